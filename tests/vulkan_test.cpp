// luxel::vulkan as an engine uses it: borrowed handles, its own memory at offsets, refusals, limits, threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <numeric>
#include <thread>

#include "host/module.h"
#include "host/vulkan/state.h"
#include "tests/support/probe_list.h"
#include "tests/support/vulkan_engine.h"

namespace luxel::built_in {
extern const std::span<const Module* const> probe;
}

namespace luxel::vulkan {
namespace {

bool validating() {
  const char* value = std::getenv("LUXEL_VALIDATION");
  return value && std::string(value) == "1";
}

TEST_F(VulkanTest, AdoptRefusesNullHandlesAndClaimsThatAreNotTrue) {
  const Adopt good = engine().machine->handles();
  const auto refused = [&](const std::function<void(Adopt&)>& change, const std::string& part) {
    Adopt info = good;
    change(info);
    expect_refusal(Device::adopt(info).status(), Code::invalid_argument, part);
  };
  refused([](Adopt& info) { info.instance = VK_NULL_HANDLE; }, "Adopt.instance is null; expected a VkInstance");
  refused([](Adopt& info) { info.physical = VK_NULL_HANDLE; }, "Adopt.physical is null; expected a VkPhysicalDevice");
  refused([](Adopt& info) { info.device = VK_NULL_HANDLE; }, "Adopt.device is null; expected a VkDevice");
}

TEST_F(VulkanTest, AdoptKnowsItsDriver) {
  EXPECT_FALSE(engine().device.name().empty());
  EXPECT_FALSE(engine().device.driver().empty());
  const bool software = engine().device.name().find("llvmpipe") != std::string::npos;
  EXPECT_EQ(engine().device.profile().name, software ? "lavapipe" : "gpu");
}

TEST_F(VulkanTest, RecordRefusesBadBindingsAndRecordsNothing) {
  const Plan plan = engine().plan();
  const Pipeline pipeline = engine().pipeline(plan);
  const std::string bytes = std::to_string(plan.resources[1].bytes);
  const auto refused = [&](const std::function<void(Bound&)>& change, const std::string& part) {
    Bound bound(engine(), plan);
    change(bound);
    expect_refusal(bound.run(pipeline), Code::invalid_argument, part);
    const std::vector<std::uint8_t> output = bound.output();
    EXPECT_EQ(std::count(output.begin(), output.end(), guard_byte), static_cast<std::ptrdiff_t>(output.size())) << part;
  };
  refused([](Bound& s) { s["dst"].bytes = 100; },
          "gaussian_blur: binding dst has 100 bytes; needs at least " + bytes);
  refused([](Bound& s) { s["scratch"].bytes = 16384; }, "gaussian_blur: binding scratch has 16384 bytes");
  refused([](Bound& s) { s.bindings.erase(s.bindings.begin()); }, "binding src is missing");
  refused([](Bound& s) { s.bindings.pop_back(); }, "binding scratch is missing");
  refused([](Bound& s) { s["src"].name = "source"; }, "binding source is unknown; expected src, dst, scratch");
  refused([](Bound& s) { s.bindings.push_back(s["src"]); }, "binding src is given twice");
  refused([](Bound& s) { s["src"].buffer = VK_NULL_HANDLE; }, "binding src has a null buffer; expected a VkBuffer");
  refused([](Bound& s) { s["dst"].offset += 1; }, "binding dst has offset 513; expected a multiple of ");
  refused([](Bound& s) { s["scratch"].offset += 2; }, "binding scratch has offset 514; expected a multiple of ");
  refused([](Bound& s) { s["scratch"].buffer = s["dst"].buffer; }, "overlap");

  const auto image = engine().memory(engine().plan(Input::image).resources[0]);
  refused([&](Bound& s) { s["src"] = image->binding("src"); }, "binding src has an image view; expected a buffer");
}

TEST_F(VulkanTest, RecordRefusesBadImagesAndOptions) {
  const Plan plan = engine().plan(Input::image);
  const Pipeline pipeline = engine().pipeline(plan);
  const auto refused = [&](const std::function<void(Binding&)>& change, const std::string& part) {
    Bound bound(engine(), plan);
    change(bound["src"]);
    expect_refusal(bound.run(pipeline), Code::invalid_argument, part);
  };
  refused([](Binding& b) { b.view = VK_NULL_HANDLE; }, "binding src has a null view; expected a VkImageView");
  refused([](Binding& b) { b.layout = VK_IMAGE_LAYOUT_UNDEFINED; }, "binding src has layout 0; expected ");
  const auto buffer = engine().buffer("buffer", 1 << 20);
  refused([&](Binding& b) { b = buffer->binding("src"); }, "binding src has a buffer; expected an image view");

  Bound bound(engine(), plan);
  expect_refusal(pipeline.record(VK_NULL_HANDLE, bound.bindings), Code::invalid_argument, "commands is null");
}

TEST_F(VulkanTest, TexelBuffersNeedAPlaceForTheirViews) {
  const Module& module = *built_in::probe[0];
  ASSERT_EQ(module.name, "f32x1");
  Plan plan;
  plan.kernel = "probe";
  const auto add = [&](const char* name, Format format, std::size_t bytes, bool written) {
    Resource resource;
    resource.name = name;
    resource.format = format;
    resource.bytes = bytes;
    resource.written = written;
    plan.resources.push_back(resource);
  };
  add("src", Format::f32x1, 4 * 37 * 5, false);
  add("dst", Format::f32x1, 4 * 37 * 5, true);
  add("counters", Format::u32, 16, true);
  add("numbers", Format::f32x1, 256, false);
  add("results", Format::f32x1, 4096, true);
  add("bits", Format::u32, 1024, true);
  plan.tables = plan.exact_tables = {std::vector<double>(16, 0.25)};
  plan.scratch_bytes = table_bytes;
  Pass pass;
  pass.module = &module;
  pass.label = "probe";
  for (const int index : {0, 1, -1, 2, 3, 4, 5, 0}) {
    pass.slots.push_back(index < 0 ? Slot{Slot::Source::table, 0} : Slot{Slot::Source::resource, index});
  }
  pass.parameters = {37, 0.75, 5, 5};
  for (const ConstantInfo& info : module.constants) pass.constants.push_back(info.name == "LANES" ? 1 : info.fallback);
  pass.workgroup = {64, 1, 1};
  pass.groups = {2, 5, 1};
  plan.passes = {pass};

  const Pipeline pipeline = engine().pipeline(plan);
  EXPECT_TRUE(pipeline.reads_texels());
  Bound bound(engine(), plan);
  Status status;
  ASSERT_TRUE(engine().machine->once([&](VkCommandBuffer commands) {
    status = pipeline.record(commands, bound.bindings);
  }));
  expect_refusal(status, Code::invalid_argument, "Record.texel_views is null");
  status = bound.run(pipeline);
  EXPECT_TRUE(status.ok()) << status.message();
  const std::vector<std::uint8_t> output = bound.output();
  EXPECT_LT(std::count(output.begin(), output.end(), guard_byte), static_cast<std::ptrdiff_t>(output.size() / 8));
}

TEST_F(VulkanTest, LimitsAreNamedBeforeAnythingIsCompiled) {
  const auto& limits = engine().device.state->physical.properties.limits;
  const auto refused = [&](const std::function<void(Plan&)>& change, const std::string& part) {
    Plan plan = engine().plan();
    change(plan);
    expect_refusal(Pipeline::create(engine().device, plan).status(), Code::unsupported, part);
  };
  const std::uint64_t range = limits.maxStorageBufferRange;
  refused([&](Plan& p) { p.resources[1].bytes = range + 16; },
          "maxStorageBufferRange of " + engine().device.name() + " is " + std::to_string(range) +
              "; binding dst (a smaller image does) needs " + std::to_string(range + 16));
  refused([&](Plan& p) { p.passes[0].groups[1] = limits.maxComputeWorkGroupCount[1] + 1; },
          "maxComputeWorkGroupCount[1]");
  refused([&](Plan& p) { p.passes[0].workgroup[2] = limits.maxComputeWorkGroupSize[2] + 1; },
          "maxComputeWorkGroupSize[2]");
  refused([&](Plan& p) { p.passes[1].workgroup = {limits.maxComputeWorkGroupInvocations, 2, 1}; },
          "maxComputeWorkGroupInvocations");

  const SharedInfo shared[] = {{limits.maxComputeSharedMemorySize, "a"}, {4, "b"}};
  Module module = *engine().plan().passes[0].module;
  module.shared = shared;
  refused([&](Plan& p) { p.passes[0].module = &module; }, "maxComputeSharedMemorySize");
  Module longer = *engine().plan().passes[0].module;
  const std::vector<ParameterInfo> many(limits.maxPushConstantsSize / 4 + 1, {Scalar::int32, "p"});
  longer.parameters = many;
  refused([&](Plan& p) {
    p.passes[0].module = &longer;
    p.passes[0].parameters.assign(many.size(), 0);
  }, "maxPushConstantsSize");
}

TEST_F(VulkanTest, AParameterThatItsTypeDoesNotHoldIsADefect) {
  Plan plan = engine().plan();
  plan.passes[0].parameters[0] = 0.5;
  expect_refusal(Pipeline::create(engine().device, plan).status(), Code::internal, "width is 0.5");
}

TEST_F(VulkanTest, ARefusalOfTheDriversCompilerNamesKernelAndDriver) {
  if (engine().device.profile().name != "lavapipe") GTEST_SKIP() << "other drivers may die of invalid SPIR-V";
  const Variable off("LUXEL_VALIDATION", "0");  // the layers die of it too
  const Engine plain = Engine::open();
  Plan plan = plain.plan();
  Module module = *plan.passes[0].module;
  std::vector<std::uint32_t> code(module.spirv.begin(), module.spirv.end());
  code.resize(code.size() / 2);
  module.spirv = code;
  plan.passes[0].module = &module;
  const Status status = Pipeline::create(plain.device, plan).status();
  expect_refusal(status, Code::compile_failed, "gaussian_blur: pass gaussian_blur rows: vkCreateComputePipelines");
  expect_refusal(status, Code::compile_failed, plain.device.driver());
}

TEST_F(VulkanTest, OffsetsAndMarginsAreKept) {
  const Plan plan = engine().plan();
  Bound bound(engine(), plan);
  const Status status = bound.run(engine().pipeline(plan));
  ASSERT_TRUE(status.ok()) << status.message();
  std::vector<float> blurred(plan.resources[1].bytes / 4);
  const std::vector<std::uint8_t> output = bound.output();
  ASSERT_EQ(output.size(), plan.resources[1].bytes);
  std::memcpy(blurred.data(), output.data(), output.size());
  const double sum = std::accumulate(blurred.begin(), blurred.end(), 0.0);
  EXPECT_NEAR(sum / static_cast<double>(blurred.size()), 0.5, 0.01);  // a sine around one half keeps its mean
  EXPECT_EQ(expected(engine().plan(Input::image)), output);
}

TEST_F(VulkanTest, InPlaceGivesTheSameBits) {
  const Plan plan = engine().plan();
  Bound bound(engine(), plan);
  Binding dst = bound["src"];
  dst.name = "dst";
  const Binding apart = bound["dst"];
  bound["dst"] = dst;
  const Status status = bound.run(engine().pipeline(plan));
  ASSERT_TRUE(status.ok()) << status.message();
  bound["dst"] = apart;
  EXPECT_EQ(bound.output("src"), expected(plan));
}

TEST_F(VulkanTest, TwoRecordsInOneBufferNeedOnlyTheDocumentedBarrier) {
  const Plan plan = engine().plan();
  const Pipeline pipeline = engine().pipeline(plan);
  const std::vector<std::uint8_t> once = expected(plan);
  const auto twice = [&](bool apart, bool current) {
    Bound bound(engine(), plan);
    Options options[] = {{engine(), pipeline}, {engine(), pipeline}};
    const Status ran = engine().machine->once([&](VkCommandBuffer commands) {
      for (int i = 0; i < 2; ++i) {
        if (i == 1 && apart) {
          VkMemoryBarrier memory{};
          memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
          memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
          memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                                 VK_ACCESS_TRANSFER_WRITE_BIT;
          vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                               VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory, 0,
                               nullptr, 0, nullptr);
        }
        options[i].record.tables_current = i == 1 && current;
        const Status status = pipeline.record(commands, bound.bindings, options[i].record);
        EXPECT_TRUE(status.ok()) << status.message();
      }
    });
    EXPECT_TRUE(ran.ok()) << ran.message();
    EXPECT_EQ(bound.output(), once);
  };
  twice(true, false);
  twice(true, true);
  EXPECT_EQ(take_validation_messages(), std::vector<std::string>{});
  if (!validating()) return;
  twice(false, false);
  const std::vector<std::string> messages = take_validation_messages();
  EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [](const std::string& message) {
    return message.find("SYNC-HAZARD") != std::string::npos;
  })) << "synchronization validation is not on, or misses a hazard";
}

/// A walk along a list of 70 items, bound and zeroed.
class Walk {
 public:
  explicit Walk(const Engine& engine) : plan(probe_list_plan(40)), pipeline(engine.pipeline(plan)), bound(engine, plan) {
    std::vector<std::uint32_t> marked(probe_items, 0);
    std::fill(marked.begin() + 100, marked.begin() + 170, 1u);
    bound.upload("marked", marked);
    bound.upload("done", std::vector<std::uint32_t>(probe_items + 1, 0));
  }

  /// How often each item of the list was met, and -1 where an item was met another number of times.
  int met() {
    read();
    for (std::size_t i = 0; i < probe_items; ++i) {
      if (done_[i] != (i >= 100 && i < 170 ? done_[100] : 0)) return -1;
    }
    return static_cast<int>(done_[100]);
  }
  std::uint32_t workgroups() {
    read();
    return done_[probe_items];
  }

  Plan plan;
  Pipeline pipeline;
  Bound bound;

 private:
  void read() {
    const std::vector<std::uint8_t> bytes = bound.output("done");
    done_.resize(probe_items + 1);
    std::memcpy(done_.data(), bytes.data(), bytes.size());
  }
  std::vector<std::uint32_t> done_;
};

TEST_F(VulkanTest, AListDecidesTheWorkgroupsOfALaterPass) {
  for (const bool indirect : {true, false}) {
    Walk walk(engine());
    EXPECT_EQ(walk.pipeline.counts(), std::vector<std::string>{"scratch"});
    const Status status = walk.bound.run(walk.pipeline, indirect);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(walk.met(), 1);
    EXPECT_EQ(walk.workgroups(), indirect ? 3u : 40u);
  }
  EXPECT_TRUE(engine().pipeline(engine().plan()).counts().empty());
}

TEST_F(VulkanTest, CountsMayLieInABufferOfTheCallers) {
  Walk walk(engine());
  Plan plan = walk.plan;
  plan.resources.push_back({"counts"});
  plan.resources.back().format = Format::u32;
  plan.resources.back().bytes = 16;
  plan.resources.back().written = true;
  plan.passes[0].slots[2] = plan.passes[1].counts->slot = {Slot::Source::resource, 2};
  const Pipeline pipeline = engine().pipeline(plan);
  EXPECT_EQ(pipeline.counts(), std::vector<std::string>{"counts"});
  Bound bound(engine(), plan);
  bound.upload("marked", std::vector<std::uint32_t>(probe_items, 1));
  bound.upload("done", std::vector<std::uint32_t>(probe_items + 1, 0));
  const Status status = bound.run(pipeline, true);
  ASSERT_TRUE(status.ok()) << status.message();
  std::vector<std::uint32_t> done(probe_items + 1), counts(4);
  std::memcpy(done.data(), bound.output("done").data(), 4 * done.size());
  std::memcpy(counts.data(), bound.output("counts").data(), 16);
  EXPECT_EQ(done.back(), 32u);
  EXPECT_EQ(counts, (std::vector<std::uint32_t>{77, 32, 1, 1}));
  EXPECT_EQ(std::count(done.begin(), done.end() - 1, 1u), static_cast<std::ptrdiff_t>(probe_items));
}

TEST_F(VulkanTest, CountsThatAreReadAndWrittenAgainNeedOnlyTheDocumentedBarrier) {
  const auto twice = [&](bool apart) {
    Walk walk(engine());
    Options options[] = {{engine(), walk.pipeline}, {engine(), walk.pipeline}};
    const Status ran = engine().machine->once([&](VkCommandBuffer commands) {
      for (int i = 0; i < 2; ++i) {
        if (i == 1 && apart) {
          VkMemoryBarrier memory{};
          memory.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
          memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
          memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                                 VK_ACCESS_TRANSFER_WRITE_BIT;
          vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                               VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 1, &memory, 0,
                               nullptr, 0, nullptr);
        }
        options[i].record.indirect = true;
        const Status status = walk.pipeline.record(commands, walk.bound.bindings, options[i].record);
        EXPECT_TRUE(status.ok()) << status.message();
      }
    });
    EXPECT_TRUE(ran.ok()) << ran.message();
    EXPECT_TRUE(!apart || walk.met() == 2);
  };
  twice(true);
  EXPECT_EQ(take_validation_messages(), std::vector<std::string>{});
  if (!validating()) return;
  twice(false);
  const std::vector<std::string> messages = take_validation_messages();
  EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [](const std::string& message) {
    return message.find("SYNC-HAZARD") != std::string::npos;
  })) << "synchronization validation is not on, or misses a hazard";
}

TEST_F(VulkanTest, ABufferThatWasNotMadeForCountsIsReportedByTheLayers) {
  if (!validating()) GTEST_SKIP() << "only the validation layers see a buffer's usage";
  Walk walk(engine());
  const VkDevice device = engine().machine->device();
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = walk.plan.scratch_bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  VkBuffer plain = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreateBuffer(device, &info, nullptr, &plain), VK_SUCCESS);
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device, plain, &needs);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex = static_cast<std::uint32_t>(engine().machine->memory_type(needs.memoryTypeBits, 0));
  VkDeviceMemory memory = VK_NULL_HANDLE;
  ASSERT_EQ(vkAllocateMemory(device, &allocate, nullptr, &memory), VK_SUCCESS);
  ASSERT_EQ(vkBindBufferMemory(device, plain, memory, 0), VK_SUCCESS);
  walk.bound["scratch"].buffer = plain;
  walk.bound["scratch"].offset = 0;
  // Without the claim a fixed launch asks nothing of the buffer.
  EXPECT_TRUE(walk.bound.run(walk.pipeline, false).ok());
  EXPECT_EQ(take_validation_messages(), std::vector<std::string>{});
  EXPECT_EQ(walk.workgroups(), 40u);
  EXPECT_TRUE(walk.bound.run(walk.pipeline, true).ok());
  const std::vector<std::string> messages = take_validation_messages();
  EXPECT_TRUE(std::any_of(messages.begin(), messages.end(), [](const std::string& message) {
    return message.find("INDIRECT_BUFFER") != std::string::npos;
  })) << "the layers do not see the missing usage";
  vkDestroyBuffer(device, plain, nullptr);
  vkFreeMemory(device, memory, nullptr);
}

TEST_F(VulkanTest, TimestampsComeInOrder) {
  const Plan plan = engine().plan();
  const Pipeline pipeline = engine().pipeline(plan);
  if (engine().machine->timestamp_mask() == 0) GTEST_SKIP() << "this queue has no timestamps";
  const VkDevice device = engine().machine->device();
  const std::uint32_t first = 3, count = static_cast<std::uint32_t>(plan.passes.size()) + 1;
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = first + count;
  VkQueryPool queries = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreateQueryPool(device, &info, nullptr, &queries), VK_SUCCESS);
  Bound bound(engine(), plan);
  Options options(engine(), pipeline);
  options.record.timestamps = queries;
  options.record.first_query = first;
  const Status ran = engine().machine->once([&](VkCommandBuffer commands) {
    vkCmdResetQueryPool(commands, queries, 0, info.queryCount);
    const Status status = pipeline.record(commands, bound.bindings, options.record);
    EXPECT_TRUE(status.ok()) << status.message();
  });
  EXPECT_TRUE(ran.ok()) << ran.message();
  std::vector<std::uint64_t> ticks(count);
  EXPECT_EQ(vkGetQueryPoolResults(device, queries, first, count, 8 * count, ticks.data(), 8, VK_QUERY_RESULT_64_BIT),
            VK_SUCCESS);
  for (std::size_t i = 1; i < ticks.size(); ++i) EXPECT_LT(ticks[i - 1], ticks[i]) << "pass " << i - 1;
  EXPECT_EQ(bound.output(), expected(plan));
  vkDestroyQueryPool(device, queries, nullptr);
}

TEST_F(VulkanTest, ThreadsCreateAndRecordAtTheSameTime) {
  const Plan plan = engine().plan(Input::buffer, 131, 67, 3);
  const Engine fresh = Engine::open();  // so that threads meet while they compile
  const std::vector<std::uint8_t> alone = expected(plan);
  const Pipeline shared = fresh.pipeline(fresh.plan());
  const std::vector<std::uint8_t> shared_alone = expected(engine().plan());
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      const Pipeline own = fresh.pipeline(plan);
      for (int i = 0; i < 5; ++i) {
        Bound a(fresh, plan), b(fresh, shared.plan());
        Status status = a.run(own);
        EXPECT_TRUE(status.ok()) << status.message();
        status = b.run(shared);
        EXPECT_TRUE(status.ok()) << status.message();
        EXPECT_EQ(a.output(), alone);
        EXPECT_EQ(b.output(), shared_alone);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST_F(VulkanTest, WithoutPushDescriptorsTheBitsAreEqual) {
  const Variable refuse("LUXEL_NO_PUSH_DESCRIPTOR", "1");
  const Engine other = Engine::open();
  Adopt claim = other.machine->handles();
  ASSERT_FALSE(claim.push_descriptor);
  claim.push_descriptor = true;
  expect_refusal(Device::adopt(claim).status(), Code::invalid_argument,
                 "Adopt.push_descriptor is true but VK_KHR_push_descriptor is not enabled");
  for (const Input input : {Input::buffer, Input::image}) {
    const Plan plan = other.plan(input);
    const Pipeline pipeline = other.pipeline(plan);
    EXPECT_FALSE(pipeline.pool_sizes().empty());
    Bound bound(other, plan);
    Status status;
    ASSERT_TRUE(other.machine->once([&](VkCommandBuffer commands) {
      status = pipeline.record(commands, bound.bindings);
    }));
    expect_refusal(status, Code::invalid_argument, "Record.pool is null; expected a VkDescriptorPool");
    status = bound.run(pipeline);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(bound.output(), expected(plan));
  }
}

}  // namespace
}  // namespace luxel::vulkan

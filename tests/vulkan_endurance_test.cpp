// Hard use of the Vulkan execution: thousands of cycles without growth, threads that share a pipeline, and what must be
// refused or survived where memory, disk or descriptors run out.
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "host/files.h"
#include "host/vulkan/result.h"
#include "tests/support/resident.h"
#include "tests/support/vulkan_engine.h"

namespace luxel::vulkan {
namespace {

namespace fs = std::filesystem;

/// Without validation layers, which keep a record of everything.
class VulkanEndurance : public testing::Test {
 protected:
  VulkanEndurance() : off("LUXEL_VALIDATION", "0"), engine(Engine::open()) {}
  const Variable off;
  const Engine engine;
};

/// One pipeline's record into a command buffer that begins anew each time.
struct Recorder {
  Recorder(const Engine& engine, const Pipeline& pipeline) : bound(engine, pipeline.plan()), commands(*engine.machine) {
    EXPECT_EQ(commands.result, VK_SUCCESS);
  }
  Status record(const Engine& engine, const Pipeline& pipeline) {
    Options options(engine, pipeline);
    EXPECT_EQ(commands.begin(), VK_SUCCESS);
    const Status status = pipeline.record(commands.buffer, bound.bindings, options.record);
    EXPECT_EQ(vkEndCommandBuffer(commands.buffer), VK_SUCCESS);
    return status;
  }
  Bound bound;
  Commands commands;
};

TEST_F(VulkanEndurance, TenThousandPipelinesAreMadeRecordedAndGone) {
  const Plan plan = engine.plan(Input::buffer, 16, 16, 1);
  Recorder recorder(engine, engine.pipeline(plan));
  std::size_t before = 0, allocated = 0;
  for (int i = 0; i < 10000; ++i) {
    if (i == 1000) before = resident_bytes(), allocated = allocated_bytes();
    const Pipeline pipeline = engine.pipeline(plan);
    const Status status = recorder.record(engine, pipeline);
    ASSERT_TRUE(status.ok()) << status.message();
  }
  EXPECT_LE(resident_bytes(), before + resident_noise);
  EXPECT_LE(allocated_bytes(), allocated + allocated_noise);
}

TEST_F(VulkanEndurance, TenThousandFramesOfOnePipeline) {
  const Pipeline pipeline = engine.pipeline(engine.plan(Input::buffer, 16, 16, 1));
  Bound bound(engine, pipeline.plan());
  Commands commands(*engine.machine);
  ASSERT_EQ(commands.result, VK_SUCCESS);
  std::size_t before = 0, allocated = 0;
  for (int i = 0; i < 10000; ++i) {
    if (i == 1000) before = resident_bytes(), allocated = allocated_bytes();
    Options options(engine, pipeline);
    ASSERT_EQ(commands.begin(), VK_SUCCESS);
    const Status status = pipeline.record(commands.buffer, bound.bindings, options.record);
    ASSERT_TRUE(status.ok()) << status.message();
    ASSERT_EQ(vkEndCommandBuffer(commands.buffer), VK_SUCCESS);
    const Status ran = engine.machine->run(commands.buffer);
    ASSERT_TRUE(ran.ok()) << ran.message();
  }
  EXPECT_LE(resident_bytes(), before + resident_noise);
  EXPECT_LE(allocated_bytes(), allocated + allocated_noise);
  Bound once(engine, pipeline.plan());
  ASSERT_TRUE(once.run(pipeline).ok());
  EXPECT_EQ(bound.output(), once.output());
}

TEST_F(VulkanTest, EightThreadsRecordOnePipelineIntoBuffersOfTheirOwn) {
  const Pipeline shared = engine().pipeline(engine().plan());
  const std::vector<std::uint8_t> alone = expected(shared.plan());
  std::vector<std::unique_ptr<Bound>> bound;
  for (int t = 0; t < 8; ++t) bound.push_back(std::make_unique<Bound>(engine(), shared.plan()));
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 8; ++i) {
        Commands commands(*engine().machine);
        Options options(engine(), shared);
        EXPECT_EQ(commands.begin(), VK_SUCCESS);
        const Status status = shared.record(commands.buffer, bound[static_cast<std::size_t>(t)]->bindings, options.record);
        EXPECT_TRUE(status.ok()) << status.message();
        EXPECT_EQ(vkEndCommandBuffer(commands.buffer), VK_SUCCESS);
        const Status ran = engine().machine->run(commands.buffer);
        EXPECT_TRUE(ran.ok()) << ran.message();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& b : bound) EXPECT_EQ(b->output(), alone);
}

TEST_F(VulkanTest, OneByteShortIsRefused) {
  const Plan plan = engine().plan();
  const Pipeline pipeline = engine().pipeline(plan);
  for (const char* name : {"src", "dst", "scratch"}) {
    Bound bound(engine(), plan);
    const std::string needs = std::to_string(bound[name].bytes);
    bound[name].bytes -= 1;
    expect_refusal(bound.run(pipeline), Code::invalid_argument, std::string("binding ") + name);
    expect_refusal(bound.run(pipeline), Code::invalid_argument, "needs at least " + needs);
  }
}

TEST_F(VulkanTest, ADispatchOfNothingIsRefused) {
  Plan plan = engine().plan();
  plan.passes[0].groups[0] = 0;
  const Status status = Pipeline::create(engine().device, plan).status();
  EXPECT_FALSE(status.ok()) << "0 workgroups were taken";
  EXPECT_EQ(status.message().find('\n'), std::string::npos);
  GaussianBlurParams nothing;
  nothing.width = 0, nothing.height = 5;
  expect_refusal(luxel::plan(nothing, engine().device.profile()).status(), Code::invalid_argument, "width is 0");
}

TEST_F(VulkanTest, APoolThatIsEmptySaysSoAndNothingIsRecorded) {
  const Variable refuse("LUXEL_NO_PUSH_DESCRIPTOR", "1");
  const Variable off("LUXEL_VALIDATION", "0");  // the layers call it an error, as it is
  const Engine other = Engine::open();
  const Plan plan = other.plan();
  const Pipeline pipeline = other.pipeline(plan);
  ASSERT_FALSE(pipeline.pool_sizes().empty());
  Bound bound(other, plan);
  Options options(other, pipeline);
  Status first, second;
  ASSERT_TRUE(other.machine->once([&](VkCommandBuffer commands) {
    first = pipeline.record(commands, bound.bindings, options.record);   // takes all that the pool has
    second = pipeline.record(commands, bound.bindings, options.record);
  }));
  EXPECT_TRUE(first.ok()) << first.message();
  if (second.ok()) GTEST_SKIP() << "this driver's pools give more than they were made for";
  expect_refusal(second, Code::out_of_memory, "from Record.pool (see Pipeline::pool_sizes)");
  EXPECT_EQ(bound.output(), expected(plan));
}

TEST_F(VulkanTest, MemoryThatNobodyHasIsOutOfMemory) {
  Resource resource;
  resource.name = "huge";
  const auto made = DeviceMemory::make(nullptr, engine().machine, resource, std::size_t{1} << 46);
  ASSERT_FALSE(made.ok());
  EXPECT_TRUE(made.status().code() == Code::out_of_memory || made.status().code() == Code::unsupported)
      << name(made.status().code()) << ": " << made.status().message();
  EXPECT_NE(made.status().message().find("huge"), std::string::npos) << made.status().message();
  (void)take_validation_messages();  // the layers may warn of the size
}

TEST(VulkanResults, ALostDeviceHasItsOwnCode) {
  const Status lost = failure("vkQueueSubmit", VK_ERROR_DEVICE_LOST);
  EXPECT_EQ(lost.code(), Code::device_lost);
  EXPECT_NE(lost.message().find("VK_ERROR_DEVICE_LOST"), std::string::npos) << lost.message();
  EXPECT_EQ(failure("x", VK_ERROR_OUT_OF_HOST_MEMORY).code(), Code::out_of_memory);
  EXPECT_EQ(failure("x", VK_ERROR_OUT_OF_DEVICE_MEMORY).code(), Code::out_of_memory);
  EXPECT_EQ(failure("x", VK_ERROR_OUT_OF_POOL_MEMORY).code(), Code::out_of_memory);
  EXPECT_EQ(failure("x", VK_ERROR_FEATURE_NOT_PRESENT).code(), Code::unsupported);
}

TEST_F(VulkanTest, ADiskThatIsFullCostsTheCacheNothingElse) {
  const fs::path folder = fs::temp_directory_path() / ("luxel_full_disk_" + std::to_string(getpid()));
  fs::remove_all(folder);
  const std::vector<std::uint8_t> wanted = expected(engine().plan());
  {
    // A file may hold 20 bytes, less than any cache: the next write fails, as on a disk that is full.
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit little = before;
    little.rlim_cur = 20;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    std::vector<std::uint8_t> output;
    {
      const Engine fresh = Engine::open(folder.string());
      const Plan plan = fresh.plan();
      Bound bound(fresh, plan);
      const Status status = bound.run(fresh.pipeline(plan));
      EXPECT_TRUE(status.ok()) << status.message();
      output = bound.output();
    }
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    EXPECT_EQ(output, wanted);
  }
  if (fs::exists(folder)) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      EXPECT_FALSE(entry.is_regular_file()) << entry.path() << " was left half written";
    }
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace luxel::vulkan

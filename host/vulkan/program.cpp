#include "host/vulkan/program.h"

#include <chrono>

#include "host/vulkan/result.h"

namespace luxel::vulkan {

Result<std::shared_ptr<luxel::Program>> DeviceProgram::compile(const Context* owner,
                                                               const std::shared_ptr<Machine>& machine,
                                                               const Device& device, const Plan& plan) {
  Result<Pipeline> pipeline = Pipeline::create(device, plan);
  if (!pipeline) return pipeline.status();
  std::shared_ptr<DeviceProgram> program(new DeviceProgram(owner, machine, std::move(pipeline).value()));
  if (program->commands_.result != VK_SUCCESS) {
    return failure(plan.kernel + ": making a command buffer", program->commands_.result);
  }
  if (plan.scratch_bytes > 0) {
    const std::string what = "scratch of " + plan.kernel;
    if (Status status = make_storage(machine, plan.scratch_bytes, what, program->scratch_); !status) return status;
  }
  return std::shared_ptr<luxel::Program>(std::move(program));
}

DeviceProgram::DeviceProgram(const Context* owner, const std::shared_ptr<Machine>& machine, Pipeline pipeline)
    : luxel::Program(owner), machine_(machine), pipeline_(std::move(pipeline)), commands_(*machine) {}

DeviceProgram::~DeviceProgram() { destroy_recorded(); }

void DeviceProgram::destroy_recorded() {
  recorded_ = {};
  vkDestroyDescriptorPool(machine_->device(), descriptors_, nullptr);
  vkDestroyQueryPool(machine_->device(), queries_, nullptr);
  for (VkBufferView view : views_) vkDestroyBufferView(machine_->device(), view, nullptr);
  descriptors_ = VK_NULL_HANDLE;
  queries_ = VK_NULL_HANDLE;
  views_.clear();
}

std::vector<Binding> DeviceProgram::bind(const std::vector<Named>& resources) const {
  std::vector<Binding> bindings;
  for (const Named& named : resources) {
    Binding& binding = bindings.emplace_back(static_cast<const DeviceMemory&>(*named.memory).binding(named.name));
    binding.offset = offset_bytes(pipeline_.plan(), named, false);
    binding.bytes -= binding.offset;
  }
  if (scratch_.handle != VK_NULL_HANDLE) {
    Binding& scratch = bindings.emplace_back();
    scratch.name = "scratch";
    scratch.buffer = scratch_.handle;
    scratch.bytes = pipeline_.plan().scratch_bytes;
  }
  return bindings;
}

Status DeviceProgram::make_pools(int repeat, bool timed) {
  const Plan& plan = pipeline_.plan();
  const auto runs = static_cast<std::uint32_t>(repeat);
  std::vector<VkDescriptorPoolSize> sizes = pipeline_.pool_sizes();
  if (!sizes.empty()) {
    for (VkDescriptorPoolSize& size : sizes) size.descriptorCount *= runs;
    auto info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = runs * static_cast<std::uint32_t>(plan.passes.size());
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    if (const VkResult result = vkCreateDescriptorPool(machine_->device(), &info, nullptr, &descriptors_)) {
      return failure(plan.kernel + ": vkCreateDescriptorPool", result);
    }
  }
  if (timed) {
    auto info = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = runs * queries_a_run();
    if (const VkResult result = vkCreateQueryPool(machine_->device(), &info, nullptr, &queries_)) {
      return failure(plan.kernel + ": vkCreateQueryPool", result);
    }
  }
  return {};
}

Status DeviceProgram::record(const std::vector<Binding>& bindings, const Recorded& wanted) {
  const std::string& kernel = pipeline_.plan().kernel;
  destroy_recorded();
  if (Status status = make_pools(wanted.repeat, wanted.timed); !status) return status;
  if (const VkResult result = commands_.begin()) return failure(kernel + ": vkBeginCommandBuffer", result);
  if (queries_ != VK_NULL_HANDLE) {
    vkCmdResetQueryPool(commands_.buffer, queries_, 0, static_cast<std::uint32_t>(wanted.repeat) * queries_a_run());
  }
  for (int i = 0; i < wanted.repeat; ++i) {
    if (i > 0) {
      auto memory = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
      memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
      memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT;
      vkCmdPipelineBarrier(commands_.buffer, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                           VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
    }
    Record options;
    options.pool = descriptors_;
    options.timestamps = queries_;
    options.first_query = static_cast<std::uint32_t>(i) * queries_a_run();
    options.tables_current = wanted.tables_current || i > 0;
    options.indirect = true;
    options.texel_views = &views_;
    if (Status status = pipeline_.record(commands_.buffer, bindings, options); !status) return status;
  }
  publish(commands_.buffer);
  if (const VkResult result = vkEndCommandBuffer(commands_.buffer)) {
    return failure(kernel + ": vkEndCommandBuffer", result);
  }
  recorded_ = wanted;
  return {};
}

Status DeviceProgram::read_times(int repeat, Times& times) const {
  const std::size_t count = static_cast<std::size_t>(repeat) * queries_a_run();
  std::vector<std::uint64_t> ticks(count);
  const VkResult result = vkGetQueryPoolResults(machine_->device(), queries_, 0, static_cast<std::uint32_t>(count),
                                                8 * count, ticks.data(), 8,
                                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
  if (result != VK_SUCCESS) return failure(pipeline_.plan().kernel + ": vkGetQueryPoolResults", result);
  times.passes.assign(queries_a_run() - 1, 0);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const std::size_t pass = i % queries_a_run();
    if (pass == times.passes.size()) continue;
    const std::uint64_t elapsed = (ticks[i + 1] - ticks[i]) & machine_->timestamp_mask();
    times.passes[pass] += static_cast<double>(elapsed) * machine_->timestamp_period() * 1e-6;
  }
  return {};
}

Status DeviceProgram::run(const std::vector<Named>& resources, int repeat, Times* times) {
  const std::lock_guard lock(mutex_);
  if (repeat < 1) {
    return {Code::invalid_argument,
            pipeline_.plan().kernel + ": repeat is " + std::to_string(repeat) + "; expected at least 1"};
  }
  if (Status status = check_memories(owner, pipeline_.plan(), resources); !status) return status;
  Recorded wanted;
  for (const Named& named : resources) {
    wanted.memories.emplace_back(named.name, static_cast<const DeviceMemory&>(*named.memory).id(),
                                 named.first);
  }
  wanted.repeat = repeat;
  wanted.timed = times && machine_->timestamp_mask() != 0;
  wanted.tables_current = tables_current_;
  if (!(wanted == recorded_)) {
    if (Status status = record(bind(resources), wanted); !status) return status;
  }

  const auto start = std::chrono::steady_clock::now();
  if (Status status = machine_->run(commands_.buffer); !status) return status;
  const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
  tables_current_ = true;
  if (!times) return {};
  times->total = elapsed.count();
  times->passes.clear();
  return wanted.timed ? read_times(repeat, *times) : Status();
}

}  // namespace luxel::vulkan

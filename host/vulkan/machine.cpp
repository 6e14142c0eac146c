#include "host/vulkan/machine.h"

#include <cstdlib>
#include <limits>
#include <string_view>

#include "host/vulkan/result.h"

namespace luxel::vulkan {
namespace {

/// The first family that computes, one with timestamps if there is any.
int choose_family(VkPhysicalDevice device, std::uint64_t& timestamp_mask) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
  int chosen = -1;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(families[i].queueFlags & VK_QUEUE_COMPUTE_BIT)) continue;
    const std::uint32_t bits = families[i].timestampValidBits;
    if (chosen >= 0 && bits == 0) continue;
    chosen = static_cast<int>(i);
    timestamp_mask = bits == 0 ? 0 : bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    if (bits) break;
  }
  return chosen;
}

}  // namespace

Result<std::shared_ptr<Machine>> Machine::open(int index) {
  Result<std::unique_ptr<Instance>> instance = Instance::create();
  if (!instance) return instance.status();
  std::shared_ptr<Machine> machine(new Machine);
  machine->instance_ = std::move(instance).value();
  const auto& devices = machine->instance_->devices();
  if (index < 0 || static_cast<std::size_t>(index) >= devices.size()) {
    return Status(Code::missing_driver, "vulkan: device " + std::to_string(index) + " does not exist; expected 0.." +
                                            std::to_string(devices.size() - 1));
  }
  machine->physical_ = devices[static_cast<std::size_t>(index)];
  machine->about_ = describe(machine->physical_);
  vkGetPhysicalDeviceMemoryProperties(machine->physical_, &machine->memory_);
  const int family = choose_family(machine->physical_, machine->timestamp_mask_);
  if (family < 0) {
    return Status(Code::unsupported, "vulkan: " + machine->about_.name + " has no queue that computes; take another");
  }
  machine->family_ = static_cast<std::uint32_t>(family);

  const char* refused = std::getenv("LUXEL_NO_PUSH_DESCRIPTOR");
  machine->push_descriptor_ = !(refused && std::string_view(refused) == "1") &&
                              has_extension(machine->physical_, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME);
  const char* const push = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
  VkPhysicalDeviceFeatures available{};
  vkGetPhysicalDeviceFeatures(machine->physical_, &available);
  VkPhysicalDeviceFeatures features{};
  features.shaderStorageImageExtendedFormats = available.shaderStorageImageExtendedFormats;
  const float priority = 1;
  auto queue = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queue.queueFamilyIndex = machine->family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = machine->push_descriptor_ ? 1 : 0;
  info.ppEnabledExtensionNames = &push;
  info.pEnabledFeatures = &features;
  if (const VkResult result = vkCreateDevice(machine->physical_, &info, nullptr, &machine->device_)) {
    return failure("vulkan: vkCreateDevice on " + machine->about_.name, result, Code::unsupported);
  }
  vkGetDeviceQueue(machine->device_, machine->family_, 0, &machine->queue_);
  return machine;
}

Machine::~Machine() {
  if (device_ == VK_NULL_HANDLE) return;
  vkDeviceWaitIdle(device_);
  for (const VkFence fence : fences_) vkDestroyFence(device_, fence, nullptr);
  vkDestroyDevice(device_, nullptr);
}

Adopt Machine::handles() const {
  Adopt info;
  info.instance = instance_->handle();
  info.physical = physical_;
  info.device = device_;
  info.push_descriptor = push_descriptor_;
  info.debug_utils = instance_->debug_utils();
  return info;
}

int Machine::memory_type(std::uint32_t bits, VkMemoryPropertyFlags flags) const {
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
    if ((bits >> i & 1) && (memory_.memoryTypes[i].propertyFlags & flags) == flags) return static_cast<int>(i);
  }
  return -1;
}

Status Machine::run(VkCommandBuffer commands) {
  VkFence fence = VK_NULL_HANDLE;
  auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  VkResult result = VK_SUCCESS;
  {
    const std::lock_guard lock(queue_mutex_);
    if (fences_.empty()) {
      const auto info = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
      if (const VkResult made = vkCreateFence(device_, &info, nullptr, &fence)) return failure("vulkan: vkCreateFence", made);
    } else {
      fence = fences_.back();
      fences_.pop_back();
    }
    result = vkQueueSubmit(queue_, 1, &submit, fence);
  }
  if (result == VK_SUCCESS) {
    result = vkWaitForFences(device_, 1, &fence, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
  }
  const bool again = result == VK_SUCCESS && vkResetFences(device_, 1, &fence) == VK_SUCCESS;
  const std::lock_guard lock(queue_mutex_);
  if (again) {
    fences_.push_back(fence);
  } else {
    vkDeviceWaitIdle(device_);  // where waiting failed, what runs may not lose its memory
    vkDestroyFence(device_, fence, nullptr);
  }
  if (result != VK_SUCCESS) return failure("vulkan: running on " + about_.name, result);
  return {};
}

Status Machine::once(const std::function<void(VkCommandBuffer)>& record) {
  Commands commands(*this);
  if (commands.result == VK_SUCCESS) commands.result = commands.begin();
  if (commands.result != VK_SUCCESS) return failure("vulkan: making a command buffer", commands.result);
  record(commands.buffer);
  publish(commands.buffer);
  if (const VkResult result = vkEndCommandBuffer(commands.buffer)) {
    return failure("vulkan: vkEndCommandBuffer", result);
  }
  return run(commands.buffer);
}

void publish(VkCommandBuffer commands) {
  auto memory = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  memory.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
  memory.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_UNIFORM_READ_BIT |
                         VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT | VK_ACCESS_HOST_WRITE_BIT;
  constexpr VkPipelineStageFlags device = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
  vkCmdPipelineBarrier(commands, device, device | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

Commands::Commands(const Machine& machine) : device(machine.device()) {
  auto pool_info = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  pool_info.queueFamilyIndex = machine.family();
  result = vkCreateCommandPool(device, &pool_info, nullptr, &pool);
  if (result != VK_SUCCESS) return;
  auto info = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  info.commandPool = pool;
  info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  info.commandBufferCount = 1;
  result = vkAllocateCommandBuffers(device, &info, &buffer);
}

Commands::~Commands() { vkDestroyCommandPool(device, pool, nullptr); }

VkResult Commands::begin() {
  if (const VkResult reset = vkResetCommandPool(device, pool, 0)) return reset;
  const auto info = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  return vkBeginCommandBuffer(buffer, &info);
}

}  // namespace luxel::vulkan

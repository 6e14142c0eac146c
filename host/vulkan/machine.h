// An instance, a device and one queue of luxel's own, for the small layer.
#pragma once
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include <luxel/vulkan.h>

#include "host/vulkan/instance.h"
#include "host/vulkan/physical.h"

namespace luxel::vulkan {

class Machine {
 public:
  /// `index` counts the instance's devices. Errors: missing_driver, unsupported, out_of_memory.
  static Result<std::shared_ptr<Machine>> open(int index);
  ~Machine();
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  /// For Device::adopt. Without push descriptors where LUXEL_NO_PUSH_DESCRIPTOR is 1 in the environment.
  Adopt handles() const;

  const Physical& about() const { return about_; }
  VkDevice device() const { return device_; }
  std::uint32_t family() const { return family_; }
  /// Nanoseconds a tick, and the bits of a timestamp that count (0: the queue has no timestamps).
  double timestamp_period() const { return about_.properties.limits.timestampPeriod; }
  std::uint64_t timestamp_mask() const { return timestamp_mask_; }

  /// Memory type for `bits` of VkMemoryRequirements with all of `flags`; -1 where there is none.
  int memory_type(std::uint32_t bits, VkMemoryPropertyFlags flags) const;

  /// Submits and waits. Any thread.
  Status run(VkCommandBuffer commands);
  /// Records, submits and waits; what was written is visible to every later use.
  Status once(const std::function<void(VkCommandBuffer)>& record);

 private:
  Machine() = default;

  std::unique_ptr<Instance> instance_;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  Physical about_;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::uint32_t family_ = 0;
  std::uint64_t timestamp_mask_ = 0;
  bool push_descriptor_ = false;
  std::mutex queue_mutex_;
  // Fences that nothing waits for, kept for the next run: a driver's thread may still look at one that has just been signalled
  // (lavapipe's does), so that none is destroyed before the device is idle.
  std::vector<VkFence> fences_;
};

/// Makes everything written so far visible to every later use, the host's too.
void publish(VkCommandBuffer commands);

/// A command pool with one primary command buffer. Null where `result` says so.
struct Commands {
  VkDevice device = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer buffer = VK_NULL_HANDLE;
  VkResult result = VK_SUCCESS;

  explicit Commands(const Machine& machine);
  ~Commands();
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  /// Empties the buffer and begins it.
  VkResult begin();
};

}  // namespace luxel::vulkan

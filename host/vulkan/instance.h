// A Vulkan instance of luxel's own, with the validation layers where they are asked for.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/vulkan.h>

namespace luxel::vulkan {

class Instance {
 public:
  /// With LUXEL_VALIDATION=1 in the environment: Khronos validation with synchronization validation, which then must be
  /// installed. Errors: missing_driver, naming what is missing and what to install; out_of_memory.
  static Result<std::unique_ptr<Instance>> create();
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return instance_; }
  bool debug_utils() const { return debug_utils_; }
  /// In the loader's order; never empty.
  const std::vector<VkPhysicalDevice>& devices() const { return devices_; }

 private:
  Instance() = default;

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  bool debug_utils_ = false;
  std::vector<VkPhysicalDevice> devices_;
};

/// Errors and warnings of the validation layers since the last call, from every instance of this process: what a layer
/// says while an instance goes is kept too.
std::vector<std::string> take_validation_messages();

}  // namespace luxel::vulkan

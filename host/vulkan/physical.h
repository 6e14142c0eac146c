// What a physical device says about itself.
#pragma once
#include <string>

#include <luxel/vulkan.h>

namespace luxel::vulkan {

struct Physical {
  VkPhysicalDeviceProperties properties{};
  std::string name;
  std::string driver;   // name and version
  std::string profile;  // name of luxel's defaults for it
};

Physical describe(VkPhysicalDevice device);

/// The device has an extension of this name.
bool has_extension(VkPhysicalDevice device, const char* name);

}  // namespace luxel::vulkan

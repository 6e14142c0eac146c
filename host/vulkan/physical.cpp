#include "host/vulkan/physical.h"

#include <algorithm>
#include <cstring>

#include "host/vulkan/result.h"

namespace luxel::vulkan {

bool has_extension(VkPhysicalDevice device, const char* name) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, name) == 0;
  });
}

Physical describe(VkPhysicalDevice device) {
  Physical physical;
  vkGetPhysicalDeviceProperties(device, &physical.properties);
  physical.name = physical.properties.deviceName;
  physical.driver = "driver version " + std::to_string(physical.properties.driverVersion);
  physical.profile = "gpu";
  const std::uint32_t version = physical.properties.apiVersion;
  const bool known = version >= VK_API_VERSION_1_2 ||
                     (version >= VK_API_VERSION_1_1 && has_extension(device, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME));
  if (known) {
    auto driver = structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    physical.driver = std::string(driver.driverName) + " " + driver.driverInfo;
    if (driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE) physical.profile = "lavapipe";
  }
  return physical;
}

}  // namespace luxel::vulkan

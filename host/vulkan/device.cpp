#include <algorithm>
#include <cstring>

#include "result.h"
#include "state.h"

namespace luxel::vulkan {
namespace {

bool has_driver_properties(VkPhysicalDevice physical, std::uint32_t api_version) {
  if (api_version >= VK_API_VERSION_1_2) return true;
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
    return std::strcmp(extension.extensionName, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME) == 0;
  });
}

VkResult make_sampler(VkDevice device, VkSamplerAddressMode address, VkSampler& sampler) {
  auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  info.magFilter = VK_FILTER_LINEAR;
  info.minFilter = VK_FILTER_LINEAR;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
  info.addressModeU = address;
  info.addressModeV = address;
  info.addressModeW = address;
  info.maxLod = VK_LOD_CLAMP_NONE;
  return vkCreateSampler(device, &info, nullptr, &sampler);
}

}  // namespace

Result<Device> Device::adopt(const Adopt& info) {
  const auto null_handle = [](const char* field, const char* type) {
    return Status(Code::invalid_argument, std::string("Adopt.") + field + " is null; expected a " + type);
  };
  if (info.instance == VK_NULL_HANDLE) return null_handle("instance", "VkInstance");
  if (info.physical == VK_NULL_HANDLE) return null_handle("physical", "VkPhysicalDevice");
  if (info.device == VK_NULL_HANDLE) return null_handle("device", "VkDevice");

  Device device;
  device.state = std::make_shared<State>();
  State& state = *device.state;
  state.adopt = info;
  vkGetPhysicalDeviceProperties(info.physical, &state.properties);
  state.name = state.properties.deviceName;
  const std::uint32_t version = state.properties.apiVersion;
  if (version < VK_API_VERSION_1_1) {
    return Status(Code::unsupported, state.name + " has Vulkan " + std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
                                         std::to_string(VK_API_VERSION_MINOR(version)) +
                                         "; luxel needs 1.1: a newer driver or another device");
  }

  auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
  auto driver = structure<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
  auto push = structure<VkPhysicalDevicePushDescriptorPropertiesKHR>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR);
  if (has_driver_properties(info.physical, version)) {
    driver.pNext = properties.pNext;
    properties.pNext = &driver;
  }
  if (info.push_descriptor) {
    push.pNext = properties.pNext;
    properties.pNext = &push;
  }
  vkGetPhysicalDeviceProperties2(info.physical, &properties);
  state.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  if (driver.driverName[0] == '\0') state.driver = "driver version " + std::to_string(state.properties.driverVersion);
  state.profile = luxel::profile(driver.driverID == VK_DRIVER_ID_MESA_LLVMPIPE ? "lavapipe" : "gpu");
  state.max_push_descriptors = push.maxPushDescriptors;

  if (info.push_descriptor) {
    state.push_descriptor_set = reinterpret_cast<PFN_vkCmdPushDescriptorSetKHR>(
        vkGetDeviceProcAddr(info.device, "vkCmdPushDescriptorSetKHR"));
    if (!state.push_descriptor_set) {
      return Status(Code::invalid_argument,
                    "Adopt.push_descriptor is true but VK_KHR_push_descriptor is not enabled on the device");
    }
  }
  if (info.debug_utils) {
    const auto find = [&](const char* function) { return vkGetInstanceProcAddr(info.instance, function); };
    state.begin_label = reinterpret_cast<PFN_vkCmdBeginDebugUtilsLabelEXT>(find("vkCmdBeginDebugUtilsLabelEXT"));
    state.end_label = reinterpret_cast<PFN_vkCmdEndDebugUtilsLabelEXT>(find("vkCmdEndDebugUtilsLabelEXT"));
    state.set_object_name = reinterpret_cast<PFN_vkSetDebugUtilsObjectNameEXT>(find("vkSetDebugUtilsObjectNameEXT"));
    if (!state.begin_label || !state.end_label || !state.set_object_name) {
      return Status(Code::invalid_argument,
                    "Adopt.debug_utils is true but VK_EXT_debug_utils is not enabled on the instance");
    }
  }

  VkResult result = make_sampler(info.device, VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE, state.clamp_sampler);
  if (result == VK_SUCCESS) result = make_sampler(info.device, VK_SAMPLER_ADDRESS_MODE_REPEAT, state.wrap_sampler);
  if (result != VK_SUCCESS) return failure("Device::adopt: vkCreateSampler", result);
  return device;
}

const Profile& Device::profile() const { return state->profile; }
const std::string& Device::name() const { return state->name; }
const std::string& Device::driver() const { return state->driver; }

Device::State::~State() {
  if (adopt.device == VK_NULL_HANDLE) return;
  for (const auto& [key, entry] : kernels) destroy(adopt.device, entry->kernel);
  vkDestroySampler(adopt.device, clamp_sampler, nullptr);
  vkDestroySampler(adopt.device, wrap_sampler, nullptr);
}

}  // namespace luxel::vulkan

#include "host/vulkan/result.h"
#include "host/vulkan/state.h"

namespace luxel::vulkan {
namespace {

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
  state.physical = describe(info.physical);
  state.profile = luxel::profile(state.physical.profile);
  const std::uint32_t version = state.physical.properties.apiVersion;
  if (version < VK_API_VERSION_1_1) {
    const std::string has = "1." + std::to_string(VK_API_VERSION_MINOR(version));
    return Status(Code::unsupported, state.physical.name + " has Vulkan " + has +
                                         "; luxel needs 1.1: a newer driver or another device");
  }

  if (info.push_descriptor) {
    auto push = structure<VkPhysicalDevicePushDescriptorPropertiesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PUSH_DESCRIPTOR_PROPERTIES_KHR);
    auto properties = structure<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &push;
    vkGetPhysicalDeviceProperties2(info.physical, &properties);
    state.max_push_descriptors = push.maxPushDescriptors;
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
const std::string& Device::name() const { return state->physical.name; }
const std::string& Device::driver() const { return state->physical.driver; }

Device::State::~State() {
  if (adopt.device == VK_NULL_HANDLE) return;
  for (const auto& [key, entry] : kernels) destroy(adopt.device, entry->kernel);
  vkDestroySampler(adopt.device, clamp_sampler, nullptr);
  vkDestroySampler(adopt.device, wrap_sampler, nullptr);
}

}  // namespace luxel::vulkan

#include "host/vulkan/result.h"

namespace luxel::vulkan {

std::string name(VkResult result) {
#define LUXEL_CASE(value) case value: return #value
  switch (result) {
    LUXEL_CASE(VK_SUCCESS);
    LUXEL_CASE(VK_NOT_READY);
    LUXEL_CASE(VK_TIMEOUT);
    LUXEL_CASE(VK_INCOMPLETE);
    LUXEL_CASE(VK_ERROR_OUT_OF_HOST_MEMORY);
    LUXEL_CASE(VK_ERROR_OUT_OF_DEVICE_MEMORY);
    LUXEL_CASE(VK_ERROR_INITIALIZATION_FAILED);
    LUXEL_CASE(VK_ERROR_DEVICE_LOST);
    LUXEL_CASE(VK_ERROR_MEMORY_MAP_FAILED);
    LUXEL_CASE(VK_ERROR_LAYER_NOT_PRESENT);
    LUXEL_CASE(VK_ERROR_EXTENSION_NOT_PRESENT);
    LUXEL_CASE(VK_ERROR_FEATURE_NOT_PRESENT);
    LUXEL_CASE(VK_ERROR_INCOMPATIBLE_DRIVER);
    LUXEL_CASE(VK_ERROR_TOO_MANY_OBJECTS);
    LUXEL_CASE(VK_ERROR_FORMAT_NOT_SUPPORTED);
    LUXEL_CASE(VK_ERROR_FRAGMENTED_POOL);
    LUXEL_CASE(VK_ERROR_OUT_OF_POOL_MEMORY);
    LUXEL_CASE(VK_ERROR_INVALID_SHADER_NV);
    LUXEL_CASE(VK_ERROR_UNKNOWN);
    default: return "VkResult " + std::to_string(static_cast<int>(result));
  }
#undef LUXEL_CASE
}

Status failure(const std::string& what, VkResult result, Code otherwise) {
  Code code = otherwise;
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
    case VK_ERROR_MEMORY_MAP_FAILED:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_OUT_OF_POOL_MEMORY: code = Code::out_of_memory; break;
    case VK_ERROR_DEVICE_LOST: code = Code::device_lost; break;
    case VK_ERROR_INCOMPATIBLE_DRIVER:
    case VK_ERROR_LAYER_NOT_PRESENT: code = Code::missing_driver; break;
    case VK_ERROR_EXTENSION_NOT_PRESENT:
    case VK_ERROR_FEATURE_NOT_PRESENT:
    case VK_ERROR_FORMAT_NOT_SUPPORTED: code = Code::unsupported; break;
    default: break;
  }
  return {code, what + " failed with " + name(result)};
}

VkFormat vulkan_format(Format format) {
  switch (format) {
    case Format::f32x1: return VK_FORMAT_R32_SFLOAT;
    case Format::f32x2: return VK_FORMAT_R32G32_SFLOAT;
    case Format::f32x4: return VK_FORMAT_R32G32B32A32_SFLOAT;
    case Format::f16x2: return VK_FORMAT_R16G16_SFLOAT;
    case Format::f16x4: return VK_FORMAT_R16G16B16A16_SFLOAT;
    case Format::unorm8x4: return VK_FORMAT_R8G8B8A8_UNORM;
    case Format::u32: return VK_FORMAT_R32_UINT;
  }
  return VK_FORMAT_UNDEFINED;
}

VkFormat vulkan_format(std::string_view type) {
  if (type == "float") return VK_FORMAT_R32_SFLOAT;
  if (type == "vec4") return VK_FORMAT_R32G32B32A32_SFLOAT;
  if (type == "unorm8x4") return VK_FORMAT_R8G8B8A8_UINT;  // the kernel divides, with the same bits on every driver
  for (const Format format :
       {Format::f32x1, Format::f32x2, Format::f32x4, Format::f16x2, Format::f16x4, Format::unorm8x4}) {
    if (type == luxel::name(format)) return vulkan_format(format);
  }
  return VK_FORMAT_UNDEFINED;
}

}  // namespace luxel::vulkan

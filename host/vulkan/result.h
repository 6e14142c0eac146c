// Vulkan's structures, results and formats, as luxel makes and says them.
#pragma once
#include <string>

#include <luxel/vulkan.h>

namespace luxel::vulkan {

/// A Vulkan structure of a type, its other members zero.
template <class T>
T structure(VkStructureType type) {
  T value{};
  value.sType = type;
  return value;
}

/// The name of a VkResult as Vulkan spells it, "VK_ERROR_DEVICE_LOST"; a number for one that luxel never meets.
std::string name(VkResult result);

/// A failed call as a Status: out_of_memory, device_lost, missing_driver, unsupported, else `otherwise`.
Status failure(const std::string& what, VkResult result, Code otherwise = Code::internal);

/// The image or texel format that stores a pixel of `format`.
VkFormat vulkan_format(Format format);

/// The texel format of a binding's element type as the dialect spells it; VK_FORMAT_UNDEFINED for one that has none.
VkFormat vulkan_format(std::string_view type);

}  // namespace luxel::vulkan

#include "host/vulkan/limits.h"

#include <algorithm>
#include <array>

#include "host/module.h"
#include "host/vulkan/kernel.h"
#include "host/vulkan/result.h"
#include "host/vulkan/state.h"

namespace luxel::vulkan {
namespace {

/// Keeps the first limit that is too small.
class Checker {
 public:
  Checker(const Device::State& device, const Plan& plan) : device_(device), plan_(plan) {}

  void at_most(const std::string& limit, std::uint64_t value, std::uint64_t needed, const std::string& by) {
    if (needed <= value) return;
    fail(limit + " of " + device_.physical.name + " is " + std::to_string(value) + "; " + by + " needs " +
         std::to_string(needed));
  }

  void fail(const std::string& message) {
    if (status) status = Status(Code::unsupported, plan_.kernel + ": " + message);
  }

  Status status;

 private:
  const Device::State& device_;
  const Plan& plan_;
};

void check_pass(const VkPhysicalDeviceLimits& limits, const Pass& pass, Checker& check) {
  constexpr std::array<const char*, 3> axis{"[0]", "[1]", "[2]"};
  const std::string by = "pass " + pass.label;
  std::uint64_t invocations = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    check.at_most(std::string("maxComputeWorkGroupSize") + axis[i], limits.maxComputeWorkGroupSize[i],
                  pass.workgroup[i], by);
    check.at_most(std::string("maxComputeWorkGroupCount") + axis[i], limits.maxComputeWorkGroupCount[i],
                  pass.groups[i], by + " (a smaller image does)");
    invocations *= pass.workgroup[i];
  }
  check.at_most("maxComputeWorkGroupInvocations", limits.maxComputeWorkGroupInvocations, invocations, by);

  std::uint64_t shared = 0;
  for (const SharedInfo& info : pass.module->shared) shared += info.bytes;
  check.at_most("maxComputeSharedMemorySize", limits.maxComputeSharedMemorySize, shared, by);
  check.at_most("maxPushConstantsSize", limits.maxPushConstantsSize, 4 * pass.module->parameters.size(), by);
}

// LP_MAX_TGSI_LOOP_ITERATIONS of llvmpipe: after so many rounds every loop of an invocation ends.
constexpr double llvmpipe_rounds = 65535;

void check_rounds(const Device::State& device, const Pass& pass, Checker& check) {
  if (device.physical.profile == "lavapipe" && pass.rounds > llvmpipe_rounds)
    check.fail(device.physical.name + " ends all loops of an invocation after 65535 rounds; pass " + pass.label + " may need " +
               std::to_string(static_cast<std::uint64_t>(pass.rounds)));
}

void check_descriptors(const Device::State& device, const Pass& pass, Checker& check) {
  const VkPhysicalDeviceLimits& limits = device.physical.properties.limits;
  const std::string by = "pass " + pass.label;
  const auto count = [&](VkDescriptorType type) {
    const auto bindings = pass.module->bindings;
    return static_cast<std::uint64_t>(std::count_if(
        bindings.begin(), bindings.end(), [&](const BindingInfo& info) { return descriptor_type(info.kind) == type; }));
  };
  const std::uint64_t samplers = count(VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  const std::uint64_t images =
      samplers + count(VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE) + count(VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
  check.at_most("maxPerStageDescriptorStorageBuffers", limits.maxPerStageDescriptorStorageBuffers,
                count(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER), by);
  check.at_most("maxPerStageDescriptorUniformBuffers", limits.maxPerStageDescriptorUniformBuffers,
                count(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER), by);
  check.at_most("maxPerStageDescriptorSampledImages", limits.maxPerStageDescriptorSampledImages, images, by);
  check.at_most("maxPerStageDescriptorSamplers", limits.maxPerStageDescriptorSamplers, samplers, by);
  check.at_most("maxPerStageDescriptorStorageImages", limits.maxPerStageDescriptorStorageImages,
                count(VK_DESCRIPTOR_TYPE_STORAGE_IMAGE), by);
  check.at_most("maxPerStageResources", limits.maxPerStageResources, pass.module->bindings.size(), by);
  if (device.push_descriptor_set) {
    check.at_most("maxPushDescriptors", device.max_push_descriptors, pass.module->bindings.size(), by);
  }
}

void check_format(const Device::State& device, VkFormat format, bool buffer, VkFormatFeatureFlags needed,
                  const std::string& by, Checker& check) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(device.adopt.physical, format, &properties);
  const VkFormatFeatureFlags has = buffer ? properties.bufferFeatures : properties.optimalTilingFeatures;
  if ((has & needed) == needed) return;
  const bool linear = needed & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  check.fail(device.physical.name + " cannot use VkFormat " + std::to_string(static_cast<int>(format)) + " for " + by +
             (buffer ? " as a texel buffer" : linear ? " with a linear sampler" : " as such an image"));
}

void check_resource(const Device::State& device, const Resource& resource, Checker& check) {
  const VkPhysicalDeviceLimits& limits = device.physical.properties.limits;
  const std::string by = "binding " + resource.name;
  if (resource.kind == ResourceKind::buffer) return;
  const auto most = static_cast<std::uint64_t>(*std::max_element(resource.extent.begin(), resource.extent.end()));
  if (resource.extent[2] > 1) {
    check.at_most("maxImageDimension3D", limits.maxImageDimension3D, most, by);
  } else {
    check.at_most("maxImageDimension2D", limits.maxImageDimension2D, most, by);
  }
}

void check_slot(const Device::State& device, const Plan& plan, const Slot& slot, const BindingInfo& info,
                Checker& check) {
  const VkPhysicalDeviceLimits& limits = device.physical.properties.limits;
  if (slot.source == Slot::Source::table) return;
  const std::size_t index = static_cast<std::size_t>(slot.index);
  std::uint64_t bytes = 0;
  std::string by;
  if (slot.source == Slot::Source::scratch) {
    bytes = plan.scratch[index].count * bytes_per_pixel(plan.scratch[index].format);
    by = "a region of scratch";
  } else {
    bytes = plan.resources[index].bytes;
    by = "binding " + plan.resources[index].name;
  }
  constexpr VkFormatFeatureFlags linear =
      VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
  const auto image = [&](VkFormatFeatureFlags needed) {
    check_format(device, vulkan_format(plan.resources[index].format), false, needed, by, check);
  };
  switch (descriptor_type(info.kind)) {
    case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
      check.at_most("maxStorageBufferRange", limits.maxStorageBufferRange, bytes, by + " (a smaller image does)");
      break;
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
      check.at_most("maxUniformBufferRange", limits.maxUniformBufferRange, bytes, by);
      break;
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER: {
      const std::size_t texel = bytes_per_pixel(slot.source == Slot::Source::scratch ? plan.scratch[index].format
                                                                                     : plan.resources[index].format);
      check.at_most("maxTexelBufferElements", limits.maxTexelBufferElements, bytes / texel,
                    by + " (a smaller image does)");
      check_format(device, vulkan_format(info.type), true, VK_FORMAT_FEATURE_UNIFORM_TEXEL_BUFFER_BIT, by, check);
      break;
    }
    case VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE: image(VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT); break;
    case VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER: image(linear); break;
    case VK_DESCRIPTOR_TYPE_STORAGE_IMAGE: image(VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT); break;
    default: break;
  }
}

}  // namespace

Status check_limits(const Device::State& device, const Plan& plan) {
  Checker check(device, plan);
  for (const Resource& resource : plan.resources) check_resource(device, resource, check);
  for (const Pass& pass : plan.passes) {
    check_pass(device.physical.properties.limits, pass, check);
    check_rounds(device, pass, check);
    check_descriptors(device, pass, check);
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      check_slot(device, plan, pass.slots[i], pass.module->bindings[i], check);
    }
  }
  return check.status;
}

}  // namespace luxel::vulkan

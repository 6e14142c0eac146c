#include "host/vulkan/kernel.h"

#include <bit>
#include <cmath>
#include <limits>

#include "host/vulkan/cache.h"
#include "host/vulkan/result.h"
#include "host/vulkan/state.h"

namespace luxel::vulkan {
namespace {

Status compile(Device::State& device, const KernelKey& key, const std::string& label, Kernel& kernel) {
  const Module& module = *key.module;
  const VkDevice vk = device.adopt.device;
  const std::string on = " on " + device.physical.name + " (" + device.physical.driver + ")";

  std::vector<VkDescriptorSetLayoutBinding> bindings;
  std::size_t sampled = 0;
  for (const BindingInfo& info : module.bindings) {
    VkDescriptorSetLayoutBinding binding{};
    binding.binding = static_cast<std::uint32_t>(info.slot);
    binding.descriptorType = descriptor_type(info.kind);
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    if (binding.descriptorType == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER) {
      const bool wrap = key.addresses[sampled++] == Address::wrap;
      binding.pImmutableSamplers = wrap ? &device.wrap_sampler : &device.clamp_sampler;
    }
    bindings.push_back(binding);
  }
  auto set_info = structure<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  if (device.push_descriptor_set) set_info.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set_info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  set_info.pBindings = bindings.data();
  if (const VkResult result = vkCreateDescriptorSetLayout(vk, &set_info, nullptr, &kernel.set_layout)) {
    return failure(label + ": vkCreateDescriptorSetLayout", result);
  }

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                 static_cast<std::uint32_t>(4 * module.parameters.size())};
  auto layout_info = structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout_info.setLayoutCount = 1;
  layout_info.pSetLayouts = &kernel.set_layout;
  layout_info.pushConstantRangeCount = push.size ? 1 : 0;
  layout_info.pPushConstantRanges = &push;
  if (const VkResult result = vkCreatePipelineLayout(vk, &layout_info, nullptr, &kernel.layout)) {
    return failure(label + ": vkCreatePipelineLayout", result);
  }

  auto shader_info = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  shader_info.codeSize = module.spirv.size_bytes();
  shader_info.pCode = module.spirv.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  if (const VkResult result = vkCreateShaderModule(vk, &shader_info, nullptr, &shader)) {
    return failure(label + ": vkCreateShaderModule" + on, result, Code::compile_failed);
  }

  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < key.constants.size(); ++i) {
    const std::size_t own = module.constants.size();
    const int id = i < own ? module.constants[i].id : workgroup_constant_id + static_cast<int>(i - own);
    entries.push_back({static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(4 * i), 4});
  }
  const VkSpecializationInfo specialization{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                            4 * key.constants.size(), key.constants.data()};
  auto info = structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = kernel.layout;
  DiskCache cache(device, module.hash);
  const VkResult result = vkCreateComputePipelines(vk, cache.handle(), 1, &info, nullptr, &kernel.pipeline);
  vkDestroyShaderModule(vk, shader, nullptr);
  if (result != VK_SUCCESS) {
    kernel.pipeline = VK_NULL_HANDLE;
    const Status refused = failure(label + ": vkCreateComputePipelines for " + std::string(module.part) + " " +
                                       std::string(module.name) + on,
                                   result, Code::compile_failed);
    if (refused.code() != Code::compile_failed) return refused;
    return Status(Code::compile_failed, refused.message() + "; a newer driver or another device may do");
  }
  cache.save();

  if (device.set_object_name) {
    auto named = structure<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    named.objectType = VK_OBJECT_TYPE_PIPELINE;
    named.objectHandle = reinterpret_cast<std::uint64_t>(kernel.pipeline);
    const std::string text = "luxel " + std::string(module.part) + " " + std::string(module.name);
    named.pObjectName = text.c_str();
    device.set_object_name(vk, &named);
  }
  return {};
}

}  // namespace

Result<const Kernel*> get_kernel(Device::State& device, const KernelKey& key, const std::string& label) {
  KernelEntry* entry = nullptr;
  {
    const std::lock_guard lock(device.mutex);
    std::unique_ptr<KernelEntry>& place = device.kernels[key];
    if (!place) place = std::make_unique<KernelEntry>();
    entry = place.get();
  }
  const std::lock_guard lock(entry->mutex);
  if (entry->kernel.pipeline == VK_NULL_HANDLE) {
    Kernel kernel;
    if (Status status = compile(device, key, label, kernel); !status) {
      destroy(device.adopt.device, kernel);
      return status;
    }
    entry->kernel = kernel;
  }
  return &entry->kernel;
}

void destroy(VkDevice device, const Kernel& kernel) {
  vkDestroyPipeline(device, kernel.pipeline, nullptr);
  vkDestroyPipelineLayout(device, kernel.layout, nullptr);
  vkDestroyDescriptorSetLayout(device, kernel.set_layout, nullptr);
}

VkDescriptorType descriptor_type(BindingKind kind) {
  switch (kind) {
    case BindingKind::read:
    case BindingKind::write:
    case BindingKind::update: return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    case BindingKind::texels: return VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
    case BindingKind::uniform: return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    case BindingKind::image2d:
    case BindingKind::image3d: return VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    case BindingKind::sampled2d:
    case BindingKind::sampled3d: return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    case BindingKind::image_write2d:
    case BindingKind::image_read2d: return VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  }
  return VK_DESCRIPTOR_TYPE_MAX_ENUM;
}

bool pack(Scalar type, double value, std::uint32_t& bits) {
  const auto whole = [&](double low, double high) {
    return value >= low && value <= high && value == std::trunc(value);
  };
  switch (type) {
    case Scalar::int32:
      if (!whole(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max())) return false;
      bits = std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value));
      return true;
    case Scalar::uint32:
      if (!whole(0, std::numeric_limits<std::uint32_t>::max())) return false;
      bits = static_cast<std::uint32_t>(value);
      return true;
    case Scalar::float32: bits = std::bit_cast<std::uint32_t>(static_cast<float>(value)); return true;
  }
  return false;
}

}  // namespace luxel::vulkan

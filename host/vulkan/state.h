// What stands behind luxel::vulkan::Device and luxel::vulkan::Pipeline.
#pragma once
#include <map>
#include <mutex>
#include <tuple>

#include <luxel/vulkan.h>

#include "host/vulkan/kernel.h"
#include "host/vulkan/physical.h"

namespace luxel::vulkan {

struct Device::State {
  Adopt adopt;
  Physical physical;
  Profile profile;
  std::uint32_t max_push_descriptors = 0;
  VkSampler clamp_sampler = VK_NULL_HANDLE;
  VkSampler wrap_sampler = VK_NULL_HANDLE;
  PFN_vkCmdPushDescriptorSetKHR push_descriptor_set = nullptr;
  PFN_vkCmdBeginDebugUtilsLabelEXT begin_label = nullptr;  // null without debug utils, as the two below
  PFN_vkCmdEndDebugUtilsLabelEXT end_label = nullptr;
  PFN_vkSetDebugUtilsObjectNameEXT set_object_name = nullptr;

  std::mutex mutex;  // of `kernels`
  std::map<KernelKey, std::unique_ptr<KernelEntry>> kernels;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();
};

/// A descriptor of a pass, decided when the pipeline is created but for the caller's handles.
struct Descriptor {
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  std::uint32_t slot = 0;       // binding number
  std::size_t need = 0;         // index into Pipeline::State::needs
  VkDeviceSize offset = 0;      // added to the caller's
  VkDeviceSize range = 0;       // buffers
  VkFormat texels = VK_FORMAT_UNDEFINED;
};

struct Step {
  const Kernel* kernel = nullptr;
  std::vector<Descriptor> descriptors;
  std::vector<std::uint32_t> push;  // parameters, as the push constants hold them
  bool counted = false;             // its number of workgroups is found in needs[counts_need]
  std::size_t counts_need = 0;
  VkDeviceSize counts_offset = 0;   // added to the caller's
};

/// What a caller must bind: the resources of the plan in order, then `scratch`.
struct Need {
  std::string name;
  ResourceKind kind = ResourceKind::buffer;
  VkDeviceSize bytes = 0;      // 0: not needed
  VkDeviceSize alignment = 1;  // of the offset
};

struct Pipeline::State {
  std::shared_ptr<Device::State> device;
  Plan plan;
  std::vector<Step> steps;  // one a pass
  std::vector<Need> needs;
  std::vector<std::pair<int, int>> exclusive;  // indices into needs that may not share memory
  std::vector<std::vector<float>> tables;
  std::vector<VkDescriptorPoolSize> pool_sizes;
  bool reads_texels = false;
};

}  // namespace luxel::vulkan

// A module compiled with one choice of constants and workgroup; a device keeps each it has compiled.
#pragma once
#include <compare>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include <luxel/vulkan.h>

#include "host/module.h"

namespace luxel::vulkan {

struct Kernel {
  VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// What tells two kernels of a device apart.
struct KernelKey {
  const Module* module = nullptr;
  std::vector<std::uint32_t> constants;  // bits, in module order, then the workgroup
  std::vector<Address> addresses;        // of the sampled bindings, in module order

  auto operator<=>(const KernelKey&) const = default;
};

/// A kernel's place in the device; `mutex` is held while it is compiled, so that others compile beside it.
struct KernelEntry {
  std::mutex mutex;
  Kernel kernel;  // compiled once `pipeline` is set
};

/// The kernel of a key, compiled now if it was not yet. It lives as long as the device's state. `label` names it to
/// debuggers and in messages. Errors: compile_failed, out_of_memory, device_lost.
Result<const Kernel*> get_kernel(Device::State& device, const KernelKey& key, const std::string& label);

/// Destroys what a kernel holds; null handles are left alone.
void destroy(VkDevice device, const Kernel& kernel);

/// The descriptor a binding takes.
VkDescriptorType descriptor_type(BindingKind kind);

/// A parameter or constant as its four bytes on the device. False where the value does not fit the type.
bool pack(Scalar type, double value, std::uint32_t& bits);

}  // namespace luxel::vulkan

#include <algorithm>

#include "host/bindings.h"

#include "host/vulkan/kernel.h"
#include "host/vulkan/limits.h"
#include "host/vulkan/result.h"
#include "host/vulkan/state.h"

namespace luxel::vulkan {
namespace {

/// What Vulkan takes for granted beyond what every execution does.
Status check_details(const Plan& plan) {
  const auto defect = [&](const std::string& message) { return Status(Code::internal, plan.kernel + ": " + message); };
  for (const Resource& resource : plan.resources) {
    if (resource.kind == ResourceKind::buffer && resource.bytes == 0) return defect(resource.name + " has 0 bytes");
    for (const int size : resource.extent) {
      if (size < 1) return defect(resource.name + " has an extent of " + std::to_string(size));
    }
  }
  for (const ScratchRegion& region : plan.scratch) {
    if (region.offset % 256 != 0) return defect("a scratch region begins at " + std::to_string(region.offset));
  }
  for (const Pass& pass : plan.passes) {
    for (const BindingInfo& info : pass.module->bindings) {
      if (info.kind == BindingKind::texels && vulkan_format(info.type) == VK_FORMAT_UNDEFINED) {
        return defect("no texel buffer holds the " + std::string(info.type) + " of " + std::string(info.name));
      }
    }
  }
  return {};
}

Descriptor make_descriptor(const Plan& plan, const BindingInfo& info, const Slot& slot) {
  Descriptor descriptor;
  descriptor.type = descriptor_type(info.kind);
  descriptor.slot = static_cast<std::uint32_t>(info.slot);
  const std::size_t index = static_cast<std::size_t>(slot.index);
  switch (slot.source) {
    case Slot::Source::resource:
      descriptor.need = index;
      descriptor.range = plan.resources[index].bytes;
      break;
    case Slot::Source::scratch:
      descriptor.need = plan.resources.size();
      descriptor.offset = plan.scratch[index].offset;
      descriptor.range = plan.scratch[index].count * bytes_per_pixel(plan.scratch[index].format);
      break;
    case Slot::Source::table:
      descriptor.need = plan.resources.size();
      descriptor.offset = index * table_bytes;
      descriptor.range = table_bytes;
      break;
  }
  if (info.kind == BindingKind::texels) descriptor.texels = vulkan_format(info.type);
  return descriptor;
}

Result<Step> make_step(Device::State& device, const Plan& plan, const Pass& pass) {
  Step step;
  KernelKey key;
  key.module = pass.module;
  const std::string label = plan.kernel + ": pass " + pass.label;
  const auto defect = [&](std::string_view field, double value) {
    return Status(Code::internal, label + ": " + std::string(field) + " is " + std::to_string(value) +
                                      ", which its type does not hold");
  };
  for (std::size_t i = 0; i < pass.constants.size(); ++i) {
    const ConstantInfo& info = pass.module->constants[i];
    if (!pack(info.type, pass.constants[i], key.constants.emplace_back())) return defect(info.name, pass.constants[i]);
  }
  key.constants.insert(key.constants.end(), pass.workgroup.begin(), pass.workgroup.end());
  for (std::size_t i = 0; i < pass.parameters.size(); ++i) {
    const ParameterInfo& info = pass.module->parameters[i];
    if (!pack(info.type, pass.parameters[i], step.push.emplace_back())) return defect(info.name, pass.parameters[i]);
  }
  for (std::size_t i = 0; i < pass.slots.size(); ++i) {
    const BindingInfo& info = pass.module->bindings[i];
    step.descriptors.push_back(make_descriptor(plan, info, pass.slots[i]));
    if (is_sampled(info.kind)) {
      key.addresses.push_back(plan.resources[static_cast<std::size_t>(pass.slots[i].index)].address);
    }
  }
  if (pass.counts) {
    const Slot& slot = pass.counts->slot;
    const auto index = static_cast<std::size_t>(slot.index);
    const bool scratch = slot.source == Slot::Source::scratch;
    step.counted = true;
    step.counts_need = scratch ? plan.resources.size() : index;
    step.counts_offset = 4 * pass.counts->first + (scratch ? plan.scratch[index].offset : 0);
  }
  Result<const Kernel*> kernel = get_kernel(device, key, label);
  if (!kernel) return kernel.status();
  step.kernel = kernel.value();
  return step;
}

/// Resources in order, then scratch; alignments from how the passes use them.
std::vector<Need> make_needs(const Plan& plan, const std::vector<Step>& steps, const VkPhysicalDeviceLimits& limits) {
  std::vector<Need> needs;
  for (const Resource& resource : plan.resources) needs.push_back({resource.name, resource.kind, resource.bytes, 1});
  needs.push_back({"scratch", ResourceKind::buffer, plan.scratch_bytes, 4});
  for (const Step& step : steps) {
    if (step.counted) needs[step.counts_need].alignment = std::max<VkDeviceSize>(needs[step.counts_need].alignment, 4);
    for (const Descriptor& descriptor : step.descriptors) {
      VkDeviceSize& alignment = needs[descriptor.need].alignment;
      switch (descriptor.type) {
        case VK_DESCRIPTOR_TYPE_STORAGE_BUFFER:
          alignment = std::max(alignment, limits.minStorageBufferOffsetAlignment);
          break;
        case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
          alignment = std::max(alignment, limits.minUniformBufferOffsetAlignment);
          break;
        case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
          alignment = std::max(alignment, limits.minTexelBufferOffsetAlignment);
          break;
        default: break;
      }
    }
  }
  return needs;
}

}  // namespace

Result<Pipeline> Pipeline::create(const Device& device, Plan plan) {
  if (!device.state) return Status(Code::invalid_argument, "device is empty; expected one that Device::adopt returned");
  if (Status status = check(plan); !status) return status;
  if (Status status = check_details(plan); !status) return status;
  if (Status status = check_limits(*device.state, plan); !status) return status;

  Pipeline pipeline;
  pipeline.state = std::make_shared<State>();
  State& state = *pipeline.state;
  state.device = device.state;
  for (const Pass& pass : plan.passes) {
    Result<Step> step = make_step(*device.state, plan, pass);
    if (!step) return step.status();
    state.steps.push_back(std::move(step).value());
  }
  state.needs = make_needs(plan, state.steps, device.state->physical.properties.limits);
  state.exclusive = exclusive(plan);
  for (const std::vector<double>& table : plan.tables) state.tables.emplace_back(table.begin(), table.end());
  for (const Step& step : state.steps) {
    for (const Descriptor& descriptor : step.descriptors) {
      state.reads_texels |= descriptor.type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
      if (device.state->push_descriptor_set) continue;
      const auto known = std::find_if(state.pool_sizes.begin(), state.pool_sizes.end(),
                                      [&](const VkDescriptorPoolSize& size) { return size.type == descriptor.type; });
      if (known != state.pool_sizes.end()) {
        ++known->descriptorCount;
      } else {
        state.pool_sizes.push_back({descriptor.type, 1});
      }
    }
  }
  state.plan = std::move(plan);
  return pipeline;
}

const Plan& Pipeline::plan() const { return state->plan; }
const std::vector<VkDescriptorPoolSize>& Pipeline::pool_sizes() const { return state->pool_sizes; }
bool Pipeline::reads_texels() const { return state->reads_texels; }

std::vector<std::string> Pipeline::counts() const {
  std::vector<std::string> names;
  for (const Step& step : state->steps) {
    if (!step.counted) continue;
    const std::string& name = state->needs[step.counts_need].name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

}  // namespace luxel::vulkan

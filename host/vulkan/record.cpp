#include "host/bindings.h"

#include "host/vulkan/result.h"
#include "host/vulkan/state.h"

namespace luxel::vulkan {
namespace {

using Resolved = std::vector<const Binding*>;  // one a need

bool readable(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_GENERAL:
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_STENCIL_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL:
    case VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL: return true;
    default: return false;
  }
}

Status check_binding(const Plan& plan, const Need& need, const Binding& binding) {
  const auto refuse = [&](const std::string& what) { return bad_binding(plan, need.name, what); };
  if (need.kind == ResourceKind::buffer) {
    if (binding.view != VK_NULL_HANDLE) return refuse("has an image view; expected a buffer");
    if (binding.buffer == VK_NULL_HANDLE) return refuse("has a null buffer; expected a VkBuffer");
    if (binding.offset % need.alignment != 0) {
      return refuse("has offset " + std::to_string(binding.offset) + "; expected a multiple of " +
                    std::to_string(need.alignment));
    }
    if (binding.bytes < need.bytes) {
      return refuse("has " + std::to_string(binding.bytes) + " bytes; needs at least " + std::to_string(need.bytes));
    }
    return {};
  }
  if (binding.buffer != VK_NULL_HANDLE) return refuse("has a buffer; expected an image view");
  if (binding.view == VK_NULL_HANDLE) return refuse("has a null view; expected a VkImageView");
  if (need.kind == ResourceKind::storage_image) {
    if (binding.layout != VK_IMAGE_LAYOUT_GENERAL) {
      return refuse("has layout " + std::to_string(binding.layout) + "; expected VK_IMAGE_LAYOUT_GENERAL");
    }
  } else if (!readable(binding.layout)) {
    return refuse("has layout " + std::to_string(binding.layout) +
                  "; expected VK_IMAGE_LAYOUT_GENERAL, SHADER_READ_ONLY_OPTIMAL or another read-only layout");
  }
  return {};
}

bool overlap(const Binding& a, VkDeviceSize a_bytes, const Binding& b, VkDeviceSize b_bytes) {
  if (a.buffer == VK_NULL_HANDLE || b.buffer == VK_NULL_HANDLE) return a.view != VK_NULL_HANDLE && a.view == b.view;
  return a.buffer == b.buffer && a.offset < b.offset + b_bytes && b.offset < a.offset + a_bytes;
}

Status resolve(const Pipeline::State& state, const std::vector<Binding>& bindings, Resolved& resolved) {
  const Plan& plan = state.plan;
  std::vector<std::string_view> names;
  for (const Binding& binding : bindings) names.push_back(binding.name);
  const Result<std::vector<int>> matched = match(plan, names);
  if (!matched) return matched.status();
  resolved.assign(state.needs.size(), nullptr);
  for (std::size_t i = 0; i < state.needs.size(); ++i) {
    const int index = matched.value()[i];
    if (index < 0 || (state.needs[i].kind == ResourceKind::buffer && state.needs[i].bytes == 0)) continue;
    resolved[i] = &bindings[static_cast<std::size_t>(index)];
    if (Status status = check_binding(plan, state.needs[i], *resolved[i]); !status) return status;
  }
  for (const auto& [first, second] : state.exclusive) {
    const std::size_t a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    if (resolved[a] && resolved[b] && overlap(*resolved[a], state.needs[a].bytes, *resolved[b], state.needs[b].bytes)) {
      return overlapping(plan, {first, second});
    }
  }
  return {};
}

/// What a record makes before it records; handed over or destroyed as a whole.
struct Prepared {
  VkDevice device = VK_NULL_HANDLE;
  std::vector<VkBufferView> views;    // one a texel descriptor, in order of steps and descriptors
  std::vector<VkDescriptorSet> sets;  // one a step, without push descriptors

  ~Prepared() {
    for (VkBufferView view : views) vkDestroyBufferView(device, view, nullptr);
  }
};

Status make_views(const Pipeline::State& state, const Resolved& resolved, Prepared& prepared) {
  for (const Step& step : state.steps) {
    for (const Descriptor& descriptor : step.descriptors) {
      if (descriptor.texels == VK_FORMAT_UNDEFINED) continue;
      const Binding& binding = *resolved[descriptor.need];
      auto info = structure<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
      info.buffer = binding.buffer;
      info.format = descriptor.texels;
      info.offset = binding.offset + descriptor.offset;
      info.range = descriptor.range;
      VkBufferView view = VK_NULL_HANDLE;
      if (const VkResult result = vkCreateBufferView(prepared.device, &info, nullptr, &view)) {
        return failure(state.plan.kernel + ": vkCreateBufferView", result);
      }
      prepared.views.push_back(view);
    }
  }
  return {};
}

Status allocate_sets(const Pipeline::State& state, VkDescriptorPool pool, Prepared& prepared) {
  if (state.steps.empty()) return {};
  std::vector<VkDescriptorSetLayout> layouts;
  for (const Step& step : state.steps) layouts.push_back(step.kernel->set_layout);
  auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  info.descriptorPool = pool;
  info.descriptorSetCount = static_cast<std::uint32_t>(layouts.size());
  info.pSetLayouts = layouts.data();
  prepared.sets.resize(layouts.size());
  if (const VkResult result = vkAllocateDescriptorSets(prepared.device, &info, prepared.sets.data())) {
    return failure(state.plan.kernel + ": vkAllocateDescriptorSets from Record.pool (see Pipeline::pool_sizes)",
                   result);
  }
  return {};
}

/// The writes of one step's descriptors; they point into this object.
class Writes {
 public:
  Writes(const Step& step, const Resolved& resolved, const VkBufferView*& view, VkDescriptorSet set) {
    const std::size_t count = step.descriptors.size();
    buffers_.reserve(count);
    images_.reserve(count);
    for (const Descriptor& descriptor : step.descriptors) {
      const Binding& binding = *resolved[descriptor.need];
      VkWriteDescriptorSet& write = writes_.emplace_back();
      write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
      write.dstSet = set;
      write.dstBinding = descriptor.slot;
      write.descriptorCount = 1;
      write.descriptorType = descriptor.type;
      if (descriptor.texels != VK_FORMAT_UNDEFINED) {
        write.pTexelBufferView = view++;
      } else if (binding.buffer != VK_NULL_HANDLE) {
        buffers_.push_back({binding.buffer, binding.offset + descriptor.offset, descriptor.range});
        write.pBufferInfo = &buffers_.back();
      } else {
        images_.push_back({VK_NULL_HANDLE, binding.view, binding.layout});
        write.pImageInfo = &images_.back();
      }
    }
  }
  Writes(const Writes&) = delete;
  Writes& operator=(const Writes&) = delete;

  std::uint32_t size() const { return static_cast<std::uint32_t>(writes_.size()); }
  const VkWriteDescriptorSet* data() const { return writes_.data(); }

 private:
  std::vector<VkDescriptorBufferInfo> buffers_;
  std::vector<VkDescriptorImageInfo> images_;
  std::vector<VkWriteDescriptorSet> writes_;
};

void barrier(VkCommandBuffer commands, VkPipelineStageFlags stage, VkAccessFlags written, VkAccessFlags used,
             VkPipelineStageFlags by = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT) {
  auto memory = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
  memory.srcAccessMask = written;
  memory.dstAccessMask = used;
  vkCmdPipelineBarrier(commands, stage, by, 0, 1, &memory, 0, nullptr, 0, nullptr);
}

void upload_tables(VkCommandBuffer commands, const Pipeline::State& state, const Binding& scratch) {
  for (std::size_t i = 0; i < state.tables.size(); ++i) {
    const std::vector<float>& table = state.tables[i];
    if (table.empty()) continue;
    vkCmdUpdateBuffer(commands, scratch.buffer, scratch.offset + i * table_bytes, 4 * table.size(), table.data());
  }
  barrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_UNIFORM_READ_BIT);
}

void record_step(VkCommandBuffer commands, const Device::State& device, const Pass& pass, const Step& step,
                 const Writes& writes, VkDescriptorSet set, const Binding* counts) {
  constexpr VkPipelineBindPoint compute = VK_PIPELINE_BIND_POINT_COMPUTE;
  const Kernel& kernel = *step.kernel;
  if (device.begin_label) {
    auto label = structure<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = pass.label.c_str();
    device.begin_label(commands, &label);
  }
  vkCmdBindPipeline(commands, compute, kernel.pipeline);
  if (!device.push_descriptor_set) {
    vkCmdBindDescriptorSets(commands, compute, kernel.layout, 0, 1, &set, 0, nullptr);
  } else if (writes.size() > 0) {
    device.push_descriptor_set(commands, compute, kernel.layout, 0, writes.size(), writes.data());
  }
  if (!step.push.empty()) {
    vkCmdPushConstants(commands, kernel.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       static_cast<std::uint32_t>(4 * step.push.size()), step.push.data());
  }
  if (counts) {
    vkCmdDispatchIndirect(commands, counts->buffer, counts->offset + step.counts_offset);
  } else {
    vkCmdDispatch(commands, pass.groups[0], pass.groups[1], pass.groups[2]);
  }
  if (device.end_label) device.end_label(commands);
}

}  // namespace

Status Pipeline::record(VkCommandBuffer commands, const std::vector<Binding>& bindings, const Record& options) const {
  const State& state = *this->state;
  const Device::State& device = *state.device;
  const auto refuse = [&](const std::string& message) {
    return Status(Code::invalid_argument, state.plan.kernel + ": " + message);
  };
  if (commands == VK_NULL_HANDLE) return refuse("commands is null; expected a VkCommandBuffer that is being recorded");
  if (!device.push_descriptor_set && options.pool == VK_NULL_HANDLE && !state.steps.empty()) {
    return refuse("Record.pool is null; expected a VkDescriptorPool, as push descriptors are not in use");
  }
  if (state.reads_texels && !options.texel_views) {
    return refuse("Record.texel_views is null; expected a vector, as a pass reads through a texel buffer");
  }
  Resolved resolved;
  if (Status status = resolve(state, bindings, resolved); !status) return status;

  Prepared prepared;
  prepared.device = device.adopt.device;
  if (Status status = make_views(state, resolved, prepared); !status) return status;
  if (!device.push_descriptor_set) {
    if (Status status = allocate_sets(state, options.pool, prepared); !status) return status;
  }

  if (!state.tables.empty() && !options.tables_current) upload_tables(commands, state, *resolved.back());
  const auto stamp = [&](std::size_t index) {
    if (options.timestamps == VK_NULL_HANDLE) return;
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, options.timestamps,
                        options.first_query + static_cast<std::uint32_t>(index));
  };
  stamp(0);
  const VkBufferView* view = prepared.views.data();
  for (std::size_t i = 0; i < state.steps.size(); ++i) {
    const bool counted = state.steps[i].counted && options.indirect;
    if (i > 0) {
      // A later write of the counts waits for their reading too: DRAW_INDIRECT comes before COMPUTE_SHADER.
      barrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_WRITE_BIT,
              VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | (counted ? VK_ACCESS_INDIRECT_COMMAND_READ_BIT : 0),
              VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | (counted ? VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT : 0));
    }
    const VkDescriptorSet set = prepared.sets.empty() ? VK_NULL_HANDLE : prepared.sets[i];
    const Writes writes(state.steps[i], resolved, view, set);
    if (set != VK_NULL_HANDLE) vkUpdateDescriptorSets(device.adopt.device, writes.size(), writes.data(), 0, nullptr);
    record_step(commands, device, state.plan.passes[i], state.steps[i], writes, set,
                counted ? resolved[state.steps[i].counts_need] : nullptr);
    stamp(i + 1);
  }
  if (options.texel_views) {
    options.texel_views->insert(options.texel_views->end(), prepared.views.begin(), prepared.views.end());
    prepared.views.clear();
  }
  return {};
}

}  // namespace luxel::vulkan

#include <algorithm>

#include "host/bindings.h"
#include "host/opencl/device.h"

namespace luxel::opencl {
namespace {

std::string extent_text(const std::array<int, 3>& extent, int dimensions) {
  std::string text = std::to_string(extent[0]) + "x" + std::to_string(extent[1]);
  return dimensions == 3 ? text + "x" + std::to_string(extent[2]) : text;
}

template <std::size_t n>
bool exceeds(const std::array<int, 3>& extent, const std::array<std::size_t, n>& limit) {
  for (std::size_t i = 0; i < n; ++i) {
    if (static_cast<std::size_t>(extent[i]) > limit[i]) return true;
  }
  return false;
}

Result<bool> format_supported(const Device::State& device, Format needed, bool volume, cl_mem_flags flags) {
  const cl_mem_object_type type = volume ? CL_MEM_OBJECT_IMAGE3D : CL_MEM_OBJECT_IMAGE2D;
  cl_uint count = 0;
  cl_int error = clGetSupportedImageFormats(device.context.get(), flags, type, 0, nullptr, &count);
  std::vector<cl_image_format> formats(count);
  if (error == CL_SUCCESS)
    error = clGetSupportedImageFormats(device.context.get(), flags, type, count, formats.data(), nullptr);
  if (error != CL_SUCCESS) return failure(error, device.name + " does not say which images it has");
  const cl_image_format wanted = image_format(needed);
  return std::any_of(formats.begin(), formats.end(), [&](const cl_image_format& format) {
    return format.image_channel_order == wanted.image_channel_order &&
           format.image_channel_data_type == wanted.image_channel_data_type;
  });
}

/// Whether some pass binds resource `index` as a volume.
bool bound_as_3d(const Plan& plan, int index) {
  for (const Pass& pass : plan.passes) {
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      if (pass.slots[i].source == Slot::Source::resource && pass.slots[i].index == index &&
          is_3d(pass.module->bindings[i].kind))
        return true;
    }
  }
  return false;
}

}  // namespace

Status check_limits(const Device::State& device, const Plan& plan) {
  const Limits& limits = device.limits;
  const auto small = [&](const std::string& who, const char* limit, const std::string& value, const std::string& need) {
    return Status(Code::unsupported,
                  plan.kernel + ": " + limit + " of " + device.name + " is " + value + "; " + who + " needs " + need);
  };
  const auto bytes = [](auto count) { return std::to_string(count) + " bytes"; };

  const std::vector<Use> use = uses(plan);
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const Resource& resource = plan.resources[i];
    if (resource.kind == ResourceKind::buffer) {
      if (resource.bytes > limits.allocation)
        return small(resource.name, "CL_DEVICE_MAX_MEM_ALLOC_SIZE", bytes(limits.allocation), bytes(resource.bytes));
      continue;
    }
    if (!limits.images) return small(resource.name, "CL_DEVICE_IMAGE_SUPPORT", "false", "images");
    const bool volume = bound_as_3d(plan, static_cast<int>(i));
    if (volume && exceeds(resource.extent, limits.image3d)) {
      const std::array<int, 3> most{static_cast<int>(limits.image3d[0]), static_cast<int>(limits.image3d[1]),
                                    static_cast<int>(limits.image3d[2])};
      return small(resource.name, "CL_DEVICE_IMAGE3D_MAX_WIDTH, _HEIGHT and _DEPTH", extent_text(most, 3),
                   extent_text(resource.extent, 3) + " texels");
    }
    if (!volume && exceeds(resource.extent, limits.image2d)) {
      const std::array<int, 3> most{static_cast<int>(limits.image2d[0]), static_cast<int>(limits.image2d[1]), 1};
      return small(resource.name, "CL_DEVICE_IMAGE2D_MAX_WIDTH and _HEIGHT", extent_text(most, 2),
                   extent_text(resource.extent, 2) + " texels");
    }
    for (const auto& [needed, flags] : {std::pair{use[i].read, CL_MEM_READ_ONLY}, {use[i].first_write >= 0, CL_MEM_WRITE_ONLY}}) {
      const Result<bool> supported = needed ? format_supported(device, resource.format, volume, flags) : Result<bool>(true);
      if (!supported) return supported.status();
      if (!supported.value())
        return Status(Code::unsupported, plan.kernel + ": " + device.name + " has no " + (volume ? "3-D" : "2-D") +
                                             " images of " + name(resource.format) + ", which " + resource.name +
                                             " needs; bind a buffer or take another format");
    }
  }

  if (plan.scratch_bytes > limits.allocation)
    return small("scratch", "CL_DEVICE_MAX_MEM_ALLOC_SIZE", bytes(limits.allocation), bytes(plan.scratch_bytes));
  std::size_t offsets = plan.tables.size() > 1 ? table_bytes : 0;
  for (const ScratchRegion& region : plan.scratch) offsets |= region.offset;
  if (offsets % limits.alignment != 0)
    return small("scratch", "CL_DEVICE_MEM_BASE_ADDR_ALIGN", bytes(limits.alignment),
                 "at most " + bytes(offsets & (~offsets + 1)));

  for (const Pass& pass : plan.passes) {
    std::size_t invocations = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (pass.workgroup[axis] > limits.workgroup_axis[axis])
        return small("pass " + pass.label, "CL_DEVICE_MAX_WORK_ITEM_SIZES", std::to_string(limits.workgroup_axis[axis]),
                     std::to_string(pass.workgroup[axis]) + " invocations on axis " + std::to_string(axis));
      invocations *= pass.workgroup[axis];
    }
    if (invocations > limits.workgroup)
      return small("pass " + pass.label, "CL_DEVICE_MAX_WORK_GROUP_SIZE", std::to_string(limits.workgroup),
                   std::to_string(invocations) + " invocations");
    std::size_t shared = 0;
    for (const SharedInfo& memory : pass.module->shared) shared += memory.bytes;
    if (shared > limits.local_memory)
      return small("pass " + pass.label, "CL_DEVICE_LOCAL_MEM_SIZE", bytes(limits.local_memory), bytes(shared));
    cl_uint tables = 0;
    for (const Slot& slot : pass.slots) {
      if (slot.source != Slot::Source::table) continue;
      ++tables;
      const std::size_t need = plan.tables[static_cast<std::size_t>(slot.index)].size() * sizeof(float);
      if (need > limits.constant_buffer)
        return small("pass " + pass.label, "CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE", bytes(limits.constant_buffer),
                     bytes(need));
    }
    if (tables > limits.constant_arguments)
      return small("pass " + pass.label, "CL_DEVICE_MAX_CONSTANT_ARGS", std::to_string(limits.constant_arguments),
                   std::to_string(tables));
  }
  return {};
}

}  // namespace luxel::opencl

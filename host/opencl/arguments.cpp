#include <algorithm>

#include "host/opencl/pipeline.h"

namespace luxel::opencl {
namespace {

/// Properties of a memory object; `error` holds the first query that failed.
struct Properties {
  cl_mem memory;
  cl_int error = CL_SUCCESS;

  template <class T>
  T value(cl_uint what, decltype(&clGetMemObjectInfo) query = clGetMemObjectInfo) {
    T result{};
    const cl_int got = query(memory, what, sizeof result, &result, nullptr);
    if (error == CL_SUCCESS) error = got;
    return result;
  }
  template <class T>
  T image(cl_uint what) { return value<T>(what, clGetImageInfo); }
};

std::string bytes_text(std::size_t bytes) { return std::to_string(bytes) + " bytes"; }

template <class T>
std::string extent_text(const std::array<T, 3>& extent) {
  return std::to_string(extent[0]) + "x" + std::to_string(extent[1]) + "x" + std::to_string(extent[2]);
}

struct Checker {
  const Shared& shared;
  const Binding& binding;

  Properties properties{binding.memory};

  /// A defect of the binding, or why it could not be looked at.
  Status bad(const std::string& what) const {
    if (properties.error == CL_SUCCESS) return bad_binding(shared.plan, binding.name, what);
    if (properties.error == CL_INVALID_MEM_OBJECT) return bad_binding(shared.plan, binding.name, "is no memory object");
    return failure(properties.error, shared.plan.kernel + ": binding " + std::string(binding.name) + " could not be looked at");
  }

  /// What every memory object must be.
  Status check_memory(bool read, bool written) {
    if (!binding.memory) return bad("has no memory; expected a cl_mem");
    if (properties.value<cl_context>(CL_MEM_CONTEXT) != shared.device->context.get()) return bad("belongs to another context");
    const auto flags = properties.value<cl_mem_flags>(CL_MEM_FLAGS);
    if (written && (flags & CL_MEM_READ_ONLY)) return bad("is CL_MEM_READ_ONLY, but is written");
    if (read && (flags & CL_MEM_WRITE_ONLY)) return bad("is CL_MEM_WRITE_ONLY, but is read");
    return {};
  }

  Result<Range> buffer(std::size_t needed) {
    if (properties.value<cl_mem_object_type>(CL_MEM_TYPE) != CL_MEM_OBJECT_BUFFER)
      return bad("is an image; expected a buffer");
    if (binding.bytes < needed)
      return bad("has " + bytes_text(binding.bytes) + "; needs at least " + std::to_string(needed));
    const auto size = properties.value<std::size_t>(CL_MEM_SIZE);
    if (binding.offset > size || binding.bytes > size - binding.offset)
      return bad("claims " + bytes_text(binding.bytes) + " from offset " + std::to_string(binding.offset) +
                 ", but its memory object has " + std::to_string(size));
    if (binding.offset % shared.device->limits.alignment != 0)
      return bad("has offset " + std::to_string(binding.offset) + "; expected a multiple of " +
                 bytes_text(shared.device->limits.alignment));
    Range range{binding.memory, binding.offset, needed, binding.memory, binding.offset};
    if (const auto parent = properties.value<cl_mem>(CL_MEM_ASSOCIATED_MEMOBJECT)) {
      range.root = parent;
      range.root_offset += properties.value<std::size_t>(CL_MEM_OFFSET);
    }
    if (properties.error != CL_SUCCESS) return bad("");
    return range;
  }

  Result<Range> image(const Resource& resource) {
    const auto type = properties.value<cl_mem_object_type>(CL_MEM_TYPE);
    if (type != CL_MEM_OBJECT_IMAGE2D && type != CL_MEM_OBJECT_IMAGE3D)
      return bad("is no 2-D or 3-D image; expected an image");
    std::array<std::size_t, 3> extent{1, 1, 1};
    const cl_image_info axes[] = {CL_IMAGE_WIDTH, CL_IMAGE_HEIGHT, CL_IMAGE_DEPTH};
    const std::size_t dimensions = type == CL_MEM_OBJECT_IMAGE3D ? 3 : 2;
    bool equal = dimensions == 3 || resource.extent[2] == 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis < dimensions) extent[axis] = properties.image<std::size_t>(axes[axis]);
      equal = equal && extent[axis] == static_cast<std::size_t>(resource.extent[axis]);
    }
    if (!equal) return bad("has " + extent_text(extent) + " texels; expected " + extent_text(resource.extent));
    const auto format = properties.image<cl_image_format>(CL_IMAGE_FORMAT);
    const cl_image_format wanted = image_format(resource.format);
    if (format.image_channel_order != wanted.image_channel_order ||
        format.image_channel_data_type != wanted.image_channel_data_type)
      return bad(std::string("has another texel format; expected ") + name(resource.format));
    const auto parent = properties.value<cl_mem>(CL_MEM_ASSOCIATED_MEMOBJECT);
    if (properties.error != CL_SUCCESS) return bad("");
    return Range{binding.memory, 0, 0, parent ? parent : binding.memory, 0};
  }
};

/// Whether two checked bindings share a byte; an image takes all of its memory.
bool overlap(const Range& a, const Range& b) {
  if (!a.root || a.root != b.root) return false;
  if (a.bytes == 0 || b.bytes == 0) return true;
  return a.root_offset < b.root_offset + b.bytes && b.root_offset < a.root_offset + a.bytes;
}

/// Images and volumes are told apart where they are bound, since a plan's extent of depth 1 is either.
Status check_dimensions(const Shared& shared, std::span<const Range> ranges) {
  for (const Pass& pass : shared.plan.passes) {
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      const BindingKind kind = pass.module->bindings[i].kind;
      if (!is_image(kind)) continue;
      const std::size_t index = static_cast<std::size_t>(pass.slots[i].index);
      Properties properties{ranges[index].memory};
      const auto type = properties.value<cl_mem_object_type>(CL_MEM_TYPE);
      if (properties.error != CL_SUCCESS) return failure(properties.error, shared.plan.kernel + ": an image could not be looked at");
      if ((type == CL_MEM_OBJECT_IMAGE3D) != is_3d(kind))
        return bad_binding(shared.plan, shared.plan.resources[index].name,
                           is_3d(kind) ? "is a 2-D image; expected 3-D" : "is a 3-D image; expected 2-D");
    }
  }
  return {};
}

}  // namespace

Result<std::vector<Range>> check_bindings(const Shared& shared, std::span<const Binding> bindings) {
  const Plan& plan = shared.plan;
  std::vector<std::string_view> names(bindings.size());
  std::transform(bindings.begin(), bindings.end(), names.begin(), [](const Binding& binding) { return binding.name; });
  const Result<std::vector<int>> found = match(plan, names);
  if (!found) return found.status();

  std::vector<Range> ranges(plan.resources.size() + 1);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const bool scratch = i == plan.resources.size();
    if (scratch && plan.scratch_bytes == 0) continue;
    Checker checker{shared, bindings[static_cast<std::size_t>(found.value()[i])],
                    {bindings[static_cast<std::size_t>(found.value()[i])].memory}};
    const bool read = scratch || shared.uses[i].read, written = scratch || shared.uses[i].first_write >= 0;
    if (Status status = checker.check_memory(read, written); !status) return status;
    const bool image = !scratch && plan.resources[i].kind != ResourceKind::buffer;
    Result<Range> range = image ? checker.image(plan.resources[i])
                                : checker.buffer(scratch ? plan.scratch_bytes : plan.resources[i].bytes);
    if (!range) return range.status();
    ranges[i] = range.value();
  }
  constexpr cl_mem_flags host_may_not_write = CL_MEM_HOST_READ_ONLY | CL_MEM_HOST_NO_ACCESS;
  if (shared.tables) {
    Properties scratch{ranges.back().memory};
    const auto flags = scratch.value<cl_mem_flags>(CL_MEM_FLAGS);
    if (scratch.error != CL_SUCCESS) return failure(scratch.error, plan.kernel + ": scratch could not be looked at");
    if (flags & host_may_not_write)
      return bad_binding(plan, "scratch", "forbids the host to write, but tables are written to it");
  }
  if (Status status = check_dimensions(shared, ranges); !status) return status;
  for (const auto& [a, b] : shared.exclusive) {
    if (overlap(ranges[static_cast<std::size_t>(a)], ranges[static_cast<std::size_t>(b)]))
      return overlapping(plan, {a, b});
  }
  return ranges;
}

Status Arguments::part(const Shared& shared, const Range& range, std::size_t offset, std::size_t bytes, cl_mem& out) {
  const cl_buffer_region region{range.root_offset + offset, bytes};
  cl_int error = CL_SUCCESS;
  OwnedMemory memory(clCreateSubBuffer(range.root, 0, CL_BUFFER_CREATE_TYPE_REGION, &region, &error));
  if (error != CL_SUCCESS)
    return failure(error, shared.plan.kernel + ": a sub-buffer of " + bytes_text(bytes) + " at offset " +
                              std::to_string(region.origin) + " could not be made");
  out = memory.get();
  parts_.push_back(std::move(memory));
  return {};
}

Status Arguments::make(const Shared& shared, std::span<const Range> ranges) {
  const Plan& plan = shared.plan;
  resources_.resize(plan.resources.size());
  regions_.resize(plan.scratch.size());
  tables_.resize(plan.tables.size());
  for (std::size_t i = 0; i < resources_.size(); ++i) {
    resources_[i] = ranges[i].memory;
    const bool buffer = plan.resources[i].kind == ResourceKind::buffer;
    const bool alone = std::count_if(ranges.begin(), ranges.end(), [&](const Range& other) {
                         return other.root == ranges[i].root;
                       }) == 1;
    // A kernel may not use a memory object and a part of it at once, so that what shares one is bound by parts.
    if (!buffer || (ranges[i].offset == 0 && alone)) continue;
    if (Status status = part(shared, ranges[i], 0, ranges[i].bytes, resources_[i]); !status) return status;
  }
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const ScratchRegion& region = plan.scratch[i];
    const std::size_t bytes = region.count * bytes_per_pixel(region.format);
    if (Status status = part(shared, ranges.back(), region.offset, bytes, regions_[i]); !status) return status;
  }
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    if (Status status = part(shared, ranges.back(), i * table_bytes, table_bytes, tables_[i]); !status) return status;
  }
  return {};
}

cl_mem Arguments::of(const Slot& slot) const {
  const std::size_t index = static_cast<std::size_t>(slot.index);
  switch (slot.source) {
    case Slot::Source::resource: return resources_[index];
    case Slot::Source::scratch: return regions_[index];
    case Slot::Source::table: return tables_[index];
  }
  return nullptr;
}

}  // namespace luxel::opencl

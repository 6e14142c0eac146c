/// \file
/// Plan: what a kernel's host code decides and an execution (OpenCL, Vulkan, C++) carries out.
/// A plan is pure data: it names no API and needs no device.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <luxel/status.h>

namespace luxel {

/// One kernel source with one choice of options, compiled for all three executions. Opaque to callers.
struct Module;

/// How the elements of a buffer or the texels of an image are stored. `xN`: channels per pixel.
enum class Format { f32x1, f32x2, f32x4, f16x2, f16x4, unorm8x4, u32 };

/// Bytes of one pixel (element) of a format.
constexpr std::size_t bytes_per_pixel(Format format) {
  switch (format) {
    case Format::f32x1: case Format::u32: case Format::f16x2: case Format::unorm8x4: return 4;
    case Format::f32x2: case Format::f16x4: return 8;
    case Format::f32x4: return 16;
  }
  return 0;
}

/// Channels of one pixel.
constexpr int channels(Format format) {
  switch (format) {
    case Format::f32x1: case Format::u32: return 1;
    case Format::f32x2: case Format::f16x2: return 2;
    case Format::f32x4: case Format::f16x4: case Format::unorm8x4: return 4;
  }
  return 0;
}

/// The name as spelled above.
const char* name(Format format);

/// What the caller binds to a resource of a plan.
enum class ResourceKind {
  buffer,         ///< storage buffer / cl_mem buffer / memory
  image,          ///< sampled image read by integer coordinates (2-D or 3-D), no sampler
  sampled_image,  ///< sampled image read through a linear sampler, which the pipeline owns
  storage_image   ///< image that is written, or read without a sampler; a later pass may sample it
};

/// How the caller binds the input of a kernel that takes either.
enum class Input {
  buffer,
  image,         ///< sampled image (usage SAMPLED), read without a sampler
  storage_image  ///< storage image (usage STORAGE): faster on software drivers
};

/// How coordinates outside a sampled image are addressed.
enum class Address { clamp, wrap };

/// Something the caller brings: its name, kind, and the least size that is accepted.
struct Resource {
  std::string name;  ///< what it is bound by
  ResourceKind kind = ResourceKind::buffer;  ///< what is bound
  Format format = Format::f32x4;  ///< of its elements
  std::size_t bytes = 0;                ///< buffers: least size in bytes
  std::array<int, 3> extent{1, 1, 1};   ///< images: exact size in texels
  Address address = Address::clamp;     ///< sampled images
  bool written = false;  ///< else it is only read
  bool may_alias = false;               ///< may be bound to the same memory as another resource
};

/// A part of the scratch buffer: `count` elements of `format`. Offsets are multiples of 1024 bytes, which
/// every driver's sub-buffers and descriptors begin at (some OpenCL drivers want 512).
struct ScratchRegion {
  Format format = Format::f32x4;  ///< of its elements
  std::size_t count = 0;  ///< elements
  std::size_t offset = 0;  ///< bytes
};

/// What one binding slot of a pass refers to.
struct Slot {
  /// Where a slot's memory is.
  enum class Source { resource, scratch, table };
  Source source = Source::resource;  ///< where this slot's memory is
  int index = 0;  ///< into resources, scratch, or tables
};

/// Where a pass finds its number of workgroups: three u32 (x, y, z) from element `first` of a buffer that an earlier pass
/// of the plan wrote, none above the pass's `groups`. Vulkan dispatches indirectly, and so does C++; OpenCL, which cannot,
/// launches `groups`. A kernel whose loop is `for (i = invocation_x(); i < length; i += stride)`, with `stride` the
/// invocations of `groups`, does every item once under either.
struct Counts {
  Slot slot;  ///< the buffer
  std::size_t first = 0;  ///< element of it that holds x
};

/// One dispatch.
struct Pass {
  const Module* module = nullptr;  ///< what is run
  std::string label;                     ///< for debug labels and timings
  std::vector<Slot> slots;               ///< in the order of the module's bindings
  std::vector<double> parameters;        ///< in the order of the module's parameters
  std::vector<double> constants;         ///< in the order of the module's constants
  std::array<std::uint32_t, 3> workgroup{1, 1, 1};  ///< invocations
  std::array<std::uint32_t, 3> groups{1, 1, 1};     ///< workgroups; with `counts` the most there may be
  std::optional<Counts> counts;                     ///< where the number of workgroups is found as the plan runs
  /// Rounds of loops that an invocation runs at most, all its loops together; 0: few, or (probe_trace) no bound that ordinary
  /// calls keep. Some drivers end loops without a word: Mesa's llvmpipe after 65,535 rounds; there the small layer refuses what
  /// may need more (unsupported).
  double rounds = 0;
};

/// Everything needed to run one call of a kernel. Passes run in order, each seeing what the one before wrote.
struct Plan {
  std::string kernel;  ///< name of the kernel's part, say lpv_propagate
  std::vector<Resource> resources;  ///< what the caller binds
  std::vector<ScratchRegion> scratch;  ///< parts of the scratch buffer
  std::vector<std::vector<double>> tables;  ///< small read-only tables (weights): the floats kept in the scratch buffer's first bytes
  std::vector<std::vector<double>> exact_tables;  ///< the same before rounding, for the execution in double
  std::vector<Pass> passes;  ///< in the order in which they run
  std::size_t scratch_bytes = 0;            ///< what the caller brings, tables included; 0: none needed
  double flops = 0;                         ///< arithmetic of the whole plan (multiplications and additions)
  double bytes = 0;                         ///< least memory traffic of the whole plan, each pass reading and writing once
};

/// Bytes at the start of the scratch buffer that table `index` begins at (each table has 16 KiB).
constexpr std::size_t table_bytes = 16384;

/// Shape of a kernel on a device: compile-time constants that decide speed, never the result.
struct Shape {
  int lanes = 0;     ///< neighbouring values per invocation; 0: one pixel
  int block = 1;     ///< outputs per invocation along the pass
  int unroll = 1;    ///< largest radius or loop that is fully unrolled
  int split = 0;     ///< 1: inside and border take separate code
  std::array<std::uint32_t, 3> workgroup{64, 1, 1};  ///< invocations
};

/// What a device is fast at. Defaults exist for the drivers luxel knows; `luxel tune` finds others.
struct Profile {
  std::string name = "reference";  ///< reference | pocl | lavapipe | gpu | opencl_gpu
  Shape rows;       ///< passes that run along rows of an image
  Shape columns;    ///< passes that run along columns
  Shape pixels;     ///< one invocation a pixel
  Shape voxels;     ///< one invocation a voxel
  bool workgroup_memory = false;   ///< forms with workgroup memory pay
  bool texels = false;             ///< buffers of pixels are read faster through texel buffers (Vulkan)
};

/// Defaults by name (above). An unknown name gives `reference`.
Profile profile(const std::string& name);

}  // namespace luxel

// A compiled plan: what clones share, and what each has of its own.
#pragma once
#include <span>
#include <string_view>
#include <utility>

#include "host/bindings.h"
#include "host/opencl/device.h"
#include "host/opencl/program.h"

namespace luxel::opencl {

/// The same for every clone, and never changed.
struct Shared {
  std::shared_ptr<Device::State> device;
  Plan plan;
  std::vector<Use> uses;                         // of the plan's resources
  std::vector<std::pair<int, int>> exclusive;    // resources that may not share memory
  std::vector<std::shared_ptr<BuiltProgram>> programs;  // one a pass
  std::vector<OwnedSampler> samplers;            // by Address; null where no pass samples
  std::shared_ptr<const std::vector<float>> tables;     // as they lie in scratch; null: none
};

struct Pipeline::State {
  std::shared_ptr<const Shared> shared;
  std::vector<OwnedKernel> kernels;  // one a pass; parameters, samplers and workgroup memory are set already
};

/// A binding that was checked: the part of a memory object that the plan uses.
struct Range {
  cl_mem memory = nullptr;   // as bound; null: nothing was needed
  std::size_t offset = 0;    // bytes into `memory`
  std::size_t bytes = 0;     // that the plan uses; images: 0, which means all
  cl_mem root = nullptr;     // what `memory` is a part of, or `memory`
  std::size_t root_offset = 0;  // of the part, in bytes into `root`
};

/// The resources of the plan, then scratch. Errors: invalid_argument, before anything is enqueued.
Result<std::vector<Range>> check_bindings(const Shared& shared, std::span<const Binding> bindings);

/// Memory objects for the slots of every pass, some of them sub-buffers made for one call. Enqueued commands keep what
/// they use alive, so that the caller's memory is held no longer than the call.
class Arguments {
 public:
  /// Errors: out_of_memory, internal.
  Status make(const Shared& shared, std::span<const Range> ranges);
  cl_mem of(const Slot& slot) const;

 private:
  Status part(const Shared& shared, const Range& range, std::size_t offset, std::size_t bytes, cl_mem& out);

  std::vector<cl_mem> resources_, regions_, tables_;
  std::vector<OwnedMemory> parts_;
};

}  // namespace luxel::opencl

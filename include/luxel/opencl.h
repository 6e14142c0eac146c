/// \file
/// Running luxel plans on OpenCL 1.2. Borrows every handle; owns only programs and kernels.
#pragma once
/// The OpenCL version that the headers are asked for.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <luxel/plan.h>

/// Plans on OpenCL, with the caller's context and queues.
namespace luxel::opencl {

/// A context and a device of the caller's.
struct Adopt {
  cl_context context = nullptr;  ///< holds the device
  cl_device_id device = nullptr;  ///< OpenCL 1.2 or newer
  std::string cache_directory;  ///< program binaries; empty: none on disk. PoCL keeps its own instead (POCL_CACHE_DIR)
};

/// A borrowed device and the programs that were built for it. Copies share both.
class Device {
 public:
  /// Borrow a context and a device of it. Errors: invalid_argument for a null handle or a device of another context;
  /// unsupported for a device without OpenCL 1.2 or without a compiler.
  static Result<Device> adopt(const Adopt& info);

  const Profile& profile() const;  ///< what the device is fast at
  const std::string& name() const;    ///< as the driver reports it
  const std::string& driver() const;  ///< platform name and driver version

  struct State;
  std::shared_ptr<State> state;  ///< opaque; shared by copies
};

/// One resource of a plan: a buffer (offset in bytes, a multiple of the device's base address alignment) or an image.
struct Binding {
  std::string_view name;  ///< of the resource, or `scratch`
  cl_mem memory = nullptr;  ///< buffer or image, as the resource's kind asks
  std::size_t offset = 0;  ///< bytes; images: 0
  std::size_t bytes = 0;  ///< available from offset; images: ignored
};

/// Options of Pipeline::enqueue.
struct Enqueue {
  const cl_event* wait = nullptr;  ///< the first pass waits for these
  cl_uint wait_count = 0;  ///< how many
  cl_event* done = nullptr;        ///< set to an event of the last pass; the caller releases it
  std::vector<cl_event>* pass_events = nullptr;  ///< one event a pass, for timing; the caller releases them
  bool tables_current = false;     ///< scratch still holds this pipeline's tables from an earlier call
};

/// A plan compiled for a device. One thread at a time may enqueue a pipeline; `clone` gives another thread its own.
class Pipeline {
 public:
  /// Builds every program that the device does not have yet. Errors: unsupported, naming limit, value and need;
  /// compile_failed with the first error of the driver's log; out_of_memory.
  static Result<Pipeline> create(const Device& device, Plan plan);

  const Plan& plan() const;  ///< what it was made from

  /// Enqueues the plan's passes, in order also on an out-of-order queue. Does not flush or wait, and holds the bound
  /// memory no longer than the commands do. Where the plan has tables, the host must be allowed to write to `scratch`.
  /// Errors: invalid_argument, naming the binding, before anything is enqueued; out_of_memory. Where the driver refuses
  /// a later pass, the message says that earlier ones are enqueued; no event is handed out then.
  Status enqueue(cl_command_queue queue, const std::vector<Binding>& bindings, const Enqueue& options = {}) const;

  /// The same programs with kernel objects of its own.
  Result<Pipeline> clone() const;

  struct State;
  std::shared_ptr<State> state;  ///< opaque; shared by copies
};

}  // namespace luxel::opencl

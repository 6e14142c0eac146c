/// \file
/// The second, small layer: opens a device by name, makes buffers, runs plans and waits. For tools, tests and people who
/// just want a result; engines use vulkan.h or opencl.h directly.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <luxel/plan.h>

namespace luxel {

/// How plans are carried out: a driver, or as C++ on this CPU.
enum class Api { opencl, vulkan, cpu };

/// What is known of a device before it is opened.
struct DeviceInfo {
  int index = 0;        ///< as `luxel devices` counts; in Context::info(): among the devices of its api
  Api api = Api::cpu;  ///< what carries plans out
  std::string name;     ///< as the driver reports it; cpu: "C++ float" and "C++ double"
  std::string driver;  ///< name and version
  std::string profile;  ///< name of its Profile
  std::string id;       ///< "opencl:<name>", "vulkan:<name>", "cpu:float", "cpu:double"
};

/// Every device of this machine: OpenCL, Vulkan, then C++ float and C++ double. `problems` (optional) receives a line for
/// each API that has none, saying what is missing and what to install.
std::vector<DeviceInfo> devices(std::vector<std::string>* problems = nullptr);

/// A linear piece of device memory, or an image, that luxel::Context made.
class Memory;

/// Times of one run in milliseconds.
struct Times {
  double total = 0;              ///< from submission to completion, as the host sees it
  std::vector<double> passes;    ///< by the device's clock; empty where it has none
};

/// A compiled plan of a Context.
class Program;

/// Memory bound to a resource of a plan.
struct Named {
  std::string_view name;  ///< of the resource
  std::shared_ptr<Memory> memory;  ///< what is bound
  /// Pixels (elements) of the memory before the resource begins, which bind parts of one buffer: a multiple of 64 always
  /// fits a device's alignment. Images: 0.
  std::size_t first = 0;
};

/// An open device. One thread at a time may use it.
class Context {
 public:
  /// `which`: "opencl", "vulkan", "cpu", "cpu:double", an index, an id or a profile ("pocl", "lavapipe"), or part of a
  /// device's name (case ignored); the first that fits.
  /// Errors: missing_driver with the devices that exist and what to install.
  static Result<std::shared_ptr<Context>> open(std::string_view which);
  virtual ~Context() = default;

  /// What this device is.
  virtual const DeviceInfo& info() const = 0;
  /// What it is fast at: give it to the kernels' plan().
  virtual const Profile& profile() const = 0;
  /// True for cpu:double, where every channel is a double on upload and download.
  virtual bool real64() const { return false; }

  /// Uninitialised memory for a resource of a plan (`bytes` at least resource.bytes; images by extent).
  virtual Result<std::shared_ptr<Memory>> make(const Resource& resource, std::size_t bytes = 0) = 0;
  /// Copies `bytes` bytes from `data` to the memory's start, and waits. Errors: invalid_argument for more than it holds.
  virtual Status upload(Memory& memory, const void* data, std::size_t bytes) = 0;
  /// The same from the memory to `data`.
  virtual Status download(Memory& memory, void* data, std::size_t bytes) = 0;

  /// Errors: unsupported, compile_failed, out_of_memory.
  virtual Result<std::shared_ptr<Program>> compile(const Plan& plan) = 0;
  /// Runs and waits. Scratch is made by the program, once.
  virtual Status run(Program& program, const std::vector<Named>& resources, Times* times = nullptr) = 0;
  /// Runs `repeat` times back to back in one submission and waits; for timing short kernels. `times` are those of all
  /// the runs together.
  virtual Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) = 0;

  /// Messages of the Vulkan validation layers since the last call (empty elsewhere). Layers are on, with
  /// synchronization validation, when the environment variable LUXEL_VALIDATION is 1, and with best practices too when it
  /// is best_practices.
  virtual std::vector<std::string> validation_messages() { return {}; }
};

}  // namespace luxel

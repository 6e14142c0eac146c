// The second, small layer: opens a device by name, makes buffers, runs plans and waits. For tools, tests and people who
// just want a result; engines use vulkan.h or opencl.h directly.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <luxel/plan.h>

namespace luxel {

enum class Api { opencl, vulkan, cpu };

struct DeviceInfo {
  int index = 0;        // as `luxel devices` counts; in Context::info(): among the devices of its api
  Api api = Api::cpu;
  std::string name;     // as the driver reports it; cpu: "C++ float" and "C++ double"
  std::string driver;
  std::string profile;
  std::string id;       // "opencl:<name>", "vulkan:<name>", "cpu:float", "cpu:double"
};

/// Every device of this machine: OpenCL, Vulkan, then C++ float and C++ double. `problems` (optional) receives a line for
/// each API that has none, saying what is missing and what to install.
std::vector<DeviceInfo> devices(std::vector<std::string>* problems = nullptr);

/// A linear piece of device memory, or an image, that luxel::Context made.
class Memory;

/// Times of one run in milliseconds.
struct Times {
  double total = 0;              // from submission to completion, as the host sees it
  std::vector<double> passes;    // by the device's clock; empty where it has none
};

/// A compiled plan of a Context.
class Program;

struct Named {
  std::string_view name;
  std::shared_ptr<Memory> memory;
  /// Pixels (elements) of the memory before the resource begins, which bind parts of one buffer: a multiple of 64 always
  /// fits a device's alignment. Images: 0.
  std::size_t first = 0;
};

class Context {
 public:
  /// `which`: "opencl", "vulkan", "cpu", "cpu:double", an index, an id or a profile ("pocl", "lavapipe"), or part of a
  /// device's name (case ignored); the first that fits.
  /// Errors: missing_driver with the devices that exist and what to install.
  static Result<std::shared_ptr<Context>> open(std::string_view which);
  virtual ~Context() = default;

  virtual const DeviceInfo& info() const = 0;
  virtual const Profile& profile() const = 0;
  /// True for cpu:double, where every channel is a double on upload and download.
  virtual bool real64() const { return false; }

  /// Uninitialised memory for a resource of a plan (`bytes` at least resource.bytes; images by extent).
  virtual Result<std::shared_ptr<Memory>> make(const Resource& resource, std::size_t bytes = 0) = 0;
  virtual Status upload(Memory& memory, const void* data, std::size_t bytes) = 0;
  virtual Status download(Memory& memory, void* data, std::size_t bytes) = 0;

  virtual Result<std::shared_ptr<Program>> compile(const Plan& plan) = 0;
  /// Runs and waits. Scratch is made by the program, once.
  virtual Status run(Program& program, const std::vector<Named>& resources, Times* times = nullptr) = 0;
  /// Runs `repeat` times back to back in one submission and waits; for timing short kernels. `times` are those of all
  /// the runs together.
  virtual Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) = 0;

  /// Messages of the Vulkan validation layers since the last call (empty elsewhere). Layers are on when the environment
  /// variable LUXEL_VALIDATION is 1.
  virtual std::vector<std::string> validation_messages() { return {}; }
};

}  // namespace luxel

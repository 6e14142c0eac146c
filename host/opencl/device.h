// What a Device knows: handles, limits, and every program that was built for it.
#pragma once
#include <array>
#include <map>
#include <mutex>

#include "host/opencl/handles.h"

namespace luxel::opencl {

struct Limits {
  std::size_t workgroup = 0;                  // invocations
  std::array<std::size_t, 3> workgroup_axis{};
  cl_ulong local_memory = 0;                  // bytes
  cl_ulong allocation = 0;                    // bytes of one memory object
  cl_ulong constant_buffer = 0;               // bytes of one __constant argument
  cl_uint constant_arguments = 0;
  std::size_t alignment = 1;                  // bytes; of a sub-buffer's offset
  bool images = false;
  std::array<std::size_t, 2> image2d{};       // texels
  std::array<std::size_t, 3> image3d{};
};

/// One program; its mutex is held while it is built.
struct BuiltProgram {
  std::mutex mutex;
  OwnedProgram program;
};

struct Device::State {
  OwnedContext context;  // counted, so that the caller may release first
  cl_device_id device = nullptr;
  std::string cache_directory;
  Profile profile;
  std::string name, driver;
  Limits limits;
  std::string base_options;
  bool keep_binaries = false;  // whether programs go to cache_directory

  std::mutex mutex;  // of `programs`
  std::map<std::string, std::shared_ptr<BuiltProgram>> programs;
};

/// Platform name and driver version.
std::string driver_of(cl_device_id device);

/// The name of the profile that suits the device.
std::string profile_of(cl_device_id device);

/// Whether a plan fits the device: workgroups, workgroup memory, allocations, alignment, images, constant memory.
/// Errors: unsupported, naming the limit, its value and what is needed.
Status check_limits(const Device::State& device, const Plan& plan);

}  // namespace luxel::opencl

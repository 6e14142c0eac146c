#include "host/opencl/device.h"

#include <algorithm>
#include <cstdio>

namespace luxel::opencl {
namespace {

Limits limits_of(cl_device_id device) {
  Limits limits;
  limits.workgroup = value<std::size_t>(device, CL_DEVICE_MAX_WORK_GROUP_SIZE);
  std::vector<std::size_t> axes(std::max<cl_uint>(3, value<cl_uint>(device, CL_DEVICE_MAX_WORK_ITEM_DIMENSIONS)));
  clGetDeviceInfo(device, CL_DEVICE_MAX_WORK_ITEM_SIZES, axes.size() * sizeof(std::size_t), axes.data(), nullptr);
  std::copy_n(axes.begin(), 3, limits.workgroup_axis.begin());
  limits.local_memory = value<cl_ulong>(device, CL_DEVICE_LOCAL_MEM_SIZE);
  limits.allocation = value<cl_ulong>(device, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
  limits.constant_buffer = value<cl_ulong>(device, CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE);
  limits.constant_arguments = value<cl_uint>(device, CL_DEVICE_MAX_CONSTANT_ARGS);
  limits.alignment = std::max<std::size_t>(1, value<cl_uint>(device, CL_DEVICE_MEM_BASE_ADDR_ALIGN) / 8);
  limits.images = value<cl_bool>(device, CL_DEVICE_IMAGE_SUPPORT) == CL_TRUE;
  limits.image2d = {value<std::size_t>(device, CL_DEVICE_IMAGE2D_MAX_WIDTH),
                    value<std::size_t>(device, CL_DEVICE_IMAGE2D_MAX_HEIGHT)};
  limits.image3d = {value<std::size_t>(device, CL_DEVICE_IMAGE3D_MAX_WIDTH),
                    value<std::size_t>(device, CL_DEVICE_IMAGE3D_MAX_HEIGHT),
                    value<std::size_t>(device, CL_DEVICE_IMAGE3D_MAX_DEPTH)};
  return limits;
}

Result<bool> contains(cl_context context, cl_device_id device) {
  std::size_t bytes = 0;
  cl_int error = clGetContextInfo(context, CL_CONTEXT_DEVICES, 0, nullptr, &bytes);
  std::vector<cl_device_id> devices(bytes / sizeof(cl_device_id));
  if (error == CL_SUCCESS) error = clGetContextInfo(context, CL_CONTEXT_DEVICES, bytes, devices.data(), nullptr);
  if (error != CL_SUCCESS) return failure(error, "opencl::Adopt.context could not be looked at");
  return std::find(devices.begin(), devices.end(), device) != devices.end();
}

}  // namespace

std::string driver_of(cl_device_id device) {
  return text(value<cl_platform_id>(device, CL_DEVICE_PLATFORM), CL_PLATFORM_NAME) + " " +
         text(device, CL_DRIVER_VERSION);
}

std::string profile_of(cl_device_id device) {
  return value<cl_device_type>(device, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU ? "pocl" : "opencl_gpu";
}

Result<Device> Device::adopt(const Adopt& info) {
  const auto invalid = [](const char* what) {
    return Status(Code::invalid_argument, std::string("opencl::Adopt.") + what);
  };
  if (!info.context) return invalid("context is null; expected a cl_context");
  if (!info.device) return invalid("device is null; expected a cl_device_id");
  const Result<bool> contained = contains(info.context, info.device);
  if (!contained) return contained.status();
  if (!contained.value()) return invalid("device is not one of the context's devices");

  auto state = std::make_shared<State>();
  state->device = info.device;
  state->name = text(info.device, CL_DEVICE_NAME);
  const std::string version = text(info.device, CL_DEVICE_VERSION);
  int major = 0, minor = 0;
  if (std::sscanf(version.c_str(), "OpenCL %d.%d", &major, &minor) != 2 || major * 10 + minor < 12)
    return Status(Code::unsupported, state->name + ": CL_DEVICE_VERSION is " + version + "; needs OpenCL 1.2");
  if (value<cl_bool>(info.device, CL_DEVICE_COMPILER_AVAILABLE) != CL_TRUE)
    return Status(Code::unsupported, state->name + ": CL_DEVICE_COMPILER_AVAILABLE is false; needs a compiler");

  clRetainContext(info.context);
  state->context = OwnedContext(info.context);
  state->cache_directory = info.cache_directory;
  state->driver = driver_of(info.device);
  state->limits = limits_of(info.device);
  state->profile = luxel::profile(profile_of(info.device));

  // -w: some drivers print their compiler's warnings on stderr, where only the caller may.
  state->base_options = "-cl-std=CL1.2 -w";
  const auto single = value<cl_device_fp_config>(info.device, CL_DEVICE_SINGLE_FP_CONFIG);
  if (single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) state->base_options += " -cl-fp32-correctly-rounded-divide-sqrt";

  // PoCL keeps both steps of its compilation on disk itself (POCL_CACHE_DIR). Asking it for a program's binary makes it
  // compile, beside, a form of each kernel for any workgroup size, which no dispatch of ours uses: as long as the
  // dispatch's own compilation (65 to 620 ms measured), to save 20 ms a program at the next start.
  state->keep_binaries = text(value<cl_platform_id>(info.device, CL_DEVICE_PLATFORM), CL_PLATFORM_NAME) !=
                         "Portable Computing Language";

  Device device;
  device.state = std::move(state);
  return device;
}

const Profile& Device::profile() const { return state->profile; }
const std::string& Device::name() const { return state->name; }
const std::string& Device::driver() const { return state->driver; }

}  // namespace luxel::opencl

// Owned OpenCL objects, and OpenCL's errors as Status.
#pragma once
#include <luxel/opencl.h>

#include <string>
#include <utility>

namespace luxel::opencl {

template <class T, cl_int (CL_API_CALL* release)(T)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(T handle) : handle_(handle) {}
  Owned(Owned&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() {
    if (handle_) release(handle_);
  }
  T get() const { return handle_; }
  T take() { return std::exchange(handle_, nullptr); }
  explicit operator bool() const { return handle_ != nullptr; }

 private:
  T handle_ = nullptr;
};

using OwnedContext = Owned<cl_context, clReleaseContext>;
using OwnedQueue = Owned<cl_command_queue, clReleaseCommandQueue>;
using OwnedMemory = Owned<cl_mem, clReleaseMemObject>;
using OwnedProgram = Owned<cl_program, clReleaseProgram>;
using OwnedKernel = Owned<cl_kernel, clReleaseKernel>;
using OwnedSampler = Owned<cl_sampler, clReleaseSampler>;
using OwnedEvent = Owned<cl_event, clReleaseEvent>;

/// "CL_OUT_OF_RESOURCES"; the number for a code of a vendor's own.
std::string error_name(cl_int error);

/// `message: CL_...` under the code that the error means.
Status failure(cl_int error, const std::string& message);

/// A text property of a platform or device.
std::string text(cl_device_id device, cl_device_info what);
std::string text(cl_platform_id platform, cl_platform_info what);

/// A fixed-size property of a device; zero where the driver does not know it.
template <class T>
T value(cl_device_id device, cl_device_info what) {
  T result{};
  if (clGetDeviceInfo(device, what, sizeof result, &result, nullptr) != CL_SUCCESS) return T{};
  return result;
}

/// How images of a format are stored.
cl_image_format image_format(Format format);

}  // namespace luxel::opencl

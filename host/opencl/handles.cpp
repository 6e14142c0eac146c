#include "host/opencl/handles.h"

#include <CL/cl_ext.h>

namespace luxel::opencl {

std::string error_name(cl_int error) {
#define LUXEL_CASE(name) case name: return #name;
  switch (error) {
    LUXEL_CASE(CL_DEVICE_NOT_FOUND)
    LUXEL_CASE(CL_DEVICE_NOT_AVAILABLE)
    LUXEL_CASE(CL_COMPILER_NOT_AVAILABLE)
    LUXEL_CASE(CL_MEM_OBJECT_ALLOCATION_FAILURE)
    LUXEL_CASE(CL_OUT_OF_RESOURCES)
    LUXEL_CASE(CL_OUT_OF_HOST_MEMORY)
    LUXEL_CASE(CL_PROFILING_INFO_NOT_AVAILABLE)
    LUXEL_CASE(CL_IMAGE_FORMAT_NOT_SUPPORTED)
    LUXEL_CASE(CL_BUILD_PROGRAM_FAILURE)
    LUXEL_CASE(CL_MISALIGNED_SUB_BUFFER_OFFSET)
    LUXEL_CASE(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST)
    LUXEL_CASE(CL_INVALID_VALUE)
    LUXEL_CASE(CL_INVALID_PLATFORM)
    LUXEL_CASE(CL_INVALID_DEVICE)
    LUXEL_CASE(CL_INVALID_CONTEXT)
    LUXEL_CASE(CL_INVALID_COMMAND_QUEUE)
    LUXEL_CASE(CL_INVALID_MEM_OBJECT)
    LUXEL_CASE(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR)
    LUXEL_CASE(CL_INVALID_IMAGE_SIZE)
    LUXEL_CASE(CL_INVALID_SAMPLER)
    LUXEL_CASE(CL_INVALID_BINARY)
    LUXEL_CASE(CL_INVALID_BUILD_OPTIONS)
    LUXEL_CASE(CL_INVALID_PROGRAM)
    LUXEL_CASE(CL_INVALID_PROGRAM_EXECUTABLE)
    LUXEL_CASE(CL_INVALID_KERNEL_NAME)
    LUXEL_CASE(CL_INVALID_KERNEL)
    LUXEL_CASE(CL_INVALID_ARG_INDEX)
    LUXEL_CASE(CL_INVALID_ARG_VALUE)
    LUXEL_CASE(CL_INVALID_ARG_SIZE)
    LUXEL_CASE(CL_INVALID_KERNEL_ARGS)
    LUXEL_CASE(CL_INVALID_WORK_DIMENSION)
    LUXEL_CASE(CL_INVALID_WORK_GROUP_SIZE)
    LUXEL_CASE(CL_INVALID_WORK_ITEM_SIZE)
    LUXEL_CASE(CL_INVALID_GLOBAL_OFFSET)
    LUXEL_CASE(CL_INVALID_EVENT_WAIT_LIST)
    LUXEL_CASE(CL_INVALID_EVENT)
    LUXEL_CASE(CL_INVALID_OPERATION)
    LUXEL_CASE(CL_INVALID_BUFFER_SIZE)
    LUXEL_CASE(CL_INVALID_GLOBAL_WORK_SIZE)
    LUXEL_CASE(CL_PLATFORM_NOT_FOUND_KHR)
    default: return "OpenCL error " + std::to_string(error);
  }
#undef LUXEL_CASE
}

Status failure(cl_int error, const std::string& message) {
  Code code = Code::internal;
  switch (error) {
    case CL_MEM_OBJECT_ALLOCATION_FAILURE: case CL_OUT_OF_RESOURCES: case CL_OUT_OF_HOST_MEMORY:
      code = Code::out_of_memory;
      break;
    case CL_DEVICE_NOT_AVAILABLE: case CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST: code = Code::device_lost; break;
    case CL_BUILD_PROGRAM_FAILURE: code = Code::compile_failed; break;
    case CL_COMPILER_NOT_AVAILABLE: case CL_IMAGE_FORMAT_NOT_SUPPORTED: case CL_INVALID_IMAGE_SIZE:
      code = Code::unsupported;
      break;
    case CL_DEVICE_NOT_FOUND: case CL_PLATFORM_NOT_FOUND_KHR: code = Code::missing_driver; break;
    case CL_INVALID_CONTEXT: case CL_INVALID_COMMAND_QUEUE: case CL_INVALID_DEVICE: case CL_INVALID_MEM_OBJECT:
    case CL_INVALID_EVENT_WAIT_LIST:
      code = Code::invalid_argument;
      break;
    default: break;
  }
  return Status(code, message + ": " + error_name(error));
}

namespace {
template <class Object, class Query>
std::string query_text(Object object, cl_uint what, Query query) {
  std::size_t size = 0;
  if (query(object, what, 0, nullptr, &size) != CL_SUCCESS || size == 0) return {};
  std::string result(size, '\0');
  if (query(object, what, size, result.data(), nullptr) != CL_SUCCESS) return {};
  result.resize(result.find('\0') == std::string::npos ? size : result.find('\0'));
  return result;
}
}  // namespace

std::string text(cl_device_id device, cl_device_info what) { return query_text(device, what, clGetDeviceInfo); }
std::string text(cl_platform_id platform, cl_platform_info what) {
  return query_text(platform, what, clGetPlatformInfo);
}

cl_image_format image_format(Format format) {
  switch (format) {
    case Format::f32x1: return {CL_R, CL_FLOAT};
    case Format::f32x2: return {CL_RG, CL_FLOAT};
    case Format::f32x4: return {CL_RGBA, CL_FLOAT};
    case Format::f16x2: return {CL_RG, CL_HALF_FLOAT};
    case Format::f16x4: return {CL_RGBA, CL_HALF_FLOAT};
    case Format::unorm8x4: return {CL_RGBA, CL_UNORM_INT8};
    case Format::u32: return {CL_R, CL_UNSIGNED_INT32};
  }
  return {};
}

}  // namespace luxel::opencl

// What the tests of the OpenCL execution share: a device with queues, a kernel small enough to break on purpose, and
// buffers with guard bands.
#pragma once
#include <gtest/gtest.h>

#include <cstring>
#include <numeric>

#include "host/module.h"
#include "host/opencl/handles.h"

namespace luxel::opencl {

/// The first OpenCL device of this machine, a context on it, and a Device without a disk cache.
struct Machine {
  cl_device_id id = nullptr;
  OwnedContext context;
  Device device;

  static Machine open() {
    Machine machine;
    cl_platform_id platform = nullptr;
    cl_int error = clGetPlatformIDs(1, &platform, nullptr);
    EXPECT_EQ(error, CL_SUCCESS) << "no OpenCL driver; install pocl-opencl-icd";
    if (error != CL_SUCCESS) std::exit(1);
    EXPECT_EQ(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &machine.id, nullptr), CL_SUCCESS);
    machine.context = OwnedContext(clCreateContext(nullptr, 1, &machine.id, nullptr, nullptr, &error));
    EXPECT_EQ(error, CL_SUCCESS);
    machine.device = machine.adopt("");
    return machine;
  }

  Device adopt(const std::string& cache) const {
    Result<Device> adopted = Device::adopt({context.get(), id, cache});
    EXPECT_TRUE(adopted.ok()) << adopted.status().message();
    return std::move(adopted).value();
  }

  OwnedQueue queue(cl_command_queue_properties properties = 0) const {
    cl_int error = CL_SUCCESS;
    OwnedQueue queue(clCreateCommandQueue(context.get(), id, properties, &error));
    EXPECT_EQ(error, CL_SUCCESS);
    return queue;
  }

  OwnedMemory buffer(std::size_t bytes, cl_mem_flags flags = CL_MEM_READ_WRITE) const {
    cl_int error = CL_SUCCESS;
    OwnedMemory memory(clCreateBuffer(context.get(), flags, bytes, nullptr, &error));
    EXPECT_EQ(error, CL_SUCCESS);
    return memory;
  }
};

template <class T>
void write(cl_command_queue queue, const OwnedMemory& memory, const std::vector<T>& data, std::size_t offset = 0) {
  EXPECT_EQ(clEnqueueWriteBuffer(queue, memory.get(), CL_TRUE, offset, data.size() * sizeof(T), data.data(), 0, nullptr,
                                 nullptr),
            CL_SUCCESS);
}

template <class T>
std::vector<T> read(cl_command_queue queue, const OwnedMemory& memory, std::size_t count, std::size_t offset = 0) {
  std::vector<T> data(count);
  EXPECT_EQ(clEnqueueReadBuffer(queue, memory.get(), CL_TRUE, offset, count * sizeof(T), data.data(), 0, nullptr,
                                nullptr),
            CL_SUCCESS);
  return data;
}

/// b[i] = a[i] * scale + OFFSET for i < count, after ROUNDS rounds of work that leave a[i] as it is.
inline const char* tiny_source = R"(
typedef struct { int count; float scale; } Parameters;
__kernel __attribute__((reqd_work_group_size(WORKGROUP_X, WORKGROUP_Y, WORKGROUP_Z)))
void tiny(const Parameters params, __global const float* a, __global float* b) {
  const int i = get_global_id(0);
  if (i >= params.count) return;
  float v = a[i];
  for (uint k = 0; k < ROUNDS; ++k) v = v * 2.0f * 0.5f;
  b[i] = v * params.scale + OFFSET;
}
)";

inline Module tiny_module(std::string_view source = tiny_source) {
  static constexpr BindingInfo bindings[] = {{BindingKind::read, 0, "float", "a", 0},
                                             {BindingKind::write, 1, "float", "b", 0}};
  static constexpr ParameterInfo parameters[] = {{Scalar::int32, "count"}, {Scalar::float32, "scale"}};
  static constexpr ConstantInfo constants[] = {{0, Scalar::float32, "OFFSET", 0, false},
                                               {1, Scalar::uint32, "ROUNDS", 0, false}};
  Module module{};
  module.kernel = module.part = module.name = "tiny";
  module.bindings = bindings;
  module.parameters = parameters;
  module.constants = constants;
  module.opencl = source;
  module.hash = 1;
  return module;
}

/// `passes` passes of `module` from `src` through scratch to `dst`, `count` floats each: x -> 2x + 1 every time.
inline Plan tiny_plan(const Module& module, int count, int passes, int rounds = 0) {
  Plan plan;
  plan.kernel = "tiny";
  const std::size_t bytes = static_cast<std::size_t>(count) * sizeof(float);
  Resource src{"src", ResourceKind::buffer, Format::f32x1, bytes}, dst = src;
  dst.name = "dst";
  dst.written = true;
  plan.resources = {src, dst};
  const std::size_t stride = (bytes + 1023) / 1024 * 1024;
  for (int p = 0; p < passes; ++p) {
    Pass pass;
    pass.module = &module;
    pass.label = "step " + std::to_string(p);
    const Slot from = p == 0 ? Slot{Slot::Source::resource, 0} : Slot{Slot::Source::scratch, p - 1};
    const Slot to = p + 1 == passes ? Slot{Slot::Source::resource, 1} : Slot{Slot::Source::scratch, p};
    if (to.source == Slot::Source::scratch)
      plan.scratch.push_back({Format::f32x1, static_cast<std::size_t>(count), static_cast<std::size_t>(p) * stride});
    pass.slots = {from, to};
    pass.parameters = {static_cast<double>(count), 2.0};
    pass.constants = {1.0, static_cast<double>(rounds)};
    pass.workgroup = {64, 1, 1};
    pass.groups = {static_cast<std::uint32_t>((count + 63) / 64), 1, 1};
    plan.passes.push_back(pass);
  }
  plan.scratch_bytes = plan.scratch.size() * stride;
  return plan;
}

/// What tiny_plan makes of `values`.
inline std::vector<float> tiny_result(std::vector<float> values, int passes) {
  for (float& value : values) {
    for (int p = 0; p < passes; ++p) value = value * 2.0f + 1.0f;
  }
  return values;
}

inline std::vector<float> counting(int count) {
  std::vector<float> values(static_cast<std::size_t>(count));
  std::iota(values.begin(), values.end(), 0.0f);
  return values;
}

}  // namespace luxel::opencl

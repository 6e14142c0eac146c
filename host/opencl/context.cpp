#include "host/opencl/context.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "host/context.h"
#include "host/files.h"
#include "host/opencl/device.h"

namespace luxel::opencl {
namespace {

using Clock = std::chrono::steady_clock;

struct Found {
  cl_device_id device;
  cl_platform_id platform;
};

std::vector<Found> find_devices(std::string* problem) {
  std::vector<Found> found;
  cl_uint count = 0;
  std::string why;
  if (clGetPlatformIDs(0, nullptr, &count) != CL_SUCCESS || count == 0) why = "no OpenCL driver is installed";
  std::vector<cl_platform_id> platforms(count);
  if (count > 0) clGetPlatformIDs(count, platforms.data(), nullptr);
  for (const cl_platform_id platform : platforms) {
    cl_uint devices = 0;
    const cl_int error = clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 0, nullptr, &devices);
    if (error != CL_SUCCESS || devices == 0) {
      why += (why.empty() ? "" : ", ") + text(platform, CL_PLATFORM_NAME) + " has no device";
      continue;
    }
    std::vector<cl_device_id> ids(devices);
    clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, devices, ids.data(), nullptr);
    for (const cl_device_id id : ids) found.push_back({id, platform});
  }
  if (problem) {
    *problem = found.empty() ? "OpenCL: " + why + "; install a driver for your GPU, or one that runs on this CPU "
                                                  "(Debian: apt-get install pocl-opencl-icd)"
                             : "";
  }
  return found;
}

DeviceInfo describe(const Found& found, int index) {
  DeviceInfo info;
  info.index = index;
  info.api = Api::opencl;
  info.name = text(found.device, CL_DEVICE_NAME);
  info.driver = driver_of(found.device);
  info.profile = profile_of(found.device);
  info.id = "opencl:" + info.name;
  return info;
}

struct DeviceMemory final : Memory {
  DeviceMemory(const Context* owner, Resource resource, std::size_t bytes, OwnedMemory memory)
      : Memory(owner, std::move(resource), bytes), handle(std::move(memory)) {}
  const OwnedMemory handle;
};

struct CompiledPlan final : Program {
  CompiledPlan(const Context* owner, Pipeline pipeline, OwnedMemory scratch)
      : Program(owner), pipeline(std::move(pipeline)), scratch(std::move(scratch)) {}
  const Pipeline pipeline;
  const OwnedMemory scratch;    // null where the plan needs none
  bool tables_current = false;  // scratch holds the tables of an earlier run
  std::mutex mutex;             // held while it runs
};

class OpenClContext final : public Context {
 public:
  OpenClContext(DeviceInfo info, Device device, OwnedContext context, OwnedQueue queue)
      : info_(std::move(info)), device_(std::move(device)), context_(std::move(context)), queue_(std::move(queue)) {}

  const DeviceInfo& info() const override { return info_; }
  const Profile& profile() const override { return device_.profile(); }
  Result<std::shared_ptr<Memory>> make(const Resource& resource, std::size_t bytes) override;
  Status upload(Memory& memory, const void* data, std::size_t bytes) override;
  Status download(Memory& memory, void* data, std::size_t bytes) override;
  Result<std::shared_ptr<Program>> compile(const Plan& plan) override;
  Status run(Program& program, const std::vector<Named>& resources, Times* times) override {
    return run_many(program, resources, 1, times);
  }
  Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) override;

 private:
  Result<OwnedMemory> make_image(const Resource& resource);
  Status check_copy(const Memory& memory, std::size_t bytes, const char* verb) const;

  DeviceInfo info_;
  Device device_;
  OwnedContext context_;
  OwnedQueue queue_;
};

Result<OwnedMemory> OpenClContext::make_image(const Resource& resource) {
  const cl_image_format format = image_format(resource.format);
  cl_image_desc layout{};
  layout.image_type = resource.extent[2] > 1 ? CL_MEM_OBJECT_IMAGE3D : CL_MEM_OBJECT_IMAGE2D;
  layout.image_width = static_cast<std::size_t>(resource.extent[0]);
  layout.image_height = static_cast<std::size_t>(resource.extent[1]);
  layout.image_depth = static_cast<std::size_t>(resource.extent[2]);
  cl_int error = CL_SUCCESS;
  OwnedMemory image(clCreateImage(context_.get(), CL_MEM_READ_WRITE, &format, &layout, nullptr, &error));
  if (error != CL_SUCCESS)
    return failure(error, "image " + resource.name + " of " + std::to_string(resource.extent[0]) + "x" +
                              std::to_string(resource.extent[1]) + "x" + std::to_string(resource.extent[2]) + " " +
                              name(resource.format) + " could not be made on " + info_.name);
  return image;
}

Result<std::shared_ptr<Memory>> OpenClContext::make(const Resource& resource, std::size_t bytes) {
  OwnedMemory memory;
  if (resource.kind == ResourceKind::buffer) {
    bytes = std::max({bytes, resource.bytes, std::size_t{1}});
    cl_int error = CL_SUCCESS;
    memory = OwnedMemory(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, bytes, nullptr, &error));
    if (error != CL_SUCCESS)
      return failure(error, "buffer " + resource.name + " of " + std::to_string(bytes) +
                                " bytes could not be made on " + info_.name);
  } else {
    for (const int side : resource.extent) {
      if (side < 1)
        return Status(Code::invalid_argument, "Resource.extent of " + resource.name + " has a side of " +
                                                  std::to_string(side) + "; expected at least 1");
    }
    Result<OwnedMemory> image = make_image(resource);
    if (!image) return image.status();
    memory = std::move(image).value();
    bytes = bytes_per_pixel(resource.format);
    for (const int side : resource.extent) bytes *= static_cast<std::size_t>(side);
  }
  return std::shared_ptr<Memory>(std::make_shared<DeviceMemory>(this, resource, bytes, std::move(memory)));
}

Status OpenClContext::check_copy(const Memory& memory, std::size_t bytes, const char* verb) const {
  const auto bad = [&](const std::string& what) {
    return Status(Code::invalid_argument, std::string(verb) + " of " + memory.resource.name + ": " + what);
  };
  if (memory.owner != this) return bad("its memory belongs to another device");
  if (memory.resource.kind != ResourceKind::buffer && bytes != memory.bytes)
    return bad(std::to_string(bytes) + " bytes; expected the image's " + std::to_string(memory.bytes));
  if (bytes > memory.bytes)
    return bad(std::to_string(bytes) + " bytes; expected at most " + std::to_string(memory.bytes));
  return {};
}

std::array<std::size_t, 3> region_of(const Resource& resource) {
  return {static_cast<std::size_t>(resource.extent[0]), static_cast<std::size_t>(resource.extent[1]),
          static_cast<std::size_t>(resource.extent[2])};
}

Status OpenClContext::upload(Memory& memory, const void* data, std::size_t bytes) {
  if (Status status = check_copy(memory, bytes, "upload"); !status || bytes == 0) return status;
  const cl_mem handle = static_cast<DeviceMemory&>(memory).handle.get();
  cl_int error = CL_SUCCESS;
  if (memory.resource.kind == ResourceKind::buffer) {
    error = clEnqueueWriteBuffer(queue_.get(), handle, CL_TRUE, 0, bytes, data, 0, nullptr, nullptr);
  } else {
    const std::array<std::size_t, 3> origin{}, region = region_of(memory.resource);
    error = clEnqueueWriteImage(queue_.get(), handle, CL_TRUE, origin.data(), region.data(), 0, 0, data, 0, nullptr,
                                nullptr);
  }
  return error == CL_SUCCESS ? Status() : failure(error, "upload of " + memory.resource.name);
}

Status OpenClContext::download(Memory& memory, void* data, std::size_t bytes) {
  if (Status status = check_copy(memory, bytes, "download"); !status || bytes == 0) return status;
  const cl_mem handle = static_cast<DeviceMemory&>(memory).handle.get();
  cl_int error = CL_SUCCESS;
  if (memory.resource.kind == ResourceKind::buffer) {
    error = clEnqueueReadBuffer(queue_.get(), handle, CL_TRUE, 0, bytes, data, 0, nullptr, nullptr);
  } else {
    const std::array<std::size_t, 3> origin{}, region = region_of(memory.resource);
    error = clEnqueueReadImage(queue_.get(), handle, CL_TRUE, origin.data(), region.data(), 0, 0, data, 0, nullptr,
                               nullptr);
  }
  return error == CL_SUCCESS ? Status() : failure(error, "download of " + memory.resource.name);
}

Result<std::shared_ptr<Program>> OpenClContext::compile(const Plan& plan) {
  Result<Pipeline> pipeline = Pipeline::create(device_, plan);
  if (!pipeline) return pipeline.status();
  OwnedMemory scratch;
  if (plan.scratch_bytes > 0) {
    cl_int error = CL_SUCCESS;
    scratch = OwnedMemory(clCreateBuffer(context_.get(), CL_MEM_READ_WRITE, plan.scratch_bytes, nullptr, &error));
    if (error != CL_SUCCESS)
      return failure(error, plan.kernel + ": scratch of " + std::to_string(plan.scratch_bytes) +
                                " bytes could not be made on " + info_.name);
  }
  return std::shared_ptr<Program>(
      std::make_shared<CompiledPlan>(this, std::move(pipeline).value(), std::move(scratch)));
}

bool names_scratch(const std::vector<Named>& resources) {
  return std::any_of(resources.begin(), resources.end(), [](const Named& named) { return named.name == "scratch"; });
}

std::vector<Binding> bindings_of(const CompiledPlan& program, const std::vector<Named>& resources) {
  std::vector<Binding> bindings;
  for (const Named& named : resources) {
    const std::size_t offset = offset_bytes(program.pipeline.plan(), named, false);
    bindings.push_back({named.name, static_cast<DeviceMemory&>(*named.memory).handle.get(), offset,
                        named.memory->bytes - offset});
  }
  if (program.scratch && !names_scratch(resources))
    bindings.push_back({"scratch", program.scratch.get(), 0, program.pipeline.plan().scratch_bytes});
  return bindings;
}

/// Sums each pass's time by the device's clock over all runs; empty where the driver kept none.
void sum_pass_times(const std::vector<OwnedEvent>& events, std::size_t passes, Times& times) {
  times.passes.assign(passes, 0.0);
  for (std::size_t i = 0; i < events.size(); ++i) {
    cl_ulong begin = 0, end = 0;
    if (clGetEventProfilingInfo(events[i].get(), CL_PROFILING_COMMAND_START, sizeof begin, &begin, nullptr) !=
            CL_SUCCESS ||
        clGetEventProfilingInfo(events[i].get(), CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr) != CL_SUCCESS) {
      times.passes.clear();
      return;
    }
    times.passes[i % passes] += static_cast<double>(end - begin) * 1e-6;
  }
}

Status OpenClContext::run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) {
  if (program.owner != this)
    return Status(Code::invalid_argument, "the program was compiled for another device than " + info_.name);
  auto& compiled = static_cast<CompiledPlan&>(program);
  const std::lock_guard lock(compiled.mutex);
  const Plan& plan = compiled.pipeline.plan();
  if (repeat < 1)
    return Status(Code::invalid_argument,
                  plan.kernel + ": repeat is " + std::to_string(repeat) + "; expected at least 1");
  if (Status status = check_memories(this, plan, resources); !status) return status;
  const std::vector<Binding> bindings = bindings_of(compiled, resources);
  const bool own_scratch = !names_scratch(resources);

  const Clock::time_point begin = Clock::now();
  std::vector<OwnedEvent> events;
  Status status;
  for (int i = 0; i < repeat && status; ++i) {
    std::vector<cl_event> pass_events;
    Enqueue options;
    options.pass_events = &pass_events;
    options.tables_current = i > 0 || (own_scratch && compiled.tables_current);
    status = compiled.pipeline.enqueue(queue_.get(), bindings, options);
    for (const cl_event event : pass_events) events.emplace_back(event);
  }
  cl_int error = clFinish(queue_.get());
  if (!status) return status;
  for (const OwnedEvent& event : events) {
    cl_int state = CL_COMPLETE;
    clGetEventInfo(event.get(), CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof state, &state, nullptr);
    if (error == CL_SUCCESS && state < 0) error = state;
  }
  if (error != CL_SUCCESS) return failure(error, plan.kernel + ": run on " + info_.name);
  compiled.tables_current = compiled.tables_current || own_scratch;
  if (times) {
    times->total = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    sum_pass_times(events, plan.passes.size(), *times);
  }
  return {};
}

}  // namespace

std::vector<DeviceInfo> list(std::string* problem) {
  std::vector<DeviceInfo> infos;
  for (const Found& found : find_devices(problem)) infos.push_back(describe(found, static_cast<int>(infos.size())));
  return infos;
}

Result<std::shared_ptr<Context>> open(int index) {
  std::string problem;
  const std::vector<Found> devices = find_devices(&problem);
  if (devices.empty()) return Status(Code::missing_driver, problem);
  if (index < 0 || static_cast<std::size_t>(index) >= devices.size())
    return Status(Code::missing_driver, "OpenCL device " + std::to_string(index) + " does not exist; expected 0.." +
                                            std::to_string(devices.size() - 1));
  const Found& found = devices[static_cast<std::size_t>(index)];
  DeviceInfo info = describe(found, index);
  const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM,
                                              reinterpret_cast<cl_context_properties>(found.platform), 0};
  cl_int error = CL_SUCCESS;
  OwnedContext context(clCreateContext(properties, 1, &found.device, nullptr, nullptr, &error));
  if (error != CL_SUCCESS) return failure(error, "a context on " + info.name + " could not be made");
  OwnedQueue queue(clCreateCommandQueue(context.get(), found.device, CL_QUEUE_PROFILING_ENABLE, &error));
  if (error != CL_SUCCESS) return failure(error, "a queue on " + info.name + " could not be made");
  Result<Device> device = Device::adopt({context.get(), found.device, cache_directory()});
  if (!device) return device.status();
  return std::shared_ptr<Context>(std::make_shared<OpenClContext>(std::move(info), std::move(device).value(),
                                                                  std::move(context), std::move(queue)));
}

}  // namespace luxel::opencl

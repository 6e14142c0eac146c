// The OpenCL execution: what it refuses, and that what it accepts runs in order, on any queue, within its bindings.
#include <functional>
#include <thread>

#include <luxel/gaussian_blur.h>
#include <luxel/reference.h>

#include "tests/support/opencl.h"

namespace luxel::opencl {
namespace {

constexpr int width = 37, height = 19;
constexpr std::size_t image_bytes = std::size_t{width} * height * 16;

Plan blur_plan(const Profile& profile, Input input = Input::buffer) {
  GaussianBlurParams params;
  params.width = width;
  params.height = height;
  params.sigma = 2.0;
  params.input = input;
  Result<Plan> result = plan(params, profile);
  EXPECT_TRUE(result.ok()) << result.status().message();
  return std::move(result).value();
}

std::vector<float> picture() {
  std::vector<float> pixels(image_bytes / 4);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<float>((i * 2654435761u >> 8) % 4096) / 4096.0f;
  return pixels;
}

std::vector<float> blurred(const std::vector<float>& input) {
  std::vector<float> source = input, result(input.size());
  const Status status = reference::run(blur_plan(luxel::profile("reference")),
                                       {{"src", source.data(), image_bytes}, {"dst", result.data(), image_bytes}});
  EXPECT_TRUE(status.ok()) << status.message();
  return result;
}

class OpenCl : public testing::Test {
 protected:
  OpenCl() : machine(Machine::open()), queue(machine.queue()) {}

  Pipeline pipeline(Plan plan) const {
    Result<Pipeline> made = Pipeline::create(machine.device, std::move(plan));
    EXPECT_TRUE(made.ok()) << made.status().message();
    if (!made.ok()) std::exit(1);
    return std::move(made).value();
  }
  Plan blur() const { return blur_plan(machine.device.profile()); }
  std::size_t alignment() const { return value<cl_uint>(machine.id, CL_DEVICE_MEM_BASE_ADDR_ALIGN) / 8; }

  OwnedMemory image(int w, int h, cl_image_format format, int depth = 0) const {
    cl_image_desc layout{};
    layout.image_type = depth ? CL_MEM_OBJECT_IMAGE3D : CL_MEM_OBJECT_IMAGE2D;
    layout.image_width = static_cast<std::size_t>(w);
    layout.image_height = static_cast<std::size_t>(h);
    layout.image_depth = static_cast<std::size_t>(depth);
    cl_int error = CL_SUCCESS;
    OwnedMemory made(clCreateImage(machine.context.get(), CL_MEM_READ_WRITE, &format, &layout, nullptr, &error));
    EXPECT_EQ(error, CL_SUCCESS);
    return made;
  }

  Machine machine;
  OwnedQueue queue;
};

void expect_refused(const Status& status, Code code, const std::string& message) {
  EXPECT_STREQ(name(status.code()), name(code));
  EXPECT_EQ(status.message(), message);
}

TEST_F(OpenCl, AdoptRefusesWhatIsNoDeviceOfTheContext) {
  expect_refused(Device::adopt({nullptr, machine.id, ""}).status(), Code::invalid_argument,
                 "opencl::Adopt.context is null; expected a cl_context");
  expect_refused(Device::adopt({machine.context.get(), nullptr, ""}).status(), Code::invalid_argument,
                 "opencl::Adopt.device is null; expected a cl_device_id");
  const cl_device_partition_property halves[] = {CL_DEVICE_PARTITION_EQUALLY, 1, 0};
  cl_device_id part = nullptr;
  if (clCreateSubDevices(machine.id, halves, 1, &part, nullptr) != CL_SUCCESS && !part) return;
  expect_refused(Device::adopt({machine.context.get(), part, ""}).status(), Code::invalid_argument,
                 "opencl::Adopt.device is not one of the context's devices");
  clReleaseDevice(part);
}

TEST_F(OpenCl, EmptyDevicesAndPipelinesAreRefused) {
  EXPECT_EQ(Pipeline::create(Device(), blur()).status().code(), Code::invalid_argument);
  EXPECT_EQ(Pipeline().clone().status().code(), Code::invalid_argument);
  EXPECT_EQ(Pipeline().enqueue(queue.get(), {}).code(), Code::invalid_argument);
}

TEST_F(OpenCl, DeviceTellsNameDriverAndProfile) {
  EXPECT_EQ(machine.device.name(), text(machine.id, CL_DEVICE_NAME));
  EXPECT_NE(machine.device.driver().find(text(machine.id, CL_DRIVER_VERSION)), std::string::npos);
  const bool cpu = value<cl_device_type>(machine.id, CL_DEVICE_TYPE) & CL_DEVICE_TYPE_CPU;
  EXPECT_EQ(machine.device.profile().name, cpu ? "pocl" : "opencl_gpu");
}

TEST_F(OpenCl, EveryWrongBindingIsRefusedBeforeAnythingIsEnqueued) {
  const Pipeline blur_pipeline = pipeline(blur());
  const std::size_t scratch_bytes = blur_pipeline.plan().scratch_bytes;
  const OwnedMemory src = machine.buffer(image_bytes), dst = machine.buffer(2 * image_bytes),
                    scratch = machine.buffer(scratch_bytes), small = machine.buffer(100),
                    constant = machine.buffer(image_bytes, CL_MEM_READ_ONLY),
                    sink = machine.buffer(image_bytes, CL_MEM_WRITE_ONLY),
                    sealed = machine.buffer(scratch_bytes, CL_MEM_HOST_NO_ACCESS | CL_MEM_READ_WRITE),
                    picture = image(width, height, {CL_RGBA, CL_FLOAT});
  const Machine other = Machine::open();
  const OwnedMemory foreign = other.buffer(image_bytes);
  const std::string need = std::to_string(image_bytes), scratch_need = std::to_string(scratch_bytes);

  struct Case {
    std::function<void(std::vector<Binding>&)> change;
    std::string message;
  };
  const std::vector<Case> cases = {
      {[](auto& b) { b.erase(b.begin() + 1); }, "binding dst is missing; expected src, dst, scratch"},
      {[](auto& b) { b.pop_back(); }, "binding scratch is missing; needs at least " + scratch_need + " bytes"},
      {[](auto& b) { b[0].name = "source"; }, "binding source is unknown; expected src, dst, scratch"},
      {[](auto& b) { b.push_back(b[0]); }, "binding src is given twice"},
      {[](auto& b) { b[1].memory = nullptr; }, "binding dst has no memory; expected a cl_mem"},
      {[](auto& b) { b[1].bytes = 100; }, "binding dst has 100 bytes; needs at least " + need},
      {[&](auto& b) { b[1].memory = small.get(); },
       "binding dst claims " + need + " bytes from offset 0, but its memory object has 100"},
      {[&](auto& b) { b[1].offset = image_bytes + alignment(); },
       "binding dst claims " + need + " bytes from offset " + std::to_string(image_bytes + alignment()) +
           ", but its memory object has " + std::to_string(2 * image_bytes)},
      {[](auto& b) { b[1].offset = static_cast<std::size_t>(-64); },
       "binding dst claims " + need + " bytes from offset 18446744073709551552, but its memory object has " +
           std::to_string(2 * image_bytes)},
      {[](auto& b) { b[1].offset = 4; },
       "binding dst has offset 4; expected a multiple of " + std::to_string(alignment()) + " bytes"},
      {[](auto& b) { b[2].bytes -= 1; },
       "binding scratch has " + std::to_string(scratch_bytes - 1) + " bytes; needs at least " + scratch_need},
      {[&](auto& b) { b[0].memory = picture.get(); }, "binding src is an image; expected a buffer"},
      {[&](auto& b) { b[1].memory = constant.get(); }, "binding dst is CL_MEM_READ_ONLY, but is written"},
      {[&](auto& b) { b[0].memory = sink.get(); }, "binding src is CL_MEM_WRITE_ONLY, but is read"},
      {[&](auto& b) { b[2].memory = sealed.get(); },
       "binding scratch forbids the host to write, but tables are written to it"},
      {[&](auto& b) { b[0].memory = foreign.get(); }, "binding src belongs to another context"},
      {[&](auto& b) { b[0].memory = b[2].memory; b[0].bytes = b[2].bytes; },
       "bindings src and scratch overlap; this plan needs them apart"},
  };
  write(queue.get(), dst, std::vector<float>(image_bytes / 2, -7.0f));
  for (const Case& wrong : cases) {
    std::vector<Binding> bindings = {{"src", src.get(), 0, image_bytes},
                                     {"dst", dst.get(), 0, image_bytes},
                                     {"scratch", scratch.get(), 0, scratch_bytes}};
    wrong.change(bindings);
    cl_event done = nullptr;
    Enqueue options;
    options.done = &done;
    expect_refused(blur_pipeline.enqueue(queue.get(), bindings, options), Code::invalid_argument,
                   "gaussian_blur: " + wrong.message);
    EXPECT_EQ(done, nullptr);
  }
  EXPECT_EQ(read<float>(queue.get(), dst, image_bytes / 2), std::vector<float>(image_bytes / 2, -7.0f));

  const std::vector<Binding> good = {{"src", src.get(), 0, image_bytes},
                                     {"dst", dst.get(), 0, image_bytes},
                                     {"scratch", scratch.get(), 0, scratch_bytes}};
  expect_refused(blur_pipeline.enqueue(nullptr, good), Code::invalid_argument,
                 "gaussian_blur: queue is null; expected a cl_command_queue");
  expect_refused(blur_pipeline.enqueue(other.queue().get(), good), Code::invalid_argument,
                 "gaussian_blur: queue belongs to another device; expected one of " + machine.device.name());
  Enqueue options;
  options.wait_count = 2;
  expect_refused(blur_pipeline.enqueue(queue.get(), good, options), Code::invalid_argument,
                 "gaussian_blur: Enqueue.wait_count is 2 and wait is null; expected both or neither");
  const cl_event nothing = nullptr;
  options = {&nothing, 1};
  expect_refused(blur_pipeline.enqueue(queue.get(), good, options), Code::invalid_argument,
                 "gaussian_blur: Enqueue.wait[0] is null; expected a cl_event");
}

TEST_F(OpenCl, WrongImagesAreRefused) {
  const Pipeline from_image = pipeline(blur_plan(machine.device.profile(), Input::image));
  const std::size_t scratch_bytes = from_image.plan().scratch_bytes;
  const OwnedMemory dst = machine.buffer(image_bytes), scratch = machine.buffer(scratch_bytes);
  const auto with = [&](const OwnedMemory& src) {
    return from_image.enqueue(queue.get(), {{"src", src.get()}, {"dst", dst.get(), 0, image_bytes},
                                            {"scratch", scratch.get(), 0, scratch_bytes}});
  };
  expect_refused(with(machine.buffer(image_bytes)), Code::invalid_argument,
                 "gaussian_blur: binding src is no 2-D or 3-D image; expected an image");
  expect_refused(with(image(width, height + 1, {CL_RGBA, CL_FLOAT})), Code::invalid_argument,
                 "gaussian_blur: binding src has 37x20x1 texels; expected 37x19x1");
  expect_refused(with(image(width, height, {CL_RGBA, CL_UNORM_INT8})), Code::invalid_argument,
                 "gaussian_blur: binding src has another texel format; expected f32x4");
  expect_refused(with(image(width, height, {CL_RGBA, CL_FLOAT}, 1)), Code::invalid_argument,
                 "gaussian_blur: binding src is a 3-D image; expected 2-D");
}

TEST_F(OpenCl, LimitsAreNamedWithValueAndNeed) {
  Plan plan = blur();
  plan.passes[1].workgroup = {1u << 20, 1, 1};
  Status status = Pipeline::create(machine.device, plan).status();
  EXPECT_EQ(status.code(), Code::unsupported);
  EXPECT_NE(status.message().find("; pass gaussian_blur columns needs 1048576 invocations"), std::string::npos)
      << status.message();

  plan = blur();
  plan.scratch_bytes = std::size_t{1} << 50;
  expect_refused(Pipeline::create(machine.device, plan).status(), Code::unsupported,
                 "gaussian_blur: CL_DEVICE_MAX_MEM_ALLOC_SIZE of " + machine.device.name() + " is " +
                     std::to_string(value<cl_ulong>(machine.id, CL_DEVICE_MAX_MEM_ALLOC_SIZE)) +
                     " bytes; scratch needs 1125899906842624 bytes");

  plan = blur_plan(machine.device.profile(), Input::image);
  plan.resources[0].extent[0] = 1 << 24;
  status = Pipeline::create(machine.device, plan).status();
  EXPECT_EQ(status.code(), Code::unsupported);
  EXPECT_NE(status.message().find("; src needs 16777216x19 texels"), std::string::npos) << status.message();

  Module module = tiny_module();
  const SharedInfo tile[] = {{std::size_t{1} << 40, "tile"}};
  module.shared = tile;
  status = Pipeline::create(machine.device, tiny_plan(module, 100, 1)).status();
  EXPECT_EQ(status.code(), Code::unsupported);
  EXPECT_NE(status.message().find("CL_DEVICE_LOCAL_MEM_SIZE of "), std::string::npos);
  EXPECT_NE(status.message().find("; pass step 0 needs 1099511627776 bytes"), std::string::npos) << status.message();

  plan = blur();
  plan.scratch.back().offset += alignment() / 2;
  plan.scratch_bytes += alignment();
  status = Pipeline::create(machine.device, plan).status();
  EXPECT_EQ(status.code(), Code::unsupported);
  EXPECT_NE(status.message().find("CL_DEVICE_MEM_BASE_ADDR_ALIGN of "), std::string::npos) << status.message();
}

TEST_F(OpenCl, DefectivePlansAreCalledInternal) {
  const auto code = [&](const std::function<void(Plan&)>& change) {
    Plan plan = blur();
    change(plan);
    return Pipeline::create(machine.device, plan).status().code();
  };
  EXPECT_EQ(code([](Plan& p) { p.passes[0].parameters.pop_back(); }), Code::internal);
  EXPECT_EQ(code([](Plan& p) { p.passes[0].slots[0].index = 7; }), Code::internal);
  EXPECT_EQ(code([](Plan& p) { p.passes[0].groups[1] = 0; }), Code::internal);
  EXPECT_EQ(code([](Plan& p) { p.passes[0].module = nullptr; }), Code::internal);
  EXPECT_EQ(code([](Plan& p) { p.scratch_bytes = table_bytes; }), Code::internal);
  EXPECT_EQ(code([](Plan& p) { p.tables[0].resize(5000); }), Code::internal);
  EXPECT_EQ(code([](Plan& p) { p.passes[0].slots[1] = {Slot::Source::resource, 1}; }), Code::internal)
      << "dst is written in the pass that reads src, but they may alias";
}

TEST_F(OpenCl, GuardBandsStayAndBitsEqualTheReference) {
  const Pipeline blur_pipeline = pipeline(blur());
  const std::size_t scratch_bytes = blur_pipeline.plan().scratch_bytes, guard = 4096;
  const OwnedMemory src = machine.buffer(image_bytes + 2 * guard), dst = machine.buffer(image_bytes + 2 * guard),
                    scratch = machine.buffer(scratch_bytes + 2 * guard);
  const std::vector<float> input = picture(), band(guard / 4, -123.0f);
  for (const OwnedMemory* memory : {&src, &dst, &scratch}) {
    const std::size_t bytes = memory == &scratch ? scratch_bytes : image_bytes;
    write(queue.get(), *memory, std::vector<float>((bytes + 2 * guard) / 4, -123.0f));
  }
  write(queue.get(), src, input, guard);
  const Status status = blur_pipeline.enqueue(queue.get(), {{"scratch", scratch.get(), guard, scratch_bytes},
                                                            {"dst", dst.get(), guard, image_bytes},
                                                            {"src", src.get(), guard, image_bytes}});
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(read<float>(queue.get(), dst, input.size(), guard), blurred(input));
  for (const OwnedMemory* memory : {&src, &dst, &scratch}) {
    const std::size_t bytes = memory == &scratch ? scratch_bytes : image_bytes;
    EXPECT_EQ(read<float>(queue.get(), *memory, guard / 4, 0), band);
    EXPECT_EQ(read<float>(queue.get(), *memory, guard / 4, guard + bytes), band);
  }
}

TEST_F(OpenCl, OneMemoryObjectMayServeSeveralBindings) {
  const Pipeline blur_pipeline = pipeline(blur());
  const std::size_t scratch_bytes = blur_pipeline.plan().scratch_bytes, part = (image_bytes + 4095) / 4096 * 4096;
  const OwnedMemory all = machine.buffer(2 * part + scratch_bytes);
  const std::vector<float> input = picture();
  write(queue.get(), all, input);
  const Binding src{"src", all.get(), 0, image_bytes}, scratch{"scratch", all.get(), 2 * part, scratch_bytes};
  Status status = blur_pipeline.enqueue(queue.get(), {src, {"dst", all.get(), part, image_bytes}, scratch});
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(read<float>(queue.get(), all, input.size(), part), blurred(input));

  // A sub-buffer of the caller's, bound at an offset of its own.
  const cl_buffer_region region{part, part + scratch_bytes};
  cl_int error = CL_SUCCESS;
  const OwnedMemory rest(clCreateSubBuffer(all.get(), 0, CL_BUFFER_CREATE_TYPE_REGION, &region, &error));
  ASSERT_EQ(error, CL_SUCCESS);
  write(queue.get(), all, std::vector<float>(input.size(), 0.0f), part);
  status = blur_pipeline.enqueue(
      queue.get(), {src, {"dst", rest.get(), 0, image_bytes}, {"scratch", rest.get(), part, scratch_bytes}});
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(read<float>(queue.get(), all, input.size(), part), blurred(input));
  expect_refused(blur_pipeline.enqueue(queue.get(), {src, {"dst", rest.get(), 0, image_bytes},
                                                     {"scratch", all.get(), 2 * part - alignment(), scratch_bytes}}),
                 Code::ok, "");
  expect_refused(blur_pipeline.enqueue(queue.get(), {src, {"dst", rest.get(), 0, image_bytes},
                                                     {"scratch", all.get(), part, scratch_bytes}}),
                 Code::invalid_argument, "gaussian_blur: bindings dst and scratch overlap; this plan needs them apart");

  // In place: src and dst are the same memory, which this plan allows.
  status = blur_pipeline.enqueue(queue.get(), {src, {"dst", all.get(), 0, image_bytes}, scratch});
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(read<float>(queue.get(), all, input.size()), blurred(input));
}

TEST_F(OpenCl, CallersMemoryIsNotHeld) {
  const Pipeline blur_pipeline = pipeline(blur());
  const std::size_t scratch_bytes = blur_pipeline.plan().scratch_bytes;
  const OwnedMemory src = machine.buffer(image_bytes + 4096), dst = machine.buffer(image_bytes),
                    scratch = machine.buffer(scratch_bytes);
  ASSERT_TRUE(blur_pipeline.enqueue(queue.get(), {{"src", src.get(), 4096, image_bytes},
                                                  {"dst", dst.get(), 0, image_bytes},
                                                  {"scratch", scratch.get(), 0, scratch_bytes}}).ok());
  clFinish(queue.get());
  for (const OwnedMemory* memory : {&src, &dst, &scratch}) {
    cl_uint count = 0;
    clGetMemObjectInfo(memory->get(), CL_MEM_REFERENCE_COUNT, sizeof count, &count, nullptr);
    EXPECT_EQ(count, 1u);
  }
}

}  // namespace
}  // namespace luxel::opencl

// luxel in an engine of one's own on OpenCL: the engine's context, its buffers, its out-of-order queue, its events. Two
// chains of kernels that know nothing of each other run side by side, and one kernel waits for both:
//   bilateral (denoise)  ->  gaussian_blur (bloom of what is clean)      mip_build (nearest depths)
// Results are compared with the C++ execution, bit for bit, and shown.
//
//   opencl_engine [PICTURE.ppm]
#include <luxel/opencl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <luxel/bilateral.h>
#include <luxel/gaussian_blur.h>
#include <luxel/mip_build.h>
#include <luxel/reference.h>

namespace {

constexpr int width = 320, height = 200;
constexpr std::size_t pixels = static_cast<std::size_t>(width) * height;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "opencl_engine: %s\n", what.c_str());
  std::exit(1);
}
void check(cl_int error, const char* what) {
  if (error != CL_SUCCESS) fail(std::string(what) + " gave " + std::to_string(error));
}
void check(const luxel::Status& status) {
  if (!status) fail(status.message());
}
template <class T> T take(luxel::Result<T> result) {
  if (!result) fail(result.status().message());
  return std::move(result).value();
}

// A floor and lamps, with the noise of one sample a pixel; depth of the same.
void draw(std::vector<float>& colour, std::vector<float>& depth) {
  colour.assign(4 * pixels, 1.0f);
  depth.assign(pixels, 0.0f);
  std::uint32_t random = 17;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      depth[i] = 12.0f - 8.0f * static_cast<float>(y) / height;
      float light[3] = {0.18f, 0.20f, 0.24f};
      for (int lamp = 0; lamp < 7; ++lamp) {
        const float cx = 25.0f + 45.0f * static_cast<float>(lamp), cy = 100.0f + 60.0f * std::sin(2.0f * static_cast<float>(lamp));
        const float d = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (18.0f * 18.0f);
        if (d >= 1.0f) continue;
        depth[i] = 3.0f - std::sqrt(1.0f - d);
        for (int c = 0; c < 3; ++c) light[c] = (lamp % 3 == 0 ? 5.0f : 0.8f) * (0.3f + 0.35f * static_cast<float>((lamp + c) % 3));
      }
      random = random * 1664525u + 1013904223u;
      for (std::size_t c = 0; c < 3; ++c)
        colour[4 * i + c] = light[c] * (0.4f + 1.2f * static_cast<float>(random >> 8) / 16777216.0f);
    }
}

constexpr int denoise = 0, bloom = 1, nearest = 2, kernels = 3;

luxel::Result<luxel::Plan> plan_of(int kernel, const luxel::Profile& profile) {
  if (kernel == denoise) {
    luxel::BilateralParams p;
    p.width = width, p.height = height, p.sigma_space = 2, p.sigma_range = 2;
    p.depth = luxel::DepthTerm::plane, p.footprint = 0.005;
    return luxel::plan(p, profile);
  }
  if (kernel == bloom) {
    luxel::GaussianBlurParams p;
    p.width = width, p.height = height, p.sigma = 8;
    return luxel::plan(p, profile);
  }
  luxel::MipBuildParams p;
  p.width = width, p.height = height, p.variant = luxel::MipVariant::min, p.format = luxel::Format::f32x1;
  return luxel::plan(p, profile);
}

// Which of the engine's buffers a kernel's resource is.
std::string role(int kernel, const std::string& resource) {
  if (resource == "src") return kernel == denoise ? "colour" : "clean";
  if (resource == "depth" || resource == "level_0") return "depth";
  if (resource == "dst") return kernel == denoise ? "clean" : "glow";
  return resource;  // level_1 and so on
}

}  // namespace

int main(int argc, char** argv) {
  // The engine: a device, a context, a queue that may run in any order, buffers.
  cl_platform_id platform = nullptr;
  cl_device_id device = nullptr;
  check(clGetPlatformIDs(1, &platform, nullptr), "clGetPlatformIDs");
  check(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr), "clGetDeviceIDs");
  cl_int error = CL_SUCCESS;
  cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, &error);
  check(error, "clCreateContext");
  cl_command_queue queue = clCreateCommandQueue(context, device, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &error);
  check(error, "clCreateCommandQueue");
  std::map<std::string, cl_mem> buffers;
  std::map<std::string, std::size_t> sizes;
  const auto buffer = [&](const std::string& name, std::size_t bytes) {
    if (!buffers.count(name)) {
      buffers[name] = clCreateBuffer(context, CL_MEM_READ_WRITE, bytes, nullptr, &error);
      check(error, "clCreateBuffer");
      sizes[name] = bytes;
    }
    return buffers[name];
  };

  // luxel borrows context and device; pipelines are compiled ahead.
  auto borrowed = take(luxel::opencl::Device::adopt({context, device, ""}));
  std::vector<luxel::opencl::Pipeline> pipelines;
  std::vector<luxel::opencl::Binding> bound[kernels];
  for (int k = 0; k < kernels; ++k) {
    pipelines.push_back(take(luxel::opencl::Pipeline::create(borrowed, take(plan_of(k, borrowed.profile())))));
    const luxel::Plan& plan = pipelines.back().plan();
    for (const luxel::Resource& r : plan.resources) bound[k].push_back({r.name, buffer(role(k, r.name), r.bytes), 0, r.bytes});
    // Each its own scratch, since they may run at the same time.
    if (plan.scratch_bytes > 0)
      bound[k].push_back({"scratch", buffer("scratch " + std::to_string(k), plan.scratch_bytes), 0, plan.scratch_bytes});
  }

  std::vector<float> colour, depth;
  draw(colour, depth);
  cl_event uploaded[2], cleaned, glowing, pyramid;
  check(clEnqueueWriteBuffer(queue, buffers["colour"], CL_FALSE, 0, 16 * pixels, colour.data(), 0, nullptr, &uploaded[0]), "write");
  check(clEnqueueWriteBuffer(queue, buffers["depth"], CL_FALSE, 0, 4 * pixels, depth.data(), 0, nullptr, &uploaded[1]), "write");
  // Nothing but events orders an out-of-order queue: what reads waits for what writes. A plan's passes keep their own order.
  luxel::opencl::Enqueue run;
  run.wait = uploaded, run.wait_count = 2, run.done = &cleaned;
  check(pipelines[denoise].enqueue(queue, bound[denoise], run));
  run.wait = &cleaned, run.wait_count = 1, run.done = &glowing;
  check(pipelines[bloom].enqueue(queue, bound[bloom], run));
  run.wait = &uploaded[1], run.wait_count = 1, run.done = &pyramid;  // beside the two others
  check(pipelines[nearest].enqueue(queue, bound[nearest], run));

  const cl_event last[] = {glowing, pyramid};
  std::map<std::string, std::vector<char>> results;
  for (const auto& [name, memory] : buffers) {
    results[name].resize(sizes[name]);
    check(clEnqueueReadBuffer(queue, memory, CL_TRUE, 0, sizes[name], results[name].data(), 2, last, nullptr), "read");
  }

  // The same with the C++ execution.
  int status = 0;
  std::map<std::string, std::vector<char>> expected;
  expected["colour"].assign(reinterpret_cast<char*>(colour.data()), reinterpret_cast<char*>(colour.data() + colour.size()));
  expected["depth"].assign(reinterpret_cast<char*>(depth.data()), reinterpret_cast<char*>(depth.data() + depth.size()));
  for (int k = 0; k < kernels; ++k) {
    const luxel::Plan plan = take(plan_of(k, luxel::profile("reference")));
    std::vector<luxel::reference::Binding> bindings;
    for (const luxel::Resource& r : plan.resources) {
      std::vector<char>& memory = expected[role(k, r.name)];
      memory.resize(r.bytes);
      bindings.push_back({r.name, memory.data(), memory.size()});
    }
    check(luxel::reference::run(plan, bindings));
  }
  for (const auto& [name, memory] : expected)
    if (memory != results[name]) {
      std::fprintf(stderr, "%s differs from the C++ execution\n", name.c_str());
      status = 1;
    }
  if (status == 0) std::printf("three kernels on an out-of-order queue: the bits of the C++ execution\n");

  if (argc > 1) {
    const auto* clean = reinterpret_cast<const float*>(results["clean"].data());
    const auto* glow = reinterpret_cast<const float*>(results["glow"].data());
    std::FILE* out = std::fopen(argv[1], "wb");
    if (!out) fail(std::string("cannot write ") + argv[1]);
    std::fprintf(out, "P6 %d %d 255\n", width, height);
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = std::clamp(0.7f * clean[4 * i + c] + 0.3f * glow[4 * i + c], 0.0f, 1.0f);
        std::fputc(static_cast<int>(255 * (light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f) + 0.5f), out);
      }
    if (std::fclose(out) != 0) fail(std::string("cannot write ") + argv[1]);
  }

  for (cl_event event : {uploaded[0], uploaded[1], cleaned, glowing, pyramid}) clReleaseEvent(event);
  for (const auto& [name, memory] : buffers) clReleaseMemObject(memory);
  clReleaseCommandQueue(queue);
  pipelines.clear();
  borrowed = {};
  clReleaseContext(context);
  return status;
}

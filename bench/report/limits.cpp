#include "bench/report/limits.h"

#include <chrono>
#include <cstring>
#include <thread>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "host/module.h"

namespace luxel::built_in {
extern const std::span<const Module*const> limit_copy, limit_triad, limit_arithmetic, limit_sample, limit_march, limit_probe;
}

namespace luxel::report {
namespace {

const Module* module_in(std::span<const Module* const> part, std::string_view name) {
  for (const Module* module : part)
    if (module->name == name) return module;
  return nullptr;
}

Resource buffer(const char* name, Format format, std::size_t pixels, bool written) {
  Resource resource{name};
  resource.format = format;
  resource.bytes = pixels * bytes_per_pixel(format);
  resource.written = written;
  return resource;
}

// One pass over rows of `wides` invocations.
Plan one_pass(const char* name, const Module* module, std::vector<Resource> resources, std::vector<double> parameters,
              std::vector<double> constants, std::uint32_t wides, std::uint32_t rows,
              std::array<std::uint32_t, 3> workgroup) {
  Plan plan;
  plan.kernel = name;
  plan.resources = std::move(resources);
  Pass pass;
  pass.module = module;
  pass.label = name;
  for (std::size_t i = 0; i < plan.resources.size(); ++i)
    pass.slots.push_back({Slot::Source::resource, static_cast<int>(i)});
  pass.parameters = std::move(parameters);
  pass.constants = std::move(constants);
  pass.workgroup = workgroup;
  pass.groups = {(wides + workgroup[0] - 1) / workgroup[0], (rows + workgroup[1] - 1) / workgroup[1], 1};
  plan.passes.push_back(std::move(pass));
  return plan;
}

int lanes_of(const Profile& profile, Format format) { return std::max(profile.pixels.lanes, channels(format)); }

Cell entry(const char* what, const std::string& size, double bytes_per_pixel, const std::string& form, const Sample& ms,
           double work, const char* unit) {
  return {{"what", what},
          {"size", size},
          {"bytes_per_pixel", bytes_per_pixel},
          {"form", form},
          {"rate", work / ms.median * 1e-6},
          {"unit", unit},
          {"q1", work / ms.q3 * 1e-6},
          {"q3", work / ms.q1 * 1e-6},
          {"n", ms.n}};
}

Status measure_arithmetic(Session& session) {
  const Profile& profile = session.context().profile();
  const int lanes = lanes_of(profile, Format::f32x4);
  const int invocations = 1 << (session.is_cpu() ? 8 : 14), rounds = 64;
  auto run =
      cases::Run::make(session.context(),
                       one_pass("limit_arithmetic", module_in(built_in::limit_arithmetic, "f32x4"),
                                {buffer("dst", Format::f32x1, static_cast<std::size_t>(invocations) * lanes, true)},
                                {static_cast<double>(invocations), rounds, 0.999, 0.001}, {static_cast<double>(lanes)},
                                static_cast<std::uint32_t>(invocations), 1, {64, 1, 1}));
  if (!run) return run.status();
  const Result<Sample> ms = session.time(run.value(), "limit arithmetic");
  if (!ms) return ms.status();
  session.note("limits", entry("arithmetic", "", 0, "a product and a sum, not contracted", ms.value(),
                               2.0 * 64 * rounds * lanes * invocations, "GFLOP/s"));
  return {};
}

Status measure_triad(Session& session) {
  const int width = 1024, height = 1024;
  const Profile& profile = session.context().profile();
  auto run = cases::Run::make(session.context(), triad_plan(width, height, profile));
  if (!run) return run.status();
  const std::vector<double> ones(static_cast<std::size_t>(width) * height * 4, 1.0);
  for (const char* name : {"b", "c"})
    if (Status status = run.value().write(name, ones); !status) return status;
  const Result<Sample> ms = session.time(run.value(), "limit triad");
  if (!ms) return ms.status();
  session.note("limits", entry("triad", "1024x1024", 16, profile.texels ? "texel buffer" : "buffer", ms.value(),
                               3.0 * 16 * width * height, "GB/s"));
  return {};
}

Status measure_copy(Session& session, const std::string& size, int width, int height, int bytes) {
  Cell best;
  double most = 0;
  for (const CopyForm& form : copy_forms(session)) {
    auto run = cases::Run::make(session.context(), copy_plan(width, height, bytes, form, session.context().profile()));
    if (!run) return run.status();
    if (Status status =
            run.value().write("src", std::vector<double>(static_cast<std::size_t>(width) * height * (bytes / 4), 0.5));
        !status)
      return status;
    const Result<Sample> ms =
        session.time(run.value(), fmt::format("limit copy {} of {} bytes, {}", size, bytes, form.name));
    if (!ms) return ms.status();
    const double rate = 1 / ms.value().median;
    if (rate > most) best = entry("copy", size, bytes, form.name, ms.value(), 2.0 * width * height * bytes, "GB/s");
    most = std::max(most, rate);
  }
  session.note("limits", best);
  return {};
}

}  // namespace

std::vector<CopyForm> copy_forms(Session& session) {
  // The shape of the C++ execution is fixed; elsewhere than on Vulkan a texel buffer is a buffer.
  if (session.is_cpu()) return {{"buffer", false, 1}};
  if (session.context().info().api == Api::opencl) return {{"buffer", false, 1}, {"buffer, 4 pieces", false, 4}};
  return {{"buffer", false, 1},
          {"buffer, 4 pieces", false, 4},
          {"texel buffer", true, 1},
          {"texel buffer, 4 pieces", true, 4}};
}

Result<Plan> triad_plan(int width, int height, const Profile& profile) {
  const int lanes = lanes_of(profile, Format::f32x4);
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  return one_pass("limit_triad", module_in(built_in::limit_triad, profile.texels ? "texels_f32x4" : "f32x4"),
                  {buffer("b", Format::f32x4, pixels, false), buffer("c", Format::f32x4, pixels, false),
                   buffer("a", Format::f32x4, pixels, true)},
                  {static_cast<double>(width), static_cast<double>(height)}, {static_cast<double>(lanes)},
                  static_cast<std::uint32_t>(width / (lanes / 4)), static_cast<std::uint32_t>(height),
                  profile.pixels.workgroup);
}

Result<Plan> copy_plan(int width, int height, int bytes, const CopyForm& form, const Profile& profile) {
  const Format format = bytes == 4 ? Format::f32x1 : bytes == 8 ? Format::f32x2 : Format::f32x4;
  const int lanes = lanes_of(profile, format), pixels_each = lanes / channels(format) * form.block;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  const Module* module = module_in(built_in::limit_copy, (form.texels ? "texels_" : "") + std::string(name(format)));
  if (!module || bytes_per_pixel(format) != static_cast<std::size_t>(bytes))
    return Status(Code::invalid_argument, fmt::format("a copy of {} bytes a pixel; expected 4, 8 or 16", bytes));
  return one_pass("limit_copy", module, {buffer("src", format, pixels, false), buffer("dst", format, pixels, true)},
                  {static_cast<double>(width), static_cast<double>(height)},
                  {static_cast<double>(lanes), static_cast<double>(form.block)},
                  static_cast<std::uint32_t>((width + pixels_each - 1) / pixels_each),
                  static_cast<std::uint32_t>(height), profile.pixels.workgroup);
}

Result<Plan> sample_plan(int width, int height, int side, int looks, std::array<double, 3> step, const SampleForm& form,
                         const Profile& profile) {
  const std::string which = form.sampled ? "sampled" : (form.texels ? "texels_" : "") + std::string(name(form.format));
  const Module* module = module_in(built_in::limit_sample, which);
  if (!module) return Status(Code::invalid_argument, "limit_sample has no form " + which);
  Resource volume = buffer("volume", form.format, static_cast<std::size_t>(side) * side * side, false);
  if (form.sampled) {
    volume.kind = ResourceKind::sampled_image;
    volume.extent = {side, side, side};
    volume.bytes = 0;
  }
  return one_pass("limit_sample", module,
                  {volume, buffer("dst", Format::f32x4, static_cast<std::size_t>(width) * height, true)},
                  {static_cast<double>(width), static_cast<double>(height), static_cast<double>(side),
                   static_cast<double>(looks), step[0], step[1], step[2]},
                  {}, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), profile.pixels.workgroup);
}

Result<Plan> march_plan(int invocations, int entries, int steps, const Profile& profile) {
  const Module* module = module_in(built_in::limit_march, profile.texels ? "texels_f32x1" : "f32x1");
  if (!module) return Status(Code::internal, "limit_march has no form of these buffers");
  const auto& w = profile.pixels.workgroup;
  return one_pass("limit_march", module,
                  {buffer("links", Format::f32x1, static_cast<std::size_t>(entries), false),
                   buffer("dst", Format::f32x1, static_cast<std::size_t>(invocations), true)},
                  {static_cast<double>(invocations), static_cast<double>(entries), static_cast<double>(steps)}, {},
                  static_cast<std::uint32_t>(invocations), 1, {w[0] * w[1] * w[2], 1, 1});
}

Result<Plan> probe_reads_plan(const ProbeReads& reads, const Profile& profile) {
  const std::string which = std::string(profile.texels ? "texels_" : "") + (reads.half ? "f16" : "f32");
  const Module* module = module_in(built_in::limit_probe, which);
  if (!module) return Status(Code::internal, "limit_probe has no form " + which);
  const std::size_t pixels = static_cast<std::size_t>(reads.width) * static_cast<std::size_t>(reads.height);
  const auto texels = [&](int size) {
    return static_cast<std::size_t>(reads.count[0] * reads.count[1] * reads.count[2]) * static_cast<std::size_t>((size + 2) * (size + 2));
  };
  return one_pass("limit_probe", module,
                  {buffer("receivers", Format::f32x4, 2 * pixels, false), buffer("dst", Format::f32x4, pixels, true),
                   buffer("light", reads.half ? Format::f16x4 : Format::f32x4, texels(reads.light_size), false),
                   buffer("moments", reads.half ? Format::f16x2 : Format::f32x2, texels(reads.moments_size), false)},
                  {static_cast<double>(reads.width), static_cast<double>(reads.height), static_cast<double>(reads.count[0]),
                   static_cast<double>(reads.count[1]), static_cast<double>(reads.count[2]), static_cast<double>(reads.light_size),
                   static_cast<double>(reads.moments_size)},
                  {static_cast<double>(reads.corners)}, static_cast<std::uint32_t>(reads.width), static_cast<std::uint32_t>(reads.height),
                  profile.pixels.workgroup);
}

double march_steps(int invocations, int steps) {
  double sum = 0;
  for (int i = 0; i < invocations; ++i) sum += 1 + scene::hash(static_cast<std::uint32_t>(i)) % static_cast<std::uint32_t>(steps);
  return sum;
}

std::vector<Job> limit_jobs(Session& session) {
  return {{"limit arithmetic", [&session] { return measure_arithmetic(session); }},
          {"limit triad", [&session] { return measure_triad(session); }}};
}

void add_copies(Session& session, std::vector<Job>& jobs, const std::string& size, int width, int rows) {
  if (!session.first_time("copy " + size)) return;
  // Memory without gaps is a row as long as one likes: one that fills workgroups of any shape.
  if (const int pixels = width * rows; pixels % 1024 == 0) {
    width = 1024;
    rows = pixels / 1024;
  }
  for (const int bytes : {4, 8, 16})
    jobs.push_back({fmt::format("limit copy {} of {} bytes a pixel", size, bytes),
                    [=, &session] { return measure_copy(session, size, width, rows, bytes); }});
}

std::vector<Cell> machine_limits(bool quick) {
  const std::size_t count = std::size_t{16} << 20;  // 64 MiB: beyond any cache here
  std::vector<float> a(count, 1.0f), b(count, 2.0f), c(count, 3.0f);
  const auto on_two = [&](auto work) {
    std::vector<double> ms;
    for (int i = 0; i < (quick ? 6 : 16); ++i) {
      const auto begin = std::chrono::steady_clock::now();
      std::thread other([&] { work(count / 2, count); });
      work(std::size_t{0}, count / 2);
      other.join();
      if (i > 0)
        ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    return summarise(std::move(ms));
  };
  const Sample copy = on_two([&](std::size_t first, std::size_t last) {
    std::memcpy(a.data() + first, b.data() + first, (last - first) * sizeof(float));
  });
  const Sample triad = on_two([&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) a[i] = b[i] + 3.0f * c[i];
  });
  Guard guard;
  for (int i = 0; i < 20; ++i) guard.measure();
  return {entry("copy", "64 MiB", 4, "memcpy, 2 threads", copy, 2.0 * 4 * count, "GB/s"),
          entry("triad", "64 MiB", 4, "C++, 2 threads", triad, 3.0 * 4 * count, "GB/s"),
          {{"what", "fma"},
           {"size", ""},
           {"bytes_per_pixel", 0},
           {"form", "C++, 2 threads, 256 bits"},
           {"rate", guard.best()},
           {"unit", "GFLOP/s"},
           {"q1", guard.best()},
           {"q3", guard.best()},
           {"n", 20}}};
}

}  // namespace luxel::report

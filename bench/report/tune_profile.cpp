#include "bench/report/tune_profile.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>

#include <fmt/format.h>
#include <luxel/bilateral.h>
#include <luxel/gaussian_blur.h>
#include <luxel/mip_build.h>

#include "bench/report/child.h"
#include "bench/report/kept.h"
#include "bench/report/profile_file.h"
#include "bench/report/report.h"
#include "bench/report/session.h"
#include "bench/report/stats.h"
#include "bench/scene/images.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/run.h"

namespace luxel::report {
namespace {

using cases::Run;
using PlanOf = std::function<Result<Plan>(const Profile&)>;

struct Subject {
  const char* kernel;
  PlanOf plan;
  std::vector<const char*> inputs;
  const char* result;
};

// A compiled run with its input, and the bits of its result.
struct Ready {
  std::shared_ptr<Run> run;
  std::uint64_t bits = 0;
};

Result<Ready> ready(Context& context, const Subject& s, const Profile& profile) {
  Result<Run> made = Run::make(context, s.plan(profile));
  if (!made) return made.status();
  Ready r{std::make_shared<Run>(std::move(made).value())};
  for (const Resource& resource : r.run->plan().resources)
    if (std::any_of(s.inputs.begin(), s.inputs.end(), [&](const char* name) { return resource.name == name; })) {
      const auto texels = static_cast<int>(resource.kind == ResourceKind::buffer ? resource.bytes / bytes_per_pixel(resource.format)
                                                                                 : static_cast<std::size_t>(resource.extent[0]) * resource.extent[1] * resource.extent[2]);
      if (Status status = r.run->write(resource.name, scene::noise(texels, 1, channels(resource.format), 1)); !status) return status;
    }
  for (int i = 0; i < 2; ++i)
    if (Status status = r.run->go(); !status) return status;
  const auto bytes = r.run->bytes(s.result);
  if (!bytes) return bytes.status();
  r.bits = hash_bytes(bytes.value());
  return r;
}

// Times of b over those of a, in turn.
Result<Sample> ratio(const Ready& a, const Ready& b, int pairs) {
  const auto ms = [](const Ready& r, int repeat) -> Result<double> {
    Times times;
    if (Status status = r.run->go(repeat, &times); !status) return status;
    return times.total / repeat;
  };
  const Result<double> one = ms(a, 1);
  if (!one) return one.status();
  const int repeat = std::clamp(static_cast<int>(2 / std::max(one.value(), 1e-3)), 1, 200);
  std::vector<double> r;
  for (int i = 0; i < pairs; ++i) {
    const Result<double> x = ms(a, repeat), y = ms(b, repeat);
    if (!x) return x.status();
    if (!y) return y.status();
    r.push_back(y.value() / x.value());
  }
  return summarise(std::move(r));
}

class Search {
 public:
  Search(Context& context, bool quick) : context_(context), quick_(quick), best_(context.profile()) {}

  /// Tries each value of `set` (profile, index) and keeps the fastest.
  Status over(const Subject& subject, const std::string& what, const std::vector<std::string>& values, const std::function<void(Profile&, std::size_t)>& set) {
    Result<Ready> now = ready(context_, subject, best_);
    if (!now) return now.status();
    for (std::size_t i = 0; i < values.size() && !interrupted(); ++i) {
      Profile other = best_;
      set(other, i);
      if (to_json(context_.info(), other) == to_json(context_.info(), best_)) continue;
      ++tried_;
      const Result<Ready> made = ready(context_, subject, other);
      if (!made) continue;  // a shape that the device, or the kernel there, does not take
      if (made.value().bits != now.value().bits) {
        fmt::print("  {} {}: other bits, so no shape for this kernel here\n", what, values[i]);
        continue;
      }
      Result<Sample> r = ratio(now.value(), made.value(), 3);
      if (!r) return r.status();
      if (r.value().median >= 0.98) continue;
      r = ratio(now.value(), made.value(), quick_ ? 7 : 15);
      if (!r) return r.status();
      if (r.value().q3 >= 0.98) continue;  // gains of less than 2 % are not worth another shape
      fmt::print("  {} {}: {:.2f} of the time (quartiles {:.2f} to {:.2f}), {}\n", what, values[i], r.value().median, r.value().q1, r.value().q3, subject.kernel);
      std::fflush(stdout);
      best_ = other;
      now = made;
    }
    return {};
  }

  Status shape(const Subject& subject, const std::string& name, Shape Profile::*shape) {
    const auto field = [&](const char* what, int Shape::*member, const std::vector<int>& values) -> Status {
      std::vector<std::string> texts;
      for (const int v : values) texts.push_back(std::to_string(v));
      return over(subject, name + "." + what, texts, [&](Profile& p, std::size_t i) { p.*shape.*member = values[i]; });
    };
    using Group = std::array<std::uint32_t, 3>;
    const std::vector<Group> groups = quick_ ? std::vector<Group>{{8, 8, 1}, {64, 1, 1}, {256, 1, 1}}
                                             : std::vector<Group>{{4, 4, 1}, {8, 4, 1}, {8, 8, 1}, {16, 16, 1}, {32, 1, 1}, {32, 4, 1}, {64, 1, 1}, {128, 1, 1}, {256, 1, 1}};
    Status s = field("lanes", &Shape::lanes, {0, 4, 16});
    if (s) s = field("block", &Shape::block, quick_ ? std::vector<int>{1, 4, 8} : std::vector<int>{1, 2, 4, 8, 10});
    std::vector<std::string> texts;
    for (const Group& g : groups) texts.push_back(fmt::format("{}x{}x{}", g[0], g[1], g[2]));
    if (s) s = over(subject, name + ".workgroup", texts, [&](Profile& p, std::size_t i) { (p.*shape).workgroup = groups[i]; });
    if (s) s = field("split", &Shape::split, {0, 1});
    if (s) s = field("unroll", &Shape::unroll, quick_ ? std::vector<int>{0, 32} : std::vector<int>{0, 8, 16, 32, 64});
    return s;
  }

  const Profile& best() const { return best_; }
  int tried() const { return tried_; }

 private:
  Context& context_;
  bool quick_;
  Profile best_;
  int tried_ = 0;
};

}  // namespace

int run_tune_profile(const std::string& device, const std::string& path, bool quick) {
  // From the driver's defaults, not from what an earlier search found.
  const auto opened = device.empty() ? [] {
    for (const char* api : {"opencl", "vulkan"})
      if (auto context = Context::open(api); context) return context;
    return Context::open("cpu");
  }() : Context::open(device);
  if (!opened) return complain(opened.status().message(), 2);
  Context& context = *opened.value();
  if (context.info().api == Api::cpu) return complain("--device is " + context.info().id + "; expected another: the C++ execution has one shape", 2);
  const Interruptible interruptible;
  const int width = quick ? 640 : 1920, height = quick ? 360 : 1080, side = quick ? 64 : 128;
  const Subject blur{"gaussian_blur, 25 taps", [=](const Profile& p) { return plan(cases::blur_params(width, height, 4, 12), p); }, {"src"}, "dst"};
  BilateralParams window;
  window.width = width / 2, window.height = height / 2, window.radius = 4, window.sigma_space = 2, window.sigma_range = 0.2;
  const Subject filter{"bilateral, 9 x 9", [=](const Profile& p) { return plan(window, p); }, {"src"}, "dst"};
  const MipBuildParams mips = cases::mip_params(MipVariant::isotropic, Format::f32x4, {side, side, side});
  const Subject pyramid{"mip_build of a volume", [=](const Profile& p) { return plan(mips, p); }, {"level_0"}, "level_1"};

  fmt::print("{} from the profile {}\n", context.info().id, context.profile().name);
  Search search(context, quick);
  Status s = search.over(blur, "texels", {"false", "true"}, [](Profile& p, std::size_t i) { p.texels = i == 1; });
  if (s) s = search.shape(blur, "rows", &Profile::rows);
  if (s) s = search.shape(blur, "columns", &Profile::columns);
  if (s) s = search.shape(filter, "pixels", &Profile::pixels);
  if (s) s = search.shape(pyramid, "voxels", &Profile::voxels);
  if (s) s = search.over(pyramid, "workgroup_memory", {"false", "true"}, [](Profile& p, std::size_t i) { p.workgroup_memory = i == 1; });
  if (!s) return complain(s.message(), 1);
  if (interrupted()) return complain("interrupted; the profile is as it was", 130);
  const std::string file = path.empty() ? profile_path(context.info()) : path;
  std::error_code error;
  if (path.empty()) std::filesystem::create_directories(profile_folder(), error);
  if (Status written = write_file(file, to_json(context.info(), search.best()).dump(1) + "\n"); !written) return complain(written.message(), 1);
  fmt::print("{} shapes tried; wrote {}\n\n{}", search.tried(), file, cpp_of(search.best()));
  return 0;
}

}  // namespace luxel::report

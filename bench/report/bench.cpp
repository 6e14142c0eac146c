#include "bench/report/bench.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <luxel/bilateral.h>
#include <luxel/gaussian_blur.h>
#include <luxel/mip_build.h>

#include "bench/report/guard.h"
#include "bench/report/settings.h"
#include "bench/report/stats.h"
#include "bench/report/workers.h"
#include "bench/scene/images.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/mip_build_support.h"

namespace luxel::report {
namespace {

Result<Sample> time(cases::Run& run) {
  Times warm;
  for (int i = 0; i < 2; ++i)
    if (Status status = run.go(1, &warm); !status) return status;
  const int repeat = std::clamp(static_cast<int>(std::ceil(2 / std::max(warm.total, 1e-3))), 1, 1000);
  std::vector<double> ms;
  for (int i = 0; i < 11; ++i) {
    Times times;
    if (Status status = run.go(repeat, &times); !status) return status;
    ms.push_back(times.total / repeat);
  }
  return summarise(ms);
}

}  // namespace

Status fill(cases::Run& run, const BenchSetting& setting) {
  for (const Resource& r : setting.plan.resources) {
    if (std::find(setting.fill.begin(), setting.fill.end(), r.name) == setting.fill.end()) continue;
    const std::size_t texels = r.kind == ResourceKind::buffer
                                   ? r.bytes / bytes_per_pixel(r.format)
                                   : static_cast<std::size_t>(r.extent[0]) * r.extent[1] * r.extent[2];
    if (Status status = run.write(r.name, scene::noise(static_cast<int>(texels), 1, channels(r.format), 1)); !status)
      return status;
  }
  for (const auto& [name, values] : setting.data)
    if (Status status = run.write(name, *values); !status) return status;
  return {};
}

std::vector<BenchSetting> gaussian_blur_settings(int width, int height, const Profile& profile) {
  std::vector<BenchSetting> settings;
  const auto add = [&](const std::string& text, GaussianVariant variant, Format format, Input input, double sigma) {
    GaussianBlurParams p;
    p.width = width;
    p.height = height;
    p.sigma = sigma;
    p.variant = variant;
    p.format = format;
    p.input = input;
    const Result<Plan> made = plan(p, profile);
    if (made)
      settings.push_back(
          {fmt::format("{} {} {} sigma {}", text, name(format), input == Input::image ? "image" : "buffer", sigma),
           made.value(),
           {"src"}});
  };
  for (const Format format : {Format::f32x1, Format::f32x2, Format::f32x4, Format::f16x4, Format::unorm8x4})
    add("separable", GaussianVariant::separable, format, Input::buffer, 4);
  add("separable", GaussianVariant::separable, Format::f32x4, Input::image, 4);
  add("sampler", GaussianVariant::sampler, Format::f32x4, Input::image, 4);
  add("separable", GaussianVariant::separable, Format::f32x4, Input::buffer, 1);
  add("direct", GaussianVariant::direct, Format::f32x4, Input::buffer, 1);
  for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::recursive, GaussianVariant::box,
                                        GaussianVariant::pyramid})
    add(cases::name(variant), variant, Format::f32x4, Input::buffer, 12);
  return settings;
}

std::vector<BenchSetting> bilateral_settings(int width, int height, const Profile& profile) {
  std::vector<BenchSetting> settings;
  const auto add = [&](const std::string& text, BilateralVariant variant, RangeTerm range, bool guided) {
    BilateralParams p;
    p.width = width;
    p.height = height;
    p.variant = variant;
    p.radius = 4;
    p.range = range;
    p.sigma_range = 0.2;
    p.depth = guided ? DepthTerm::plane : DepthTerm::off;
    p.normal = guided;
    const Result<Plan> made = plan(p, profile);
    if (made) settings.push_back({text, made.value(), {"src", "guide", "depth", "normals"}});
  };
  add("direct d 9", BilateralVariant::direct, RangeTerm::self, false);
  add("direct d 9 joint", BilateralVariant::direct, RangeTerm::guide, false);
  add("direct d 9 depth, normal", BilateralVariant::direct, RangeTerm::off, true);
  add("separable d 9", BilateralVariant::separable, RangeTerm::self, false);
  add("atrous 5 levels depth, normal", BilateralVariant::atrous, RangeTerm::off, true);
  return settings;
}

std::vector<BenchSetting> mip_build_settings(const Profile& profile) {
  std::vector<BenchSetting> settings;
  const auto add = [&](MipVariant variant, Format format, std::array<int, 3> extent, bool single_pass, int ratio = 2) {
    MipBuildParams p = cases::mip_params(variant, format, extent);
    p.ratio = ratio;
    Profile form = profile;
    form.workgroup_memory = single_pass;
    const Result<Plan> made = plan(p, form);
    if (made)
      settings.push_back({fmt::format("{} {} {}x{}x{}{}{}", cases::name(variant), name(format), extent[0], extent[1],
                                      extent[2], ratio == 16 ? " ratio 16" : "", single_pass ? " single pass" : ""),
                          made.value(),
                          {"level_0"}});
  };
  constexpr std::array<int, 3> volume{128, 128, 128}, image{1920, 1080, 1};
  for (const Format format : {Format::f32x1, Format::f32x4, Format::f16x4, Format::unorm8x4})
    add(MipVariant::isotropic, format, volume, false);
  add(MipVariant::isotropic, Format::f32x4, volume, true);
  add(MipVariant::anisotropic, Format::f32x4, volume, false);
  add(MipVariant::gaussian3, Format::f32x4, volume, false);
  add(MipVariant::min, Format::f32x1, image, false);
  add(MipVariant::min, Format::f32x1, image, false, 16);
  add(MipVariant::minmax, Format::f32x2, image, false);
  add(MipVariant::minmax, Format::f16x2, image, false);
  add(MipVariant::minmax, Format::f32x2, image, true);
  add(MipVariant::moments, Format::f16x2, image, false);
  return settings;
}

int bench_device(const std::shared_ptr<Context>& context, const std::vector<std::string>& kernels,
                 const std::vector<std::pair<int, int>>& sizes) {
  Settings wanted;
  wanted.kernels = kernels;
  Guard guard;
  Workers workers;
  for (int i = 0; i < 10; ++i) guard.measure();
  int status = 0;
  fmt::print("{}\n{:<58} {:>9} {:>9} {:>9} {:>7} {:>9}\n", context->info().id, "setting", "ms", "q1", "q3", "GB/s",
             "GFLOP/s");
  const auto line = [&](const std::string& where, const BenchSetting& setting) {
    auto run = cases::Run::make(*context, setting.plan);
    Status failed = run.status();
    if (run) failed = fill(run.value(), setting);
    if (!failed && context->info().api != Api::cpu) workers.place([&] { return run.value().go(1).ok(); });
    const Result<Sample> ms = failed ? time(run.value()) : Result<Sample>(failed);
    if (!ms) {
      fmt::print("{:<58} {}\n", where, ms.status().message());
      if (ms.status().code() != Code::unsupported) status = 1;
      return;
    }
    const Sample& s = ms.value();
    fmt::print("{:<58} {:>9.4g} {:>9.4g} {:>9.4g} {:>7.3g} {:>9.3g}{}\n", where, s.median, s.q1, s.q3,
               setting.plan.bytes / s.median * 1e-6, setting.plan.flops / s.median * 1e-6,
               guard.quiet(guard.measure()) ? "" : "  (busy machine)");
  };
  for (const auto& [width, height] : sizes)
    if (wanted.wants("bilateral"))
      for (const BenchSetting& setting : bilateral_settings(width, height, context->profile()))
        line(fmt::format("bilateral {}x{} {}", width, height, setting.name), setting);
  for (const auto& [width, height] : sizes)
    if (wanted.wants("gaussian_blur"))
      for (const BenchSetting& setting : gaussian_blur_settings(width, height, context->profile()))
        line(fmt::format("gaussian_blur {}x{} {}", width, height, setting.name), setting);
  if (wanted.wants("mip_build"))
    for (const BenchSetting& setting : mip_build_settings(context->profile()))
      line("mip_build " + setting.name, setting);
  if (wanted.wants("voxelize"))
    for (const BenchSetting& setting : voxelize_settings(context->profile()))
      line("voxelize " + setting.name, setting);
  if (wanted.wants("voxelize"))
    for (const BenchSetting& setting : voxel_inject_settings(context->profile())) line(setting.name, setting);
  if (wanted.wants("cone_trace"))
    for (const BenchSetting& setting : cone_trace_settings(context->profile()))
      line("cone_trace " + setting.name, setting);
  if (wanted.wants("hiz_ssr"))
    for (const BenchSetting& setting : hiz_ssr_settings(context->profile()))
      line("hiz_ssr " + setting.name, setting);
  if (wanted.wants("octahedral_march")) {
    for (const BenchSetting& setting : octahedral_march_settings(context->profile()))
      line("octahedral_march " + setting.name, setting);
    for (const BenchSetting& setting : probe_shade_settings(context->profile()))
      line("octahedral_march " + setting.name, setting);
  }
  if (wanted.wants("light_propagation")) {
    for (const BenchSetting& setting : light_propagation_settings(context->profile()))
      line("light_propagation " + setting.name, setting);
    for (const BenchSetting& setting : lpv_inject_settings(context->profile())) line(setting.name, setting);
  }
  fmt::print("\n");
  return status;
}

}  // namespace luxel::report

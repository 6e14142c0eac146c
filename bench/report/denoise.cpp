#include "bench/report/denoise.h"

#include <algorithm>

#include <luxel/variance.h>

#include "tests/cases/run.h"

namespace luxel::report {
namespace {

using cases::Run;

constexpr double least_albedo = 1e-3;

// One plan: inputs by name, its first output, and its time added.
Result<std::vector<double>> step(Context& context, const Result<Plan>& plan, const std::string& output,
                                 const std::vector<std::pair<std::string, const std::vector<double>*>>& inputs,
                                 double& ms, std::vector<double>* counters = nullptr) {
  Result<Run> made = Run::make(context, plan);
  if (!made) return made.status();
  Run& run = made.value();
  for (const auto& [name, values] : inputs)
    if (Status s = run.write(name, *values); !s) return s;
  if (counters != nullptr)
    if (Status s = run.write("counters", *counters); !s) return s;
  Times times;
  // Drivers compile at the first dispatch.
  const int turns = context.info().api == Api::cpu || counters != nullptr ? 1 : 2;
  for (int i = 0; i < turns; ++i)
    if (Status s = run.go(1, &times); !s) return s;
  ms += times.total;
  if (counters != nullptr) {
    Result<std::vector<double>> read = run.read("counters");
    if (!read) return read;
    *counters = std::move(read).value();
  }
  return run.read(output);
}

}  // namespace

std::vector<double> without_albedo(const NoisyRender& render, const std::vector<double>& color) {
  std::vector<double> light = color;
  if (!render.albedo.empty())
    for (std::size_t i = 0; i < light.size(); ++i)
      if (i % 4 != 3) light[i] /= std::max(render.albedo[i], least_albedo);
  return light;
}

std::vector<double> with_albedo(const NoisyRender& render, const std::vector<double>& light) {
  std::vector<double> color = light;
  if (!render.albedo.empty())
    for (std::size_t i = 0; i < color.size(); ++i)
      if (i % 4 != 3) color[i] *= std::max(render.albedo[i], least_albedo);
  return color;
}

Result<Denoised> denoise(Context& context, const NoisyRender& render, const DenoiseParams& params) {
  Denoised result;
  std::vector<double> light = without_albedo(render, render.color);
  if (params.clamp) {
    OutlierClampParams outliers;
    outliers.width = render.width;
    outliers.height = render.height;
    outliers.radius = params.radius;
    outliers.k = params.k;
    outliers.count = true;
    std::vector<double> counters(2, 0.0);
    auto clamped = step(context, plan(outliers, context.profile()), "dst", {{"src", &light}}, result.ms, &counters);
    if (!clamped) return clamped.status();
    light = std::move(clamped).value();
    result.clamped = static_cast<std::uint32_t>(counters[0]);
    result.not_finite = static_cast<std::uint32_t>(counters[1]);
  }
  VarianceParams variance;
  variance.width = render.width;
  variance.height = render.height;
  const auto spread = step(context, plan(variance, context.profile()), "variances", {{"src", &light}}, result.ms);
  if (!spread) return spread.status();

  BilateralParams filter;
  filter.width = render.width;
  filter.height = render.height;
  filter.variant = BilateralVariant::atrous;
  filter.levels = params.levels;
  filter.range = RangeTerm::off;
  filter.luminance = true;
  filter.sigma_luminance = params.sigma_luminance;
  filter.variance_target = params.variance_target;
  std::vector<std::pair<std::string, const std::vector<double>*>> inputs{{"src", &light},
                                                                         {"variance", &spread.value()}};
  if (!render.depth.empty()) {
    filter.depth = DepthTerm::plane;
    filter.sigma_depth = params.sigma_depth;
    filter.footprint = params.footprint;
    inputs.emplace_back("depth", &render.depth);
  }
  if (!render.albedo.empty() && params.sigma_albedo > 0) {
    filter.range = RangeTerm::guide;
    filter.sigma_range = params.sigma_albedo;
    inputs.emplace_back("guide", &render.albedo);
  }
  if (!render.normals.empty()) {
    filter.normal = true;
    filter.sigma_normal = params.sigma_normal;
    inputs.emplace_back("normals", &render.normals);
  }
  auto filtered = step(context, plan(filter, context.profile()), "dst", inputs, result.ms);
  if (!filtered) return filtered.status();
  result.color = with_albedo(render, filtered.value());
  return result;
}

}  // namespace luxel::report

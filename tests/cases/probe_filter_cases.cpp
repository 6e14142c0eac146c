#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "tests/cases/compare.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kernel = "probe_irradiance";

std::size_t texels(const ProbeIrradianceParams& p) {
  return probe_count(p.grid) * static_cast<std::size_t>(p.maps.size) * static_cast<std::size_t>(p.maps.size);
}

Values all_radiance(const ProbeIrradianceParams& p, double value) {
  Values v;
  for (std::size_t i = 0; i < texels(p); ++i) v.insert(v.end(), {value, value, value, 0});
  return v;
}

Case furnace_case(bool half, int samples) {
  return {kernel, fmt::format("furnace, {}, averaged to {}", half ? "halves" : "f32", samples),
          "radiance that is the same from everywhere gives pi times it (relative difference)",
          half ? 0x1p-11 : 1.2e-6,  // half a step of f16; sums of 1024 terms
          [=](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({2, 1, 1}, half).filter;
            p.maps.size = 64;
            p.samples = samples;
            p.moments_size = 0;
            const auto r = filter(context, p, {all_radiance(p, 0.75), {}});
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
              if (i % 4 < 3) most = std::max(most, std::fabs(r.value().irradiance[i] / (0.75 * pi) - 1));
            return most;
          }};
}

// Distances about 1000 that differ by 1/100: E[r^2] - E[r]^2 in f32 has no digit left (its rounding is 2^-23 of 10^6), and in
// halves r^2 is infinite from 256 on.
Case cancellation_case(double distance, double spread) {
  return {kernel, fmt::format("distances {} +- {}", distance, spread),
          "the standard deviation is that of the map (relative error); E[r^2] - E[r]^2 in f32 would have lost all of it",
          2.2 * distance * 0x1p-24 / spread + 1e-5,  // the map's own rounding: half a step of f32 at this distance
          [=](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({1, 1, 1}).filter;
            p.grid.spacing = {distance, distance, distance};
            p.irradiance_size = 0;
            ProbeSeen seen;
            for (std::size_t i = 0; i < texels(p); ++i)
              seen.distance.push_back(static_cast<float>(distance + ((i ^ (i >> 4)) % 2 == 0 ? spread : -spread)));
            const auto exact_device = Context::open("cpu:double");
            if (!exact_device) return exact_device.status();
            const auto r = filter(context, p, seen), exact = filter(*exact_device.value(), p, seen);
            if (!r) return r.status();
            if (!exact) return exact.status();
            double most = 0;
            for (std::size_t i = 1; i < r.value().moments.size(); i += 2) {
              const double sigma = exact.value().moments[i] * probe_unit(p.grid);
              if (!(std::fabs(sigma / spread - 1) < 0.2)) return nan;  // the case is what it says
              most = std::max(most, std::fabs(r.value().moments[i] * probe_unit(p.grid) / sigma - 1));
            }
            return most;
          },
          false, not_double};
}

Case far_case() {
  return {kernel, "all texels at the far limit", "mean max_distance, standard deviation 0 (largest difference)", 1e-6,
          [](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({1, 1, 1}, true).filter;
            p.irradiance_size = 0;
            Values distance(texels(p), HUGE_VAL);
            for (std::size_t i = 0; i < distance.size(); i += 3) distance[i] = 1e30;
            const auto r = filter(context, p, {{}, distance});
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < r.value().moments.size(); i += 2)
              most = std::max({most, std::fabs(r.value().moments[i] - 1.5), std::fabs(r.value().moments[i + 1])});
            return most;
          }};
}

Case scale_case(double scale) {
  return {kernel, fmt::format("distances of {} to {}, in halves", scale, 2 * scale),
          "moments are in units of the grid: those of the same scene at scale 1 (largest difference, steps of f16 at 1)", 1,
          [=](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({1, 1, 1}, true).filter, q = p;
            for (double& s : q.grid.spacing) s *= scale;
            p.irradiance_size = q.irradiance_size = 0;
            const ProbeSeen a = random_probes(p, 51);
            ProbeSeen b = a;
            for (double& d : b.distance) d = static_cast<float>(d * scale);
            const auto x = filter(context, p, a), y = filter(context, q, b);
            if (!x) return x.status();
            if (!y) return y.status();
            return max_difference(x.value().moments, y.value().moments) * 1024;
          }};
}

Case hostile_radiance_case() {
  return {kernel, "NaN and infinite radiance", "is left out: what else is seen has its mean; a probe that sees nothing else is 0 (largest difference)",
          2e-6, [](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({2, 1, 1}).filter;
            p.moments_size = 0;
            Values radiance = all_radiance(p, 2);
            for (std::size_t i = 0; i < radiance.size() / 2; i += 4)
              if (i % 12 == 0) radiance[i + i % 3] = i % 8 == 0 ? nan : HUGE_VAL;
            for (std::size_t i = radiance.size() / 2; i < radiance.size(); i += 4) radiance[i] = -HUGE_VAL;
            const auto r = filter(context, p, {radiance, {}});
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
              if (i % 4 < 3) most = std::max(most, std::fabs(r.value().irradiance[i] - (i < r.value().irradiance.size() / 2 ? 2 * pi : 0)));
            return most;
          }};
}

Case hostile_distance_case() {
  return {kernel, "NaN and negative distances", "are 0: what is not known hides (largest difference)", 0,
          [](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({1, 1, 1}).filter;
            p.irradiance_size = 0;
            Values a(texels(p), 1.5), b = a;
            for (std::size_t i = 0; i < a.size(); i += 5) a[i] = i % 2 == 0 ? nan : -3, b[i] = 0;
            const auto x = filter(context, p, {{}, a}), y = filter(context, p, {{}, b});
            if (!x) return x.status();
            if (!y) return y.status();
            return max_difference(x.value().moments, y.value().moments);
          }};
}

Case bright_case() {
  return {kernel, "radiance of 60000, in halves", "irradiance beyond 65504 is 65504: nothing is infinite (largest difference)", 0,
          [](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({1, 1, 1}, true).filter;
            p.moments_size = 0;
            const auto r = filter(context, p, {all_radiance(p, 60000), {}});
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
              if (i % 4 < 3) most = std::max(most, std::fabs(r.value().irradiance[i] - 65504));
            return most;
          },
          false, not_double};
}

// Frames of the same radiance over maps that began at 0. `part`: of what is missing, at most.
Case hysteresis_case(bool half, double keep, int frames, double part, const char* promise) {
  return {kernel, fmt::format("hysteresis {}, {} frames, {}", keep, frames, half ? "halves" : "f32"), promise, part,
          [=](Context& context) -> Result<double> {
            ProbeIrradianceParams p = probe_set_up({1, 1, 1}, half).filter;
            p.maps.size = 16;
            p.samples = 4;
            p.irradiance_size = p.moments_size = 4;
            const ProbeSeen seen = random_probes(p, 57);
            const auto target = filter(context, p, seen);
            if (!target) return target.status();
            p.previous = true;
            p.hysteresis = keep;
            ProbeFiltered now{even_map(1, 4, {0, 0, 0, 1}), even_map(1, 4, {0, 0})};
            for (int i = 0; i < frames; ++i) {
              auto next = filter(context, p, seen, {}, now);
              if (!next) return next.status();
              // Gain: no texel goes past its target, and none moves away.
              for (std::size_t k = 0; k < now.irradiance.size(); ++k) {
                const double t = target.value().irradiance[k], a = now.irradiance[k], b = next.value().irradiance[k];
                if (!(std::fabs(t - b) <= std::fabs(t - a) * (1 + 1e-6) + 1e-7)) return nan;
              }
              now = std::move(next).value();
            }
            double most = 0;
            for (std::size_t k = 0; k < now.irradiance.size(); ++k)
              if (k % 4 < 3) most = std::max(most, std::fabs(now.irradiance[k] / target.value().irradiance[k] - 1));
            for (std::size_t k = 0; k < now.moments.size(); k += 2)
              most = std::max(most, std::fabs(now.moments[k] / target.value().moments[k] - 1));
            return most;
          },
          false, half ? not_double : std::function<bool(const DeviceInfo&)>{}};
}

}  // namespace

void add_probe_filter_cases(std::vector<Case>& cases) {
  for (const bool half : {false, true})
    for (const int samples : {8, 64}) cases.push_back(furnace_case(half, samples));
  cases.push_back(cancellation_case(1000, 0.01));
  cases.push_back(cancellation_case(60000, 0.5));
  cases.push_back(cancellation_case(0.001, 1e-8));
  cases.push_back(far_case());
  for (const double scale : {1e-3, 1e2, 1e5}) cases.push_back(scale_case(scale));
  cases.push_back(hostile_radiance_case());
  cases.push_back(hostile_distance_case());
  cases.push_back(bright_case());
  cases.push_back(hysteresis_case(false, 0.75, 24, std::pow(0.75, 24) * 1.001 + 1e-6, "what is missing falls by the hysteresis each frame, and nothing overshoots (relative)"));
  cases.push_back(hysteresis_case(false, 0.98, 60, std::pow(0.98, 60) * 1.001, "what is missing falls by the hysteresis each frame, and nothing overshoots (relative)"));
  cases.push_back(hysteresis_case(true, 0.75, 60, 0x1p-11 / 0.25 + 0x1p-11, "halves come to a stop within 2^-11 / (1 - hysteresis) of their value"));
}

std::vector<Case> probe_cases() {
  std::vector<Case> cases;
  add_probe_filter_cases(cases);
  add_probe_shade_cases(cases);
  return cases;
}

}  // namespace luxel::cases

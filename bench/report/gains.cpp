// The largest factor by which what is iterated or fed back grows a step.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <luxel/variance.h>

#include "bench/report/instruments.h"
#include "bench/scene/images.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/run.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;

double norm(const Values& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

// Half a step of every value, added up: what rounding to floats may add to a factor.
constexpr double rounding = 1e-6;

// Sum of |h| of the impulse response along a row: how far a bounded image can grow.
Instrument impulse(GaussianVariant variant, double bound, const char* promise, int order = 5) {
  const bool recursive = variant == GaussianVariant::recursive;
  return {"gaussian_blur", "gaussian_blur", fmt::format("gain: {}{}, impulse", cases::name(variant), recursive ? fmt::format(" of order {}", order) : ""),
          promise, bound,
          [variant, order](Context& device, Context&, bool quick) -> Result<Found> {
            Found f;
            for (const double sigma : quick ? std::vector{2.0, 8.0, 100.0} : std::vector{2.0, 4.0, 8.0, 32.0, 100.0, 500.0}) {
              if (cases::has_taps(variant) && sigma > 100) continue;
              const int width = std::clamp(static_cast<int>(16 * sigma), 64, 8192) | 1;
              GaussianBlurParams p =
                  cases::blur_params(width, 1, sigma, static_cast<int>(std::ceil(3 * sigma)), Format::f32x1, Border::wrap, variant);
              if (variant == GaussianVariant::recursive) p.order = order;
              Values src(static_cast<std::size_t>(width), 0.0);
              src[src.size() / 2] = 1;
              const auto dst = cases::blur(device, p, src);
              if (!dst) return dst.status();
              double sum = 0;
              for (const double v : dst.value()) sum += std::fabs(v);
              if (!(sum <= f.measured)) f = {sum, fmt::format("at sigma {:g}", sigma)};
            }
            return f;
          }};
}

// The filter on its own result, again and again: the growth of the largest value, of signs as bad as can be.
Instrument again_and_again(BilateralVariant variant, const char* what) {
  return {"bilateral", "bilateral", fmt::format("gain: {}, iterated", what),
          "the largest of an image's values never grows, over 24 runs each on the last one's result", 1 + rounding,
          [variant](Context& device, Context&, bool quick) -> Result<Found> {
            BilateralParams p;
            p.width = 48, p.height = 32;
            p.variant = variant;
            p.radius = 3, p.sigma_space = 1.5, p.sigma_range = 0.3;
            if (variant == BilateralVariant::atrous) p.levels = 3;
            cases::BilateralImages images;
            images.src = scene::noise(p.width, p.height, 4, 9);
            for (std::size_t i = 0; i < images.src.size(); ++i) images.src[i] = i % 4 == 3 ? 1 : 2 * images.src[i] - 1;
            const auto largest = [](const Values& v) {
              double most = 0;
              for (std::size_t i = 0; i < v.size(); ++i)
                if (const double x = std::fabs(v[i]); i % 4 != 3 && !(x <= most)) most = x;
              return most;
            };
            Found f;
            double before = largest(images.src);
            for (int run = 0; run < (quick ? 8 : 24); ++run) {
              const auto result = cases::filter(device, p, images);
              if (!result) return result.status();
              const double after = largest(result.value().dst);
              if (!(after / before <= f.measured)) f = {after / before, fmt::format("in run {}", run + 1)};
              images.src = result.value().dst;
              before = after;
            }
            return f;
          }};
}

// Two histories with the same input: how much of their difference is left a frame.
Instrument hysteresis(double part) {
  return {"octahedral_march", "probe_irradiance", fmt::format("gain: maps blended over frames, hysteresis {:g}", part),
          "of the difference of two histories no more than the hysteresis is left a frame (power iteration, f32)", part + rounding,
          [part](Context& device, Context&, bool quick) -> Result<Found> {
            ProbeIrradianceParams p = cases::probe_set_up({2, 1, 1}).filter;
            p.previous = true, p.hysteresis = part;
            const cases::ProbeSeen seen = cases::random_probes(p, 3);
            cases::ProbeFiltered a, b;
            const std::size_t texels = probe_map_texels(2, p.irradiance_size), moments = probe_map_texels(2, p.moments_size);
            const auto filled = [](std::size_t n, std::uint32_t seed, double scale) {
              Values v = scene::noise(static_cast<int>(n), 1, 1, seed);
              for (double& x : v) x = static_cast<float>(x * scale);
              return v;
            };
            a = {filled(4 * texels, 1, 3), filled(2 * moments, 2, 1)}, b = {filled(4 * texels, 5, 3), filled(2 * moments, 6, 1)};
            Found f;
            for (int frame = 0; frame < (quick ? 3 : 8); ++frame) {
              const auto next_a = cases::filter(device, p, seen, {}, a), next_b = cases::filter(device, p, seen, {}, b);
              if (!next_a) return next_a.status();
              if (!next_b) return next_b.status();
              const auto apart = [](const Values& x, const Values& y) {
                Values d(x.size());
                for (std::size_t i = 0; i < x.size(); ++i) d[i] = x[i] - y[i];
                return norm(d);
              };
              // The borders of histories that no frame made yet do not agree with their maps.
              const double gain = apart(next_a.value().irradiance, next_b.value().irradiance) / apart(a.irradiance, b.irradiance);
              if (frame > 0 && !(gain <= f.measured)) f = {gain, fmt::format("in frame {}", frame + 1)};
              a = next_a.value(), b = next_b.value();
            }
            return f;
          }};
}

// The same of variance's running mean and variance.
Instrument running_variance() {
  return {"bilateral", "variance", "gain: history over frames, alpha 0.2",
          "of the difference of two histories' means no more than 1 - alpha is left a frame, once frames outnumber 1 / alpha",
          0.8 + rounding, [](Context& device, Context&, bool quick) -> Result<Found> {
            VarianceParams p;
            p.width = 16, p.height = 8, p.format = Format::f32x1, p.variant = VarianceVariant::temporal, p.alpha = 0.2;
            constexpr std::size_t n = 16 * 8;
            const auto begin = [](std::uint32_t seed) {
              Values h = scene::noise(static_cast<int>(3 * n), 1, 1, seed);
              for (std::size_t i = 0; i < n; ++i) h[3 * i + 2] = 64;  // seen for long
              return h;
            };
            Values a = begin(1), b = begin(2);
            Found f;
            const auto next = [&](Values& history, const Values& src) -> Status {
              Result<Run> made = Run::make(device, plan(p, device.profile()));
              if (!made) return made.status();
              if (Status s = made.value().write("src", src); !s) return s;
              if (Status s = made.value().write("history", history); !s) return s;
              if (Status s = made.value().go(); !s) return s;
              auto read = made.value().read("history_out");
              if (!read) return read.status();
              history = std::move(read).value();
              return {};
            };
            const auto apart = [&] {
              double sum = 0;
              for (std::size_t i = 0; i < n; ++i) sum += (a[3 * i] - b[3 * i]) * (a[3 * i] - b[3 * i]);
              return std::sqrt(sum);
            };
            for (std::uint32_t frame = 0; frame < (quick ? 4u : 16u); ++frame) {
              const Values src = scene::noise(16, 8, 1, 50 + frame);
              const double before = apart();
              if (Status s = next(a, src); !s) return s;
              if (Status s = next(b, src); !s) return s;
              const double gain = apart() / before;
              if (!(gain <= f.measured)) f = {gain, fmt::format("in frame {}", frame + 1)};
            }
            return f;
          }};
}

// Light that is gathered and put back into voxels of albedo 1, in a closed room: the largest irradiance over pi times the
// radiance.
Instrument bounce() {
  return {"cone_trace", "cone_trace", "gain: a bounce between voxels of albedo 1",
          "irradiance over pi times the radiance of a closed room, the largest over all sets of cones", 1 + 1e-5,
          [](Context& device, Context&, bool quick) -> Result<Found> {
            Found f;
            for (const cases::NamedSet& set : cases::cone_sets()) {
              if (quick && set.name.find('6') == std::string::npos) continue;
              ConeTraceParams p = cases::cone_params(16);
              p.cones = set.cones;
              const Values receivers = cases::cone_receivers(p, 64, 5);
              p.width = 64, p.height = 1;
              const auto r = cases::trace(device, p, cases::uniform_volume(16, {1, 1, 1, 1}), receivers);
              if (!r) return r.status();
              for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
                if (const double gain = r.value().irradiance[i] / std::numbers::pi; i % 4 != 3 && !(gain <= f.measured))
                  f = {gain, "with the set " + set.name};
            }
            return f;
          }};
}

}  // namespace

void add_gains(std::vector<Instrument>& all) {
  // Weights of one sign: their sum is 1, and rounds.
  for (const GaussianVariant v : {GaussianVariant::separable, GaussianVariant::box, GaussianVariant::pyramid})
    all.push_back(impulse(v, 1 + 1e-5, "sum of |weights|, by which a bounded image may grow: none is negative"));
  // Twice half the L1 norm of its error (kernels/gaussian_blur/README.md, sigma from 2 on).
  for (const auto& [order, half_l1] : {std::pair{3, 1.4e-2}, {4, 5.6e-3}, {5, 2.1e-3}})
    all.push_back(impulse(GaussianVariant::recursive, 1 + 2 * half_l1,
                          "sum of |weights|, by which a bounded image may grow: 1 and the L1 norm of the response's error", order));
  for (const auto& [variant, what] : {std::pair{BilateralVariant::direct, "direct"}, {BilateralVariant::separable, "separable"}, {BilateralVariant::atrous, "atrous"}})
    all.push_back(again_and_again(variant, what));
  all.push_back(running_variance());
  all.push_back(hysteresis(0.98));
  all.push_back(hysteresis(0.5));
  all.push_back(bounce());
}

}  // namespace luxel::report

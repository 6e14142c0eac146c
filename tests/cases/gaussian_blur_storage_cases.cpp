// Storage formats: half steps, sums that are kept, alpha and outer taps that are left out.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "bench/truth/gaussian_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

double sum(const Values& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

// f32 accumulation behind f16 and unorm8: the result is the truth rounded once.
void add_single_rounding(std::vector<Case>& cases, Format format, double tolerance) {
  cases.push_back({"", fmt::format("{} accumulates in f32", name(format)),
                   "a result is within half a storage step of the truth, and what f32 sums add (in storage steps)",
                   0.5 + tolerance, [=](Context& context) -> Result<double> {
                     const Values src = quantise(scene::noise(61, 43, 4, 7), format);
                     const auto out = blur(context, blur_params(61, 43, 4, 12, format), src);
                     if (!out) return out.status();
                     const Values exact = truth::gaussian(src, 61, 43, 4, 4, Border::clamp, 12);
                     double most = 0;
                     for (std::size_t i = 0; i < exact.size(); ++i) {
                       const double d = std::fabs(out.value()[i] - exact[i]) / step(format, exact[i]);
                       if (!(d <= most)) most = d;
                     }
                     return most;
                   }});
}

// The same for variants whose method is off by more than that: against the execution in double.
void add_single_rounding(std::vector<Case>& cases, GaussianVariant variant, Format format) {
  cases.push_back({"", fmt::format("{} {} accumulates in f32", name(variant), name(format)),
                   "within half a storage step of the double execution, and what f32 adds (in storage steps)", 0.52,
                   [=](Context& context) -> Result<double> {
                     const Values src = quantise(scene::noise(61, 43, 4, 7), format);
                     const GaussianBlurParams p = blur_params(61, 43, 8, 24, format, Border::clamp, variant);
                     const auto out = blur(context, p, src);
                     if (!out) return out.status();
                     const auto exact = Context::open("cpu:double");
                     if (!exact) return exact.status();
                     const auto expected = blur(*exact.value(), p, src);
                     if (!expected) return expected.status();
                     double most = 0;
                     for (std::size_t i = 0; i < src.size(); ++i) {
                       const double d =
                           std::fabs(out.value()[i] - expected.value()[i]) / step(format, expected.value()[i]);
                       if (!(d <= most)) most = d;
                     }
                     return most;
                   }});
}

// With wrap every pixel is handed on whole, so the sum of all pixels is kept.
void add_kept_sum(std::vector<Case>& cases, Format format, double bound, const char* promise) {
  for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::direct, GaussianVariant::recursive,
                                        GaussianVariant::box, GaussianVariant::pyramid})
    cases.push_back({"", fmt::format("sum of all pixels, wrap, {} {}", name(variant), name(format)), promise, bound,
                     [=](Context& context) -> Result<double> {
                       const Values src = quantise(scene::noise(128, 64, channels(format), 8), format);
                       const int radius = variant == GaussianVariant::direct ? 6 : 12;
                       const auto out =
                           blur(context, blur_params(128, 64, radius / 3.0, radius, format, Border::wrap, variant), src);
                       if (!out) return out.status();
                       return std::fabs(sum(out.value()) / sum(src) - 1);
                     }});
}

void add_keep_alpha(std::vector<Case>& cases) {
  for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4})
    for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::recursive, GaussianVariant::box})
      cases.push_back({"", fmt::format("keep_alpha, {} {}", name(variant), name(format)),
                       "alpha is copied bit for bit and colour is as without it (values that differ)", 0,
                       [=](Context& context) -> Result<double> {
                         const Values src = quantise(scene::noise(33, 17, 4, 9), format);
                         GaussianBlurParams p = blur_params(33, 17, 2, 6, format, Border::clamp, variant);
                         const auto filtered = blur(context, p, src);
                         if (!filtered) return filtered.status();
                         p.keep_alpha = true;
                         const auto kept = blur(context, p, src);
                         if (!kept) return kept.status();
                         double different = 0;
                         for (std::size_t i = 0; i < src.size(); ++i)
                           different += same(kept.value()[i], i % 4 == 3 ? src[i] : filtered.value()[i]) ? 0 : 1;
                         return different;
                       }});
}

void add_dropped_taps(std::vector<Case>& cases) {
  // Weights that sum to at most half a step are left out on each of two axes, the rest is scaled up by as much again;
  // then each result is rounded by half a step.
  for (const auto& [format, half] : {std::pair{Format::unorm8x4, 1.0 / 510}, {Format::f16x4, 0x1p-12}})
    cases.push_back({"", fmt::format("drop_taps, {}", name(format)),
                     "leaving out the outer taps moves a result by at most their weight on both axes and one rounding",
                     2 * half + 2 * half, [format = format](Context& context) -> Result<double> {
                       const Values src = quantise(scene::step_edge(90, 20, 4, 45), format);
                       GaussianBlurParams p = blur_params(90, 20, 4, 24, format);
                       const auto all = blur(context, p, src);
                       if (!all) return all.status();
                       p.drop_taps = true;
                       if (effective_radius(p) >= 24)
                         return Status(Code::internal, "drop_taps dropped none of 24 taps");
                       const auto fewer = blur(context, p, src);
                       if (!fewer) return fewer.status();
                       return max_difference(all.value(), fewer.value());
                     }});
}

}  // namespace

void add_storage_cases(std::vector<Case>& cases) {
  // 24 taps of f32 rounding (12 on each side) are 2.6e-6 of full scale: 0.01 steps of f16 at a half, where values of
  // noise lie, 0.001 of unorm8.
  add_single_rounding(cases, Format::f16x4, 0.02);
  add_single_rounding(cases, Format::unorm8x4, 0.002);
  for (const GaussianVariant variant : {GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid})
    for (const Format format : {Format::f16x4, Format::unorm8x4}) add_single_rounding(cases, variant, format);
  const double n = 128 * 64 * 4;
  add_kept_sum(cases, Format::f32x4, 1e-6, "with wrap the sum of all pixels is kept to 1e-6");
  add_kept_sum(
      cases, Format::f16x4, 3 * 0x1p-11 / std::sqrt(n),
      "with wrap the sum of all pixels is kept to three times 2^-11/sqrt(N): roundings of f16 are independent");
  // A rounding of unorm8 is uniform in +-1/510: standard deviation 1/(255 sqrt 12); the mean of the noise is 1/2.
  add_kept_sum(cases, Format::unorm8x4, 3 * 2 / (255 * std::sqrt(12 * n)),
               "with wrap the sum of all pixels is kept to three standard deviations of rounding half to even");
  add_keep_alpha(cases);
  add_dropped_taps(cases);
}

}  // namespace luxel::cases

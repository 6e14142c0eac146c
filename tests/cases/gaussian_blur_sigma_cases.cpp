// sigma and radius at their ends, and sizes of images.
#include <cmath>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "bench/truth/gaussian_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

void add_input_unchanged(std::vector<Case>& cases, double sigma, int radius) {
  for (const Format format : pixel_formats)
    for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::direct,
                                          GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid})
      cases.push_back({"", fmt::format("sigma {} radius {}, {} {}", sigma, radius, name(variant), name(format)),
                       "sigma towards 0 gives the input bit for bit (values that differ)", 0,
                       [=](Context& context) -> Result<double> {
                         const Values src = quantise(scene::noise(19, 7, channels(format), 1), format);
                         const auto out =
                             blur(context, blur_params(19, 7, sigma, radius, format, Border::clamp, variant), src);
                         if (!out) return out.status();
                         return count_different(out.value(), src);
                       },
                       sigma > 0 && format != Format::f32x4});
}

void add_limit(std::vector<Case>& cases, Border border, double sigma, int radius, double bound, const char* promise) {
  cases.push_back({"", fmt::format("sigma {} on 16x12, {}", sigma, name(border)), promise, bound,
                   [=](Context& context) -> Result<double> {
                     const Values src = scene::noise(16, 12, 1, 2);
                     const auto out = blur(context, blur_params(16, 12, sigma, radius, Format::f32x4, border), as_four(src));
                     if (!out) return out.status();
                     return max_difference(out.value(), Values(4 * src.size(), limit_of(src, 16, 12, border)));
                   }});
}

void add_size(std::vector<Case>& cases, int width, int height, int radius, Border border, Format format,
              GaussianVariant variant = GaussianVariant::separable) {
  cases.push_back(
      {"", fmt::format("{}x{}, R {}, {} {} {}", width, height, radius, name(variant), name(border), name(format)),
       "any size and a radius beyond it: within rounding of the truth with the same radius", rounding_bound(radius),
       [=](Context& context) -> Result<double> {
         const double sigma = radius / 3.0;
         const Values src = quantise(scene::noise(width, height, channels(format), 3), format);
         const auto out = blur(context, blur_params(width, height, sigma, radius, format, border, variant), src);
         if (!out) return out.status();
         return max_difference(out.value(),
                               truth::gaussian(src, width, height, channels(format), sigma, border, radius));
       }});
}

// Just below and above the sigma where ceil(k sigma) steps from R to R + 1.
void add_step_of_radius(std::vector<Case>& cases, int radius, double k) {
  const double sigma = radius / k;
  const double outer =
      std::exp(-0.5 * (radius + 1) * (radius + 1) / (sigma * sigma)) / (sigma * std::sqrt(2 * 3.14159265358979));
  // A tap on each side of each axis appears, and everything else is scaled down by as much.
  const double bound = 2 * 2 * outer + 1e-5;
  cases.push_back({"", fmt::format("R steps from {} to {} (k = {})", radius, radius + 1, k),
                   "where ceil(k sigma) steps, the result moves by no more than the weights of the taps that appear",
                   bound, [=](Context& context) -> Result<double> {
                     const Values src = scene::step_edge(97, 61, 1, 48);
                     const auto below =
                         blur(context, blur_params(97, 61, sigma * (1 - 1e-7), radius, Format::f32x1), src);
                     if (!below) return below.status();
                     const auto above =
                         blur(context, blur_params(97, 61, sigma * (1 + 1e-7), radius + 1, Format::f32x1), src);
                     if (!above) return above.status();
                     return max_difference(below.value(), above.value());
                   }});
}

}  // namespace

void add_sigma_cases(std::vector<Case>& cases) {
  add_input_unchanged(cases, 0, -1);
  add_input_unchanged(cases, 1e-3, 3);

  // Within the image lie at most N of the 2R + 1 taps of an axis, each at most the centre's weight 1/(sigma sqrt(2 pi))
  // over the share erf(R / (sigma sqrt 2)) that the radius keeps; they move an axis by at most their sum.
  const double centre = 1 / (1300 * 2.5066) / std::erf(3900 / 1300.0 / std::sqrt(2.0));
  add_limit(cases, Border::clamp, 1300, 3900, (16 + 12) * centre,
            "sigma far above the size, clamp: the mean of the four corners, but for the taps inside");
  // 601 roundings a pass average out: 2e-6 where the rigorous bound is 1.1e-4.
  add_limit(cases, Border::wrap, 100, 600, 2e-6, "sigma far above the size, wrap: the mean");
  add_limit(cases, Border::mirror, 100, 600, 2e-6,
            "sigma far above the size, mirror: the mean, edge pixels counted half");
  // At sigma 10000 the weights across 16 pixels still fall by (16/10000)^2/2 = 1.3e-6.
  add_limit(cases, Border::zero, 10000, 64, 3e-6, "sigma far above the size, zero-renormalised: the mean");

  for (const Border border : borders) {
    add_size(cases, 5, 3, 40, border, Format::f32x4);
    add_size(cases, 37, 23, 6, border, Format::f32x1);
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 31}, {31, 1}, {2, 2}, {17, 13}, {127, 3}})
    for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::direct})
      add_size(cases, width, height, 6, Border::clamp, Format::f32x4, variant);
  add_size(cases, 1, 29, 6, Border::mirror, Format::f32x2);
  add_size(cases, 29, 1, 12, Border::zero, Format::f32x4);
  add_size(cases, 401, 5, 200, Border::wrap, Format::f32x4);

  add_step_of_radius(cases, 3, 3);
  add_step_of_radius(cases, 36, 3);
  add_step_of_radius(cases, 36, 4);
}

}  // namespace luxel::cases

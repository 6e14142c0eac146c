// The box variant: its error, its rounding, its ends, and that nothing is left behind a spike.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "bench/truth/gaussian_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

GaussianBlurParams boxes(int width, int height, double sigma, Format format = Format::f32x1,
                         Border border = Border::clamp, int passes = 3) {
  GaussianBlurParams p = blur_params(width, height, sigma, -1, format, border, GaussianVariant::box);
  p.passes = passes;
  return p;
}

// Half the L1 norm of the error of the impulse response of an axis, as measured, rounded up. Windows of few pixels are
// further from a Gaussian.
double box_error(double sigma, int passes) {
  const double large[] = {0.21, 0.053, 0.029, 0.0205, 0.016}, small[] = {0.21, 0.058, 0.032, 0.028, 0.039};
  return (sigma >= 3 ? large : small)[passes - 1];
}

// Pixels that an axis reaches to each side, worked out apart from the host's code: passes windows of variance
// sigma^2 / passes, whose whole pixels 2r + 1 have the variance r (r + 1) / 3, and one pixel more a pass.
int reach_of(double sigma, int passes) {
  int r = 0;
  while ((r + 1) * (r + 2) / 3.0 <= sigma * sigma / passes) ++r;
  return passes * (r + 1);
}

// A window's sum of n values rounds n times; it is at most n, and divided by n again.
double box_rounding(double sigma, int passes) {
  return 2 * passes * (2.0 * reach_of(sigma, passes) / passes + 4) * 0x1p-24;
}

void add_errors(std::vector<Case>& cases) {
  for (const double sigma : {0.5, 1.0, 2.0, 4.0, 12.0, 33.0, 100.0, 500.0})
    for (int passes = 1; passes <= 5; ++passes)
      cases.push_back({"", fmt::format("box, {} passes, sigma {}", passes, sigma),
                       "half the L1 norm of the impulse response's error stays below that of as many boxes",
                       box_error(sigma, passes), [=](Context& context) -> Result<double> {
                         const int reach = static_cast<int>(std::ceil(9 * sigma)) + 8, n = 2 * reach + 1;
                         Values src(n, 0.0);
                         src[reach] = 1;
                         const auto out = blur(context, boxes(n, 1, sigma, Format::f32x1, Border::clamp, passes), src);
                         if (!out) return out.status();
                         return half_l1(out.value(), impulse_truth(n, sigma));
                       }});
  for (const double sigma : {0.3, 1.0, 4.7, 100.0})
    for (int passes = 1; passes <= 5; ++passes)
      cases.push_back({"", fmt::format("box, variance of {} passes, sigma {}", passes, sigma),
                       "the impulse response has the variance sigma^2 exactly (relative to it)", 4e-6,
                       [=](Context& context) -> Result<double> {
                         const int reach = reach_of(sigma, passes) + 2, n = 2 * reach + 1;
                         Values src(n, 0.0);
                         src[reach] = 1;
                         const auto out = blur(context, boxes(1, n, sigma, Format::f32x1, Border::clamp, passes), src);
                         if (!out) return out.status();
                         double sum = 0, variance = 0;
                         for (int i = 0; i < n; ++i) {
                           sum += out.value()[i];
                           variance += out.value()[i] * (i - reach) * (i - reach);
                         }
                         return std::fabs(variance / sum / (sigma * sigma) - 1);
                       }});
}

void add_rounding(std::vector<Case>& cases) {
  for (const double sigma : {0.5, 2.0, 12.0, 100.0, 500.0})
    cases.push_back({"", fmt::format("box in f32, sigma {}", sigma),
                     "float against double: a window's sum rounds once a pixel", box_rounding(sigma, 3),
                     [=](Context& context) -> Result<double> {
                       const int width = sigma > 50 ? 3001 : 401, height = 5;
                       const Values src = quantise(scene::noise(width, height, 1, 20), Format::f32x1);
                       const auto out = blur(context, boxes(width, height, sigma), src);
                       if (!out) return out.status();
                       const auto exact = Context::open("cpu:double");
                       if (!exact) return exact.status();
                       const auto expected = blur(*exact.value(), boxes(width, height, sigma), src);
                       if (!expected) return expected.status();
                       return max_difference(out.value(), expected.value());
                     }});
}

// Values lie in 0..1: an axis moves a result by at most box_error, and where outside is nothing by twice that over the half
// of the weights that is inside at least.
void add_ends(std::vector<Case>& cases) {
  const auto add = [&](int width, int height, double sigma, Border border, Format format, int passes) {
    const double axes = (width > 1) + (height > 1), share = border == Border::zero ? 4 : 1;
    cases.push_back(
        {"",
         fmt::format("box {}x{}, sigma {}, {} {}, {} passes", width, height, sigma, name(border), name(format), passes),
         "any size and border: within the boxes' error of the truth", axes * share * box_error(sigma, passes) + 1e-6,
         [=](Context& context) -> Result<double> {
           const Values src = quantise(scene::noise(width, height, channels(format), 21), format);
           const auto out = blur(context, boxes(width, height, sigma, format, border, passes), src);
           if (!out) return out.status();
           return max_difference(out.value(), truth::gaussian(src, width, height, channels(format), sigma, border));
         }});
  };
  for (const Border border : borders) {
    for (int passes = 1; passes <= 5; ++passes) add(37, 23, 3, border, Format::f32x4, passes);
    add(5, 3, 13, border, Format::f32x4, 3);
    add(2, 2, 5, border, border == Border::clamp ? Format::f32x2 : Format::f32x4, 3);
    add(401, 5, 66, border, Format::f32x4, 4);
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 31}, {31, 1}, {17, 13}, {127, 3}})
    add(width, height, 2, Border::clamp, Format::f32x4, 3);
  add(1, 29, 2, Border::mirror, Format::f32x2, 1);
  add(29, 1, 2, Border::zero, Format::f32x4, 2);
}

// Sigma far above the size: the mean, or with clamp that of the corners.
void add_limits(std::vector<Case>& cases) {
  // Of the windows of the last pass, 16 + 12 pixels at most are not edge pixels, each of a weight of 1 / (1.3 sigma).
  for (const Border border : borders)
    cases.push_back({"", fmt::format("box, sigma 900 on 16x12, {}", name(border)),
                     border == Border::clamp ? "sigma far above the size: the mean of the four corners"
                                             : "sigma far above the size: the mean",
                     border == Border::clamp  ? (16 + 12) / (900 * 1.3)
                     : border == Border::zero ? 1e-4
                                              : 3e-3,
                     [=](Context& context) -> Result<double> {
                       const Values src = scene::noise(16, 12, 1, 2);
                       const auto out = blur(context, boxes(16, 12, 900, Format::f32x4, border), as_four(src));
                       if (!out) return out.status();
                       return max_difference(out.value(), Values(4 * src.size(), limit_of(src, 16, 12, border)));
                     }});
}

void add_constants(std::vector<Case>& cases) {
  for (const Border border : borders)
    for (const double sigma : {0.7, 8.0, 100.0}) {
      const auto changed = [=](double value) {
        return [=](Context& context) -> Result<double> {
          const Values src = quantise(Values(53 * 31 * 4, value), Format::f32x4);
          const auto out = blur(context, boxes(53, 31, sigma, Format::f32x4, border), src);
          if (!out) return out.status();
          return max_difference(out.value(), src);
        };
      };
      cases.push_back({"", fmt::format("box, constant 1, sigma {}, {}", sigma, name(border)),
                       "the weights sum to 1: a constant 1 stays 1 to the bit", 0, changed(1), false, not_double});
      cases.push_back({"", fmt::format("box, constant 0.7, sigma {}, {}", sigma, name(border)),
                       "a constant image stays constant to rounding", box_rounding(sigma, 3), changed(0.7)});
    }
}

// One pixel `value` among others: counts pixels for which `bad(inside the reach, result, result without that pixel)`.
template <class Bad>
Case one_pixel(std::string name, std::string promise, double value, Values background, int passes, Bad bad) {
  constexpr int side = 61, centre = 30;
  return {"", fmt::format("box, {}, {} passes", name, passes), std::move(promise), 0,
          [=](Context& context) -> Result<double> {
            const GaussianBlurParams p = boxes(side, side, 4, Format::f32x1, Border::clamp, passes);
            const int reach = reach_of(4, passes);
            Values src = background;
            const auto without = blur(context, p, src);
            if (!without) return without.status();
            src[centre * side + centre] = value;
            const auto with = blur(context, p, src);
            if (!with) return with.status();
            double count = 0;
            for (int y = 0; y < side; ++y)
              for (int x = 0; x < side; ++x) {
                const bool in = std::abs(x - centre) <= reach && std::abs(y - centre) <= reach;
                count += bad(in, with.value()[y * side + x], without.value()[y * side + x]) ? 1 : 0;
              }
            return count;
          }};
}

void add_one_pixel_cases(std::vector<Case>& cases) {
  const Values zeros(61 * 61, 0.0), picture = quantise(scene::noise(61, 61, 1, 4), Format::f32x1);
  for (const int passes : {1, 3, 5}) {
    cases.push_back(one_pixel("one NaN", "a NaN spreads over exactly the pixels that the passes' windows reach", nan,
                              picture, passes,
                              [](bool in, double v, double v0) { return in ? !std::isnan(v) : !same(v, v0); }));
    cases.push_back(one_pixel("one infinity", "an infinity stays within that reach, as infinity", HUGE_VAL, picture,
                              passes, [](bool in, double v, double v0) { return in ? v != HUGE_VAL : !same(v, v0); }));
    cases.push_back(one_pixel("1e30 on 0", "finite and positive within that reach, exactly 0 beyond", 1e30, zeros,
                              passes, [](bool in, double v, double) { return in ? !(v > 0 && v <= 1e30) : v != 0; }));
    cases.push_back(one_pixel("spike of 1e6 on 0..1",
                              "beyond that reach not a bit changes: running sums leave no residue", 1e6, picture,
                              passes, [](bool in, double v, double v0) { return in ? !(v > v0) : !same(v, v0); }));
    cases.push_back(one_pixel("spike of 1e30 on 0..1",
                              "beyond that reach not a bit changes: running sums leave no residue", 1e30, picture,
                              passes, [](bool in, double v, double v0) { return in ? !(v > v0) : !same(v, v0); }));
  }
}

void add_denormals(std::vector<Case>& cases) {
  cases.push_back({"", "box, denormals",
                   "denormal input: sums are exact, each of 6 passes rounds two products (in steps of 2^-149)", 9,
                   [=](Context& context) -> Result<double> {
                     Values src = scene::noise(29, 11, 1, 5);
                     for (double& v : src) v = static_cast<float>(v * 1e-40);
                     const auto out = blur(context, boxes(29, 11, 2), src);
                     if (!out) return out.status();
                     const auto exact = Context::open("cpu:double");
                     if (!exact) return exact.status();
                     const auto expected = blur(*exact.value(), boxes(29, 11, 2), src);
                     if (!expected) return expected.status();
                     return max_difference(out.value(), expected.value()) / 0x1p-149;
                   }});
}

}  // namespace

void add_box_cases(std::vector<Case>& cases) {
  add_errors(cases);
  add_rounding(cases);
  add_ends(cases);
  add_limits(cases);
  add_constants(cases);
  add_one_pixel_cases(cases);
  add_denormals(cases);
}

}  // namespace luxel::cases

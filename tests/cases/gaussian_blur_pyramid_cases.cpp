// The pyramid variant: its error, its variance, flicker, ends, and how far a pixel reaches.
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

GaussianBlurParams pyramid(int width, int height, double sigma, int levels,
                           PyramidFilter filter = PyramidFilter::linear, Format format = Format::f32x1,
                           Border border = Border::clamp) {
  GaussianBlurParams p = blur_params(width, height, sigma, -1, format, border, GaussianVariant::pyramid);
  p.levels = levels;
  p.filter = filter;
  return p;
}

const char* filter_name(PyramidFilter filter) { return filter == PyramidFilter::linear ? "linear" : "cubic"; }

// Sigma of the coarsest level's blur, worked out apart from the host's code: a level down and up adds the variance of its
// weights, 3/4 + 3/4 (linear) or 5/4 + 4/3 (cubic), in its own pixels.
double coarse_sigma(double sigma, int levels, PyramidFilter filter) {
  const double added = filter == PyramidFilter::linear ? 1.5 : 31.0 / 12, cells = std::pow(4.0, levels);
  return std::sqrt((sigma * sigma - added * (cells - 1) / 3) / cells);
}

// How far a pixel reaches: half a level's weights (down and up), twice as far at each next level; the blur at the last.
int reach_of(double sigma, int levels, PyramidFilter filter) {
  const int radius = static_cast<int>(std::ceil(4 * coarse_sigma(sigma, levels, filter)));
  const int ways = filter == PyramidFilter::linear ? 4 : 7;
  return radius * (1 << levels) + ways * ((1 << levels) - 1);
}

// What an impulse at each of the 2^levels places of a coarse pixel becomes, shifted back to the middle.
Result<std::vector<Values>> responses(Context& context, double sigma, int levels, PyramidFilter filter) {
  const int reach = reach_of(sigma, levels, filter) + static_cast<int>(5 * sigma), n = 2 * reach + 1,
            places = 1 << levels;
  std::vector<Values> all;
  for (int place = 0; place < places; ++place) {
    Values src(n + places, 0.0);
    src[reach + place] = 1;
    const auto out = blur(context, pyramid(n + places, 1, sigma, levels, filter), src);
    if (!out) return out.status();
    all.emplace_back(out.value().begin() + place, out.value().begin() + place + n);
  }
  return all;
}

struct Setting {
  double sigma;
  int levels;
  double linear, cubic;  // bounds
};

// Errors depend on the coarse sigma alone: 1.3, 1.8 to 2, about 2.9. Cutting the coarse blur at 4 of its sigma gives 6e-5.
void add_errors(std::vector<Case>& cases) {
  const Setting settings[] = {{4, 1, 1.7e-3, 4e-4},  {8, 2, 1.3e-3, 4.5e-4},  {12, 2, 4.2e-4, 1.4e-4},
                              {12, 3, 3e-3, 1.4e-3}, {16, 3, 1.2e-3, 4.5e-4}, {33, 4, 1.2e-3, 4e-4},
                              {100, 5, 4e-4, 1.4e-4}};
  for (const Setting& s : settings)
    for (const PyramidFilter filter : {PyramidFilter::linear, PyramidFilter::cubic})
      cases.push_back(
          {"", fmt::format("pyramid of {} levels, {}, sigma {}", s.levels, filter_name(filter), s.sigma),
           "half the L1 norm of the impulse response's error, the largest over all places in a coarse pixel",
           filter == PyramidFilter::linear ? s.linear : s.cubic, [=](Context& context) -> Result<double> {
             const auto all = responses(context, s.sigma, s.levels, filter);
             if (!all) return all.status();
             const int n = static_cast<int>(all.value()[0].size());
             const Values& exact = impulse_truth(n, s.sigma);
             double most = 0;
             for (const Values& response : all.value()) {
               const double d = half_l1(response, exact);
               if (!(d <= most)) most = d;
             }
             return most;
           }});
}

void add_variance(std::vector<Case>& cases) {
  for (const auto& [sigma, levels] : {std::pair{4.0, 1}, {12.0, 2}, {12.0, 3}})
    for (const PyramidFilter filter : {PyramidFilter::linear, PyramidFilter::cubic})
      // A Gaussian that is cut at 4 sigma has lost 8 phi(4) = 1.07e-3 of its variance.
      cases.push_back({"", fmt::format("pyramid, variance, {} levels, {}, sigma {}", levels, filter_name(filter), sigma),
                       "the mean variance is sigma^2 with the resampling filters', but for what is cut off (relative)",
                       1.2e-3, [=, sigma = sigma, levels = levels](Context& context) -> Result<double> {
                         const auto all = responses(context, sigma, levels, filter);
                         if (!all) return all.status();
                         double sum = 0, variance = 0;
                         for (const Values& response : all.value()) {
                           const int middle = static_cast<int>(response.size()) / 2;
                           for (int i = 0; i <= 2 * middle; ++i) {
                             sum += response[i];
                             variance += response[i] * (i - middle) * (i - middle);
                           }
                         }
                         return std::fabs(variance / sum / (sigma * sigma) - 1);
                       }});
}

// A bright pixel that moves: how much its blurred peak changes from place to place.
void add_flicker(std::vector<Case>& cases) {
  const Setting settings[] = {
      {8, 2, 2.6e-3, 2.2e-4}, {12, 2, 6e-4, 5e-5}, {12, 3, 1.1e-2, 1.5e-3}, {16, 3, 3.3e-3, 2.5e-4}};
  for (const Setting& s : settings)
    for (const PyramidFilter filter : {PyramidFilter::linear, PyramidFilter::cubic})
      cases.push_back(
          {"", fmt::format("pyramid, flicker, {} levels, {}, sigma {}", s.levels, filter_name(filter), s.sigma),
           "the peak that a bright pixel becomes, as it moves over a coarse pixel (largest over smallest, less 1)",
           filter == PyramidFilter::linear ? s.linear : s.cubic, [=](Context& context) -> Result<double> {
             const auto all = responses(context, s.sigma, s.levels, filter);
             if (!all) return all.status();
             double least = HUGE_VAL, most = 0;
             for (const Values& response : all.value()) {
               const double peak = *std::max_element(response.begin(), response.end());
               least = std::min(least, peak);
               most = std::max(most, peak);
             }
             return most / least - 1;
           }});
}

// Values lie in 0..1: an axis moves a result by at most the error of its response, at levels of 1.8 coarse pixels of sigma.
void add_ends(std::vector<Case>& cases) {
  const auto add = [&](int width, int height, double sigma, Border border, Format format, int levels,
                       PyramidFilter filter) {
    const double axes = (width > 1) + (height > 1), share = border == Border::zero ? 4 : 1;
    const double error = filter == PyramidFilter::linear ? 1.7e-3 : 4.5e-4;
    cases.push_back(
        {"",
         fmt::format("pyramid {}x{}, sigma {}, {} {}, {} levels, {}", width, height, sigma, name(border), name(format),
                     levels, filter_name(filter)),
         "any size and border: within the pyramid's error of the truth", axes * share * error + 1e-6,
         [=](Context& context) -> Result<double> {
           const Values src = quantise(scene::noise(width, height, channels(format), 21), format);
           const auto out = blur(context, pyramid(width, height, sigma, levels, filter, format, border), src);
           if (!out) return out.status();
           return max_difference(out.value(), truth::gaussian(src, width, height, channels(format), sigma, border));
         }});
  };
  for (const Border border : borders) {
    for (const PyramidFilter filter : {PyramidFilter::linear, PyramidFilter::cubic}) {
      add(37, 23, 4, border, Format::f32x4, 1, filter);
      add(38, 23, 8, border, Format::f32x4, 2, filter);
    }
    add(5, 3, 16, border, Format::f32x4, 3, PyramidFilter::linear);
    add(2, 2, 8, border, border == Border::clamp ? Format::f32x2 : Format::f32x4, 2, PyramidFilter::linear);
    add(401, 5, 66, border, Format::f32x4, 5, PyramidFilter::linear);
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 31}, {31, 1}, {17, 13}, {127, 3}})
    add(width, height, 8, Border::clamp, Format::f32x4, 2, PyramidFilter::linear);
  add(1, 29, 8, Border::mirror, Format::f32x2, 2, PyramidFilter::linear);
  add(29, 1, 8, Border::zero, Format::f32x4, 2, PyramidFilter::linear);
}

void add_limits(std::vector<Case>& cases) {
  for (const Border border : borders)
    cases.push_back(
        {"", fmt::format("pyramid, sigma 200 on 16x12, {}", name(border)),
         border == Border::clamp ? "sigma far above the size: the mean of the four corners"
                                 : "sigma far above the size: the mean",
         border == Border::clamp ? (16 + 12) / (200 * 2.5066) : 2e-3, [=](Context& context) -> Result<double> {
           const Values src = scene::noise(16, 12, 1, 2);
           const auto out = blur(context, pyramid(16, 12, 200, -1, PyramidFilter::linear, Format::f32x4, border), as_four(src));
           if (!out) return out.status();
           return max_difference(out.value(), Values(4 * src.size(), limit_of(src, 16, 12, border)));
         }});
}

// Roundings of an axis: each level down and up adds at most 6 + 5 products, the blur 2R + 1, each half a unit of at most 1.
double pyramid_rounding(double sigma, int levels, PyramidFilter filter) {
  return 2 * (2 * levels * 11 + 2 * 4 * coarse_sigma(sigma, levels, filter) + 4) * 0x1p-25;
}

void add_rounding(std::vector<Case>& cases) {
  for (const auto& [sigma, levels] : {std::pair{4.0, 1}, {12.0, 2}, {100.0, 5}})
    cases.push_back({"", fmt::format("pyramid in f32, sigma {}", sigma), "float against double: a rounding a tap",
                     pyramid_rounding(sigma, levels, PyramidFilter::cubic),
                     [sigma = sigma, levels = levels](Context& context) -> Result<double> {
                       const Values src = quantise(scene::noise(201, 35, 1, 20), Format::f32x1);
                       const GaussianBlurParams p = pyramid(201, 35, sigma, levels, PyramidFilter::cubic);
                       const auto out = blur(context, p, src);
                       if (!out) return out.status();
                       const auto exact = Context::open("cpu:double");
                       if (!exact) return exact.status();
                       const auto expected = blur(*exact.value(), p, src);
                       if (!expected) return expected.status();
                       return max_difference(out.value(), expected.value());
                     }});
  for (const Border border : borders)
    for (const double value : {1.0, 0.7})
      cases.push_back(
          {"", fmt::format("pyramid, constant {}, {}", value, name(border)),
           value == 1 && border != Border::zero ? "the weights sum to 1: a constant 1 stays 1 to the bit"
                                                : "a constant image stays constant to rounding",
           value == 1 && border != Border::zero ? 0 : pyramid_rounding(12, 2, PyramidFilter::cubic),
           [=](Context& context) -> Result<double> {
             const Values src = quantise(Values(53 * 31 * 4, value), Format::f32x4);
             const auto out = blur(context, pyramid(53, 31, 12, 2, PyramidFilter::cubic, Format::f32x4, border), src);
             if (!out) return out.status();
             return max_difference(out.value(), src);
           },
           false, value == 1 && border != Border::zero ? not_double : std::function<bool(const DeviceInfo&)>()});
}

// One pixel `value` among others: counts pixels for which `bad(distance below the reach, result, result without it)`.
template <class Bad>
void add_one_pixel(std::vector<Case>& cases, std::string text, std::string promise, double value, Values background,
                   Bad bad) {
  constexpr int side = 161, centre = 80;
  for (const PyramidFilter filter : {PyramidFilter::linear, PyramidFilter::cubic})
    cases.push_back(
        {"", fmt::format("pyramid, {}, {}", text, filter_name(filter)), promise, 0, [=](Context& context) -> Result<double> {
           const GaussianBlurParams p = pyramid(side, side, 8, 2, filter);
           const int reach = reach_of(8, 2, filter);
           Values src = background;
           const auto without = blur(context, p, src);
           if (!without) return without.status();
           src[centre * side + centre] = value;
           const auto with = blur(context, p, src);
           if (!with) return with.status();
           double count = 0;
           for (int y = 0; y < side; ++y)
             for (int x = 0; x < side; ++x) {
               const int far = std::max(std::abs(x - centre), std::abs(y - centre));
               const double v = with.value()[y * side + x], v0 = without.value()[y * side + x];
               count += bad(far, reach, v, v0) ? 1 : 0;
             }
           return count;
         }});
}

void add_one_pixel_cases(std::vector<Case>& cases) {
  const Values zeros(161 * 161, 0.0), picture = quantise(scene::noise(161, 161, 1, 4), Format::f32x1);
  for (const auto& [text, value] : {std::pair{"one NaN", nan}, {"one infinity", HUGE_VAL}})
    add_one_pixel(cases, text,
                  "not finite up to 4 sigma, not a bit of change beyond 2^L R + 4 (2^L - 1) pixels (cubic: 7)", value,
                  picture, [](int far, int reach, double v, double v0) {
                    return far <= 24 ? std::isfinite(v) : far > reach ? !same(v, v0) : false;
                  });
  add_one_pixel(cases, "1e30 on 0",
                "finite, positive up to 3 sigma, exactly 0 beyond 2^L R + 4 (2^L - 1) pixels (cubic: 7)", 1e30, zeros,
                [](int far, int reach, double v, double) {
                  return far <= 24 ? !(v > 0 && v <= 1e30) : far > reach ? v != 0 : !(v >= 0 && v <= 1e30);
                });
  add_one_pixel(cases, "spike of 1e6 on 0..1", "beyond 2^L R + 4 (2^L - 1) pixels (cubic: 7) not a bit changes", 1e6,
                picture, [](int far, int reach, double v, double v0) {
                  return far <= 24 ? !(v > v0) : far > reach ? !same(v, v0) : !(v >= v0);
                });
}

// The levels' cells do not fit a period that is no multiple of 2^L: then the sum is kept to the pyramid's error.
void add_wrap(std::vector<Case>& cases) {
  cases.push_back({"", "pyramid, sum of all pixels, wrap, 127x61", "with wrap the sum is kept to the pyramid's error",
                   1e-4, [=](Context& context) -> Result<double> {
                     const Values src = quantise(scene::noise(127, 61, 1, 8), Format::f32x1);
                     const auto out =
                         blur(context, pyramid(127, 61, 8, 2, PyramidFilter::linear, Format::f32x1, Border::wrap), src);
                     if (!out) return out.status();
                     double before = 0, after = 0;
                     for (std::size_t i = 0; i < src.size(); ++i) {
                       before += src[i];
                       after += out.value()[i];
                     }
                     return std::fabs(after / before - 1);
                   }});
}

}  // namespace

void add_pyramid_cases(std::vector<Case>& cases) {
  add_errors(cases);
  add_variance(cases);
  add_flicker(cases);
  add_ends(cases);
  add_limits(cases);
  add_rounding(cases);
  add_one_pixel_cases(cases);
  add_wrap(cases);
}

}  // namespace luxel::cases

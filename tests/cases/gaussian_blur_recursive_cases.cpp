// The recursive variant: its error and rounding from sigma 0.5 to 500, its ends, what a spike and a NaN leave.
#include <algorithm>
#include <cmath>
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

GaussianBlurParams recursive(int width, int height, double sigma, Format format = Format::f32x1,
                             Border border = Border::clamp, int order = 5) {
  GaussianBlurParams p = blur_params(width, height, sigma, -1, format, border, GaussianVariant::recursive);
  p.order = order;
  return p;
}

// Half the L1 norm of the error of the impulse response of an axis, as measured, rounded up. The poles are fitted at large
// sigma; just above 1 they are at their worst, and just below the zeros that take their place are.
double fit_error(double sigma, int order) {
  const double large[] = {0.011, 0.0036, 0.0013}, at_two[] = {0.0145, 0.0058, 0.0022}, at_one[] = {0.036, 0.019, 0.011};
  return (sigma >= 4 ? large : sigma >= 2 ? at_two : at_one)[order - 3];
}

void add_errors(std::vector<Case>& cases) {
  for (const double sigma :
       {0.5, 0.7, 0.9, 0.999, 1.0, 1.049, 1.05, 1.099, 1.1, 1.5, 2.0, 4.0, 12.0, 33.0, 100.0, 500.0})
    for (const int order : {3, 4, 5})
      cases.push_back({"", fmt::format("recursive, order {}, sigma {}", order, sigma),
                       "half the L1 norm of the impulse response's error stays below the fit's",
                       fit_error(sigma, order), [=](Context& context) -> Result<double> {
                         const int reach = static_cast<int>(std::ceil(16 * sigma)) + 8, n = 2 * reach + 1;
                         Values src(n, 0.0);
                         src[reach] = 1;
                         const auto out =
                             blur(context, recursive(n, 1, sigma, Format::f32x1, Border::clamp, order), src);
                         if (!out) return out.status();
                         return half_l1(out.value(), impulse_truth(n, sigma));
                       }});
}

// A step of y += (1 - p)(x - y) rounds y by half a unit, 2^-25, and forgets it after 1 / (1 - p) steps, which is about 0.8
// sigma for a real pole and 0.45 sigma for each of a pair's two states: at worst 6 sigma 2^-24 over the states of an axis.
// Independent roundings give about the root of their number; along the flat side of a step they agree, and come near a
// tenth of the worst case.
double recursive_rounding(double sigma) { return (8 + 2 * std::sqrt(sigma)) * 0x1p-24; }
double step_rounding(double sigma) { return (8 + 0.25 * sigma) * 0x1p-24; }

void add_rounding(std::vector<Case>& cases) {
  for (const double sigma : {0.5, 2.0, 12.0, 100.0, 500.0})
    for (const bool step : {false, true})
      cases.push_back({"", fmt::format("recursive in f32, sigma {}, {}", sigma, step ? "a step" : "noise"),
                       "float against double: the cascade in difference form does not lose digits as sigma grows",
                       step ? step_rounding(sigma) : recursive_rounding(sigma),
                       [=](Context& context) -> Result<double> {
                         const int width = sigma > 50 ? 8001 : 401, height = 5;
                         const Values image =
                             step ? scene::step_edge(width, height, 1, width / 2) : scene::noise(width, height, 1, 20);
                         const Values src = quantise(image, Format::f32x1);
                         const auto out = blur(context, recursive(width, height, sigma), src);
                         if (!out) return out.status();
                         const auto exact = Context::open("cpu:double");
                         if (!exact) return exact.status();
                         const auto expected = blur(*exact.value(), recursive(width, height, sigma), src);
                         if (!expected) return expected.status();
                         return max_difference(out.value(), expected.value());
                       }});
}

// Values lie in 0..1, and so does what every border makes of them: an axis moves a result by at most fit_error, and where
// outside is nothing, by twice that over the half of the weights that is inside at least.
void add_ends(std::vector<Case>& cases) {
  const auto add = [&](int width, int height, double sigma, Border border, Format format, int order) {
    const double axes = (width > 1) + (height > 1), share = border == Border::zero ? 4 : 1;
    cases.push_back({"",
                     fmt::format("recursive {}x{}, sigma {}, {} {}, order {}", width, height, sigma, name(border),
                                 name(format), order),
                     "any size and border: within the fit's error of the truth",
                     axes * share * fit_error(sigma, order) + 2 * recursive_rounding(sigma),
                     [=](Context& context) -> Result<double> {
                       const Values src = quantise(scene::noise(width, height, channels(format), 21), format);
                       const auto out = blur(context, recursive(width, height, sigma, format, border, order), src);
                       if (!out) return out.status();
                       return max_difference(out.value(),
                                             truth::gaussian(src, width, height, channels(format), sigma, border));
                     }});
  };
  // Order, axis, border and format meet in pairs: each value of one with each of the others (equal bits: formats).
  for (const Border border : borders) {
    const bool rows = border == Border::clamp || border == Border::wrap;
    add(rows ? 37 : 1, rows ? 1 : 23, 3, border, Format::f32x4, 3);
    add(rows ? 1 : 37, rows ? 23 : 1, 3, border, Format::f32x4, 4);
    add(37, 23, 3, border, Format::f32x4, 5);
    add(border == Border::mirror ? 1 : 37, border == Border::wrap ? 1 : 23, 0.6, border, Format::f32x4, 5);
    add(5, 3, 13, border, Format::f32x4, 5);
    add(2, 2, 5, border, border == Border::clamp ? Format::f32x2 : Format::f32x4, 5);
    add(401, 5, 66, border, Format::f32x4, 5);
  }
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 31}, {31, 1}, {17, 13}, {127, 3}})
    add(width, height, 2, Border::clamp, Format::f32x4, 5);
  add(1, 29, 2, Border::mirror, Format::f32x2, 5);
  add(29, 1, 2, Border::zero, Format::f32x4, 5);
}

// Sigma far above the size: the mean, or with clamp that of the corners.
void add_limits(std::vector<Case>& cases) {
  for (const Border border : borders)
    cases.push_back({"", fmt::format("recursive, sigma 3000 on 16x12, {}", name(border)),
                     border == Border::clamp ? "sigma far above the size: the mean of the four corners"
                                             : "sigma far above the size: the mean",
                     border == Border::clamp ? (16 + 12) / (3000 * 2.5066) : 2e-6,
                     [=](Context& context) -> Result<double> {
                       const Values src = scene::noise(16, 12, 1, 2);
                       const auto out = blur(context, recursive(16, 12, 3000, Format::f32x4, border), as_four(src));
                       if (!out) return out.status();
                       return max_difference(out.value(), Values(4 * src.size(), limit_of(src, 16, 12, border)));
                     }});
}

void add_constants(std::vector<Case>& cases) {
  for (const Border border : borders)
    for (const double sigma : {0.7, 8.0})
      cases.push_back({"", fmt::format("recursive, constant 0.7, sigma {}, {}", sigma, name(border)),
                       border == Border::zero
                           ? "a constant image stays constant to rounding (in units of the last place)"
                           : "a constant image stays constant to the bit",
                       border == Border::zero ? 16.0 : 0.0, [=](Context& context) -> Result<double> {
                         const Values src = quantise(Values(53 * 31 * 4, 0.7), Format::f32x4);
                         const auto out = blur(context, recursive(53, 31, sigma, Format::f32x4, border), src);
                         if (!out) return out.status();
                         return max_difference(out.value(), src) / step(Format::f32x1, 0.7);
                       }});
}

// One channel is spoilt, its neighbours are not touched.
void add_spoilt(std::vector<Case>& cases) {
  for (const auto& [text, value] : {std::pair{"NaN", nan}, {"infinity", HUGE_VAL}})
    for (const Border border : {Border::clamp, Border::wrap})
      cases.push_back({"", fmt::format("recursive, one {}, {}", text, name(border)),
                       "one NaN or infinity makes the whole of its channel NaN and leaves other channels alone (values "
                       "that break it)",
                       0, [=, value = value](Context& context) -> Result<double> {
                         Values src = quantise(scene::noise(41, 29, 4, 22), Format::f32x4);
                         const GaussianBlurParams p = recursive(41, 29, 2, Format::f32x4, border);
                         const auto without = blur(context, p, src);
                         if (!without) return without.status();
                         src[4 * (13 * 41 + 20)] = value;
                         const auto with = blur(context, p, src);
                         if (!with) return with.status();
                         double bad = 0;
                         for (std::size_t i = 0; i < src.size(); ++i)
                           bad += (i % 4 == 0 ? std::isnan(with.value()[i]) : same(with.value()[i], without.value()[i]))
                                      ? 0
                                      : 1;
                         return bad;
                       }});
}

void add_spikes(std::vector<Case>& cases) {
  const int width = 401, height = 11, at = 5 * width + 200;
  const double sigma = 3;
  cases.push_back({"", "recursive, 1e30 on 0", "finite, and below 1e30 everywhere (values that break it)", 0,
                   [=](Context& context) -> Result<double> {
                     Values src(width * height, 0.0);
                     src[at] = 1e30;
                     const auto out = blur(context, recursive(width, height, sigma), src);
                     if (!out) return out.status();
                     return static_cast<double>(std::count_if(out.value().begin(), out.value().end(),
                                                              [](double v) { return !(std::fabs(v) < 1e30); }));
                   }});
  // Beyond 40 sigma the filter itself has less than 1e6 e^(-1.3 * 40) = 3e-17 left.
  cases.push_back({"", "recursive, what a spike of 1e6 leaves",
                   "beyond 40 sigma a result differs from that without the spike by rounding alone",
                   recursive_rounding(sigma), [=](Context& context) -> Result<double> {
                     Values src = quantise(scene::noise(width, height, 1, 23), Format::f32x1);
                     const auto without = blur(context, recursive(width, height, sigma), src);
                     if (!without) return without.status();
                     src[at] = 1e6;
                     const auto with = blur(context, recursive(width, height, sigma), src);
                     if (!with) return with.status();
                     double most = 0;
                     for (int y = 0; y < height; ++y)
                       for (int x = 0; x < width; ++x)
                         if (std::abs(x - 200) > 40 * sigma) {
                           const double d = std::fabs(with.value()[y * width + x] - without.value()[y * width + x]);
                           if (!(d <= most)) most = d;
                         }
                     return most;
                   }});
  cases.push_back({"", "recursive, denormals", "denormal input: within 64 steps of 2^-149 of the double execution", 64,
                   [=](Context& context) -> Result<double> {
                     Values src = scene::noise(29, 11, 1, 5);
                     for (double& v : src) v = static_cast<float>(v * 1e-40);
                     const auto out = blur(context, recursive(29, 11, 2), src);
                     if (!out) return out.status();
                     const auto exact = Context::open("cpu:double");
                     if (!exact) return exact.status();
                     const auto expected = blur(*exact.value(), recursive(29, 11, 2), src);
                     if (!expected) return expected.status();
                     return max_difference(out.value(), expected.value()) / 0x1p-149;
                   }});
}

}  // namespace

void add_recursive_cases(std::vector<Case>& cases) {
  add_errors(cases);
  add_rounding(cases);
  add_ends(cases);
  add_limits(cases);
  add_constants(cases);
  add_spoilt(cases);
  add_spikes(cases);
}

}  // namespace luxel::cases

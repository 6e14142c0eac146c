// Values that are not ordinary: NaN, infinities, spikes, denormals, constants.
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "bench/truth/gaussian_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int side = 41, centre = 20;

bool reached(std::size_t pixel, int radius) {
  return std::abs(static_cast<int>(pixel % side) - centre) <= radius &&
         std::abs(static_cast<int>(pixel / side) - centre) <= radius;
}

// One pixel `value` on `background`: counts pixels for which `bad(inside the reach, result, result without that
// pixel)`.
template <class Bad>
Case one_pixel(std::string name, std::string promise, double value, Values background, GaussianBlurParams params,
               Bad bad) {
  return {"", std::move(name), std::move(promise), 0, [=](Context& context) -> Result<double> {
            Values src = background;
            const auto without = blur(context, params, src);
            if (!without) return without.status();
            src[centre * side + centre] = value;
            const auto with = blur(context, params, src);
            if (!with) return with.status();
            double count = 0;
            for (std::size_t i = 0; i < src.size(); ++i)
              count += bad(reached(i, params.radius), with.value()[i], without.value()[i]) ? 1 : 0;
            return count;
          }};
}

void add_one_pixel_cases(std::vector<Case>& cases) {
  const Values zeros(side * side, 0.0), picture = scene::noise(side, side, 1, 4);
  for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::direct}) {
    GaussianBlurParams p = blur_params(side, side, 2.0, 6, Format::f32x1, Border::clamp, variant);
    const auto tag = [&](const char* text) {
      return fmt::format("{}, {}{}", text, name(variant), p.difference ? " difference" : "");
    };
    cases.push_back(
        one_pixel(tag("one NaN"), "a NaN spreads over exactly the (2R+1)^2 pixels within R (pixels that break it)", nan,
                  picture, p, [](bool in, double v, double v0) { return in ? !std::isnan(v) : !same(v, v0); }));
    cases.push_back(one_pixel(tag("one infinity"), "an infinity stays within R, as infinity", HUGE_VAL, picture, p,
                              [](bool in, double v, double v0) { return in ? v != HUGE_VAL : !same(v, v0); }));
    cases.push_back(one_pixel(tag("1e30 on 0"),
                              "finite and positive within R, exactly 0 beyond: no infinity, no residue", 1e30, zeros, p,
                              [](bool in, double v, double) { return in ? !(v > 0 && v <= 1e30) : v != 0; }));
    cases.push_back(one_pixel(tag("spike of 1e6 on 0..1"), "beyond R not a bit changes", 1e6, picture, p,
                              [](bool in, double v, double v0) { return in ? !(v > v0) : !same(v, v0); }));
    p.difference = true;
    cases.push_back(
        one_pixel(tag("one NaN"), "a NaN spreads over exactly the (2R+1)^2 pixels within R (pixels that break it)", nan,
                  picture, p, [](bool in, double v, double v0) { return in ? !std::isnan(v) : !same(v, v0); }));
    cases.push_back(one_pixel(tag("1e30 on 0"), "finite within R, exactly 0 beyond: no infinity, no residue", 1e30,
                              zeros, p, [](bool in, double v, double) { return in ? !std::isfinite(v) : v != 0; }));
  }
}

void add_denormals(std::vector<Case>& cases) {
  // A product rounds to the next multiple of 2^-149, by at most half; 2R + 1 of them a pass (in pairs, so fewer here).
  const int radius = 6;
  cases.push_back({"", "denormals", "denormal input keeps its value to (2R+1) steps of 2^-149 a pass (in such steps)",
                   2.0 * (2 * radius + 1), [=](Context& context) -> Result<double> {
                     Values src = scene::noise(29, 11, 1, 5);
                     for (double& v : src) v = static_cast<float>(v * 1e-40);
                     const auto out = blur(context, blur_params(29, 11, 2, radius, Format::f32x1), src);
                     if (!out) return out.status();
                     return max_difference(out.value(), truth::gaussian(src, 29, 11, 1, 2, Border::clamp, radius)) /
                            0x1p-149;
                   }});
}

// A constant image, as a count of changed values.
void add_constants(std::vector<Case>& cases) {
  const auto changed = [](GaussianBlurParams p, double value) {
    return [=](Context& context) -> Result<double> {
      const Values src =
          quantise(Values(static_cast<std::size_t>(p.width) * p.height * channels(p.format), value), p.format);
      const auto out = blur(context, p, src);
      if (!out) return out.status();
      return count_different(out.value(), src);
    };
  };
  for (const Border border : borders) {
    GaussianBlurParams p = blur_params(53, 31, 8, 36, Format::f32x4, border);
    p.difference = true;
    cases.push_back({"", fmt::format("constant 0.7, difference, {}", name(border)),
                     "in difference form a constant image stays constant to the bit (values that differ)", 0,
                     changed(p, 0.7)});
  }
  for (const Format format : pixel_formats)
    for (const int radius : {12, 36, 100})
      cases.push_back({"", fmt::format("constant 1, R {}, {}", radius, name(format)),
                       "the weights sum to 1 in the storage format: a constant 1 stays 1 (values that differ)", 0,
                       changed(blur_params(23, 19, radius / 3.0, radius, format), 1.0),
                       radius != 36 && format != Format::f32x4, not_double});
  for (const Border border : {Border::mirror, Border::wrap})
    cases.push_back({"", fmt::format("constant 1, {}", name(border)), "a constant 1 stays 1 at this border too", 0,
                     changed(blur_params(23, 19, 4, 12, Format::f32x4, border), 1.0), false, not_double});
  for (const int radius : {12, 36, 100})
    cases.push_back({"", fmt::format("constant 0.7, plain form, R {}", radius),
                     "plain f32 sums drift by rounding only (in units of the last place)", 2.0 * (radius + 3),
                     [=](Context& context) -> Result<double> {
                       const Values src = quantise(Values(23 * 19, 0.7), Format::f32x1);
                       const auto out = blur(context, blur_params(23, 19, radius / 3.0, radius, Format::f32x1), src);
                       if (!out) return out.status();
                       return max_difference(out.value(), src) / step(Format::f32x1, 0.7);
                     }});
}

void add_strides(std::vector<Case>& cases) {
  for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::direct, GaussianVariant::recursive,
                                        GaussianVariant::box, GaussianVariant::pyramid})
    for (const Border border : borders)
      cases.push_back({"", fmt::format("strides 40 and 37 for 29, {} {}", name(variant), name(border)),
                       "what lies between the rows is neither read nor written (NaN there; values that break it)", 0,
                       [=](Context& context) -> Result<double> {
                         const int width = 29, height = 13, src_stride = 40, dst_stride = 37;
                         const Values tight = scene::noise(width, height, 1, 6);
                         Values src(static_cast<std::size_t>(height - 1) * src_stride + width, nan);
                         for (int y = 0; y < height; ++y)
                           for (int x = 0; x < width; ++x) src[y * src_stride + x] = tight[y * width + x];
                         GaussianBlurParams p = blur_params(width, height, 2, 6, Format::f32x1, border, variant);
                         const auto expected = blur(context, p, tight);
                         if (!expected) return expected.status();
                         p.src_stride = src_stride;
                         p.dst_stride = dst_stride;
                         const auto out = blur(context, p, src);
                         if (!out) return out.status();
                         double bad = 0;
                         for (std::size_t i = 0; i < out.value().size(); ++i) {
                           const std::size_t x = i % dst_stride, y = i / dst_stride;
                           const double v = out.value()[i];
                           bad += (x < width ? same(v, expected.value()[y * width + x]) : std::isnan(v)) ? 0 : 1;
                         }
                         return bad;
                       },
                       variant != GaussianVariant::separable&& border != Border::clamp});
}

}  // namespace

void add_value_cases(std::vector<Case>& cases) {
  add_one_pixel_cases(cases);
  add_denormals(cases);
  add_constants(cases);
  add_strides(cases);
}

}  // namespace luxel::cases

// Values that are not ordinary: NaN, infinities, steps of 1e6, weights that underflow, constants, sizes, strides.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int side = 33, centre = 16;

// Values that are not those of src.
Case unchanged(std::string name, std::string promise, const BilateralParams& p) {
  return {"", std::move(name), std::move(promise), 0, [=](Context& context) -> Result<double> {
            const BilateralImages images = bilateral_images(p, 5);
            const auto out = filter(context, p, images);
            if (!out) return out.status();
            return count_different(out.value().dst, images.src);
          }};
}

void add_sigma(std::vector<Case>& cases) {
  for (const Format format : pixel_formats) {
    BilateralParams p = bilateral_params(29, 17, "c", format);
    p.alpha = channels(format) == 4;
    p.sigma_range = 0;
    const std::string promise = "the input, bit for bit (values that differ)";
    cases.push_back(unchanged(fmt::format("sigma_range 0, {}", name(format)), promise, p));
    p.sigma_range = 1e-30;
    cases.push_back(unchanged(fmt::format("sigma_range 1e-30, {}", name(format)), promise, p));
    cases.back().slow = format != Format::f32x4;
    p.sigma_range = 0.1;
    p.sigma_space = 0;
    p.radius = 4;
    cases.push_back(unchanged(fmt::format("sigma_space 0, {}", name(format)), promise, p));
    p.sigma_space = 0.1;  // exp(-1/0.02): below 2^-64
    cases.push_back(unchanged(fmt::format("sigma_space 0.1, {}", name(format)), promise, p));
  }
}

void add_constants(std::vector<Case>& cases) {
  for (const Format format : pixel_formats)
    for (const std::string terms : {"", "c"})
      cases.push_back({"", fmt::format("constant 0.7, {}, terms '{}'", name(format), terms),
                       "a constant image stays constant to the bit (values that differ)", 0,
                       [=](Context& context) -> Result<double> {
                         const BilateralParams p = bilateral_params(21, 15, terms, format);
                         BilateralImages images = bilateral_images(p, 5);
                         images.src = quantise(Values(images.src.size(), 0.7), format);
                         const auto out = filter(context, p, images);
                         if (!out) return out.status();
                         return count_different(out.value().dst, images.src);
                       }});
}

// One pixel `value`: counts pixels that break the promise, and 1e6 where the counter is not 1.
Case one_pixel(std::string what, double value, const BilateralParams& params) {
  BilateralParams p = params;
  p.count = true;
  return {"", fmt::format("one {}", what),
          "the pixel stays; others lie among the other values, and beyond R are as without it, bit for bit; it is counted "
          "(pixels that break it)",
          0, [=](Context& context) -> Result<double> {
            BilateralImages images = bilateral_images(p, 6);
            const int n = channels(p.format);
            const double most = 1.01 * *std::max_element(images.src.begin(), images.src.end());
            const auto without = filter(context, p, images);
            if (!without) return without.status();
            const std::size_t at = static_cast<std::size_t>(centre) * side + centre;
            images.src[at * n] = value;
            const auto with = filter(context, p, images);
            if (!with) return with.status();
            const int reach = p.variant == BilateralVariant::atrous ? (p.taps / 2 << p.levels) - p.taps / 2 : p.radius;
            double count = with.value().counters[0] == 1 ? 0 : 1e6;
            for (std::size_t i = 0; i < images.src.size(); ++i) {
              const int x = static_cast<int>(i / n % side), y = static_cast<int>(i / n / side);
              const double v = with.value().dst[i];
              if (i / n == at)
                count += same(v, images.src[i]) ? 0 : 1;
              else if (std::abs(x - centre) <= reach && std::abs(y - centre) <= reach)
                count += v >= 0 && v <= most ? 0 : 1;
              else
                count += same(v, without.value().dst[i]) ? 0 : 1;
            }
            return count;
          }};
}

void add_one_pixel_cases(std::vector<Case>& cases) {
  for (const std::string terms : {"", "c", "gdn", "l"})
    for (const auto& [what, value] : {std::pair{"NaN", nan}, {"infinity", static_cast<double>(HUGE_VAL)}}) {
      cases.push_back(
          one_pixel(fmt::format("{}, terms '{}'", what, terms), value, bilateral_params(side, side, terms)));
      BilateralParams p = bilateral_params(side, side, terms, Format::f32x1);
      p.variant = BilateralVariant::atrous;
      p.levels = 2;
      cases.push_back(one_pixel(fmt::format("{}, atrous, terms '{}'", what, terms), value, p));
      cases.back().slow = terms != "c";
      p.variant = BilateralVariant::separable;
      cases.push_back(one_pixel(fmt::format("{}, separable, terms '{}'", what, terms), value, p));
      cases.back().slow = terms != "c";
    }
}

void add_steps(std::vector<Case>& cases) {
  cases.push_back({"", "HDR step of 1e6",
                   "neither side takes from the other: the dark side stays in 0..1 (largest value there)", 1,
                   [](Context& context) -> Result<double> {
                     const BilateralParams p = bilateral_params(side, side, "c", Format::f32x1);
                     BilateralImages images = bilateral_images(p, 7);
                     images.src = quantise(scene::noise(side, side, 1, 7), p.format);
                     for (int i = 0; i < side * side; ++i)
                       if (i % side >= centre) images.src[i] += 1e6;
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     double most = 0;
                     for (int i = 0; i < side * side; ++i)
                       if (i % side < centre && !(out.value().dst[i] <= most)) most = out.value().dst[i];
                     return most;
                   }});
  cases.push_back(
      {"", "weights that underflow",
       "sigma_range of 1/40 of the steps between pixels: nothing but the input is left, no NaN, no denormal "
       "(largest difference)",
       0, [](Context& context) -> Result<double> {
         BilateralParams p = bilateral_params(side, side, "c", Format::f32x1);
         p.sigma_range = 1.0 / 40;
         BilateralImages images = bilateral_images(p, 8);
         for (int i = 0; i < side * side; ++i) images.src[i] = i;
         const auto out = filter(context, p, images);
         if (!out) return out.status();
         return max_difference(out.value().dst, images.src);
       }});
}

void add_sizes(std::vector<Case>& cases) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 19}, {23, 1}, {3, 2}, {17, 5}})
    for (const Border border : borders)
      cases.push_back({"", fmt::format("{}x{}, R 9, {}", width, height, name(border)),
                       "an image smaller than the window follows the formula (largest difference)", 2e-6,
                       [=, width = width, height = height](Context& context) -> Result<double> {
                         BilateralParams p = bilateral_params(width, height, "c", Format::f32x2, border);
                         p.radius = 9;
                         const BilateralImages images = bilateral_images(p, 9);
                         const auto out = filter(context, p, images);
                         if (!out) return out.status();
                         return max_difference(out.value().dst, truth::bilateral(p, images).src);
                       },
                       width > 1 && height > 1 && border != Border::clamp});
}

void add_strides(std::vector<Case>& cases) {
  for (const BilateralVariant variant :
       {BilateralVariant::direct, BilateralVariant::separable, BilateralVariant::atrous})
    cases.push_back({"", fmt::format("strides 40 and 37 for 29, variant {}", static_cast<int>(variant)),
                     "what lies between the rows is neither read nor written (NaN there; values that break it)", 0,
                     [=](Context& context) -> Result<double> {
                       BilateralParams p = bilateral_params(29, 13, "c", Format::f32x1);
                       p.variant = variant;
                       p.levels = 2;
                       const BilateralImages tight = bilateral_images(p, 10);
                       const auto expected = filter(context, p, tight);
                       if (!expected) return expected.status();
                       BilateralImages spread = tight;
                       spread.src.assign(static_cast<std::size_t>(12) * 40 + 29, nan);
                       for (int y = 0; y < 13; ++y)
                         for (int x = 0; x < 29; ++x) spread.src[y * 40 + x] = tight.src[y * 29 + x];
                       p.src_stride = 40;
                       p.dst_stride = 37;
                       const auto out = filter(context, p, spread);
                       if (!out) return out.status();
                       double bad = 0;
                       for (std::size_t i = 0; i < out.value().dst.size(); ++i) {
                         const std::size_t x = i % 37, y = i / 37;
                         const double v = out.value().dst[i];
                         bad += (x < 29 ? same(v, expected.value().dst[y * 29 + x]) : std::isnan(v)) ? 0 : 1;
                       }
                       return bad;
                     }});
}

}  // namespace

void add_bilateral_value_cases(std::vector<Case>& cases) {
  add_sigma(cases);
  add_constants(cases);
  add_one_pixel_cases(cases);
  add_steps(cases);
  add_sizes(cases);
  add_strides(cases);
}

}  // namespace luxel::cases

// Results that must be equal to those of the C++ execution, bit for bit, for every term, format, border and variant.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tests/cases/bilateral_cases.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"

namespace luxel::cases {
namespace {

Case equal_to_cpp(std::string name, const BilateralParams& p) {
  return {"",
          "bits, " + name,
          "the same bits as the C++ execution in float (values that differ)",
          0,
          [=](Context& context) -> Result<double> {
            const BilateralImages images = bilateral_images(p, 20, true);
            const auto out = filter(context, p, images);
            if (!out) return out.status();
            const auto cpu = Context::open("cpu:float");
            if (!cpu) return cpu.status();
            const auto expected = filter(*cpu.value(), p, images);
            if (!expected) return expected.status();
            return count_different(out.value().dst, expected.value().dst);
          },
          false,
          not_double};
}

// Noise, with a NaN and an infinity in the image and in the guide.
BilateralImages spoilt_images(const BilateralParams& p) {
  BilateralImages images = bilateral_images(p, 20);
  const std::size_t n = images.src.size();
  if (p.format == Format::unorm8x4 || n < 400) return images;
  images.src[n / 2] = std::numeric_limits<double>::quiet_NaN();
  images.src[n / 3 * 1 + 1] = HUGE_VAL;
  if (p.range == RangeTerm::guide) images.guide[images.guide.size() / 4] = std::numeric_limits<double>::quiet_NaN();
  return images;
}

// The packed form (whole texels, the window unrolled) against the form of planes: on every device, as if it read texels fast.
Case packed_equals_planes(std::string name, const BilateralParams& p) {
  return {"",
          "packed form, " + name,
          "the same bits as the form of planes, and another form (values that differ)",
          0,
          [=](Context& context) -> Result<double> {
            const BilateralImages images = spoilt_images(p);
            Profile texels = context.profile(), planes = texels;
            texels.texels = true;
            texels.pixels.unroll = std::max(texels.pixels.unroll, 5);
            planes.pixels.unroll = 0;
            const auto a = filter(context, p, images, texels), b = filter(context, p, images, planes);
            if (!a) return a.status();
            if (!b) return b.status();
            return count_different(a.value().dst, b.value().dst) + 
                   (a.value().part == "bilateral_packed" && b.value().part == "bilateral" ? 0 : 1e6);
          }};
}

void add_packed(std::vector<Case>& cases) {
  for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4})
    for (const Border border : {Border::clamp, Border::mirror, Border::wrap}) {
      BilateralParams p = bilateral_params(43, 29, border == Border::mirror ? "g" : "c", format, border);
      p.guide_format = format;
      p.window = border == Border::clamp ? FilterWindow::circle : FilterWindow::square;
      p.range_norm = border == Border::wrap ? RangeNorm::l2 : RangeNorm::l1;
      p.alpha = border == Border::wrap;
      p.radius = border == Border::clamp ? 4 : 2;
      cases.push_back(packed_equals_planes(fmt::format("{}, border {}", name(format), static_cast<int>(border)), p));
      cases.back().slow = format == Format::f16x4 && border != Border::clamp;
    }
  // Smaller than the window, and less than an invocation's results.
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {1, 9}})
    cases.push_back(packed_equals_planes(fmt::format("{}x{}", width, height), bilateral_params(width, height, "g")));
}

}  // namespace

void add_bilateral_equality_cases(std::vector<Case>& cases) {
  for (const std::string terms : {"", "c", "g", "d", "s", "n", "l", "cdnl"})
    cases.push_back(equal_to_cpp(fmt::format("terms '{}'", terms), bilateral_params(67, 43, terms)));
  for (const Format format : pixel_formats)
    for (const Border border : borders) {
      cases.push_back(equal_to_cpp(fmt::format("{}, {}", name(format), name(border)),
                                   bilateral_params(43, 29, "c", format, border)));
      // A format and a border meet only in the loads and stores: a row and a column of the table nearly say it all.
      cases.back().slow = format != Format::f32x4 && border != Border::clamp;
    }
  for (const Format format : pixel_formats) {
    BilateralParams p = bilateral_params(43, 29, "gn", format);
    p.guide_format = format;
    p.normal_format = channels(format) == 4 ? format : Format::f32x4;
    cases.push_back(equal_to_cpp(fmt::format("guides of {}", name(format)), p));
  }
  for (const BilateralVariant variant : {BilateralVariant::separable, BilateralVariant::atrous}) {
    BilateralParams p = bilateral_params(67, 43, "cdnl");
    p.variant = variant;
    cases.push_back(equal_to_cpp(fmt::format("variant {}", static_cast<int>(variant)), p));
  }
  BilateralParams p = bilateral_params(67, 43, "c");
  p.variant = BilateralVariant::separable;
  p.adaptive = true;
  p.radius = 9;
  cases.push_back(equal_to_cpp("adaptive", p));
  p = bilateral_params(67, 43, "g");
  p.flat = 0.5;
  p.sigma_range = 1;
  cases.push_back(equal_to_cpp("flat tiles", p));
  cases.push_back(packed_equals_planes("flat tiles", p));
  p = bilateral_params(67, 43, "c");
  p.window = FilterWindow::circle;
  p.range_norm = RangeNorm::l1;
  p.radius = 9;
  p.step = 2;
  cases.push_back(equal_to_cpp("circle, L1, steps of 2", p));
  add_packed(cases);
}

std::vector<Case> bilateral_cases() {
  std::vector<Case> cases;
  add_bilateral_formula_cases(cases);
  add_bilateral_value_cases(cases);
  add_bilateral_guide_cases(cases);
  add_bilateral_equality_cases(cases);
  add_bilateral_left_out_cases(cases);
  for (Case& c : cases) c.kernel = "bilateral";
  add_bilateral_variant_cases(cases);
  return cases;
}

}  // namespace luxel::cases

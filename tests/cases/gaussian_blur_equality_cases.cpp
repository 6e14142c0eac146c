// Results that must be equal to others: to the C++ execution, in place, image against buffer, variants among each
// other.
#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

Case equal_to_cpp(GaussianBlurParams p, std::string options) {
  return {"",
          fmt::format("bits, {} {} {}{}", name(p.variant), name(p.format), name(p.border), options),
          "the same bits as the C++ execution in float (values that differ)",
          0,
          [=](Context& context) -> Result<double> {
            const Values src = quantise(scene::noise(p.width, p.height, channels(p.format), 10), p.format);
            const auto out = blur(context, p, src);
            if (!out) return out.status();
            const auto cpu = Context::open("cpu:float");
            if (!cpu) return cpu.status();
            const auto expected = blur(*cpu.value(), p, src);
            if (!expected) return expected.status();
            return count_different(out.value(), expected.value());
          },
          false,
          not_double};
}

void add_equal_bits(std::vector<Case>& cases) {
  for (const Format format : pixel_formats)
    for (const Border border : borders) {
      cases.push_back(equal_to_cpp(blur_params(67, 43, 3.7, 12, format, border), ""));
      cases.push_back(equal_to_cpp(blur_params(43, 29, 2, 6, format, border, GaussianVariant::direct), ""));
      for (const GaussianVariant variant : {GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid})
        cases.push_back(equal_to_cpp(blur_params(67, 43, 3.7, 12, format, border, variant), ""));
      // A format and a border meet only in the loads and stores, so that a row and a column of the table nearly say it
      // all.
      for (auto c = cases.end() - 5; c != cases.end(); ++c)
        c->slow = format != Format::f32x4 && border != Border::clamp;
    }
  GaussianBlurParams p = blur_params(67, 43, 3.7, 12);
  p.difference = true;
  cases.push_back(equal_to_cpp(p, " difference"));
  p.variant = GaussianVariant::direct;
  p.radius = 6;
  cases.push_back(equal_to_cpp(p, " difference"));
  for (const int order : {3, 4}) {
    GaussianBlurParams r = blur_params(67, 43, 3.7, 12, Format::f32x4, Border::clamp, GaussianVariant::recursive);
    r.order = order;
    cases.push_back(equal_to_cpp(r, fmt::format(" order {}", order)));
    r.sigma = 0.6;
    cases.push_back(equal_to_cpp(r, fmt::format(" order {} sigma 0.6", order)));
  }
  for (const int passes : {1, 4}) {
    GaussianBlurParams b = blur_params(67, 43, 3.7, 12, Format::f16x4, Border::clamp, GaussianVariant::box);
    b.passes = passes;
    cases.push_back(equal_to_cpp(b, fmt::format(" {} passes", passes)));
  }
  p = blur_params(67, 43, 12, 36, Format::f16x4, Border::clamp, GaussianVariant::pyramid);
  p.levels = 3;
  cases.push_back(equal_to_cpp(p, " 3 levels"));
  p.filter = PyramidFilter::cubic;
  cases.push_back(equal_to_cpp(p, " 3 levels cubic"));
  p = blur_params(67, 43, 60, 180, Format::f32x4, Border::clamp, GaussianVariant::box);
  cases.push_back(equal_to_cpp(p, " sigma 60"));
  p = blur_params(67, 43, 20, 60);
  cases.push_back(equal_to_cpp(p, " R 60"));
  for (const Format format : pixel_formats) {
    p = blur_params(67, 43, 3.7, 12, format, Border::mirror);
    p.input = Input::image;
    cases.push_back(equal_to_cpp(p, " image"));
    for (const GaussianVariant variant : {GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid}) {
      p = blur_params(67, 43, 3.7, 12, format, Border::clamp, variant);
      p.input = Input::image;
      cases.push_back(equal_to_cpp(p, " image"));
    }
  }
}

void add_in_place(std::vector<Case>& cases) {
  for (const Format format : pixel_formats)
    for (const GaussianVariant variant :
         {GaussianVariant::separable, GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid})
      cases.push_back({"", fmt::format("in place, {} {}", name(variant), name(format)),
                       "src == dst gives what src and dst apart give, bit for bit (values that differ)", 0,
                       [=](Context& context) -> Result<double> {
                         const Values src = quantise(scene::noise(45, 37, channels(format), 11), format);
                         const GaussianBlurParams p = blur_params(45, 37, 3.7, 12, format, Border::clamp, variant);
                         const auto apart = blur(context, p, src);
                         if (!apart) return apart.status();
                         Result<Run> run = Run::make(context, plan(p, context.profile()));
                         if (!run) return run.status();
                         run.value().alias("dst", "src");
                         if (Status status = run.value().write("src", src); !status) return status;
                         if (Status status = run.value().go(); !status) return status;
                         const auto in_place = run.value().read("src");
                         if (!in_place) return in_place.status();
                         return count_different(in_place.value(), apart.value());
                       }});
}

// |a - b| of two ways to blur the same image.
Case apart(std::string name, std::string promise, double bound, GaussianBlurParams a, GaussianBlurParams b) {
  return {"", std::move(name), std::move(promise), bound, [=](Context& context) -> Result<double> {
            const Values src = quantise(scene::noise(a.width, a.height, channels(a.format), 12), a.format);
            const auto first = blur(context, a, src);
            if (!first) return first.status();
            const auto second = blur(context, b, src);
            if (!second) return second.status();
            return max_difference(first.value(), second.value());
          }};
}

}  // namespace

void add_equality_cases(std::vector<Case>& cases) {
  add_equal_bits(cases);
  add_in_place(cases);
  for (const Border border : borders) {
    GaussianBlurParams direct = blur_params(51, 33, 2, 6, Format::f32x4, border, GaussianVariant::direct);
    GaussianBlurParams separable = direct;
    separable.variant = GaussianVariant::separable;
    // (2R+1)^2 = 169 terms, each rounded once more as it is added; they partly cancel.
    cases.push_back(apart(fmt::format("direct against separable, {}", name(border)),
                          "direct and separable agree to rounding", 170 * 0x1p-24, direct, separable));
    cases.back().slow = border == Border::mirror || border == Border::wrap;
  }
  for (const Border border : {Border::clamp, Border::wrap})
    for (const Format format : pixel_formats) {
      const GaussianBlurParams sampler = blur_params(51, 33, 2, 6, format, border, GaussianVariant::sampler);
      const GaussianBlurParams separable = blur_params(51, 33, 2, 6, format, border);
      cases.push_back(apart(fmt::format("sampler against separable, {} {}", name(format), name(border)),
                            "two texels a tap through the sampler: within the sampler's weights (2^-9 on each axis) "
                            "and one storage step of separable",
                            2 * 0x1p-9 + step(format, 0.5), sampler, separable));
      cases.back().slow = border == Border::wrap && format != Format::f32x4;
    }
}

}  // namespace luxel::cases

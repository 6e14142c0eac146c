// bilateral against its formula in double with library functions, and its approximations against the filter itself.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bench/truth/gaussian_truth.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// Weights err by 9.2e-8 in the power of 2 and, in floats, by the rounding of their exponents: a share of 2^-24 of what
// is left at the exponent's size, at most some 8 roundings of 64 at weights that no longer count. An average of values
// up to 1 by such weights, and the roundings of its sums: measured 3e-7 to 9e-7.
constexpr double formula_bound = 2e-6;
// As formula_bound; a cosine's logarithm is multiplied by sigma_normal (16), depths differ from a plane by differences
// of 1/z, whose roundings are divided by the footprint.
constexpr double guided_bound = 1e-5;

Case follows(std::string name, const BilateralParams& p, double bound, bool slow = false) {
  return {"",
          std::move(name),
          "within rounding of the formula in double with exp and pow (largest difference)",
          bound,
          [=](Context& context) -> Result<double> {
            const BilateralImages images = bilateral_images(p, 3);
            const auto out = filter(context, p, images);
            if (!out) return out.status();
            return max_difference(out.value().dst, truth::bilateral(p, images).src);
          },
          slow};
}

void add_terms(std::vector<Case>& cases) {
  for (const std::string terms : {"", "c", "g", "d", "s", "n", "l", "cdnl", "gsn"}) {
    const BilateralParams p = bilateral_params(37, 29, terms);
    const bool guided = terms.find_first_of("dsn") != std::string::npos;
    cases.push_back(follows(fmt::format("formula, terms '{}'", terms), p, guided ? guided_bound : formula_bound));
  }
  for (const Border border : {Border::clamp, Border::mirror, Border::wrap, Border::zero})
    for (const std::string terms : {"c", "gdn"}) {
      const BilateralParams p = bilateral_params(23, 19, terms, Format::f32x1, border);
      cases.push_back(
          follows(fmt::format("formula, border {}, terms '{}'", static_cast<int>(border), terms), p, guided_bound));
    }
}

void add_windows(std::vector<Case>& cases) {
  BilateralParams p = bilateral_params(41, 31, "c", Format::f32x4);
  p.window = FilterWindow::circle;
  p.range_norm = RangeNorm::l1;
  cases.push_back(follows("formula, circle, L1", p, formula_bound));
  p.radius = 9;
  p.step = 2;
  cases.push_back(follows("formula, circle R 9 in steps of 2", p, formula_bound));
  p.window = FilterWindow::square;
  p.step = 3;
  p.radius = 12;
  p.alpha = true;
  cases.push_back(follows("formula, square R 12 in steps of 3, alpha filtered", p, formula_bound));
  p = bilateral_params(41, 31, "c", Format::f32x2);
  p.sigma_space = inf;
  cases.push_back(follows("formula, sigma_space infinite", p, formula_bound));
}

void add_atrous(std::vector<Case>& cases) {
  for (const int taps : {3, 5})
    for (const std::string terms : {"c", "dn", "dnl"}) {
      BilateralParams p = bilateral_params(45, 37, terms);
      p.variant = BilateralVariant::atrous;
      p.taps = taps;
      p.levels = 4;
      cases.push_back(follows(fmt::format("formula, atrous, 4 levels of {} taps, terms '{}'", taps * taps, terms), p,
                              4 * guided_bound));
    }
  BilateralParams p = bilateral_params(45, 37, "dnl");
  p.variant = BilateralVariant::atrous;
  p.levels = 3;
  p.carry_variance = true;
  cases.push_back({"", "formula, atrous, variance of the result",
                   "Var' = sum w^2 Var / (sum w)^2 at every level (largest relative difference)", 4 * guided_bound,
                   [=](Context& context) -> Result<double> {
                     const BilateralImages images = bilateral_images(p, 3);
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     const Values expected = truth::bilateral(p, images).variance;
                     double most = 0;
                     for (std::size_t i = 0; i < expected.size(); ++i) {
                       const double e = std::fabs(out.value().variance_out[i] / expected[i] - 1);
                       if (!(e <= most)) most = e;
                     }
                     return most;
                   }});
}

void add_gaussian(std::vector<Case>& cases) {
  for (const Format format : {Format::f32x1, Format::f32x4})
    cases.push_back({"", fmt::format("sigma_range infinite, {}", name(format)),
                     "with a square window, what gaussian_blur computes (largest difference from its truth)",
                     formula_bound, [=](Context& context) -> Result<double> {
                       BilateralParams p = bilateral_params(33, 27, "c", format);
                       p.sigma_range = inf;
                       p.alpha = channels(format) == 4;
                       const BilateralImages images = bilateral_images(p, 4);
                       const auto out = filter(context, p, images);
                       if (!out) return out.status();
                       return max_difference(out.value().dst, truth::gaussian(images.src, 33, 27, channels(format),
                                                                              p.sigma_space, Border::clamp, p.radius));
                     }});
}

// Separable and adaptive are other filters: how far they are off is stated, as measured on this picture, rounded up.
void add_approximations(std::vector<Case>& cases) {
  const auto apart = [&](std::string name, std::string promise, BilateralParams p, double bound) {
    cases.push_back({"", std::move(name), std::move(promise), bound, [=](Context& context) -> Result<double> {
                       const BilateralImages images = bilateral_images(p, 3);
                       const auto out = filter(context, p, images);
                       if (!out) return out.status();
                       return max_difference(out.value().dst, truth::bilateral(p, images).src);
                     }});
  };
  BilateralParams p = bilateral_params(61, 43, "c");
  p.variant = BilateralVariant::separable;
  apart("separable beside direct",
        "rows, then columns, is within 0.06 of the filter on two levels with noise (largest difference)", p, 0.06);
  p.adaptive = true;
  p.sigma_space = 4;
  p.radius = 12;
  apart("adaptive beside direct", "pairs of averaged pixels in the outer half: within 0.1 (largest difference)", p,
        0.1);
  p = bilateral_params(61, 43, "c");
  p.variant = BilateralVariant::separable;
  cases.push_back({"", "separable, either order",
                   "rows first and columns first differ by at most 0.03 (largest difference)", 0.03,
                   [=](Context& context) -> Result<double> {
                     const BilateralImages images = bilateral_images(p, 3);
                     BilateralParams q = p;
                     q.width = p.height;
                     q.height = p.width;
                     BilateralImages turned = images;
                     const auto turn = [&](const Values& from, int width, int height) {
                       Values to(from.size());
                       for (int y = 0; y < height; ++y)
                         for (int x = 0; x < width; ++x)
                           for (int c = 0; c < 4; ++c) to[(x * height + y) * 4 + c] = from[(y * width + x) * 4 + c];
                       return to;
                     };
                     turned.src = turn(images.src, p.width, p.height);
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     const auto other = filter(context, q, turned);
                     if (!other) return other.status();
                     return max_difference(out.value().dst, turn(other.value().dst, q.width, q.height));
                   }});
}

}  // namespace

void add_bilateral_formula_cases(std::vector<Case>& cases) {
  add_terms(cases);
  add_windows(cases);
  add_atrous(cases);
  add_gaussian(cases);
  add_approximations(cases);
}

}  // namespace luxel::cases

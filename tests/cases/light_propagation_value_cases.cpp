// lpv_propagate: values at the ends of the formats, lobes that no light has, symmetry.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "tests/cases/compare.h"
#include "tests/cases/light_propagation_cases.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

std::size_t pixel_at(const LpvGrid& g, int x, int y, int z) {
  return static_cast<std::size_t>(4 * ((z * g.extent[1] + y) * g.extent[0] + x));
}

void put(Values& light, const LpvGrid& g, std::array<int, 3> at, const std::array<double, 3>& n, double flux) {
  for (std::size_t i = 0; i < 4; ++i) light[pixel_at(g, at[0], at[1], at[2]) + i] = lpv_cosine(static_cast<int>(i), n, flux);
}

// Dim light beside bright: the error of every cell in units of what reaches that cell.
Case bright_beside_dim() {
  Case c{"light_propagation", "1e6 beside 1e-6", "relative error of a cell's flux, the cells before a bright and a dim light", 2e-6};
  c.measure = [](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({20, 5, 5});
    p.iterations = 4;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    put(light, p.grid, {5, 2, 2}, {1, 0, 0}, 1e6);
    put(light, p.grid, {6, 2, 2}, {0, 1, 0}, 1e-6);
    put(light, p.grid, {17, 2, 2}, {0, 0, 1}, 1e-6);
    const Values expected = truth::lpv_propagated(p, light, {});
    const Result<Values> got = propagate(context, p, light);
    if (!got) return got.status();
    // Twice in reach of the dim light alone, and the bright one's own cells.
    double most = 0;
    for (const auto& at : {std::array{17, 2, 2}, {17, 2, 3}, {18, 2, 2}, {6, 2, 2}, {5, 2, 2}, {7, 2, 2}}) {
      const std::size_t i = pixel_at(p.grid, at[0], at[1], at[2]);
      const double e = std::fabs(got.value()[i] / expected[i] - 1);
      if (!(e <= most)) most = e;
    }
    return most;
  };
  return c;
}

Case no_flux(LpvLobes lobes, double bound) {
  Case c{"light_propagation", std::string("lobes without flux, ") + name(lobes),
         lobes == LpvLobes::clamp  ? "clamp makes flux of a lobe that has none: what 4 steps sum up to, over the lobe's coefficient"
         : lobes == LpvLobes::linear ? "a lobe with c0 = 0 has no flux after 4 steps either, over the lobe's coefficient"
                                     : "a lobe with c0 = 0 sends nothing: largest value after 4 steps",
         bound};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 9, 9}, 2, lobes);
    p.iterations = 4;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    light[pixel_at(p.grid, 8, 4, 4) + 3] = 1, light[pixel_at(p.grid, 8, 4, 4) + 1] = -2;
    const Result<Values> got = propagate(context, p, light);
    if (!got) return got.status();
    if (lobes == LpvLobes::linear || lobes == LpvLobes::clamp) return std::fabs(lpv_flux(got.value(), lpv_pixels(p.grid, 2, 1)));
    double most = 0;
    for (const double v : got.value()) if (!(std::fabs(v) <= most)) most = std::fabs(v);
    return most;
  };
  return c;
}

// f16 in and out, f32 between: the result is that of the f32 form, rounded once.
Case f16_rounds_once() {
  Case c{"light_propagation", "f16, 6e-8 to 65504", "values that differ from the f32 result rounded to f16", 0};
  c.applies = not_double;
  c.measure = [](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 6, 5});
    p.iterations = 3;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    put(light, p.grid, {2, 2, 2}, {0, 1, 0}, 1.2e-7);  // coefficients near the smallest f16, 6e-8: sixths of it vanish
    put(light, p.grid, {12, 2, 2}, {0, 0, 1}, 65504 * 3.2);
    put(light, p.grid, {12, 2, 3}, {0, 0, -1}, 65504 * 3.2);
    light = quantise(light, Format::f16x4);
    const Result<Values> exact = propagate(context, p, light);
    p.format = Format::f16x4;
    const Result<Values> got = propagate(context, p, light);
    if (!exact) return exact.status();
    if (!got) return got.status();
    return count_different(got.value(), quantise(exact.value(), Format::f16x4));
  };
  return c;
}

Case f16_saturates() {
  Case c{"light_propagation", "f16 beyond 65504", "values that are not finite, where neighbours of 65504 add up", 0};
  c.applies = not_double;
  c.measure = [](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({8, 4, 4});
    p.iterations = 20, p.border = LpvBorder::periodic, p.format = Format::f16x4;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    for (std::size_t at = 0; at < light.size(); at += 4) light[at] = 65504;
    const Result<Values> got = propagate(context, p, light);
    if (!got) return got.status();
    double bad = 0;
    for (std::size_t at = 0; at < light.size(); ++at)
      if (!(std::fabs(got.value()[at]) <= 65504) || (at % 4 == 0 && got.value()[at] != 65504)) ++bad;
    return bad;
  };
  return c;
}

Case scaled(const char* what, double flux, double bound) {
  Case c{"light_propagation", what, "largest error over the largest value", bound};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({16, 7, 7});
    p.iterations = 3;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    put(light, p.grid, {7, 3, 3}, {0.6, 0, 0.8}, flux);
    light = quantise(light, Format::f32x4);
    const Values expected = truth::lpv_propagated(p, light, {});
    const Result<Values> got = propagate(context, p, light);
    if (!got) return got.status();
    double most = 0;
    for (const double v : expected) most = std::max(most, std::fabs(v));
    return max_difference(got.value(), expected) / most;
  };
  return c;
}

// A value that is not finite reaches a ring more every step, and nothing beyond.
Case not_finite(const char* what, double value, LpvLobes lobes) {
  Case c{"light_propagation", std::string(what) + ", " + name(lobes), "values that differ more than three rings from it, after three steps", 0};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({20, 9, 9}, 2, lobes);
    p.iterations = 3;
    Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
    for (int x = 0; x < 20; x += 3) put(light, p.grid, {x, 4, 4}, {0, 1, 0}, 1);
    const Result<Values> clean = propagate(context, p, light);
    light[pixel_at(p.grid, 10, 4, 4) + 2] = value;
    const Result<Values> got = propagate(context, p, light);
    if (!clean) return clean.status();
    if (!got) return got.status();
    double different = 0;
    bool reached = false;
    for (int z = 0; z < 9; ++z)
      for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 20; ++x)
          for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t at = pixel_at(p.grid, x, y, z) + i;
            if (std::abs(x - 10) + std::abs(y - 4) + std::abs(z - 4) > 3) different += same(got.value()[at], clean.value()[at]) ? 0 : 1;
            else reached = reached || !same(got.value()[at], clean.value()[at]);
          }
    return reached ? different : std::numeric_limits<double>::quiet_NaN();
  };
  return c;
}

// The 48 maps of the cube onto itself: axes permuted and turned round.
Case symmetries(bool geometry, LpvLobes lobes) {
  Case c{"light_propagation", std::string("48 symmetries of the cube, ") + name(lobes) + (geometry ? ", geometry" : ""),
         "largest difference of the turned result from the result of turned light, over the largest value", 2e-6};
  c.measure = [=](Context& context) -> Result<double> {
    LpvPropagateParams p = lpv_params({5, 5, 5}, 2, lobes);
    p.iterations = 3, p.geometry = geometry;
    const Values light = lpv_lights(p.grid, 2, 12, 21), blocks = geometry ? lpv_surfels(p.grid, 1.5, 22) : Values();
    const Result<Values> plain = propagate(context, p, light, blocks);
    if (!plain) return plain.status();
    double scale = 0, most = 0;
    for (const double v : plain.value()) scale = std::max(scale, std::fabs(v));
    for (int symmetry = 0; symmetry < 48; ++symmetry) {
      const Result<Values> got = propagate(context, p, lpv_turned(light, 5, symmetry), geometry ? lpv_turned(blocks, 6, symmetry) : Values());
      if (!got) return got.status();
      const double d = max_difference(got.value(), lpv_turned(plain.value(), 5, symmetry)) / scale;
      if (!(d <= most)) most = d;
    }
    return most;
  };
  return c;
}

}  // namespace

void add_lpv_value_cases(std::vector<Case>& cases) {
  cases.push_back(bright_beside_dim());
  cases.push_back(no_flux(LpvLobes::linear, 1e-6));
  cases.push_back(no_flux(LpvLobes::clamp, 3.82));  // 0.9 of |c1| = 2.24 in the first step, then up to 2 % more a step
  cases.push_back(no_flux(LpvLobes::shrink, 0));
  cases.push_back(no_flux(LpvLobes::rescale, 0));
  cases.push_back(f16_rounds_once());
  cases.push_back(f16_saturates());
  cases.push_back(scaled("1e37", 1e37, 1e-6));
  cases.push_back(scaled("1e-30", 1e-30, 1e-6));
  cases.push_back(scaled("denormals", 1e-40, 2e-4));  // steps of 1.4e-45, a dozen roundings
  for (const LpvLobes lobes : all_lobes) cases.push_back(not_finite("NaN", std::numeric_limits<double>::quiet_NaN(), lobes));
  cases.push_back(not_finite("infinity", std::numeric_limits<double>::infinity(), LpvLobes::linear));
  cases.push_back(symmetries(false, LpvLobes::linear));
  cases.push_back(symmetries(true, LpvLobes::rescale));
}

}  // namespace luxel::cases

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "tests/cases/compare.h"
#include "tests/cases/lpv_cases.h"
#include "tests/cases/lpv_support.h"

namespace luxel::cases {
namespace {

using namespace lpv;

constexpr const char* kernel = "light_propagation";
constexpr double per_flux = 3.5449077018110318;  // flux of a cell over its c0: 2 sqrt(pi)
// The normal's length, a function, 1/pi, and at the end the three words: 14 roundings, as a share of the cell's c0.
constexpr double coefficient_bound = 14 * 0x1p-24;

LpvInjectParams params_of(const LpvGrid& grid, int bands = 2) {
  LpvInjectParams p;
  p.grid = grid;
  p.bands = bands;
  return p;
}

// Largest difference of a coefficient over the c0 of its cell and channel (what is nowhere must be 0).
double error_per_cell(const LpvInjectParams& p, const Values& v, const Values& truth) {
  if (v.size() != truth.size()) return std::nan("");
  const std::size_t cells = lpv_pixels(p.grid, 2, 1), quads = p.bands == 3 ? 3 : 1;
  double most = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::size_t pixel = i / 4, channel = pixel / (cells * quads), cell = pixel % cells;
    const double scale = truth[4 * (channel * quads * cells + cell)], d = std::fabs(v[i] - truth[i]);
    const double e = scale > 0 ? d / scale : d == 0 ? 0 : std::numeric_limits<double>::infinity();
    if (!(e <= most)) most = e;
  }
  return most;
}

double total_flux(const LpvInjectParams& p, const Values& v, std::size_t channel) {
  const std::size_t cells = lpv_pixels(p.grid, 2, 1), quads = p.bands == 3 ? 3 : 1;
  double sum = 0;
  for (std::size_t i = 0; i < cells; ++i) sum += v[4 * (channel * quads * cells + i)];
  return sum * per_flux;
}

void add_truths(std::vector<Case>& cases) {
  for (const int bands : {2, 3})
    cases.push_back({kernel, fmt::format("inject, 20000 lights in 7 x 5 x 6 cells, {} bands", bands),
                     "coefficients of the cosine lobes (largest error over the cell's c0)", coefficient_bound,
                     [=](Context& context) -> Result<double> {
                       const LpvInjectParams p = params_of(grid_of(7, 5, 6), bands);
                       const auto lights = random_lights(20000, p.grid.extent, 1);
                       const auto v = injected(context, p, list_of(lights));
                       if (!v) return v.status();
                       return error_per_cell(p, v.value(), injected_truth(p, lights));
                     }});
  cases.push_back({kernel, "inject, flux of 20000 lights", "all cells' flux is the lights' (relative difference)",
                   3 * 0x1p-24,  // 1/pi and sqrt(pi) in float; the rest of the roundings has no sign
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(7, 5, 6));
                     const auto lights = random_lights(20000, p.grid.extent, 5);
                     const auto v = injected(context, p, list_of(lights));
                     if (!v) return v.status();
                     double most = 0;
                     for (std::size_t c = 0; c < 3; ++c) {
                       double flux = 0;
                       for (const Light& l : lights) flux += l.flux[c];
                       most = std::max(most, std::fabs(total_flux(p, v.value(), c) / flux - 1));
                     }
                     return most;
                   }});
  cases.push_back({kernel, "inject, fluxes of 1e-6 and 1e6 in neighbours", "each cell is its own (largest error over its c0)",
                   coefficient_bound, [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(4, 1, 1), 3);
                     p.flux_max = 1e6;
                     std::vector<Light> lights;
                     for (int k = 0; k < 4; ++k) {
                       const double f = static_cast<float>(k % 2 == 0 ? 1e-6 : 1e6);
                       lights.push_back({{k + 0.5, 0.2, 0.3}, {0.125, 0.75, 0.5}, {f, f / 3, f / 7}});
                       for (double& c : lights.back().flux) c = static_cast<float>(c);
                     }
                     const auto v = injected(context, p, list_of(lights));
                     if (!v) return v.status();
                     return error_per_cell(p, v.value(), injected_truth(p, lights));
                   }});
  cases.push_back({kernel, "inject, 262144 weak lights in a cell with two of 2^40 times their flux, opposite",
                   "sums are exact (relative error of what the weak ones leave in c1)", coefficient_bound,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(1, 1, 1));
                     p.flux_max = 1048576;
                     p.channels = 1;
                     const double weak = 0x1p-20;
                     std::vector<Light> lights(262144, {{0.5, 0.5, 0.5}, {0, 1, 0}, {weak, 0, 0}});
                     lights[1000] = {{0.5, 0.5, 0.5}, {0, 0, 1}, {1048576, 0, 0}};
                     lights[200000] = {{0.5, 0.5, 0.5}, {0, 0, -1}, {1048576, 0, 0}};
                     for (Light& l : lights) l.place[1] = l.normal[1] > 0 ? 0.25 : 0.5;
                     p.offset = 0;
                     const auto v = injected(context, p, list_of(lights));
                     if (!v) return v.status();
                     const double expected = 262142 * weak / std::numbers::pi * std::sqrt(std::numbers::pi / 3);
                     return std::fabs(v.value()[1] / expected - 1) + std::fabs(v.value()[2]);
                   }});
}

void add_orders(std::vector<Case>& cases) {
  for (const Format format : {Format::f32x4, Format::f16x4})
    cases.push_back({kernel, fmt::format("inject, 20000 lights in three orders, {}", name(format)),
                     "sums do not depend on the order (values that differ)", 0, [=](Context& context) -> Result<double> {
                       LpvInjectParams p = params_of(grid_of(7, 5, 6), 3);
                       p.format = format;
                       auto lights = random_lights(20000, p.grid.extent, 9);
                       const auto a = injected(context, p, list_of(lights));
                       std::reverse(lights.begin(), lights.end());
                       const auto b = injected(context, p, list_of(lights));
                       for (std::size_t i = 1; i < lights.size(); ++i)
                         std::swap(lights[i], lights[static_cast<std::size_t>(uniform(static_cast<std::uint32_t>(i)) * static_cast<double>(i))]);
                       const auto c = injected(context, p, list_of(lights));
                       if (!a) return a.status();
                       if (!b) return b.status();
                       if (!c) return c.status();
                       return count_different(a.value(), b.value()) + count_different(a.value(), c.value());
                     }});
  cases.push_back({kernel, "inject, 20000 lights, every device", "the same bits as the C++ execution in float (values that differ)",
                   0,
                   [](Context& context) -> Result<double> {
                     const auto cpu = Context::open("cpu:float");
                     if (!cpu) return cpu.status();
                     double different = 0;
                     for (const int bands : {2, 3}) {
                       LpvInjectParams p = params_of(grid_of(7, 5, 6), bands);
                       p.flux_max = 0.9;
                       const Values lights = list_of(random_lights(20000, p.grid.extent, 13));
                       const auto a = injected(context, p, lights), b = injected(*cpu.value(), p, lights);
                       if (!a) return a.status();
                       if (!b) return b.status();
                       different += count_different(a.value(), b.value());
                     }
                     return different;
                   },
                   false, not_double});
}

void add_places(std::vector<Case>& cases) {
  cases.push_back({kernel, "inject, lights on faces, edges and corners", "they belong to the cell behind; on the last face outside (lights elsewhere)",
                   0, [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(3, 2, 2));
                     p.channels = 1;
                     double wrong = 0;
                     for (int z = 0; z <= 2; ++z)
                       for (int y = 0; y <= 2; ++y)
                         for (int x = 0; x <= 3; ++x) {
                           Values outcomes;
                           // Half a cell back, which the normal brings forward again.
                           const auto v = injected(context, p, list_of({Light{{x - 0.5, y * 1.0, z * 1.0}, {1, 0, 0}, {1, 0, 0}}}),
                                                   &outcomes);
                           if (!v) return v.status();
                           const bool inside = x < 3 && y < 2 && z < 2;
                           const auto& found = v.value();
                           wrong += outcomes[0] != inside || outcomes[1] != !inside;
                           for (std::size_t i = 0; i < found.size() / 4; ++i)
                             wrong += (found[4 * i] > 0) != (inside && i == static_cast<std::size_t>((z * 2 + y) * 3 + x));
                         }
                     return wrong;
                   }});
  cases.push_back({kernel, "inject, dropped and counted", "lights outside, invalid and saturated ones, each counted (counts that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(4, 4, 4));
                     const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
                     std::vector<Light> lights = random_lights(50, p.grid.extent, 21);
                     const std::vector<Light> good = lights;
                     const Light one{{1.5, 1.5, 1.5}, {0, 1, 0}, {1, 1, 1}};
                     double bad = 0;
                     for (std::size_t a = 0; a < 3; ++a)
                       for (const double v : {nan, infinity, -infinity}) {
                         Light l = one;
                         l.place[a] = v;
                         lights.push_back(l);
                         l = one;
                         l.normal[a] = v;
                         lights.push_back(l);
                         l = one;
                         l.flux[a] = v;
                         lights.push_back(l);
                         bad += 3;
                       }
                     for (std::size_t a = 0; a < 3; ++a, ++bad) {
                       lights.push_back(one);
                       lights.back().flux[a] = -1e-3;
                     }
                     for (const double far : {-0.6, 4.6, 1e9, -1e9, 1e38})
                       lights.push_back({{1.5, far, 1.5}, {1, 0, 0}, {1, 1, 1}});
                     Values outcomes, clean;
                     std::rotate(lights.begin(), lights.begin() + 60, lights.end());
                     const auto v = injected(context, p, list_of(lights), &outcomes);
                     const auto w = injected(context, p, list_of(good), &clean);
                     if (!v) return v.status();
                     if (!w) return w.status();
                     const Values expected{50, 5, bad, 0};
                     // What was dropped leaves no trace.
                     return count_different(outcomes, expected) + count_different(v.value(), w.value());
                   }});
  cases.push_back({kernel, "inject, flux above flux_max", "counts as flux_max, in any channel (values and counts that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(1, 1, 1));
                     p.flux_max = 0.75;
                     double wrong = 0;
                     for (std::size_t a = 0; a < 3; ++a) {
                       Light most{{0.5, 0.2, 0.5}, {0, 1, 0}, {0.25, 0.5, 0.125}};
                       most.flux[a] = 0.75;
                       Light more = most;
                       more.flux[a] = 3e30;
                       Values outcomes, two;
                       const auto v = injected(context, p, list_of({more}), &outcomes);
                       const auto w = injected(context, p, list_of({most}), &two);
                       if (!v) return v.status();
                       if (!w) return w.status();
                       wrong += count_different(v.value(), w.value()) + std::fabs(outcomes[3] - 1) + two[3] + std::fabs(outcomes[0] - 1);
                     }
                     return wrong;
                   }});
  cases.push_back({kernel, "inject, one channel", "green and blue are not looked at (values and counts that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(1, 1, 1));
                     p.channels = 1;
                     double wrong = 0;
                     for (const double other : {-1.0, 3.0, std::nan("")}) {
                       Values outcomes;
                       const auto v = injected(context, p, list_of({Light{{0.5, 0.2, 0.5}, {0, 1, 0}, {0.5, other, other}}}), &outcomes);
                       const auto w = injected(context, p, list_of({Light{{0.5, 0.2, 0.5}, {0, 1, 0}, {0.5, 0, 0}}}));
                       if (!v) return v.status();
                       if (!w) return w.status();
                       wrong += count_different(v.value(), w.value()) + count_different(outcomes, Values{1, 0, 0, 0});
                     }
                     return wrong;
                   }});
  cases.push_back({kernel, "inject, no light at all", "every cell is written 0 (values that are not)", 0,
                   [](Context& context) -> Result<double> {
                     const auto v = injected(context, params_of(grid_of(5, 3, 2), 3), {});
                     if (!v) return v.status();
                     double wrong = 0;
                     for (const double c : v.value()) wrong += c != 0;
                     return wrong;
                   }});
}

void add_normals(std::vector<Case>& cases) {
  cases.push_back({kernel, "inject, normal 0", "flux / (4 pi) everywhere, not moved (error of c0, and what is not 0 beyond)",
                   coefficient_bound, [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(2, 1, 1), 3);
                     double most = 0;
                     for (const double n : {0.0, 1e-31, -1e-38}) {
                       const auto v = injected(context, p, list_of({Light{{0.99, 0.5, 0.5}, {n, n, n}, {1, 1, 1}}}));
                       if (!v) return v.status();
                       most = std::max(most, std::fabs(v.value()[0] * per_flux - 1));
                       for (std::size_t i = 1; i < v.value().size(); ++i)
                         if (i % 24 != 0) most = std::max(most, std::fabs(v.value()[i]));
                     }
                     return most;
                   }});
  cases.push_back({kernel, "inject, normals 1e-20 to 1e20 long", "their length does not matter (largest error over c0)", coefficient_bound,
                   [](Context& context) -> Result<double> {
                     const LpvInjectParams p = params_of(grid_of(1, 1, 1), 3);
                     double most = 0;
                     for (const double length : {1e-20, 1e-3, 1.0, 1e20}) {
                       std::vector<Light> lights{{{0.5, 0.5, 0.5}, {0.6 * length, 0, -0.8 * length}, {1, 1, 1}}};
                       const auto v = injected(context, p, list_of(lights));
                       if (!v) return v.status();
                       most = std::max(most, error_per_cell(p, v.value(), injected_truth(p, lights)));
                     }
                     return most;
                   }});
  cases.push_back({kernel, "inject, opposite lights in a cell", "c1 cancels to 0, c0 adds up (error of c0 + |c1|)", coefficient_bound,
                   [](Context& context) -> Result<double> {
                     const LpvInjectParams p = params_of(grid_of(1, 1, 1));
                     std::vector<Light> lights;
                     for (std::uint32_t i = 0; i < 3000; ++i) {
                       const Vec n = direction(i);
                       const double f = static_cast<float>(uniform(i + 9));
                       lights.push_back({{0.5, 0.5, 0.5}, n, {f, f, f}});
                       lights.push_back({{0.5, 0.5, 0.5}, {-n[0], -n[1], -n[2]}, {f, f, f}});
                     }
                     const auto v = injected(context, p, list_of(lights));
                     if (!v) return v.status();
                     double flux = 0;
                     for (const Light& l : lights) flux += l.flux[0];
                     double c1 = 0;
                     for (std::size_t i = 1; i < 4; ++i) c1 += std::fabs(v.value()[i]);
                     return std::fabs(v.value()[0] * per_flux / flux - 1) + c1;
                   }});
}

void add_storage(std::vector<Case>& cases) {
  cases.push_back({kernel, "inject, f16 from 1e-9 to 1e9", "half a step of f16; beyond 65504 it saturates, below 2^-25 it is 0 (largest error in half steps)",
                   1.001,  // 1, and the float before rounding
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(19, 1, 1));
                     p.format = Format::f16x4;
                     p.channels = 1;
                     p.flux_max = 1e9;
                     std::vector<Light> lights;
                     for (int k = 0; k < 19; ++k)
                       lights.push_back({{k + 0.5, 0.2, 0.5}, {0, 1, 0}, {static_cast<float>(std::pow(10.0, k - 9)), 0, 0}});
                     const auto v = injected(context, p, list_of(lights));
                     if (!v) return v.status();
                     const Values truth = injected_truth(p, lights);
                     double most = 0;
                     for (std::size_t i = 0; i < truth.size(); ++i) {
                       const double t = std::min(truth[i], 65504.0);
                       const double step = std::ldexp(1.0, std::max(std::ilogb(std::max(t, 1e-30)), -14) - 10);
                       const double e = std::fabs(v.value()[i] - t) / (step / 2);
                       if (!(e <= most)) most = e;
                     }
                     return most;
                   },
                   false, not_double});
  for (const double scale : {1e-3, 1e4})
    cases.push_back({kernel, fmt::format("inject, a scene scaled by {}", scale), "the same radiance in cells (largest error over c0)",
                     coefficient_bound + 8 * 0x1p-24,  // cell, its square and fluxes are rounded anew
                     [=](Context& context) -> Result<double> {
                       LpvInjectParams p = params_of(grid_of(7, 5, 6), 3);
                       auto lights = random_lights(3000, p.grid.extent, 31);
                       const Values truth = injected_truth(p, lights);
                       p.grid.cell = scale;
                       p.flux_max = scale * scale;
                       for (Light& l : lights) {
                         for (double& c : l.place) c *= scale;
                         for (double& c : l.flux) c *= scale * scale;
                       }
                       const auto v = injected(context, p, list_of(lights));
                       if (!v) return v.status();
                       return error_per_cell(p, v.value(), truth);
                     }});
  cases.push_back({kernel, "inject, a scene shifted by whole cells", "the volume moves with it (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams p = params_of(grid_of(6, 6, 6));
                     p.grid.cell = 0.25;
                     auto lights = random_lights(3000, {6, 6, 6}, 41);
                     for (Light& l : lights)
                       for (double& c : l.place) c = std::round(c / 4 * 16384) / 16384;
                     const auto a = injected(context, p, list_of(lights));
                     const Vec by{3 * 0.25, -5 * 0.25, 64 * 0.25};
                     for (Light& l : lights)
                       for (std::size_t c = 0; c < 3; ++c) l.place[c] += by[c];
                     for (std::size_t c = 0; c < 3; ++c) p.grid.origin[c] += by[c];
                     const auto b = injected(context, p, list_of(lights));
                     if (!a) return a.status();
                     if (!b) return b.status();
                     double lit = 0;
                     for (const double c : a.value()) lit += c != 0;
                     return count_different(a.value(), b.value()) + (lit > 1000 ? 0 : 1e9);
                   }});
}

}  // namespace

std::vector<Case> lpv_inject_cases() {
  std::vector<Case> cases;
  add_truths(cases);
  add_orders(cases);
  add_places(cases);
  add_normals(cases);
  add_storage(cases);
  return cases;
}

}  // namespace luxel::cases

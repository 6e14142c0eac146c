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

LpvInjectGeometryParams params_of(const LpvGrid& grid) {
  LpvInjectGeometryParams p;
  p.grid = grid;
  return p;
}

Values join(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// B in direction w at a corner.
double blocking(const Values& v, std::size_t corner, const Vec& w) {
  const double first = std::sqrt(3 / (4 * std::numbers::pi));
  return v[4 * corner] / std::sqrt(4 * std::numbers::pi) +
         first * (v[4 * corner + 1] * w[1] + v[4 * corner + 2] * w[2] + v[4 * corner + 3] * w[0]);
}

}  // namespace

std::vector<Case> lpv_geometry_cases() {
  std::vector<Case> cases;
  for (const bool two_sided : {false, true})
    cases.push_back({kernel, fmt::format("geometry, 5000 surfels, {}", two_sided ? "two-sided" : "one-sided"),
                     "area <n|w>+ / cell^2 at the nearest corner (error over the largest coefficient)", float_bound,
                     [=](Context& context) -> Result<double> {
                       LpvInjectGeometryParams p = params_of(grid_of(4, 5, 3));
                       p.two_sided = two_sided;
                       const auto surfels = random_surfels(5000, p.grid.extent, 3);
                       const auto v = injected_geometry(context, p, list_of(surfels));
                       if (!v) return v.status();
                       return relative_error(v.value(), geometry_truth(p, surfels));
                     }});
  cases.push_back({kernel, "geometry, a wall of a cell's area a corner", "blocks 3/4 of what meets it, a quarter of what passes along, nothing from behind (largest error)",
                   float_bound, [](Context& context) -> Result<double> {
                     const LpvInjectGeometryParams p = params_of(grid_of(4, 4, 4));
                     std::vector<Surfel> wall;
                     for (int z = 0; z <= 16; ++z)
                       for (int y = 0; y <= 16; ++y)
                         if (y < 16 && z < 16) wall.push_back({{2, y / 4.0 + 0.0625, z / 4.0 + 0.0625}, {1, 0, 0}, 0.0625});
                     const auto v = injected_geometry(context, p, list_of(wall));
                     if (!v) return v.status();
                     const std::size_t corner = (2 * 5 + 2) * 5 + 2;
                     // Light along w meets B(-w).
                     return std::max({std::fabs(blocking(v.value(), corner, {1, 0, 0}) - 0.75),
                                      std::fabs(blocking(v.value(), corner, {0, 1, 0}) - 0.25),
                                      std::fabs(blocking(v.value(), corner, {-1, 0, 0}) + 0.25)});
                   }});
  cases.push_back({kernel, "geometry, two sources", "in each corner the whole function with the larger c0 stands (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectGeometryParams p = params_of(grid_of(4, 5, 3));
                     const Values a = list_of(random_surfels(700, p.grid.extent, 5)), b = list_of(random_surfels(700, p.grid.extent, 70001)),
                                  c = list_of(random_surfels(100, p.grid.extent, 170001));
                     const auto va = injected_geometry(context, p, a), vb = injected_geometry(context, p, b), vc = injected_geometry(context, p, c);
                     if (!va) return va.status();
                     if (!vb) return vb.status();
                     if (!vc) return vc.status();
                     p.surfels = {700, 0, 700, 100};
                     const auto both = injected_geometry(context, p, join(join(a, b), c));
                     if (!both) return both.status();
                     p.surfels = {700, 700, 100, 0};
                     const auto three = injected_geometry(context, p, join(join(a, b), c));
                     if (!three) return three.status();
                     p.surfels = {700, 100, 0, 0};
                     const auto kept = injected_geometry(context, p, join(a, c), vb.value());
                     if (!kept) return kept.status();
                     Values expected = va.value();
                     double changed = 0;
                     for (std::size_t i = 0; i < expected.size(); i += 4)
                       for (const Values* other : {&vb.value(), &vc.value()})
                         if ((*other)[i] > expected[i]) {
                           std::copy_n(other->begin() + static_cast<std::ptrdiff_t>(i), 4, expected.begin() + static_cast<std::ptrdiff_t>(i));
                           ++changed;
                         }
                     return count_different(both.value(), expected) + count_different(three.value(), expected) +
                            count_different(kept.value(), expected) + (changed > 20 ? 0 : 1e9);
                   }});
  cases.push_back({kernel, "geometry, two sources under the cube's 48 symmetries", "corners turn with the surfels (largest error over the largest coefficient)",
                   float_bound, [](Context& context) -> Result<double> {
                     LpvInjectGeometryParams p = params_of(grid_of(3, 3, 3));
                     const auto surfels = random_surfels(600, p.grid.extent, 51);
                     p.surfels = {300, 300, 0, 0};
                     const auto before = injected_geometry(context, p, list_of(surfels));
                     if (!before) return before.status();
                     double most = 0;
                     for (const Turn& turn : turns()) {
                       auto turned = surfels;
                       for (Surfel& s : turned) s.place = turn.about(s.place, 3), s.normal = turn.of(s.normal);
                       const auto v = injected_geometry(context, p, list_of(turned));
                       if (!v) return v.status();
                       Values expected(v.value().size());
                       for (int z = 0; z < 4; ++z)
                         for (int y = 0; y < 4; ++y)
                           for (int x = 0; x < 4; ++x) {
                             const std::size_t from = static_cast<std::size_t>(4 * ((z * 4 + y) * 4 + x));
                             const Vec at = turn.about({x * 1.0, y * 1.0, z * 1.0}, 3);
                             const std::size_t to = static_cast<std::size_t>(4 * std::lround((at[2] * 4 + at[1]) * 4 + at[0]));
                             const Values& b = before.value();
                             const Vec c = turn.of({b[from + 3], b[from + 1], b[from + 2]});
                             expected[to] = b[from];
                             expected[to + 3] = c[0], expected[to + 1] = c[1], expected[to + 2] = c[2];
                           }
                       const double e = relative_error(v.value(), expected);
                       if (!(e <= most)) most = e;
                     }
                     return most;
                   }});
  cases.push_back({kernel, "geometry, 5000 surfels in another order", "the same bits, on every device (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     const auto cpu = Context::open(context.real64() ? "cpu:double" : "cpu:float");
                     if (!cpu) return cpu.status();
                     LpvInjectGeometryParams p = params_of(grid_of(4, 5, 3));
                     auto surfels = random_surfels(5000, p.grid.extent, 7);
                     p.format = Format::f16x4;
                     const auto a = injected_geometry(*cpu.value(), p, list_of(surfels));
                     std::reverse(surfels.begin(), surfels.end());
                     const auto b = injected_geometry(context, p, list_of(surfels));
                     if (!a) return a.status();
                     if (!b) return b.status();
                     return count_different(a.value(), b.value());
                   }});
  cases.push_back({kernel, "geometry, surfels dropped, and saturated", "counted, and without a trace (values and counts that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectGeometryParams p = params_of(grid_of(2, 2, 2));
                     p.area_max = 2;
                     const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
                     const Surfel good{{1, 1, 1}, {0, 0, 1}, 2};
                     std::vector<Surfel> surfels{good, {{-0.51, 0, 0}, {1, 0, 0}, 1}, {{2.51, 0, 0}, {1, 0, 0}, 1}, {{1e38, 0, 0}, {1, 0, 0}, 1}};
                     for (const double v : {nan, infinity, -infinity}) {
                       surfels.push_back({{1, v, 1}, {0, 0, 1}, 1});
                       surfels.push_back({{1, 1, 1}, {0, 0, v}, 1});
                       surfels.push_back({{1, 1, 1}, {0, 0, 1}, v});
                     }
                     surfels.push_back({{1, 1, 1}, {0, 0, 1}, -1});
                     Values outcomes, one, large;
                     const auto v = injected_geometry(context, p, list_of(surfels), {}, &outcomes);
                     const auto w = injected_geometry(context, p, list_of({good}), {}, &one);
                     const auto u = injected_geometry(context, p, list_of({Surfel{{1, 1, 1}, {0, 0, 1}, 1e30}}), {}, &large);
                     if (!v) return v.status();
                     if (!w) return w.status();
                     if (!u) return u.status();
                     return count_different(outcomes, Values{1, 3, 10, 0}) + count_different(large, Values{1, 0, 0, 1}) +
                            count_different(v.value(), w.value()) + count_different(u.value(), w.value());
                   }});
  cases.push_back({kernel, "geometry, surfels moved along their normals", "as those that lie there (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectGeometryParams p = params_of(grid_of(4, 4, 4));
                     const auto there = injected_geometry(context, p, list_of({Surfel{{2.125, 1.25, 3}, {1, 0, 0}, 1}}));
                     p.offset = 1.5;
                     const auto moved = injected_geometry(context, p, list_of({Surfel{{0.625, 1.25, 3}, {1, 0, 0}, 1}}));
                     if (!there) return there.status();
                     if (!moved) return moved.status();
                     return count_different(moved.value(), there.value());
                   }});
  cases.push_back({kernel, "geometry, an area that is no float once in cells", "dropped and counted (values and counts that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectGeometryParams p = params_of(grid_of(1, 1, 1));
                     p.grid.cell = 1e-5;
                     Values outcomes;
                     const auto v = injected_geometry(context, p, list_of({Surfel{{0, 0, 0}, {1, 0, 0}, 1e30}}), {}, &outcomes);
                     if (!v) return v.status();
                     return count_different(v.value(), Values(v.value().size(), 0)) + count_different(outcomes, Values{0, 0, 1, 0});
                   }});
  cases.push_back({kernel, "geometry, a surfel without normal", "blocks as the mean over all normals (error of B)", float_bound,
                   [](Context& context) -> Result<double> {
                     const auto v = injected_geometry(context, params_of(grid_of(1, 1, 1)), list_of({Surfel{{0.1, 0.2, 0.3}, {0, 0, 0}, 1}}));
                     if (!v) return v.status();
                     double most = 0;
                     for (std::uint32_t i = 0; i < 10; ++i) most = std::max(most, std::fabs(blocking(v.value(), 0, direction(i)) - 0.25));
                     return most;
                   }});
  for (const double scale : {1e-3, 1e4})
    cases.push_back({kernel, fmt::format("geometry, a scene scaled by {}", scale), "the same blocking (error over the largest coefficient)",
                     float_bound, [=](Context& context) -> Result<double> {
                       LpvInjectGeometryParams p = params_of(grid_of(4, 5, 3));
                       auto surfels = random_surfels(1000, p.grid.extent, 3);
                       const Values truth = geometry_truth(p, surfels);
                       p.grid.cell = scale;
                       for (Surfel& s : surfels) {
                         for (double& c : s.place) c *= scale;
                         s.area *= scale * scale;
                       }
                       const auto v = injected_geometry(context, p, list_of(surfels));
                       if (!v) return v.status();
                       return relative_error(v.value(), truth);
                     }});
  return cases;
}

}  // namespace luxel::cases

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
constexpr double pi = std::numbers::pi;
const double y0 = std::sqrt(1 / (4 * pi));

LpvSampleParams params_of(const LpvGrid& grid, int bands = 2) {
  LpvSampleParams p;
  p.grids = {grid};
  p.bands = bands;
  p.offset = 0;
  return p;
}

// Any light: c0 of 1 to 2, other coefficients up to `anisotropy` of it.
Values random_volume(const LpvSampleParams& p, double anisotropy, std::uint32_t seed) {
  Values v(lpv_sample_offset(p, static_cast<int>(p.grids.size())) * 4, 0.0);
  const std::size_t cells = lpv_pixels(p.grids[0], 2, 1), quads = p.bands == 3 ? 3 : 1;
  for (std::size_t k = 0; k < p.grids.size(); ++k)
    for (std::size_t c = 0; c < static_cast<std::size_t>(p.channels); ++c)
      for (std::size_t i = 0; i < static_cast<std::size_t>(p.bands * p.bands); ++i)
        for (std::size_t cell = 0; cell < cells; ++cell) {
          const std::size_t at = 4 * (lpv_sample_offset(p, static_cast<int>(k)) + (c * quads + i / 4) * cells + cell) + i % 4;
          const double u = uniform(seed + static_cast<std::uint32_t>(at));
          v[at] = static_cast<float>(i == 0 ? 1 + u : anisotropy * (2 * u - 1));
        }
  return v;
}

// The same radiance in every direction, a value a cascade.
Values flat_volume(const LpvSampleParams& p, const Values& radiance) {
  Values v(lpv_sample_offset(p, static_cast<int>(p.grids.size())) * 4, 0.0);
  const std::size_t cells = lpv_pixels(p.grids[0], 2, 1), quads = p.bands == 3 ? 3 : 1;
  for (std::size_t k = 0; k < p.grids.size(); ++k)
    for (std::size_t c = 0; c < static_cast<std::size_t>(p.channels); ++c)
      for (std::size_t cell = 0; cell < cells; ++cell)
        v[4 * (lpv_sample_offset(p, static_cast<int>(k)) + c * quads * cells + cell)] = static_cast<float>(radiance[k] / y0);
  return v;
}

Values random_receivers(int count, double low, double high, std::uint32_t seed) {
  std::vector<Surfel> places;
  for (int k = 0; k < count; ++k) {
    const std::uint32_t i = seed + 8 * static_cast<std::uint32_t>(k);
    Surfel s;
    for (std::uint32_t a = 0; a < 3; ++a) s.place[a] = low + (high - low) * uniform(i + a);
    s.normal = direction(i + 3);
    places.push_back(s);
  }
  return receivers_at(places);
}

void add_truths(std::vector<Case>& cases) {
  for (const int bands : {2, 3})
    for (const int channels : {1, 3})
      cases.push_back({kernel, fmt::format("sample, 4000 receivers in any light, {} bands, {} channels", bands, channels),
                       "the sum over hat functions and cosine lobes (error over the largest irradiance)", float_bound,
                       [=](Context& context) -> Result<double> {
                         LpvSampleParams p = params_of(grid_of(5, 4, 6), bands);
                         p.channels = channels;
                         p.offset = 0.5;
                         p.per_area = false;
                         p.grids[0].cell = 0.75;
                         const Values light = random_volume(p, 0.7, 3), receivers = random_receivers(4000, -0.2, 3.4, 5);
                         const auto r = sampled(context, p, light, receivers);
                         if (!r) return r.status();
                         return relative_error(r.value().irradiance, sampled_truth(p, light, receivers));
                       }});
  for (const double damping : {0.0, 1.0})
    cases.push_back({kernel, fmt::format("sample, the same radiance everywhere, damping {}", damping),
                     "irradiance is pi times it, glossy radiance it (largest relative error)", float_bound,
                     [=](Context& context) -> Result<double> {
                       LpvSampleParams p = params_of(grid_of(6, 6, 6), 3);
                       p.damping = damping;
                       p.glossy_steps = 4;
                       const Values receivers = random_receivers(500, 0, 6, 9);
                       Values views;
                       for (std::size_t i = 0; i < 500; ++i) {
                         const Vec d = direction(static_cast<std::uint32_t>(7000 + i));
                         // On the side of the normal.
                         const double side = d[0] * receivers[8 * i + 4] + d[1] * receivers[8 * i + 5] + d[2] * receivers[8 * i + 6];
                         for (const double c : d) views.push_back(side < 0 ? -c : c);
                         views.push_back(0);
                       }
                       const auto r = sampled(context, p, flat_volume(p, {2.5}), receivers, views);
                       if (!r) return r.status();
                       double most = 0;
                       for (std::size_t i = 0; i < 2000; ++i) {
                         // A ray whose every look-up lies outside sees nothing.
                         const double e = i % 4 == 3 ? std::fabs(r.value().irradiance[i] - 1) + std::fabs(r.value().specular[i] - 1)
                                                     : std::max(std::fabs(r.value().irradiance[i] / (2.5 * pi) - 1),
                                                                r.value().specular[i] == 0 ? 0 : std::fabs(r.value().specular[i] / 2.5 - 1));
                         if (!(e <= most)) most = e;
                       }
                       return most;
                     }});
  cases.push_back({kernel, "sample, glossy, the same light of all axes everywhere",
                   "the light that goes against the mirror direction: c0 Y0 + Y1 (c1 y + c2 z + c3 x) (error over the largest)", float_bound,
                   [](Context& context) -> Result<double> {
                     LpvSampleParams p = params_of(grid_of(6, 6, 6));
                     p.channels = 1;
                     p.glossy_steps = 2;
                     constexpr double c[] = {4, 0.7, -1.1, 1.9};
                     Values light(lpv_sample_offset(p, 1) * 4, 0.0);
                     for (std::size_t i = 0; i < light.size(); ++i) light[i] = c[i % 4];
                     const Values receivers = random_receivers(500, 2, 4, 11);
                     Values views;
                     for (std::uint32_t i = 0; i < 500; ++i)
                       for (const double v : {direction(8000 + i)[0], direction(8000 + i)[1], direction(8000 + i)[2], 0.0}) views.push_back(v);
                     const auto r = sampled(context, p, light, receivers, views);
                     if (!r) return r.status();
                     Values found, expected;
                     for (std::size_t i = 0; i < 500; ++i) {
                       const double *n = &receivers[8 * i + 4], *v = &views[4 * i], n_v = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
                       const auto against = [&](std::size_t k) { return v[k] - 2 * n_v * n[k]; };
                       found.push_back(r.value().specular[4 * i]);
                       expected.push_back(std::max(0.0, c[0] / std::sqrt(4 * pi) + std::sqrt(3 / (4 * pi)) * (c[1] * against(1) + c[2] * against(2) + c[3] * against(0))));
                     }
                     return relative_error(found, expected);
                   }});
  cases.push_back({kernel, "sample, radiance linear along x, half a cell above", "linear, the outermost centre's beyond (largest relative error)", float_bound,
                   [](Context& context) -> Result<double> {
                     LpvSampleParams p = params_of(grid_of(8, 2, 2));
                     p.channels = 1;
                     p.offset = 0.5;
                     Values light(lpv_sample_offset(p, 1) * 4, 0.0);
                     for (std::size_t i = 0; i < 32; ++i) light[4 * i] = 1 + static_cast<double>(i % 8);
                     std::vector<Surfel> places;
                     for (int k = 0; k <= 64; ++k) places.push_back({{k / 8.0, 1, 1}, {-1, 0, 0}, 0});
                     const auto r = sampled(context, p, light, receivers_at(places));
                     if (!r) return r.status();
                     double most = 0;
                     for (std::size_t k = 0; k <= 64; ++k) {
                       const double q = std::clamp(static_cast<double>(k) / 8 - 0.5 - 0.5, 0.0, 7.0), expected = (1 + q) * std::sqrt(pi) / 2;
                       most = std::max(most, std::fabs(r.value().irradiance[4 * k] / expected - 1));
                     }
                     return most;
                   }});
  cases.push_back({kernel, "sample, light that goes along the normal", "an intensity below 0 is no light (largest |irradiance|)", 0,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams in;
                     in.grid = grid_of(1, 1, 1);
                     const auto light = injected(context, in, list_of({Light{{0.5, 0, 0.5}, {0, 1, 0}, {1, 1, 1}}}));
                     if (!light) return light.status();
                     const auto r = sampled(context, params_of(in.grid), light.value(), receivers_at({{{0.5, 0, 0.5}, {0, 1, 0}, 0}}));
                     if (!r) return r.status();
                     return r.value().irradiance[0] + r.value().irradiance[1] + r.value().irradiance[2];
                   }});
}

void add_damping(std::vector<Case>& cases) {
  cases.push_back({kernel, "sample, all light behind the surface, or in front of it", "damping drops it, or leaves it (error over the irradiance undamped)",
                   float_bound, [](Context& context) -> Result<double> {
                     LpvSampleParams p = params_of(grid_of(8, 4, 4));
                     double most = 0;
                     for (const bool behind : {true, false})
                       for (const double damping : {0.0, 0.5, 1.0}) {
                         p.damping = damping;
                         Values light(lpv_sample_offset(p, 1) * 4, 0.0);
                         for (std::size_t i = 0; i < 3 * 128; ++i)
                           if ((i % 8 < 4) == behind) light[4 * i] = 1;
                         // Between centres: half of the light is seen there.
                         const auto r = sampled(context, p, light, receivers_at({{{4, 2, 2}, {1, 0, 0}, 0}}));
                         if (!r) return r.status();
                         const double undamped = std::sqrt(pi) / 4;
                         // c is 1/2, what it changes by 1: r is 1, s is -1 or 1.
                         const double expected = behind ? undamped * (1 - damping) : undamped;
                         most = std::max(most, std::fabs(r.value().irradiance[0] - expected) / undamped);
                       }
                     return most;
                   }});
}

void add_cascades(std::vector<Case>& cases) {
  const auto three = [] {
    LpvSampleParams p;
    p.grids = lpv_cascades({8, 8, 8}, 1, {3.3, -2.1, 100.4}, 3);
    p.offset = 0;
    return p;
  };
  cases.push_back({kernel, "sample, three cascades of the same radiance", "no seam (largest relative error of irradiance)", float_bound,
                   [=](Context& context) -> Result<double> {
                     LpvSampleParams p = three();
                     std::vector<Surfel> places;
                     for (std::uint32_t i = 0; i < 3000; ++i) {
                       const LpvGrid& g = p.grids[2];
                       Surfel s;
                       for (std::uint32_t a = 0; a < 3; ++a) s.place[a] = g.origin[a] + (0.001 + 0.998 * uniform(5 * i + a)) * 32;
                       s.normal = direction(i);
                       places.push_back(s);
                     }
                     const auto r = sampled(context, p, flat_volume(p, {2, 2, 2}), receivers_at(places));
                     if (!r) return r.status();
                     double most = 0;
                     for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
                       if (const double e = std::fabs(r.value().irradiance[i] / (i % 4 == 3 ? 1 : 2 * pi) - 1); !(e <= most)) most = e;
                     return most;
                   }});
  cases.push_back({kernel, "sample, from one cascade into the next", "a ramp over the cells asked for (largest relative error)",
                   1e-4,  // places are floats near 100, in cells of 1/16: 2^-17 of a cell each
                   [](Context& context) -> Result<double> {
                     LpvSampleParams p;
                     p.grids = lpv_cascades({8, 8, 8}, 0.0625, {3.3, -2.1, 100.4}, 3);
                     p.blend = 1.5;
                     std::vector<Surfel> places;
                     for (int i = 0; i < 512; ++i)
                       places.push_back({{p.grids[2].origin[0] + 0.001 + i / 512.0 * 1.99, -2.1, 100.4}, {0, 1, 0}, 0});
                     const Values light = flat_volume(p, {1, 3, 5});
                     const auto r = sampled(context, p, light, receivers_at(places));
                     if (!r) return r.status();
                     double most = 0;
                     for (std::size_t i = 0; i < 512; ++i) {
                       double left = 1, expected = 0;
                       for (std::size_t k = 0; k < 3; ++k) {
                         double inside = 1e9;
                         for (std::size_t a = 0; a < 3; ++a) {
                           const double q = (static_cast<float>(places[i].place[a]) - p.grids[k].origin[a]) / p.grids[k].cell;
                           inside = std::min({inside, q, 8 - q});
                         }
                         const double share = inside < 0 ? 0 : k == 2 ? 1 : std::min(1.0, inside / 1.5);
                         expected += left * share * Values{1, 3, 5}[k] * pi;
                         left *= 1 - share;
                       }
                       most = std::max(most, std::fabs(r.value().irradiance[4 * i] / expected - 1));
                     }
                     return most;
                   }});
  cases.push_back({kernel, "sample, cascades that receivers read", "the host finds those that the device reads (cascades that differ)", 0,
                   [=](Context& context) -> Result<double> {
                     LpvSampleParams p = three();
                     p.count = true;
                     const auto at = [&](std::size_t k, double cells) {
                       const LpvGrid& g = p.grids[k];
                       return Surfel{{g.origin[0] + cells * g.cell, g.origin[1] + 4 * g.cell, g.origin[2] + 4 * g.cell}, {0, 1, 0}, 0};
                     };
                     const std::vector<std::vector<Surfel>> sets{{at(0, 4)}, {at(0, 1.25)}, {at(1, 1)}, {at(2, 0.5)}, {at(0, 4), at(2, 0.5)}, {at(2, -1)}};
                     double different = 0;
                     for (const auto& set : sets) {
                       const Values receivers = receivers_at(set);
                       const auto r = sampled(context, p, flat_volume(p, {1, 1, 1}), receivers);
                       if (!r) return r.status();
                       const auto read = lpv_cascades_read(p, std::vector<float>(receivers.begin(), receivers.end()));
                       for (std::size_t k = 0; k < 3; ++k) different += read[k] != (r.value().outcomes[3 + k] > 0);
                     }
                     return different;
                   }});
  cases.push_back({kernel, "sample, a cascade that no receiver reads holds NaN", "nothing of it shows (values that differ)", 0,
                   [=](Context& context) -> Result<double> {
                     const LpvSampleParams p = three();
                     const LpvGrid& g = p.grids[0];
                     const Values receivers = receivers_at({{{g.origin[0] + 4, g.origin[1] + 4, g.origin[2] + 4}, {0, 1, 0}, 0}});
                     Values light = flat_volume(p, {1, 1, 1});
                     const auto a = sampled(context, p, light, receivers);
                     std::fill(light.begin() + static_cast<std::ptrdiff_t>(4 * lpv_sample_offset(p, 1)), light.end(), std::nan(""));
                     const auto b = sampled(context, p, light, receivers);
                     if (!a) return a.status();
                     if (!b) return b.status();
                     return count_different(a.value().irradiance, b.value().irradiance);
                   }});
}

void add_values(std::vector<Case>& cases) {
  cases.push_back({kernel, "sample, receivers outside, without normal, not finite", "0, counted, others as without them (values and counts that differ)", 0,
                   [](Context& context) -> Result<double> {
                     LpvSampleParams p = params_of(grid_of(4, 4, 4));
                     p.count = true;
                     p.damping = 0.5;
                     const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
                     const std::vector<Surfel> bad{{{-0.01, 1, 1}, {0, 1, 0}, 0}, {{4.01, 1, 1}, {0, 1, 0}, 0}, {{1, 1e38, 1}, {0, 1, 0}, 0},
                                                   {{1, 1, 1}, {0, 0, 0}, 0},     {{1, 1, 1}, {0, 1e-31, 0}, 0}, {{nan, 1, 1}, {0, 1, 0}, 0},
                                                   {{1, infinity, 1}, {0, 1, 0}, 0}, {{1, 1, 1}, {0, nan, 0}, 0}, {{1, 1, 1}, {0, -infinity, 0}, 0}};
                     Values receivers = receivers_at(bad), good = random_receivers(50, 0, 4, 3);
                     receivers.insert(receivers.end(), good.begin(), good.end());
                     const Values light = random_volume(p, 0.5, 4);
                     const auto a = sampled(context, p, light, receivers), b = sampled(context, p, light, good);
                     if (!a) return a.status();
                     if (!b) return b.status();
                     Values expected(4 * bad.size(), 0.0);
                     expected.insert(expected.end(), b.value().irradiance.begin(), b.value().irradiance.end());
                     return count_different(a.value().irradiance, expected) +
                            count_different(a.value().outcomes, Values{50, 3, 6, 50, 0, 0, 0, 0});
                   }});
  cases.push_back({kernel, "sample, NaN and infinity in a cell", "only look-ups beside it see them (values that are not finite elsewhere)", 0,
                   [](Context& context) -> Result<double> {
                     const LpvSampleParams p = params_of(grid_of(6, 1, 1));
                     double wrong = 0;
                     for (const double v : {std::nan(""), std::numeric_limits<double>::infinity()}) {
                       Values light = flat_volume(p, {1});
                       for (std::size_t c = 0; c < 3; ++c) light[4 * (6 * c)] = v;
                       std::vector<Surfel> places;
                       for (int i = 0; i < 40; ++i) places.push_back({{1.51 + i * 0.1, 0.5, 0.5}, {0, 1, 0}, 0});
                       const auto r = sampled(context, p, light, receivers_at(places));
                       if (!r) return r.status();
                       for (const double e : r.value().irradiance) wrong += !std::isfinite(e);
                     }
                     return wrong;
                   }});
  for (const Format format : {Format::f32x4, Format::f16x4})
    cases.push_back({kernel, fmt::format("sample, {}, damping, glossy, two cascades", name(format)), "the same bits as the C++ execution in float (values that differ)", 0,
                     [=](Context& context) -> Result<double> {
                       const auto cpu = Context::open("cpu:float");
                       if (!cpu) return cpu.status();
                       double different = 0;
                       for (const int bands : {2, 3}) {
                         LpvSampleParams p;
                         p.grids = lpv_cascades({6, 5, 7}, 0.5, {0, 0, 0}, 2);
                         p.bands = bands;
                         p.format = format;
                         p.damping = 0.8;
                         p.glossy_steps = 3;
                         p.offset = 0.3;
                         const Values light = random_volume(p, 0.9, 6), receivers = random_receivers(2000, -3, 3, 8);
                         Values views;
                         for (std::uint32_t i = 0; i < 2000; ++i) {
                           for (const double c : direction(i)) views.push_back(c);
                           views.push_back(0);
                         }
                         const auto a = sampled(context, p, light, receivers, views), b = sampled(*cpu.value(), p, light, receivers, views);
                         if (!a) return a.status();
                         if (!b) return b.status();
                         different += count_different(a.value().irradiance, b.value().irradiance) +
                                      count_different(a.value().specular, b.value().specular);
                       }
                       return different;
                     },
                     false, not_double});
  cases.push_back({kernel, "inject and sample under the cube's 48 symmetries", "irradiance turns with the scene (error over the largest)", float_bound,
                   [](Context& context) -> Result<double> {
                     LpvInjectParams in;
                     in.grid = grid_of(4, 4, 4);
                     in.bands = 3;
                     in.channels = 1;
                     LpvSampleParams p = params_of(in.grid, 3);
                     p.channels = 1;
                     p.damping = 0.7;
                     p.offset = 0.4;
                     const auto lights = random_lights(300, in.grid.extent, 61);
                     std::vector<Surfel> places;
                     for (std::uint32_t i = 0; i < 300; ++i)
                       places.push_back({{4 * uniform(9 * i), 4 * uniform(9 * i + 1), 4 * uniform(9 * i + 2)}, direction(i + 99), 0});
                     Values before;
                     double most = 0;
                     for (const Turn& turn : turns()) {
                       auto turned = lights;
                       auto seen = places;
                       for (Light& l : turned) l.place = turn.about(l.place, 4), l.normal = turn.of(l.normal);
                       for (Surfel& s : seen) s.place = turn.about(s.place, 4), s.normal = turn.of(s.normal);
                       const auto light = injected(context, in, list_of(turned));
                       if (!light) return light.status();
                       const auto r = sampled(context, p, light.value(), receivers_at(seen));
                       if (!r) return r.status();
                       if (before.empty()) before = r.value().irradiance;
                       const double e = relative_error(r.value().irradiance, before);
                       if (!(e <= most)) most = e;
                     }
                     return most;
                   }});
  for (const double scale : {1e-3, 1e4})
    cases.push_back({kernel, fmt::format("inject and sample, a scene scaled by {}, f16", scale),
                     "the irradiance of the scene as it was (error over the largest)", 2 * 0x1p-11,  // f16 rounds each coefficient; both runs
                     [=](Context& context) -> Result<double> {
                       Values first;
                       for (const double s : {1.0, scale}) {
                         LpvInjectParams in;
                         in.grid = grid_of(4, 4, 4);
                         in.grid.cell = s;
                         in.format = Format::f16x4;
                         in.flux_max = s * s;
                         auto lights = random_lights(300, in.grid.extent, 61);
                         for (Light& l : lights) {
                           for (double& c : l.place) c *= s;
                           for (double& c : l.flux) c *= s * s;
                         }
                         LpvSampleParams p = params_of(in.grid);
                         p.format = in.format;
                         p.damping = 1;
                         std::vector<Surfel> places;
                         for (std::uint32_t i = 0; i < 300; ++i)
                           places.push_back({{s * 4 * uniform(9 * i), s * 4 * uniform(9 * i + 1), s * 4 * uniform(9 * i + 2)}, direction(i + 99), 0});
                         const auto light = injected(context, in, list_of(lights));
                         if (!light) return light.status();
                         const auto r = sampled(context, p, light.value(), receivers_at(places));
                         if (!r) return r.status();
                         if (s == 1) first = r.value().irradiance;
                         else return relative_error(r.value().irradiance, first);
                       }
                       return std::nan("");
                     }});
}

void add_filter(std::vector<Case>& cases) {
  cases.push_back({kernel, "filter, an impulse and a constant", "binomial weights; a constant to the bit (largest error; what is not constant)", 1e-12,
                   [](Context& context) -> Result<double> {
                     LpvFilterParams p;
                     p.grid = grid_of(5, 4, 6);
                     p.channels = 1;
                     Values v(480, 0.0);
                     const auto at = [](int x, int y, int z) { return static_cast<std::size_t>(4 * ((z * 4 + y) * 5 + x)); };
                     v[at(2, 2, 3)] = 64;
                     v[at(2, 2, 3) + 2] = -64;
                     v[at(0, 0, 0) + 3] = 64;  // a corner: what would leave stays
                     const auto r = filtered(context, p, v);
                     if (!r) return r.status();
                     double most = 0;
                     const double weights[3] = {1, 2, 1}, edge[3] = {0, 3, 1};
                     for (int z = 0; z < 6; ++z)
                       for (int y = 0; y < 4; ++y)
                         for (int x = 0; x < 5; ++x) {
                           const auto of = [](const double* w, int d) { return d < -1 || d > 1 ? 0 : w[d + 1]; };
                           const double middle = of(weights, x - 2) * of(weights, y - 2) * of(weights, z - 3);
                           const double corner = of(edge, x) * of(edge, y) * of(edge, z);
                           const double expected[4] = {middle, 0, -middle, corner};
                           for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::fabs(r.value()[at(x, y, z) + c] - expected[c]));
                         }
                     const Values constant(480, static_cast<float>(0.1));
                     const auto s = filtered(context, p, constant);
                     if (!s) return s.status();
                     return most + count_different(s.value(), constant);
                   }});
  cases.push_back({kernel, "filter, any light, 3 bands, 3 channels", "sums are kept (largest relative change)", 1e-6,
                   [](Context& context) -> Result<double> {
                     LpvFilterParams p;
                     p.grid = grid_of(7, 1, 6);
                     p.bands = 3;
                     p.weight = 0.3;
                     const std::size_t cells = 42;
                     Values v(lpv_pixels(p.grid, 3, 3) * 4);
                     for (std::size_t i = 0; i < v.size(); ++i) v[i] = static_cast<float>(uniform(static_cast<std::uint32_t>(i)));
                     const auto r = filtered(context, p, v);
                     if (!r) return r.status();
                     double most = 0;
                     for (std::size_t volume = 0; volume < 9; ++volume)
                       for (std::size_t c = 0; c < 4; ++c) {
                         double before = 0, after = 0;
                         for (std::size_t i = 0; i < cells; ++i) {
                           before += v[4 * (volume * cells + i) + c];
                           after += r.value()[4 * (volume * cells + i) + c];
                         }
                         most = std::max(most, std::fabs(after / before - 1));
                       }
                     return most;
                   }});
}

}  // namespace

std::vector<Case> lpv_sample_cases() {
  std::vector<Case> cases;
  add_truths(cases);
  add_damping(cases);
  add_cascades(cases);
  add_values(cases);
  add_filter(cases);
  return cases;
}

}  // namespace luxel::cases

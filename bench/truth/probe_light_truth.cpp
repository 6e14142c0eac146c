#include "bench/truth/probe_light_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxel::truth {

namespace {

using Vec = std::array<double, 3>;
constexpr double pi = std::numbers::pi;

double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// A point of the octahedron |x| + |y| + |z| = 1.
Vec octahedron(double u, double v) {
  const double z = 1 - std::fabs(u) - std::fabs(v);
  if (z >= 0) return {u, v, z};
  return {std::copysign(1 - std::fabs(v), u), std::copysign(1 - std::fabs(u), v), z};
}

// The four texels around a place of a map with borders, in texels, and their weights.
struct Look {
  std::array<std::size_t, 4> at{};
  std::array<double, 4> weight{};
};
Look look(const Vec& d, int size, std::size_t map) {
  const auto [u, v] = octahedral_place(d);
  const double x = (u + 1) / 2 * size + 0.5, y = (v + 1) / 2 * size + 0.5;  // centre of texel i at i + 1
  const double i = std::min(std::floor(x), static_cast<double>(size)), j = std::min(std::floor(y), static_cast<double>(size));
  const std::size_t side = static_cast<std::size_t>(size) + 2;
  Look l;
  for (std::size_t k = 0; k < 4; ++k) {
    const double p = k % 2 == 0 ? 1 - (x - i) : x - i, q = k / 2 == 0 ? 1 - (y - j) : y - j;
    l.at[k] = (map * side + static_cast<std::size_t>(j) + k / 2) * side + static_cast<std::size_t>(i) + k % 2;
    l.weight[k] = p * q;
  }
  return l;
}

}  // namespace

void over_sphere(int size, int parts, const std::function<void(int, const Vec&, double)>& visit) {
  const double n = static_cast<double>(size) * parts;
  for (int y = 0; y < size * parts; ++y)
    for (int x = 0; x < size * parts; ++x) {
      const Vec p = octahedron((2.0 * x + 1) / n - 1, (2.0 * y + 1) / n - 1);
      const double squared = inner(p, p), length = std::sqrt(squared);
      // The determinant of a face's point and its two sides is 1 over its area in the map.
      visit(y / parts * size + x / parts, {p[0] / length, p[1] / length, p[2] / length}, 4 / (n * n) / (squared * length));
    }
}

Vec probe_irradiance(const Radiance& radiance, const Vec& n, int size, int parts) {
  Vec e{};
  over_sphere(size, parts, [&](int, const Vec& d, double solid) {
    const double cosine = inner(n, d);
    if (cosine <= 0) return;
    const Vec l = radiance(d);
    for (std::size_t c = 0; c < 3; ++c) e[c] += l[c] * cosine * solid;
  });
  return e;
}

Vec probe_irradiance(int size, std::span<const double> radiance, const Vec& n, int parts) {
  Vec e{};
  over_sphere(size, parts, [&](int texel, const Vec& d, double solid) {
    const double cosine = inner(n, d);
    if (cosine <= 0) return;
    for (std::size_t c = 0; c < 3; ++c) e[c] += radiance[4 * static_cast<std::size_t>(texel) + c] * cosine * solid;
  });
  return e;
}

std::array<double, 2> probe_moments(const ProbeIrradianceParams& p, std::span<const double> distance, const Vec& n, int parts) {
  double all = 0, sum = 0, squares = 0;
  const double unit = probe_unit(p.grid);
  const auto value = [&](int texel) {
    const double d = distance[static_cast<std::size_t>(texel)] / unit;
    return d >= 0 ? std::min(d, p.max_distance) : 0;
  };
  for (const bool about : {false, true})
    over_sphere(p.maps.size, parts, [&](int texel, const Vec& d, double solid) {
      const double cosine = inner(n, d);
      if (cosine <= 0) return;
      const double w = std::pow(cosine, p.power) * solid, v = value(texel);
      if (about) {
        squares += w * (v - sum / all) * (v - sum / all);
      } else {
        all += w;
        sum += w * v;
      }
    });
  return {sum / all, std::sqrt(squares / all)};
}

std::array<double, 4> probe_shade(const ProbeShadeParams& p, const ProbeScene& scene, std::span<const double> r) {
  const ProbeGrid& g = p.grid;
  Vec n{r[4], r[5], r[6]};
  const double size = std::sqrt(inner(n, n)), unit = probe_unit(g);
  if (!(size > 0) || !std::isfinite(size + r[0] + r[1] + r[2])) return {};
  for (double& v : n) v /= size;
  double least = HUGE_VAL;
  bool several = false;
  for (std::size_t k = 0; k < 3; ++k)
    if (g.count[k] > 1) least = std::min(least, g.spacing[k]), several = true;
  if (!several) least = std::min({g.spacing[0], g.spacing[1], g.spacing[2]});

  Vec sum{};
  double all = 0, seen = 0, weights = 0;
  // Every probe of the grid with a tent as wide as a cell: the eight of the cage have a weight.
  Vec q;
  for (std::size_t k = 0; k < 3; ++k)
    q[k] = std::clamp((r[k] - g.origin[k]) / g.spacing[k], 0.0, static_cast<double>(g.count[k] - 1));
  for (int z = 0; z < g.count[2]; ++z)
    for (int y = 0; y < g.count[1]; ++y)
      for (int x = 0; x < g.count[0]; ++x) {
        const Vec at{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        double w = 1;
        for (std::size_t k = 0; k < 3; ++k) w *= std::max(0.0, 1 - std::fabs(q[k] - at[k]));
        const std::size_t probe = static_cast<std::size_t>(x + g.count[0] * (y + g.count[1] * z));
        if (g.placed && scene.positions[4 * probe + 3] <= 0) w = 0;
        if (w == 0) continue;
        Vec v;
        for (std::size_t k = 0; k < 3; ++k)
          v[k] = (r[k] + p.normal_bias * least * n[k] - (g.placed ? scene.positions[4 * probe + k] : g.origin[k] + at[k] * g.spacing[k])) / unit;
        const double distance = std::sqrt(inner(v, v)), cosine = distance > 0 ? -inner(n, v) / distance : 1;
        if (p.facing == ProbeFacing::cosine) w *= std::max(cosine, p.least_facing);
        if (p.facing == ProbeFacing::smooth) w *= (1 + cosine) * (1 + cosine) / 4 + p.least_facing;
        double visible = 1;
        if (p.visibility) {
          const Look l = look(distance > 0 ? v : Vec{0, 0, 1}, p.moments_size, probe);
          double mean = 0, variance = 0;
          for (std::size_t k = 0; k < 4; ++k) mean += l.weight[k] * scene.moments[2 * l.at[k]];
          for (std::size_t k = 0; k < 4; ++k) {
            const double mu = scene.moments[2 * l.at[k]], sigma = scene.moments[2 * l.at[k] + 1];
            variance += l.weight[k] * (sigma * sigma + (mu - mean) * (mu - mean));
          }
          variance += std::pow(p.footprint * 2 / p.moments_size * mean, 2);
          if (distance > mean) {
            const double whole = variance + (distance - mean) * (distance - mean);
            visible = whole > 0 ? std::pow(variance / whole, p.sharpen) : 1;
          }
        }
        const Look l = look(n, p.irradiance_size, probe);
        const double part = w * (p.hidden == ProbeHidden::dark ? visible : std::max(visible, p.least_visibility));
        all += w;
        seen += w * visible;
        weights += part;
        for (std::size_t k = 0; k < 4; ++k)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += part * l.weight[k] * scene.light[4 * l.at[k] + c];
      }
  if (p.hidden == ProbeHidden::dark) weights = std::max(weights, p.least_visibility * all);
  if (!(all > 0)) return {};
  return {sum[0] / weights, sum[1] / weights, sum[2] / weights, seen / all};
}

std::vector<double> probe_shade_all(const ProbeShadeParams& p, const ProbeScene& scene, std::span<const double> receivers) {
  std::vector<double> all;
  for (std::size_t i = 0; i + 8 <= receivers.size(); i += 8)
    for (const double v : probe_shade(p, scene, receivers.subspan(i, 8))) all.push_back(v);
  return all;
}

}  // namespace luxel::truth

#include "tests/cases/light_propagation_support.h"

#include <cmath>
#include <numbers>

#include "tests/cases/run.h"

namespace luxel::cases {
namespace {

// 0..1 from a counter.
double unit(std::uint32_t& state) {
  state += 0x9e3779b9u;
  std::uint32_t h = state;
  h = (h ^ (h >> 16)) * 0x21f0aaadu;
  h = (h ^ (h >> 15)) * 0x735a2d97u;
  h ^= h >> 15;
  return (h >> 8) * (1.0 / (1 << 24));
}

std::array<double, 3> direction(std::uint32_t& state) {
  const double z = 2 * unit(state) - 1, a = 2 * std::numbers::pi * unit(state), r = std::sqrt(1 - z * z);
  return {r * std::cos(a), r * std::sin(a), z};
}

}  // namespace

const char* name(LpvLobes lobes) {
  constexpr const char* names[] = {"linear", "clamp", "shrink", "rescale"};
  return names[static_cast<int>(lobes)];
}

LpvPropagateParams lpv_params(std::array<int, 3> extent, int bands, LpvLobes lobes) {
  LpvPropagateParams p;
  p.grid.extent = extent;
  p.bands = bands;
  p.channels = 1;
  p.lobes = lobes;
  p.keep_injected = false;
  return p;
}

Result<Values> propagate(Context& context, const LpvPropagateParams& params, std::span<const double> injected,
                         std::span<const double> geometry) {
  Result<Run> run = Run::make(context, plan(params, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write("injected", injected); !s) return s;
  if (params.geometry)
    if (Status s = run.value().write("geometry", geometry); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  return run.value().read("result");
}

double lpv_cosine(int i, const std::array<double, 3>& n, double flux) {
  constexpr double pi = std::numbers::pi;
  const double k = std::sqrt(15 / (4 * pi));
  const double quad[5] = {k * n[0] * n[1], k * n[1] * n[2], k / std::sqrt(12.0) * (3 * n[2] * n[2] - 1), k * n[0] * n[2],
                          k / 2 * (n[0] * n[0] - n[1] * n[1])};
  const double value = i == 0 ? std::sqrt(pi) / 2 : i < 4 ? std::sqrt(pi / 3) * n[i % 3] : pi / 4 * quad[i - 4];
  return flux / pi * value;
}

Values lpv_lights(const LpvGrid& grid, int bands, int every, std::uint32_t seed) {
  const std::size_t n = static_cast<std::size_t>(truth::lpv_coefficients(bands)), cells = lpv_pixels(grid, 2, 1);
  Values light(cells * n, 0);
  std::uint32_t state = seed;
  for (std::size_t at = 0; at < cells; ++at) {
    if (unit(state) * every >= 1) continue;
    const auto d = direction(state);
    const double flux = 0.1 + unit(state);
    for (std::size_t i = 0; i < n; ++i) light[at * n + i] = lpv_cosine(static_cast<int>(i), d, flux);
  }
  return light;
}

Values lpv_surfels(const LpvGrid& grid, double most, std::uint32_t seed) {
  Values b(4 * lpv_geometry_pixels(grid), 0);
  std::uint32_t state = seed;
  for (std::size_t at = 0; at < b.size(); at += 4) {
    const auto d = direction(state);
    const double area = most * unit(state);
    for (int i = 0; i < 4; ++i) b[at + static_cast<std::size_t>(i)] = std::numbers::pi * lpv_cosine(i, d, area);
  }
  return b;
}

double lpv_flux(std::span<const double> pixels, std::size_t cells) {
  double sum = 0;
  for (std::size_t at = 0; at < cells; ++at) sum += pixels[4 * at];
  return sum;
}

Values lpv_turned(const Values& pixels, int side, int symmetry) {
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  constexpr std::size_t coefficient[3] = {3, 1, 2};  // of x, y, z
  // Axis a is axis order[a] of `pixels`, backwards where its bit of `flips` is set.
  const auto& order = orders[symmetry / 8];
  const int flips = symmetry % 8;
  Values out(pixels.size());
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int to[3] = {x, y, z};
        int from[3];
        for (int a = 0; a < 3; ++a) from[order[a]] = flips >> a & 1 ? side - 1 - to[a] : to[a];
        const auto at = static_cast<std::size_t>(4 * ((z * side + y) * side + x));
        const auto was = static_cast<std::size_t>(4 * ((from[2] * side + from[1]) * side + from[0]));
        out[at] = pixels[was];
        for (int a = 0; a < 3; ++a) out[at + coefficient[a]] = (flips >> a & 1 ? -1 : 1) * pixels[was + coefficient[order[a]]];
      }
  return out;
}

}  // namespace luxel::cases

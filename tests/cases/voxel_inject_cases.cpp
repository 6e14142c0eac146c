#include "tests/cases/voxel_inject_cases.h"

#include <luxel/voxel_inject.h>

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/run.h"

namespace luxel::cases {
namespace {

using Vec = std::array<double, 3>;
using Values = std::vector<double>;

double uniform(std::uint32_t i) { return (scene::hash(i) >> 8) * 0x1p-24; }

Vec unit(Vec v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  for (double& c : v) c /= length;
  return v;
}

double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec direction(std::uint32_t i) {
  return unit({2 * uniform(3 * i) - 1.01, 2 * uniform(3 * i + 1) - 1.01, 2 * uniform(3 * i + 2) - 1.01});
}

// A cube of voxels whose bricks are all listed.
struct Volume {
  int side;
  Values colour, normal;
  explicit Volume(int n) : side(n), colour(count(n), 0.0), normal(count(n), 0.0) {}
  static std::size_t count(int n) { return static_cast<std::size_t>(n) * n * n * 4; }
  std::size_t at(int x, int y, int z) const { return static_cast<std::size_t>((z * side + y) * side + x) * 4; }
  void put(int x, int y, int z, double coverage, const Vec& n) {
    for (std::size_t c = 0; c < 4; ++c) colour[at(x, y, z) + c] = c < 3 ? 1 : coverage;
    for (std::size_t c = 0; c < 3; ++c) normal[at(x, y, z) + c] = n[c];
  }
};

// Every voxel that the plane through the middle meets, closed boxes.
Volume plane_of(int side, const Vec& n) {
  Volume v(side);
  const double reach = (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2])) / 2, middle = side / 2.0;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (std::fabs(inner(n, {x + 0.5 - middle, y + 0.5 - middle, z + 0.5 - middle})) <= reach) v.put(x, y, z, 1, n);
  return v;
}

Volume random_volume(int side) {
  Volume v(side);
  std::uint32_t i = 1;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x, ++i)
        if (uniform(i) < 0.2) {
          Vec n = direction(i);
          for (double& c : n) c = static_cast<float>(c * uniform(i + 77));
          v.put(x, y, z, uniform(i + 5) < 0.3 ? 1 : static_cast<float>(uniform(i + 9)), n);
        }
  return v;
}

Result<Values> radiance(Context& context, const Volume& v, VoxelInjectParams p, const std::vector<VoxelLight>& lights,
                        const Values& map = {}, const Vec& origin = {0, 0, 0}) {
  p.width = p.height = p.depth = v.side;
  const int along = (v.side + 7) / 8;
  p.bricks = along * along * along;
  p.lights = static_cast<int>(lights.size());
  Result<Run> run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  Values bricks, counters(16, 0.0), words;
  for (int i = 0; i < p.bricks; ++i) bricks.push_back(i);
  counters[2] = p.bricks;
  for (const float w : voxel_lights(lights, origin, p.voxel)) words.push_back(w);
  if (Status s = run.value().write("colour", v.colour); !s) return s;
  if (Status s = run.value().write("bricks", bricks); !s) return s;
  if (Status s = run.value().write("voxel_counters", counters); !s) return s;
  if (!lights.empty()) {
    if (Status s = run.value().write("normal", v.normal); !s) return s;
    if (Status s = run.value().write("lights", words); !s) return s;
  }
  if (!map.empty())
    if (Status s = run.value().write("map", map); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  return run.value().read("radiance");
}

// Largest relative error of pi L where pi L is known.
double largest_error(const Volume& v, const Values& r, double expected) {
  double most = 0;
  for (std::size_t i = 0; i < r.size(); i += 4)
    if (v.colour[i + 3] > 0)
      if (const double e = std::fabs(r[i] * std::numbers::pi - expected) / expected; !(e <= most)) most = e;
  return most;
}

constexpr double float_bound = 16 * 0x1p-24;  // a dozen roundings

void add_planes(std::vector<Case>& cases) {
  cases.push_back({"voxel_inject", "planes of 40 directions, lit from 40 more",
                   "from an offset of 3 sqrt(3) / 2 on a plane never shadows itself (largest error of N.l)",
                   float_bound, [](Context& context) -> Result<double> {
                     double most = 0;
                     for (std::uint32_t i = 1; i <= 40; ++i) {
                       Vec n = direction(i);
                       for (double& c : n) c = static_cast<float>(c);
                       Vec to = direction(1000 + i);
                       const double facing = inner(n, to);
                       if (std::fabs(facing) < 0.05) continue;
                       const Volume v = plane_of(20, n);
                       const auto r = radiance(context, v, {}, {{VoxelLight::Kind::sun, to, {1, 1, 1}, {}, 0}});
                       if (!r) return r.status();
                       const double share = std::fabs(facing) + std::max(0.0, 1 - std::sqrt(inner(n, n))) / 4;
                       most = std::max(most, largest_error(v, r.value(), share) * share);
                     }
                     return most;
                   }});
}

void add_grazing(std::vector<Case>& cases) {
  for (const double degrees : {0.0, 60.0, 89.0})
    cases.push_back({"voxel_inject", fmt::format("sun {} degrees from a floor's normal", degrees),
                     "irradiance is the cosine (largest error over the facing irradiance)", float_bound,
                     [=](Context& context) -> Result<double> {
                       const double angle = degrees * std::numbers::pi / 180;
                       const Volume v = plane_of(16, {0, 1, 0});
                       const auto r =
                           radiance(context, v, {},
                                    {{VoxelLight::Kind::sun, {std::sin(angle), std::cos(angle), 0}, {1, 1, 1}, {}, 0}});
                       if (!r) return r.status();
                       return largest_error(v, r.value(), std::cos(angle)) * std::cos(angle);
                     }});
}

void add_scales(std::vector<Case>& cases) {
  for (const double scale : {1e-3, 1e4})
    cases.push_back({"voxel_inject", fmt::format("a scene with a point light scaled by {}", scale),
                     "the irradiance of the scene as it was (largest relative difference)", float_bound,
                     [=](Context& context) -> Result<double> {
                       const Volume v = plane_of(16, {0, 1, 0});
                       const auto at = [&](double s) {
                         VoxelInjectParams p;
                         p.voxel = s;
                         const Vec origin{s * 3, s * -70, s * 11};
                         const double power = s * s * 50;
                         return radiance(context, v, p,
                                         {{VoxelLight::Kind::point,
                                           {origin[0] + s * 7.3, origin[1] + s * 12.9, origin[2] + s * 8.1},
                                           {power, power, power},
                                           {},
                                           0}},
                                         {}, origin);
                       };
                       const auto a = at(1), b = at(scale);
                       if (!a) return a.status();
                       if (!b) return b.status();
                       double most = 0;
                       for (std::size_t i = 0; i < a.value().size(); ++i)
                         if (a.value()[i] > 0)
                           if (const double e = std::fabs(b.value()[i] / a.value()[i] - 1); !(e <= most)) most = e;
                       return most;
                     }});
}

void add_orders(std::vector<Case>& cases) {
  cases.push_back({"voxel_inject", "a map of 65536 points, and the same turned round",
                   "sums do not depend on the order (values that differ)", 0, [](Context& context) -> Result<double> {
                     const Volume v = random_volume(16);
                     Values map, turned;
                     for (std::uint32_t i = 0; i < 65536; ++i)
                       map.insert(map.end(),
                                  {static_cast<float>(16 * uniform(4 * i)), static_cast<float>(16 * uniform(4 * i + 1)),
                                   static_cast<float>(16 * uniform(4 * i + 2)), 1,
                                   static_cast<float>(uniform(4 * i + 3)), 1e-6f, 1, 0});
                     for (std::size_t i = map.size(); i > 0; i -= 8)
                       turned.insert(turned.end(), map.begin() + static_cast<std::ptrdiff_t>(i) - 8,
                                     map.begin() + static_cast<std::ptrdiff_t>(i));
                     VoxelInjectParams p;
                     p.map_width = p.map_height = 256;
                     const auto a = radiance(context, v, p, {}, map), b = radiance(context, v, p, {}, turned);
                     if (!a) return a.status();
                     if (!b) return b.status();
                     return count_different(a.value(), b.value());
                   }});
  cases.push_back({"voxel_inject", "random voxels, three kinds of lights",
                   "the same bits as the C++ execution in float (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     const Volume v = random_volume(24);
                     const std::vector<VoxelLight> lights{
                         {VoxelLight::Kind::sun, {0.3, 0.8, 0.2}, {1, 0.5, 0.25}, {}, 0},
                         {VoxelLight::Kind::point, {6.3, 30.1, 8.2}, {100, 200, 300}, {}, 0},
                         {VoxelLight::Kind::patch, {-5.2, 4.7, 3.1}, {50, 20, 10}, {2, 0.5, 0.1}, 3}};
                     const auto cpu = Context::open("cpu:float");
                     if (!cpu) return cpu.status();
                     const auto a = radiance(context, v, {}, lights), b = radiance(*cpu.value(), v, {}, lights);
                     if (!a) return a.status();
                     if (!b) return b.status();
                     return count_different(a.value(), b.value());
                   },
                   false, not_double});
}

}  // namespace

std::vector<Case> voxel_inject_cases() {
  std::vector<Case> cases;
  add_planes(cases);
  add_grazing(cases);
  add_scales(cases);
  add_orders(cases);
  return cases;
}

}  // namespace luxel::cases

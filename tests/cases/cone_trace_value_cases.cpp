// Opacities and radiances that are not ordinary.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_cases.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

using std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int side = 16;

using Voxel = std::array<double, 4>;
Values volume(int n, const std::function<Voxel(int x, int y, int z)>& at) {
  Values values;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (const double v : at(x, y, z)) values.push_back(static_cast<float>(v));
  return values;
}

// One receiver in the middle of the lowest slab, looking along +z.
Values looking_up() {
  Values receivers;
  add_receiver(receivers, {0.5, 0.5, 2.0 / side}, {0, 0, 1});
  return receivers;
}

ConeTraceParams single(double aperture, ConeVariant v = ConeVariant::isotropic) {
  ConeTraceParams p = cone_params(side, v);
  p.cones = {{{0, 0, 1}, 1, aperture}};
  p.normal_offset = 0;
  return p;
}

// Homogeneous medium: what a path of 14 voxels hides.
Case medium(double a) {
  return {"", fmt::format("homogeneous medium of opacity {}", a),
          "hidden is 1 - (1-a)^length, whatever the steps and levels (relative error)", 64 * 0x1p-24,
          [=](Context& context) -> Result<double> {
            const double stored = static_cast<float>(a), hidden = -std::expm1(14 * std::log1p(-stored));
            double most = 0;
            for (const double aperture : {0.0, 0.5, pi / 2}) {
              const auto r = trace(context, single(aperture), uniform_volume(side, {stored, stored, stored, stored}),
                                   looking_up());
              if (!r) return r.status();
              const double e = std::fabs(r.value().irradiance[0] / (pi * hidden) - 1);
              if (!(e <= most)) most = e;
            }
            return most;
          }};
}

Case black_case() {
  return {"", "black opaque voxels", "opaque voxels without radiance give exactly 0, and no visibility (largest value)",
          0, [](Context& context) -> Result<double> {
            double most = 0;
            for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
              ConeTraceParams p = cone_params(side, v);
              p.environment = {1, 1, 1};
              const auto r = trace(context, p, uniform_volume(side, {0, 0, 0, 1}), looking_up());
              if (!r) return r.status();
              for (const double x : r.value().irradiance) most = std::max(most, std::fabs(x));
            }
            return most;
          }};
}

Case inside_case() {
  return {"", "start inside a filled voxel", "who is inside opaque voxels of radiance L sees L (relative error)",
          4 * 0x1p-23, [](Context& context) -> Result<double> {
            double most = 0;
            for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
              ConeTraceParams p = cone_params(side, v);
              p.normal_offset = 0;
              p.environment = {9, 9, 9};
              const auto r = trace(context, p, uniform_volume(side, {0.7f, 0.7f, 0.7f, 1}), looking_up());
              if (!r) return r.status();
              most = std::max({most, std::fabs(r.value().irradiance[0] / (pi * 0.7f) - 1), r.value().irradiance[3]});
            }
            return most;
          }};
}

// Dim in front of bright, both opaque.
Case range_case() {
  return {"", "radiance 1e-6 before 1e6", "an opaque wall of 1e-6 hides one of 1e6 behind it (relative error)",
          64 * 0x1p-24, [](Context& context) -> Result<double> {
            const Values v = volume(side, [](int, int, int z) {
              return z < 6 ? Voxel{} : z < 11 ? Voxel{1e-6, 1e-6, 1e-6, 1} : Voxel{1e6, 1e6, 1e6, 1};
            });
            const auto r = trace(context, single(0.1), v, looking_up());
            if (!r) return r.status();
            return std::fabs(r.value().irradiance[0] / (pi * static_cast<double>(1e-6f)) - 1);
          }};
}

Case bright_case() {
  return {"", "radiance of 1e30", "what overflows is dropped and counted, and never NaN or infinite (values, or no count)",
          0, [](Context& context) -> Result<double> {
            ConeTraceParams p = cone_params(side);
            p.normal_offset = 0;
            p.count = true;
            const auto r = trace(context, p, uniform_volume(side, {1e38, 1e30, 0, 0.5}), looking_up());
            if (!r) return r.status();
            double bad = 0;
            for (const double x : r.value().irradiance) bad += std::isfinite(x) ? 0 : 1;
            return bad;
          }, false, not_double};
}

Case nan_case() {
  return {"", "NaN in the volume", "cones that meet NaN or infinity give 0 and are counted (others, or none counted)", 0,
          [](Context& context) -> Result<double> {
            double bad = 0;
            for (const double v : {nan, static_cast<double>(INFINITY)}) {
              ConeTraceParams p = single(0.5);
              p.count = true;
              const auto r = trace(context, p, uniform_volume(side, {v, v, v, 0.5}), looking_up());
              if (!r) return r.status();
              const Values& e = r.value().irradiance;
              bad += e[0] != 0 || e[1] != 0 || e[2] != 0 || e[3] != 1 || r.value().counters[6] != 1;
            }
            return bad;
          }};
}

// Emission without opacity: the integral of the emission along the path.
Case emission_case() {
  return {"", "emission without opacity", "a path of n voxels of emission q and no opacity gives n q (relative error)",
          64 * 0x1p-24, [](Context& context) -> Result<double> {
            const auto r = trace(context, single(0.6), uniform_volume(side, {0.5, 0.5, 0.5, 0}), looking_up());
            if (!r) return r.status();
            return std::fabs(r.value().irradiance[0] / (pi * 0.5 * 14) - 1);
          }};
}

// No coarse level is read by a cone without width, and none is bound.
Case narrow_case() {
  return {"", "aperture 0", "a cone of aperture 0 reads the finest level alone (values that differ with more levels)", 0,
          [](Context& context) -> Result<double> {
            const Values v = volume(side, [](int x, int y, int z) {
              const double a = (x * 7 + y * 5 + z * 3) % 11 / 11.0;
              return Voxel{a * 0.3, a * 0.6, a, a};
            });
            ConeTraceParams p = cone_params(side);
            p.cones = classic_cones();
            for (Cone& c : p.cones) c.aperture = 0;
            const auto all = trace(context, p, v, looking_up());
            p.levels = 1;
            const auto one = trace(context, p, v, looking_up());
            if (!all) return all.status();
            if (!one) return one.status();
            return count_different(all.value().irradiance, one.value().irradiance);
          }};
}

// Two sheets of opacity 1/2: cones take what the sheets hide as independent.
Case sheets_case(const char* name, bool complementary, double truth) {
  return {"", fmt::format("two half-opaque sheets, {}", name),
          fmt::format("{:.2f} should pass; cones multiply, and interpolation thins each sheet (difference)", truth),
          // Half of a half is 1/4 beside 1/2 or 0; each sheet, interpolated and averaged, passes .65 in place of 1/2.
          0.45, [=](Context& context) -> Result<double> {
            const Values v = volume(side, [=](int x, int y, int z) {
              const bool filled = (x + y + (z > 8 && complementary ? 1 : 0)) % 2 == 0;
              return Voxel{0, 0, 0, (z == 6 || z == 10) && filled ? 1.0 : 0.0};
            });
            const auto r = trace(context, single(pi / 3), v, looking_up());
            if (!r) return r.status();
            return std::fabs(r.value().irradiance[3] - truth);
          }};
}

// A wall one voxel thick before an open sky, at every place relative to the coarse voxels; far enough from the volume's
// end for the coarsest level, where it is spread over three voxels, to hold all of it.
Case wall_case(ConeVariant variant, bool mean, double bound, const char* why) {
  const char* how = variant == ConeVariant::isotropic ? "isotropic" : "anisotropic";
  return {"", fmt::format("thin opaque wall, {}, {}", how, mean ? "mean" : "largest leak"), why, bound,
          [=](Context& context) -> Result<double> {
            constexpr int n = 64;
            double most = 0, sum = 0;
            int count = 0;
            for (int at = 8; at < 29; at += 1) {
              const Values v = volume(n, [=](int, int, int z) { return Voxel{0, 0, 0, z == at ? 1.0 : 0.0}; });
              for (const double degrees : {10.0, 20.0, 30.0}) {
                ConeTraceParams p = cone_params(n, variant);
                p.cones = {{{0, 0, 1}, 1, degrees * pi / 180}};
                p.footprint = 1;
                p.normal_offset = 0;
                p.environment = {1, 1, 1};
                Values receivers;
                add_receiver(receivers, {0.5, 0.5, 1.0 / n}, {0, 0, 1});
                const auto r = trace(context, p, v, receivers);
                if (!r) return r.status();
                most = std::max(most, r.value().irradiance[0] / pi);
                sum += r.value().irradiance[0] / pi;
                ++count;
              }
            }
            return mean ? sum / count : most;
          }};
}

}  // namespace

void add_cone_value_cases(std::vector<Case>& cases) {
  for (const double a : {1e-7, 1e-3, 0.25, 0.99, 1 - 0x1p-24, 1.0}) cases.push_back(medium(a));
  cases.push_back(black_case());
  cases.push_back(inside_case());
  cases.push_back(range_case());
  cases.push_back(bright_case());
  cases.push_back(nan_case());
  cases.push_back(emission_case());
  cases.push_back(narrow_case());
  cases.push_back(sheets_case("aligned", false, 0.5));
  cases.push_back(sheets_case("complementary", true, 0));
  cases.push_back(wall_case(ConeVariant::isotropic, true, std::exp(-1.0),
                            "at every level 1/e of the light leaks, and not 1 - 2^-l (mean leak over 21 places)"));
  // Where the cone goes on to a coarser level inside the wall's smear, the next level has the wall elsewhere.
  cases.push_back(wall_case(ConeVariant::isotropic, false, 0.5, "at most half where the level changes within the wall"));
  cases.push_back(wall_case(ConeVariant::anisotropic, true, 0.25,
                            "along the axis at most a quarter between voxel centres (mean leak over 21 places)"));
  cases.push_back(wall_case(ConeVariant::anisotropic, false, 0.35, "at most .35 where the level changes within the wall"));
}

}  // namespace luxel::cases

// Where light is the same everywhere: whatever the opacities, every cone sees it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/cone_trace_cases.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

using std::numbers::pi;

constexpr int side = 16;

// q = a: empty, opaque, all kinds of densities, some so thin that they vanish beside 1.
Values furnace(Format format, std::uint32_t seed) {
  Values values;
  for (std::uint32_t i = 0; i < side * side * side; ++i) {
    const double kind = scene::random01(2 * i, seed), v = scene::random01(2 * i + 1, seed);
    const double a = kind < 0.4 ? 0 : kind < 0.5 ? 1 : kind < 0.6 ? 1 - 0x1p-24 : kind < 0.7 ? 1e-7 * v : v * v;
    values.insert(values.end(), 4, static_cast<float>(a));
  }
  return quantise(values, format);
}

ConeTraceParams furnace_params(ConeVariant variant, Format format, const NamedSet& set) {
  ConeTraceParams p = cone_params(side, variant, format);
  p.cones = set.cones;
  p.width = 64;
  return p;
}

// C and A run the same recurrence, so that they are equal to the bit; C + (1 - A) rounds once a cone, the mean over n
// cones n times: n + 2 steps of 2^-24. The printed bound counts the steps as well: a cone makes at most 64 here.
double bound(const NamedSet& set) { return (static_cast<double>(set.cones.size()) + 2) * 0x1p-23; }

Case furnace_case(const NamedSet& set, ConeVariant variant, Format format) {
  const char* how = variant == ConeVariant::isotropic ? "isotropic" : "anisotropic";
  return {"", fmt::format("furnace, {} {}, set {}", how, name(format), set.name),
          "radiance 1 in every voxel of any opacity and beyond: every cone sees 1 (error)", bound(set),
          [=](Context& context) -> Result<double> {
            ConeTraceParams p = furnace_params(variant, format, set);
            p.environment = {1, 1, 1};
            const auto r = trace(context, p, furnace(format, 3), cone_receivers(p, p.width, 5));
            if (!r) return r.status();
            double most = 0;
            for (int i = 0; i < p.width; ++i)
              for (int c = 0; c < 3; ++c) {
                const double e = std::fabs(r.value().irradiance[i * 4 + c] / pi - 1);
                if (!(e <= most)) most = e;
              }
            return most;
          }};
}

// The answer is A.
Case dark_case(const NamedSet& set, ConeVariant variant) {
  const char* how = variant == ConeVariant::isotropic ? "isotropic" : "anisotropic";
  return {"", fmt::format("dark furnace, {}, set {}", how, set.name),
          "the same without light beyond the volume: cones see their opacity (difference from 1 - visibility)",
          bound(set), [=](Context& context) -> Result<double> {
            const ConeTraceParams p = furnace_params(variant, Format::f32x4, set);
            const auto r = trace(context, p, furnace(Format::f32x4, 4), cone_receivers(p, p.width, 6));
            if (!r) return r.status();
            double most = 0;
            for (int i = 0; i < p.width; ++i) {
              const double e = std::fabs(r.value().irradiance[i * 4] / pi - (1 - r.value().irradiance[i * 4 + 3]));
              if (!(e <= most)) most = e;
            }
            return most;
          }};
}

// A closed room, its walls eight voxels thick, of radiance L: emission e, albedo rho, after `bounces` exchanges.
Case room_case(const char* name, int bounces, ConeVariant variant) {
  const char* how = variant == ConeVariant::isotropic ? "isotropic" : "anisotropic";
  return {"", fmt::format("closed room, {}, {}", how, name),
          "a closed room of emission e and albedo rho has e (1 - rho^n) / (1 - rho) after n exchanges (relative error)",
          // Each of up to 25 exchanges rounds some 64 times.
          25 * 64 * 0x1p-24, [=](Context& context) -> Result<double> {
            constexpr int n = 32, wall = 8;
            constexpr double emission = 0.3, albedo = 0.7;
            ConeTraceParams p = cone_params(n, variant);
            Values receivers;
            for (int axis = 0; axis < 3; ++axis)
              for (const double towards : {-1.0, 1.0})
                for (int i = 0; i < 4; ++i) {
                  std::array<double, 3> at, normal{};
                  for (int a = 0; a < 3; ++a)
                    at[a] = a == axis ? (towards < 0 ? n - wall : wall) : wall + 2 + 4 * ((i >> (a % 2)) & 1) + 3.5;
                  normal[axis] = towards;
                  for (double& v : at) v /= n;
                  add_receiver(receivers, at, normal);
                }
            p.width = static_cast<int>(receivers.size() / 8);
            double radiance = 0, expected = 0, most = 0;
            for (int bounce = 0; bounce <= bounces; ++bounce) {
              expected = emission + albedo * expected;
              Values room;
              for (int i = 0; i < n * n * n; ++i) {
                const int x = i % n, y = i / n % n, z = i / n / n;
                const int low = std::min({x, y, z}), high = std::max({x, y, z});
                const double a = low < wall || high >= n - wall ? 1 : 0;
                const double l = static_cast<float>(emission + albedo * radiance);
                room.insert(room.end(), {a * l, a * l, a * l, a});
              }
              const auto r = trace(context, p, room, receivers);
              if (!r) return r.status();
              double sum = 0;
              for (int i = 0; i < p.width; ++i) {
                const double seen = r.value().irradiance[i * 4] / pi;
                const double e = std::fabs(seen / expected - 1);
                if (!(e <= most)) most = e;
                sum += seen;
              }
              radiance = sum / p.width;
            }
            return most;
          }};
}

}  // namespace

void add_cone_furnace_cases(std::vector<Case>& cases) {
  for (const NamedSet& set : cone_sets())
    for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
      cases.push_back(furnace_case(set, v, Format::f32x4));
      if (set.name != "6") continue;
      cases.push_back(furnace_case(set, v, Format::f16x4));
      cases.push_back(furnace_case(set, v, Format::unorm8x4));
      cases.push_back(dark_case(set, v));
    }
  for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
    cases.push_back(room_case("e", 0, v));
    cases.push_back(room_case("e (1 + rho)", 1, v));
    cases.push_back(room_case("e / (1 - rho)", 24, v));
  }
}

}  // namespace luxel::cases

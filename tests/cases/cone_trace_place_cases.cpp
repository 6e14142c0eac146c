// Receivers, normals and parameters that are not ordinary.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "bench/scene/volumes.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_cases.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

using std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int side = 16;

Case normals_case() {
  return {"", "bad normals and places", "zero, NaN and infinite normals or places give 0 and are counted (others)", 0,
          [](Context& context) -> Result<double> {
            ConeTraceParams p = cone_params(side);
            p.count = true;
            p.specular = true;
            p.environment = {1, 1, 1};
            const double inf = INFINITY, big = std::numeric_limits<float>::max();
            Values receivers;
            add_receiver(receivers, {0.5, 0.5, 0.5}, {0, 0, 0});
            add_receiver(receivers, {0.5, 0.5, 0.5}, {nan, 0, 1});
            add_receiver(receivers, {0.5, 0.5, 0.5}, {0, inf, 1});
            add_receiver(receivers, {0.5, 0.5, 0.5}, {0, 1e-40, 0});
            add_receiver(receivers, {nan, 0.5, 0.5}, {0, 0, 1});
            add_receiver(receivers, {0.5, -inf, 0.5}, {0, 0, 1});
            add_receiver(receivers, {0.5, 0.5, big}, {0, 0, 1});  // infinite, in voxels
            p.width = static_cast<int>(receivers.size() / 8);
            Values views;
            for (int i = 0; i < p.width; ++i) views.insert(views.end(), {0, 0, 1, 0});
            const auto r = trace(context, p, uniform_volume(side, {1, 1, 1, 0.5}), receivers, views);
            if (!r) return r.status();
            double bad = 0;
            for (const double v : r.value().irradiance) bad += v != 0;
            for (const double v : r.value().specular) bad += v != 0;
            return bad + std::fabs(r.value().counters[7] - 2.0 * p.width);
          }, false, not_double};
}

Case scaled_normals_case() {
  return {"", "normals of any length", "normals need no unit length (largest difference)", 1e-5,
          [](Context& context) -> Result<double> {
            ConeTraceParams p = cone_params(side);
            p.width = 4;
            const Values room = scene::voxel_room(side);
            Values one, other;
            for (const double scale : {1.0, 1e-20, 1e20, 3.0}) {
              add_receiver(one, {0.6, 0.6, 0.3}, {0.25, 0.5, 0.75});
              add_receiver(other, {0.6, 0.6, 0.3}, {0.25 * scale, 0.5 * scale, 0.75 * scale});
            }
            const auto a = trace(context, p, room, one), b = trace(context, p, room, other);
            if (!a) return a.status();
            if (!b) return b.status();
            return max_difference(a.value().irradiance, b.value().irradiance);
          }};
}

Case outside_case() {
  return {"", "receivers outside", "who looks past the volume sees the environment exactly, from any distance (others)", 0,
          [](Context& context) -> Result<double> {
            ConeTraceParams p = cone_params(side);
            p.environment = {0.25, 0.5, 1};
            p.cones = {{{0, 0, 1}, 1, 0.3}};
            Values receivers;
            for (const double away : {1.5, 100.0, 1e9, 1e30}) {
              add_receiver(receivers, {0.5, 0.5, away}, {0, 0, 1});
              add_receiver(receivers, {-away, 0.5, 0.5}, {-1, 0, 0});
              add_receiver(receivers, {0.5, away, 0.5}, {1, 0, 0});
            }
            p.width = static_cast<int>(receivers.size() / 8);
            const auto r = trace(context, p, uniform_volume(side, {3, 3, 3, 1}), receivers);
            if (!r) return r.status();
            double bad = 0;
            for (int i = 0; i < p.width; ++i)
              for (int c = 0; c < 3; ++c)
                bad += !(std::fabs(r.value().irradiance[i * 4 + c] / (pi * p.environment[c]) - 1) <= 0x1p-22);
            return bad;
          }};
}

Case towards_case() {
  return {"", "looking in from outside", "an opaque volume hides the environment from who looks at it (light that leaks)",
          1e-6, [](Context& context) -> Result<double> {
            double most = 0;
            for (const double away : {1.5, 10.0, 1000.0}) {
              ConeTraceParams p = cone_params(side);
              p.environment = {1, 1, 1};
              p.cones = {{{0, 0, 1}, 1, 1.0}};
              Values receivers;
              add_receiver(receivers, {0.5, 0.5, away}, {0, 0, -1});
              const auto r = trace(context, p, uniform_volume(side, {0, 0, 0, 1}), receivers);
              if (!r) return r.status();
              most = std::max(most, r.value().irradiance[0]);
            }
            return most;
          }};
}

Case steps_case() {
  return {"", "steps are bounded", "cones end before the step cap that the host computes, for any parameters (capped cones)",
          0, [](Context& context) -> Result<double> {
            double capped = 0;
            for (std::uint32_t i = 0; i < 24; ++i) {
              const auto random = [&](std::uint32_t k) { return scene::random01(i * 16 + k, 9); };
              ConeTraceParams p = cone_params(side, i % 2 == 0 ? ConeVariant::isotropic : ConeVariant::anisotropic);
              p.extent = {side, 1 + static_cast<int>(40 * random(0)), 1 + static_cast<int>(9 * random(1))};
              p.width = 32;
              p.count = true;
              p.cones = classic_cones();
              for (Cone& c : p.cones) c.aperture = i % 3 == 0 ? 0 : 2.6 * random(2);
              p.step_scale = i % 4 == 0 ? 0.0625 : 0.0625 + 3.9 * random(3);
              p.start = 64 * random(4) * random(4);
              p.normal_offset = 64 * random(5) * random(6);
              const std::size_t texels = static_cast<std::size_t>(p.extent[0]) * p.extent[1] * p.extent[2];
              const Values thin(texels * 4, 1e-3);
              const auto r = trace(context, p, thin, cone_receivers(p, p.width, i));
              if (!r) return r.status();
              capped += r.value().counters[4];
              double outcomes = 0;
              for (int k = 1; k <= 5; ++k) outcomes += r.value().counters[k];
              capped += std::fabs(outcomes - r.value().counters[0]);
            }
            return capped;
          }};
}

// Two steps of a sixteenth of a voxel lead nowhere: nearly all cones of zero width must say that they were stopped.
Case cap_case() {
  return {"", "a cap of two steps", "cones that the cap stops are counted as capped (part that are not, of those in the volume)",
          0.1, [](Context& context) -> Result<double> {
            double most = 0;
            for (const ConeVariant variant : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
              ConeTraceParams p = cone_params(side, variant);
              p.width = 32;
              p.count = true;
              p.cones = classic_cones();
              for (Cone& c : p.cones) c.aperture = 0;
              p.step_scale = 0.0625;
              p.start = 0;
              p.max_steps = 2;
              const Values thin(static_cast<std::size_t>(side) * side * side * 4, 1e-3);
              const auto r = trace(context, p, thin, cone_receivers(p, p.width, 3));
              if (!r) return r.status();
              const double within = r.value().counters[0] - r.value().counters[5];
              most = std::max(most, within > 32 ? 1 - r.value().counters[4] / within : 1.0);
            }
            return most;
          }};
}

// The inner corner of three opaque walls that shine: the receiver sees mostly walls, and their light is all the same.
Case corner_case() {
  return {"", "corner of three filled voxels", "light in a corner is at most that of the walls (excess, or negative light)",
          4 * 0x1p-23, [](Context& context) -> Result<double> {
            ConeTraceParams p = cone_params(side);
            Values v;
            for (int i = 0; i < side * side * side; ++i) {
              const bool wall = i % side < 4 || i / side % side < 4 || i / side / side < 4;
              v.insert(v.end(), 4, wall ? 1.0 : 0.0);
            }
            Values receivers;
            const double at = 4.0 / side;
            add_receiver(receivers, {at, at, at}, {1, 0, 0});
            add_receiver(receivers, {at, at, at}, {1, 1, 1});
            add_receiver(receivers, {at + 0.01, at, at}, {0, 0, 1});
            p.width = 3;
            const auto r = trace(context, p, v, receivers);
            if (!r) return r.status();
            double most = 0;
            for (const double x : r.value().irradiance) most = std::max({most, x / pi - 1, -x});
            return most;
          }};
}

// One of the 48 symmetries of the cube: axes permuted, then mirrored.
struct Symmetry {
  std::array<int, 3> axis;
  std::array<bool, 3> mirrored;
};
std::vector<Symmetry> symmetries() {
  std::vector<Symmetry> all;
  std::array<int, 3> axis{0, 1, 2};
  do
    for (int m = 0; m < 8; ++m) all.push_back({axis, {(m & 1) != 0, (m & 2) != 0, (m & 4) != 0}});
  while (std::next_permutation(axis.begin(), axis.end()));
  return all;
}
std::array<double, 3> turned(const Symmetry& s, const std::array<double, 3>& v, double mirror) {
  std::array<double, 3> r;
  for (int i = 0; i < 3; ++i) r[i] = s.mirrored[i] ? mirror - v[s.axis[i]] : v[s.axis[i]];
  return r;
}

Case symmetry_case(ConeVariant variant) {
  const char* how = variant == ConeVariant::isotropic ? "isotropic" : "anisotropic";
  return {"", fmt::format("48 symmetries, {}", how),
          "the scene turned and mirrored with its receivers gives the same light along a cone (difference)", 2e-5, [=](Context& context) -> Result<double> {
            ConeTraceParams p = cone_params(side, variant);
            p.width = 16;
            p.environment = {0.1, 0.2, 0.3};
            p.cones = cone_set(1, 0.6).value();  // in more cones the frame's azimuth shows, which no frame turns with all
            const Values room = scene::voxel_room(side);
            Values receivers;
            for (std::uint32_t i = 0; i < 16; ++i) {
              std::array<double, 3> at, n;
              for (std::uint32_t a = 0; a < 3; ++a) {
                at[a] = 0.1 + 0.8 * scene::random01(i * 8 + a, 5);
                n[a] = (0.2 + 0.3 * a + 0.1 * scene::random01(i * 8 + 4 + a, 5)) * (scene::random01(i * 8 + 3, 5 + a) < 0.5 ? -1 : 1);
              }
              add_receiver(receivers, at, n);
            }
            const auto first = trace(context, p, room, receivers);
            if (!first) return first.status();
            double most = 0;
            for (const Symmetry& s : symmetries()) {
              Values turned_room(room.size()), turned_receivers;
              for (int i = 0; i < side * side * side; ++i) {
                const std::array<double, 3> at{i % side + 0.5, i / side % side + 0.5, i / side / side + 0.5};
                const auto to = turned(s, at, side);
                const int j = (static_cast<int>(to[2]) * side + static_cast<int>(to[1])) * side + static_cast<int>(to[0]);
                std::copy_n(&room[i * 4], 4, &turned_room[j * 4]);
              }
              for (std::size_t i = 0; i < receivers.size(); i += 8)
                add_receiver(turned_receivers, turned(s, {receivers[i], receivers[i + 1], receivers[i + 2]}, 1),
                             turned(s, {receivers[i + 4], receivers[i + 5], receivers[i + 6]}, 0));
              const auto r = trace(context, p, turned_room, turned_receivers);
              if (!r) return r.status();
              most = std::max(most, max_difference(r.value().irradiance, first.value().irradiance));
            }
            return most;
          }};
}

// Scene units, and a corner elsewhere: the same picture.
Case scale_case() {
  return {"", "scene scaled by 1e-3 to 1e4", "the same scene in other units, distances in them, gives the same (difference)",
          2e-5, [](Context& context) -> Result<double> {
            const Values room = scene::voxel_room(side);
            Values first;
            double most = 0;
            for (const double scale : {1.0, 1e-3, 1e4}) {
              ConeTraceParams p = cone_params(side);
              p.width = 32;
              p.voxel = scale / side;
              p.gamma = 3 / scale;
              p.max_distance = 0.7 * scale;
              Values receivers = cone_receivers(cone_params(side), p.width, 3);
              for (std::size_t i = 0; i < receivers.size(); i += 8)
                for (std::size_t a = 0; a < 3; ++a) receivers[i + a] *= scale;
              const auto r = trace(context, p, room, receivers);
              if (!r) return r.status();
              if (first.empty()) first = r.value().irradiance;
              most = std::max(most, max_difference(r.value().irradiance, first));
            }
            return most;
          }};
}

}  // namespace

void add_cone_place_cases(std::vector<Case>& cases) {
  cases.push_back(normals_case());
  cases.push_back(scaled_normals_case());
  cases.push_back(outside_case());
  cases.push_back(towards_case());
  cases.push_back(steps_case());
  cases.push_back(cap_case());
  for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
    cases.push_back(symmetry_case(v));
  }
  cases.push_back(corner_case());
  cases.push_back(scale_case());
}

std::vector<Case> cone_trace_cases() {
  std::vector<Case> cases;
  add_cone_furnace_cases(cases);
  add_cone_value_cases(cases);
  add_cone_place_cases(cases);
  add_cone_scene_cases(cases);
  for (Case& c : cases) c.kernel = "cone_trace";
  return cases;
}

}  // namespace luxel::cases

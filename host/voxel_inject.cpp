#include <luxel/voxel_inject.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

constexpr int brick_side = 8;
constexpr std::size_t brick_voxels = 512;
constexpr double steps = 16384;           // of irradiance_max, as kernels/voxelize/voxel_inject_map has it
constexpr std::uint32_t strided = 65536;  // invocations of passes that stride over their work

std::size_t bricks_of(const VoxelInjectParams& p) {
  const auto along = [&](int n) { return static_cast<std::size_t>((n + brick_side - 1) / brick_side + p.toroidal); };
  return along(p.width) * along(p.height) * along(p.depth);
}

std::size_t voxels_of(const VoxelInjectParams& p) {
  return static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height) * static_cast<std::size_t>(p.depth);
}

std::size_t sums_of(const VoxelInjectParams& p) { return static_cast<std::size_t>(p.bricks) * brick_voxels * 4; }

int modulo(int a, int n) { return (a % n + n) % n; }
Planner::Values window_values(const VoxelInjectParams& p) {
  const auto turn = [&](std::size_t axis, int n) { return p.toroidal ? modulo(p.window[axis], n) : 0; };
  return {{"inner_x", turn(0, brick_side)}, {"inner_y", turn(1, brick_side)}, {"inner_z", turn(2, brick_side)},
          {"turn_x", turn(0, p.width)},     {"turn_y", turn(1, p.height)},    {"turn_z", turn(2, p.depth)}};
}

Status check_above_zero(const char* field, double value) {
  return value > 0 && std::isfinite(value) ? Status() : out_of_range(field, value, "a number above 0");
}

// Texels of a voxel along both axes, and what asks for orthogonal rows.
Status check_shadow(const VoxelInjectParams& p) {
  const VoxelShadow& s = p.shadow;
  const int there = s.width > 0 || s.height > 0;
  LUXEL_CHECK(check_range("VoxelInjectParams.shadow.width", s.width, there, 32768));
  LUXEL_CHECK(check_range("VoxelInjectParams.shadow.height", s.height, there, 32768));
  if (there == 0) return {};
  if (p.lights == 0) return out_of_range("VoxelInjectParams.lights", p.lights, "1..65536 with a shadow map");
  const auto inner = [](const std::array<double, 4>& a, const std::array<double, 4>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  const double u = std::sqrt(inner(s.to_x, s.to_x)), v = std::sqrt(inner(s.to_y, s.to_y)),
               w = std::sqrt(inner(s.to_depth, s.to_depth));
  LUXEL_CHECK(check_range("VoxelInjectParams.shadow.to_x's length", u, 1.0, 8.0));
  LUXEL_CHECK(check_range("VoxelInjectParams.shadow.to_y's length", v, 1.0, 8.0));
  LUXEL_CHECK(check_range("VoxelInjectParams.shadow.to_depth's length", w, 1e-20, 1e20));
  const double tilt = std::max({std::fabs(inner(s.to_x, s.to_y)) / (u * v), std::fabs(inner(s.to_x, s.to_depth)) / (u * w),
                                std::fabs(inner(s.to_y, s.to_depth)) / (v * w)});
  LUXEL_CHECK(check_range("VoxelInjectParams.shadow's cosine between directions", tilt, 0.0, 1e-4));
  for (const auto& row : {s.to_x, s.to_y, s.to_depth})
    LUXEL_CHECK(check_range("VoxelInjectParams.shadow's offset", row[3], -1e30, 1e30));
  return {};
}

}  // namespace

VoxelShadow voxel_shadow(const std::array<int, 3>& extent, const std::array<double, 3>& direction, double texels) {
  const double length = std::hypot(direction[0], direction[1], direction[2]);
  const std::array<double, 3> l{direction[0] / length, direction[1] / length, direction[2] / length};
  const std::array<double, 3> axis = std::fabs(l[1]) < 0.9 ? std::array<double, 3>{0, 1, 0} : std::array<double, 3>{1, 0, 0};
  const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  std::array<double, 3> right = cross(axis, l);
  const double scale = 1 / std::hypot(right[0], right[1], right[2]);
  for (double& c : right) c *= scale;
  const std::array<double, 3> up = cross(l, right);
  const double across = std::hypot(extent[0], extent[1], extent[2]);
  VoxelShadow shadow;
  // At least so many texels a voxel, in a map that a buffer can hold.
  shadow.width = shadow.height = std::min(32768, static_cast<int>(std::ceil(across * texels)));
  const auto row = [&](const std::array<double, 3>& d, double size, double middle) {
    std::array<double, 4> r{size * d[0], size * d[1], size * d[2], middle};
    for (std::size_t i = 0; i < 3; ++i) r[3] -= r[i] * extent[i] / 2;
    return r;
  };
  shadow.to_x = row(right, texels, shadow.width / 2.0);
  shadow.to_y = row(up, texels, shadow.height / 2.0);
  shadow.to_depth = row(l, -1, across / 2);
  return shadow;
}

Status validate(const VoxelInjectParams& p) {
  LUXEL_CHECK(check_range("VoxelInjectParams.width", p.width, 1, 2048));
  LUXEL_CHECK(check_range("VoxelInjectParams.height", p.height, 1, 2048));
  LUXEL_CHECK(check_range("VoxelInjectParams.depth", p.depth, 1, 2048));
  if (voxels_of(p) * 4 > 0x7fffffff)
    return out_of_range("VoxelInjectParams.depth", p.depth, "width x height x depth of at most 536870911");
  if (p.toroidal)
    for (const int n : {p.width, p.height, p.depth})
      if (n % brick_side != 0 || n > 2040)
        return out_of_range("VoxelInjectParams.width, height or depth", n, "multiples of 8 up to 2040 with toroidal");
  if (p.format != Format::f32x4 && p.format != Format::f16x4 && p.format != Format::unorm8x4)
    return out_of_range("VoxelInjectParams.format", name(p.format), "f32x4, f16x4 or unorm8x4");
  LUXEL_CHECK(check_range("VoxelInjectParams.bricks", p.bricks, 1, static_cast<int>(bricks_of(p))));
  LUXEL_CHECK(check_range("VoxelInjectParams.lights", p.lights, 0, 65536));
  LUXEL_CHECK(check_range("VoxelInjectParams.normal_offset", p.normal_offset, 0.0, 64.0));
  const int least = p.map_width > 0 || p.map_height > 0;
  LUXEL_CHECK(check_range("VoxelInjectParams.map_width", p.map_width, least, 32768));
  LUXEL_CHECK(check_range("VoxelInjectParams.map_height", p.map_height, least, 32768));
  LUXEL_CHECK(check_above_zero("VoxelInjectParams.irradiance_max", p.irradiance_max));
  if (least && sums_of(p) > 0x7fffffff)
    return out_of_range("VoxelInjectParams.bricks", p.bricks, "1..1048575 with a map");
  LUXEL_CHECK(check_shadow(p));
  LUXEL_CHECK(check_above_zero("VoxelInjectParams.voxel", p.voxel));
  return check_above_zero("VoxelInjectParams.scale", p.scale);
}

std::vector<std::uint32_t> voxel_all_bricks(const VoxelInjectParams& p) {
  std::vector<std::uint32_t> list(bricks_of(p));
  std::iota(list.begin(), list.end(), 0u);
  return list;
}

Result<Plan> plan(const VoxelInjectParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const bool map = p.map_width > 0, list = p.lights > 0 || !map;
  const std::size_t pixel = bytes_per_pixel(p.format), voxels = voxels_of(p);
  const std::string format = name(p.format);
  Planner planner("voxel_inject");
  const auto resource = [&](const char* name, Format f, std::size_t bytes, bool written = false) {
    Resource r{name};
    r.format = f;
    r.bytes = bytes;
    r.written = written;
    return planner.resource(r);
  };
  const Slot colour = resource("colour", p.format, voxels * pixel);
  const Slot normal = list ? resource("normal", p.format, voxels * pixel) : Slot{};
  const Slot emission = p.emission ? resource("emission", p.format, voxels * pixel) : Slot{};
  const Slot bricks = resource("bricks", Format::u32, static_cast<std::size_t>(p.bricks) * 4);
  const Slot counters = resource("voxel_counters", Format::u32, 64);
  const Slot lights =
      list ? resource("lights", Format::f32x4, static_cast<std::size_t>(std::max(p.lights, 1)) * 48) : Slot{};
  const Slot shadow = p.shadow.width > 0 ? resource("shadow", Format::f32x1,
                                                    static_cast<std::size_t>(p.shadow.width) *
                                                        static_cast<std::size_t>(p.shadow.height) * 4)
                                         : counters;  // never read without a map
  const Slot texels =
      map ? resource("map", Format::f32x4,
                     static_cast<std::size_t>(p.map_width) * static_cast<std::size_t>(p.map_height) * 32)
          : Slot{};
  const Slot radiance = resource("radiance", p.format, voxels * pixel, true);
  const Slot outcomes = p.count ? resource("outcomes", Format::u32, 32, true) : planner.scratch(Format::u32, 8);

  const std::array<std::uint32_t, 3> line{64, 1, 1};
  const auto zero = [&](Slot words, std::size_t count, const char* what) {
    planner.pass("voxel_inject_zero", "u32", std::string("voxel_inject clear ") + what, {strided, 1, 1}, line,
                 {{"count", static_cast<double>(count)}, {"stride", strided}}, {}, {{"words", words}});
    planner.cost(0, static_cast<double>(count) * 4);
  };
  if (p.clear) {
    planner.pass("voxel_inject_clear", format, "voxel_inject clear radiance", {strided, 1, 1}, line,
                 {{"count", static_cast<double>(voxels)}, {"stride", strided}}, {}, {{"radiance", radiance}});
    planner.cost(0, static_cast<double>(voxels * pixel));
  }
  zero(outcomes, 8, "outcomes");

  const Planner::Values window = window_values(p);
  const std::uint32_t capacity = static_cast<std::uint32_t>(p.bricks);
  Slot sums;
  if (map) {
    const Slot slots = planner.scratch(Format::u32, bricks_of(p));
    sums = planner.scratch(Format::u32, sums_of(p));
    zero(slots, bricks_of(p), "slots");
    zero(sums, sums_of(p), "sums");
    planner.pass("voxel_inject_slots", "u32", "voxel_inject slots", {capacity, 1, 1}, line, {{"bricks", p.bricks}}, {},
                 {{"brick_list", bricks}, {"voxel_counters", counters}, {"slots", slots}});
    planner.pass("voxel_inject_map", format, "voxel_inject map",
                 {static_cast<std::uint32_t>(p.map_width), static_cast<std::uint32_t>(p.map_height), 1},
                 profile.pixels.workgroup, window +
                 Planner::Values{{"width", p.width},
                  {"height", p.height},
                  {"depth", p.depth},
                  {"map_width", p.map_width},
                  {"map_height", p.map_height},
                  {"per_unit", steps / p.irradiance_max}},
                 {{"COUNT", p.count}, {"TORUS", p.toroidal}},
                 {{"map", texels}, {"colour", colour}, {"slots", slots}, {"sums", sums}, {"outcomes", outcomes}});
    planner.cost(0, static_cast<double>(p.map_width) * p.map_height * 48.0);
  }

  std::vector<std::pair<std::string_view, Slot>> slots{{"colour", colour},
                                                       {"brick_list", bricks},
                                                       {"voxel_counters", counters},
                                                       {"radiance", radiance},
                                                       {"outcomes", outcomes}};
  if (list) slots.insert(slots.end(), {{"normal", normal}, {"lights", lights}, {"shadow", shadow}});
  if (map) slots.emplace_back("sums", sums);
  if (p.emission) slots.emplace_back("emission", emission);
  const std::string module = std::string(!map   ? "lights_"
                                         : list ? "both_"
                                                : "map_") +
                             (p.emission ? "emission_" : "") + format;
  planner.pass("voxel_inject", module, "voxel_inject", {brick_voxels, capacity, 1}, line, window +
               Planner::Values{{"width", p.width},
                {"height", p.height},
                {"depth", p.depth},
                {"bricks", p.bricks},
                {"lights", p.lights},
                {"voxel", p.voxel},
                {"normal_offset", p.normal_offset},
                {"two_sided", p.two_sided},
                {"unit", p.irradiance_max / steps},
                {"scale", p.scale},
                {"shadow_width", p.shadow.width},
                {"shadow_height", p.shadow.height},
                {"u_x", p.shadow.to_x[0]},
                {"u_y", p.shadow.to_x[1]},
                {"u_z", p.shadow.to_x[2]},
                {"u_at", p.shadow.to_x[3]},
                {"v_x", p.shadow.to_y[0]},
                {"v_y", p.shadow.to_y[1]},
                {"v_z", p.shadow.to_y[2]},
                {"v_at", p.shadow.to_y[3]},
                {"w_x", p.shadow.to_depth[0]},
                {"w_y", p.shadow.to_depth[1]},
                {"w_z", p.shadow.to_depth[2]},
                {"w_at", p.shadow.to_depth[3]}},
               {{"COUNT", p.count}, {"TORUS", p.toroidal}, {"SHADOW", p.shadow.width > 0}}, slots);
  // Rays that pass a voxel, and all texels of the shadow map that see one.
  const auto texels_of = [](const std::array<double, 4>& to, int most) {
    return std::min<double>(most, std::fabs(to[0]) + std::fabs(to[1]) + std::fabs(to[2]) + 2);
  };
  planner.rounds(p.lights * (2.0 + p.width + p.height + p.depth) +
                 texels_of(p.shadow.to_y, p.shadow.height) * (texels_of(p.shadow.to_x, p.shadow.width) + 1));
  planner.cost(0, static_cast<double>(p.bricks) * static_cast<double>(brick_voxels * pixel * (3 + p.emission)));
  return std::move(planner).finish();
}

std::vector<float> voxel_lights(const std::vector<VoxelLight>& lights, const std::array<double, 3>& origin,
                                double voxel) {
  std::vector<float> words;
  words.reserve(lights.size() * 12);
  const auto append = [&](std::array<double, 3> v, double scale, double w) {
    for (const double c : v) words.push_back(static_cast<float>(c * scale));
    words.push_back(static_cast<float>(w));
  };
  const auto unit = [](const std::array<double, 3>& v) { return 1 / std::hypot(v[0], v[1], v[2]); };
  for (const VoxelLight& light : lights) {
    const bool sun = light.kind == VoxelLight::Kind::sun;
    std::array<double, 3> place = light.place;
    if (!sun)
      for (int i = 0; i < 3; ++i) place[i] -= origin[i];
    append(place, sun ? unit(place) : 1 / voxel, static_cast<int>(light.kind));
    append(light.power, 1, light.area / (std::numbers::pi * voxel * voxel));
    append(light.normal, unit(light.normal), 0);
  }
  return words;
}

}  // namespace luxel

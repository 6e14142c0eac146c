#include <luxel/probe_irradiance.h>

#include <algorithm>
#include <cmath>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

constexpr int table_floats = 4096;  // of the kernels' table of texels
constexpr int most_samples = 64;    // a quarter of so many squared fills it
constexpr double most_texels = 1 << 28;
constexpr std::size_t most_probes = 65535;  // workgroups along an axis

bool divides(int part, int size) { return part >= 4 && part % 2 == 0 && size % part == 0; }

using Vec = std::array<double, 3>;
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

// Adds int d dw over the spherical triangle of these corners: half the sum over edges of the angle times the unit normal
// (Lambert 1760).
void add_area(Vec& sum, const std::array<Vec, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec turn = cross(b, c);
  const double sign = a[0] * turn[0] + a[1] * turn[1] + a[2] * turn[2] < 0 ? -0.5 : 0.5;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec &p = corners[i], &q = corners[(i + 1) % 3];
    const Vec n = cross(p, q);
    const double size = length(n), angle = std::atan2(size, p[0] * q[0] + p[1] * q[1] + p[2] * q[2]);
    for (std::size_t k = 0; k < 3; ++k) sum[k] += sign * angle * n[k] / size;
  }
}

// The point of the octahedron (not of unit length) at (u, v), both 0..1.
Vec on_octahedron(double u, double v) {
  return u + v <= 1 ? Vec{u, v, 1 - u - v} : Vec{1 - v, 1 - u, 1 - u - v};
}

// Of the texels of the quarter u, v >= 0, row by row: direction and length of int d dw.
std::vector<double> texel_table(int size) {
  const int half = size / 2;
  std::vector<double> table;
  for (int v = 0; v < half; ++v)
    for (int u = 0; u < half; ++u) {
      const auto corner = [&](int i, int j) { return on_octahedron((u + i) / static_cast<double>(half), (v + j) / static_cast<double>(half)); };
      Vec area{};
      // Cut along the diagonal that the equator runs along.
      add_area(area, {corner(0, 0), corner(1, 0), corner(0, 1)});
      add_area(area, {corner(1, 1), corner(1, 0), corner(0, 1)});
      const double size_of = length(area);
      for (const double x : area) table.push_back(x / size_of);
      table.push_back(size_of);
    }
  table.resize(table_floats);
  return table;
}

}  // namespace

int probe_samples(const ProbeIrradianceParams& p) {
  if (p.samples > 0) return p.samples;
  int samples = std::min(p.maps.size, 32);
  while (samples > 4 && !divides(samples, p.maps.size)) --samples;
  return samples;
}

Status validate(const ProbeIrradianceParams& p) {
  LUXEL_CHECK(validate(p.grid));
  const std::size_t probes = probe_count(p.grid);
  LUXEL_CHECK(validate(p.maps, probes));
  if (probes > most_probes)
    return out_of_range("ProbeIrradianceParams.grid.count", probes, "at most 65535 probes");
  LUXEL_CHECK(check_range("ProbeIrradianceParams.listed", p.listed, 0, static_cast<int>(probes)));
  const int samples = probe_samples(p);
  if (samples > most_samples || !divides(samples, p.maps.size))
    return p.samples > 0 ? out_of_range("ProbeIrradianceParams.samples", p.samples, "an even divisor of the maps' size, 4..64")
                         : out_of_range("ProbeIrradianceParams.maps.size", p.maps.size, "a size with an even divisor in 4..32");
  LUXEL_CHECK(check_range("ProbeIrradianceParams.irradiance_size", p.irradiance_size, 0, 128));
  LUXEL_CHECK(check_range("ProbeIrradianceParams.moments_size", p.moments_size, 0, 128));
  for (const auto& [field, size] : {std::pair{"ProbeIrradianceParams.irradiance_size", p.irradiance_size},
                                    {"ProbeIrradianceParams.moments_size", p.moments_size}})
    if (size != 0 && size < 4) return out_of_range(field, size, "0 or 4..128");
  if (p.irradiance_size == 0 && p.moments_size == 0)
    return out_of_range("ProbeIrradianceParams.irradiance_size", 0, "4..128 without moments");
  if (static_cast<double>(probe_map_texels(probes, std::max(p.irradiance_size, p.moments_size))) > most_texels)
    return out_of_range("ProbeIrradianceParams.grid.count", probes, "maps of at most 268435456 texels");
  LUXEL_CHECK(check_range("ProbeIrradianceParams.power", p.power, 1, 256));
  LUXEL_CHECK(check_range("ProbeIrradianceParams.max_distance", p.max_distance, 1e-6, 65504.0));
  LUXEL_CHECK(check_range("ProbeIrradianceParams.hysteresis", p.hysteresis, 0.0, 1.0));
  if (p.irradiance_format != Format::f32x4 && p.irradiance_format != Format::f16x4)
    return out_of_range("ProbeIrradianceParams.irradiance_format", name(p.irradiance_format), "f32x4 or f16x4");
  if (p.moments_format != Format::f32x2 && p.moments_format != Format::f16x2)
    return out_of_range("ProbeIrradianceParams.moments_format", name(p.moments_format), "f32x2 or f16x2");
  return {};
}

Result<Plan> plan(const ProbeIrradianceParams& p, const Profile&) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t probes = probe_count(p.grid), made = p.listed > 0 ? static_cast<std::size_t>(p.listed) : probes;
  const int samples = probe_samples(p);
  const std::size_t reduced = made * static_cast<std::size_t>(samples * samples);
  const double seen = static_cast<double>(made) * p.maps.size * p.maps.size, unit = probe_unit(p.grid);
  const auto resource = [&](const char* name, Format format, std::size_t count, bool written) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    return planner.resource(r);
  };
  using Slots = std::vector<std::pair<std::string_view, Slot>>;
  Slot list{};
  if (p.listed > 0) list = resource("list", Format::u32, made, false);
  const auto with_list = [&](Slots slots) {
    if (p.listed > 0) slots.emplace_back("list", list);
    return slots;
  };
  const std::string listed = p.listed > 0 ? "list_" : "", kept = p.previous ? "previous_" : "";
  const double count = static_cast<double>(made);
  const auto over = [&](int size) {
    return std::array<std::uint32_t, 3>{static_cast<std::uint32_t>(size * size), static_cast<std::uint32_t>(made), 1};
  };
  const std::vector<double> exact = texel_table(samples);
  std::vector<double> rounded;
  for (const double v : exact) rounded.push_back(static_cast<float>(v));
  const Slot table = planner.table(rounded, exact);
  const Planner::Values reduce{{"probes", count}, {"size", p.maps.size}, {"reduced", samples}, {"unit_length", unit},
                               {"farthest", p.max_distance}};
  constexpr std::array<std::uint32_t, 3> line{64, 1, 1};
  const double factor = p.maps.size / samples;

  if (p.irradiance_size > 0) {
    constexpr const char* stored[] = {"f32x4", "f16x4", "r11g11b10"};
    const Slot radiance = resource("radiance", probe_radiance_format(p.maps), probe_radiance_elements(p.maps, probes), false);
    const Slot means = planner.scratch(Format::f32x4, reduced);
    planner.pass("probe_reduce", "radiance_" + listed + stored[static_cast<int>(p.maps.radiance)], "probe_irradiance reduce radiance",
                 over(samples), line, reduce, {}, with_list({{"src", radiance}, {"means", means}}));
    planner.rounds(factor * (factor + 1));
    const std::size_t out = probe_map_texels(probes, p.irradiance_size);
    Slots slots = with_list({{"means", means}, {"texels", table}, {"irradiance", resource("irradiance", p.irradiance_format, out, true)}});
    if (p.previous) slots.emplace_back("previous", resource("previous_irradiance", p.irradiance_format, out, false));
    planner.pass("probe_irradiance", kept + listed + name(p.irradiance_format), "probe_irradiance cosine", over(p.irradiance_size), line,
                 {{"probes", count}, {"reduced", samples}, {"size", p.irradiance_size}, {"keep", p.hysteresis}}, {}, slots);
    planner.cost(12.0 * static_cast<double>(reduced) * p.irradiance_size * p.irradiance_size + 60 * seen,
                 seen * static_cast<double>(bytes_per_pixel(probe_radiance_format(p.maps))) + static_cast<double>(reduced) * 32 +
                     static_cast<double>(out * bytes_per_pixel(p.irradiance_format)));
  }
  if (p.moments_size > 0) {
    const bool half = p.maps.distance == ProbeDistance::f16;
    const Slot distance = resource("distance", probe_distance_format(p.maps), probe_distance_elements(p.maps, probes), false);
    const Slot distances = planner.scratch(Format::f32x2, reduced);
    planner.pass("probe_reduce", "distance_" + listed + (half ? "f16" : "f32"), "probe_irradiance reduce distance", over(samples), line,
                 reduce, {}, with_list({{"src", distance}, {"moments", distances}}));
    planner.rounds(2 * factor * (factor + 1));
    const std::size_t out = probe_map_texels(probes, p.moments_size);
    Slots slots = with_list({{"distances", distances}, {"texels", table}, {"moments", resource("moments", p.moments_format, out, true)}});
    if (p.previous) slots.emplace_back("previous", resource("previous_moments", p.moments_format, out, false));
    // Below this cosine a texel weighs less than 1e-14 of one in the middle.
    planner.pass("probe_moments", kept + listed + name(p.moments_format), "probe_irradiance distances", over(p.moments_size), line,
                 {{"probes", count},
                  {"reduced", samples},
                  {"size", p.moments_size},
                  {"power", p.power},
                  {"least", std::pow(10.0, -14.0 / p.power)},
                  {"keep", p.hysteresis}},
                 {}, slots);
    planner.cost(16.0 * static_cast<double>(reduced) * p.moments_size * p.moments_size + 60 * seen,
                 seen * (half ? 2 : 4) + static_cast<double>(reduced) * 16 + static_cast<double>(out * bytes_per_pixel(p.moments_format)));
  }
  return std::move(planner).finish();
}

}  // namespace luxel

#include <luxel/probe_trace.h>

#include <cmath>

#include "host/check.h"
#include "host/octahedral_march_line.h"

namespace luxel {
namespace {

constexpr int most_steps = 1 << 24;  // whole numbers that a float holds

int log2_of(int ratio) {
  int n = 0;
  while ((1 << n) < ratio) ++n;
  return n;
}

// A piece crosses at most 2 size texels of its triangle of the map, and as many cells above; four pieces a probe.
int steps_needed(const ProbeTraceParams& p) {
  const double a_probe = 4.0 * (2.0 * p.maps.size + 4.0 * p.maps.size / p.maps.ratio + 8);
  const double cages = p.probe >= 0 ? 1 : p.grid.count[0] + p.grid.count[1] + p.grid.count[2];
  return static_cast<int>(std::min<double>(most_steps, a_probe * (p.probe >= 0 ? 1 : p.tries) * cages));
}

}  // namespace

Status validate(const ProbeTraceParams& p) {
  LUXEL_CHECK(validate(p.grid));
  LUXEL_CHECK(validate(p.maps, probe_count(p.grid)));
  LUXEL_CHECK(check_range("ProbeTraceParams.rays", p.rays, 1, 1 << 26));
  LUXEL_CHECK(check_range("ProbeTraceParams.probe", p.probe, -1, static_cast<int>(probe_count(p.grid)) - 1));
  LUXEL_CHECK(check_range("ProbeTraceParams.tries", p.tries, 1, 24));
  LUXEL_CHECK(check_range("ProbeTraceParams.order", static_cast<int>(p.order), 0, 1));
  LUXEL_CHECK(check_range("ProbeTraceParams.max_steps", p.max_steps, 0, most_steps));
  LUXEL_CHECK(check_range("ProbeTraceParams.thickness", p.thickness, 0.125, 64.0));
  LUXEL_CHECK(check_range("ProbeTraceParams.slope", p.slope, 0.0, 64.0));
  return check_range("ProbeTraceParams.bias", p.bias, 0.0, 64.0);
}

Result<Plan> plan(const ProbeTraceParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t probes = probe_count(p.grid), rays = static_cast<std::size_t>(p.rays);
  const Format format = probe_distance_format(p.maps);
  std::vector<std::pair<std::string_view, Slot>> slots;
  const Slot distances = probe_buffer(planner, "distances", format, probe_distance_elements(p.maps, probes), false);
  slots.emplace_back("rays", probe_buffer(planner, "rays", Format::f32x4, 2 * rays, false));
  slots.emplace_back("distances", distances);
  slots.emplace_back("minimum", p.maps.ratio == 1 ? distances
                                                  : probe_buffer(planner, "minimum", format,
                                                                 probe_minimum_elements(p.maps, probes), false));
  std::string module = p.maps.distance == ProbeDistance::f16 ? "f16" : "f32";
  if (p.maps.normal != ProbeNormal::none) {
    module += "_normals";
    slots.emplace_back("normals",
                       probe_buffer(planner, "normals", Format::u32, probe_normal_elements(p.maps, probes), false));
  }
  if (p.grid.placed) {
    module += "_placed";
    slots.emplace_back("positions", probe_buffer(planner, "positions", Format::f32x4, probes, false));
  }
  if (p.count) {
    module += "_count";
    slots.emplace_back("counters", probe_buffer(planner, "counters", Format::u32, probe_outcomes, true));
  }
  slots.emplace_back("hits", probe_buffer(planner, "hits", Format::f32x4, rays, true));
  slots.emplace_back("texels", probe_buffer(planner, "texels", Format::u32, rays, true));
  const ProbeLine line = probe_line(rays, profile);
  planner.pass("probe_trace", module, "probe_trace", line.invocations, line.workgroup,
               {{"rays", p.rays},
                {"stride", line.invocations[0]},
                {"size", p.maps.size},
                {"coarse", log2_of(p.maps.ratio)},
                {"count_x", p.grid.count[0]},
                {"count_y", p.grid.count[1]},
                {"count_z", p.grid.count[2]},
                {"probe", p.probe},
                {"tries", p.tries},
                {"step_cap", p.max_steps > 0 ? p.max_steps : steps_needed(p)},
                {"origin_x", p.grid.origin[0]},
                {"origin_y", p.grid.origin[1]},
                {"origin_z", p.grid.origin[2]},
                {"spacing_x", p.grid.spacing[0]},
                {"spacing_y", p.grid.spacing[1]},
                {"spacing_z", p.grid.spacing[2]},
                {"unit_length", probe_unit(p.grid)},
                {"thickness", p.thickness},
                {"slope", p.slope},
                {"bias", p.bias}},
               {{"ORDER", static_cast<int>(p.order)}, {"BITS", p.maps.normal == ProbeNormal::snorm16 ? 16 : 8},
                {"SPLIT", profile.rows.lanes == 0}}, slots);
  planner.cost(0, static_cast<double>(rays * 52 + (probe_distance_elements(p.maps, probes) +
                                                   probe_minimum_elements(p.maps, probes)) * 4));
  return std::move(planner).finish();
}

Status validate(const ProbeFetchParams& p) {
  LUXEL_CHECK(check_range("ProbeFetchParams.probes", p.probes, 1, 65536));
  LUXEL_CHECK(validate(p.maps, static_cast<std::size_t>(p.probes)));
  LUXEL_CHECK(check_range("ProbeFetchParams.rays", p.rays, 1, 1 << 26));
  for (const double v : p.environment) LUXEL_CHECK(check_range("ProbeFetchParams.environment", v, 0.0, 1e30));
  return {};
}

Result<Plan> plan(const ProbeFetchParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t probes = static_cast<std::size_t>(p.probes), rays = static_cast<std::size_t>(p.rays);
  const Format format = probe_radiance_format(p.maps);
  const std::size_t texels = probe_texels(p.maps, probes);
  const Slot hits = probe_buffer(planner, "hits", Format::f32x4, rays, false);
  const Slot at = probe_buffer(planner, "texels", Format::u32, rays, false);
  const Slot radiance = probe_buffer(planner, "radiance", format, texels, false);
  const Slot seen = probe_buffer(planner, "seen", Format::f32x4, rays, true);
  const char* names[] = {"f32x4", "f16x4", "r11g11b10"};
  const ProbeLine line = probe_line(rays, profile);
  planner.pass("probe_fetch", names[static_cast<int>(p.maps.radiance)], "probe_fetch", line.invocations, line.workgroup,
               {{"rays", p.rays},
                {"texel_count", static_cast<double>(texels)},
                {"stride", line.invocations[0]},
                {"environment_r", p.environment[0]},
                {"environment_g", p.environment[1]},
                {"environment_b", p.environment[2]}},
               {}, {{"hits", hits}, {"texels", at}, {"radiance", radiance}, {"seen", seen}});
  planner.cost(0, static_cast<double>(rays * (36 + bytes_per_pixel(format))));
  return std::move(planner).finish();
}

}  // namespace luxel

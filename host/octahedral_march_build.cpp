#include <cmath>
#include <luxel/octahedral_map.h>
#include <luxel/probe_build.h>

#include "host/check.h"
#include "host/octahedral_march_line.h"

namespace luxel {
namespace {

constexpr Format value_format = Format::f32x4;

// Elements of a source: pixels of all images, or texels.
std::size_t given(const ProbeBuildParams& p) {
  const std::size_t probes = static_cast<std::size_t>(p.probes);
  if (p.source == ProbeSource::texels) return probe_texels(p.maps, probes);
  return probes * (p.source == ProbeSource::cube ? 6 : 1) * static_cast<std::size_t>(p.width) *
         static_cast<std::size_t>(p.height);
}

void minimum_pass(Planner& planner, const ProbeMaps& m, std::size_t probes, Slot distances, const Profile& profile) {
  const Slot to = probe_buffer(planner, "minimum", probe_distance_format(m), probe_minimum_elements(m, probes), true);
  const std::size_t side = static_cast<std::size_t>(m.size / m.ratio), cells = probes * side * side;
  const ProbeLine line = probe_line(probe_minimum_elements(m, probes), profile);
  planner.pass("probe_minimum", m.distance == ProbeDistance::f16 ? "f16" : "f32", "probe_build minimum",
               line.invocations, line.workgroup,
               {{"size", m.size}, {"ratio", m.ratio}, {"cells", static_cast<double>(cells)}, {"stride", line.invocations[0]}},
               {}, {{"distances", distances}, {"minimum", to}});
  planner.rounds(2 * std::ceil(static_cast<double>(cells) / 2 / line.invocations[0]) * m.ratio * (m.ratio + 1.0));
  planner.cost(0, static_cast<double>((probe_distance_elements(m, probes) + probe_minimum_elements(m, probes)) * 4));
}

}  // namespace

Status validate(const ProbeBuildParams& p) {
  LUXEL_CHECK(check_range("ProbeBuildParams.probes", p.probes, 1, 65536));
  LUXEL_CHECK(validate(p.maps, static_cast<std::size_t>(p.probes)));
  LUXEL_CHECK(check_range("ProbeBuildParams.source", static_cast<int>(p.source), 0, 2));
  const bool images = p.source != ProbeSource::texels;
  LUXEL_CHECK(check_range("ProbeBuildParams.width", p.width, images ? 1 : 0, images ? 8192 : 0));
  LUXEL_CHECK(check_range("ProbeBuildParams.height", p.height, images ? 1 : 0, images ? 8192 : 0));
  if (p.source == ProbeSource::cube && p.width != p.height)
    return out_of_range("ProbeBuildParams.height", p.height, "the width: faces of cubes are square");
  if (given(p) > 0x7fffffffu)
    return out_of_range("ProbeBuildParams.width", p.width, "images of at most 2147483647 pixels in all");
  LUXEL_CHECK(check_range("ProbeBuildParams.samples", p.samples, 1, images ? 16 : 1));
  if (p.planar && p.source != ProbeSource::cube)
    return out_of_range("ProbeBuildParams.planar", "true", "false but for cubes");
  LUXEL_CHECK(check_range("ProbeBuildParams.unit", p.unit, 1e-15, 1e15));
  if (!p.radiance && !p.distance && p.maps.normal == ProbeNormal::none)
    return out_of_range("ProbeBuildParams.radiance", "false", "true where neither distance nor normals are made");
  return {};
}

Result<Plan> plan(const ProbeBuildParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t probes = static_cast<std::size_t>(p.probes), texels = probe_texels(p.maps, probes);
  const auto pass = [&](const char* module, const char* label, Slot source, Slot map, std::size_t elements) {
    const ProbeLine line = probe_line(elements, profile);
    planner.pass("probe_build", module, label, line.invocations, line.workgroup,
                 {{"size", p.maps.size},
                  {"texels", static_cast<double>(texels)},
                  {"width", p.width},
                  {"height", p.height},
                  {"samples", p.samples},
                  {"planar", p.planar ? 1 : 0},
                  {"stride", line.invocations[0]},
                  {"per_unit", 1 / p.unit}},
                 {{"SOURCE", static_cast<int>(p.source)}}, {{"source", source}, {"map", map}});
  };
  if (p.radiance) {
    const Format format = probe_radiance_format(p.maps);
    const std::size_t n = probe_radiance_elements(p.maps, probes);
    const Slot from = probe_buffer(planner, "radiance_source", value_format, given(p), false);
    const Slot to = probe_buffer(planner, "radiance", format, n, true);
    const char* names[] = {"radiance_f32x4", "radiance_f16x4", "radiance_r11g11b10"};
    pass(names[static_cast<int>(p.maps.radiance)], "probe_build radiance", from, to, n);
    planner.cost(0, static_cast<double>(given(p) * 16 + n * bytes_per_pixel(format)));
  }
  if (p.distance) {
    const std::size_t n = probe_distance_elements(p.maps, probes);
    const Slot from = probe_buffer(planner, "distance_source", Format::f32x1, given(p), false);
    const Slot to = probe_buffer(planner, "distances", probe_distance_format(p.maps), n, true);
    pass(p.maps.distance == ProbeDistance::f16 ? "distance_f16" : "distance_f32", "probe_build distance", from, to, n);
    planner.cost(0, static_cast<double>(given(p) * 4 + n * 4));
    if (p.maps.ratio > 1) minimum_pass(planner, p.maps, probes, to, profile);
  }
  if (p.maps.normal != ProbeNormal::none) {
    const std::size_t n = probe_normal_elements(p.maps, probes);
    const Slot from = probe_buffer(planner, "normal_source", value_format, given(p), false);
    const Slot to = probe_buffer(planner, "normals", Format::u32, n, true);
    pass(p.maps.normal == ProbeNormal::snorm8 ? "normal_snorm8" : "normal_snorm16", "probe_build normals", from, to, n);
    planner.cost(0, static_cast<double>(given(p) * 16 + n * 4));
  }
  return std::move(planner).finish();
}

Status validate(const ProbeMinimumParams& p) {
  LUXEL_CHECK(check_range("ProbeMinimumParams.probes", p.probes, 1, 65536));
  LUXEL_CHECK(validate(p.maps, static_cast<std::size_t>(p.probes)));
  return check_range("ProbeMaps.ratio", p.maps.ratio, 2, 256);
}

Result<Plan> plan(const ProbeMinimumParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t probes = static_cast<std::size_t>(p.probes);
  const Slot from =
      probe_buffer(planner, "distances", probe_distance_format(p.maps), probe_distance_elements(p.maps, probes), false);
  minimum_pass(planner, p.maps, probes, from, profile);
  return std::move(planner).finish();
}

Status validate(const OctahedralMapParams& p) {
  LUXEL_CHECK(check_range("OctahedralMapParams.count", p.count, 1, 1 << 28));
  return check_range("OctahedralMapParams.code", static_cast<int>(p.code), 0, 2);
}

Result<Plan> plan(const OctahedralMapParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t n = static_cast<std::size_t>(p.count);
  const Slot values = probe_buffer(planner, "values", value_format, n, p.decode);
  const Slot codes = probe_buffer(planner, "codes", Format::u32, n, !p.decode);
  std::vector<std::pair<std::string_view, Slot>> slots{{"values", values}, {"codes", codes}};
  if (!p.decode) slots.emplace_back("places", probe_buffer(planner, "places", value_format, n, true));
  const ProbeLine line = probe_line(n, profile);
  planner.pass("octahedral_map", p.decode ? "decode" : "encode", "octahedral_map", line.invocations, line.workgroup,
               {{"count", p.count}, {"stride", line.invocations[0]}}, {{"CODE", static_cast<int>(p.code)}}, slots);
  planner.cost(static_cast<double>(n) * 30, static_cast<double>(n) * (p.decode ? 20 : 36));
  return std::move(planner).finish();
}

}  // namespace luxel

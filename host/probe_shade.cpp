#include <luxel/probe_shade.h>

#include <algorithm>

#include <luxel/probe_irradiance.h>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

// Of the axes along which there are several probes; of all where there is one probe.
double least_spacing(const ProbeGrid& g) {
  double least = 0;
  for (std::size_t k = 0; k < 3; ++k)
    if (g.count[k] > 1 && (least == 0 || g.spacing[k] < least)) least = g.spacing[k];
  return least > 0 ? least : std::min({g.spacing[0], g.spacing[1], g.spacing[2]});
}

}  // namespace

Status validate(const ProbeShadeParams& p) {
  LUXEL_CHECK(validate(p.grid));
  const std::size_t probes = probe_count(p.grid);
  if (probes > 65535) return out_of_range("ProbeShadeParams.grid.count", probes, "at most 65535 probes");
  LUXEL_CHECK(check_range("ProbeShadeParams.width", p.width, 1, 1 << 20));
  LUXEL_CHECK(check_range("ProbeShadeParams.height", p.height, 1, 65535));
  if (static_cast<double>(p.width) * p.height > 1 << 28)
    return out_of_range("ProbeShadeParams.height", p.height, "width x height of at most 268435456");
  LUXEL_CHECK(check_range("ProbeShadeParams.irradiance_size", p.irradiance_size, 4, 128));
  if (p.visibility) LUXEL_CHECK(check_range("ProbeShadeParams.moments_size", p.moments_size, 4, 128));
  if (static_cast<double>(probe_map_texels(probes, std::max(p.irradiance_size, p.moments_size))) > 1 << 28)
    return out_of_range("ProbeShadeParams.grid.count", probes, "maps of at most 268435456 texels");
  if (p.irradiance_format != Format::f32x4 && p.irradiance_format != Format::f16x4)
    return out_of_range("ProbeShadeParams.irradiance_format", name(p.irradiance_format), "f32x4 or f16x4");
  LUXEL_CHECK(check_range("ProbeShadeParams.sharpen", p.sharpen, 1, 8));
  LUXEL_CHECK(check_range("ProbeShadeParams.least_visibility", p.least_visibility, 1e-6, 1.0));
  LUXEL_CHECK(check_range("ProbeShadeParams.hidden", static_cast<int>(p.hidden), 0, 1));
  LUXEL_CHECK(check_range("ProbeShadeParams.footprint", p.footprint, 0.0, 8.0));
  LUXEL_CHECK(check_range("ProbeShadeParams.facing", static_cast<int>(p.facing), 0, 2));
  LUXEL_CHECK(check_range("ProbeShadeParams.least_facing", p.least_facing, 0.0, 1.0));
  return check_range("ProbeShadeParams.normal_bias", p.normal_bias, 0.0, 1.0);
}

Result<Plan> plan(const ProbeShadeParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("octahedral_march");
  const std::size_t probes = probe_count(p.grid), receivers = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  const bool half = p.irradiance_format == Format::f16x4;
  std::vector<std::pair<std::string_view, Slot>> slots;
  const auto resource = [&](const char* name, Format format, std::size_t count, bool written = false) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    slots.emplace_back(name, planner.resource(r));
    return static_cast<double>(r.bytes);
  };
  double bytes = resource("receivers", Format::f32x4, 2 * receivers);
  bytes += resource("irradiance", Format::f32x4, receivers, true);
  bytes += resource("light", p.irradiance_format, probe_map_texels(probes, p.irradiance_size));
  if (p.visibility) bytes += resource("moments", half ? Format::f16x2 : Format::f32x2, probe_map_texels(probes, p.moments_size));
  if (p.grid.placed) bytes += resource("positions", Format::f32x4, probes);
  if (p.count) resource("counters", Format::u32, probe_shade_outcomes, true);
  std::string module = p.count ? "count_" : profile.texels ? "texels_" : "";
  module += p.visibility ? "visible_" : "plain_";
  module += p.grid.placed ? "placed_" : "";
  module += half ? "f16" : "f32";
  const double unit = probe_unit(p.grid);
  planner.pass("probe_shade", module, "probe_shade", {static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1},
               profile.pixels.workgroup,
               {{"width", p.width},
                {"height", p.height},
                {"count_x", p.grid.count[0]},
                {"count_y", p.grid.count[1]},
                {"count_z", p.grid.count[2]},
                {"origin_x", p.grid.origin[0]},
                {"origin_y", p.grid.origin[1]},
                {"origin_z", p.grid.origin[2]},
                {"spacing_x", p.grid.spacing[0]},
                {"spacing_y", p.grid.spacing[1]},
                {"spacing_z", p.grid.spacing[2]},
                {"per_unit", 1 / unit},
                {"normal_bias", p.normal_bias * least_spacing(p.grid)},
                {"light_size", p.irradiance_size},
                {"moments_size", p.moments_size},
                {"footprint", p.footprint * 2 / p.moments_size},
                {"least", p.least_visibility},
                {"least_facing", p.least_facing}},
               {{"FACING", static_cast<double>(static_cast<int>(p.facing))},
                {"SHARPEN", p.sharpen},
                {"DARK", p.hidden == ProbeHidden::dark ? 1.0 : 0.0}},
               slots);
  planner.cost(static_cast<double>(receivers) * (p.visibility ? 900 : 420), bytes);
  return std::move(planner).finish();
}

}  // namespace luxel

#include <luxel/hiz_ssr.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {
namespace {

constexpr double endless = 1e18;  // a length that the kernel's products stay finite with

bool finite_above(double v, double low) { return v > low && v <= FLT_MAX; }

int looks_needed(const HizSsrParams& p) {
  if (p.variant == SsrVariant::linear) return (p.steps + 1) * (p.refinements + 2);
  // Cells crossed on each level halve; each is entered once from below, and left downwards once.
  return 4 * (p.width + p.height) + 64;
}

Status check_projection(const HizSsrParams& p) {
  if (!(p.near_plane >= 1e-6 && p.near_plane <= 1e9))
    return out_of_range("HizSsrParams.near_plane", p.near_plane, "1e-6..1e9");
  if (p.far_plane != 0 && (p.depth == SsrDepth::linear || !finite_above(p.far_plane, p.near_plane)))
    return out_of_range("HizSsrParams.far_plane", p.far_plane,
                        p.depth == SsrDepth::linear ? "0 for linear depth" : "0 (infinite), or more than near_plane");
  for (const auto& [field, v] : {std::pair{"HizSsrParams.focal_x", p.focal_x}, {"HizSsrParams.focal_y", p.focal_y}})
    if (!(v >= 1e-3 && v <= 1e9)) return out_of_range(field, v, "1e-3..1e9 pixels");
  LUXEL_CHECK(check_range("HizSsrParams.centre_x", p.centre_x, -1e9, 1e9));
  return check_range("HizSsrParams.centre_y", p.centre_y, -1e9, 1e9);
}

}  // namespace

void set_field(HizSsrParams& p, double vertical_field) {
  p.focal_x = p.focal_y = p.height / (2 * std::tan(vertical_field / 2));
  p.centre_x = p.width / 2.0;
  p.centre_y = p.height / 2.0;
}

MipBuildParams hiz_ssr_pyramid(const HizSsrParams& p) {
  MipBuildParams m;
  m.width = p.width;
  m.height = p.height;
  m.variant = p.depth == SsrDepth::reversed ? MipVariant::max : MipVariant::min;
  m.format = Format::f32x1;
  m.sizes = MipSizes::ceil;
  m.levels = std::max(p.levels - 1, 0);
  return m;
}

int hiz_ssr_levels(const HizSsrParams& p) {
  if (p.variant != SsrVariant::hiz || p.levels == 1 || (p.width == 1 && p.height == 1)) return 1;
  return mip_levels(hiz_ssr_pyramid(p)) + 1;
}

std::size_t hiz_ssr_level_offset(const HizSsrParams& p, int level) {
  const MipBuildParams m = hiz_ssr_pyramid(p);
  std::size_t at = 0;
  for (int l = 0; l < level; ++l) {
    const auto e = mip_extent(m, l);
    at += (static_cast<std::size_t>(e[0]) * e[1] + 63) / 64 * 64;
  }
  return at;
}

std::size_t hiz_ssr_depth_texels(const HizSsrParams& p) {
  const int last = hiz_ssr_levels(p) - 1;
  const auto e = mip_extent(hiz_ssr_pyramid(p), last);
  return hiz_ssr_level_offset(p, last) + static_cast<std::size_t>(e[0]) * e[1];
}

Status validate(const HizSsrParams& p) {
  LUXEL_CHECK(check_range("HizSsrParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("HizSsrParams.height", p.height, 1, 65535));
  if (static_cast<double>(p.width) * p.height > 1 << 28)
    return out_of_range("HizSsrParams.height", p.height, "width x height of at most 268435456");
  LUXEL_CHECK(check_range("HizSsrParams.variant", static_cast<int>(p.variant), 0, 2));
  LUXEL_CHECK(check_range("HizSsrParams.depth", static_cast<int>(p.depth), 0, 2));
  LUXEL_CHECK(check_projection(p));
  LUXEL_CHECK(check_range("HizSsrParams.rays", p.rays, 0, 1 << 26));
  const int most = p.width == 1 && p.height == 1 ? 1 : mip_levels(hiz_ssr_pyramid({p.width, p.height})) + 1;
  LUXEL_CHECK(check_range("HizSsrParams.levels", p.levels, 0, most));
  LUXEL_CHECK(check_range("HizSsrParams.start_level", p.start_level, 0, hiz_ssr_levels(p) - 1));
  LUXEL_CHECK(check_range("HizSsrParams.max_steps", p.max_steps, 0, 1 << 24));
  LUXEL_CHECK(check_range("HizSsrParams.steps", p.steps, 1, 65536));
  LUXEL_CHECK(check_range("HizSsrParams.refinements", p.refinements, 0, 24));
  if (!(p.thickness >= 0)) return out_of_range("HizSsrParams.thickness", p.thickness, "0 or more");
  LUXEL_CHECK(check_range("HizSsrParams.max_distance", p.max_distance, 0.0, endless));
  if (p.variant == SsrVariant::linear && p.max_distance == 0)
    return out_of_range("HizSsrParams.max_distance", p.max_distance, "more than 0 for variant linear");
  LUXEL_CHECK(check_range("HizSsrParams.bias", p.bias, 0.0, 64.0));
  LUXEL_CHECK(check_range("HizSsrParams.cutoff", p.cutoff, 0.0, 2.0));
  LUXEL_CHECK(check_range("HizSsrParams.fade_edge", p.fade_edge, 0.0, 0.5));
  LUXEL_CHECK(check_range("HizSsrParams.fade_distance", p.fade_distance, 0.0, 1.0));
  LUXEL_CHECK(check_range("HizSsrParams.fade_thickness", p.fade_thickness, 0.0, 1.0));
  return check_range("HizSsrParams.fade_back", p.fade_back, 0.0, 1.0);
}

Result<Plan> plan(const HizSsrParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("hiz_ssr");
  const std::size_t pixels = static_cast<std::size_t>(p.width) * p.height;
  const std::size_t rays = p.rays > 0 ? static_cast<std::size_t>(p.rays) : pixels;
  const auto list = [&](const char* name, Format format, std::size_t count, bool written) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    return planner.resource(r);
  };
  std::vector<std::pair<std::string_view, Slot>> slots;
  slots.emplace_back("depth", list("depth", Format::f32x1, hiz_ssr_depth_texels(p), false));
  slots.emplace_back("source", p.rays > 0 ? list("rays", Format::f32x4, 2 * rays, false)
                                          : list("normals", Format::f32x4, pixels, false));
  slots.emplace_back("hits", list("hits", Format::f32x4, rays, true));
  slots.emplace_back("paths", list("paths", Format::f32x4, rays, true));
  if (p.count) slots.emplace_back("counters", list("counters", Format::u32, ssr_outcomes, true));

  const double near_w = 1 / p.near_plane, far_w = p.far_plane > 0 ? 1 / p.far_plane : 0;
  std::string module = p.count ? "count_" : profile.texels ? "texels_" : "";
  module += p.rays > 0 ? "rays" : "pixels";
  const auto& block = profile.pixels.workgroup;
  const std::uint32_t line = block[0] * block[1] * block[2];
  using Three = std::array<std::uint32_t, 3>;
  const Three invocations = p.rays > 0 ? Three{static_cast<std::uint32_t>(p.rays), 1, 1}
                                       : Three{static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1};
  planner.pass("hiz_ssr", module, "hiz_ssr rays", invocations, p.rays > 0 || p.height == 1 ? Three{line, 1, 1} : block,
               {{"width", p.width},
                {"height", p.height},
                {"rays", p.rays},
                {"top", hiz_ssr_levels(p) - 1},
                {"first", p.start_level},
                {"step_cap", p.max_steps > 0 ? p.max_steps : looks_needed(p)},
                {"steps", p.steps},
                {"refinements", p.refinements},
                {"focal_x", p.focal_x},
                {"focal_y", p.focal_y},
                {"centre_x", p.centre_x},
                {"centre_y", p.centre_y},
                {"depth_scale", near_w - far_w},
                {"depth_offset", far_w},
                {"nearest", p.near_plane},
                {"reach", p.max_distance > 0 ? p.max_distance : endless},
                {"thickness", std::min(p.thickness, 1e30)},
                {"bias", p.bias},
                {"cutoff", p.cutoff},
                {"fade_edge", p.fade_edge},
                {"fade_distance", p.fade_distance},
                {"fade_thickness", p.fade_thickness},
                {"fade_back", p.fade_back}},
               {{"METHOD", static_cast<int>(p.variant)}, {"DEPTH", static_cast<int>(p.depth)}}, slots);
  planner.cost(0, static_cast<double>(hiz_ssr_depth_texels(p) * 4 + rays * (p.rays > 0 ? 64 : 48)));
  return std::move(planner).finish();
}

}  // namespace luxel

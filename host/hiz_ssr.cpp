#include <luxel/hiz_ssr.h>
#include <luxel/cone_trace.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {
namespace {

constexpr double endless = 1e18;  // a length that the kernel's products stay finite with

bool finite_above(double v, double low) { return v > low && v <= FLT_MAX; }

bool climbs(const HizSsrParams& p) { return p.variant == SsrVariant::hiz || p.variant == SsrVariant::stochastic; }

int looks_needed(const HizSsrParams& p) {
  if (p.variant == SsrVariant::linear) return (p.steps + 1) * (p.refinements + 2);
  // Cells crossed on each level halve; each is entered once from below, and left downwards once.
  return 4 * (p.width + p.height) + 64;
}

std::size_t texels(const MipBuildParams& m, int level) {
  const auto e = mip_extent(m, level);
  return static_cast<std::size_t>(e[0]) * e[1];
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

Status check_shading(const HizSsrParams& p) {
  const bool stochastic = p.variant == SsrVariant::stochastic;
  if (p.rays > 0 && (stochastic || p.shade))
    return out_of_range("HizSsrParams.rays", p.rays, stochastic ? "0 for variant stochastic" : "0 with shade");
  LUXEL_CHECK(check_range("HizSsrParams.rays_per_pixel", p.rays_per_pixel, 1, stochastic ? 4 : 1));
  if (p.half_resolution && !stochastic)
    return out_of_range("HizSsrParams.half_resolution", "true", "false but for variant stochastic");
  LUXEL_CHECK(check_range("HizSsrParams.reuse", p.reuse, 0, 4));
  LUXEL_CHECK(check_range("HizSsrParams.seed", p.seed, 0, 0xffffff));
  const int most = p.width == 1 && p.height == 1 ? 1 : mip_levels(hiz_ssr_colours({p.width, p.height})) + 1;
  LUXEL_CHECK(check_range("HizSsrParams.colour_levels", p.colour_levels, 0, most));
  LUXEL_CHECK(check_range("HizSsrParams.prefilter", p.prefilter, 0.0, 16.0));
  for (const double v : p.environment) LUXEL_CHECK(check_range("HizSsrParams.environment", v, 0.0, 1e30));
  if (!p.shade && (p.fallback || p.factor))
    return out_of_range(p.fallback ? "HizSsrParams.fallback" : "HizSsrParams.factor", "true", "false without shade");
  return check_range("HizSsrParams.split_sum_size", p.split_sum_size, 2, 1024);
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
  if (!climbs(p) || p.levels == 1 || (p.width == 1 && p.height == 1)) return 1;
  return mip_levels(hiz_ssr_pyramid(p)) + 1;
}

MipBuildParams hiz_ssr_colours(const HizSsrParams& p) {
  MipBuildParams m;
  m.width = p.width;
  m.height = p.height;
  m.variant = MipVariant::isotropic;
  m.format = Format::f32x4;
  m.levels = std::max(p.colour_levels - 1, 0);
  return m;
}

int hiz_ssr_colour_levels(const HizSsrParams& p) {
  if (p.colour_levels == 1 || (p.width == 1 && p.height == 1)) return 1;
  return mip_levels(hiz_ssr_colours(p)) + 1;
}

namespace {

// Each level begins at a multiple of 64 texels.
std::size_t texels_before(const MipBuildParams& m, int level) {
  std::size_t at = 0;
  for (int l = 0; l < level; ++l) at += (texels(m, l) + 63) / 64 * 64;
  return at;
}

}  // namespace

std::size_t hiz_ssr_level_offset(const HizSsrParams& p, int level) { return texels_before(hiz_ssr_pyramid(p), level); }
std::size_t hiz_ssr_colour_offset(const HizSsrParams& p, int level) { return texels_before(hiz_ssr_colours(p), level); }

std::size_t hiz_ssr_depth_texels(const HizSsrParams& p) {
  const int last = hiz_ssr_levels(p) - 1;
  return hiz_ssr_level_offset(p, last) + texels(hiz_ssr_pyramid(p), last);
}

std::size_t hiz_ssr_colour_texels(const HizSsrParams& p) {
  const int last = hiz_ssr_colour_levels(p) - 1;
  return hiz_ssr_colour_offset(p, last) + texels(hiz_ssr_colours(p), last);
}

std::size_t hiz_ssr_rays(const HizSsrParams& p) {
  if (p.rays > 0) return static_cast<std::size_t>(p.rays);
  const int scale = p.half_resolution ? 2 : 1, each = p.variant == SsrVariant::stochastic ? p.rays_per_pixel : 1;
  return static_cast<std::size_t>((p.width + scale - 1) / scale) * ((p.height + scale - 1) / scale) * each;
}

Status validate(const HizSsrParams& p) {
  LUXEL_CHECK(check_range("HizSsrParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("HizSsrParams.height", p.height, 1, 65535));
  if (static_cast<double>(p.width) * p.height > 1 << 28)
    return out_of_range("HizSsrParams.height", p.height, "width x height of at most 268435456");
  LUXEL_CHECK(check_range("HizSsrParams.variant", static_cast<int>(p.variant), 0, 3));
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
  LUXEL_CHECK(check_range("HizSsrParams.fade_back", p.fade_back, 0.0, 1.0));
  return check_shading(p);
}

namespace {

constexpr int tile = 8;               // traced pixels along a side (kernels/hiz_ssr)
constexpr int spreads = 65;           // entries of the table over roughness 0..1
constexpr int span = 256;             // tiles that an invocation counts (kernels/hiz_ssr)
constexpr std::uint32_t most_invocations = 1u << 20;  // of a launch that strides over a list
constexpr std::uint32_t most_of_few_rounds = 1u << 23;  // the same where an invocation's loops may not run long (Pass::rounds)

class Reflecting {
 public:
  Reflecting(const HizSsrParams& params, const Profile& profile)
      : p_(params), profile_(profile), planner_("hiz_ssr"), pixels_(static_cast<std::size_t>(p_.width) * p_.height) {
    const auto& block = profile_.pixels.workgroup;
    line_ = {block[0] * block[1] * block[2], 1, 1};
    depth_ = list("depth", Format::f32x1, hiz_ssr_depth_texels(p_), false);
    source_ = p_.rays > 0 ? list("rays", Format::f32x4, 2 * hiz_ssr_rays(p_), false)
                          : list("normals", Format::f32x4, pixels_, false);
    hits_ = list("hits", Format::f32x4, hiz_ssr_rays(p_), true);
    paths_ = list("paths", Format::f32x4, hiz_ssr_rays(p_), true);
    if (stochastic()) directions_ = list("directions", Format::f32x4, hiz_ssr_rays(p_), true);
    if (p_.count) counters_ = list("counters", Format::u32, ssr_outcomes, true);
    if (p_.shade) radiance_ = list("radiance", Format::f32x4, pixels_, true);
    const double near_w = 1 / p_.near_plane, far_w = p_.far_plane > 0 ? 1 / p_.far_plane : 0;
    scale_ = near_w - far_w;
    offset_ = far_w;
  }

  Result<Plan> plan() && {
    if (p_.rays == 0) classify();
    trace();
    if (p_.shade) resolve();
    return std::move(planner_).finish();
  }

 private:
  using Slots = std::vector<std::pair<std::string_view, Slot>>;
  using Three = std::array<std::uint32_t, 3>;

  bool stochastic() const { return p_.variant == SsrVariant::stochastic; }
  int scale() const { return p_.half_resolution ? 2 : 1; }
  int each() const { return stochastic() ? p_.rays_per_pixel : 1; }
  std::uint32_t rays_a_tile() const { return static_cast<std::uint32_t>(tile * tile * each()); }
  std::uint32_t pixels_a_tile() const { return static_cast<std::uint32_t>(tile * tile * scale() * scale()); }
  int depth() const { return static_cast<int>(p_.depth); }
  static std::uint32_t parts(int n, int size) { return static_cast<std::uint32_t>((n + size - 1) / size); }

  Slot list(const char* name, Format format, std::size_t count, bool written) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    return planner_.resource(r);
  }

  // Invocations for `count` pieces of work, whole workgroups, and how far apart those of one invocation are.
  Three strided(std::size_t count) const {
    const std::uint32_t allowed = profile_.name == "lavapipe" ? most_of_few_rounds : most_invocations;
    const std::uint32_t most = std::max(allowed / line_[0], 1u) * line_[0];
    const std::uint32_t whole = static_cast<std::uint32_t>(std::min<std::size_t>((count + line_[0] - 1) / line_[0] * line_[0], most));
    return {whole, 1, 1};
  }

  void classify() {
    const int side = tile * scale();
    const std::uint32_t x = parts(p_.width, side), y = parts(p_.height, side);
    tiles_ = static_cast<std::size_t>(x) * y;
    const Slot flags = planner_.scratch(Format::u32, tiles_);
    list_ = planner_.scratch(Format::u32, tiles_ + 1);
    counts_ = planner_.scratch(Format::u32, 6);
    Slots slots{{"depth", depth_}, {"normals", source_}, {"flags", flags}, {"hits", hits_}, {"paths", paths_}};
    if (p_.shade) slots.emplace_back("radiance", radiance_);
    planner_.pass("hiz_ssr_tiles", p_.shade ? "shaded" : "hits", "hiz_ssr tiles", {x, y, 1}, {8, 4, 1},
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"scale", scale()},
                   {"each", each()},
                   {"depth_scale", scale_},
                   {"depth_offset", offset_},
                   {"cutoff", p_.cutoff}},
                  {{"DEPTH", depth()}}, slots);
    const std::uint32_t spans = parts(static_cast<int>(tiles_), span);
    const Slot sums = planner_.scratch(Format::u32, spans);
    planner_.pass("hiz_ssr_spans", "u32", "hiz_ssr count tiles", {spans, 1, 1}, {8, 1, 1}, {{"tiles", static_cast<double>(tiles_)}}, {},
                  {{"flags", flags}, {"sums", sums}});
    planner_.pass("hiz_ssr_list", "u32", "hiz_ssr list of tiles", {spans, 1, 1}, {8, 1, 1},
                  {{"tiles", static_cast<double>(tiles_)},
                   {"rays", rays_a_tile()},
                   {"pixels", pixels_a_tile()},
                   {"workgroup", line_[0]},
                   {"most_rays", strided(tiles_ * rays_a_tile())[0] / line_[0]},
                   {"most_pixels", strided(tiles_ * pixels_a_tile())[0] / line_[0]}},
                  {}, {{"flags", flags}, {"sums", sums}, {"tile_list", list_}, {"counts", counts_}});
    planner_.rounds(spans + span);
    planner_.cost(0, static_cast<double>(pixels_) * 20);
  }

  void trace() {
    Slots slots{{"depth", depth_}, {"source", source_}, {"hits", hits_}, {"paths", paths_}};
    if (p_.count) slots.emplace_back("counters", counters_);
    if (p_.rays == 0) slots.emplace_back("tile_list", list_);
    if (stochastic()) slots.emplace_back("directions", directions_);
    std::string module = p_.count ? "count_" : profile_.texels ? "texels_" : "";
    module += p_.rays > 0 ? "rays" : stochastic() ? "stochastic" : "pixels";
    const Three invocations = p_.rays > 0 ? Three{static_cast<std::uint32_t>(p_.rays), 1, 1}
                                          : strided(tiles_ * rays_a_tile());
    planner_.pass("hiz_ssr", module, "hiz_ssr rays", invocations, line_,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"rays", p_.rays},
                   {"each", each()},
                   {"scale", scale()},
                   {"seed", p_.seed},
                   {"stride", invocations[0]},
                   {"top", hiz_ssr_levels(p_) - 1},
                   {"first", p_.start_level},
                   {"step_cap", p_.max_steps > 0 ? p_.max_steps : looks_needed(p_)},
                   {"steps", p_.steps},
                   {"refinements", p_.refinements},
                   {"focal_x", p_.focal_x},
                   {"focal_y", p_.focal_y},
                   {"centre_x", p_.centre_x},
                   {"centre_y", p_.centre_y},
                   {"depth_scale", scale_},
                   {"depth_offset", offset_},
                   {"nearest", p_.near_plane},
                   {"reach", p_.max_distance > 0 ? p_.max_distance : endless},
                   {"thickness", std::min(p_.thickness, 1e30)},
                   {"bias", p_.bias},
                   {"cutoff", p_.cutoff},
                   {"fade_edge", p_.fade_edge},
                   {"fade_distance", p_.fade_distance},
                   {"fade_thickness", p_.fade_thickness},
                   {"fade_back", p_.fade_back}},
                  {{"METHOD", stochastic() ? 0 : static_cast<int>(p_.variant)}, {"DEPTH", depth()}}, slots);
    if (p_.rays == 0) planner_.counts(counts_);
    const double looks = p_.max_steps > 0 ? std::min(p_.max_steps, looks_needed(p_)) : looks_needed(p_);
    planner_.rounds((looks + 32.0) * (p_.rays > 0 ? 1.0 : std::ceil(static_cast<double>(tiles_ * rays_a_tile()) / invocations[0])));
    planner_.cost(0, static_cast<double>(hiz_ssr_depth_texels(p_) * 4 + hiz_ssr_rays(p_) * 48));
  }

  void resolve() {
    const Slot colour = list("colour", Format::f32x4, hiz_ssr_colour_texels(p_), false);
    Slots slots{{"depth", depth_}, {"normals", source_}, {"tile_list", list_}, {"hits", hits_},
                {"paths", paths_}, {"colour", colour},   {"radiance", radiance_}};
    if (stochastic()) {
      slots.emplace_back("directions", directions_);
    } else {
      std::vector<double> exact, rounded;
      for (int i = 0; i < spreads; ++i) exact.push_back(2 * std::tan(specular_aperture(i / (spreads - 1.0)) / 2));
      for (const double v : exact) rounded.push_back(static_cast<float>(v));
      slots.emplace_back("spreads", planner_.table(rounded, exact));
    }
    if (p_.fallback) slots.emplace_back("fallback", list("fallback", Format::f32x4, pixels_, false));
    if (p_.factor) {
      slots.emplace_back("specular", list("specular", Format::f32x4, pixels_, false));
      slots.emplace_back("split_sum",
                         list("split_sum", Format::f32x2, static_cast<std::size_t>(p_.split_sum_size) * p_.split_sum_size, false));
    }
    std::string module = stochastic() ? "stochastic" : "mirror";
    if (p_.fallback) module += "_fallback";
    if (p_.factor) module += "_factor";
    const Three invocations = strided(tiles_ * pixels_a_tile());
    planner_.pass("hiz_ssr_resolve", module, "hiz_ssr resolve", invocations, line_,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"each", each()},
                   {"scale", scale()},
                   {"reuse", stochastic() ? p_.reuse : 0},
                   {"stride", invocations[0]},
                   {"top", hiz_ssr_colour_levels(p_) - 1},
                   {"table_size", p_.split_sum_size},
                   {"focal_x", p_.focal_x},
                   {"focal_y", p_.focal_y},
                   {"centre_x", p_.centre_x},
                   {"centre_y", p_.centre_y},
                   {"depth_scale", scale_},
                   {"depth_offset", offset_},
                   {"cutoff", p_.cutoff},
                   {"prefilter", p_.prefilter},
                   {"environment_r", p_.environment[0]},
                   {"environment_g", p_.environment[1]},
                   {"environment_b", p_.environment[2]}},
                  {{"DEPTH", depth()}}, slots);
    planner_.counts(counts_, 3);
    planner_.cost(0, static_cast<double>(hiz_ssr_colour_texels(p_) * 16 + pixels_ * 36 + hiz_ssr_rays(p_) * 32));
  }

  const HizSsrParams& p_;
  const Profile& profile_;
  Planner planner_;
  const std::size_t pixels_;
  std::size_t tiles_ = 0;
  double scale_ = 0, offset_ = 0;
  Three line_{};
  Slot depth_, source_, hits_, paths_, directions_, counters_, radiance_, list_, counts_;
};

}  // namespace

Result<Plan> plan(const HizSsrParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  return Reflecting(p, profile).plan();
}

Status validate(const SplitSumParams& p) {
  LUXEL_CHECK(check_range("SplitSumParams.size", p.size, 2, 1024));
  return check_range("SplitSumParams.samples", p.samples, 1, 65536);
}

Result<Plan> plan(const SplitSumParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("hiz_ssr");
  Resource table{"split_sum"};
  table.format = Format::f32x2;
  table.bytes = static_cast<std::size_t>(p.size) * p.size * 8;
  table.written = true;
  const Slot to = planner.resource(table);
  const std::uint32_t n = static_cast<std::uint32_t>(p.size);
  planner.pass("hiz_ssr_split_sum", "f32x2", "hiz_ssr split sum", {n, n, 1}, profile.pixels.workgroup,
               {{"size", p.size}, {"samples", p.samples}}, {}, {{"split_sum", to}});
  planner.rounds(p.samples * (3.0 + std::bit_width(static_cast<unsigned>(p.samples))));  // each looks at its number digit by digit
  planner.cost(static_cast<double>(p.size) * p.size * p.samples * 110, static_cast<double>(table.bytes));
  return std::move(planner).finish();
}

}  // namespace luxel

#include "host/bilateral_plans.h"

#include <algorithm>
#include <cmath>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {
namespace {

struct Grid {
  int cell, columns, rows, bins;
};

Grid grid_of(const BilateralParams& p) {
  const int cell = std::max(1, static_cast<int>(std::lround(p.sigma_space)));
  // The last cell begins at most half a cell before the last pixel.
  return {cell, (p.width - 1 + cell / 2) / cell + 2, (p.height - 1 + cell / 2) / cell + 2,
          static_cast<int>(std::ceil((p.high - p.low) / p.sigma_range)) + 1};
}

std::array<std::uint32_t, 3> over(int x, int y, int z = 1) {
  return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)};
}

struct Images {
  int src_stride, dst_stride;
  Slot src, dst;
};

Images add_images(Planner& planner, const BilateralParams& p) {
  Images m{p.src_stride ? p.src_stride : p.width, p.dst_stride ? p.dst_stride : p.width, {}, {}};
  Resource src{"src"}, dst{"dst"};
  src.format = dst.format = p.format;
  src.bytes = (static_cast<std::size_t>(p.height - 1) * m.src_stride + p.width) * bytes_per_pixel(p.format);
  dst.bytes = (static_cast<std::size_t>(p.height - 1) * m.dst_stride + p.width) * bytes_per_pixel(p.format);
  dst.written = true;
  m.src = planner.resource(src);
  m.dst = planner.resource(dst);
  return m;
}

}  // namespace

Status validate_grid(const BilateralParams& p) {
  LUXEL_CHECK(check_range("BilateralParams.sigma_space of variant grid", p.sigma_space, 1.0, 1024.0));
  LUXEL_CHECK(check_range("BilateralParams.low", p.low, -1e30, 1e30));
  LUXEL_CHECK(check_range("BilateralParams.high", p.high, p.low, 1e30));
  if (!(p.sigma_range > 0) || !((p.high - p.low) / p.sigma_range <= 256))
    return out_of_range("BilateralParams.sigma_range of variant grid", p.sigma_range, "(high - low) / 256 or more");
  const Grid g = grid_of(p);
  const double cells = static_cast<double>(g.columns) * g.rows * g.bins;
  if (cells > 1 << 26)
    return out_of_range("BilateralParams.sigma_range of variant grid", p.sigma_range,
                        "a grid of at most 67108864 cells");
  return {};
}

Status validate_terms(const BilateralParams& p) {
  const bool grid = p.variant == BilateralVariant::grid;
  const std::string where = grid ? " for variant grid" : " for variant discontinuity";
  if (grid && p.range != RangeTerm::self)
    return out_of_range("BilateralParams.range", p.range == RangeTerm::off ? "off" : "guide", "self" + where);
  if (!grid && p.range != RangeTerm::off)
    return out_of_range("BilateralParams.range", p.range == RangeTerm::self ? "self" : "guide", "off" + where);
  if (p.depth != DepthTerm::off)
    return out_of_range("BilateralParams.depth", p.depth == DepthTerm::plane ? "plane" : "svgf", "off" + where);
  if (p.normal) return out_of_range("BilateralParams.normal", "true", "false" + where);
  if (p.luminance) return out_of_range("BilateralParams.luminance", "true", "false" + where);
  if (p.count) return out_of_range("BilateralParams.count", "true", "false" + where);
  if (grid && p.alpha) return out_of_range("BilateralParams.alpha", "true", "false" + where);
  if (!grid && p.step != 1) return out_of_range("BilateralParams.step", p.step, "1" + where);
  if (p.border != Border::clamp) {
    const char* const names[] = {"clamp", "mirror", "wrap", "zero"};
    return out_of_range("BilateralParams.border", names[static_cast<int>(p.border)],
                        "clamp" + where + ", which takes nothing from outside");
  }
  return {};
}

Result<Plan> plan_grid(const BilateralParams& p, const Profile& profile) {
  const Grid g = grid_of(p);
  const std::size_t cells = static_cast<std::size_t>(g.columns) * g.rows * g.bins;
  const double pixels = static_cast<double>(p.width) * p.height, per_step = 1 / p.sigma_range;
  Planner planner("bilateral");
  const Images m = add_images(planner, p);
  Slot a = planner.scratch(Format::f32x4, cells), b = planner.scratch(Format::f32x4, cells);
  const std::array<std::uint32_t, 3> workgroup = profile.pixels.workgroup;
  planner.pass("bilateral_grid_fill", name(p.format), "bilateral grid fill", over(g.columns, g.rows), {16, 4, 1},
               {{"width", p.width},
                {"height", p.height},
                {"src_stride", m.src_stride},
                {"columns", g.columns},
                {"rows", g.rows},
                {"bins", g.bins},
                {"cell", g.cell},
                {"low", p.low},
                {"per_step", per_step}},
               {}, {{"src", m.src}, {"grid", a}});
  planner.rounds(g.bins + g.cell * (g.cell + 1.0));
  planner.cost(10 * pixels, pixels * bytes_per_pixel(p.format) + 16.0 * cells);
  for (int axis = 0; axis < 3; ++axis) {
    planner.pass("bilateral_grid_blur", "f32x4", "bilateral grid blur", over(g.columns, g.rows, g.bins), {16, 4, 1},
                 {{"columns", g.columns}, {"rows", g.rows}, {"bins", g.bins}}, {{"AXIS", axis}},
                 {{"from", a}, {"to", b}});
    planner.cost(28.0 * cells, 32.0 * cells);
    std::swap(a, b);
  }
  planner.pass("bilateral_grid_slice", name(p.format), "bilateral grid slice", over(p.width, p.height), workgroup,
               {{"width", p.width},
                {"height", p.height},
                {"src_stride", m.src_stride},
                {"dst_stride", m.dst_stride},
                {"columns", g.columns},
                {"rows", g.rows},
                {"bins", g.bins},
                {"cell", g.cell},
                {"low", p.low},
                {"per_step", per_step}},
               {}, {{"src", m.src}, {"grid", a}, {"dst", m.dst}});
  planner.cost(100 * pixels, 2 * pixels * bytes_per_pixel(p.format) + 16.0 * cells);
  return std::move(planner).finish();
}

Result<Plan> plan_discontinuity(const BilateralParams& p, const Profile& profile) {
  const int taps = effective_taps(p), n = channels(p.format);
  const Format middle_format = n == 1 ? Format::f32x1 : n == 2 ? Format::f32x2 : Format::f32x4;
  const std::string own = name(p.format), middle_name = name(middle_format);
  Planner planner("bilateral");
  const Images m = add_images(planner, p);
  Resource mask{"mask"};
  mask.format = Format::u32;
  mask.bytes = static_cast<std::size_t>(p.width) * p.height * 4;
  const Slot edges = planner.resource(mask);
  const Slot middle = planner.scratch(middle_format, static_cast<std::size_t>(p.width) * p.height);
  std::vector<double> weights{1};
  for (int t = 1; t <= taps; ++t) weights.push_back(std::exp(-0.5 * (t / p.sigma_space) * (t / p.sigma_space)));
  const Slot table = planner.table(weights, weights);
  const bool same = p.format == middle_format;
  const auto pass = [&](int axis, const std::string& module, Slot from, int src_stride, Slot to, int dst_stride) {
    planner.pass("bilateral_discontinuity", module, "bilateral discontinuity", over(p.width, p.height),
                 profile.pixels.workgroup,
                 {{"width", p.width}, {"height", p.height}, {"src_stride", src_stride}, {"dst_stride", dst_stride}},
                 {{"RADIUS", taps}, {"AXIS", axis}, {"ALPHA", p.alpha}},
                 {{"src", from}, {"mask", edges}, {"dst", to}, {"weights", table}});
    planner.cost(
        static_cast<double>(p.width) * p.height * 2 * taps * (3 * n + 1),
        static_cast<double>(p.width) * p.height * (4.0 + bytes_per_pixel(p.format) + bytes_per_pixel(middle_format)));
  };
  pass(0, same ? own : own + "_" + middle_name, m.src, m.src_stride, middle, p.width);
  pass(1, same ? own : middle_name + "_" + own, middle, p.width, m.dst, m.dst_stride);
  return std::move(planner).finish();
}

Status validate(const BilateralUpsampleParams& p) {
  LUXEL_CHECK(check_range("BilateralUpsampleParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("BilateralUpsampleParams.height", p.height, 1, 65535));
  if (p.ratio != 2 && p.ratio != 4) return out_of_range("BilateralUpsampleParams.ratio", p.ratio, "2 or 4");
  LUXEL_CHECK(check_range("BilateralUpsampleParams.sigma_depth", p.sigma_depth, 1e-6, 1e6));
  LUXEL_CHECK(check_range("BilateralUpsampleParams.footprint", p.footprint, 1e-9, 1e3));
  if (p.normal) LUXEL_CHECK(check_range("BilateralUpsampleParams.sigma_normal", p.sigma_normal, 0.01, 4096.0));
  LUXEL_CHECK(check_range("BilateralUpsampleParams.least", p.least, 1e-12, 1.0));
  if (p.format != Format::f32x1 && p.format != Format::f32x4 && p.format != Format::f16x4)
    return out_of_range("BilateralUpsampleParams.format", name(p.format), "f32x1, f32x4 or f16x4");
  if (static_cast<long long>(p.width) * p.height > 0x1fffffffLL)
    return out_of_range("BilateralUpsampleParams.height", p.height, "width x height of at most 536870911");
  return {};
}

Result<Plan> plan(const BilateralUpsampleParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const int low_width = (p.width + p.ratio - 1) / p.ratio, low_height = (p.height + p.ratio - 1) / p.ratio;
  const std::size_t all = static_cast<std::size_t>(p.width) * p.height,
                    low = static_cast<std::size_t>(low_width) * low_height;
  Planner planner("bilateral_upsample");
  const auto resource = [&](const char* name, Format format, std::size_t count, bool written = false) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    return planner.resource(r);
  };
  const Slot src = resource("src", p.format, low), depth_low = resource("depth_low", Format::f32x1, low);
  const Slot depth = resource("depth", Format::f32x1, all), dst = resource("dst", p.format, all, true);
  const Slot normals_low = p.normal ? resource("normals_low", Format::f32x4, low) : depth_low;
  const Slot normals = p.normal ? resource("normals", Format::f32x4, all) : depth;
  planner.pass("bilateral_upsample", (p.normal ? "normal_" : "") + std::string(name(p.format)), "bilateral upsample",
               over(p.width, p.height), profile.pixels.workgroup,
               {{"width", p.width},
                {"height", p.height},
                {"low_width", low_width},
                {"low_height", low_height},
                {"depth_scale", p.sigma_depth * p.footprint},
                {"normal_power", p.sigma_normal},
                {"least", p.least}},
               {{"RATIO", p.ratio}, {"NEAREST", p.nearest_depth}},
               {{"src", src},
                {"depth_low", depth_low},
                {"depth", depth},
                {"normals_low", normals_low},
                {"normals", normals},
                {"dst", dst}});
  const double pixels = static_cast<double>(all);
  planner.cost(pixels * (p.normal ? 260 : 160),
               static_cast<double>(low * (bytes_per_pixel(p.format) + 4)) + pixels * (4.0 + bytes_per_pixel(p.format)));
  return std::move(planner).finish();
}

}  // namespace luxel

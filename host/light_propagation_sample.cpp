#include <algorithm>
#include <cmath>

#include <luxel/lpv_sample.h>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

constexpr std::uint32_t strided = 65536;  // invocations of passes that stride over their work
constexpr std::size_t table_size = 24;    // eight values a cascade

std::size_t apart(const LpvSampleParams& p) {
  return (lpv_pixels(p.grids[0], p.bands, p.channels) + 63) / 64 * 64;
}

Status check_format(const char* field, Format format) {
  if (format == Format::f32x4 || format == Format::f16x4) return {};
  return out_of_range(field, name(format), "f32x4 or f16x4");
}

Status check_grids(const LpvSampleParams& p) {
  LUXEL_CHECK(check_range("LpvSampleParams.grids.size()", static_cast<int>(p.grids.size()), 1, 3));
  for (std::size_t k = 0; k < p.grids.size(); ++k) {
    const LpvGrid& g = p.grids[k];
    const std::string base = "LpvSampleParams.grids[" + std::to_string(k) + "].";
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string axis = "[" + std::to_string(a) + "]";
      LUXEL_CHECK(check_range((base + "extent" + axis).c_str(), g.extent[a], 1, 1024));
      if (g.extent[a] != p.grids[0].extent[a])
        return out_of_range((base + "extent" + axis).c_str(), g.extent[a], "that of the first cascade");
      LUXEL_CHECK(check_range((base + "origin" + axis).c_str(), g.origin[a], -1e30, 1e30));
    }
    LUXEL_CHECK(check_range((base + "cell").c_str(), g.cell, 1e-15, 1e15));
    if (k == 0) continue;
    const LpvGrid& finer = p.grids[k - 1];
    const double slack = 1e-6 * g.cell;
    for (std::size_t a = 0; a < 3; ++a)
      if (finer.origin[a] < g.origin[a] - slack ||
          finer.origin[a] + finer.cell * finer.extent[a] > g.origin[a] + g.cell * g.extent[a] + slack)
        return out_of_range((base + "cell").c_str(), g.cell, "a grid that holds the cascade before it");
  }
  return {};
}

}  // namespace

Status validate(const LpvSampleParams& p) {
  LUXEL_CHECK(check_grids(p));
  LUXEL_CHECK(check_range("LpvSampleParams.receivers", p.receivers, 1, 1 << 24));
  LUXEL_CHECK(check_range("LpvSampleParams.bands", p.bands, 2, 3));
  if (p.channels != 1 && p.channels != 3) return out_of_range("LpvSampleParams.channels", p.channels, "1 or 3");
  LUXEL_CHECK(check_format("LpvSampleParams.format", p.format));
  LUXEL_CHECK(check_range("LpvSampleParams.offset", p.offset, -4.0, 4.0));
  LUXEL_CHECK(check_range("LpvSampleParams.damping", p.damping, 0.0, 1.0));
  const auto& e = p.grids[0].extent;
  if (p.grids.size() > 1)
    LUXEL_CHECK(check_range("LpvSampleParams.blend", p.blend, 0.125, std::max({e[0], e[1], e[2], 2}) / 2.0));
  LUXEL_CHECK(check_range("LpvSampleParams.gain", p.gain, 1e-30, 1e30));
  LUXEL_CHECK(check_range("LpvSampleParams.glossy_steps", p.glossy_steps, 0, 64));
  if (static_cast<double>(apart(p)) * static_cast<double>(p.grids.size()) > 0x7fffffff)
    return out_of_range("LpvSampleParams.grids[0].extent[2]", e[2], "cascades of at most 2147483647 pixels");
  return {};
}

std::size_t lpv_sample_offset(const LpvSampleParams& p, int cascade) {
  return apart(p) * static_cast<std::size_t>(cascade);
}

Result<Plan> plan(const LpvSampleParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  Planner planner("light_propagation");
  const auto resource = [&](const char* name, Format f, std::size_t count, bool written = false) {
    Resource r{name};
    r.format = f;
    r.bytes = count * bytes_per_pixel(f);
    r.written = written;
    return planner.resource(r);
  };
  const std::size_t receivers = static_cast<std::size_t>(p.receivers), cascades = p.grids.size();
  const bool glossy = p.glossy_steps > 0;
  const Slot light = resource("light", p.format, apart(p) * cascades);
  const Slot places = resource("receivers", Format::f32x4, receivers * 2);
  const Slot views = glossy ? resource("views", Format::f32x4, receivers) : places;  // never read without glossy
  const Slot irradiance = resource("irradiance", Format::f32x4, receivers, true);
  const Slot specular = glossy ? resource("specular", Format::f32x4, receivers, true) : planner.scratch(Format::f32x4, 1);
  const Slot outcomes = p.count ? resource("outcomes", Format::u32, 8, true) : planner.scratch(Format::u32, 8);
  std::vector<double> table(table_size, 0.0);
  for (std::size_t k = 0; k < cascades; ++k) {
    const LpvGrid& g = p.grids[k];
    for (std::size_t a = 0; a < 3; ++a) table[8 * k + a] = g.origin[a];
    table[8 * k + 3] = 1 / g.cell;
    table[8 * k + 4] = p.gain / (p.per_area ? 1 : g.cell * g.cell);
  }
  const std::vector<double> exact = table;
  for (double& v : table) v = static_cast<float>(v);
  if (p.count)
    planner.pass("lpv_zero", "u32", "lpv_sample clear", {8, 1, 1}, {8, 1, 1}, {{"count", 8}, {"stride", 8}}, {},
                 {{"words", outcomes}});
  const auto& e = p.grids[0].extent;
  planner.pass("lpv_sample", std::string(profile.texels ? "texels_" : "") + name(p.format), "lpv_sample",
               {static_cast<std::uint32_t>(p.receivers), 1, 1}, {64, 1, 1},
               {{"width", e[0]},
                {"height", e[1]},
                {"depth", e[2]},
                {"cascades", static_cast<double>(cascades)},
                {"receivers", p.receivers},
                {"channels", p.channels},
                {"apart", static_cast<double>(apart(p))},
                {"offset", p.offset},
                {"damping", p.damping},
                {"per_blend", 1 / p.blend},
                {"steps", p.glossy_steps}},
               {{"BANDS", p.bands}, {"DAMPED", p.damping > 0}, {"GLOSSY", glossy}, {"COUNT", p.count}},
               {{"light", light},
                {"places", places},
                {"views", views},
                {"irradiance", irradiance},
                {"specular", specular},
                {"outcomes", outcomes},
                {"grids", planner.table(table, exact)}});
  planner.cost(0, static_cast<double>(apart(p) * cascades * bytes_per_pixel(p.format)) + static_cast<double>(receivers) * 48);
  return std::move(planner).finish();
}

std::vector<LpvGrid> lpv_cascades(const std::array<int, 3>& extent, double cell, const std::array<double, 3>& centre,
                                  int count) {
  std::vector<LpvGrid> grids;
  for (int k = 0; k < count; ++k) {
    LpvGrid g{extent, {}, std::ldexp(cell, k)};
    for (std::size_t a = 0; a < 3; ++a) g.origin[a] = g.cell * std::floor(centre[a] / g.cell - extent[a] / 2.0 + 0.5);
    grids.push_back(g);
  }
  return grids;
}

std::vector<bool> lpv_cascades_read(const LpvSampleParams& p, const std::vector<float>& receivers) {
  std::vector<bool> read(p.grids.size(), false);
  for (std::size_t i = 0; i + 8 <= receivers.size(); i += 8) {
    const float* v = &receivers[i];
    bool there = v[4] != 0 || v[5] != 0 || v[6] != 0;
    for (const std::size_t c : {0u, 1u, 2u, 4u, 5u, 6u}) there = there && std::isfinite(v[c]);
    if (!there) continue;
    for (std::size_t k = 0; k < p.grids.size(); ++k) {
      const LpvGrid& g = p.grids[k];
      double inside = 1e30;
      for (std::size_t a = 0; a < 3; ++a) {
        const double q = (v[a] - g.origin[a]) / g.cell;
        inside = std::min({inside, q, g.extent[a] - q});
      }
      // What float makes of a side may be as far off as this: then too much is read, never too little.
      const double slack = 1e-4 * (1 + std::max({g.extent[0], g.extent[1], g.extent[2]}) +
                                   std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])}) / g.cell * 1e-2);
      if (inside < -slack) continue;
      read[k] = true;
      if (inside > p.blend + slack) break;
    }
  }
  return read;
}

Status validate(const LpvFilterParams& p) {
  constexpr const char* extents[3] = {"LpvFilterParams.grid.extent[0]", "LpvFilterParams.grid.extent[1]",
                                      "LpvFilterParams.grid.extent[2]"};
  for (std::size_t a = 0; a < 3; ++a) LUXEL_CHECK(check_range(extents[a], p.grid.extent[a], 1, 1024));
  LUXEL_CHECK(check_range("LpvFilterParams.bands", p.bands, 2, 3));
  LUXEL_CHECK(check_range("LpvFilterParams.channels", p.channels, 1, 4));
  LUXEL_CHECK(check_format("LpvFilterParams.format", p.format));
  LUXEL_CHECK(check_range("LpvFilterParams.weight", p.weight, 0.0, 1 / 3.0));
  if (lpv_pixels(p.grid, p.bands, p.channels) > 0x7fffffff)
    return out_of_range(extents[2], p.grid.extent[2], "a volume of at most 2147483647 pixels");
  return {};
}

Result<Plan> plan(const LpvFilterParams& p, const Profile&) {
  LUXEL_CHECK(validate(p));
  Planner planner("light_propagation");
  const std::size_t pixels = lpv_pixels(p.grid, p.bands, p.channels);
  Resource in{"src"}, out{"dst"};
  in.format = out.format = p.format;
  in.bytes = out.bytes = pixels * bytes_per_pixel(p.format);
  out.written = true;
  const Slot src = planner.resource(in), dst = planner.resource(out);
  const std::uint32_t threads = static_cast<std::uint32_t>(std::min<std::size_t>(pixels, strided));
  planner.pass("lpv_filter", name(p.format), "lpv_filter", {threads, 1, 1}, {64, 1, 1},
               {{"width", p.grid.extent[0]},
                {"height", p.grid.extent[1]},
                {"depth", p.grid.extent[2]},
                {"pixels", static_cast<double>(pixels)},
                {"stride", threads},
                {"weight", p.weight}},
               {}, {{"src", src}, {"dst", dst}});
  planner.cost(static_cast<double>(pixels) * 4 * 39, static_cast<double>(2 * pixels * bytes_per_pixel(p.format)));
  return std::move(planner).finish();
}

}  // namespace luxel

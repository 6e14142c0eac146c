#include <luxel/light_propagation.h>

#include <algorithm>
#include <array>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

std::size_t lpv_pixels(const LpvGrid& g, int bands, int channels) {
  return static_cast<std::size_t>(g.extent[0]) * static_cast<std::size_t>(g.extent[1]) *
         static_cast<std::size_t>(g.extent[2]) * static_cast<std::size_t>(channels) * (bands == 3 ? 3 : 1);
}

std::size_t lpv_geometry_pixels(const LpvGrid& g) {
  return static_cast<std::size_t>(g.extent[0] + 1) * static_cast<std::size_t>(g.extent[1] + 1) *
         static_cast<std::size_t>(g.extent[2] + 1);
}

namespace {

constexpr int lane_limit = 16;       // values of a wide, at most
constexpr int box_words = 9;         // lpv_boxes: of a box
constexpr int header_rows = 3;       // lpv_start: nothing, cells with a left neighbour, with a right one

Status check_format(const char* field, Format format) {
  if (format == Format::f32x4 || format == Format::f16x4) return {};
  return out_of_range(field, name(format), "f32x4 or f16x4");
}

int coefficients(const LpvPropagateParams& p) { return p.bands == 3 ? 9 : 4; }
// Light that came through faces has nothing across axes: c4, c5, c7.
int carried(const LpvPropagateParams& p) { return p.bands == 3 ? 6 : 4; }

// Values from row to row, slice to slice and plane to plane. Caches find a place by the lowest bits of an address: a few
// lines between slices and planes keep what a step reads together from asking for the same places.
struct Strides {
  int pitch, slice, plane;
  Strides(int width, int height, int depth)
      : pitch((width + lane_limit - 1) / lane_limit * lane_limit), slice(pitch * height + lane_limit),
        plane(slice * depth + 5 * lane_limit) {}
  Planner::Values values() const { return {{"pitch", pitch}, {"slice", slice}, {"plane", plane}}; }
};
bool too_large(const LpvPropagateParams& p) {
  double values = 1;
  for (const int n : p.grid.extent) values *= n + lane_limit;
  return values * p.channels * (p.bands == 3 ? 12 : 4) * 4 > 0x7fffffff;
}

// Values of a buffer of planes; a row behind the last, since wides reach one beyond a row.
std::size_t plane_values(const LpvPropagateParams& p, const Strides& s) {
  return static_cast<std::size_t>(header_rows + 1) * static_cast<std::size_t>(s.pitch) +
         static_cast<std::size_t>(p.channels * coefficients(p)) * static_cast<std::size_t>(s.plane);
}

}  // namespace

Status validate(const LpvPropagateParams& p) {
  constexpr const char* extents[3] = {"LpvPropagateParams.grid.extent[0]", "LpvPropagateParams.grid.extent[1]",
                                      "LpvPropagateParams.grid.extent[2]"};
  for (std::size_t a = 0; a < 3; ++a) LUXEL_CHECK(check_range(extents[a], p.grid.extent[a], 1, 1024));
  LUXEL_CHECK(check_range("LpvPropagateParams.bands", p.bands, 2, 3));
  LUXEL_CHECK(check_range("LpvPropagateParams.channels", p.channels, 1, 4));
  LUXEL_CHECK(check_format("LpvPropagateParams.format", p.format));
  LUXEL_CHECK(check_range("LpvPropagateParams.iterations", p.iterations, 1, 1000));
  LUXEL_CHECK(check_range("LpvPropagateParams.lobes", static_cast<int>(p.lobes), 0, 3));
  LUXEL_CHECK(check_range("LpvPropagateParams.border", static_cast<int>(p.border), 0, 1));
  if (p.geometry) LUXEL_CHECK(check_format("LpvPropagateParams.geometry_format", p.geometry_format));
  LUXEL_CHECK(check_range("LpvPropagateParams.error", p.error, 0.0, 0.5));
  if (!p.active && p.error > 0)
    return out_of_range("LpvPropagateParams.error", p.error, "0 without active, whose steps find out what travels");
  if (p.active && p.travelling)
    return out_of_range("LpvPropagateParams.travelling", "true", "false with active, whose last step is not known before");
  if (p.active && p.energy)
    return out_of_range("LpvPropagateParams.energy", "true", "false with active, which leaves out cells");
  if (too_large(p))
    return out_of_range(extents[2], p.grid.extent[2], "a grid whose coefficients, in f32 and with 16 cells more along each axis, "
                        "take at most 2147483647 bytes");
  return {};
}

Result<Plan> plan(const LpvPropagateParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const auto& e = p.grid.extent;
  const auto cells = [](int x, int y, int z) {
    return std::array<std::uint32_t, 3>{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                        static_cast<std::uint32_t>(z)};
  };
  const std::string bands = p.bands == 3 ? "bands3" : "bands2";
  const int quads = p.bands == 3 ? 3 : 1;
  Planner planner("light_propagation");
  Resource in{"injected"}, out{"result"};
  in.format = out.format = p.format;
  in.bytes = out.bytes = lpv_pixels(p.grid, p.bands, p.channels) * bytes_per_pixel(p.format);
  out.written = true;
  const Slot injected = planner.resource(in);
  Slot geometry, blocking;
  const bool blocked = p.geometry && (p.iterations > 1 || p.continued);
  if (p.geometry) {
    Resource g{"geometry"};
    g.format = p.geometry_format;
    g.bytes = lpv_geometry_pixels(p.grid) * bytes_per_pixel(g.format);
    geometry = planner.resource(g);
  }
  const Slot result = planner.resource(out);
  Slot travelling;
  if (p.travelling) {
    out.name = "travelling";
    travelling = planner.resource(out);
  }
  Slot energy;
  if (p.energy) {
    Resource r{"energy"};
    r.format = Format::f32x4;
    r.bytes = lpv_pixels(p.grid, 2, p.channels) * bytes_per_pixel(r.format);
    r.written = true;
    energy = planner.resource(r);
  }
  // Two forms of a step, with the same bits: planes of coefficients, and pixels of cells, which can account for energy.
  const bool pixels = profile.texels || p.energy;
  const Strides s(e[0], e[1], e[2]), g(e[0] + 1 + lane_limit, e[1] + 1, e[2] + 1);
  const auto lights = [&] {
    return pixels ? planner.scratch(Format::f32x4, 1 + lpv_pixels(p.grid, p.bands, p.channels))
                  : planner.scratch(Format::f32x1, plane_values(p, s));
  };
  const std::array<Slot, 2> light{lights(), lights()};
  const std::array<Slot, 2> sum{lights(), lights()};

  const int lanes = profile.rows.lanes > 0 && !pixels ? lane_limit : 1;
  const int runs = (e[0] + lanes - 1) / lanes;
  const std::array<std::uint32_t, 3> workgroup =
      lanes > 1 ? std::array<std::uint32_t, 3>{static_cast<std::uint32_t>(std::min(4, s.pitch / lanes)), 8, 1}
                : profile.voxels.workgroup;
  const auto words = [&](double n) { return planner.scratch(Format::u32, static_cast<std::size_t>(n)); };
  const Slot unused = planner.scratch(Format::f32x4, 1);
  Slot state = unused, boxes = unused;
  std::array<Slot, 2> reached{unused, unused};

  const double n = static_cast<double>(e[0]) * e[1] * e[2] * p.channels;
  const double stored = static_cast<double>(quads) * static_cast<double>(bytes_per_pixel(p.format));
  const Planner::Values extent = {{"width", e[0]}, {"height", e[1]}, {"depth", e[2]}};
  const Planner::Values periodic = {{"PERIODIC", p.border == LpvBorder::periodic}};
  const std::array<std::uint32_t, 3>& starting = profile.voxels.workgroup;
  const int columns = pixels ? e[0] : s.pitch;
  if (p.active) {
    const int states = p.iterations + 2;  // steps made; the largest c0 before each step and after the last; then the bounds
    state = words(states + 6);
    boxes = words(static_cast<double>(box_words) * (p.iterations + 1));
    for (Slot& flags : reached) flags = words(static_cast<double>(runs) * e[1] * e[2]);
    planner.pass("lpv_zero", "u32", "light_propagation zero", {8, 1, 1}, {8, 1, 1}, {{"count", states + 6}, {"stride", 8}}, {},
                 {{"words", state}});
    planner.pass("lpv_reach", name(p.format), "light_propagation reach", cells(runs, e[1], e[2]), workgroup,
                 extent + Planner::Values{{"run", lanes}, {"volumes", p.channels * quads}, {"quads", quads}}, {},
                 {{"injected", injected}, {"reached", reached[0]}, {"reaches", reached[1]}, {"state", state}});
    planner.cost(0, n * stored);
    planner.pass("lpv_bounds", "u32", "light_propagation bounds", cells(e[1], e[2], 1), {8, 1, 1},
                 extent + Planner::Values{{"run", lanes}, {"at", states}}, {}, {{"reached", reached[0]}, {"state", state}});
    planner.pass("lpv_boxes", "u32", "light_propagation boxes", cells(p.iterations + 1, 1, 1), {8, 1, 1},
                 extent + Planner::Values{{"run", lanes}, {"columns", columns}, {"channels", p.channels}, {"steps", p.iterations},
                                          {"at", states}, {"step_x", workgroup[0]}, {"step_y", workgroup[1]}, {"step_z", workgroup[2]},
                                          {"start_x", starting[0]}, {"start_y", starting[1]}, {"start_z", starting[2]}},
                 periodic, {{"state", state}, {"boxes", boxes}});
  }
  planner.pass("lpv_start", std::string(name(p.format)) + "_" + bands, "light_propagation start",
               cells(columns, e[1], e[2] * p.channels), starting,
               extent + s.values() + Planner::Values{{"channels", p.channels}, {"keep", p.keep_injected}},
               {{"LOBES", static_cast<int>(p.lobes)}, {"ACTIVE", p.active}, {"CELLS", pixels}},
               {{"injected", injected}, {"travelling", light[0]}, {"other", light[1]}, {"sum", sum[0]}, {"total", sum[1]}, {"boxes", boxes}});
  if (p.active) planner.counts(boxes);
  planner.cost(0, n * (stored + (p.active ? 4.0 : 2.0) * 4 * coefficients(p)));

  if (blocked && pixels && p.geometry_format == Format::f32x4) {
    blocking = geometry;
  } else if (blocked) {
    blocking = pixels ? planner.scratch(Format::f32x4, lpv_geometry_pixels(p.grid))
                      : planner.scratch(Format::f32x1, 4 * static_cast<std::size_t>(g.plane));
    planner.pass("lpv_blocking", name(p.geometry_format), "light_propagation blocking",
                 cells(pixels ? e[0] + 1 : g.pitch, e[1] + 1, e[2] + 1), profile.voxels.workgroup,
                 Planner::Values{{"width", e[0] + 1}, {"height", e[1] + 1}, {"depth", e[2] + 1}} + g.values(), {{"CELLS", pixels}},
                 {{"geometry", geometry}, {"planes", blocking}});
    planner.cost(0, static_cast<double>(lpv_geometry_pixels(p.grid)) *
                        (16.0 + static_cast<double>(bytes_per_pixel(p.geometry_format))));
  }

  for (int step = 0; step < p.iterations; ++step) {
    const std::size_t from = static_cast<std::size_t>(step % 2), to = 1 - from;
    const bool blocks = p.geometry && (step > 0 || p.continued);
    const bool apart = !p.active && (pixels ? p.bands == 3 : lanes > 1 && !blocks);
    const bool last = step + 1 == p.iterations;
    std::vector<std::pair<std::string_view, Slot>> slots = {
        {"src", light[from]}, {"dst", light[to]}, {"sum", sum[from]}, {"total", sum[to]}};
    if (blocks || pixels) slots.push_back({"geometry", blocks ? blocking : light[from]});
    if (p.active || pixels)
      slots.insert(slots.end(), {{"reached", reached[from]}, {"reaches", reached[to]}, {"state", state}, {"boxes", boxes}});
    if (pixels) slots.push_back({"energy", p.energy ? energy : unused});
    const Planner::Values parameters = {{"channels", p.channels},
                                        {"across", step == 0 && p.bands == 3},
                                        {"last", !last ? 0 : p.travelling ? 2 : 1},
                                        {"step", step},
                                        {"error", p.error}};
    const Planner::Values constants = periodic + Planner::Values{{"LOBES", static_cast<int>(p.lobes)}, {"APART", apart}};
    const auto grid = cells(runs, e[1], apart ? e[2] * p.channels : e[2]);
    const std::string label = "light_propagation step " + std::to_string(step + 1);
    if (pixels)
      planner.pass("lpv_propagate_cells", profile.texels ? "texels" : "buffers", label, grid, workgroup, extent + parameters,
                   constants + Planner::Values{{"BANDS", p.bands}, {"BLOCKED", blocks}, {"ACTIVE", p.active}, {"ENERGY", p.energy}},
                   slots);
    else
      planner.pass("lpv_propagate", bands + (blocks ? "_geometry" : "") + (p.active ? "_active" : ""), label, grid, workgroup,
                   extent + s.values() + Planner::Values{{"geometry_pitch", g.pitch}, {"geometry_slice", g.slice}, {"geometry_plane", g.plane}} +
                       parameters,
                   constants + Planner::Values{{"LANES", lanes}}, slots);
    if (p.active) planner.counts(boxes, box_words * static_cast<std::size_t>(step + 1));
    const double read = step == 0 ? coefficients(p) : carried(p);
    const double faces = p.bands == 3 ? 31 : 17;
    const double lobes = p.lobes == LpvLobes::clamp ? 30 : p.lobes == LpvLobes::shrink ? 14 : p.lobes == LpvLobes::rescale ? 150 : 0;
    planner.cost(n * (6 * faces + 2 * carried(p) + 10 + lobes + (blocks ? 30 : 0)) + (blocks ? n / p.channels * 220 : 0),
                 n * 4 * (read + (last && !p.travelling ? 2.0 : 3.0) * carried(p)) + (blocks ? 16.0 * n / p.channels : 0));
  }

  const std::size_t at = static_cast<std::size_t>(p.iterations % 2);
  const auto finish = [&](Slot from, Slot odd, Slot to, bool keep) {
    planner.pass("lpv_finish", name(p.format), "light_propagation finish", cells(e[0], e[1], e[2] * p.channels * quads),
                 profile.voxels.workgroup, extent + s.values() + Planner::Values{{"channels", p.channels}, {"keep", keep}},
                 {{"QUADS", quads}, {"ACTIVE", p.active}, {"CELLS", pixels}},
                 {{"injected", injected}, {"sum", from}, {"result", to}, {"odd", odd}, {"state", state}, {"boxes", boxes}});
    planner.cost(0, n * (4.0 * carried(p) + stored));
  };
  finish(p.active ? sum[0] : sum[at], sum[1], result, p.keep_injected);
  if (p.travelling) finish(light[at], light[at], travelling, false);
  return std::move(planner).finish();
}

}  // namespace luxel

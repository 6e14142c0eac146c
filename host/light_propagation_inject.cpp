#include <cmath>

#include <luxel/lpv_inject.h>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

constexpr std::uint32_t strided = 65536;  // invocations of passes that stride over their work
constexpr std::array<std::uint32_t, 3> line{64, 1, 1};

Status check_grid(const char* name, const LpvGrid& g) {
  const std::string base = std::string(name) + ".grid.";
  constexpr const char* axes[3] = {"extent[0]", "extent[1]", "extent[2]"};
  constexpr const char* places[3] = {"origin[0]", "origin[1]", "origin[2]"};
  for (std::size_t a = 0; a < 3; ++a) LUXEL_CHECK(check_range((base + axes[a]).c_str(), g.extent[a], 1, 1024));
  for (std::size_t a = 0; a < 3; ++a) LUXEL_CHECK(check_range((base + places[a]).c_str(), g.origin[a], -1e30, 1e30));
  return check_range((base + "cell").c_str(), g.cell, 1e-15, 1e15);
}

Status check_words(const char* name, const LpvGrid& g, double words) {
  if (words <= 0x7fffffff) return {};
  return out_of_range((std::string(name) + ".grid.extent[2]").c_str(), g.extent[2],
                      "a grid whose sums, three words each, are at most 2147483647 words");
}

Status check_format(const char* field, Format format) {
  if (format == Format::f32x4 || format == Format::f16x4) return {};
  return out_of_range(field, name(format), "f32x4 or f16x4");
}

// A power of two that brings v to 1/2..1.
double to_one(double v) {
  int exponent = 0;
  std::frexp(v, &exponent);
  return std::ldexp(1.0, -exponent);
}

Resource resource_of(const char* name, Format format, std::size_t count, bool written = false) {
  Resource r{name};
  r.format = format;
  r.bytes = std::max<std::size_t>(count, 1) * bytes_per_pixel(format);
  r.written = written;
  return r;
}

std::uint32_t invocations(std::size_t count) {
  return static_cast<std::uint32_t>(std::min<std::size_t>(std::max<std::size_t>(count, 1), strided));
}

// What both injections share: sums are cleared, added to, and turned into coefficients.
struct Injection {
  std::string module;             // lights or surfels
  std::array<int, 3> extent{};    // cells, or corners
  int bands = 2, colours = 3, sources = 1;
  int count = 0;
  double most = 1, offset = 0, scale = 1;
  bool two_sided = false, counted = false;
  std::array<int, 3> begins{};    // of the second source and those that follow
};

void inject(Planner& planner, const Injection& in, const LpvGrid& grid, Slot list, Slot kept, Slot volume, Slot outcomes,
            Format format, bool keep) {
  const std::size_t cells = static_cast<std::size_t>(in.extent[0]) * static_cast<std::size_t>(in.extent[1]) *
                            static_cast<std::size_t>(in.extent[2]);
  const std::size_t words = cells * static_cast<std::size_t>(in.bands * in.bands * in.colours * in.sources * 3);
  const Slot sums = planner.scratch(Format::u32, words);
  const auto zero = [&](Slot slot, std::size_t count, const char* label) {
    planner.pass("lpv_zero", "u32", label, {invocations(count), 1, 1}, line,
                 {{"count", static_cast<double>(count)}, {"stride", invocations(count)}}, {}, {{"words", slot}});
    planner.cost(0, static_cast<double>(count) * 4);
  };
  zero(sums, words, "lpv_inject clear");
  if (in.counted) zero(outcomes, 4, "lpv_inject clear outcomes");
  const float most = static_cast<float>(in.most);
  const std::uint32_t threads = invocations(static_cast<std::size_t>(in.count));
  if (in.count > 0)
    planner.pass("lpv_inject", in.module, "lpv_inject " + in.module, {threads, 1, 1}, line,
                 {{"width", in.extent[0]},
                  {"height", in.extent[1]},
                  {"depth", in.extent[2]},
                  {"count", in.count},
                  {"stride", threads},
                  {"origin_x", grid.origin[0]},
                  {"origin_y", grid.origin[1]},
                  {"origin_z", grid.origin[2]},
                  {"per_cell", 1 / grid.cell},
                  {"most", most},
                  {"to_one", to_one(most)},
                  {"offset", in.offset},
                  {"two_sided", in.two_sided},
                  {"second", in.begins[0]},
                  {"third", in.begins[1]},
                  {"fourth", in.begins[2]}},
                 {{"BANDS", in.bands}, {"COLOURS", in.colours}, {"COUNT", in.counted}},
                 {{"lights", list}, {"sums", sums}, {"outcomes", outcomes}});
  const std::size_t pixels = cells * static_cast<std::size_t>(in.colours * (in.bands == 3 ? 3 : 1));
  planner.cost(0, in.count * (in.module == "lights" ? 48.0 : 32.0));
  planner.pass("lpv_inject_resolve", name(format), "lpv_inject resolve", {invocations(cells), 1, 1}, line,
               {{"cells", static_cast<double>(cells)},
                {"stride", invocations(cells)},
                {"from_one", 1 / to_one(most)},
                {"scale", in.scale}},
               {{"BANDS", in.bands}, {"COLOURS", in.colours}, {"SOURCES", in.sources}, {"KEPT", keep}},
               {{"sums", sums}, {"kept", kept}, {"volume", volume}});
  planner.cost(0, static_cast<double>(words) * 4 + static_cast<double>(pixels * bytes_per_pixel(format)));
}

std::size_t surfels_of(const LpvInjectGeometryParams& p) {
  std::size_t sum = 0;
  for (const int n : p.surfels) sum += static_cast<std::size_t>(n);
  return sum;
}

int sources_of(const LpvInjectGeometryParams& p) {
  int last = 1;
  for (int i = 0; i < 4; ++i)
    if (p.surfels[static_cast<std::size_t>(i)] > 0) last = i + 1;
  return last;
}

}  // namespace

Status validate(const LpvInjectParams& p) {
  LUXEL_CHECK(check_grid("LpvInjectParams", p.grid));
  LUXEL_CHECK(check_range("LpvInjectParams.lights", p.lights, 0, 1 << 24));
  LUXEL_CHECK(check_range("LpvInjectParams.bands", p.bands, 2, 3));
  if (p.channels != 1 && p.channels != 3) return out_of_range("LpvInjectParams.channels", p.channels, "1 or 3");
  LUXEL_CHECK(check_format("LpvInjectParams.format", p.format));
  LUXEL_CHECK(check_range("LpvInjectParams.flux_max", p.flux_max, 1e-30, 1e30));
  LUXEL_CHECK(check_range("LpvInjectParams.offset", p.offset, -4.0, 4.0));
  return check_words("LpvInjectParams", p.grid,
                     static_cast<double>(lpv_pixels(p.grid, 2, p.channels)) * p.bands * p.bands * 3);
}

Result<Plan> plan(const LpvInjectParams& p, const Profile&) {
  LUXEL_CHECK(validate(p));
  Planner planner("light_propagation");
  const Slot lights = planner.resource(resource_of("lights", Format::f32x4, static_cast<std::size_t>(p.lights) * 3));
  const Slot volume = planner.resource(resource_of("injected", p.format, lpv_pixels(p.grid, p.bands, p.channels), true));
  const Slot outcomes = p.count ? planner.resource(resource_of("outcomes", Format::u32, 4, true)) : planner.scratch(Format::u32, 4);
  Injection in;
  in.module = "lights";
  in.extent = p.grid.extent;
  in.bands = p.bands;
  in.colours = p.channels;
  in.count = p.lights;
  in.most = p.flux_max;
  in.offset = p.offset;
  in.scale = p.per_area ? 1 / (p.grid.cell * p.grid.cell) : 1;
  in.counted = p.count;
  inject(planner, in, p.grid, lights, lights, volume, outcomes, p.format, false);  // `kept` is never read
  return std::move(planner).finish();
}

Status validate(const LpvInjectGeometryParams& p) {
  LUXEL_CHECK(check_grid("LpvInjectGeometryParams", p.grid));
  constexpr const char* sources[4] = {"LpvInjectGeometryParams.surfels[0]", "LpvInjectGeometryParams.surfels[1]",
                                      "LpvInjectGeometryParams.surfels[2]", "LpvInjectGeometryParams.surfels[3]"};
  for (std::size_t i = 0; i < 4; ++i) LUXEL_CHECK(check_range(sources[i], p.surfels[i], 0, 1 << 22));
  if (surfels_of(p) > 1 << 22)
    return out_of_range("LpvInjectGeometryParams.surfels", surfels_of(p), "0..4194304 in all");
  LUXEL_CHECK(check_format("LpvInjectGeometryParams.format", p.format));
  LUXEL_CHECK(check_range("LpvInjectGeometryParams.area_max", p.area_max, 0x1p-20, 64.0));
  LUXEL_CHECK(check_range("LpvInjectGeometryParams.offset", p.offset, -4.0, 4.0));
  return check_words("LpvInjectGeometryParams", p.grid, static_cast<double>(lpv_geometry_pixels(p.grid)) * 12 * sources_of(p));
}

Result<Plan> plan(const LpvInjectGeometryParams& p, const Profile&) {
  LUXEL_CHECK(validate(p));
  Planner planner("light_propagation");
  const Slot surfels = planner.resource(resource_of("surfels", Format::f32x4, surfels_of(p) * 2));
  const Slot kept = p.keep ? planner.resource(resource_of("kept", p.format, lpv_geometry_pixels(p.grid))) : surfels;
  const Slot volume = planner.resource(resource_of("geometry", p.format, lpv_geometry_pixels(p.grid), true));
  const Slot outcomes = p.count ? planner.resource(resource_of("outcomes", Format::u32, 4, true)) : planner.scratch(Format::u32, 4);
  Injection in;
  in.module = "surfels";
  for (std::size_t a = 0; a < 3; ++a) in.extent[a] = p.grid.extent[a] + 1;
  in.colours = 1;
  in.sources = sources_of(p);
  in.count = static_cast<int>(surfels_of(p));
  in.most = p.area_max;
  in.offset = p.offset;
  in.two_sided = p.two_sided;
  in.counted = p.count;
  int begin = 0;
  for (std::size_t i = 0; i < 3; ++i) in.begins[i] = begin += p.surfels[i];
  inject(planner, in, p.grid, surfels, kept, volume, outcomes, p.format, p.keep);
  return std::move(planner).finish();
}

}  // namespace luxel

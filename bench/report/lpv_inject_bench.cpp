#include <fmt/format.h>
#include <luxel/lpv_inject.h>
#include <luxel/lpv_sample.h>

#include "bench/report/bench.h"
#include "tests/cases/lpv_support.h"

namespace luxel::report {

std::vector<BenchSetting> lpv_inject_settings(const Profile& profile) {
  using namespace cases::lpv;
  constexpr int count = 1 << 18;
  std::vector<BenchSetting> settings;
  const auto shared = [](Values v) { return std::make_shared<const std::vector<double>>(std::move(v)); };
  const auto add = [&](const std::string& text, const auto& params, const char* resource, const auto& data) {
    const Result<Plan> made = plan(params, profile);
    if (!made) return;
    settings.push_back({text, made.value(), {}, {}});
    settings.back().data = {{resource, data}};
  };
  for (const int n : {32, 64}) {
    const LpvGrid grid = grid_of(n, n, n);
    const auto lights = shared(list_of(random_lights(count, grid.extent, 1)));
    // A wall: all lights in one layer of cells, as a shadow map has them, and all in one cell.
    std::vector<Light> wall = random_lights(count, {n, n, 1}, 1);
    std::vector<Light> heap(count, Light{{n / 2.0, n / 2.0, n / 2.0}, {0.6, 0.48, 0.64}, {0.5, 0.25, 0.125}});
    const auto flat = shared(list_of(wall)), one = shared(list_of(heap));
    LpvInjectParams p;
    p.grid = grid;
    p.lights = count;
    p.format = Format::f16x4;
    add(fmt::format("lpv_inject {} lights anywhere in {}^3", count, n), p, "lights", lights);
    add(fmt::format("lpv_inject {} lights on a wall of {}^2 cells", count, n), p, "lights", flat);
    p.bands = 3;
    add(fmt::format("lpv_inject {} lights anywhere in {}^3, 3 bands", count, n), p, "lights", lights);
    if (n == 64) continue;
    p.bands = 2;
    add(fmt::format("lpv_inject {} lights in one cell of {}^3", count, n), p, "lights", one);
    p.channels = 1;
    add(fmt::format("lpv_inject {} lights anywhere in {}^3, 1 channel", count, n), p, "lights", lights);
    const auto surfels = shared(list_of(random_surfels(count, grid.extent, 1)));
    LpvInjectGeometryParams g;
    g.grid = grid;
    g.format = Format::f16x4;
    g.surfels = {count, 0, 0, 0};
    add(fmt::format("lpv_inject_geometry {} surfels anywhere in {}^3", count, n), g, "surfels", surfels);
    LpvSampleParams s;
    s.grids = {grid};
    s.format = Format::f16x4;
    s.receivers = count;
    add(fmt::format("lpv_sample {} receivers in {}^3", count, n), s, "receivers", surfels);
    s.damping = 1;
    add(fmt::format("lpv_sample {} receivers in {}^3, damped", count, n), s, "receivers", surfels);
    LpvFilterParams f;
    f.grid = grid;
    f.format = Format::f16x4;
    add(fmt::format("lpv_filter {}^3", n), f, "src", shared(Values(lpv_pixels(grid, 2, 3) * 4, 0.5)));
  }
  return settings;
}

}  // namespace luxel::report

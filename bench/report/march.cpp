#include "bench/report/march.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/scene/images.h"

namespace luxel::report {
namespace {

constexpr int ray_count = 4000;

struct Ray {
  double x, y, d;     // texels and distance at t = 0
  double vx, vy, vd;  // change up to t = 1
};

// From in front of the map to behind it, straight across: most rays pass much empty space and then hit.
Ray ray(const MarchScene& s, int i) {
  const auto random = [&](int k) { return scene::random01(static_cast<std::uint32_t>(i * 8 + k), 61); };
  const double x0 = random(0) * s.width, y0 = random(1) * s.height, x1 = random(2) * s.width, y1 = random(3) * s.height;
  return {x0, y0, 0.5, x1 - x0, y1 - y0, 60 * random(4)};
}

// Walks a ray cell by cell; `up(level)` and `down(level)` say where to go on after an empty and an occupied cell.
template <class Up, class Down>
MarchResult march(const MarchScene& s, int first, Up up, Down down) {
  MarchResult result;
  const auto begin = std::chrono::steady_clock::now();
  double steps = 0;
  for (int i = 0; i < ray_count; ++i) {
    const Ray r = ray(s, i);
    const double ix = r.vx != 0 ? 1 / r.vx : HUGE_VAL, iy = r.vy != 0 ? 1 / r.vy : HUGE_VAL;
    // Cells are counted in texels of the map; a point on an edge belongs to the cell that the ray enters.
    int level = first;
    double t = 0;
    int x = std::clamp(static_cast<int>(r.x), 0, s.width - 1), y = std::clamp(static_cast<int>(r.y), 0, s.height - 1);
    while (t < 1) {
      ++steps;
      const int cx = x >> level, cy = y >> level;
      const double edge_x = r.vx >= 0 ? static_cast<double>((cx + 1) << level) : static_cast<double>(cx << level);
      const double edge_y = r.vy >= 0 ? static_cast<double>((cy + 1) << level) : static_cast<double>(cy << level);
      const double tx = r.vx != 0 ? (edge_x - r.x) * ix : HUGE_VAL, ty = r.vy != 0 ? (edge_y - r.y) * iy : HUGE_VAL;
      const double leave = std::min({tx, ty, 1.0});
      const float bound = s.levels[level][static_cast<std::size_t>(cy) * s.sizes[level].first + cx];
      if (r.d + r.vd * leave < bound) {  // in front of everything in the cell, up to where it is left
        t = leave;
        if (t >= 1) break;
        if (tx <= ty)
          x = r.vx >= 0 ? (cx + 1) << level : (cx << level) - 1;
        else
          x = std::clamp(static_cast<int>(r.x + r.vx * t), cx << level, ((cx + 1) << level) - 1);
        if (ty <= tx)
          y = r.vy >= 0 ? (cy + 1) << level : (cy << level) - 1;
        else
          y = std::clamp(static_cast<int>(r.y + r.vy * t), cy << level, ((cy + 1) << level) - 1);
        if (x < 0 || y < 0 || x >= s.width || y >= s.height) break;
        level = up(level);
      } else if (level == 0) {
        ++result.hits;
        result.sum += x + static_cast<double>(y) * s.width;
        break;
      } else {
        level = down(level);
      }
    }
  }
  result.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  result.rays = ray_count;
  result.steps = steps / ray_count;
  return result;
}

}  // namespace

MarchScene make_march_scene(const MipScene& map) {
  MarchScene s{map.extent[0], map.extent[1], {}, {}};
  s.levels.emplace_back(map.values.begin(), map.values.end());
  s.sizes.emplace_back(s.width, s.height);
  while (s.sizes.back() != std::pair{1, 1}) {
    const auto [w, h] = s.sizes.back();
    const std::pair size{(w + 1) / 2, (h + 1) / 2};
    std::vector<float> level(static_cast<std::size_t>(size.first) * size.second, HUGE_VALF);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        float& to = level[static_cast<std::size_t>(y / 2) * size.first + x / 2];
        to = std::min(to, s.levels.back()[static_cast<std::size_t>(y) * w + x]);
      }
    s.levels.push_back(std::move(level));
    s.sizes.push_back(size);
  }
  return s;
}

MarchResult march_full(const MarchScene& s) {
  const int top = static_cast<int>(s.levels.size()) - 1;
  return march(
      s, std::min(4, top), [=](int level) { return std::min(level + 1, top); }, [](int level) { return level - 1; });
}

MarchResult march_two(const MarchScene& s) {
  const int top = static_cast<int>(s.levels.size()) - 1, coarse = std::min(4, top);
  return march(
      s, coarse, [=](int) { return coarse; }, [](int) { return 0; });
}

}  // namespace luxel::report

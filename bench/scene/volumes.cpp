#include "bench/scene/volumes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace luxel::scene {
namespace {

using Rgba = std::array<double, 4>;

bool in_ball(double x, double y, double z, double cx, double cy, double cz, double r) {
  return (x - cx) * (x - cx) + (y - cy) * (y - cy) + (z - cz) * (z - cz) < r * r;
}

// Colour at a point of the unit cube; `cell`: a voxel's width, which the walls are thick.
Rgba room(double x, double y, double z, double cell) {
  if (y < 3 * cell) return {0.5, 0.48, 0.45, 1};
  if (x >= 0.25 && x < 0.25 + cell) return {0.7, 0.05, 0.04, 1};
  if (x >= 0.25 + cell && x < 0.25 + 2 * cell) return {0.05, 0.6, 0.05, 1};
  if (in_ball(x, y, z, 0.6, 0.25, 0.4, 0.2)) return {0.1, 0.2, 0.7, 1};
  if (in_ball(x, y, z, 0.7, 0.5, 0.75, 0.18)) return {0.06, 0.075, 0.08, 0.1};
  if (std::fabs(x - 0.6) < 0.1 && std::fabs(z - 0.5) < 0.1 && y > 0.9 && y < 0.95)
    return {0.03, 0.025, 0.02, 0};  // dim: it adds up along a ray
  return {0, 0, 0, 0};
}

}  // namespace

std::vector<double> voxel_room(int side) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(side) * side * side * 4);
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (const double v : room((x + 0.5) / side, (y + 0.5) / side, (z + 0.5) / side, 1.0 / side))
          values.push_back(static_cast<float>(v));
  return values;
}

std::vector<double> depth_map(int width, int height) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double u = ((column + 0.5) / width - 0.5) * 2 * width / height, v = 1 - 2 * (row + 0.5) / height;
      double depth = 1000;
      if (v < 0) depth = std::min(depth, 1.5 / -v);            // floor
      if (v > 0.1) depth = std::min(depth, 6.0 / (v - 0.05));  // ceiling
      for (int i = 1; i <= 12; ++i)                            // two rows of pillars
        for (const double side : {-3.0, 3.0}) {
          const double z = 4.0 * i;
          if (std::fabs(u - side / z) < 0.4 / z)
            depth = std::min(depth, z - std::sqrt(std::max(0.0, 0.16 - (u * z - side) * (u * z - side))));
        }
      const double bx = u * 5 - 0.5, by = v * 5 + 0.6, ball = 0.8 - bx * bx - by * by;
      if (ball > 0) depth = std::min(depth, 5 - std::sqrt(ball));
      values.push_back(static_cast<float>(depth));
    }
  return values;
}

}  // namespace luxel::scene

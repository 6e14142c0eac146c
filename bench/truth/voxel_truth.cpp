#include "bench/truth/voxel_truth.h"

#include <algorithm>
#include <cmath>

namespace luxel::truth {

namespace {

__extension__ using Wide = __int128;
constexpr std::int64_t unit = 65536;

struct Span {
  Wide low, high;
  friend bool apart(const Span& a, const Span& b) { return a.high < b.low || b.high < a.low; }
};

Span along(const Triangle& t, const Corner& axis) {
  const auto at = [&](const Corner& v) { return Wide{axis[0]} * v[0] + Wide{axis[1]} * v[1] + Wide{axis[2]} * v[2]; };
  return {std::min({at(t[0]), at(t[1]), at(t[2])}), std::max({at(t[0]), at(t[1]), at(t[2])})};
}

Span along(const Corner& low, const Corner& high, const Corner& axis) {
  Span span{0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Wide a = Wide{axis[k]} * low[k], b = Wide{axis[k]} * high[k];
    span.low += std::min(a, b);
    span.high += std::max(a, b);
  }
  return span;
}

Corner minus(const Corner& a, const Corner& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Corner cross(const Corner& a, const Corner& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

using Point = std::array<double, 3>;

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Point& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

}  // namespace

bool meets(const Triangle& t, const Corner& low, const Corner& high) {
  const Corner unit_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::vector<Corner> axes(unit_axes, unit_axes + 3);
  for (std::size_t i = 0; i < 3; ++i)
    for (const Corner& axis : unit_axes) axes.push_back(cross(minus(t[(i + 1) % 3], t[i]), axis));
  axes.push_back(cross(minus(t[1], t[0]), minus(t[2], t[0])));
  return std::none_of(axes.begin(), axes.end(),
                      [&](const Corner& axis) { return apart(along(t, axis), along(low, high, axis)); });
}

bool touches(const Triangle& t, std::array<int, 3> voxel, VoxelizeMode mode) {
  Corner low, high;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = voxel[k] * unit;
    high[k] = low[k] + unit;
  }
  if (mode == VoxelizeMode::conservative) return meets(t, low, high);
  for (std::size_t along = 0; along < 3; ++along) {
    Corner a = low, b = high;
    for (std::size_t k = 0; k < 3; ++k)
      if (k != along) a[k] = b[k] = low[k] + unit / 2;
    if (meets(t, a, b)) return true;
  }
  return false;
}

double area_in(const Triangle& t, std::array<int, 3> voxel) {
  std::vector<Point> polygon;
  for (const Corner& v : t) {
    Point p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = static_cast<double>(v[k] - voxel[k] * unit) / unit;
    polygon.push_back(p);
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      const double bound = sign > 0 ? 0.0 : -1.0;
      std::vector<Point> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double dp = sign * p[k] - bound, dq = sign * q[k] - bound;
        if (dp >= 0) kept.push_back(p);
        if ((dp >= 0) == (dq >= 0)) continue;
        Point c;
        for (std::size_t a = 0; a < 3; ++a) c[a] = p[a] + dp / (dp - dq) * (q[a] - p[a]);
        kept.push_back(c);
      }
      polygon = std::move(kept);
    }
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    Point a, b;
    for (std::size_t k = 0; k < 3; ++k) {
      a[k] = polygon[i - 1][k] - polygon[0][k];
      b[k] = polygon[i][k] - polygon[0][k];
    }
    area += 0.5 * length(cross(a, b));
  }
  return area;
}

Triangle triangle_of(const std::int32_t* record) {
  Triangle t;
  for (std::size_t i = 0; i < 9; ++i) t[i / 3][i % 3] = record[i];
  return t;
}

std::vector<Voxel> voxels(const VoxelTriangles& triangles, const VoxelGrid& grid, VoxelizeMode mode,
                          const std::vector<Material>& materials) {
  const std::array<int, 3> extent{grid.width, grid.height, grid.depth};
  std::vector<Voxel> all(static_cast<std::size_t>(extent[0]) * extent[1] * extent[2]);
  for (std::size_t i = 0; i < triangles.count; ++i) {
    const std::int32_t* record = triangles.records.data() + 12 * i;
    const Triangle t = triangle_of(record);
    const Material& material = materials[static_cast<std::size_t>(record[9])];
    const Corner n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    Point normal{static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])};
    if (const double size = length(normal); size > 0)
      for (double& v : normal) v *= (record[11] != 0 ? -1 : 1) / size;
    std::array<int, 3> first, last;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({t[0][k], t[1][k], t[2][k]});
      first[k] = static_cast<int>(std::clamp<std::int64_t>(low / unit - 2, 0, extent[k]));
      last[k] = static_cast<int>(std::clamp<std::int64_t>(high / unit + 2, -1, extent[k] - 1));
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          if (!touches(t, {x, y, z}, mode)) continue;
          Voxel& voxel = all[(static_cast<std::size_t>(z) * extent[1] + y) * extent[0] + x];
          voxel.touched = true;
          const double area = std::max(area_in(t, {x, y, z}), 0x1p-16);
          voxel.area += area;
          voxel.opacity += area * material.colour[3];
          for (std::size_t k = 0; k < 3; ++k) {
            voxel.colour[k] += area * material.colour[k];
            voxel.normal[k] += area * normal[k];
            voxel.emission[k] += area * material.emission[k];
          }
          voxel.triangles.push_back(static_cast<std::uint32_t>(record[10]));
        }
  }
  for (Voxel& voxel : all) {
    if (!voxel.touched) continue;
    voxel.opacity /= voxel.area;
    for (std::size_t k = 0; k < 3; ++k) {
      voxel.colour[k] /= voxel.area;
      voxel.normal[k] /= voxel.area;
      voxel.emission[k] /= voxel.area;
    }
    std::sort(voxel.triangles.begin(), voxel.triangles.end());
  }
  return all;
}

}  // namespace luxel::truth

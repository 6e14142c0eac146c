// Meshes into the triangle records of voxelize: rebased and clipped in double, rounded once, cut into counts of pieces.
#include <algorithm>
#include <cmath>

#include <luxel/voxelize.h>

#include "host/check.h"

namespace luxel {

namespace {

using Point = std::array<double, 5>;         // voxels; u, v
using Corner = std::array<std::int32_t, 3>;  // 2^-16 voxel
constexpr int unit = 65536;

// Sutherland and Hodgman, Reentrant Polygon Clipping (1974), at the sides of a cube. The crossing of an edge is computed
// from its lesser end, so that two triangles get the same point where they share the edge.
std::vector<Point> clip(std::vector<Point> polygon, double low, double high) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const double bound = upper ? high : low;
      const auto inside = [&](const Point& p) { return upper ? p[axis] <= bound : p[axis] >= bound; };
      std::vector<Point> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point& p = polygon[i];
        const Point& q = polygon[(i + 1) % polygon.size()];
        if (inside(p)) kept.push_back(p);
        if (inside(p) == inside(q)) continue;
        const Point &a = std::min(p, q), &b = std::max(p, q);
        const double t = (bound - a[axis]) / (b[axis] - a[axis]);
        Point crossing;
        for (std::size_t k = 0; k < 5; ++k) crossing[k] = k == axis ? bound : a[k] + t * (b[k] - a[k]);
        kept.push_back(crossing);
      }
      polygon = std::move(kept);
    }
  return polygon;
}

std::int64_t cross(const Corner& o, const Corner& a, const Corner& b, std::size_t u, std::size_t v) {
  const auto d = [&](const Corner& p, std::size_t axis) { return std::int64_t{p[axis]} - o[axis]; };
  return d(a, u) * d(b, v) - d(a, v) * d(b, u);
}

class Builder {
 public:
  Builder(const VoxelGrid& grid, bool textured, VoxelTriangles& out)
      : extent_{grid.width, grid.height, grid.depth}, textured_(textured), out_(out), marks_(cells(8)) {
    const double largest = std::max({grid.width, grid.height, grid.depth});
    low_ = -2 * largest;
    high_ = 3 * largest;
  }

  bool far(const Point& p) const {
    return std::any_of(p.begin(), p.begin() + 3, [&](double g) { return g < low_ || g > high_; });
  }

  // A triangle whose coordinates are finite.
  void triangle(const std::array<Point, 3>& corners, std::uint32_t material, std::size_t index) {
    if (!far(corners[0]) && !far(corners[1]) && !far(corners[2])) {
      if (!record(corners, material, index)) ++out_.outside;
      return;
    }
    // From the least corner, so that the parts do not depend on where the triangle begins.
    std::vector<Point> polygon(corners.begin(), corners.end());
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    const bool turned = polygon[2] < polygon[1];
    if (turned) std::swap(polygon[1], polygon[2]);
    polygon = clip(std::move(polygon), low_, high_);
    bool kept = false;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Point &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
      kept |= record(turned ? std::array<Point, 3>{a, c, b} : std::array<Point, 3>{a, b, c}, material, index);
    }
    ++(kept ? out_.clipped : out_.outside);
  }

 private:
  std::size_t cells(int side) const {
    std::size_t n = 1;
    for (const int e : extent_) n *= static_cast<std::size_t>((e + side - 1) / side);
    return n;
  }

  // False where it does not touch the grid's bounds.
  bool record(const std::array<Point, 3>& corners, std::uint32_t material, std::size_t index) {
    std::array<Corner, 3> v;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) v[i][k] = static_cast<std::int32_t>(std::nearbyint(corners[i][k] * unit));
    Corner low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min({v[0][k], v[1][k], v[2][k]});
      high[k] = std::max({v[0][k], v[1][k], v[2][k]});
      if (high[k] < 0 || low[k] > extent_[k] * unit) return false;
    }
    std::int32_t turned = 0;
    std::array<std::size_t, 3> order{0, 1, 2};
    for (const std::size_t i : {0u, 1u, 0u})
      if (v[i + 1] < v[i]) {
        std::swap(v[i], v[i + 1]);
        std::swap(order[i], order[i + 1]);
        turned ^= 1;
      }
    if (textured_)
      for (const std::size_t i : order)
        for (const std::size_t k : {3u, 4u}) out_.uvs.push_back(static_cast<float>(corners[i][k]));
    for (const Corner& corner : v) out_.records.insert(out_.records.end(), corner.begin(), corner.end());
    out_.records.insert(out_.records.end(),
                        {static_cast<std::int32_t>(material), static_cast<std::int32_t>(index), turned});
    ++out_.count;
    out_.blocks += count(v, low, high, 64, false);
    out_.pieces += count(v, low, high, 8, true);
    out_.bricks = marked_;
    return true;
  }

  // Blocks of side^3 voxels that the triangle can touch: those of its bounding box that its plane meets.
  std::size_t count(const std::array<Corner, 3>& v, const Corner& low, const Corner& high, int side, bool mark) {
    std::array<int, 3> first, last;
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = std::max((low[k] - 1) >> 16, 0) / side;
      last[k] = std::min(high[k] >> 16, extent_[k] - 1) / side;
    }
    const std::array<double, 3> n{static_cast<double>(cross(v[0], v[1], v[2], 1, 2)), static_cast<double>(cross(v[0], v[1], v[2], 2, 0)),
                                  static_cast<double>(cross(v[0], v[1], v[2], 0, 1))};
    std::size_t w = 2;
    for (const std::size_t k : {std::size_t{1}, std::size_t{0}})
      if (std::fabs(n[k]) > std::fabs(n[w])) w = k;
    const std::size_t a = (w + 1) % 3, b = (w + 2) % 3;
    const double size = static_cast<double>(side) * unit;
    std::size_t found = 0;
    for (int i = first[a]; i <= last[a]; ++i)
      for (int j = first[b]; j <= last[b]; ++j) {
        int from = first[w], to = last[w];
        if (n[w] != 0 && (from < to)) {
          const double slope_a = n[a] / n[w], slope_b = n[b] / n[w];
          const double at = v[0][w] - slope_a * ((i + 0.5) * size - v[0][a]) - slope_b * ((j + 0.5) * size - v[0][b]);
          const double reach = (std::fabs(slope_a) + std::fabs(slope_b)) * 0.5 * size + 1;  // and a unit for rounding
          from = std::max(from, static_cast<int>(std::floor((at - reach) / size)));
          to = std::min(to, static_cast<int>(std::floor((at + reach) / size)));
        }
        for (int k = from; k <= to; ++k) {
          ++found;
          if (!mark) continue;
          std::array<int, 3> at{};
          at[a] = i, at[b] = j, at[w] = k;
          const auto along = [&](std::size_t axis) { return (extent_[axis] + 7) / 8; };
          char& seen = marks_[static_cast<std::size_t>(at[0] + (at[1] + at[2] * along(1)) * along(0))];
          marked_ += seen == 0;
          seen = 1;
        }
      }
    return found;
  }

  const std::array<int, 3> extent_;
  const bool textured_;
  VoxelTriangles& out_;
  double low_ = 0, high_ = 0;
  std::vector<char> marks_;
  std::size_t marked_ = 0;
};

}  // namespace

Result<VoxelTriangles> voxel_triangles(const VoxelMesh& mesh, const VoxelGrid& grid) {
  for (const double o : grid.origin)
    if (!std::isfinite(o)) return out_of_range("VoxelGrid.origin", o, "finite numbers");
  if (!(grid.voxel > 0 && std::isfinite(grid.voxel)))
    return out_of_range("VoxelGrid.voxel", grid.voxel, "a finite number above 0");
  LUXEL_CHECK(check_range("VoxelGrid.width", grid.width, 1, 2048));
  LUXEL_CHECK(check_range("VoxelGrid.height", grid.height, 1, 2048));
  LUXEL_CHECK(check_range("VoxelGrid.depth", grid.depth, 1, 2048));
  if (mesh.triangles > 1u << 27) return out_of_range("VoxelMesh.triangles", mesh.triangles, "0..134217728");
  if (mesh.triangles > 0 && mesh.indices == nullptr)
    return Status(Code::invalid_argument, "VoxelMesh.indices is null; expected three for each triangle");
  if (mesh.vertices > 0 && mesh.positions == nullptr)
    return Status(Code::invalid_argument, "VoxelMesh.positions is null; expected three numbers for each vertex");

  VoxelTriangles out;
  Builder builder(grid, mesh.uvs != nullptr, out);
  out.records.reserve(mesh.triangles * 12);
  for (std::size_t t = 0; t < mesh.triangles; ++t) {
    const std::uint32_t* index = mesh.indices + 3 * t;
    if (index[0] >= mesh.vertices || index[1] >= mesh.vertices || index[2] >= mesh.vertices) {
      ++out.bad_index;
      continue;
    }
    std::array<Point, 3> corners;
    bool finite = true;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        corners[i][k] = (mesh.positions[3 * std::size_t{index[i]} + k] - grid.origin[k]) / grid.voxel;
        finite = finite && std::fabs(corners[i][k]) <= 1e150;  // so that differences and products are finite too
      }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const double uv = mesh.uvs ? mesh.uvs[2 * std::size_t{index[i]} + k] : 0;
        corners[i][3 + k] = std::isfinite(uv) ? uv : 0;
      }
    if (!finite)
      ++out.not_finite;
    else
      builder.triangle(corners, mesh.materials ? mesh.materials[t] : 0, t);
  }
  return out;
}

}  // namespace luxel

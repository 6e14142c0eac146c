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
constexpr int world = 8192;  // voxels on each side of the origin that windows may reach
using Box = std::array<std::array<double, 2>, 3>;  // low and high along each axis

// Sutherland and Hodgman, Reentrant Polygon Clipping (1974), at the sides of a box. The crossing of an edge is computed
// from its lesser end, so that two triangles get the same point where they share the edge.
std::vector<Point> clip(std::vector<Point> polygon, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true}) {
      const double bound = box[axis][upper];
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
    largest_ = std::max({grid.width, grid.height, grid.depth});
    low_ = -2 * largest_;
    high_ = 3 * largest_;
  }

  // For windows: a grid of the whole world, whose triangles are never longer than a window. Records count from its middle.
  static Builder of_windows(const VoxelGrid& grid, bool textured, VoxelTriangles& out) {
    Builder builder({}, textured, out);
    builder.extent_ = {2 * world, 2 * world, 2 * world};
    builder.largest_ = std::max({grid.width, grid.height, grid.depth});
    builder.low_ = 0;
    builder.high_ = 2 * world;
    builder.middle_ = world;
    return builder;
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
    polygon = clip(std::move(polygon), {{{low_, high_}, {low_, high_}, {low_, high_}}});
    ++(fan(polygon, turned, material, index) ? out_.clipped : out_.outside);
  }

  // The same, cut at the sides of cubes as long as a window where it is longer than that.
  void world_triangle(const std::array<Point, 3>& corners, std::uint32_t material, std::size_t index) {
    Box bounds;
    bool longer = false;
    for (std::size_t k = 0; k < 3; ++k) {
      bounds[k] = {std::min({corners[0][k], corners[1][k], corners[2][k]}),
                   std::max({corners[0][k], corners[1][k], corners[2][k]})};
      longer = longer || bounds[k][1] - bounds[k][0] > largest_ || bounds[k][0] < low_ || bounds[k][1] > high_;
    }
    if (!longer) {
      if (!record(corners, material, index)) ++out_.outside;
      return;
    }
    std::vector<Point> polygon(corners.begin(), corners.end());
    std::rotate(polygon.begin(), std::min_element(polygon.begin(), polygon.end()), polygon.end());
    const bool turned = polygon[2] < polygon[1];
    if (turned) std::swap(polygon[1], polygon[2]);
    std::array<int, 3> first, last;
    const int cubes = static_cast<int>(std::ceil(2 * world / largest_));
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = static_cast<int>(std::clamp(std::floor(bounds[k][0] / largest_), 0.0, cubes - 1.0));
      last[k] = static_cast<int>(std::clamp(std::floor(bounds[k][1] / largest_), 0.0, cubes - 1.0));
    }
    const auto side = [&](int cube) { return std::min<double>(cube * largest_, 2 * world); };
    bool kept = false;
    for (int z = first[2]; z <= last[2]; ++z) {
      const std::vector<Point> slice = clip(polygon, {{{low_, high_}, {low_, high_}, {side(z), side(z + 1)}}});
      for (int y = first[1]; y <= last[1] && !slice.empty(); ++y) {
        const std::vector<Point> row =
            clip(slice, {{{low_, high_}, {side(y), side(y + 1)}, {side(z), side(z + 1)}}});
        for (int x = first[0]; x <= last[0] && !row.empty(); ++x) {
          const Box cube{{{side(x), side(x + 1)}, {side(y), side(y + 1)}, {side(z), side(z + 1)}}};
          const std::vector<Point> part = clip(row, cube);
          if (!part.empty() && !of_neighbour(part, cube, bounds)) kept |= fan(part, turned, material, index);
        }
      }
    }
    ++(kept ? out_.clipped : out_.outside);
  }

 private:
  bool fan(const std::vector<Point>& polygon, bool turned, std::uint32_t material, std::size_t index) {
    bool kept = false;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Point &a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
      kept |= record(turned ? std::array<Point, 3>{a, c, b} : std::array<Point, 3>{a, b, c}, material, index);
    }
    return kept;
  }

  // Whether a part lies in a side of its cube that it shares with another, which has it: so that nothing counts twice.
  bool of_neighbour(const std::vector<Point>& part, const Box& cube, const Box& bounds) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto all_at = [&](double side) {
        return std::all_of(part.begin(), part.end(), [&](const Point& p) { return p[k] == side; });
      };
      if (cube[k][1] < high_ && all_at(cube[k][1])) return true;
      if (bounds[k][0] < cube[k][0] && all_at(cube[k][0])) return true;
    }
    return false;
  }

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
    for (const Corner& corner : v)
      for (const std::int32_t at : corner) out_.records.push_back(at - middle_ * unit);
    out_.records.insert(out_.records.end(),
                        {static_cast<std::int32_t>(material), static_cast<std::int32_t>(index), turned});
    ++out_.count;
    out_.pieces += count(v, low, high, 8, middle_ == 0);
    // A window's blocks begin at any brick: there are never more than pieces.
    out_.blocks = middle_ == 0 ? out_.blocks + count(v, low, high, 64, false) : out_.pieces;
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

  std::array<int, 3> extent_;
  const bool textured_;
  VoxelTriangles& out_;
  double low_ = 0, high_ = 0, largest_ = 0;
  int middle_ = 0;
  std::vector<char> marks_;
  std::size_t marked_ = 0;
};

}  // namespace

namespace {

Result<VoxelTriangles> triangles_of(const VoxelMesh& mesh, const VoxelGrid& grid, bool windows) {
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
  const bool textured = mesh.uvs != nullptr;
  Builder builder = windows ? Builder::of_windows(grid, textured, out) : Builder(grid, textured, out);
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
        if (windows) corners[i][k] += world;
      }
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const double uv = mesh.uvs ? mesh.uvs[2 * std::size_t{index[i]} + k] : 0;
        corners[i][3 + k] = std::isfinite(uv) ? uv : 0;
      }
    if (!finite)
      ++out.not_finite;
    else if (windows)
      builder.world_triangle(corners, mesh.materials ? mesh.materials[t] : 0, t);
    else
      builder.triangle(corners, mesh.materials ? mesh.materials[t] : 0, t);
  }
  return out;
}

}  // namespace

Result<VoxelTriangles> voxel_triangles(const VoxelMesh& mesh, const VoxelGrid& grid) {
  return triangles_of(mesh, grid, false);
}

Result<VoxelTriangles> window_triangles(const VoxelMesh& mesh, const VoxelGrid& grid) {
  return triangles_of(mesh, grid, true);
}

}  // namespace luxel

// voxel_inject on a device, for tests: a grid as voxelize would hand it over, lights in, radiance out.
#pragma once
#include <algorithm>
#include <array>

#include <luxel/voxel_inject.h>

#include "tests/support/pyramid.h"

namespace luxel {

using Vec = std::array<double, 3>;

/// Float keeps 24 bits through about a dozen operations.
constexpr double float_bound = 16 * 0x1p-24;

/// Volumes with 4 values a voxel, and the list of bricks that hold something.
struct Grid {
  int n[3];
  std::vector<float> colour, normal, emission;
  std::vector<float> shadow;  // depths of a map
  std::vector<std::uint32_t> bricks, counters = std::vector<std::uint32_t>(16);

  Grid(int x, int y, int z) : n{x, y, z}, colour(voxels() * 4), normal(voxels() * 4), emission(voxels() * 4) {}
  std::size_t voxels() const { return static_cast<std::size_t>(n[0] * n[1] * n[2]); }
  std::size_t at(int x, int y, int z) const { return static_cast<std::size_t>((z * n[1] + y) * n[0] + x); }
  void put(int x, int y, int z, std::array<float, 4> c, std::array<float, 3> d) {
    std::copy(c.begin(), c.end(), &colour[at(x, y, z) * 4]);
    std::copy(d.begin(), d.end(), &normal[at(x, y, z) * 4]);
  }
  double coverage(int x, int y, int z) const { return colour[at(x, y, z) * 4 + 3]; }

  void list_bricks() {
    bricks.clear();
    const int b[3] = {(n[0] + 7) / 8, (n[1] + 7) / 8, (n[2] + 7) / 8};
    for (int i = 0; i < b[0] * b[1] * b[2]; ++i) {
      const int low[3] = {i % b[0] * 8, i / b[0] % b[1] * 8, i / b[0] / b[1] * 8};
      bool touched = false;
      for (int z = low[2]; z < std::min(low[2] + 8, n[2]); ++z)
        for (int y = low[1]; y < std::min(low[1] + 8, n[1]); ++y)
          for (int x = low[0]; x < std::min(low[0] + 8, n[0]); ++x) touched |= coverage(x, y, z) > 0;
      if (touched) bricks.push_back(static_cast<std::uint32_t>(i));
    }
    counters[2] = static_cast<std::uint32_t>(bricks.size());
  }

  VoxelInjectParams params() const {
    VoxelInjectParams p;
    p.width = n[0];
    p.height = n[1];
    p.depth = n[2];
    p.bricks = static_cast<int>(std::max<std::size_t>(bricks.size(), 1));
    return p;
  }
};

/// What the plan writes: radiance and, where counted, outcomes. `light`: lights, then the texels of a map.
std::vector<Bytes> inject(const std::string& device, const Grid& g, const VoxelInjectParams& p,
                          const std::vector<float>& light, const Bytes& before = {});
std::vector<double> radiance(const std::string& device, const Grid& g, const VoxelInjectParams& p,
                             const std::vector<float>& light);

/// The tested devices, and C++ in double.
std::vector<std::string> all_devices();
std::vector<std::uint32_t> words(const Bytes& bytes);

/// A floor of voxels at height y, normal up, base colour 1/2.
void floor_at(Grid& g, int y);
/// Voxels of every kind in a grid of no whole bricks.
Grid random_grid();
/// A sun, a point and a patch for it.
extern const std::vector<VoxelLight> several;

}  // namespace luxel

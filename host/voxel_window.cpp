// What a window that moves over a torus of voxels needs anew.
#include <algorithm>
#include <cstdlib>

#include <luxel/voxelize.h>

namespace luxel {

std::vector<VoxelizeParams> voxelize_move(const VoxelizeParams& params, const std::array<int, 3>& from) {
  const std::array<int, 3> extent{params.width, params.height, params.depth};
  VoxelizeParams rest = params;  // what is not yet made
  rest.first = {0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) rest.last[k] = extent[k] - 1;
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(params.window[k] - from[k]) >= extent[k]) return {rest};
  std::vector<VoxelizeParams> slabs;
  for (std::size_t k = 0; k < 3; ++k) {
    const int moved = params.window[k] - from[k];
    if (moved == 0) continue;
    VoxelizeParams slab = rest;
    if (moved > 0) {
      slab.first[k] = extent[k] - moved;
      rest.last[k] = slab.first[k] - 1;
    } else {
      slab.last[k] = -moved - 1;
      rest.first[k] = -moved;
    }
    slabs.push_back(slab);
  }
  return slabs;
}

}  // namespace luxel

// What pyramids should hold: reductions in double from level 0, never from a rounded level, written apart from the kernels.
#pragma once
#include <span>
#include <vector>

#include <luxel/mip_build.h>

namespace luxel::truth {

/// One level: `extent` texels of `channels` values, interleaved, x first.
struct Level {
  std::array<int, 3> extent{1, 1, 1};
  int channels = 4;
  std::vector<double> values;
};

/// Levels 0, 1, ... of one volume. `level_0` has the channels of its format; single values become pairs (minmax: the value
/// twice; moments: the value and 0). `direction` 0..5 as in MipDirections for anisotropic, else ignored.
/// Bounds are taken over the texels of level 0 whose address is the texel, as MipSizes says it.
std::vector<Level> pyramid(const MipBuildParams& params, std::span<const double> level_0, int direction = -1);

}  // namespace luxel::truth

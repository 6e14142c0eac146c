// Rays across a distance map, on the host: how a full hierarchy of lower bounds compares with two levels
// (McGuire et al., Real-Time Global Illumination using Precomputed Light Field Probes, 2017, 4.2).
#pragma once
#include <vector>

#include "bench/report/mips.h"

namespace luxel::report {

struct MarchScene {
  int width = 0, height = 0;
  std::vector<std::vector<float>> levels;  // lower bounds, ratio 2, sizes rounded up; 0: the map
  std::vector<std::pair<int, int>> sizes;
};

struct MarchResult {
  double ms = 0, steps = 0;  // steps a ray
  int rays = 0, hits = 0;
  double sum = 0;  // of the places of all hits: equal where the same surfaces were found
};

MarchScene make_march_scene(const MipScene& map);

/// Every ray by all levels, without a stack: up a level where a cell was empty, down where it was not.
MarchResult march_full(const MarchScene& scene);
/// Every ray by the map and the level of 1/16.
MarchResult march_two(const MarchScene& scene);

}  // namespace luxel::report

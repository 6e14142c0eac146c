// Generated volumes and depth maps, the same on every machine.
#pragma once
#include <vector>

namespace luxel::scene {

/// Premultiplied radiance and opacity, [z][y][x][4], side^3: a floor, a red wall with a green one right behind it, a
/// solid and a glass ball, a lamp that emits without opacity.
std::vector<double> voxel_room(int side);

/// Distances 1..1000 of a hall with pillars and a ball, row 0 on top. What shows no surface is at 1000.
std::vector<double> depth_map(int width, int height);

}  // namespace luxel::scene

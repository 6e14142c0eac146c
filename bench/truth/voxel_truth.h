// What voxelize must find: exact tests of closed triangles against closed boxes, and means by clipping in double. Apart
// from the kernel: all thirteen axes, both ways, in 128-bit integers.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <luxel/voxelize.h>

namespace luxel::truth {

/// In 2^-16 voxel.
using Corner = std::array<std::int64_t, 3>;
using Triangle = std::array<Corner, 3>;

/// Whether a closed triangle meets the closed box low..high, which may be flat, a segment or a point.
bool meets(const Triangle& triangle, const Corner& low, const Corner& high);

/// Whether it touches voxel (x, y, z), in mode conservative or thin.
bool touches(const Triangle& triangle, std::array<int, 3> voxel, VoxelizeMode mode);

/// Area of the triangle's part in a voxel, in voxels^2.
double area_in(const Triangle& triangle, std::array<int, 3> voxel);

/// Mean over what triangles touch a voxel.
struct Voxel {
  bool touched = false;
  double area = 0;                      // each triangle's at least 2^-16
  std::array<double, 3> colour{}, normal{}, emission{};
  double opacity = 0;
  std::vector<std::uint32_t> triangles;  // of the mesh, ascending
};

/// Base colour, opacity, emission.
struct Material {
  std::array<double, 4> colour{1, 1, 1, 1};
  std::array<double, 3> emission{};
};

/// The triangle of a record of VoxelTriangles.
Triangle triangle_of(const std::int32_t* record);

/// Every voxel of the grid, [z][y][x], from the records that the kernel gets.
std::vector<Voxel> voxels(const VoxelTriangles& triangles, const VoxelGrid& grid, VoxelizeMode mode,
                          const std::vector<Material>& materials);

}  // namespace luxel::truth

// Meshes that the tests and cases of voxelize share, generated and from OBJ files.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <luxel/voxelize.h>

namespace luxel::cases {

struct Mesh {
  std::vector<double> positions;         // x, y, z
  std::vector<std::uint32_t> indices;    // three a triangle
  std::vector<std::uint32_t> materials;  // of each triangle; empty: all 0

  std::size_t triangles() const { return indices.size() / 3; }
  /// Three vertices of its own.
  void add(const std::array<double, 9>& corners, std::uint32_t material = 0);
  VoxelMesh view() const;
};

/// Vertices and faces of an OBJ file (faces of more corners as fans); indices are as the file has them, also bad ones.
/// Empty where the file cannot be read.
Mesh read_obj(const std::string& path);

/// A cube of N^3 voxels of side 1 at the origin.
VoxelGrid unit_grid(int n);

/// A ball of 20 * 4^level triangles, closed, with shared vertices.
Mesh icosphere(std::array<double, 3> centre, double radius, int level);

/// Triangles of every awkward kind in and around a grid of n^3 voxels: from small ones to +-2 grids; corners on voxel
/// corners and centres, in grid planes, along grid lines; segments, points, slivers.
Mesh awkward_mesh(std::uint32_t count, double n, std::uint32_t seed);

/// A cube of sides low..high, two triangles a side, with vertices of their own.
Mesh cube_mesh(double low, double high);

/// Voxels that a walk from (0,0,0), through faces or also through edges and corners, does not reach in a grid of n^3.
/// None where (0,0,0) is occupied.
std::size_t enclosed(const std::vector<char>& occupied, int n, bool by_corners);

}  // namespace luxel::cases

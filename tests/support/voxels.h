// Voxelizations on a device, for tests: a mesh in, volumes, lists and counters out.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include <luxel/voxelize.h>

#include "bench/truth/voxel_truth.h"
#include "tests/support/run.h"

namespace luxel {

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

/// Path of a file under LUXEL_DATA; empty where that is not set or the file is absent.
std::string data_file(const std::string& name);

/// A cube of N^3 voxels of side 1 at the origin.
VoxelGrid unit_grid(int n);

/// 0 up to 1 from a hash, so that numbers are the same with every standard library.
double random01(std::uint32_t i);

/// A ball of 20 * 4^level triangles, closed, with shared vertices.
Mesh icosphere(std::array<double, 3> centre, double radius, int level);

struct Voxelized {
  std::map<std::string, Bytes> bytes;        // of every resource that is written
  std::array<std::uint32_t, 16> counters{};

  std::uint32_t count(VoxelizeCount which) const { return counters[static_cast<std::size_t>(which)]; }
  std::vector<std::uint32_t> words(const std::string& name) const;
};

/// Runs the kernel on records in a grid. `params` as voxelize_params makes them, and what a test changes.
Voxelized voxelize(Context& context, const VoxelizeParams& params, const VoxelTriangles& triangles,
                   const std::vector<truth::Material>& materials = {{}});

/// Touched voxels, [z][y][x]: coverage above 0.
std::vector<char> occupied(const VoxelizeParams& params, const Voxelized& result);
std::vector<char> occupied(const std::vector<truth::Voxel>& voxels);

/// How many differ.
std::size_t different(const std::vector<char>& a, const std::vector<char>& b);

}  // namespace luxel

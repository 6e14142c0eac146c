// Voxelizations on a device, for tests: records in, volumes, lists and counters out.
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

/// Path of a file under LUXEL_DATA; empty where that is not set or the file is absent.
std::string data_file(const std::string& name);

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

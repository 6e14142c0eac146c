// What the cases of voxelize share: records in, volumes, lists and counters out.
#pragma once
#include <cstdint>
#include <vector>

#include <luxel/voxelize.h>

#include "bench/truth/voxel_truth.h"
#include "tests/cases/case.h"
#include "tests/cases/voxelize_meshes.h"

namespace luxel::cases {

struct Voxels {
  std::vector<double> colour, normal, emission;        // four channels a voxel, as far as asked for
  std::vector<std::array<std::uint32_t, 4>> fragments; // x, y, z, triangle, sorted
  std::vector<double> counters;

  double count(VoxelizeCount which) const { return counters[static_cast<std::size_t>(which)]; }
};

/// Runs the kernel on a device.
Result<Voxels> voxelize(Context& context, const VoxelizeParams& params, const VoxelTriangles& triangles,
                        const std::vector<truth::Material>& materials = {{}});

/// Touched voxels, [z][y][x]: coverage above 0.
std::vector<char> occupied(const Voxels& voxels);

/// Pairs of voxel and triangle that the truth has, sorted.
std::vector<std::array<std::uint32_t, 4>> fragments(const std::vector<truth::Voxel>& voxels, const VoxelGrid& grid);

/// How many elements of two sorted lists have no partner in the other.
double unmatched(const std::vector<std::array<std::uint32_t, 4>>& a, const std::vector<std::array<std::uint32_t, 4>>& b);

/// Three materials: opaque; half transparent and bright; nearly clear and brighter.
const std::vector<truth::Material>& paints();
constexpr double brightest = 100;

/// How far a mean of values in 0..1 may be off. A weight is the area to within half a step 2^-22 voxel^2 and what clipping
/// in f32 rounds (2^-20, coordinates up to 2 grids off), or the floor 2^-16: with m triangles over an area A a mean
/// moves by m 2^-19 / A at most; the values by half a step 2^-14; and f32 rounds.
double mean_bound(const truth::Voxel& voxel);

/// Largest error of colour, coverage, normal and emission against the truth, as a share of the bound.
double worst_mean(const Voxels& voxels, const std::vector<truth::Voxel>& truth);

}  // namespace luxel::cases

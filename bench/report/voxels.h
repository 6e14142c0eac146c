// What the report measures of voxelize.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/voxelize.h>

#include "bench/report/session.h"
#include "tests/cases/voxelize_meshes.h"

namespace luxel::report {

struct VoxelScene {
  std::string name;
  cases::Mesh mesh;  // materials 0, 1, 2
  VoxelGrid grid;
};

/// The bounding cube of a mesh in n^3 voxels: centred, padded by 1 % of its side at each end.
VoxelGrid grid_around(const cases::Mesh& mesh, int n);

/// The bunny of LUXEL_DATA; without it, a ball of as many triangles.
cases::Mesh bunny_or_ball(std::string& name);

/// A floor 256 voxels wide, of 2 parts^2 triangles.
cases::Mesh floor_of(int parts);

/// Frontier rows, the published times of a peer, and what is left out when not needed.
std::vector<Job> voxel_jobs(Session& session);

}  // namespace luxel::report

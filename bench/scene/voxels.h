// Scenes as voxelize takes them: triangles, materials and textures of a scene in a grid.
#pragma once
#include <vector>

#include <luxel/voxelize.h>

#include "bench/scene/scene.h"

namespace luxel::scene {

/// A bounding cube in n^3 voxels: centred, padded by 1 % of its side at each end.
VoxelGrid grid_around(const Bounds& box, int n);
VoxelGrid grid_around(const Scene& scene, int n);

struct SceneVoxels {
  VoxelGrid grid;
  VoxelTriangles triangles;
  VoxelTextures textures;        // empty where no material has any
  std::vector<float> materials;  // 8 values each: the resource `materials`
  VoxelizeParams params;         // extents, capacities and what the materials need: opacity, emission, textures
};

/// `albedo`: colours are diffuse reflectance (base colour times 1 - metallic), else base colour. `windows`: triangles for
/// windows that move (window_triangles).
/// Errors: those of voxel_triangles and voxel_textures.
Result<SceneVoxels> scene_voxels(const Scene& scene, const VoxelGrid& grid, bool albedo = false, bool windows = false);

}  // namespace luxel::scene

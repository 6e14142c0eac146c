// Light that reaches the pixels of a G-buffer straight from lights, by shadow rays.
#pragma once
#include <vector>

#include <luxel/voxel_inject.h>

#include "render.h"

namespace luxel::program {

/// Irradiance at each pixel from the suns among the lights, or from all others.
std::vector<glm::dvec3> direct(const RenderInput& input, const std::vector<VoxelLight>& lights, bool sun);

}  // namespace luxel::program

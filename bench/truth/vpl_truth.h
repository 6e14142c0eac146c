// What small lights send to points, by all pairs and a ray each, in double.
#pragma once
#include <vector>

#include "bench/scene/rsm.h"

namespace luxel::truth {

/// Irradiance at each point, 3 values: the sum over lights of flux / pi cos cos V / (d^2 + area / pi). V: whether a ray
/// meets nothing on the way. A light counts as a disc seen along its axis, so that none sends more than its radiosity
/// (instant radiosity, Keller 1997, without its singularity).
std::vector<double> vpl_irradiance(const scene::Rays& rays, const std::vector<scene::VirtualLight>& lights,
                                   const std::vector<glm::dvec3>& places, const std::vector<glm::dvec3>& normals);

}  // namespace luxel::truth

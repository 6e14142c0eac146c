// Reflective shadow maps by ray casts: what every light of a scene reaches first, as small lights of their own (Dachsbacher
// and Stamminger, Reflective Shadow Maps, 2005), and pieces of surfaces.
#pragma once
#include <cstddef>
#include <vector>

#include "bench/scene/rays.h"

namespace luxel::scene {

/// What a texel saw: a small diffuse reflector.
struct VirtualLight {
  glm::dvec3 position{0};
  glm::dvec3 normal{0};  // geometric, unit, on the side that the light comes from
  glm::dvec3 flux{0};    // albedo times what arrives: irradiance times area
  double area = 0;       // of the surface that the texel covers
};

struct RsmSettings {
  int sun_texels = 128;      // along the longer side of the sun's map, 1..4096; the map covers the scene's bounds
  int sky_directions = 32;   // the sky is so many suns about the sphere, 1..4096 ...
  int sky_texels = 32;       // ... with maps of so many texels along the longer side
  int lamp_rays = 16384;     // of all emitting surfaces together, cosine-distributed from both sides
};

/// One light after the other: sun, sky, emitters. What no light reaches first is not there; a surface without albedo has no
/// flux but is there. The sum of all fluxes is what one diffuse reflection sends on.
std::vector<VirtualLight> reflective_shadow_maps(const Rays& rays, const RsmSettings& settings);

/// All surfaces in pieces of about `area` (triangles are cut in a quarter until they are no larger), on their fronts.
std::vector<VirtualLight> surface_pieces(const Scene& scene, double area);

/// The resources `lights` and `surfels` of lpv_inject, places from `origin`.
std::vector<float> lights_list(const std::vector<VirtualLight>& lights, glm::dvec3 origin);
std::vector<float> surfels_list(const std::vector<VirtualLight>& lights, glm::dvec3 origin);

}  // namespace luxel::scene

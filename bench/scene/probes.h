// Probes in a scene: where they stand, and what rays from them meet, in double.
#pragma once
#include <cstdint>
#include <vector>

#include <luxel/octahedral_march.h>

#include "bench/scene/rays.h"
#include "bench/scene/voxel_scene.h"

namespace luxel::scene {

/// Probes of a grid: where each stands, and whether it is of use.
struct Probes {
  ProbeGrid grid;                      // placed: where jitter moved a probe or one is dead
  std::vector<glm::dvec3> centres;     // one a probe
  std::vector<std::uint8_t> alive;     // 1, or 0 for a probe inside geometry
  std::size_t size() const { return centres.size(); }
  /// The buffer `positions` of a placed grid: 4 a probe.
  std::vector<double> positions() const;
};

/// A grid over the scene's bounds: each probe in the middle of a cell. `jitter`: each is moved by up to this part of half
/// its cell along each axis (0..1), by luxel's hash of its number and the seed. Centres are floats.
Probes place_probes(const Scene& scene, std::array<int, 3> count, double jitter = 0, std::uint32_t seed = 1);

/// The direction of a texel's centre in a map of size x size, in double (pole +z, u right, v down).
glm::dvec3 texel_direction(int x, int y, int size);
/// Place of a direction in the map, both in -1..1.
glm::dvec2 octahedral_place(glm::dvec3 direction);

/// A probe is dead where more than half of the surfaces that it sees show it their back, in meshes whose closed surfaces
/// are wound outwards; probes in the open, which see none, live. Sets `alive`. `rays_a_probe`: directions asked.
void find_dead_probes(Probes& probes, const Rays& rays, int rays_a_probe = 256);

/// What light a probe's radiance holds.
struct ProbeLight {
  bool reflected = true;  // L1 = albedo / pi times the irradiance of sun and lamps (voxel_lights_of), with shadow rays
  bool emitted = false;   // what seen surfaces emit
  bool sky = false;       // the sky, where no surface is seen
  int sky_samples = 0;    // > 0: L1 counts the sky's irradiance too, by so many cosine directions
  int lamp_pieces = 64;
};

/// Sun and lamps of a scene, and what they send to a point: irradiance, shadow rays cast.
class DirectLight {
 public:
  DirectLight(const Rays& rays, const ProbeLight& light);
  glm::dvec3 irradiance(glm::dvec3 position, glm::dvec3 normal) const;
  /// Radiance along a ray that met (or did not meet) a surface.
  glm::dvec3 radiance(const std::optional<Hit>& hit, glm::dvec3 direction) const;

 private:
  const Rays& rays_;
  ProbeLight light_;
  std::vector<VoxelLight> lights_;
};

/// What the texels of all probes' maps see through their centres, as probe_build's hits, texel order of ProbeMaps.
struct ProbeHits {
  int size = 0;
  std::vector<double> distance;  // 1 a texel; infinite where no surface is
  std::vector<double> normal;    // 4 a texel: unit, facing the probe, 0; zeros where no surface is
  std::vector<double> radiance;  // 4 a texel, the fourth 0; empty where `light` is null
};

/// Casts by all cores. `samples`: rays along each axis of a texel that radiance is the mean of; distance and normal are of
/// the centre. Results do not depend on the number of cores. Dead probes are cast like others.
ProbeHits cast_probes(const Probes& probes, const Rays& rays, int size, const ProbeLight* light = nullptr,
                      int samples = 1);

}  // namespace luxel::scene

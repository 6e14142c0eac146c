// What rays meet in the scene itself, and how far answers from its probes are off.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <luxel/probe_trace.h>

#include "bench/scene/probes.h"

namespace luxel::truth {

/// Rays of one kind: floats, as the buffer `rays` has them (8 a ray), and what they meet: distance, infinite where nothing.
struct SceneRays {
  std::vector<double> rays;
  std::vector<double> met;
  std::size_t size() const { return met.size(); }
};

/// Rays that leave surfaces as diffuse light does: from points that random rays from random places in the open meet, in
/// cosine-weighted directions; lifted off the surface by Rays::offset(). Places in the open: those from which the first
/// surface met shows its front. Results do not depend on the number of cores.
SceneRays surface_rays(const scene::Rays& rays, std::size_t count, std::uint32_t seed);
/// Rays from places in the open into all directions alike.
SceneRays open_rays(const scene::Rays& rays, std::size_t count, std::uint32_t seed);

struct ProbeAgreement {
  double agree = 0;     // part of all rays: hit and hit, or miss and miss; `assumed` counts as hit, unknown and capped never agree
  double right = 0;     // part of all rays: agree, and where both hit, within two footprints and 1 % of the distance
  double median = 0;    // distance error of the hits that agree, in footprints of the texel that was hit
  double p95 = 0;
  double known_right = 0;  // right, of the rays that ended otherwise than `assumed`, unknown or capped
  double unknown = 0;   // parts of all rays: no probe knew; `assumed` among them
  double capped = 0;
  double relative = 0;  // median of |t - t*| / t*
  double probes = 0, steps = 0;  // a ray
};

/// `hits` and `texels` as probe_trace writes them; `distances`: radial distance of every texel as cast (ProbeHits).
ProbeAgreement agreement(const SceneRays& rays, std::span<const double> hits, std::span<const double> texels,
                         std::span<const double> distances, int size);

}  // namespace luxel::truth

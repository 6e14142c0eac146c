/// \file
/// probe_trace: rays through octahedral maps of radial distance (McGuire et al. 2017, section 4).
#pragma once
#include <luxel/octahedral_march.h>

namespace luxel {

/// In which order the probes of a cage are asked, from the one nearest to the ray's line on.
enum class ProbeOrder {
  plus3,   ///< corner (i + 3) mod 8 (McGuire et al. 2017, 4.1): mostly across faces; the path is 15 or 16 edges long
  farthest ///< i xor 7, 6, 7, 5, 7, 6, 7: across the cage every other time; 18 edges, the longest there is
};

/// Rays are followed through maps of distance.
struct ProbeTraceParams {
  ProbeGrid grid;  ///< where the probes are
  ProbeMaps maps;        ///< ratio 1: texel by texel, without a minimum map; normal none: no normals are read
  int rays = 0;          ///< 1..2^26
  int probe = -1;        ///< >= 0: only this one is asked; -1: those of the cages that the ray comes through
  int tries = 8;         ///< probes asked in a cage, 1..24; above 8 they are asked again, from where the others led to
  ProbeOrder order = ProbeOrder::plus3;  ///< in which the probes of a cage are asked
  int max_steps = 0;     ///< looks at maps a ray; 0: as many as the longest may need
  double thickness = 0.5;  ///< of what is seen, in texel footprints (the side of a square of the texel's solid angle, at its
                         ///< distance), 0.125..64. A ray that enters a texel farther behind what it saw is behind it: in
                         ///< distance (with normals beside the surface's slope over a footprint), and with normals below its
                         ///< plane by the thickness times 1/4 + the slope's sine
  double slope = 8;      ///< with normals: the largest slope that counts, 0..64
  double bias = 0;       ///< nothing is hit nearer to a ray's beginning than this many footprints there; rays that start on a
                         ///< surface need 1 or more where there are no normals. 0..64
  bool count = false;    ///< adds `counters`
};

/// How a ray ended: hits[4 i + 1], and the u32 of `counters` that are added to. A step cap is never a hit.
enum class ProbeOutcome {
  none,        ///< not used
  hit,         ///< within the thickness of what a texel saw, from its front
  miss,        ///< reached the ray's end in front of everything
  unknown,     ///< passed behind something, and the probe that is asked does not know on (or no probe is alive)
  capped,      ///< reached max_steps
  degenerate,  ///< no direction (zero or NaN), origin not finite, reach below the beginning or NaN
  assumed,     ///< all probes of a cage led behind something: the last occluder counts as hit
  rays,        ///< counters alone: all of hit .. assumed
  probes,      ///< counters alone: probes asked
  steps        ///< counters alone: looks at maps, coarse and fine
};
/// Words of `counters`.
constexpr int probe_outcomes = 10;

/// Resources of the plan:
/// - `rays`: two vec4 a ray: origin (scene units) and where the ray begins along it (>= 0, mostly 0); direction (any length)
///   and the length where it ends, 1e30 and above: never;
/// - `distances`, `minimum` (ratio > 1), `normals` (maps.normal): as probe_build writes them;
/// - `positions` (grid.placed): a vec4 a probe;
/// - `hits` (written): a vec4 a ray: length in scene units (of the hit; where it ended, or where knowledge ends), ProbeOutcome,
///   probes asked, looks;
/// - `texels` (written): a u32 a ray: texel (of all maps) that was hit, or at which knowledge ended; 0xffffffff: none;
/// - `counters` (count): probe_outcomes u32.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeTraceParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ProbeTraceParams& params, const Profile& profile);

/// Radiance of what rays met: `hits`, `texels` and the map `radiance` in, `seen` out (written): a vec4 a ray: r, g, b of the
/// texel, 1; where nothing was met (miss): `environment`, 0; else (unknown, capped, degenerate) zeros. `assumed` counts as hit.
struct ProbeFetchParams {
  ProbeMaps maps;  ///< what the probes hold
  int probes = 1;  ///< of the maps, 1..65536
  int rays = 0;  ///< 1..2^26
  std::array<double, 3> environment{0, 0, 0};  ///< radiance where nothing was met
};
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeFetchParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ProbeFetchParams& params, const Profile& profile);

}  // namespace luxel

/// \file
/// probe_irradiance: from what probes see (octahedral maps of radiance and distance) to what probe_shade looks up: irradiance for
/// every normal, and mean and standard deviation of the distance around every direction (McGuire et al., Real-Time Global
/// Illumination using Precomputed Light Field Probes, 2017, 5.2).
#pragma once
#include <luxel/octahedral_march.h>

namespace luxel {

/// Maps to look up are made from what probes see.
struct ProbeIrradianceParams {
  ProbeGrid grid;                 ///< how many probes, 65535 at most, and the diagonal of a cage, probe_unit()
  ProbeMaps maps;                 ///< size and formats of what the probes see; the minimum and normals are not read
  int listed = 0;                 ///< probes that are made, 1..65535: those whose numbers are in `list`, each at most once;
                                  ///< all others stay as they are. 0: all are made, and there is no list
  int samples = 0;                ///< the maps are first averaged down to this size, by solid angle: even, 4..64, a divisor of
                                  ///< theirs; 0: the largest one up to 32
  int irradiance_size = 16;       ///< of the maps of irradiance, without their border, 4..128; 0: not wanted
  int moments_size = 16;          ///< of the maps of distance, without their border, 4..128; 0: not wanted
  int power = 64;                 ///< of the cosine around a direction whose distance is meant, 1..256
  double max_distance = 1.5;      ///< diagonals of a cage, 1e-6..65504: what is farther counts as this
  Format irradiance_format = Format::f16x4;  ///< f32x4, f16x4
  Format moments_format = Format::f16x2;     ///< f32x2, f16x2
  bool previous = false;          ///< maps are blended with those of before
  double hysteresis = 0.98;       ///< part of these that stays, 0..1. In half floats a map may stop 2^-11 / (1 -
                                  ///< hysteresis) of its value short: 2.4 % at 0.98
};

/// Resources of the plan:
/// - `radiance` (irradiance_size > 0), `distance` (moments_size > 0): as ProbeMaps has them. Radiance that is not finite is
///   left out; distances that are negative or NaN are 0: what is not known hides;
/// - `list` (listed > 0): u32, each below the number of probes;
/// - `irradiance` (written): irradiance and 1, maps of (irradiance_size + 2)^2 texels one behind the other: a border of one
///   texel around each holds what lies across the edge, so that look-ups are bilinear everywhere. 0 where a probe sees no
///   number;
/// - `moments` (written): mean and standard deviation of the distance in diagonals of a cage, maps of (moments_size + 2)^2;
/// - `previous_irradiance`, `previous_moments` (previous): like these. What is not finite counts as absent.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeIrradianceParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ProbeIrradianceParams& params, const Profile& profile);

/// The size that maps are averaged down to. `params` must be valid.
int probe_samples(const ProbeIrradianceParams& params);

/// Texels of maps with their border.
constexpr std::size_t probe_map_texels(std::size_t probes, int size) {
  return probes * static_cast<std::size_t>(size + 2) * static_cast<std::size_t>(size + 2);
}

}  // namespace luxel

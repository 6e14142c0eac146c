/// \file
/// probe_shade: irradiance at receivers from the eight probes around each, which count as far as they see the receiver (McGuire
/// et al., Real-Time Global Illumination using Precomputed Light Field Probes, 2017, 5.2). The maps: luxel/probe_irradiance.h.
#pragma once
#include <luxel/octahedral_march.h>

namespace luxel {

/// How much a probe counts by the cosine c between the receiver's normal and the direction to the probe.
enum class ProbeFacing {
  all,     ///< alike
  cosine,  ///< max(c, least_facing) (McGuire et al. 2017)
  smooth   ///< ((1 + c) / 2)^2 + least_facing (Majercik et al. 2019)
};

/// What a receiver gets that no probe sees.
enum class ProbeHidden {
  unfiltered,  ///< what it would get without visibility
  dark         ///< nothing: light fades to 0 as the share that is seen falls below least_visibility
};

/// Receivers (points with a normal) look up the eight probes around them.
struct ProbeShadeParams {
  ProbeGrid grid;        ///< 65535 probes at most; placed: probes with w = 0 in `positions` count nothing
  int width = 0;         ///< receivers in a row, 1..1048576
  int height = 1;        ///< rows of receivers, 1..65535
  int irradiance_size = 16;                  ///< of the maps, without their border, 4..128
  int moments_size = 16;  ///< the same of the moments
  Format irradiance_format = Format::f16x4;  ///< f32x4 with moments of f32x2, or f16x4 with f16x2

  bool visibility = true;       ///< probes count by Chebyshev's bound on how much of what they see lies beyond the receiver;
                                ///< false: there are no moments
  int sharpen = 3;              ///< power of that bound, 1..8
  double least_visibility = 1e-3;  ///< no bound is less, 1e-6..1
  ProbeHidden hidden = ProbeHidden::unfiltered;  ///< what lights receivers that no probe sees
  double footprint = 0.5;       ///< distances spread by at least this part of a texel of the moments, seen from the probe, 0..8
  ProbeFacing facing = ProbeFacing::smooth;  ///< how probes behind the surface count
  double least_facing = 0.05;   ///< 0..1
  double normal_bias = 0.35;    ///< probes look at a point above the surface, least spacings, 0..1
  bool count = false;           ///< adds `counters`
};

/// Outcomes, as the u32 values of `counters` that are added to.
enum class ProbeShadeOutcome {
  receivers,   ///< all
  degenerate,  ///< without a place or a normal (NaN, infinite, zero), or farther than 1e12 diagonals of a cage: 0
  outside,     ///< beyond the outermost probes along an axis that has several: lit by the nearest cage's, as if on its side
  hidden,      ///< seen by no probe: the share that is seen is no more than least_visibility
  lost,        ///< without any probe that counts: 0
  dropped      ///< probes whose look-ups were not finite; they count nothing
};
/// Words of `counters`.
constexpr int probe_shade_outcomes = 6;

/// Resources of the plan:
/// - `receivers`: two vec4 each: position (scene units) and any number; normal (any length) and any number. f32x4;
/// - `light`: the maps `irradiance` of probe_irradiance;
/// - `moments` (visibility): its maps `moments`;
/// - `positions` (grid.placed): a vec4 a probe, as ProbeGrid has it;
/// - `irradiance` (written): a vec4 each: irradiance, and the share of its probes' weight that sees the receiver, 0..1
///   (without visibility 1);
/// - `counters` (count): probe_shade_outcomes u32.
/// Along an axis with one probe that probe counts alone. Probes in one place share what falls to it. A receiver in a probe's
/// own place is seen by it, and faces it. Biases are in units of the grid: scenes of any scale look the same.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeShadeParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ProbeShadeParams& params, const Profile& profile);

}  // namespace luxel

/// \file
/// lpv_sample: irradiance and glossy radiance from light volumes at receivers; cascades; lpv_filter: a blur of a light
/// volume (Kaplanyan and Dachsbacher, Cascaded Light Propagation Volumes for Real-Time Indirect Illumination, 2010).
#pragma once
#include <luxel/light_propagation.h>

namespace luxel {

/// Receivers (points with a normal) look up light volumes.
struct LpvSampleParams {
  std::vector<LpvGrid> grids;     ///< 1..3 cascades of one extent, finest first, each within the next one
  int receivers = 0;              ///< 1..16777216
  int bands = 2;                  ///< 2 or 3
  int channels = 3;               ///< 3, or 1: grey
  Format format = Format::f32x4;  ///< of the volumes: f32x4 or f16x4
  double offset = 0.5;            ///< look-ups are so many cells above the surface, -4..4: where lights were moved to
  double damping = 0;             ///< 0..1: how much of the light is dropped where it grows, along the normal, from behind the surface
  double blend = 2;               ///< cells over which a cascade gives way to the next at its sides, 0.125..extent / 2
  double gain = 1;                ///< the result is multiplied by it, > 0
  int glossy_steps = 0;           ///< 1..64: `specular` is wanted, the mean over so many cells along the mirror direction; 0: not
  bool per_area = true;           ///< volumes hold I / cell^2, as LpvInjectParams.per_area has it; false: I
  bool count = false;             ///< fills `outcomes`
};

/// Words of the resource `outcomes`.
enum class LpvSampleCount {
  inside,      ///< receivers that some cascade holds
  outside,     ///< that none holds: their result is 0
  degenerate,  ///< without normal, or with a position or normal that is not finite: their result is 0
  used         ///< this and the next two: receivers that read cascade 0, 1, 2
};

/// Resources: `light` (read; the volumes of all cascades, at lpv_sample_offset), `receivers` (read; two vec4 each: position,
/// scene units, and an unused value; normal, any length, and an unused value), `views` (read; with glossy_steps; a vec4
/// each: direction to the eye, any length), `irradiance` (written; a vec4 each: r, g, b and the share of light that cascades had, 1 inside,
/// 0 outside), `specular` (written; with glossy_steps; the same of mean radiance), `outcomes` (written; 8 u32; with count).
/// Look-ups are trilinear between the centres of cells, and take the outermost beyond these. What comes out negative
/// (lobes of few bands) is 0.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const LpvSampleParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const LpvSampleParams& params, const Profile& profile);

/// Pixels of `light` before a cascade's volume, a multiple of 64; after the last: of the whole. `params` must be valid. lpv_propagate's
/// result can be bound as that part (Named::first).
std::size_t lpv_sample_offset(const LpvSampleParams& params, int cascade);

/// Nested grids about a place (scene units): each has cells twice as wide as the one before, and begins at a multiple of
/// its cells, so that nothing flickers while the place moves. count: 1..3.
std::vector<LpvGrid> lpv_cascades(const std::array<int, 3>& extent, double cell, const std::array<double, 3>& centre,
                                  int count);

/// Which cascades receivers (as the resource holds them) read: what a cascade holds that none reads need not be injected
/// and propagated. `params` must be valid.
std::vector<bool> lpv_cascades_read(const LpvSampleParams& params, const std::vector<float>& receivers);

/// A light volume is averaged with its six neighbours, axis by axis.
struct LpvFilterParams {
  LpvGrid grid;                   ///< origin and cell have no influence
  int bands = 2;                  ///< 2 or 3
  int channels = 3;               ///< 1..4
  Format format = Format::f32x4;  ///< f32x4 or f16x4
  double weight = 0.25;           ///< of each neighbour along an axis, 0..1/3; 1/4: binomial
};

/// Resources: `src` (read), `dst` (written): light volumes. Sums are kept: beyond the grid is its outermost cell.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const LpvFilterParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const LpvFilterParams& params, const Profile& profile);

}  // namespace luxel

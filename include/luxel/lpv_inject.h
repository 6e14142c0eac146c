/// \file
/// lpv_inject, lpv_inject_geometry: small lights and pieces of surfaces into the volumes of light_propagation.h (Kaplanyan
/// and Dachsbacher, Cascaded Light Propagation Volumes for Real-Time Indirect Illumination, 2010).
///
/// A light of flux F and normal n has the intensity F / pi <n|w>+ (F is what passes its hemisphere; that of a texel of a
/// reflective shadow map is albedo, times irradiance, times area). Sums are integers of 96 bits: they do not depend on the
/// order of lights, and are the same on every device.
#pragma once
#include <luxel/light_propagation.h>

namespace luxel {

/// Small lights are added to an empty light volume.
struct LpvInjectParams {
  LpvGrid grid;                   ///< the device subtracts origin in float: far from 0, rebase lights and origin on the host
  int lights = 0;                 ///< 0..16777216
  int bands = 2;                  ///< 2 or 3
  int channels = 3;               ///< 3, or 1: the first of each flux
  Format format = Format::f32x4;  ///< of the volume: f32x4 or f16x4
  double flux_max = 1;            ///< largest flux of a channel, 1e-30..1e30. Lights of 2^-48 of it and more are summed exactly,
                                  ///< weaker ones are rounded, below 2^-70 of it nothing is left; stronger ones count as this,
                                  ///< and as saturated
  double offset = 0.5;            ///< lights are moved so many cells along their normals, off their own surfaces, -4..4
  bool per_area = true;           ///< the volume holds I / cell^2, radiance, which does not change with the scene's scale; false: I
  bool count = false;             ///< fills `outcomes`
};

/// Words of the resource `outcomes`.
enum class LpvInjectCount {
  injected,   ///< lights (or surfels) in the sums
  outside,    ///< dropped: not in the grid once moved
  invalid,    ///< dropped: NaN, infinite, or a flux (area) below 0
  saturated   ///< among the injected: above flux_max (area_max)
};

/// Resources: `lights` (read; three vec4 each: position, scene units; normal, any length; flux, r, g, b. The fourths are
/// unused), `injected` (written: the whole light volume), `outcomes` (written; 4 u32; with count).
/// A cell holds the places q with cell <= q < cell + 1 in each coordinate: a light on a face belongs to the cell behind it, one
/// on the grid's last face is outside. A light without normal (0, or shorter than 1e-30) sends F / (4 pi) everywhere and is
/// not moved.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const LpvInjectParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const LpvInjectParams& params, const Profile& profile);

/// Surfels are added to a geometry volume.
struct LpvInjectGeometryParams {
  LpvGrid grid;                   ///< as the light's
  std::array<int, 4> surfels{0, 0, 0, 0};  ///< of each source (a reflective shadow map, a G-buffer ...), 0..4194304 in all; in
                                  ///< the list they follow each other. Sources see the same surfaces: in each corner the one
                                  ///< with the largest c0 counts, never their sum
  Format format = Format::f32x4;  ///< of the volume: f32x4 or f16x4
  double area_max = 4;            ///< largest area of a surfel, squared cells, 2^-20..64; larger ones count as this
  double offset = 0;              ///< surfels are moved so many cells along their normals, -4..4
  bool two_sided = false;         ///< surfels block from their backs as well: area |<n|w>| / cell^2, of which 2 bands hold the mean
  bool keep = false;              ///< the volume `kept` is one source more: static surfaces, injected once
  bool count = false;             ///< fills `outcomes` (LpvInjectCount)
};

/// Resources: `surfels` (read; two vec4 each: position, scene units, and area, squared scene units; normal, any length, and
/// an unused value), `kept` (read; with keep; a geometry volume of the same format), `geometry` (written: the whole geometry volume), `outcomes`
/// (written; 4 u32; with count).
/// A surfel adds area <n|w>+ / cell^2 to the nearest corner of the grid, and is outside where that is none. Without normal it
/// blocks as the mean over all normals does.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const LpvInjectGeometryParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const LpvInjectGeometryParams& params, const Profile& profile);

}  // namespace luxel

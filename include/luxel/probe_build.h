/// \file
/// probe_build: octahedral maps of probes from ray-caster hits, latitude-longitude images or cubes; and their minimum map.
#pragma once
#include <luxel/octahedral_march.h>

namespace luxel {

/// What was seen is given as.
enum class ProbeSource {
  texels,    ///< one value a texel, for its centre's direction: a ray caster's hits
  equirect,  ///< latitude-longitude images: row r of H lies at t = (r + 1/2) / H pi from +y, column c of W at
             ///< p = ((c + 1/2) / W - 1/2) 2 pi: direction (sin t cos p, cos t, sin t sin p)
  cube       ///< six square images a probe: +x -x +y -y +z -z, each laid out as OpenGL and Vulkan do
};

/// Maps of probes are made from what was seen at their places.
struct ProbeBuildParams {
  ProbeMaps maps;  ///< what is made
  int probes = 1;                ///< 1..65536
  ProbeSource source = ProbeSource::texels;  ///< from what
  /// Pixels.
  int width = 0, height = 0;     ///< of an image, of a cube's face (equal); 1..8192; texels: 0
  int samples = 1;               ///< radiance from images: a texel is the mean of samples^2 directions, 1..16; take
                                 ///< about the image's pixels along a texel's side
  bool planar = false;           ///< cube: distances are depths along the face's axis
  double unit = 1;               ///< f16: scene units that 1 stands for (probe_unit), > 0
  bool radiance = true;          ///< its map is made
  bool distance = true;          ///< its map is made and, where maps.ratio > 1, the minimum map; normals: as maps.normal says
};

/// Resources of the plan, of all probes one behind the other:
/// - `radiance_source`: a vec4 a pixel (texel): linear r, g, b; looked up bilinearly. NaN, infinity and what is below 0
///   count as 0;
/// - `distance_source`: f32x1 a pixel: radial distance in scene units, 1e30 and above (or infinite): no surface; of the nearest
///   pixel. NaN and what is below 0 is stored as 0: the probe knows nothing there;
/// - `normal_source`: a vec4 a pixel: normal of any length; of the nearest pixel;
/// - `radiance`, `distances`, `minimum`, `normals` (written): as ProbeMaps says.
/// Only what the maps hold is there. Radiance may also be written by other means, for further bounces: probe_shade with the
/// texels' points as receivers, texel i of probe p at position + distances[i] * direction(i), gives the irradiance to
/// multiply by albedo / pi; the maps of distance and normals stay as they are.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeBuildParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ProbeBuildParams& params, const Profile& profile);

/// The minimum map alone: `distances` in, `minimum` out (written).
struct ProbeMinimumParams {
  ProbeMaps maps;  ///< ratio of at least 2
  int probes = 1;  ///< of the maps, 1..65536
};
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ProbeMinimumParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ProbeMinimumParams& params, const Profile& profile);

}  // namespace luxel

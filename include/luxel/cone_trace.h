/// \file
/// cone_trace: diffuse irradiance, ambient occlusion and glossy radiance gathered by cones from a pyramid of voxels
/// (Crassin et al., Interactive Indirect Illumination Using Voxel Cone Tracing, 2011).
#pragma once
#include <functional>
#include <vector>

#include <luxel/plan.h>

namespace luxel {

/// A cone of a set, in the frame of the receiver's normal.
struct Cone {
  std::array<double, 3> direction{0, 0, 1};  ///< z along the normal; any length but 0
  double weight = 1;                         ///< > 0; a set's are scaled to sum to 1
  double aperture = 0;                       ///< full angle, radians, 0..2.6
};

/// A set of 1, 4, 5, 6, 8, 9, 16 or 25 cones whose weighted sum over caps of that aperture equals the cosine-weighted
/// mean of every function of the spherical-harmonics bands 0 and 1 (1 cone), 0..2 (4, 5, 6), 0..3 (8, 9), 0..4 (16) and
/// 0..6 (25): rings at the nodes of the Gauss rule (Gauss-Radau with a cone along the normal) of the cosine lobe
/// divided, band by band, by the cap's own coefficients. `aperture`: full angle in radians, 0 takes the set's own: for
/// 6 cones 60 degrees, else such that the caps cover 4/5 of the hemisphere (for 1 what band 1 asks for, 141 degrees).
/// Errors: invalid_argument for another count, or an aperture at which no such set of cones above the horizon exists.
Result<std::vector<Cone>> cone_set(int count, double aperture = 0);

/// The six cones of 60 degrees that Crassin 2011 is usually implemented with: weights 1/4 along the normal and 3/20 at 60
/// degrees from it. They return .875 of band 1 and .505 of band 2.
std::vector<Cone> classic_cones();

/// What a set, of caps, returns of each band 0..6 of the cosine-weighted mean, where the cosine lobe has that band (0, 1,
/// 2, 4, 6); and the largest response to a harmonic that it should not respond to (of any order, or of bands 3 and 5),
/// all harmonics normalised to a maximum of about 1.
struct ConeSetResponse {
  std::array<double, 7> band{};   ///< 1: exact; 0 where the lobe has none
  std::array<double, 7> stray{};  ///< 0: exact
};
/// Measures a set. `cones`: at least one.
ConeSetResponse cone_set_response(const std::vector<Cone>& cones);

/// Root mean square and maximum error of the cosine-weighted visibility of random half-spaces through a set of caps.
struct HalfSpaceError {
  double rms = 0;  ///< in parts of full visibility
  double max = 0;  ///< the same
};
/// Measures a set at `samples` half-spaces, the same in every call.
HalfSpaceError cone_set_half_spaces(const std::vector<Cone>& cones, int samples = 20000);

/// Which volumes the coarse levels are.
enum class ConeVariant {
  isotropic,   ///< coarse levels by mip_build's isotropic; the opacity of every level is per finest voxel
  anisotropic  ///< coarse levels by mip_build's anisotropic; the opacity of each is per voxel of its level
};

/// Receivers (points with a normal) are lit by cones through the levels of a volume.
struct ConeTraceParams {
  int width = 0;   ///< receivers in a row, 1..1048576
  int height = 1;  ///< rows of receivers, 1..65535
  std::array<int, 3> extent{0, 0, 0};  ///< of the finest level, x, y, z, each 1..2048 (Input::image: from 4 on)
  int levels = 0;  ///< levels that are read, the finest counts; 0: all, until every extent is 1
  ConeVariant variant = ConeVariant::isotropic;  ///< of the coarse levels
  Format format = Format::f32x4;     ///< of the volumes: f32x4, f16x4, unorm8x4
  Input input = Input::buffer;       ///< buffer (interpolated in code), or image: sampled, through the linear sampler
  std::array<double, 3> origin{0, 0, 0};  ///< outer corner of voxel (0,0,0), scene units. The device subtracts it in float:
                                          ///< far from 0, rebase receivers and origin on the host
  double voxel = 1;                  ///< side of a finest voxel, scene units, > 0

  /// A clipmap in place of a pyramid, as voxelize's moving windows fill it: levels of the same extent (multiples of 8, from
  /// 16 on), each with voxels twice as wide as those of the level before, whose windows lie one in another
  /// (cone_trace_windows); isotropic, in buffers. A sample takes the coarser of the level that fits the cone and of the
  /// finest window that holds it; lengths that count voxels count those that the windows hold there.
  std::vector<std::array<int, 3>> clipmap = {};  ///< first voxel of each level's window, in voxels of the level from `origin`,
                                     ///< finest first, -2^20..2^20; 2..16 levels. Empty: a pyramid
  double clipmap_border = 0;         ///< voxels over which a level gives way to the next at its window's sides, 0.5..extent / 4;
                                     ///< 0: an eighth of the least extent
  bool clipmap_own_length = true;    ///< opacity is per voxel of its level, as levels that are voxelized each have it; false:
                                     ///< per finest voxel, as the levels of an isotropic pyramid have it

  std::vector<Cone> cones = {};      ///< empty: cone_set(6); at most 64
  int pattern_x = 1;                 ///< 1..64: interleaved sampling (Keller and Heidrich 2001): the cones are dealt to the
                                     ///< pattern_x * pattern_y receivers of a tile, which together have the whole set
  int pattern_y = 1;                 ///< rows of that tile, 1..64
  double footprint = 0.25;           ///< width of the voxels that are looked up, in diameters of the cone, 1/16..1. At 1
                                     ///< (Crassin 2011) a trilinear look-up is wider than the cone, and hides a floor from
                                     ///< itself; at 1/2 it has the variance of the cone's disc;
                                     ///< at 1/4 most errors against rays through the voxels were least (README)
  double specular_footprint = 0.4;   ///< the same for the specular cone, which stands for a whole lobe, 1/16..1
  double step_scale = 1;             ///< step along the axis, in such voxels (but at least that part of a finest one), 1/16..4
  double normal_offset = 1;          ///< cones start this many voxels above the surface, 0..64
  double start = 0;                  ///< cones gather from here on, voxels along the axis, 0..64
  double max_distance = 0;           ///< and up to here, scene units along the axis; 0: until they leave the volume
  bool rotate = false;               ///< the cones are turned about the normal, by one of 64 angles: a hash of `seed` and the
                                     ///< receiver's index (of its tile's first, with a pattern)
  int seed = 0;                      ///< of `rotate`, 0..2147483647
  double gamma = 0;                  ///< occlusion at distance r counts 1 / (1 + gamma r), per scene unit, >= 0
  std::array<double, 3> environment{0, 0, 0};  ///< radiance where a cone ends without being blocked; with a sky its factor
  int sky_size = 0;                  ///< 0: the environment is the same everywhere; else there is a sky, of levels of so many
                                     ///< points squared, 2..1024
  int sky_levels = 8;                ///< of the sky, 1..16
  double sky_aperture = 2.0943951023931953;  ///< full angle, radians, of the caps of its first level, 0.01..2.6; each
                                     ///< further one has half of it. Cones of these angles see it exact, others a blend
  double error = 0;                  ///< a cone ends once what is left cannot add more than this radiance, >= 0
  double radiance_max = 1;           ///< largest radiance of volume and environment, > 0
  int max_steps = 0;                 ///< of a cone, 0: as many as the longest may need

  bool radiance = true;              ///< irradiance is wanted
  bool occlusion = true;             ///< visibility is wanted
  bool specular = false;             ///< glossy radiance is wanted
  bool skip_empty = true;            ///< where the coarser of two levels is empty, the finer is not read; exact in f32x4
  bool count = false;                ///< adds `counters`
};

/// Outcomes, as the u32 values of `counters` that are added to. Each cone is one of opaque .. missed.
enum class ConeOutcome {
  cones,       ///< cones traced
  opaque,      ///< ended where no more than error / radiance_max passes
  left,        ///< left the volume
  reached,     ///< reached max_distance
  capped,      ///< reached max_steps
  missed,      ///< did not meet the volume
  not_finite,  ///< gave NaN or infinity; dropped (counted as no radiance and no occlusion)
  degenerate,  ///< receivers without a normal or place (zero, NaN or infinite); their result is 0
  look_ups     ///< trilinear look-ups of all cones
};
/// Words of `counters`.
constexpr int cone_outcomes = 9;

/// Resources of the plan:
/// - `fine`: level 0, premultiplied radiance and opacity, [z][y][x], tightly packed (Input::image: a 3-D image);
/// - `coarse` (levels > 1): all further levels in one buffer, at cone_trace_level_offset(); or one 3-D image of
///   cone_trace_atlas_extent(), each level at cone_trace_atlas_offset();
/// - `clipmap` (a clipmap, in place of both): all levels one after the other, voxel v of a level's world at v mod extent;
/// - `sky` (sky_size > 0): sky_levels * sky_size^2 vec4, as cone_sky makes them;
/// - `receivers`: two vec4 each: position (scene units) and roughness; normal (any length) and 0. f32x4;
/// - `views` (specular): a vec4 each, the direction to the eye, any length;
/// - `irradiance` (written; radiance or occlusion): a vec4 each: irradiance, and visibility 0..1 (1 - occlusion). What is
///   not wanted is 0, or 1. With a pattern, each holds an unbiased estimate, whose mean over a tile is meant;
/// - `specular` (written): a vec4 each: mean radiance over the lobe's cone, and visibility;
/// - `counters` (count): cone_outcomes u32.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const ConeTraceParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const ConeTraceParams& params, const Profile& profile);

/// Windows of a clipmap about a place (scene units): as near as whole voxels of each level come. `params`: extent, origin, voxel.
std::vector<std::array<int, 3>> cone_trace_windows(const ConeTraceParams& params, const std::array<double, 3>& centre,
                                                   int levels);

/// Levels that are read, and the extent of one in texels, as mip_build makes them. `params` must be valid.
int cone_trace_levels(const ConeTraceParams& params);
/// Extent of a level (0: the finest), texels.
std::array<int, 3> cone_trace_extent(const ConeTraceParams& params, int level);

/// Texels of the buffer `coarse` before a level (>= 1) of a direction (0..5 as MipDirections; isotropic: 0), a multiple of
/// 64; and of the whole buffer. mip_build's outputs can be bound as these parts (Named::first).
std::size_t cone_trace_level_offset(const ConeTraceParams& params, int level, int direction = 0);
/// Texels of the whole buffer `coarse`.
std::size_t cone_trace_coarse_texels(const ConeTraceParams& params);

/// The same for the image of all coarse levels: side by side along x, directions one behind the other along z.
std::array<int, 3> cone_trace_atlas_offset(const ConeTraceParams& params, int level, int direction = 0);
/// Extent of that image, texels.
std::array<int, 3> cone_trace_atlas_extent(const ConeTraceParams& params);

/// The resource `sky`: for each level, the mean of `radiance` (of unit directions) over caps, at the points of an octahedral
/// map (Cigolle et al. 2014): point i of row j stands at (2 i / (size - 1) - 1, 2 j / (size - 1) - 1), +z in the middle. In
/// double, by `rays` (1..) directions a cap; 4 floats a point, the fourth 0. Points lie 180 / (size - 1) degrees apart
/// on the mean: narrower caps than that are blurred between them. `params` must be valid, with a sky.
std::vector<float> cone_sky(const ConeTraceParams& params,
                            const std::function<std::array<double, 3>(const std::array<double, 3>&)>& radiance,
                            int rays = 256);

/// Full angle, radians, of the cone that stands for the GGX lobe of a (perceptual) roughness 0..1: half of the cone's
/// solid angle and half of the lobe (with its masking, at normal incidence, above the horizon) lie within the same angle
/// of the mirror direction. Its mean would be wider: GGX has long tails.
double specular_aperture(double roughness);

}  // namespace luxel

/// \file
/// hiz_ssr: reflections found on the screen, by rays over a depth image (Uludag, Hi-Z Screen-Space Cone-Traced
/// Reflections, GPU Pro 5, 2014; McGuire and Mara, Efficient GPU Screen-Space Ray Tracing, 2014).
#pragma once
#include <luxel/mip_build.h>

namespace luxel {

/// How rays are followed over the depth image.
enum class SsrVariant {
  hiz,    ///< a pyramid of nearest depths: up a level where nothing is near, down where something may be
  dda,    ///< every pixel along the ray; the same pixels are hit as by hiz, to the bit
  linear, ///< uniform steps in view space and a binary search: the crude baseline, which misses what lies between
  stochastic  ///< hiz along directions of the GGX lobe; hits are shared with the pixels around (Stachowiak 2015)
};

/// What a depth image holds of a surface at depth d, its distance from the camera along the view axis.
enum class SsrDepth {
  linear,   ///< d; 1e10 and above, infinity and NaN: no surface
  standard, ///< 0 at the near plane, 1 at the far plane, (1/near - 1/d) / (1/near - 1/far); 1 and above, NaN: no surface
  reversed  ///< 1 minus that; 0 and below, NaN: no surface
};

/// View space is right-handed, x right, y up, the camera looks along -z. Pixel (0, 0) is the top left one, pixel
/// coordinates are 0 at its outer corner; a point (x, y, -d) is seen at (centre_x + focal_x x / d, centre_y - focal_y y / d).
struct HizSsrParams {
  int width = 0;   ///< of the depth image, pixels, 1..65535
  int height = 0;  ///< 1..65535
  SsrVariant variant = SsrVariant::hiz;  ///< how rays are followed
  SsrDepth depth = SsrDepth::linear;  ///< what the depth image holds
  double near_plane = 0.01;  ///< scene units, > 0: rays that come back to this depth end there, behind the camera
  double far_plane = 0;      ///< > near_plane, or 0 for infinite; of standard and reversed depth alone
  double focal_x = 0;        ///< pixels, > 0: width / (2 tan(half the horizontal field))
  double focal_y = 0;        ///< pixels, > 0
  double centre_x = 0;       ///< pixel coordinates of the view axis
  double centre_y = 0;  ///< the same along y, from the top
  int rays = 0;              ///< > 0: rays of a list are followed; 0: rays of the pixels

  int levels = 0;            ///< hiz: levels of the pyramid that are read, level 0 counts; 0: all
  int start_level = 0;       ///< hiz: the level that rays start on
  int max_steps = 0;         ///< looks at the depth image a ray; 0: as many as the longest may need
  int steps = 64;            ///< linear: along a ray, 1..65536
  int refinements = 6;       ///< linear: halvings of a step, 0..24
  double thickness = 1e30;   ///< of surfaces behind what is seen, scene units along the view axis, >= 0 or infinite
  double max_distance = 0;   ///< length of rays, scene units; 0: without end (linear: must be given)
  double bias = 0.5;         ///< mirror rays start in front of the surface by its slope over this many pixels, 0..64; from
                             ///< 0.5 on no plane hits itself
  double cutoff = 1;         ///< roughness from which on pixels do not reflect, 0..2
  double fade_edge = 0.05;   ///< confidence falls to 0 over this part of the image at its edges, 0..0.5
  double fade_distance = 0;  ///< over this last part of max_distance, 0..1
  double fade_thickness = 0; ///< at the back of a surface by this much, 0..1
  double fade_back = 1;      ///< at the back of a surface that looks away by this much, 0..1 (mirror rays)
  bool count = false;        ///< adds `counters`

  int rays_per_pixel = 1;    ///< stochastic: 1..4
  bool half_resolution = false;  ///< stochastic: one pixel of 2 x 2 is traced
  int reuse = 1;             ///< stochastic: pixels (of those that are traced) around one whose rays it takes, 0..4
  int seed = 0;              ///< stochastic: 0..16777215; another for every frame
  bool shade = false;        ///< mirror and stochastic rays: adds `colour` and `radiance`
  int colour_levels = 0;     ///< shade: levels of `colour`, level 0 counts; 0: all
  double prefilter = 1;      ///< shade: width of what is looked up in `colour`, in widths of the part of the lobe that a ray
                             ///< stands for, 0..16; 0: always the pixel that was hit
  std::array<double, 3> environment{0, 0, 0};  ///< shade: radiance where nothing was found
  bool fallback = false;     ///< shade: a buffer `fallback` takes the environment's place
  bool factor = false;       ///< shade: `radiance` is multiplied by F0 A + B; adds `specular` and `split_sum`
  int split_sum_size = 32;   ///< factor: of the table, 2..1024
};

/// How a ray ended: paths[4 i + 1], and the u32 of `counters` that are added to. A step cap is never a hit.
enum class SsrOutcome {
  none,        ///< no ray: no surface, or too rough (not counted)
  hit,         ///< the ray's depths within the pixel meet [d, d + thickness] of the surface there
  miss,        ///< reached max_distance or infinity within the image
  left,        ///< left the image
  behind,      ///< came back to the near plane
  capped,      ///< reached max_steps
  degenerate,  ///< no direction (zero or NaN), a normal that looks away, or a direction below the surface
  rays,        ///< counters alone: all of hit .. capped
  hidden,      ///< counters alone: rays of any outcome that passed behind a surface, so that what they met may be hidden
  steps        ///< counters alone: looks at the depth image
};
/// Words of `counters`.
constexpr int ssr_outcomes = 10;

/// Resources of the plan:
/// - `depth`: f32x1, level 0, tightly packed, rows from the top; hiz: and all levels behind it, at
///   hiz_ssr_level_offset(), each the nearest depth below it, as mip_build's outputs with hiz_ssr_pyramid();
/// - `normals` (mirror rays): a vec4 a pixel: normal in view space (any length) and roughness;
/// - `rays` (rays of a list): two vec4 a ray: origin in view space and reach (0: max_distance); direction (any length), 0;
/// - `hits` (written): a vec4 a ray: u, v (0..1, from the top left), depth of the ray where it meets the surface,
///   confidence 0..1; zeros unless hit;
/// - `paths` (written): a vec4 a ray: length in scene units, SsrOutcome, 1 where it passed behind a surface, looks;
/// - `counters` (count): ssr_outcomes u32;
/// - `directions` (written; stochastic): a vec4 a ray: unit direction, density per steradian that it was drawn
///   with; undefined where there is no ray (none, degenerate);
/// - `colour` (shade): a vec4 a pixel: radiance that the screen shows, and all levels behind it, at hiz_ssr_colour_offset(), as
///   mip_build's outputs with hiz_ssr_colours();
/// - `radiance` (written; shade): a vec4 a pixel: mean radiance in the specular lobe, and the part of it that was seen (0..1);
///   zeros where a pixel does not reflect;
/// - `fallback` (fallback): a vec4 a pixel: radiance in the lobe by other means;
/// - `specular` (factor): a vec4 a pixel: reflectance at normal incidence; `split_sum`: the table of SplitSumParams.
/// Rays of pixels: ray k of traced pixel (x, y) is number (k * traced height + y) * traced width + x, where half resolution
/// traces half the width and height, rounded up. Only tiles of 8 x 8 traced pixels with a pixel that reflects are traced and
/// resolved: by a list, over which a fixed launch strides.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const HizSsrParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const HizSsrParams& params, const Profile& profile);

/// The pyramid that hiz reads, as mip_build makes it, and how many levels that is with level 0 (1: none is made).
MipBuildParams hiz_ssr_pyramid(const HizSsrParams& params);
/// How many levels that is with level 0 (1: none is made).
int hiz_ssr_levels(const HizSsrParams& params);

/// Texels of `depth` before a level, a multiple of 64 (mip_build's outputs can be bound as these parts, Named::first); and of
/// the whole buffer.
std::size_t hiz_ssr_level_offset(const HizSsrParams& params, int level);
/// Texels of the whole buffer `depth`.
std::size_t hiz_ssr_depth_texels(const HizSsrParams& params);

/// The same for colour.
MipBuildParams hiz_ssr_colours(const HizSsrParams& params);
/// How many levels that is with level 0 (1: none is made).
int hiz_ssr_colour_levels(const HizSsrParams& params);
/// Texels of `colour` before a level, a multiple of 64.
std::size_t hiz_ssr_colour_offset(const HizSsrParams& params, int level);
/// Texels of the whole buffer `colour`.
std::size_t hiz_ssr_colour_texels(const HizSsrParams& params);

/// Rays that a plan follows: of the list, or of all traced pixels.
std::size_t hiz_ssr_rays(const HizSsrParams& params);

/// The table that `factor` reads: what a GGX surface mirrors of an even environment is F0 A + B (Karis 2013, second sum).
struct SplitSumParams {
  int size = 32;       ///< along both axes, 2..1024
  int samples = 1024;  ///< an entry, 1..65536
};

/// Resource of the plan: `split_sum` (written), f32x2, size * size: A and B; columns: cosine of the view direction, rows:
/// roughness, at (i + 1/2) / size. Errors: invalid_argument.
Status validate(const SplitSumParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const SplitSumParams& params, const Profile& profile);

/// Sets focal lengths and centre to a symmetric view with this vertical field, radians, above 0 and below pi, and square
/// pixels.
void set_field(HizSsrParams& params, double vertical_field);

}  // namespace luxel

/// \file
/// mip_build: coarser levels of images and volumes: means of premultiplied colour, directional volumes, bounds, moments
/// (Akenine-Moeller et al., Real-Time Rendering 4e, 2018, 11.5.7 and 11.6.5; Crassin et al. 2011).
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// What a coarser texel holds of those below it.
enum class MipVariant {
  isotropic,    ///< mean of 2 x 2 x 2 of premultiplied colour and opacity; the latter stays that of a finest voxel
  anisotropic,  ///< six volumes, one a direction: pairs composited front to back, then the mean of four; opacity of a
                ///< path through a voxel of the level
  gaussian3,    ///< 1-2-1 (vertices) or 1-3-3-1 (cells) along each axis
  min,          ///< lower bound
  max,          ///< upper bound
  minmax,       ///< both, in two channels
  moments       ///< mean and standard deviation, in two channels, blended as mixtures
};

/// Sizes of the levels of bounds. Averages halve and round down.
enum class MipSizes {
  floor,  ///< as image mips; the last texel covers what is left over; texel p lies under min(p >> l, size - 1)
  ceil    ///< texel p lies under p >> l
};

/// Where gaussian3's samples are.
enum class MipSamples { cells, vertices };

/// A set of directions of anisotropic, one bit each. px: seen by who looks along +x.
enum MipDirections : unsigned { mip_px = 1, mip_nx = 2, mip_py = 4, mip_ny = 8, mip_pz = 16, mip_nz = 32, mip_all = 63 };

/// Levels are made from level 0.
struct MipBuildParams {
  int width = 0;    ///< texels of level 0, 1..65535
  int height = 0;   ///< 1..65535
  int depth = 1;    ///< 1..65535; 1 for bounds and moments
  int levels = 0;   ///< levels that are made; 0: until every extent is 1 (ratio 16: one)
  MipVariant variant = MipVariant::isotropic;  ///< what a coarser texel holds
  /// Of the levels that are made: f32x1, f32x4, f16x4, unorm8x4 (isotropic, gaussian3), f32x4, f16x4, unorm8x4
  /// (anisotropic), f32x1 (min, max), f32x2, f16x2 (minmax, moments).
  Format format = Format::f32x4;
  Input input = Input::buffer;      ///< how level_0 is bound
  bool pairs = false;               ///< minmax, moments: level_0 holds pairs in `format`, else single values, f32x1
  MipSizes sizes = MipSizes::floor; ///< bounds
  int ratio = 2;                    ///< bounds: 2, or one step of 16
  MipSamples samples = MipSamples::cells;  ///< gaussian3
  unsigned directions = mip_all;    ///< anisotropic: the volumes that are made
  bool count = false;               ///< adds `counters`: see below; not for unorm8x4
};

/// Resources of the plan: `level_0` (read), `level_1`, `level_2`, ... (written), tightly packed, rows from the top,
/// slice after slice; anisotropic: `level_1_px`, `level_1_nx`, `level_1_py`, ... for each direction that is made. With
/// count: `counters`, four u32 that are added to (texels of level_0 whose colour was dropped for having no opacity and
/// no finite value; other texels with a NaN; other texels with an infinity; unused). No scratch.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const MipBuildParams& params);

/// The passes that make the levels on a device of this profile.
Result<Plan> plan(const MipBuildParams& params, const Profile& profile);

/// Extent of a level in texels (level 0 is the input's). `params` must be valid.
std::array<int, 3> mip_extent(const MipBuildParams& params, int level);

/// How many levels are made. `params` must be valid.
int mip_levels(const MipBuildParams& params);

/// `level_3`, or `level_3_ny` (direction 0..5 in the order of MipDirections; -1: none).
std::string mip_level_name(int level, int direction = -1);

}  // namespace luxel

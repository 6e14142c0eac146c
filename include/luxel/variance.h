/// \file
/// variance: how far the luminance of noisy pixels spreads, in a window or over frames (Schied et al. 2017, 4.2).
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// Over what luminance spreads.
enum class VarianceVariant {
  spatial,  ///< over a window of (2R+1)^2 pixels
  temporal  ///< over frames; spatial where a pixel has been seen for fewer than `shortest`
};

/// The variance of pixels' luminance is estimated.
struct VarianceParams {
  int width = 0;        ///< pixels, 1..65535
  int height = 0;       ///< pixels, 1..65535
  int src_stride = 0;   ///< pixels from row to row, width..1048576; 0: width
  VarianceVariant variant = VarianceVariant::spatial;  ///< over what luminance spreads
  int radius = 3;       ///< pixels, 1..16
  double alpha = 0.2;   ///< temporal: least part that a new frame counts, 0..0.9; 0: all frames alike
  int shortest = 4;     ///< temporal: frames, 2..1024
  Format format = Format::f32x4;  ///< of src: f32x1, f32x2, f32x4, f16x4, unorm8x4
};

/// Resources of the plan: `src`; `variances` (f32x1), the variance of one pixel's luminance; temporal: `history` and
/// `history_out` (three f32 a pixel: mean, variance, frames seen; zeros begin), brought to this frame's pixels by the
/// caller. Pixels that are not finite do not count. Errors: invalid_argument, naming field, value and range.
Status validate(const VarianceParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const VarianceParams& params, const Profile& profile);

}  // namespace luxel

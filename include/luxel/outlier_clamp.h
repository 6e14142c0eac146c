/// \file
/// outlier_clamp: fireflies and dark specks of noisy images, clamped to what their neighbours say before they are filtered.
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// What the limits are made of.
enum class OutlierVariant {
  mean,   ///< mean +- k standard deviations of the neighbours
  median  ///< median +- k 1.4826 median absolute deviations: stays firm where several neighbours are outliers too
};

/// Pixels far off their neighbours are brought nearer.
struct OutlierClampParams {
  int width = 0;       ///< pixels, 1..65535
  int height = 0;      ///< pixels, 1..65535
  int src_stride = 0;  ///< pixels from row to row of src, width..1048576; 0: width
  int dst_stride = 0;  ///< the same of dst
  OutlierVariant variant = OutlierVariant::mean;  ///< what the limits are made of
  int radius = 2;      ///< pixels on each side, 1..3: 8, 24 or 48 neighbours
  double k = 3;        ///< deviations that are let through, 0..1e6
  Format format = Format::f32x4;  ///< of src and dst: f32x1, f32x4, f16x4
  bool count = false;  ///< `counters`: pixels clamped [0], pixels that were not finite [1]
};

/// Resources of the plan: `src`, `dst`; `counters` (2 uint, which the caller clears). Luminance is clamped and colour scaled
/// with it; alpha stays. A pixel that is not finite becomes grey of the neighbours' mean or median, with alpha 1; neighbours
/// that are not finite do not count. Errors: invalid_argument, naming field, value and range.
Status validate(const OutlierClampParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const OutlierClampParams& params, const Profile& profile);

}  // namespace luxel

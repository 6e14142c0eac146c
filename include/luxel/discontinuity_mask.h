/// \file
/// discontinuity_mask: where surfaces end between neighbouring pixels, by depth and normals; what bilateral's variant
/// `discontinuity` stops at (Segovia et al. 2006, discontinuity buffer).
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// Where an edge is drawn between two pixels.
struct DiscontinuityMaskParams {
  int width = 0;    ///< pixels, 1..65535
  int height = 0;   ///< pixels, 1..65535
  double depth_threshold = 0.02;   ///< parts of depth off both sides' planes, 0..1
  bool normal = true;              ///< look at normals too
  double normal_threshold = 0.9;   ///< cosine between neighbouring normals, -1..1
  Format normal_format = Format::f32x4;  ///< of `normals`: f32x4 or f16x4 (-1..1), unorm8x4 (n/2 + 1/2)
};

/// Resources of the plan: `depth` (f32x1, view space; 1e10 and more is sky), `normals`, `mask` (u32 a pixel: bit 0 an edge to
/// the right, 1 below, 2 left, 3 above; the image's border is an edge). Sky beside sky is none; a pixel whose depth is no
/// number, zero or negative is surrounded by edges. Errors: invalid_argument, naming field, value and range.
Status validate(const DiscontinuityMaskParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const DiscontinuityMaskParams& params, const Profile& profile);

}  // namespace luxel

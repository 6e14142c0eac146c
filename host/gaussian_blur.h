// The parts of gaussian_blur's host code: each variant adds its passes to the plan.
#pragma once
#include <luxel/gaussian_blur.h>

#include "host/planner.h"

namespace luxel {

/// Adds the passes from `from` to `to`. Sigma is above 0, and so large that a neighbour has a normal float weight.
void plan_recursive(const GaussianBlurParams& params, const Profile& profile, Planner& planner, Slot from, Slot to);

/// Values of the largest scratch region that plan_recursive asks for.
double recursive_scratch(const GaussianBlurParams& params);

}  // namespace luxel

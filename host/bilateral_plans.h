// The variants of bilateral that are kernels of their own.
#pragma once
#include <luxel/bilateral.h>

namespace luxel {

/// The knobs of variant grid, and the terms that grid and discontinuity do not have.
Status validate_grid(const BilateralParams& params);
Status validate_terms(const BilateralParams& params);

/// For parameters that are valid.
Result<Plan> plan_grid(const BilateralParams& params, const Profile& profile);
Result<Plan> plan_discontinuity(const BilateralParams& params, const Profile& profile);

}  // namespace luxel

// Extreme and stiff cases of lpv_inject, lpv_inject_geometry, lpv_sample and lpv_filter.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> lpv_inject_cases();
std::vector<Case> lpv_geometry_cases();
std::vector<Case> lpv_sample_cases();

}  // namespace luxel::cases

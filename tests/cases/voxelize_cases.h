// Extreme and stiff cases of voxelize.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> voxelize_cases();

}  // namespace luxel::cases

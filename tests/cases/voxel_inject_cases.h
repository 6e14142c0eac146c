// Extreme and stiff cases of voxel_inject.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> voxel_inject_cases();

}  // namespace luxel::cases

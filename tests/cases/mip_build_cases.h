// Extreme and stiff cases of mip_build.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> mip_build_cases();

}  // namespace luxel::cases

// Extreme and stiff cases of bilateral.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> bilateral_cases();

}  // namespace luxel::cases

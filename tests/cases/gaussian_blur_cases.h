// Extreme and stiff cases of gaussian_blur.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> gaussian_blur_cases();

}  // namespace luxel::cases

// Extreme and stiff cases of hiz_ssr.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> hiz_ssr_cases();

}  // namespace luxel::cases

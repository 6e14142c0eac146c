// Extreme and stiff cases of probe_irradiance and probe_shade.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> probe_cases();

}  // namespace luxel::cases

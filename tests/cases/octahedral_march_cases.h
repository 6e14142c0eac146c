// Extreme and stiff cases of octahedral_march: maps, building and tracing.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> octahedral_march_cases();

/// The same in these files, in the order of octahedral_march_cases().
void add_probe_ray_cases(std::vector<Case>& cases);
void add_probe_value_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

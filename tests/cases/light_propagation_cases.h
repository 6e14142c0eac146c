// Extreme and stiff cases of light_propagation.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> light_propagation_cases();

/// Cases in these files, in the order of light_propagation_cases().
void add_lpv_flux_cases(std::vector<Case>& cases);
void add_lpv_value_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

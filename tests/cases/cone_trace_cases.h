// Extreme and stiff cases of cone_trace.
#pragma once
#include "tests/cases/case.h"

namespace luxel::cases {

std::vector<Case> cone_trace_cases();

/// The same in these files, in the order of cone_trace_cases().
void add_cone_furnace_cases(std::vector<Case>& cases);
void add_cone_value_cases(std::vector<Case>& cases);
void add_cone_place_cases(std::vector<Case>& cases);
void add_cone_scene_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

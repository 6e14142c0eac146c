// What the rows of bilateral share: how they name a setting, and its inputs.
#pragma once
#include <initializer_list>
#include <utility>
#include <vector>

#include <luxel/bilateral.h>

#include "bench/report/cell.h"
#include "tests/cases/run.h"

namespace luxel::report {

/// "separable, adaptive".
std::string variant_text(const BilateralParams& p);
Cell options_of(const BilateralParams& p);
Cell knobs_of(const BilateralParams& p);

/// Writes those of the inputs that the plan has.
Status write_inputs(cases::Run& run, std::initializer_list<std::pair<const char*, const std::vector<double>*>> inputs);

}  // namespace luxel::report

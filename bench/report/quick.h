// What a quick report leaves out.
#pragma once
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// Removes what only a whole report measures: every variant stays, at one setting or a few. Drivers take about a second to
/// compile each setting, which is most of a report's time.
void keep_quick(std::vector<Job>& jobs);

}  // namespace luxel::report

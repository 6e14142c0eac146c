// The extreme cases of the kernels as jobs of the report.
#pragma once
#include "bench/report/session.h"
#include "tests/cases/case.h"

namespace luxel::report {

/// A stability row for each case that applies to the device; quick reports leave out slow ones.
std::vector<Job> stability_jobs(Session& session, const std::vector<cases::Case>& cases);

}  // namespace luxel::report

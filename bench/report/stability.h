// The extreme cases of the kernels as jobs of the report.
#pragma once
#include "bench/report/session.h"
#include "tests/cases/case.h"

namespace luxel::report {

/// A stability row for each case that applies to the device. Quick reports leave out slow ones, and measure all others
/// on the C++ execution alone: a driver, which compiles most of them anew, takes the first and the last of each kind
/// (names that are equal up to a comma or a digit), and `luxel stability` every growth, unless rows were asked for by name.
std::vector<Job> stability_jobs(Session& session, const std::vector<cases::Case>& cases);

}  // namespace luxel::report

// The settings of a kernel that lie on its frontiers' panels, as jobs.
#pragma once
#include "bench/report/session.h"

namespace luxel::report {

/// Every job of a kernel (one of measured_kernels()) that makes frontier rows of its own settings: peers, limits, claims and
/// extreme cases are not among them. `scenes`: also those in whole scenes and renders, where the kernel has a grid of its own
/// without. `missing`: a line for each file that is not there.
std::vector<Job> grid_jobs(Session& session, const std::string& kernel, bool scenes, std::vector<std::string>& missing);

}  // namespace luxel::report

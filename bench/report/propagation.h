// What the report measures of lpv_propagate.
#pragma once
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// Frontier: forms for negative lobes, bands, formats, iterations, by two metrics: the irradiance that a light sends
/// against the linear operator in double, and against the inverse square.
std::vector<Job> propagation_grid(Session& session);
std::vector<Job> propagation_left_out(Session& session);
std::vector<Job> propagation_reproduction(Session& session);
/// The driver's best copy, and its triad, of as many bytes.
std::vector<Job> propagation_peers(Session& session);

}  // namespace luxel::report

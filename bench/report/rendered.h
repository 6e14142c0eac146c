// Whole scenes on the frontier: indirect light by voxels and cones against path tracing.
#pragma once
#include <string>
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// Scenes, resolutions, cone sets and both kinds of pyramid: irradiance after one bounce at what a camera sees, against the
/// path-traced truth of the same receivers. method: all of the error; discretization: what exhaustive rays through the
/// same voxels are off by; model: what cones add to that. `missing` receives a line for each scene file that is absent.
std::vector<Job> rendered_grid(Session& session, std::vector<std::string>& missing);

}  // namespace luxel::report

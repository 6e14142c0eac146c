// Rows of hiz_ssr: time and what is missed as rays grow longer, what leaving tiles out saves, looks beside a dependent march.
#pragma once
#include <string>
#include <vector>

#include "bench/report/bench.h"
#include "bench/report/session.h"

namespace luxel::report {

std::vector<Job> screen_grid(Session& session);
/// Reflected radiance against path tracing in atrium and Sponza, and thin features that walks miss.
std::vector<Job> screen_truth_grid(Session& session, std::vector<std::string>& missing);
std::vector<Job> screen_left_out(Session& session);
std::vector<Job> screen_peers(Session& session);

}  // namespace luxel::report

// What an update costs beside building everything anew: a window that scrolled, a light and an object that moved; and light
// from shadow maps of several resolutions.
#pragma once
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// Frontier rows: time_ms.build is everything anew, time_ms.update the update alone, in turn in one run.
std::vector<Job> update_jobs(Session& session);

/// Reproduction rows: which share of lit voxels a shadow map of N texels a voxel misses.
std::vector<Job> shadow_map_jobs(Session& session);

}  // namespace luxel::report

// Dense pyramids of voxels against a sparse octree of the same voxels: building and looking up.
#pragma once
#include <string>
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// The headline of Hong 2015, 4.4: mips in place of an octree. Rows of `reproduction`.
std::vector<Job> octree_reproduction(Session& session, std::vector<std::string>& missing);

}  // namespace luxel::report

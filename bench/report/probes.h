// Rows of octahedral_march: rays through probes beside rays through the scene, as resolution and number of probes grow, what is
// left out, claims of the source, and peers.
#pragma once
#include "bench/report/session.h"

namespace luxel::report {

std::vector<Job> probe_grid(Session& session);
std::vector<Job> probe_left_out(Session& session);
std::vector<Job> probe_reproduction(Session& session);
std::vector<Job> probe_peers(Session& session);

}  // namespace luxel::report

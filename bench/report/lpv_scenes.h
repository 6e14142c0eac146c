// Whole scenes in light propagation volumes: rows of lpv_inject, lpv_inject_geometry and lpv_sample, with lpv_propagate between.
#pragma once
#include <string>
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// Irradiance after one bounce at the receivers of cone_trace's rows, by grids, steps, forms of lobes, blockers and cascades.
/// method: all of the error; discretization: of the light's maps, as small lights with a shadow ray each in double; model: what the
/// volumes add to that. And the energy that leaks into the dark one of two_rooms. `missing` as in rendered_grid.
std::vector<Job> lpv_scene_grid(Session& session, std::vector<std::string>& missing);
/// A geometry volume where nothing blocks, three channels of grey light, cascades that no receiver reads, surfaces that
/// do not move.
std::vector<Job> lpv_scene_left_out(Session& session);

}  // namespace luxel::report

// Rows of probe_irradiance and probe_shade: light that probes gather, and receivers that they light.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/report/session.h"
#include "bench/report/stage.h"
#include "bench/scene/probe_scene.h"

namespace luxel::report {

/// Maps of one size after another against quadrature; whole scenes by number of probes, sizes and with and without visibility,
/// against path tracing; and what leaks into a dark room, by probes and by cones. method: all of the error; discretization: what
/// finer maps of the same probes take away; model: what is left then. `missing` as in rendered_grid.
std::vector<Job> probe_light_grid(Session& session, std::vector<std::string>& missing);
std::vector<Job> probe_light_left_out(Session& session);
std::vector<Job> probe_light_reproduction(Session& session);
std::vector<Job> probe_light_peers(Session& session);

/// The receivers of a stage, as the kernel takes them.
std::vector<float> probe_receivers(const Stage& stage);
/// The session's context, which outlives what holds it.
std::shared_ptr<Context> borrowed(Session& session);

}  // namespace luxel::report

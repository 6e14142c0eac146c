// What leaving out saves in a scene: the cones' picture made with and without work that the scene has no use for, in turn.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>

#include "bench/report/session.h"
#include "bench/report/stats.h"
#include "bench/scene/gbuffer.h"
#include "bench/scene/scene_plan.h"
#include "bench/scene/voxel_scene.h"

namespace luxel::report {

struct SceneSaving {
  std::string what;
  int level = 0;           // 1 code and bindings, 3 kernels
  Sample whole, saved;     // milliseconds of all steps with the work, and how much less it is without
  double saved_bytes = 0;  // of the device's memory
  double error = 0;        // the largest difference of what the pictures are made of
};

/// One for each thing that the scene has no use for, and one for all of them together. `resolution`: voxels along each side.
/// Errors: of the kernels.
Result<std::vector<SceneSaving>> scene_savings(std::shared_ptr<Context> context, const scene::Scene& scene,
                                               const scene::Rays& rays, const scene::GBuffer& gbuffer, int resolution,
                                               int repeats);

/// Rows of `left_out` for whole scenes; atrium and Sponza under the sun alone, since a sky has a use for all but gloss.
std::vector<Job> scene_left_out(Session& session, std::vector<std::string>& missing);

}  // namespace luxel::report

// Methods of `luxel render`: how the light at the pixels of a G-buffer is found.
#pragma once
#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "bench/io/image.h"
#include "bench/scene/compose.h"
#include "bench/scene/lpv_scene.h"
#include "bench/scene/probe_scene.h"
#include "bench/scene/screen.h"
#include "bench/scene/voxel_scene.h"
#include "bench/truth/path_truth.h"

namespace luxel::program {

/// What a method is given. `scene` holds the lights and the camera of the command line.
struct RenderInput {
  const scene::Scene& scene;
  const scene::Rays& rays;
  const scene::GBuffer& gbuffer;
  std::string device;             // as --device names it; empty: the first that works
  truth::PathSettings settings;   // ambient occlusion's falloff and reach hold for every method
  scene::VoxelSceneSettings voxels;
  ConeTraceParams cones;          // how they are traced; volumes and receivers are the method's own
  HizSsrParams screen;            // of ssr: how rays walk; view and resources are the method's own
  scene::ProbeSceneSettings probes;  // of probe
  ProbeShadeParams by_probes;     // of probe: visibility, facing and biases; grid and receivers are the method's own
  scene::LpvSceneSettings lpv;    // of lpv; `centre` and `seen` are the method's own
  LpvSampleParams by_lpv;         // of lpv: how volumes are looked up; grids and receivers are the method's own
};

/// Milliseconds that a step took; `phase` is build (once for a scene), update (once for a change of light) or shade (once
/// for a picture).
struct StepTime {
  std::string phase, step;
  double ms = 0;
};

/// Milliseconds since the last call, or since it was made.
class Clock {
 public:
  double ms() {
    const auto now = std::chrono::steady_clock::now();
    const double passed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return passed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct RenderOutput {
  scene::Lighting lighting;
  std::vector<StepTime> times;
  std::vector<std::string> notes;             // lines to print
  std::map<std::string, io::Image> buffers;   // what --buffers writes beside the G-buffer and the parts
};

struct RenderMethod {
  const char* name;
  const char* meaning;
  Result<RenderOutput> (*run)(const RenderInput& input);
};

Result<RenderOutput> render_truth(const RenderInput& input);
Result<RenderOutput> render_cone(const RenderInput& input);
Result<RenderOutput> render_ssr(const RenderInput& input);
Result<RenderOutput> render_probe(const RenderInput& input);
Result<RenderOutput> render_lpv(const RenderInput& input);

}  // namespace luxel::program

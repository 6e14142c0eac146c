// A scene's light in light propagation volumes on a device: surfaces injected once, light whenever lights move, and seen
// from receivers.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>
#include <luxel/lpv_inject.h>
#include <luxel/lpv_sample.h>

#include "bench/scene/rays.h"
#include "bench/scene/rsm.h"

namespace luxel::scene {

/// What blocks light in the volumes.
enum class LpvBlockers {
  none,      // nothing: no geometry volume is made
  surfaces,  // every triangle's front
  empty,     // nothing either, with a geometry volume that holds 0
  maps       // what the lights' maps see, beside what the camera sees (`seen`), as an engine without its meshes has it
};

struct LpvSceneSettings {
  int resolution = 32;            // cells along the longest side (cascades: along every side)
  int cascades = 1;               // 1: a grid about the whole scene; 2, 3: nested about `centre`, the last holds the scene
  glm::dvec3 centre{0};
  int bands = 2;
  Format format = Format::f16x4;
  int iterations = 0;             // 0: as many as cells along the longest side
  LpvLobes lobes = LpvLobes::linear;
  bool keep_injected = true;
  LpvBlockers blockers = LpvBlockers::surfaces;
  bool moving = false;            // surfaces are injected again with every change of light
  bool two_sided = false;         // surfaces block from both sides
  std::vector<VirtualLight> seen; // of the maps: more surfaces, the G-buffer's
  bool find_grey = true;          // lights without colour are injected and propagated as one channel
  double filter = 0;              // weight of lpv_filter, 0: none
  RsmSettings maps;               // texels 0: four along a cell for the sun, one for each of the sky's, 16 rays a cell face
  LpvSceneSettings() { maps.sun_texels = maps.sky_texels = maps.lamp_rays = 0; }
};

/// Milliseconds: of the device where it has a clock, else of the host; of Embree's casts on the host.
struct LpvStep {
  std::string name;
  double ms = 0;
};

class LpvScene {
 public:
  /// Places the grids and injects the surfaces. `rays` must outlive the result. Errors: of the kernels.
  static Result<LpvScene> build(std::shared_ptr<Context> context, const Rays& rays, const LpvSceneSettings& settings);

  /// Maps, injection and propagation, in those cascades that `receivers` (8 floats each, places from origin()) read; all where
  /// there are none. `knobs`: how they will be looked up.
  Status light(const LpvSampleParams& knobs = {}, const std::vector<float>& receivers = {});

  /// Irradiance (4 a receiver) and, with views and knobs.glossy_steps, mean radiance along the mirror direction.
  struct Seen {
    std::vector<float> irradiance, glossy;
  };
  Result<Seen> sample(const LpvSampleParams& knobs, const std::vector<float>& receivers, const std::vector<float>& views = {});

  glm::dvec3 origin() const { return origin_; }  // places on the device count from here
  const std::vector<LpvGrid>& grids() const { return grids_; }
  const std::vector<VirtualLight>& lights() const { return lights_; }
  int channels() const { return channels_; }
  int iterations() const;
  std::vector<bool> cascades_run() const { return run_; }
  std::size_t memory_bytes() const { return bytes_; }  // volumes and lists; what a step needs beside is in scratch_bytes()
  std::size_t scratch_bytes() const { return scratch_; }
  const std::vector<LpvStep>& build_steps() const { return build_steps_; }
  const std::vector<LpvStep>& light_steps() const { return light_steps_; }
  const std::vector<LpvStep>& shade_steps() const { return shade_steps_; }

  /// The light volume of a cascade as f32, and the geometry volume.
  Result<std::vector<float>> volume(std::size_t cascade);

 private:
  LpvScene(std::shared_ptr<Context> context, const Rays& rays, const LpvSceneSettings& settings)
      : context_(std::move(context)), rays_(&rays), settings_(settings) {}
  void place();
  Status block(std::size_t cascade, const std::vector<VirtualLight>& pieces, const std::vector<VirtualLight>& more,
               std::vector<LpvStep>& steps);
  Status fill(std::size_t cascade, const std::shared_ptr<Memory>& list, double flux_max);
  LpvSampleParams look_up(const LpvSampleParams& knobs, std::size_t receivers) const;
  Result<std::shared_ptr<Memory>> make(Format format, std::size_t count, const void* data, bool kept = true);
  Status run(const Result<Plan>& plan, const std::vector<Named>& resources, const char* name, std::vector<LpvStep>& steps);

  std::shared_ptr<Context> context_;
  const Rays* rays_;
  LpvSceneSettings settings_;
  glm::dvec3 origin_{0};
  std::vector<LpvGrid> grids_;    // from origin_
  std::vector<VirtualLight> lights_, pieces_;
  int channels_ = 3;
  std::vector<bool> run_;
  std::shared_ptr<Memory> light_;                   // all cascades
  std::vector<std::shared_ptr<Memory>> geometry_;   // of each
  std::size_t bytes_ = 0, light_bytes_ = 0, scratch_ = 0;
  std::vector<LpvStep> build_steps_, light_steps_, shade_steps_;
};

}  // namespace luxel::scene

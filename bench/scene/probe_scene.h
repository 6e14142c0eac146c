// A scene in probes on a device: cast once, lit whenever lights move, and seen from receivers.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>
#include <luxel/probe_irradiance.h>
#include <luxel/probe_shade.h>

#include "bench/scene/probes.h"

namespace luxel::scene {

struct ProbeSceneSettings {
  std::array<int, 3> count{4, 4, 4};  // of probes, each in the middle of a cell of the scene's bounds
  int size = 32;             // of the maps that rays are cast for, as ProbeMaps has it
  int bounces = 1;           // of diffuse light, 1..16: from the second on, what the probes see is lit by the probes
  int sky_samples = 64;      // directions by which the sky lights what probes see, where there is a sky
  bool find_dead = true;     // probes inside geometry are found, left out of the filter, and count nothing
  ProbeIrradianceParams filter;  // sizes, formats, power; grid and maps are filled in
  ProbeShadeParams bounce;       // how probes light what probes see: knobs; grid, sizes and receivers are filled in
};

/// `probe_cubes(scene, n)`: counts such that cells are about cubes, n along the longest side.
std::array<int, 3> probe_cubes(const Scene& scene, int longest);

/// Irradiance at points, 4 a receiver; the fourth: share of the probes' weight that sees it.
struct ProbeLit {
  std::vector<float> indirect;  // from surfaces that reflect light
  std::vector<float> direct;    // from the sky and from what emits, seen directly; empty where there is neither
  std::vector<std::uint32_t> counters;  // as ProbeShadeOutcome names them, of `indirect`
};

/// Milliseconds: of the device where it has a clock, else of the host; of Embree's casts on the host.
struct ProbeStep {
  std::string name;
  double ms = 0;
};

class ProbeScene {
 public:
  /// Places the probes and casts what they see. `rays` must outlive the result. Errors: of the kernels, and unsupported on
  /// cpu:double.
  static Result<ProbeScene> build(std::shared_ptr<Context> context, const Rays& rays, const ProbeSceneSettings& settings);
  /// Light of sun, lamps and sky on what the probes see, and the maps that receivers look up.
  Status light();
  /// `knobs`: visibility, facing, biases and so on. Receivers: 8 floats each. `direct`: whether it is wanted.
  Result<ProbeLit> shade(const ProbeShadeParams& knobs, const std::vector<float>& receivers, bool direct = false);

  const Probes& probes() const { return probes_; }
  /// The sun, and the emitters where they are lamps (few, and no sky shines): the lights that shadow rays reach. Of all others
  /// `direct` has the light.
  const std::vector<VoxelLight>& lights() const { return lights_; }
  bool lamps() const { return lamps_; }
  std::size_t dead() const;
  std::size_t memory_bytes() const;  // of all buffers on the device, receivers left out
  const std::vector<ProbeStep>& build_steps() const { return build_steps_; }
  const std::vector<ProbeStep>& light_steps() const { return light_steps_; }
  const std::vector<ProbeStep>& shade_steps() const { return shade_steps_; }

  /// The parameters that shade() uses for so many receivers, and the memory of a name ("irradiance", "moments", "positions",
  /// "receivers", "lit"), for whoever times kernels alone.
  ProbeShadeParams shade_params(const ProbeShadeParams& knobs, std::size_t receivers) const;
  ProbeIrradianceParams filter_params() const { return filter_; }
  std::shared_ptr<Memory> memory(const std::string& name) const { return memories_.at(name).memory; }

 private:
  ProbeScene(std::shared_ptr<Context> context, const Rays& rays, const ProbeSceneSettings& settings)
      : context_(std::move(context)), rays_(&rays), settings_(settings) {}
  Status cast();
  Status put(const std::string& name, Format format, std::size_t count, const void* data);
  Status run(const Result<Plan>& plan, const std::map<std::string, std::string>& names, const char* step, std::vector<ProbeStep>& steps);
  Result<std::vector<float>> lit_by(const std::string& maps, const ProbeShadeParams& params, const std::vector<float>& receivers,
                                    const char* step, std::vector<ProbeStep>& steps);
  Status gather(const std::vector<double>& radiance, const std::string& to, bool moments);

  std::shared_ptr<Context> context_;
  const Rays* rays_;
  ProbeSceneSettings settings_;
  Probes probes_;
  ProbeIrradianceParams filter_;
  std::vector<double> distance_, albedo_;  // of texels; 3 a texel
  std::vector<float> seen_;                // what the texels see, as receivers
  bool sky_ = false, seen_directly_ = false, lamps_ = false;
  std::vector<VoxelLight> lights_;
  struct Held {
    std::shared_ptr<Memory> memory;
    std::size_t bytes = 0;
  };
  std::map<std::string, Held> memories_;
  std::vector<ProbeStep> build_steps_, light_steps_, shade_steps_;
};

}  // namespace luxel::scene

// A scene in voxels on a device: voxelized once, lit whenever lights move, and seen through cones.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <luxel/cone_trace.h>
#include <luxel/device.h>
#include <luxel/voxel_inject.h>
#include <luxel/voxelize.h>

#include "bench/scene/rays.h"
#include "bench/scene/voxels.h"

namespace luxel::scene {

/// A list of lights for voxel_inject: the sun, and each emitting triangle cut into pieces so that there are about `pieces`
/// in all. Both of a triangle's sides emit.
std::vector<VoxelLight> voxel_lights_of(const Scene& scene, int pieces);

/// Work that a scene has no use for and that is done all the same, to measure what leaving it out saves.
struct VoxelKeep {
  bool emission = false;   // volumes of emitted light, and what is made of them
  bool gathering = false;  // cones that gather direct light: from the sky, from emitters that are no lamps
};

struct VoxelSceneSettings {
  int resolution = 128;
  Format format = Format::f16x4;  // of every volume
  VoxelizeMode mode = VoxelizeMode::conservative;
  ConeVariant variant = ConeVariant::isotropic;
  const Rays* rays = nullptr;  // where given, the sun casts its shadows by a map, which these rays make (an engine has
                               // rasterized it); else by rays through the voxels. Must outlive the voxels
  double shadow_texels = 3;    // of that map in a voxel, along each side, 1..8
  bool textures = true;  // base-colour textures are sampled in the voxels; false: their mean
  bool two_sided = false;    // true: both sides of every surface are lit alike, and show light on their backs
  int lamp_pieces = 64;  // emitting triangles are lights of about so many pieces where they are no more than these and
                         // no sky shines: lamps. Else cones gather what they send
  int voxel_cones = 6;   // cones of a voxel that sky and many emitters light
  VoxelKeep keep;
};

/// What a step took: milliseconds of the device (where it has a clock, else of the host).
struct VoxelStep {
  std::string name;
  double ms = 0;
};

/// Irradiance and visibility at points. What the scene does not have is empty: neither volumes nor cones are made for it.
struct ConeLight {
  std::vector<float>
      direct;  // 4 a receiver: irradiance from the sky, and from emitting surfaces that are not lamps; visibility
  std::vector<float> indirect;  // 4 a receiver: irradiance from surfaces that reflect light; visibility
  std::vector<float> glossy;    // 4 a receiver: mean radiance in the specular lobe; empty where nothing is glossy
};

class VoxelScene {
 public:
  /// Voxelizes. Errors: of the kernels, and unsupported where a buffer does not fit the device, naming it.
  static Result<VoxelScene> build(std::shared_ptr<Context> context, const Scene& scene,
                                  const VoxelSceneSettings& settings);

  /// Direct light of the scene's sun, sky and emitters into the voxels, and the pyramids of what cones read.
  Status light();

  /// The sun, and the emitters where they are few enough to be lamps: the lights that shadow rays reach. Cones gather the
  /// direct light of everything else.
  const std::vector<VoxelLight>& lights() const { return lights_; }

  /// Traces. `cones`: cone set, step and so on; volumes, extents and environment are filled in. `views` (a vec4 each) may be
  /// empty: then nothing is glossy. `occlusion_reach`: surfaces beyond it do not occlude, scene units; 0: all do.
  Result<ConeLight> trace(const ConeTraceParams& cones, const std::vector<float>& receivers,
                          const std::vector<float>& views, double occlusion_reach = 0);

  const VoxelGrid& grid() const { return grid_; }
  /// Triangles skipped for a vertex that is no finite number.
  std::size_t skipped() const { return skipped_; }
  std::uint32_t occupied() const { return occupied_; }
  std::size_t memory_bytes() const;
  const std::vector<VoxelStep>& build_steps() const { return build_steps_; }
  const std::vector<VoxelStep>& light_steps() const { return light_steps_; }
  const std::vector<VoxelStep>& shade_steps() const { return shade_steps_; }

  /// Level 0 of the volume of reflected light, as f32 [z][y][x][4].
  Result<std::vector<float>> reflected();

 private:
  struct Pyramid {
    std::shared_ptr<Memory> fine, coarse;
    std::size_t bytes = 0;
  };

  VoxelScene(std::shared_ptr<Context> context, const Scene& scene, const VoxelSceneSettings& settings);
  Status voxelize();
  Status inject(Pyramid& pyramid, bool emission, const std::vector<VoxelLight>& lights, const std::vector<float>& map,
                const char* name);
  Status mip(Pyramid& pyramid, const char* name);
  std::vector<float> shadow_map(const VoxelShadow& shadow);
  Result<std::vector<float>> cones(const ConeTraceParams& params, const Pyramid& pyramid,
                                   const std::vector<float>& receivers, const std::vector<float>& views,
                                   std::vector<float>* glossy, const char* name, std::vector<VoxelStep>& steps);
  Status run(const Plan& plan, const std::vector<Named>& resources, const char* name, std::vector<VoxelStep>& steps);
  Result<std::shared_ptr<Memory>> make(Format format, std::size_t count, const void* data = nullptr);
  ConeTraceParams shape() const;
  Status see_sky(ConeTraceParams& params);
  Result<std::vector<float>> voxel_receivers(std::vector<float>& places);

  std::shared_ptr<Context> context_;
  const Scene& scene_;
  VoxelSceneSettings settings_;
  VoxelGrid grid_;
  std::size_t skipped_ = 0;
  std::uint32_t occupied_ = 0;
  bool emission_ = false;
  int bricks_ = 0;
  std::size_t bytes_ = 0;
  std::shared_ptr<Memory> sky_;  // for cones of this aperture
  double sky_aperture_ = 0;
  std::shared_ptr<Memory> colour_, normal_, emitted_, brick_list_, counters_;
  Pyramid own_, reflected_;  // what surfaces emit (and the sky behind them), and what they reflect
  bool gathered_ = false;    // whether cones gather direct light: of the sky, or of emitters that are no lamps
  std::vector<VoxelLight> lights_;
  std::vector<VoxelStep> build_steps_, light_steps_, shade_steps_;
};

}  // namespace luxel::scene

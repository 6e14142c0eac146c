#include <cmath>

#include <fmt/format.h>

#include "bench/scene/interleaved.h"
#include "common.h"
#include "direct_light.h"
#include "render.h"

namespace luxel::program {

using glm::dvec3;

Result<RenderOutput> render_cone(const RenderInput& input) {
  const scene::GBuffer& g = input.gbuffer;
  auto context = open_device(input.device);
  if (!context) return context.status();
  if (context.value()->real64())
    return Status(Code::invalid_argument, "--method cone: the device cpu:double is not taken; expected another");
  scene::VoxelSceneSettings settings = input.voxels;
  settings.rays = &input.rays;
  auto built = scene::VoxelScene::build(context.value(), input.scene, settings);
  if (!built) return built.status();
  scene::VoxelScene& voxels = built.value();
  if (Status s = voxels.light(); !s) return s;

  const std::vector<float> receivers = receivers_of(g, voxels.grid());
  std::vector<float> views;
  bool glossy = false;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const dvec3 view = input.scene.camera.eye - g.at(g.position, i);
    for (const double v : {view.x, view.y, view.z, 0.0}) views.push_back(static_cast<float>(v));
    glossy = glossy || g.at(g.specular, i) != dvec3(0);
  }
  if (!glossy) views.clear();
  ConeTraceParams cones = input.cones;
  cones.width = g.width;
  cones.height = g.height;
  cones.gamma = input.settings.ao_falloff;
  const double reach = input.settings.ao_distance;
  auto traced = voxels.trace(cones, receivers, views, std::isfinite(reach) ? reach : 0);
  if (!traced) return traced.status();
  const scene::ConeLight& light = traced.value();

  RenderOutput out;
  Clock clock;
  out.lighting.sun = direct(input, voxels.lights(), true);
  out.lighting.direct = direct(input, voxels.lights(), false);
  out.times.push_back({"shade", "shadow rays", clock.ms()});
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const auto rgb = [&](const std::vector<float>& v) {
      return v.empty() ? dvec3(0) : dvec3(v[4 * i], v[4 * i + 1], v[4 * i + 2]);
    };
    out.lighting.direct[i] += rgb(light.direct);
    out.lighting.indirect.push_back(rgb(light.indirect));
    out.lighting.glossy.push_back(rgb(light.glossy));
    out.lighting.visibility.push_back(g.surface_at(i) ? light.indirect[4 * i + 3] : 0);
  }
  for (const scene::VoxelStep& s : voxels.build_steps()) out.times.push_back({"build", s.name, s.ms});
  for (const scene::VoxelStep& s : voxels.light_steps()) out.times.push_back({"update", s.name, s.ms});
  for (const scene::VoxelStep& s : voxels.shade_steps()) out.times.push_back({"shade", s.name, s.ms});
  out.notes.push_back(fmt::format("{}: {}^3 voxels of {:.4g}, {} occupied, {} triangles skipped, {:.0f} MiB",
                                  context.value()->info().id, input.voxels.resolution, voxels.grid().voxel,
                                  voxels.occupied(), voxels.skipped(),
                                  static_cast<double>(voxels.memory_bytes()) / 1048576));
  return out;
}

}  // namespace luxel::program

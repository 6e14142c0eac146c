#include <cmath>
#include <numbers>
#include <thread>

#include <fmt/format.h>

#include "bench/scene/interleaved.h"
#include "common.h"
#include "render.h"

namespace luxel::program {
namespace {

using glm::dvec3;

dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// Irradiance by one light on a surface, with a shadow ray: the formula of voxel_inject.
dvec3 irradiance(const scene::Rays& rays, const VoxelLight& light, dvec3 position, dvec3 normal) {
  dvec3 to = vector_of(light.place);
  double share = 1, reach = scene::Rays::forever;
  if (light.kind != VoxelLight::Kind::sun) {
    to -= position;
    const double squared = glm::dot(to, to);
    if (squared == 0) return dvec3(0);
    reach = std::sqrt(squared) * (1 - 1e-3);
    to /= std::sqrt(squared);
    share = std::max(0.0, -glm::dot(to, glm::normalize(vector_of(light.normal)))) /
            (squared + light.area / std::numbers::pi);
  }
  share *= glm::dot(normal, to);
  if (!(share > 0) || rays.blocked(position + rays.offset() * normal, to, reach)) return dvec3(0);
  return share * vector_of(light.power);
}

// Of the sun or of all others, at each pixel.
std::vector<dvec3> direct(const RenderInput& input, const std::vector<VoxelLight>& lights, bool sun) {
  const scene::GBuffer& g = input.gbuffer;
  std::vector<dvec3> sum(g.pixels(), dvec3(0));
  std::vector<std::thread> threads;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < g.pixels(); i += count)
        if (g.surface_at(i))
          for (const VoxelLight& light : lights)
            if ((light.kind == VoxelLight::Kind::sun) == sun)
              sum[i] += irradiance(input.rays, light, g.at(g.position, i), g.at(g.normal, i));
    });
  for (std::thread& thread : threads) thread.join();
  return sum;
}

}  // namespace

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

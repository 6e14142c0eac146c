#include <atomic>
#include <thread>

#include <fmt/format.h>

#include "bench/scene/lpv_scene.h"
#include "bench/scene/probes.h"
#include "common.h"
#include "direct_light.h"
#include "render.h"

namespace luxel::program {
namespace {

using glm::dvec3;

// Irradiance from all lights and the sky, by shadow rays.
std::vector<dvec3> all_direct(const RenderInput& input) {
  const scene::GBuffer& g = input.gbuffer;
  scene::ProbeLight what;
  what.sky_samples = input.scene.sky.dark() ? 0 : 64;
  const scene::DirectLight lights(input.rays, what);
  std::vector<dvec3> sum(g.pixels(), dvec3(0));
  std::vector<std::thread> threads;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < g.pixels(); i += count)
        if (g.surface_at(i)) sum[i] = lights.irradiance(g.at(g.position, i), g.at(g.normal, i));
    });
  for (std::thread& thread : threads) thread.join();
  return sum;
}

const char* name_of(scene::LpvBlockers blockers) {
  return blockers == scene::LpvBlockers::none || blockers == scene::LpvBlockers::empty ? "nothing" : blockers == scene::LpvBlockers::surfaces ? "all surfaces" : "what maps and camera see";
}

}  // namespace

Result<RenderOutput> render_lpv(const RenderInput& input) {
  const scene::GBuffer& g = input.gbuffer;
  auto context = open_device(input.device);
  if (!context) return context.status();
  if (context.value()->real64())
    return Status(Code::invalid_argument, "--method lpv: the device cpu:double is not taken; expected another");
  scene::LpvSceneSettings settings = input.lpv;
  const glm::dvec3 eye = input.scene.camera.eye;
  double pixel = 0;  // area of a pixel's surface over its squared distance, at normal incidence
  {
    const double tangent = std::tan(input.scene.camera.fov * 3.14159265358979 / 360);
    pixel = 4 * tangent * tangent / (static_cast<double>(g.height) * g.height);
  }
  // Nested grids are finest about the middle of what is seen.
  std::size_t seen = 0;
  for (std::size_t i = 0; i < g.pixels(); ++i)
    if (g.surface_at(i)) {
      const dvec3 p = g.at(g.position, i), n = g.at(g.normal, i), to = eye - p;
      settings.centre += p;
      ++seen;
      const double cosine = std::max(glm::dot(n, to) / glm::length(to), 0.05);
      if (settings.blockers == scene::LpvBlockers::maps)
        settings.seen.push_back({p, n, dvec3(0), glm::dot(to, to) * pixel / cosine});
    }
  if (seen > 0) settings.centre /= static_cast<double>(seen);
  auto built = scene::LpvScene::build(context.value(), input.rays, settings);
  if (!built) return built.status();
  scene::LpvScene& volumes = built.value();

  std::vector<float> receivers, views;
  bool glossy = false;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const dvec3 p = g.at(g.position, i) - volumes.origin(), n = g.at(g.normal, i), view = eye - g.at(g.position, i);
    for (const double v : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) receivers.push_back(static_cast<float>(v));
    for (const double v : {view.x, view.y, view.z, 0.0}) views.push_back(static_cast<float>(v));
    glossy = glossy || g.at(g.specular, i) != dvec3(0);
  }
  if (!glossy) views.clear();
  LpvSampleParams knobs = input.by_lpv;
  knobs.glossy_steps = glossy ? 4 : 0;
  if (Status s = volumes.light(knobs, receivers); !s) return s;
  auto lit = volumes.sample(knobs, receivers, views);
  if (!lit) return lit.status();

  RenderOutput out;
  Clock clock;
  out.lighting.direct = all_direct(input);
  out.lighting.sun = direct(input, scene::voxel_lights_of(input.scene, 1), true);
  out.times.push_back({"shade", "shadow rays", clock.ms()});
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const auto rgb = [&](const std::vector<float>& v) {
      return v.empty() ? dvec3(0) : dvec3(v[4 * i], v[4 * i + 1], v[4 * i + 2]);
    };
    out.lighting.direct[i] = glm::max(out.lighting.direct[i] - out.lighting.sun[i], dvec3(0));
    out.lighting.indirect.push_back(rgb(lit.value().irradiance));
    out.lighting.glossy.push_back(rgb(lit.value().glossy));
    out.lighting.visibility.push_back(g.surface_at(i) ? 1 : 0);
  }
  for (const scene::LpvStep& s : volumes.build_steps()) out.times.push_back({"build", s.name, s.ms});
  for (const scene::LpvStep& s : volumes.light_steps()) out.times.push_back({"update", s.name, s.ms});
  for (const scene::LpvStep& s : volumes.shade_steps()) out.times.push_back({"shade", s.name, s.ms});
  std::string grids;
  for (std::size_t k = 0; k < volumes.grids().size(); ++k) {
    const LpvGrid& grid = volumes.grids()[k];
    grids += fmt::format("{}{}x{}x{} cells of {:.4g}{}", k == 0 ? "" : ", ", grid.extent[0], grid.extent[1], grid.extent[2], grid.cell,
                         volumes.cascades_run()[k] ? "" : " (not run: no receiver)");
  }
  out.notes.push_back(fmt::format("{}: {}, {} small lights, {} steps, blocked by {}, {} channel{}, {:.1f} MiB",
                                  context.value()->info().id, grids, volumes.lights().size(), volumes.iterations(), name_of(settings.blockers),
                                  volumes.channels(), volumes.channels() == 1 ? "" : "s", static_cast<double>(volumes.memory_bytes()) / 1048576));
  out.notes.push_back("ambient occlusion is not found by light volumes: 1 everywhere");
  if (glossy) out.notes.push_back("glossy surfaces mirror a few cells of the volume, whatever their roughness");
  return out;
}

}  // namespace luxel::program

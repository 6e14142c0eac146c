#include "bench/report/rendered.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "bench/report/stage.h"
#include "bench/scene/voxel_scene.h"
#include "bench/truth/cone_truth.h"

namespace luxel::report {
namespace {

using glm::dvec3;

struct RenderSetting {
  Place place;
  int resolution = 64, cones = 6;
  bool anisotropic = false;
  double step = 0.5;
};

std::string label(const RenderSetting& s) {
  return fmt::format("cone_trace {} {} cones {}^3 step {} in {}", s.anisotropic ? "anisotropic" : "isotropic", s.cones,
                     s.resolution, s.step, s.place.name);
}

double total(const std::vector<scene::VoxelStep>& steps) {
  double ms = 0;
  for (const scene::VoxelStep& s : steps) ms += s.ms;
  return ms;
}

Cell phase(std::vector<double> ms) { return cell_of(summarise(std::move(ms))); }

// Irradiance by exhaustive rays, 3 a receiver. Kept: most settings of a scene have the same voxels.
const std::vector<double>& by_rays(const ConeTraceParams& params, const std::vector<float>& voxels,
                                   const std::vector<float>& receivers, int rays) {
  static std::map<std::uint64_t, std::vector<double>> made;
  const auto bytes = std::as_bytes(std::span(voxels));
  std::vector<double>& irradiance = made[hash_bytes({bytes.begin(), bytes.end()})];
  if (!irradiance.empty()) return irradiance;
  const std::vector<double> values(voxels.begin(), voxels.end()), points(receivers.begin(), receivers.end());
  const std::vector<double> all = truth::irradiance(params, {params.extent, values}, points, rays);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (i % 4 < 3) irradiance.push_back(all[i]);
  return irradiance;
}

// The voxels of a setting, lit, and how long that took. Settings that differ in cones alone share them: light, with its shadow
// rays, takes longest by far.
struct Lit {
  std::string what;
  std::optional<scene::VoxelScene> voxels;
  std::vector<double> update;
};

Status light(Session& session, const RenderSetting& s, const Stage& stage, Lit& lit) {
  const std::string what = fmt::format("{} {} {}", s.place.name, s.resolution, s.anisotropic);
  if (lit.what == what) return {};
  lit.what.clear();
  lit.voxels.reset();
  lit.update.clear();
  scene::VoxelSceneSettings settings;
  settings.resolution = s.resolution;
  settings.rays = &*stage.rays;
  settings.variant = s.anisotropic ? ConeVariant::anisotropic : ConeVariant::isotropic;
  // The context is the session's; it outlives the scene.
  const std::shared_ptr<Context> context(std::shared_ptr<Context>(), &session.context());
  auto built = scene::VoxelScene::build(context, stage.scene, settings);
  if (!built) return built.status();
  lit.voxels.emplace(std::move(built).value());
  for (int run = 0; run < (session.is_cpu() || session.settings().quick ? 1 : 3); ++run) {
    if (Status done = lit.voxels->light(); !done) return done;
    lit.update.push_back(total(lit.voxels->light_steps()));
  }
  lit.what = what;
  return {};
}

Status measure(Session& session, const RenderSetting& s, Lit& lit) {
  const bool quick = session.settings().quick;
  const auto found = stage_of(s.place, quick);
  if (!found) return found.status();
  const Stage& stage = *found.value();
  ConeTraceParams cones;
  cones.cones = cone_set(s.cones).value();
  cones.step_scale = s.step;
  cones.occlusion = false;

  if (Status done = light(session, s, stage, lit); !done) return done;
  scene::VoxelScene& voxels = *lit.voxels;
  const dvec3 origin(voxels.grid().origin[0], voxels.grid().origin[1], voxels.grid().origin[2]);
  std::vector<float> receivers;
  for (const std::size_t i : stage.pixels) {
    const dvec3 p = stage.seen.at(stage.seen.position, i) - origin, n = stage.seen.at(stage.seen.normal, i);
    for (const double v : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) receivers.push_back(static_cast<float>(v));
  }
  std::vector<double> shade;
  scene::ConeLight light;
  for (int run = 0; run < (session.is_cpu() ? 1 : 3); ++run) {
    auto traced = voxels.trace(cones, receivers, {});
    if (!traced) return traced.status();
    light = std::move(traced).value();
    shade.push_back(total(voxels.shade_steps()));
  }
  std::vector<double> x;
  for (std::size_t i = 0; i < light.indirect.size(); ++i)
    if (i % 4 < 3) x.push_back(light.indirect[i]);
  const Relative method = relative(x, x, stage.t1, stage.t2, stage.mean);

  // The same voxels, seen by exhaustive rays.
  const auto volume = voxels.reflected();
  if (!volume) return volume.status();
  ConeTraceParams exact = cones;
  exact.extent = {s.resolution, s.resolution, s.resolution};
  exact.voxel = voxels.grid().voxel;
  const std::vector<double>& v = by_rays(exact, volume.value(), receivers, quick ? 64 : 256);
  const Relative discretization = relative(v, v, stage.t1, stage.t2, stage.mean);
  const Relative model = relative(x, x, v, v, stage.mean);

  FrontierRow row{"cone_trace", s.anisotropic ? "anisotropic" : "isotropic", s.place.name,
                  fmt::format("{} receivers", stage.pixels.size()), {{"format", "f16x4"}},
                  {{"resolution", s.resolution}, {"cones", s.cones}, {"step", s.step}}, "",
                  {bounce_metric}};
  row.error.method = method.value;
  row.error.discretization = discretization.value;
  row.error.model = model.value;
  row.error.standard_error = method.error;
  row.build = phase({total(voxels.build_steps())});
  row.update = phase(lit.update);
  row.shade = phase(shade);
  row.memory = voxels.memory_bytes();
  session.frontier(row);
  return {};
}

}  // namespace

std::vector<Job> rendered_grid(Session& session, std::vector<std::string>& missing) {
  const bool quick = session.settings().quick;
  std::vector<Job> jobs;
  const auto lit = std::make_shared<Lit>();
  const auto add = [&](const RenderSetting& s) {
    jobs.push_back({label(s), [&session, s, lit] { return measure(session, s, *lit); }});
  };
  const std::vector<Place> all = places(missing);
  for (const Place& place : all) {
    if (quick) {  // the execution in C++ takes seconds for each
      if (session.is_cpu() && &place != &all[0]) continue;
      add({place, 64, 6, false, 0.5});
      if (&place == &all[1]) {
        add({place, 64, 6, true, 0.5});
        add({place, 64, 16, false, 0.5});
      }
      continue;
    }
    for (const int resolution : session.is_cpu() ? std::vector<int>{64} : std::vector<int>{64, 128})
      for (const bool anisotropic : {true, false}) add({place, resolution, 6, anisotropic, 0.5});
    if (!session.is_cpu() && &place == &all[1]) add({place, 256, 6, false, 0.5});  // takes half a minute
    if (session.is_cpu() || &place != &all[0]) continue;
    for (const int cones : {1, 4, 9, 16, 25}) add({place, 128, cones, false, 0.5});
    for (const double step : {0.25, 1.0}) add({place, 128, 6, false, step});
  }
  return jobs;
}

}  // namespace luxel::report

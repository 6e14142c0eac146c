#include "bench/report/scene_savings.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "bench/report/probe_light.h"
#include "bench/report/stage.h"
#include "bench/scene/interleaved.h"

namespace luxel::report {
namespace {

using glm::dvec3;
using scene::VoxelScene;

struct Item {
  std::string what;
  int level;
  scene::VoxelKeep keep;
  bool gloss;
};

std::vector<Item> items_of(const scene::SceneFacts& f) {
  Item all{"all of this together", 3, {}, false};
  std::vector<Item> items;
  if (f.emitters == 0 && !f.sky) {
    items.push_back({"volumes of emitted light where nothing emits", 1, {true, false}, false});
    items.push_back({"cones that gather direct light where no sky shines", 3, {false, true}, false});
    all.keep = {true, true};
  }
  if (f.glossy == 0) {
    items.push_back({"specular cones where nothing reflects", 3, {}, true});
    all.gloss = true;
  }
  if (items.size() > 1) items.push_back(all);
  return items;
}

struct Made {
  double ms = 0, bytes = 0;
  scene::ConeLight light;
};

Result<Made> make(const std::shared_ptr<Context>& context, const scene::Scene& s, const scene::GBuffer& g,
                  const scene::VoxelSceneSettings& settings, bool gloss) {
  auto built = VoxelScene::build(context, s, settings);
  if (!built) return built.status();
  VoxelScene& voxels = built.value();
  if (Status status = voxels.light(); !status) return status;
  std::vector<float> views;
  for (std::size_t i = 0; i < g.pixels() && gloss; ++i) {
    const dvec3 view = s.camera.eye - g.at(g.position, i);
    for (const double v : {view.x, view.y, view.z, 0.0}) views.push_back(static_cast<float>(v));
  }
  ConeTraceParams cones;
  cones.cones = cone_set(6).value();
  cones.width = g.width;
  cones.height = g.height;
  auto light = voxels.trace(cones, receivers_of(g, voxels.grid()), views);
  if (!light) return light.status();
  Made made{0, static_cast<double>(voxels.memory_bytes()), std::move(light).value()};
  for (const auto* steps : {&voxels.build_steps(), &voxels.light_steps(), &voxels.shade_steps()})
    for (const scene::VoxelStep& step : *steps)
      if (step.name != "shadow map") made.ms += step.ms;  // cast on the CPU; an engine has it
  return made;
}

// Missing values are 0.
double difference(const std::vector<float>& a, const std::vector<float>& b, std::size_t channels,
                  const std::function<double(std::size_t)>& weight) {
  double most = 0;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i % 4 >= channels) continue;
    const double d = std::fabs((a.empty() ? 0.0 : a[i]) - (b.empty() ? 0.0 : b[i])) * weight(i);
    if (!(d <= most)) most = d;
  }
  return most;
}

}  // namespace

Result<std::vector<SceneSaving>> scene_savings(std::shared_ptr<Context> context, const scene::Scene& s,
                                               const scene::Rays& rays, const scene::GBuffer& g, int resolution,
                                               int repeats) {
  const scene::SceneFacts facts = facts_of(s, g, 1);
  scene::VoxelSceneSettings lean;
  lean.resolution = resolution;
  lean.rays = &rays;
  std::vector<SceneSaving> savings;
  for (const Item& item : items_of(facts)) {
    scene::VoxelSceneSettings more = lean;
    more.keep = item.keep;
    std::vector<double> whole, saved;
    SceneSaving saving{item.what, item.level, {}, {}, 0, 0};
    for (int k = -1; k < repeats; ++k) {  // the first warms up
      const auto a = make(context, s, g, more, item.gloss || facts.glossy > 0);
      if (!a) return a.status();
      const auto b = make(context, s, g, lean, facts.glossy > 0);
      if (!b) return b.status();
      if (k < 0) continue;
      whole.push_back(a.value().ms);
      saved.push_back(a.value().ms - b.value().ms);
      saving.saved_bytes = a.value().bytes - b.value().bytes;
      const scene::ConeLight &x = a.value().light, &y = b.value().light;
      const auto one = [](std::size_t) { return 1.0; };
      // Of direct light the visibility stands in `indirect` too.
      saving.error = std::max({difference(x.direct, y.direct, 3, one), difference(x.indirect, y.indirect, 4, one),
                               difference(x.glossy, y.glossy, 3, [&](std::size_t i) {
                                 return static_cast<double>(g.specular[i / 4 * 3 + i % 4]);
                               })});
    }
    saving.whole = summarise(whole);
    saving.saved = summarise(saved);
    savings.push_back(saving);
  }
  return savings;
}

namespace {

Status scene_rows(Session& session, const Place& place, bool sky) {
  auto read = scene::scene_from(place.scene);
  if (!read) return read.status();
  scene::Scene& s = read.value();
  if (place.camera.fov > 0) s.camera = place.camera;
  if (!sky) s.sky = {};
  const auto rays = scene::Rays::make(s);
  if (!rays) return rays.status();
  const bool quick = session.settings().quick;
  const int resolution = quick ? 16 : 64;
  const scene::GBuffer g = scene::gbuffer(rays.value(), s.camera, quick ? 32 : 160, quick ? 18 : 90);
  const auto savings = scene_savings(borrowed(session), s, rays.value(), g, resolution, quick ? 2 : 5);
  if (!savings) return savings.status();
  for (const SceneSaving& saving : savings.value())
    session.row("left_out", {{"kernel", "cone_trace"},
                             {"scene", fmt::format("{}{} {}^3", place.name, sky ? "" : ", no sky", resolution)},
                             {"what", saving.what},
                             {"level", saving.level},
                             {"saved_ms", saving.saved.median},
                             {"saved_bytes", saving.saved_bytes},
                             {"error", saving.error},
                             {"device", session.device()}});
  return {};
}

}  // namespace

std::vector<Job> scene_left_out(Session& session, std::vector<std::string>& missing) {
  if (session.is_cpu()) return {};
  std::vector<Job> jobs;
  const auto add = [&](const Place& place, bool sky) {
    jobs.push_back({"left out of a scene: " + place.name, [&session, place, sky] { return scene_rows(session, place, sky); }});
  };
  add({"two_rooms (generated)", "two_rooms", {{}, {}, 0}}, true);
  if (session.settings().quick) return jobs;
  add({"furnace (generated)", "furnace", {{}, {}, 0}}, true);
  for (const Place& place : places(missing))
    if (place.scene != "cornell") add(place, false);
  return jobs;
}

}  // namespace luxel::report

#include "bench/report/lpv_scenes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "bench/report/leaks.h"
#include "bench/report/stage.h"
#include "bench/scene/lpv_scene.h"
#include "bench/truth/vpl_truth.h"
#include "host/check.h"

namespace luxel::report {
namespace {

using glm::dvec3;
using scene::LpvBlockers;
using scene::LpvScene;
using scene::LpvSceneSettings;

constexpr const char* lobe_names[] = {"linear", "clamp", "shrink", "rescale"};
constexpr const char* blocker_names[] = {"none", "surfaces", "empty", "maps"};

struct Setting {
  int cells = 32, steps = 32, cascades = 1, bands = 2;
  LpvLobes lobes = LpvLobes::linear;
  LpvBlockers blockers = LpvBlockers::surfaces;
  bool keep = true;
  double offset = 0.5, damping = 0, filter = 0, gain = 1;
};

std::string knobs_text(const Setting& s) {
  return fmt::format("{}^3 {} steps {} {} bands blockers {}{}{}{}{}{}{}", s.cells, s.steps, lobe_names[static_cast<int>(s.lobes)], s.bands,
                     blocker_names[static_cast<int>(s.blockers)], s.cascades > 1 ? fmt::format(" {} cascades", s.cascades) : "",
                     s.keep ? "" : " without injected", s.offset != 0.5 ? fmt::format(" offset {}", s.offset) : "",
                     s.damping > 0 ? " damped" : "", s.filter > 0 ? " filtered" : "", s.gain != 1 ? " gain 2/3" : "");
}

Cell knobs(const Setting& s) {
  Cell k = {{"resolution", s.cells}, {"steps", s.steps}};
  if (s.cascades > 1) k.set("cascades", s.cascades);
  if (s.offset != 0.5) k.set("offset", s.offset);
  if (s.damping > 0) k.set("damping", s.damping);
  if (s.filter > 0) k.set("filter", s.filter);
  if (s.gain != 1) k.set("gain", s.gain);
  return k;
}

Cell options(const Setting& s) {
  return {{"format", "f16x4"}, {"bands", s.bands}, {"blockers", blocker_names[static_cast<int>(s.blockers)]}, {"without injected", !s.keep}};
}

template <class Steps>
double total(const Steps& steps) {
  double ms = 0;
  for (const auto& s : steps) ms += s.ms;
  return ms;
}

std::vector<float> receivers_from(const std::vector<dvec3>& places, const std::vector<dvec3>& normals, dvec3 origin) {
  std::vector<float> list;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const dvec3 p = places[i] - origin, n = normals[i];
    for (const double v : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) list.push_back(static_cast<float>(v));
  }
  return list;
}

LpvSceneSettings scene_settings(const Setting& s, dvec3 centre) {
  LpvSceneSettings settings;
  settings.resolution = s.cells;
  settings.iterations = s.steps;
  settings.cascades = s.cascades;
  settings.bands = s.bands;
  settings.lobes = s.lobes;
  settings.blockers = s.blockers;
  settings.keep_injected = s.keep;
  settings.filter = s.filter;
  settings.centre = centre;
  return settings;
}

LpvSampleParams look_up(const Setting& s) {
  LpvSampleParams p;
  p.offset = s.offset;
  p.damping = s.damping;
  p.gain = s.gain;
  return p;
}

std::shared_ptr<Context> borrowed(Session& session) { return {std::shared_ptr<Context>(), &session.context()}; }

// Irradiance, 3 a receiver, and the times of a setting.
struct Measured {
  std::vector<double> irradiance, update, shade;
  double build = 0;
  std::size_t memory = 0;
};

Result<Measured> measure(Session& session, const Setting& s, const scene::Rays& rays, const std::vector<dvec3>& places,
                         const std::vector<dvec3>& normals) {
  dvec3 centre(0);
  for (const dvec3& p : places) centre += p / static_cast<double>(places.size());
  LpvSceneSettings settings = scene_settings(s, centre);
  // What a camera sees beside what lights see: each receiver stands for its share of about a steradian.
  if (s.blockers == LpvBlockers::maps)
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double along = glm::length(rays.scene().camera.eye - places[i]);
      settings.seen.push_back({places[i], normals[i], dvec3(0), along * along / static_cast<double>(places.size())});
    }
  auto built = LpvScene::build(borrowed(session), rays, settings);
  if (!built) return built.status();
  LpvScene& volumes = built.value();
  const std::vector<float> receivers = receivers_from(places, normals, volumes.origin());
  Measured m;
  const int runs = session.is_cpu() ? 1 : 3;
  LpvScene::Seen seen;
  for (int run = 0; run < runs; ++run) {
    if (Status lit = volumes.light(look_up(s), receivers); !lit) return lit;
    auto looked = volumes.sample(look_up(s), receivers);
    if (!looked) return looked.status();
    seen = std::move(looked).value();
    m.update.push_back(total(volumes.light_steps()));
    m.shade.push_back(total(volumes.shade_steps()));
  }
  for (std::size_t i = 0; i < seen.irradiance.size(); ++i)
    if (i % 4 < 3) m.irradiance.push_back(seen.irradiance[i]);
  m.build = total(volumes.build_steps());
  m.memory = volumes.memory_bytes() + volumes.scratch_bytes();
  return m;
}

// The light that is injected, as small lights with a shadow ray each. Kept: all settings of a scene share it.
const std::vector<double>& by_small_lights(const std::string& place, const scene::Rays& rays, const std::vector<dvec3>& places,
                                           const std::vector<dvec3>& normals) {
  static std::map<std::string, std::vector<double>> made;
  std::vector<double>& irradiance = made[place];
  if (!irradiance.empty()) return irradiance;
  scene::RsmSettings maps;
  maps.sun_texels = 64;
  maps.sky_directions = 32;
  maps.sky_texels = 12;
  maps.lamp_rays = 4096;
  irradiance = truth::vpl_irradiance(rays, scene::reflective_shadow_maps(rays, maps), places, normals);
  return irradiance;
}

Status stage_row(Session& session, const Place& place, const Setting& s) {
  const auto found = stage_of(place, session.settings().quick);
  if (!found) return found.status();
  const Stage& stage = *found.value();
  std::vector<dvec3> places, normals;
  for (const std::size_t i : stage.pixels) {
    places.push_back(stage.seen.at(stage.seen.position, i));
    normals.push_back(stage.seen.at(stage.seen.normal, i));
  }
  const auto measured = measure(session, s, *stage.rays, places, normals);
  if (!measured) return measured.status();
  const Measured& m = measured.value();
  const std::vector<double>& x = m.irradiance;
  const Relative method = relative(x, x, stage.t1, stage.t2, stage.mean);
  const std::vector<double>& v = by_small_lights(place.name, *stage.rays, places, normals);
  FrontierRow row{"light_propagation", lobe_names[static_cast<int>(s.lobes)], place.name, fmt::format("{} receivers", stage.pixels.size()),
                  options(s), knobs(s), "", {bounce_metric}};
  row.error.method = method.value;
  row.error.discretization = relative(v, v, stage.t1, stage.t2, stage.mean).value;
  row.error.model = relative(x, x, v, v, stage.mean).value;
  row.error.standard_error = method.error;
  row.build = cell_of(summarise({m.build}));
  row.update = cell_of(summarise(m.update));
  row.shade = cell_of(summarise(m.shade));
  row.memory = m.memory;
  session.frontier(row);
  return {};
}

Status leak_row(Session& session, const Setting& s) {
  const auto found = leak_stage(session.settings().quick);
  if (!found) return found.status();
  const LeakStage& stage = *found.value();
  std::vector<dvec3> places, normals;
  for (std::size_t i = 0; i < stage.count(); ++i) {
    const float* r = &stage.receivers[8 * i];
    places.emplace_back(r[0], r[1], r[2]);
    normals.emplace_back(r[4], r[5], r[6]);
  }
  const auto measured = measure(session, s, *stage.rays, places, normals);
  if (!measured) return measured.status();
  const Measured& m = measured.value();
  const Leak l = leak(stage, m.irradiance, 3);
  Cell k = knobs(s);
  k.set("lit_room", l.lit);
  k.set("lit_room_error", l.relative);
  FrontierRow row{"light_propagation", lobe_names[static_cast<int>(s.lobes)], "two_rooms (generated)", fmt::format("{} receivers", stage.count()),
                  options(s), k, "leaks", {leak_metric}};
  row.error.method = l.dark;
  row.build = cell_of(summarise({m.build}));
  row.update = cell_of(summarise(m.update));
  row.shade = cell_of(summarise(m.shade));
  row.memory = m.memory;
  session.frontier(row);
  return {};
}

// All knobs in one scene; in the others what depends on the scene most.
std::vector<Setting> settings_of(Session& session, bool all_knobs) {
  std::vector<Setting> all;
  const auto add = [&](auto change) {
    Setting s;
    change(s);
    all.push_back(s);
  };
  if (session.settings().quick || session.is_cpu()) {
    add([](Setting& s) { s.cells = s.steps = 16; });
    if (!session.is_cpu()) add([](Setting& s) { s.cells = s.steps = 16, s.blockers = LpvBlockers::none; });
    return all;
  }
  for (const int n : all_knobs ? std::vector{8, 16, 32, 64} : std::vector{16, 32})
    for (const LpvBlockers b : {LpvBlockers::none, LpvBlockers::surfaces, LpvBlockers::maps})
      add([&](Setting& s) { s.cells = s.steps = n, s.blockers = b; });
  if (!all_knobs) return all;
  for (const int steps : {8, 16, 64, 128}) add([&](Setting& s) { s.steps = steps; });
  for (const LpvLobes l : {LpvLobes::clamp, LpvLobes::shrink, LpvLobes::rescale}) add([&](Setting& s) { s.lobes = l; });
  add([](Setting& s) { s.bands = 3; });
  add([](Setting& s) { s.keep = false; });
  for (const double offset : {0.0, 1.0}) add([&](Setting& s) { s.offset = offset; });
  add([](Setting& s) { s.damping = 1; });
  add([](Setting& s) { s.filter = 0.25; });
  add([](Setting& s) { s.gain = 2.0 / 3; });
  for (const int cascades : {2, 3}) add([&](Setting& s) { s.cells = s.steps = 16, s.cascades = cascades; });
  return all;
}

}  // namespace

std::vector<Job> lpv_scene_grid(Session& session, std::vector<std::string>& missing) {
  std::vector<Job> jobs;
  bool first = true;
  for (const Place& place : places(missing)) {
    for (const Setting& s : settings_of(session, first))
      jobs.push_back({fmt::format("light_propagation {} in {}", knobs_text(s), place.name),
                      [&session, place, s] { return stage_row(session, place, s); }});
    first = false;
  }
  std::vector<Setting> leaking;
  const bool small = session.settings().quick || session.is_cpu();
  for (const int n : small ? std::vector<int>{16} : std::vector<int>{16, 32, 64})
    for (const LpvBlockers b : {LpvBlockers::none, LpvBlockers::surfaces, LpvBlockers::maps})
      if (!small || b != LpvBlockers::maps) {
        Setting s;
        s.cells = s.steps = n;
        s.blockers = b;
        leaking.push_back(s);
        if (b == LpvBlockers::surfaces && !small) {
          s.damping = 1;
          leaking.push_back(s);
        }
      }
  for (const Setting& s : leaking)
    jobs.push_back({fmt::format("light_propagation leaks of {}", knobs_text(s)), [&session, s] { return leak_row(session, s); }});
  return jobs;
}

// ---- what is left out ----

namespace {

// Light and look-up of two settings in turn; `fewer` leaves out what `more` does.
Status compare(Session& session, const std::string& scene_name, LpvSceneSettings more, LpvSceneSettings fewer, const std::string& what,
               const std::vector<dvec3>& places, const std::vector<dvec3>& normals) {
  auto read = scene::scene_from(scene_name);
  if (!read) return read.status();
  const auto rays = scene::Rays::make(read.value());
  if (!rays) return rays.status();
  auto first = LpvScene::build(borrowed(session), rays.value(), more), second = LpvScene::build(borrowed(session), rays.value(), fewer);
  if (!first) return first.status();
  if (!second) return second.status();
  const std::vector<float> receivers = receivers_from(places, normals, second.value().origin());
  const auto timed = [&](LpvScene& scene, bool all) -> Session::Timed {
    return [&, all]() -> Result<double> {
      if (Status s = scene.light({}, all ? std::vector<float>() : receivers); !s) return s;
      double ms = 0;
      for (const scene::LpvStep& step : scene.light_steps())
        if (step.name != "maps") ms += step.ms;
      return ms;
    };
  };
  const auto pair = session.interleave(timed(first.value(), true), timed(second.value(), false), "left out: " + what);
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  auto x = first.value().sample({}, receivers), y = second.value().sample({}, receivers);
  if (!x) return x.status();
  if (!y) return y.status();
  double most = 0;
  for (std::size_t i = 0; i < x.value().irradiance.size(); ++i)
    most = std::max<double>(most, std::fabs(x.value().irradiance[i] - y.value().irradiance[i]));
  session.row("left_out", {{"kernel", "light_propagation"},
                           {"scene", fmt::format("{} {}^3", scene_name, fewer.resolution)},
                           {"what", what},
                           {"level", 0},
                           {"saved_ms", saved.median},
                           {"saved_bytes", static_cast<double>(first.value().memory_bytes()) - static_cast<double>(second.value().memory_bytes())},
                           {"error", most},
                           {"device", session.device()}});
  return {};
}

}  // namespace

std::vector<Job> lpv_scene_left_out(Session& session) {
  const bool small = session.settings().quick || session.is_cpu();
  const int n = small ? 16 : 32;
  LpvSceneSettings base;
  base.resolution = n;
  const std::vector<dvec3> places{{0.2, 0.001, 0.3}, {-0.5, 0.001, -0.2}, {-0.999, 0.5, 0}}, normals{{0, 1, 0}, {0, 1, 0}, {1, 0, 0}};
  std::vector<Job> jobs;
  jobs.push_back({"left out: light_propagation, two channels of grey light", [=, &session] {
                    LpvSceneSettings more = base;
                    more.find_grey = false;
                    return compare(session, "furnace", more, base, "two of three equal channels", places, normals);
                  }});
  jobs.push_back({"left out: light_propagation, cascades without receivers", [=, &session] {
                    LpvSceneSettings nested = base;
                    nested.cascades = 3;
                    nested.centre = {0, 0.5, 0};
                    std::vector<dvec3> near;
                    for (const dvec3& p : places) near.push_back(nested.centre + 0.1 * (p - nested.centre));
                    return compare(session, "cornell", nested, nested, "two cascades of three that no receiver reads", near, normals);
                  }});
  jobs.push_back({"left out: light_propagation, a geometry volume where nothing blocks", [=, &session] {
                    LpvSceneSettings none = base, empty = base;
                    none.blockers = LpvBlockers::none;
                    empty.blockers = LpvBlockers::empty;
                    return compare(session, "cornell", empty, none, "a geometry volume that holds nothing", places, normals);
                  }});
  jobs.push_back({"left out: light_propagation, surfaces injected again", [=, &session] {
                    LpvSceneSettings again = base;
                    again.moving = true;
                    return compare(session, "cornell", again, base, "static surfaces, injected again for every change of light", places, normals);
                  }});
  return jobs;
}

}  // namespace luxel::report

#include "bench/report/probe_light.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "bench/report/leaks.h"
#include "bench/scene/images.h"
#include "bench/scene/voxel_scene.h"
#include "bench/truth/probe_light_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using cases::Values;
using glm::dvec3;

double total(const std::vector<scene::ProbeStep>& steps) {
  double ms = 0;
  for (const scene::ProbeStep& s : steps) ms += s.ms;
  return ms;
}

// ---- maps against quadrature ----

struct FilterSetting {
  int irradiance = 8, moments = 16, samples = 32;
  bool half = true;
};

std::string label(const FilterSetting& s) {
  return fmt::format("probe_irradiance {}, maps of {} and {}, averaged to {}", s.half ? "f16" : "f32", s.irradiance, s.moments, s.samples);
}

// Eight probes of the Cornell box, 64 x 64 texels each.
struct FilterWorld {
  ProbeIrradianceParams params;
  Values radiance, distance;
  std::vector<std::array<double, 3>> normals;
  Values truth;  // irradiance at the normals, 3 a normal, probe by probe
  double mean = 0;
};
Result<std::shared_ptr<const FilterWorld>> filter_world() {
  static std::shared_ptr<const FilterWorld> made;
  if (made) return made;
  const auto cornell = scene::built_in("cornell");
  if (!cornell) return cornell.status();
  const auto rays = scene::Rays::make(cornell.value());
  if (!rays) return rays.status();
  FilterWorld w;
  const scene::Probes probes = scene::place_probes(cornell.value(), {2, 2, 2});
  scene::ProbeLight light;
  light.lamp_pieces = 16;
  scene::ProbeHits hits = scene::cast_probes(probes, rays.value(), 64, &light);
  w.params.grid = probes.grid;
  w.params.maps = {64, 1, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
  for (const double v : hits.radiance) w.radiance.push_back(static_cast<float>(v));
  for (const double v : hits.distance) w.distance.push_back(std::isfinite(v) ? static_cast<float>(v) : 1e30);
  for (std::uint32_t i = 0; i < 24; ++i) {
    const double z = 2 * scene::random01(2 * i, 71) - 1, phi = 2 * 3.141592653589793 * scene::random01(2 * i + 1, 71), r = std::sqrt(1 - z * z);
    w.normals.push_back({r * std::cos(phi), r * std::sin(phi), z});
  }
  for (std::size_t probe = 0; probe < 8; ++probe)
    for (const auto& n : w.normals)
      for (const double v : truth::probe_irradiance(64, std::span(w.radiance).subspan(probe * 64 * 64 * 4, 64 * 64 * 4), n, 2)) {
        w.truth.push_back(v);
        w.mean += v;
      }
  w.mean /= static_cast<double>(w.truth.size());
  made = std::make_shared<FilterWorld>(std::move(w));
  return made;
}

ProbeIrradianceParams params_of(const FilterWorld& w, const FilterSetting& s) {
  ProbeIrradianceParams p = w.params;
  p.irradiance_size = s.irradiance;
  p.moments_size = s.moments;
  p.samples = s.samples;
  p.irradiance_format = s.half ? Format::f16x4 : Format::f32x4;
  p.moments_format = s.half ? Format::f16x2 : Format::f32x2;
  return p;
}

double apart(const Values& a, const Values& b, double mean) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (i % 4 != 3) squares += (a[i] - b[i]) * (a[i] - b[i]), ++count;
  return a.size() == b.size() ? std::sqrt(squares / count) / mean : std::numeric_limits<double>::quiet_NaN();
}

// Looked up between texels, against quadrature.
double off_truth(const FilterWorld& w, const Values& maps, int size) {
  double squares = 0;
  for (std::size_t probe = 0; probe < 8; ++probe)
    for (std::size_t k = 0; k < w.normals.size(); ++k) {
      const auto e = truth::look_up(maps, 4, size, probe, w.normals[k]);
      for (std::size_t c = 0; c < 3; ++c) squares += std::pow(e[c] - w.truth[3 * (probe * w.normals.size() + k) + c], 2);
    }
  return std::sqrt(squares / static_cast<double>(w.truth.size())) / w.mean;
}

Status measure_filter(Session& session, const FilterSetting& s) {
  const auto world = filter_world();
  if (!world) return world.status();
  const FilterWorld& w = *world.value();
  const ProbeIrradianceParams p = params_of(w, s);
  auto made = cases::Run::make(session.context(), plan(p, session.context().profile()));
  if (!made) return made.status();
  cases::Run& run = made.value();
  if (Status status = run.write("radiance", w.radiance); !status) return status;
  if (Status status = run.write("distance", w.distance); !status) return status;
  const auto ms = session.time(run, label(s));
  if (!ms) return ms.status();
  const auto result = run.read("irradiance");
  if (!result) return result.status();
  const auto on = [&](Context& context, bool half) -> Result<Values> {
    FilterSetting t = s;
    t.half = half;
    auto r = cases::filter(context, params_of(w, t), {w.radiance, w.distance});
    if (!r) return r.status();
    return r.value().irradiance;
  };
  const auto errors = session.errors(
      label(s), {"irradiance for random normals: root mean square of x - quadrature, over the mean"}, hash_values(result.value()), true,
      [&]() -> Result<std::vector<Oracle>> {
        const auto stored = on(session.cpu_float(), s.half), f32 = on(session.cpu_float(), false), exact = on(session.cpu_double(), false);
        if (!stored) return stored.status();
        if (!f32) return f32.status();
        if (!exact) return exact.status();
        return std::vector<Oracle>{{hash_values(stored.value()), apart(f32.value(), exact.value(), w.mean),
                                    apart(stored.value(), f32.value(), w.mean), off_truth(w, exact.value(), s.irradiance)}};
      },
      [&]() -> Result<std::vector<double>> {
        const auto expected = on(session.cpu_float(), s.half);
        if (!expected) return expected.status();
        return std::vector{apart(result.value(), expected.value(), w.mean)};
      });
  if (!errors) return errors.status();
  FrontierRow row{"probe_irradiance", "cosine and distances", "cornell (generated)", "8 probes of 64x64", {{"format", s.half ? "f16" : "f32"}},
                  {{"irradiance", s.irradiance}, {"distances", s.moments}, {"averaged_to", s.samples}}, s.half ? "f16" : "f32", errors.value()[0]};
  row.update = cell_of(ms.value());
  row.costs_of(run);
  session.frontier(row);
  return {};
}

// ---- whole scenes against path tracing ----

struct SceneSetting {
  Place place;
  int probes = 8;      // along the longest side
  int size = 32, irradiance = 8, distances = 16;
  bool visibility = true;
  bool find_dead = true;
};

std::string variant(const SceneSetting& s) {
  return std::string(s.visibility ? "filtered" : "plain") + (s.find_dead ? "" : ", dead probes count");
}

std::string label(const SceneSetting& s) {
  return fmt::format("probe_shade {} {} probes, maps of {}, {}, {} in {}", variant(s), s.probes, s.size, s.irradiance, s.distances, s.place.name);
}

scene::ProbeSceneSettings settings_of(const scene::Scene& scene, const SceneSetting& s, bool quick) {
  scene::ProbeSceneSettings p;
  p.count = scene::probe_cubes(scene, s.probes);
  p.size = s.size;
  p.sky_samples = quick ? 16 : 64;
  p.filter.irradiance_size = s.irradiance;
  p.filter.moments_size = s.visibility ? s.distances : 0;
  p.find_dead = s.find_dead;
  return p;
}

std::vector<double> three(const std::vector<float>& four) {
  std::vector<double> v;
  for (std::size_t i = 0; i < four.size(); ++i)
    if (i % 4 < 3) v.push_back(static_cast<double>(four[i]));
  return v;
}

// Means of the three channels: what shadows receive over the truth there (receivers of less than a quarter of the mean), and the
// share of the truth that the darkest twentieth of all receivers gets at most.
struct Leaking {
  double shadow = 0, pools = 0;
};
Leaking leaking(const Stage& stage, const std::vector<double>& x) {
  double ours = 0, truth = 0;
  std::vector<double> shares;
  for (std::size_t i = 0; i < stage.pixels.size(); ++i) {
    double e = 0, t = 0;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) e += x[c] / 3, t += (stage.t1[c] + stage.t2[c]) / 6;
    if (t < stage.mean / 4) ours += e, truth += t;
    shares.push_back(e / std::max(t, 1e-6 * stage.mean));
  }
  if (shares.empty()) return {};
  std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 20), shares.end());
  return {truth > 0 ? ours / truth : 0, shares[shares.size() / 20]};
}

// Irradiance from the same probes with every map twice as fine: what is left are probes, their weights and the scene between them.
// Filtered, then plain: both take the same maps, which take long.
Result<std::vector<double>> finer(Session& session, const Stage& stage, const SceneSetting& s) {
  SceneSetting fine = s;
  fine.visibility = true;
  const std::string what = "finer maps: " + label(fine);
  fine.size *= 2, fine.irradiance *= 2, fine.distances *= 2;
  auto both = session.shared(what, [&]() -> Result<std::vector<double>> {
    const scene::ProbeSceneSettings p = settings_of(stage.scene, fine, session.settings().quick);
    auto built = scene::ProbeScene::build(borrowed(session), *stage.rays, p);
    if (!built) return built.status();
    if (Status lit = built.value().light(); !lit) return lit;
    std::vector<double> found;
    for (const bool visibility : {true, false}) {
      ProbeShadeParams shade = p.bounce;
      shade.visibility = visibility;
      const auto light = built.value().shade(shade, probe_receivers(stage));
      if (!light) return light.status();
      const std::vector<double> x = three(light.value().indirect);
      found.insert(found.end(), x.begin(), x.end());
    }
    return found;
  });
  if (!both) return both;
  const auto half = both.value().begin() + static_cast<std::ptrdiff_t>(both.value().size() / 2);
  return s.visibility ? std::vector<double>(both.value().begin(), half) : std::vector<double>(half, both.value().end());
}

Status measure_scene(Session& session, const SceneSetting& s) {
  const bool quick = session.settings().quick;
  const auto found = stage_of(s.place, quick);
  if (!found) return found.status();
  const Stage& stage = *found.value();
  const scene::ProbeSceneSettings settings = settings_of(stage.scene, s, quick);
  auto built = scene::ProbeScene::build(borrowed(session), *stage.rays, settings);
  if (!built) return built.status();
  scene::ProbeScene& probes = built.value();
  if (Status lit = probes.light(); !lit) return lit;
  const std::vector<double> update{total(probes.light_steps())};
  const std::vector<float> receivers = probe_receivers(stage);
  std::vector<double> shade;
  scene::ProbeLit light;
  for (int run = 0; run < (session.is_cpu() ? 2 : 10); ++run) {
    auto lit = probes.shade(settings.bounce, receivers);
    if (!lit) return lit.status();
    light = std::move(lit).value();
    if (run > 0) shade.push_back(total(probes.shade_steps()));  // the first compiles
  }
  const std::vector<double> x = three(light.indirect);
  const Relative method = relative(x, x, stage.t1, stage.t2, stage.mean);
  FrontierRow row{"probe_shade", variant(s), s.place.name, fmt::format("{} receivers", stage.pixels.size()),
                  {{"format", "f16"}}, {{"probes", s.probes}, {"seen", s.size}, {"irradiance", s.irradiance}, {"distances", s.visibility ? s.distances : 0}},
                  "", {bounce_metric}};
  row.error.method = method.value;
  row.error.standard_error = method.error;
  const Leaking leaks = leaking(stage, x);
  row.knobs.set("shadow_energy", leaks.shadow);
  row.knobs.set("darkest_twentieth", leaks.pools);
  if (!quick && !session.is_cpu()) {
    const auto fine = finer(session, stage, s);
    if (!fine) return fine.status();
    const Relative model = relative(fine.value(), fine.value(), stage.t1, stage.t2, stage.mean);
    const Relative maps = relative(x, x, fine.value(), fine.value(), stage.mean);
    row.error.model = model.value;
    row.error.discretization = maps.value;
  }
  row.build = cell_of(summarise({total(probes.build_steps())}));
  row.update = cell_of(summarise(update));
  row.shade = cell_of(summarise(shade));
  row.memory = probes.memory_bytes();
  session.frontier(row);
  return {};
}

// ---- leaks ----

Status leak_row(Session& session, const char* kernel, const std::string& variant, const Cell& knobs, const Leak& l, std::size_t receivers,
                const std::vector<double>& ms, std::size_t memory) {
  FrontierRow row{kernel, variant, "two_rooms (generated)", fmt::format("{} receivers", receivers), {{"format", "f16"}}, knobs, "leaks", {leak_metric}};
  row.knobs.set("lit_room", l.lit);
  row.knobs.set("lit_room_error", l.relative);
  row.error.method = l.dark;
  row.shade = cell_of(summarise(ms));
  row.memory = memory;
  session.frontier(row);
  return {};
}

Status probes_leak(Session& session, int count, bool visibility) {
  const auto found = leak_stage(session.settings().quick);
  if (!found) return found.status();
  const LeakStage& stage = *found.value();
  SceneSetting s;
  s.probes = count;
  s.visibility = visibility;
  const scene::ProbeSceneSettings settings = settings_of(stage.scene, s, true);
  auto built = scene::ProbeScene::build(borrowed(session), *stage.rays, settings);
  if (!built) return built.status();
  if (Status lit = built.value().light(); !lit) return lit;
  std::vector<double> ms, x;
  for (int run = 0; run < (session.is_cpu() ? 2 : 6); ++run) {
    const auto lit = built.value().shade(settings.bounce, stage.receivers);
    if (!lit) return lit.status();
    if (run > 0) ms.push_back(total(built.value().shade_steps()));
    x.assign(lit.value().indirect.begin(), lit.value().indirect.end());
  }
  return leak_row(session, "probe_shade", visibility ? "filtered" : "plain", {{"probes", count}}, leak(stage, x, 4), stage.count(), ms,
                  built.value().memory_bytes());
}

Status cones_leak(Session& session, int resolution, bool anisotropic) {
  const auto found = leak_stage(session.settings().quick);
  if (!found) return found.status();
  const LeakStage& stage = *found.value();
  scene::VoxelSceneSettings settings;
  settings.resolution = resolution;
  settings.rays = &*stage.rays;
  settings.variant = anisotropic ? ConeVariant::anisotropic : ConeVariant::isotropic;
  auto built = scene::VoxelScene::build(borrowed(session), stage.scene, settings);
  if (!built) return built.status();
  scene::VoxelScene& voxels = built.value();
  if (Status lit = voxels.light(); !lit) return lit;
  std::vector<float> receivers = stage.receivers;  // about the grid's origin
  for (std::size_t i = 0; i < receivers.size(); ++i)
    if (i % 8 < 3) receivers[i] -= static_cast<float>(voxels.grid().origin[i % 8]);
  ConeTraceParams cones;
  cones.step_scale = 0.5;
  cones.occlusion = false;
  const auto light = voxels.trace(cones, receivers, {});
  if (!light) return light.status();
  double ms = 0;
  for (const scene::VoxelStep& step : voxels.shade_steps()) ms += step.ms;
  const std::vector<double> x(light.value().indirect.begin(), light.value().indirect.end());
  return leak_row(session, "cone_trace", anisotropic ? "anisotropic" : "isotropic", {{"resolution", resolution}, {"cones", 6}, {"step", 0.5}},
                  leak(stage, x, 4), stage.count(), {ms}, voxels.memory_bytes());
}

}  // namespace

std::shared_ptr<Context> borrowed(Session& session) { return {std::shared_ptr<Context>(), &session.context()}; }

std::vector<float> probe_receivers(const Stage& stage) {
  std::vector<float> receivers;
  for (const std::size_t i : stage.pixels) {
    const dvec3 p = stage.seen.at(stage.seen.position, i), n = stage.seen.at(stage.seen.normal, i);
    for (const double v : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) receivers.push_back(static_cast<float>(v));
  }
  return receivers;
}

std::vector<Job> probe_light_grid(Session& session, std::vector<std::string>& missing) {
  const bool quick = session.settings().quick;
  std::vector<Job> jobs;
  const auto filter = [&](const FilterSetting& s) { jobs.push_back({label(s), [&session, s] { return measure_filter(session, s); }}); };
  filter({});
  if (!quick) {
    for (const int size : {4, 16, 32, 64}) filter({size, 16});
    for (const int samples : {8, 16, 64}) filter({8, 16, samples});
    for (const int size : {8, 32}) filter({8, size});
    filter({8, 16, 32, false});
    filter({16, 16, 64});
  }
  const auto scene = [&](const SceneSetting& s) { jobs.push_back({label(s), [&session, s] { return measure_scene(session, s); }}); };
  for (const Place& place : places(missing)) {
    if (quick && place.name.starts_with("Sponza")) continue;
    const int few = place.name.starts_with("cornell") ? 4 : 8;  // a hall wants more than a room
    for (const int probes : quick || session.is_cpu() ? std::vector<int>{few} : std::vector<int>{4, 8, 12})
      for (const bool visibility : {true, false})
        if (visibility || !quick) scene({place, probes, 32, 8, 16, visibility});
    if (quick || session.is_cpu() || !place.name.starts_with("cornell")) continue;
    scene({place, 8, 16, 8, 16});
    scene({place, 8, 64, 8, 16});
    scene({place, 8, 32, 16, 16});
    scene({place, 8, 32, 8, 32});
  }
  if (!quick && !session.is_cpu())
    for (const char* name : {"pillars", "curtain"})
      for (const int probes : {3, 6, 12})
        for (const bool visibility : {false, true})
          for (const bool find_dead : {true, false}) {
            if (!find_dead && (probes != 3 || std::string(name) != "pillars")) continue;
            scene({{fmt::format("{} (generated)", name), name, {{}, {}, 0}}, probes, 32, 8, 16, visibility, find_dead});
          }
  for (const int count : quick || session.is_cpu() ? std::vector<int>{8} : std::vector<int>{4, 8, 12, 16})
    for (const bool visibility : {false, true})
      jobs.push_back({fmt::format("probe_shade leaks of {} probes, {}", count, visibility ? "filtered" : "plain"),
                      [=, &session] { return probes_leak(session, count, visibility); }});
  if (!session.is_cpu())
    for (const int resolution : quick ? std::vector<int>{64} : std::vector<int>{64, 128})
      for (const bool anisotropic : {false, true})
        if (!quick || !anisotropic)
          jobs.push_back({fmt::format("cone_trace leaks of {}^3, {}", resolution, anisotropic ? "anisotropic" : "isotropic"),
                          [=, &session] { return cones_leak(session, resolution, anisotropic); }});
  return jobs;
}

}  // namespace luxel::report

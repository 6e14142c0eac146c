// What probes' light leaves out where it is not needed, the source's claims measured again, and the driver's rate of reading.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <fmt/format.h>

#include <luxel/bilateral.h>
#include <luxel/probe_build.h>
#include <luxel/probe_trace.h>

#include "bench/report/claims.h"
#include "bench/report/limits.h"
#include "bench/report/probe_light.h"
#include "bench/report/shared_plans.h"
#include "bench/scene/images.h"
#include "bench/truth/path_lights.h"
#include "tests/cases/probe_support.h"

namespace luxel::report {
namespace {

using cases::Values;
using glm::dvec3;

const Place cornell{"cornell (generated)", "cornell", {{}, {}, 0}};

std::vector<float> floats(const std::vector<std::uint8_t>& bytes) {
  std::vector<float> v(bytes.size() / sizeof(float));
  std::memcpy(v.data(), bytes.data(), v.size() * sizeof(float));
  return v;
}

std::vector<float> as_floats(const std::vector<double>& v) {
  std::vector<float> f;
  for (const double x : v) f.push_back(std::isfinite(x) ? static_cast<float>(x) : 1e30f);
  return f;
}

// Probes of a scene in the memory of SharedPlans: what they see, and the maps of light. 128 x 64 receivers and more: those of a
// picture, pixels without a surface among them (their normal is 0).
struct World {
  scene::GBuffer seen;
  scene::Probes probes;
  std::unique_ptr<SharedPlans> plans;
  ProbeIrradianceParams filter;
  ProbeShadeParams shade;
  std::size_t pixels() const { return seen.pixels(); }
};

Result<std::shared_ptr<World>> world_of(Session& session, const scene::Rays& rays, const scene::Camera& camera, int width, int height, int count,
                                        int size) {
  auto w = std::make_shared<World>();
  w->seen = scene::gbuffer(rays, camera, width, height);
  w->probes = scene::place_probes(rays.scene(), scene::probe_cubes(rays.scene(), count));
  scene::find_dead_probes(w->probes, rays);
  scene::ProbeLight light;
  light.lamp_pieces = 16;
  light.sky_samples = rays.scene().sky.dark() ? 0 : 16;
  const scene::ProbeHits hits = scene::cast_probes(w->probes, rays, size, &light);
  w->plans = std::make_unique<SharedPlans>(session.context());
  std::vector<float> receivers;
  for (std::size_t i = 0; i < w->pixels(); ++i) {
    const dvec3 p = w->seen.at(w->seen.position, i), n = w->seen.at(w->seen.normal, i);
    for (const double v : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) receivers.push_back(static_cast<float>(v));
  }
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i < w->probes.size(); ++i)
    if (w->probes.alive[i] != 0) list.push_back(static_cast<std::uint32_t>(i));
  SharedPlans& plans = *w->plans;
  if (Status s = plans.put("receivers", receivers, Format::f32x4); !s) return s;
  if (Status s = plans.put("radiance", as_floats(hits.radiance), Format::f32x4); !s) return s;
  if (Status s = plans.put("distance", as_floats(hits.distance), Format::f32x1); !s) return s;
  if (Status s = plans.put("positions", as_floats(w->probes.positions()), Format::f32x4); !s) return s;
  if (Status s = plans.put("list", list, Format::u32); !s) return s;
  w->filter.grid = w->shade.grid = w->probes.grid;
  w->filter.maps = {size, 1, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
  w->filter.irradiance_size = w->shade.irradiance_size = 8;
  w->shade.width = width;
  w->shade.height = height;
  const auto maps = plans.step(plan(w->filter, session.context().profile()), {{"irradiance", "light"}});
  if (!maps) return maps.status();
  if (const auto ms = maps.value()(); !ms) return ms.status();
  return w;
}

Result<std::shared_ptr<World>> atrium_world(Session& session) {
  static std::map<std::string, std::shared_ptr<World>> made;
  static std::shared_ptr<scene::Scene> atrium;
  auto& world = made[session.device()];
  if (world) return world;
  if (!atrium) {
    auto found = scene::scene_from("atrium:20000");
    if (!found) return found.status();
    atrium = std::make_shared<scene::Scene>(std::move(found).value());
  }
  const auto rays = scene::Rays::make(*atrium);
  if (!rays) return rays.status();
  const bool quick = session.settings().quick;
  auto w = world_of(session, rays.value(), atrium->camera, quick ? 160 : 512, quick ? 90 : 288, 8, 16);
  if (!w) return w.status();
  return world = w.value();
}

Result<SharedPlans::Step> shading(Session& session, World& w, const ProbeShadeParams& p) {
  return w.plans->step(plan(p, session.context().profile()), {{"irradiance", "lit"}});
}

// `fewer` leaves out what `more` does. The error: root mean square of the difference over the mean.
Status compare(Session& session, const char* kernel, World& w, const Result<SharedPlans::Step>& more, const Result<SharedPlans::Step>& fewer,
               const std::string& output, const std::string& what, int level, double saved_bytes, bool halves) {
  if (!more) return more.status();
  if (!fewer) return fewer.status();
  const auto pair = session.interleave(more.value(), fewer.value(), fmt::format("{} left out: {}", kernel, what));
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  Values x[2];
  for (const int k : {0, 1}) {
    if (const auto ms = (k == 0 ? more : fewer).value()(); !ms) return ms.status();
    const auto bytes = w.plans->read(output);
    if (!bytes) return bytes.status();
    if (halves) {
      x[k].assign(bytes.value().begin(), bytes.value().end());  // whether any bit differs
    } else {
      for (const float v : floats(bytes.value())) x[k].push_back(static_cast<double>(v));
    }
  }
  double squares = 0, sum = 0, n = 0;
  for (std::size_t i = 0; i < x[0].size(); ++i)
    if (halves || i % 4 < 3) squares += (x[0][i] - x[1][i]) * (x[0][i] - x[1][i]), sum += x[0][i], ++n;
  session.row("left_out", {{"kernel", kernel},
                           {"scene", "atrium (generated)"},
                           {"what", what},
                           {"level", level},
                           {"saved_ms", saved.median},
                           {"saved_bytes", saved_bytes},
                           {"error", sum > 0 ? std::sqrt(squares / n) / (sum / n) : 0},
                           {"device", session.device()}});
  return {};
}

Status left_out(Session& session, const std::string& what) {
  const auto world = atrium_world(session);
  if (!world) return world.status();
  World& w = *world.value();
  ProbeShadeParams more = w.shade, fewer = w.shade;
  more.grid.placed = fewer.grid.placed = false;
  const std::size_t probes = w.probes.size();
  if (what == "visibility") {
    fewer.visibility = false;
    return compare(session, "probe_shade", w, shading(session, w, more), shading(session, w, fewer), "lit", what + " where little is hidden", 1,
                   static_cast<double>(probe_map_texels(probes, more.moments_size) * 4), false);
  }
  if (what == "facing") {
    fewer.facing = ProbeFacing::all;
    return compare(session, "probe_shade", w, shading(session, w, more), shading(session, w, fewer), "lit", "the test of facing", 1, 0, false);
  }
  if (what == "positions") {
    more.grid.placed = true;
    const std::vector<double> regular = [&] {
      scene::Probes all = w.probes;
      all.alive.assign(all.size(), 1);
      return all.positions();
    }();
    if (Status s = w.plans->put("regular", as_floats(regular), Format::f32x4); !s) return s;
    return compare(session, "probe_shade", w, w.plans->step(plan(more, session.context().profile()), {{"irradiance", "lit"}, {"positions", "regular"}}),
                   shading(session, w, fewer), "lit", "positions of a regular grid", 1, static_cast<double>(probes * 16), false);
  }
  if (what == "counters") {
    more.count = true;
    const std::vector<std::uint32_t> zeros(probe_shade_outcomes, 0);
    if (Status s = w.plans->put("counters", zeros, Format::u32); !s) return s;
    return compare(session, "probe_shade", w, shading(session, w, more), shading(session, w, fewer), "lit", "counters", 1, 4 * probe_shade_outcomes, false);
  }
  // Half of the probes: those that this frame's turn or the camera asks for.
  ProbeIrradianceParams all = w.filter, some = w.filter;
  std::vector<std::uint32_t> half;
  for (std::uint32_t i = 0; i < probes; i += 2) half.push_back(i);
  some.listed = static_cast<int>(half.size());
  if (Status s = w.plans->put("half", half, Format::u32); !s) return s;
  const auto& profile = session.context().profile();
  return compare(session, "probe_irradiance", w, w.plans->step(plan(all, profile), {{"irradiance", "light"}}),
                 w.plans->step(plan(some, profile), {{"irradiance", "light"}, {"list", "half"}}), "light", "probes that are not listed (every other one)", 2, 0, true);
}

// Eight probes' texels a receiver: the nearest one of each map, and the four of a bilinear look-up, which shading takes.
Status beside_reads(Session& session, int corners) {
  const auto world = atrium_world(session);
  if (!world) return world.status();
  World& w = *world.value();
  ProbeShadeParams p = w.shade;
  p.grid.placed = false;
  const auto ours = shading(session, w, p);
  if (!ours) return ours.status();
  const auto loop = w.plans->step(probe_reads_plan({p.width, p.height, p.grid.count, p.irradiance_size, p.moments_size, true, corners},
                                                   session.context().profile()), {{"dst", "reads"}});
  if (!loop) return loop.status();
  const auto pair = session.interleave(ours.value(), loop.value(), fmt::format("probe_shade peer: reads of {}", corners));
  if (!pair) return pair.status();
  const Sample ratio = summarise(ratios(pair.value().b, pair.value().a));
  const double receivers = static_cast<double>(w.pixels());
  session.row("peers", {{"peer", corners == 1 ? "the eight texels of a receiver (irradiance and distances, nearest), read in a loop"
                                              : "the eight look-ups of a receiver (irradiance and distances, four texels each), read in a loop"},
                        {"version", "-"},
                        {"kernel", "probe_shade"},
                        {"size", fmt::format("{} receivers", w.pixels())},
                        {"time_ms", cell_of(summarise(pair.value().b))},
                        {"error", nullptr},
                        {"ratio", ratio.median},
                        {"q1", ratio.q1},
                        {"q3", ratio.q3},
                        {"device", session.device()},
                        {"options", {{"format", "f16"}, {"ns_a_receiver", summarise(pair.value().a).median * 1e6 / receivers}}},
                        {"own_ms", cell_of(summarise(pair.value().a))},
                        {"own_error", nullptr},
                        {"goal", 1.0 / 3}});
  return {};
}

// One cosine-distributed ray a pixel through the probes and a filter of 12 pixels, steps of 2, against eight prefiltered probes; and
// rays enough to need no filter. Errors are those of the stage's receivers: `large` measures time alone, at 1280x720.
Status against_rays(Session& session, bool large) {
  const bool quick = session.settings().quick;
  const auto found = stage_of(cornell, quick);
  if (!found) return found.status();
  const Stage& stage = *found.value();
  const int width = large ? 1280 : stage.seen.width, height = large ? 720 : stage.seen.height;
  constexpr int ratio = 16, many = 64;
  const int size = quick ? 64 : 128;
  const auto made = world_of(session, *stage.rays, stage.scene.camera, width, height, 4, size);
  if (!made) return made.status();
  World& w = *made.value();
  SharedPlans& plans = *w.plans;
  const Profile& profile = session.context().profile();

  ProbeTraceParams trace;
  trace.grid = w.probes.grid;
  trace.maps = {size, ratio, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
  trace.bias = 1;
  ProbeFetchParams fetch;
  fetch.maps = trace.maps;
  fetch.probes = static_cast<int>(w.probes.size());
  ProbeMinimumParams minimum{trace.maps, fetch.probes};
  const auto least = plans.step(plan(minimum, profile), {{"distances", "distance"}});
  if (!least) return least.status();
  if (const auto ms = least.value()(); !ms) return ms.status();
  const auto rays_of = [&](int each) {
    std::vector<float> rays;
    for (std::size_t i = 0; i < w.pixels(); ++i)
      for (int k = 0; k < each; ++k) {
        const dvec3 p = w.seen.at(w.seen.position, i), n = w.seen.at(w.seen.normal, i);
        truth::Random random(7, i, static_cast<std::uint64_t>(k));
        const double u = random.next(), v = random.next();
        const dvec3 d = n == dvec3(0) ? n : truth::cosine_direction(n, {u, v});
        for (const double x : {p.x, p.y, p.z, 0.0, d.x, d.y, d.z, 1e30}) rays.push_back(static_cast<float>(x));
      }
    return rays;
  };
  const auto traced = [&](int each, const std::string& prefix) -> Result<std::vector<SharedPlans::Step>> {
    trace.rays = fetch.rays = static_cast<int>(w.pixels()) * each;
    if (Status s = plans.put(prefix + "rays", rays_of(each), Format::f32x4); !s) return s;
    const auto a = plans.step(plan(trace, profile), {{"rays", prefix + "rays"}, {"distances", "distance"}, {"hits", prefix + "hits"}, {"texels", prefix + "texels"}});
    if (!a) return a.status();
    const auto b = plans.step(plan(fetch, profile), {{"hits", prefix + "hits"}, {"texels", prefix + "texels"}, {"seen", prefix + "seen"}});
    if (!b) return b.status();
    return std::vector{a.value(), b.value()};
  };
  auto one = traced(1, "one_");
  if (!one) return one.status();
  BilateralParams blur;
  blur.width = width;
  blur.height = height;
  blur.sigma_space = 6;
  blur.radius = 12;
  blur.step = 2;
  blur.range = RangeTerm::off;
  blur.depth = DepthTerm::plane;
  blur.footprint = 2 * std::tan(stage.scene.camera.fov * std::numbers::pi / 360) / height;
  blur.normal = true;
  blur.sigma_normal = 32;
  std::vector<float> normals;
  for (std::size_t i = 0; i < w.pixels(); ++i)
    for (const double v : {w.seen.at(w.seen.normal, i).x, w.seen.at(w.seen.normal, i).y, w.seen.at(w.seen.normal, i).z, 0.0}) normals.push_back(static_cast<float>(v));
  if (Status s = plans.put("normals", normals, Format::f32x4); !s) return s;
  if (Status s = plans.put("depth", w.seen.depth, Format::f32x1); !s) return s;
  const auto filtered = plans.step(plan(blur, profile), {{"src", "one_seen"}, {"dst", "blurred"}});
  if (!filtered) return filtered.status();
  one.value().push_back(filtered.value());
  const auto prefiltered = shading(session, w, w.shade);
  if (!prefiltered) return prefiltered.status();
  const auto pair = session.interleave(in_turn(one.value()), prefiltered.value(), "probe_shade reproduction: rays");
  if (!pair) return pair.status();
  const Sample r = summarise(ratios(pair.value().a, pair.value().b));
  const auto claim = [&](const char* what, const Sample& found, const std::string& reason) {
    add(session, {what, "McGuire et al. 2017, section 6, figure 11 (13 ms against 0.2 ms)", 65, found,
                  {"half of it or more", found.median >= 65 / 2.0},
                  fmt::format("cornell, {}x{}, {} probes of {}x{}; {}", width, height, w.probes.size(), size, size, reason)});
  };
  constexpr const char* of_one = "prefiltered visibility is 65 times as fast as one ray a pixel with a filter (time ratio)";
  if (large) {
    claim(of_one, r, fmt::format("{:.3g} ms against {:.3g}", summarise(pair.value().a).median, summarise(pair.value().b).median));
    return {};
  }

  // Errors against path tracing, of receivers.
  const auto error = [&](const std::string& name, int each, double factor) -> Result<double> {
    const auto bytes = plans.read(name);
    if (!bytes) return bytes.status();
    const std::vector<float> v = floats(bytes.value());
    std::vector<double> x;
    for (const std::size_t i : stage.pixels)
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (int k = 0; k < each; ++k) sum += static_cast<double>(v[4 * (i * static_cast<std::size_t>(each) + static_cast<std::size_t>(k)) + c]);
        x.push_back(sum / each * factor);
      }
    return relative(x, x, stage.t1, stage.t2, stage.mean).value;
  };
  const auto noisy = error("one_seen", 1, std::numbers::pi), smooth = error("blurred", 1, std::numbers::pi), ours = error("lit", 1, 1);
  auto converged_steps = traced(many, "many_");
  if (!converged_steps) return converged_steps.status();
  const auto slow = session.interleave(in_turn(converged_steps.value()), prefiltered.value(), "probe_shade reproduction: many rays");
  if (!slow) return slow.status();
  const auto converged = error("many_seen", many, std::numbers::pi);
  for (const auto* e : {&noisy, &smooth, &ours, &converged})
    if (!*e) return e->status();
  const std::string errors = fmt::format("mean squared error over mean squared, of path tracing: one ray {:.2f}, with a filter {:.3f}, {} rays {:.4f}, "
                                         "prefiltered {:.4f}",
                                         noisy.value(), smooth.value(), many, converged.value(), ours.value());
  claim(of_one, r, errors);
  claim("prefiltered visibility against 64 rays a pixel without a filter (time ratio; the source's 65 is of one ray)",
        summarise(ratios(slow.value().a, slow.value().b)), errors);
  return {};
}

// White noise of radiance in every frame, through the blend: what is left of its standard deviation.
Status hysteresis(Session& session, double keep) {
  ProbeIrradianceParams p;
  p.grid.count = {4, 4, 1};
  p.maps = {16, 1, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
  p.samples = 16;
  p.irradiance_size = 8;
  p.moments_size = 0;
  p.irradiance_format = Format::f32x4;
  p.hysteresis = keep;
  const int frames = static_cast<int>(std::ceil(std::log(1e-3) / std::log(keep)));
  const std::size_t texels = 16 * 16 * 16;
  Values mean, alone, blended;
  cases::ProbeFiltered now;
  for (int f = 0; f < frames; ++f) {
    cases::ProbeSeen seen;
    for (std::uint32_t i = 0; i < texels; ++i) {
      const double v = scene::random01(static_cast<std::uint32_t>(f) * 65536u + i, 5) < 0.125 ? 8 : 0;
      seen.radiance.insert(seen.radiance.end(), {v, v, v, 0});
    }
    p.previous = f > 0;
    auto next = cases::filter(session.context(), p, seen, {}, now);
    if (!next) return next.status();
    now = std::move(next).value();
    if (f == 0) alone = now.irradiance;
  }
  blended = now.irradiance;
  const auto deviation = [&](const Values& v) {
    double squares = 0, n = 0;
    for (std::size_t i = 0; i < v.size(); i += 4) squares += (v[i] - std::numbers::pi) * (v[i] - std::numbers::pi), ++n;
    return std::sqrt(squares / n);
  };
  const double left = deviation(blended) / deviation(alone), expected = std::sqrt((1 - keep) / (1 + keep));
  add(session, {fmt::format("a hysteresis of {:.0f} % leaves sqrt((1 - h) / (1 + h)) of a frame's noise", 100 * keep),
                "McGuire et al. 2017, 5.1 (98 % and 75 %; the formula is that of an exponential mean)", expected, once(left),
                {"within 20 %", std::fabs(left / expected - 1) <= 0.2},
                fmt::format("{} frames of 16 probes whose texels hold 8 with probability 1/8", frames)});
  return {};
}

}  // namespace

std::vector<Job> probe_light_left_out(Session& session) {
  std::vector<Job> jobs;
  for (const std::string what : {"visibility", "facing", "positions", "counters", "list"})
    jobs.push_back({fmt::format("{} left out: {}", what == "list" ? "probe_irradiance" : "probe_shade", what),
                    [&session, what] { return left_out(session, what); }});
  return jobs;
}

std::vector<Job> probe_light_reproduction(Session& session) {
  std::vector<Job> jobs;
  if (!session.is_cpu()) jobs.push_back({"probe_shade reproduction: one ray a pixel", [&session] { return against_rays(session, false); }});
  if (!session.is_cpu() && !session.settings().quick)
    jobs.push_back({"probe_shade reproduction: one ray a pixel, 1280x720", [&session] { return against_rays(session, true); }});
  jobs.push_back({"probe_irradiance reproduction: hysteresis 75 %", [&session] { return hysteresis(session, 0.75); }});
  if (!session.settings().quick)
    jobs.push_back({"probe_irradiance reproduction: hysteresis 98 %", [&session] { return hysteresis(session, 0.98); }});
  return jobs;
}

std::vector<Job> probe_light_peers(Session& session) {
  if (session.is_cpu()) return {};
  std::vector<Job> jobs;
  for (const int corners : {1, 4})
    jobs.push_back({fmt::format("probe_shade peer: reads of {}", corners), [&session, corners] { return beside_reads(session, corners); }});
  return jobs;
}

}  // namespace luxel::report

#include "bench/report/screens.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "bench/report/dependent_reads.h"
#include "bench/scene/images.h"
#include "bench/scene/screen.h"
#include "tests/cases/compare.h"
#include "tests/cases/hiz_ssr_support.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;

// The atrium's G-buffer. Every surface mirrors, so that rays of all directions and lengths are followed.
struct ScreenWorld {
  HizSsrParams params;
  Values depth, normals;
  std::map<SsrVariant, Values> levels = {};  // depth with its pyramid, once it is asked for
};

Result<ScreenWorld> make_world(int width, int height) {
  const auto made = scene::built_in("atrium");
  if (!made) return made.status();
  const auto rays = scene::Rays::make(made.value());
  if (!rays) return rays.status();
  const scene::GBuffer g = scene::gbuffer(rays.value(), made.value().camera, width, height);
  ScreenWorld w;
  w.params = scene::screen_params(g, made.value().camera);
  const scene::Bounds box = scene::bounds(made.value());
  w.params.thickness = glm::length(box.high - box.low) / 64;
  w.depth.assign(g.depth.begin(), g.depth.end());
  const std::vector<float> normals = scene::screen_normals(g, made.value().camera);
  w.normals.assign(normals.begin(), normals.end());
  for (std::size_t i = 0; i < g.pixels(); ++i) w.normals[4 * i + 3] = g.surface_at(i) ? 0 : 2;
  return w;
}

Result<std::shared_ptr<ScreenWorld>> world_of(int width, int height) {
  static std::map<int, std::shared_ptr<ScreenWorld>> worlds;
  auto& world = worlds[width];
  if (!world) {
    auto made = make_world(width, height);
    if (!made) return made.status();
    world = std::make_shared<ScreenWorld>(std::move(made).value());
  }
  return world;
}

Result<std::shared_ptr<Run>> ready(Session& session, ScreenWorld& world, const HizSsrParams& p, const Values& normals,
                                   bool fixed = false) {
  Values& levels = world.levels[p.variant];
  if (levels.empty()) {
    auto all = cases::with_pyramid(session.cpu_float(), p, world.depth);
    if (!all) return all.status();
    levels = std::move(all).value();
  }
  auto planned = plan(p, session.context().profile());
  if (planned && fixed)
    for (Pass& pass : planned.value().passes) pass.counts.reset();
  auto made = Run::make(session.context(), planned);
  if (!made) return made.status();
  const auto run = std::make_shared<Run>(std::move(made).value());
  if (Status s = run->write("depth", levels); !s) return s;
  if (Status s = run->write("normals", normals); !s) return s;
  if (p.count)
    if (Status s = run->write("counters", Values(ssr_outcomes, 0.0)); !s) return s;
  return run;
}

const char* name(SsrVariant v) {
  constexpr const char* names[] = {"hiz", "dda", "linear", "stochastic"};
  return names[static_cast<int>(v)];
}

// Where every ray ended: outcome, and the pixel that was hit.
std::vector<int> ends_of(const HizSsrParams& p, const Values& hits, const Values& paths) {
  std::vector<int> ends;
  for (std::size_t i = 0; i < paths.size(); i += 4) {
    const bool hit = static_cast<int>(paths[i + 1]) == static_cast<int>(SsrOutcome::hit);
    ends.push_back(hit ? static_cast<int>(hits[i + 1] * p.height) * p.width + static_cast<int>(hits[i] * p.width)
                       : -static_cast<int>(paths[i + 1]));
  }
  return ends;
}

// The share of rays that end differently.
double apart(const std::vector<int>& a, const std::vector<int>& b) {
  double different = 0, rays = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (b[i] != 0) different += a[i] != b[i], ++rays;
  return a.size() == b.size() && rays > 0 ? different / rays : std::numeric_limits<double>::quiet_NaN();
}

Result<std::vector<int>> ends_on(Context& context, const HizSsrParams& p, const ScreenWorld& world) {
  const auto r = cases::follow(context, p, world.depth, world.normals);
  if (!r) return r.status();
  return ends_of(p, r.value().hits, r.value().paths);
}

std::uint64_t bits_of(Values a, const Values& b) {
  a.insert(a.end(), b.begin(), b.end());
  return hash_values(a);
}

Status measure(Session& session, int width, int height, SsrVariant variant, double reach, int steps) {
  const auto found = world_of(width, height);
  if (!found) return found.status();
  ScreenWorld& world = *found.value();
  HizSsrParams p = world.params;
  p.variant = variant;
  p.max_distance = reach;
  p.steps = steps;
  const std::string where = fmt::format("hiz_ssr {} {}x{} reach {} steps {}", name(variant), width, height, reach, steps);
  const auto run = ready(session, world, p, world.normals);
  if (!run) return run.status();
  const Result<Sample> ms = session.time(*run.value(), where);
  if (!ms) return ms.status();
  const auto hits = run.value()->read("hits"), paths = run.value()->read("paths");
  if (!hits) return hits.status();
  if (!paths) return paths.status();
  double looks = 0, rays = 0;
  for (std::size_t i = 0; i < paths.value().size(); i += 4) looks += paths.value()[i + 3], rays += paths.value()[i + 1] != 0;
  // In double dda is the exhaustive walk (stability rows).
  const auto errors = session.errors(
      where, {"share of rays that end elsewhere than the exhaustive walk's"}, bits_of(hits.value(), paths.value()), true,
      [&]() -> Result<std::vector<Oracle>> {
        HizSsrParams exact = p;
        exact.variant = SsrVariant::dda;
        const auto truth = ends_on(session.cpu_double(), exact, world), in_double = ends_on(session.cpu_double(), p, world);
        const auto in_float = cases::follow(session.cpu_float(), p, world.depth, world.normals);
        if (!truth) return truth.status();
        if (!in_double) return in_double.status();
        if (!in_float) return in_float.status();
        const auto ends = ends_of(p, in_float.value().hits, in_float.value().paths);
        return std::vector<Oracle>{{bits_of(in_float.value().hits, in_float.value().paths), apart(ends, in_double.value()), 0,
                                    apart(in_double.value(), truth.value())}};
      },
      [&]() -> Result<std::vector<double>> {
        const auto expected = ends_on(session.cpu_float(), p, world);
        if (!expected) return expected.status();
        return std::vector<double>{apart(ends_of(p, hits.value(), paths.value()), expected.value())};
      });
  if (!errors) return errors.status();
  FrontierRow row{"hiz_ssr", name(variant), "atrium", fmt::format("{}x{}", width, height), {{"depth", "linear"}},
                  {{"max_distance", reach}, {"looks_a_ray", looks / rays}, {"rays", rays}},
                  fmt::format("reach {}", reach), errors.value()[0]};
  if (variant == SsrVariant::linear) row.knobs.set("steps", steps);
  row.shade = cell_of(ms.value());
  if (hiz_ssr_levels(p) > 1) {
    auto pyramid = Run::make(session.context(), plan(hiz_ssr_pyramid(p), session.context().profile()));
    if (!pyramid) return pyramid.status();
    if (Status s = pyramid.value().write("level_0", world.depth); !s) return s;
    const Result<Sample> build = session.time(pyramid.value(), where + " pyramid");
    if (!build) return build.status();
    row.build = cell_of(build.value());
  }
  row.costs_of(*run.value());
  session.frontier(row);
  return {};
}

// A frame of which 30 of 100 tiles of 64 x 64 pixels reflect, beside one that reflects everywhere.
Status tiles(Session& session, int width, int height) {
  const auto found = world_of(width, height);
  if (!found) return found.status();
  ScreenWorld& world = *found.value();
  Values some = world.normals;
  double part = 0, all_rays = 0;
  // The blocks in a random order: as many as make 30 %.
  std::vector<int> blocks;
  const int across = (width + 63) / 64, down = (height + 63) / 64;
  for (int b = 0; b < across * down; ++b) blocks.push_back(b);
  std::sort(blocks.begin(), blocks.end(), [](int a, int b) {
    return scene::hash(static_cast<std::uint32_t>(a) + 77) < scene::hash(static_cast<std::uint32_t>(b) + 77);
  });
  std::vector<char> reflects(blocks.size(), 0);
  for (std::size_t i = 0; i < blocks.size() * 3 / 10; ++i) reflects[static_cast<std::size_t>(blocks[i])] = 1;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      if (world.normals[4 * i + 3] >= 1) continue;
      ++all_rays;
      if (reflects[static_cast<std::size_t>(y / 64 * across + x / 64)]) ++part;
      else some[4 * i + 3] = 2;
    }
  const auto a = ready(session, world, world.params, world.normals), b = ready(session, world, world.params, some);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), "left out: tiles that do not reflect");
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  const Sample share = summarise(ratios(pair.value().b, pair.value().a));
  session.row("left_out", {{"kernel", "hiz_ssr"},
                           {"scene", fmt::format("atrium {}x{}", width, height)},
                           {"what", fmt::format("tiles that do not reflect; {:.0f} % of the pixels do, and cost {:.0f} % of all", 100 * part / all_rays,
                                                100 * share.median)},
                           {"level", 2},
                           {"saved_ms", saved.median},
                           {"saved_bytes", 0},
                           {"error", 0},
                           {"device", session.device()}});
  if (session.context().info().api != Api::vulkan) return {};
  // The same list walked by as many workgroups as it needs, and by those of the whole frame.
  const auto whole = ready(session, world, world.params, some, true);
  if (!whole) return whole.status();
  const auto launches = session.interleave(timed(whole.value()), timed(b.value()), "left out: workgroups that a list has no tiles for");
  if (!launches) return launches.status();
  const Sample of_launches = summarise(differences(launches.value().a, launches.value().b));
  const Sample of_fixed = summarise(ratios(launches.value().b, launches.value().a));
  session.row("left_out", {{"kernel", "hiz_ssr"},
                           {"scene", fmt::format("atrium {}x{}", width, height)},
                           {"what", fmt::format("workgroups that the list has no tiles for (indirect dispatch); the frame costs {:.1f} % of a fixed launch",
                                                100 * of_fixed.median)},
                           {"level", 2},
                           {"saved_ms", of_launches.median},
                           {"saved_bytes", 0},
                           {"error", 0},
                           {"device", session.device()}});
  return {};
}

Status beside_march(Session& session, int width, int height) {
  const auto found = world_of(width, height);
  if (!found) return found.status();
  ScreenWorld& world = *found.value();
  const auto own = ready(session, world, world.params, world.normals);
  if (!own) return own.status();
  return beside_dependent_reads(session, own.value(),
                                {"hiz_ssr", "hiz", fmt::format("{}x{}", width, height), "the pyramid's", "paths",
                                 static_cast<double>(width) * height, static_cast<int>(hiz_ssr_depth_texels(world.params))});
}

}  // namespace

std::vector<Job> screen_grid(Session& session) {
  const bool quick = session.settings().quick;
  const int width = quick ? 320 : 640, height = quick ? 180 : 360;
  std::vector<Job> jobs;
  const auto add = [&](SsrVariant v, double reach, int steps) {
    jobs.push_back({fmt::format("hiz_ssr {} reach {} steps {}", name(v), reach, steps),
                    [=, &session] { return measure(session, width, height, v, reach, steps); }});
  };
  for (const double reach : quick ? std::vector<double>{2, 32} : std::vector<double>{0.5, 2, 8, 32}) {
    add(SsrVariant::hiz, reach, 64);
    add(SsrVariant::dda, reach, 64);
    for (const int steps : quick ? std::vector<int>{32} : std::vector<int>{16, 64, 256}) add(SsrVariant::linear, reach, steps);
  }
  return jobs;
}

std::vector<Job> screen_left_out(Session& session) {
  return {{"hiz_ssr left out: tiles that do not reflect", [&session] { return session.settings().quick ? tiles(session, 640, 360) : tiles(session, 1280, 720); }}};
}

std::vector<Job> screen_peers(Session& session) {
  return {{"hiz_ssr peer: a march of dependent reads", [&session] { return session.settings().quick ? beside_march(session, 640, 360) : beside_march(session, 1280, 720); }}};
}

std::vector<BenchSetting> hiz_ssr_settings(const Profile& profile) {
  std::vector<BenchSetting> settings;
  const auto found = world_of(640, 360);
  const auto cpu = Context::open("cpu");
  if (!found || !cpu) return settings;
  const ScreenWorld& world = *found.value();
  const auto normals = std::make_shared<const Values>(world.normals);
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda, SsrVariant::linear, SsrVariant::stochastic}) {
    HizSsrParams p = world.params;
    p.variant = v;
    p.max_distance = 32;
    const auto depth = cases::with_pyramid(*cpu.value(), p, world.depth);
    const auto made = plan(p, profile);
    if (depth && made)
      settings.push_back({fmt::format("{} 640x360", name(v)), made.value(), {}, {{"depth", std::make_shared<const Values>(depth.value())}, {"normals", normals}}});
  }
  return settings;
}

}  // namespace luxel::report

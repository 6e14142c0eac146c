// hiz_ssr in whole scenes: reflected radiance against path tracing over all pixels that reflect, split into what the screen
// knows and what it cannot; and thin features that each walk misses as rays grow longer.
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "bench/report/claims.h"
#include "bench/report/screens.h"
#include "bench/report/stage.h"
#include "bench/scene/screen.h"
#include "bench/truth/ssr_radiance.h"
#include "tests/cases/hiz_ssr_support.h"

namespace luxel::report {
namespace {

constexpr const char* radiance_metric = "reflected radiance, all pixels that reflect: mean((x - t1)(x - t2)) / (mean t)^2";

const char* name(SsrVariant v) {
  constexpr const char* names[] = {"hiz", "dda", "linear", "stochastic"};
  return names[static_cast<int>(v)];
}

Result<std::shared_ptr<const truth::ScreenTruth>> truth_of(const Place& place, bool mirror, bool quick) {
  static std::map<std::pair<std::string, bool>, std::shared_ptr<const truth::ScreenTruth>> kept;
  auto& found = kept[{place.name, mirror}];
  if (found) return found;
  auto read = scene::scene_from(place.scene);
  if (!read) return read.status();
  if (place.camera.fov > 0) read.value().camera = place.camera;
  const auto rays = scene::Rays::make(read.value());
  if (!rays) return rays.status();
  const int width = quick ? 96 : 320, height = quick ? 54 : 180;
  auto made = truth::screen_truth(read.value(), rays.value(), width, height, mirror, quick ? 16 : 64);
  if (!made) return made.status();
  found = std::make_shared<const truth::ScreenTruth>(std::move(made).value());
  return found;
}

Status measure(Session& session, const Place& place, SsrVariant variant, bool sky, int rays_per_pixel) {
  const bool mirror = variant != SsrVariant::stochastic;
  const auto found = truth_of(place, mirror, session.settings().quick);
  if (!found) return found.status();
  const truth::ScreenTruth& t = *found.value();
  HizSsrParams p = t.params;
  p.variant = variant;
  p.rays_per_pixel = rays_per_pixel;
  p.max_distance = variant == SsrVariant::linear ? 64 * p.thickness : 0;
  if (!sky) p.environment = {0, 0, 0};
  std::vector<double> build, shade;
  truth::ScreenErrors e;
  for (int run = 0; run < (session.is_cpu() ? 1 : 3); ++run) {
    const auto r = scene::reflect(session.context(), p, {t.g.depth, t.normals, {}, t.colour, {}, {}});
    if (!r) return r.status();
    double before = 0, after = 0;
    for (const scene::ScreenStep& s : r.value().steps) (&s == &r.value().steps.back() ? after : before) += s.ms;
    build.push_back(before);
    shade.push_back(after);
    e = truth::screen_errors(t, r.value().radiance);
  }
  double reflecting = 0;
  for (std::size_t c = 1; c < truth::seen_classes; ++c) reflecting += t.pixels[c];
  FrontierRow row{"hiz_ssr", name(variant), place.name, fmt::format("{}x{}", p.width, p.height),
                  {{"surfaces", mirror ? "mirrors" : "their own roughness"}, {"misses", sky ? "the sky" : "0"}},
                  {{"rays", mirror ? 1 : rays_per_pixel},
                   {"share_on_screen", t.pixels[1] / reflecting},
                   {"share_off_screen", t.pixels[2] / reflecting},
                   {"share_hidden", t.pixels[3] / reflecting},
                   {"on_screen", e.of[1]},
                   {"off_screen", e.of[2]},
                   {"hidden", e.of[3]},
                   {"sky", e.of[4]}},
                  mirror ? "mirrors" : "glossy", {radiance_metric}};
  row.error.method = e.all;
  row.error.discretization = e.part[1];          // what the screen knows
  row.error.model = e.all - e.part[1];           // what it cannot know
  row.error.standard_error = e.standard_error;
  row.build = cell_of(summarise(build));
  row.shade = cell_of(summarise(shade));
  session.frontier(row);
  return {};
}

// Poles one pixel wide, 37 pixels apart; rays along rows begin at every distance from them.
Status thin(Session& session, double reach) {
  constexpr int width = 640, height = 64, rays = 2048, between = 37;
  HizSsrParams p = cases::ssr_params(width, height);
  p.thickness = 0.2;
  p.rays = rays;
  p.max_distance = reach;
  cases::Values stored, starts;
  for (int i = 0; i < width * height; ++i) stored.push_back(i % width % between == 20 ? 3 : HUGE_VAL);
  const double pixel = 3.1 / p.focal_x, left = -p.centre_x * pixel;
  for (int i = 0; i < rays; ++i) {
    const double first = left + 0.01 + between * pixel * std::fmod(i * 0.6180339887498949, 1.0);
    cases::add_ray(starts, {first, -0.2 + 0.4 * i / rays, -3.01 - 0.15 * i / rays}, {1, 0, 0.02 * (i % 7) / 7});
  }
  std::map<SsrVariant, cases::Values> hits;
  for (const SsrVariant v : {SsrVariant::dda, SsrVariant::hiz, SsrVariant::linear}) {
    p.variant = v;
    p.steps = 32;
    const auto r = cases::follow(session.context(), p, stored, starts);
    if (!r) return r.status();
    hits[v] = r.value().hits;
    double met = 0, missed = 0;
    const auto& truth = hits[SsrVariant::dda];
    for (std::size_t i = 0; i < truth.size(); i += 4) {
      if (truth[i] == 0) continue;
      ++met;
      missed += std::floor(hits[v][i] * width) != std::floor(truth[i] * width);
    }
    const bool uniform = v == SsrVariant::linear;
    add(session, {fmt::format("hiz_ssr {}: share of rays of length {} that miss the pole, a pixel wide, that dda hits ({:.0f} rays hit one)",
                              name(v), reach, met),
                  uniform ? "McGuire and Mara 2014: uniform steps step over features (no number is printed)"
                          : "Uludag 2014; McGuire and Mara 2014: no feature is stepped over",
                  uniform ? Cell() : Cell(0.0), once(met > 0 ? missed / met : std::numeric_limits<double>::quiet_NaN()),
                  {uniform ? "above 0" : "0", met > 0 && (missed > 0) == uniform},
                  uniform ? "32 uniform steps: what is thinner than a step is met by chance" : "every pixel on the way is bounded or looked at"});
  }
  return {};
}

}  // namespace

std::vector<Job> screen_truth_grid(Session& session, std::vector<std::string>& missing) {
  const bool quick = session.settings().quick;
  std::vector<Job> jobs;
  for (const Place& place : places(missing)) {
    if (place.scene == "cornell" || (quick && place.name != "atrium (generated)")) continue;
    const auto add = [&](SsrVariant v, bool sky, int rays) {
      jobs.push_back({fmt::format("hiz_ssr {} {} rays, misses {} in {}", name(v), rays, sky ? "sky" : "0", place.name),
                      [=, &session] { return measure(session, place, v, sky, rays); }});
    };
    add(SsrVariant::hiz, false, 1);
    add(SsrVariant::stochastic, false, quick ? 1 : 4);
    if (quick) continue;
    add(SsrVariant::hiz, true, 1);
    add(SsrVariant::dda, false, 1);
    add(SsrVariant::linear, false, 1);
    add(SsrVariant::stochastic, false, 1);
  }
  for (const double reach : quick ? std::vector<double>{4} : std::vector<double>{2, 4, 8})  // below 2 steps are shorter than a pixel
    jobs.push_back({fmt::format("hiz_ssr thin features, reach {}", reach), [=, &session] { return thin(session, reach); }});
  return jobs;
}

}  // namespace luxel::report

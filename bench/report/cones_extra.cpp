// What cone_trace leaves out where it is not needed, a claim measured again, and the driver's rate of sampling.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/cones.h"
#include "bench/report/limits.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using cases::ConeScene;
using cases::Values;

// `fewer` leaves out what `more` does. The error is the largest difference of what both make.
Status compare(Session& session, const ConeSetting& more, const ConeSetting& fewer, const std::string& what, int level,
               int channels) {
  ConeScenes first, second;  // a scene keeps what it traced last
  const auto a = first.on(session.context(), more), b = second.on(session.context(), fewer);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair =
      session.interleave(timed(a.value(), more.params), timed(b.value(), fewer.params), "left out: " + what);
  if (!pair) return pair.status();
  std::vector<double> saved;
  for (std::size_t i = 0; i < pair.value().a.size(); ++i) saved.push_back(pair.value().a[i] - pair.value().b[i]);
  const Result<Values> x = a.value()->read("irradiance"), y = b.value()->read("irradiance");
  if (!x) return x.status();
  if (!y) return y.status();
  double most = 0;
  for (std::size_t i = 0; i < x.value().size(); ++i)
    if (static_cast<int>(i % 4) < channels) most = std::max(most, std::fabs(x.value()[i] - y.value()[i]));
  const auto bytes = [&](const ConeSetting& s, const ConeScene& scene) {
    return static_cast<double>(scene.volume_bytes()) + (s.params.count ? 4 * cone_outcomes : 0);
  };
  session.row("left_out", {{"kernel", "cone_trace"},
                           {"scene", fmt::format("{} {}", fewer.world->name, fewer.world->side)},
                           {"what", what},
                           {"level", level},
                           {"saved_ms", summarise(saved).median},
                           {"saved_bytes", bytes(more, *a.value()) - bytes(fewer, *b.value())},
                           {"error", most},
                           {"device", session.device()}});
  return {};
}

// The kernel's look-ups a second beside those of a loop whose addresses no value decides.
Status beside_sampling(Session& session, const ConeSetting& s) {
  ConeScenes scenes;
  const auto scene = scenes.on(session.context(), s);
  if (!scene) return scene.status();
  ConeTraceParams counted = s.params;
  counted.count = true;
  if (Status status = scene.value()->trace(counted); !status) return status;
  const Result<Values> counters = scene.value()->read("counters");
  if (!counters) return counters.status();
  const double looks = counters.value()[static_cast<std::size_t>(ConeOutcome::look_ups)];

  const Profile& profile = session.context().profile();
  constexpr int width = 256, height = 64, each = 64;
  const bool image = s.params.input == Input::image;
  Result<cases::Run> loop = cases::Run::make(
      session.context(), sample_plan(width, height, s.world->side, each, {0.37, 0.53, 0.76},
                                     {s.params.format, image, !image && profile.texels}, profile));
  if (!loop) return loop.status();
  const auto run = std::make_shared<cases::Run>(std::move(loop).value());
  if (Status status = run->write("volume", cases::quantise(s.world->voxels, s.params.format)); !status) return status;
  const auto pair = session.interleave(
      timed(scene.value(), s.params),
      [run]() -> Result<double> {
        Times times;
        if (Status status = run->go(1, &times); !status) return status;
        return times.total;
      },
      "peer: sampling in a loop");
  if (!pair) return pair.status();
  std::vector<double> r = ratios(pair.value().b, pair.value().a);
  for (double& v : r) v *= looks / (static_cast<double>(width) * height * each);
  const Sample ratio = summarise(r);
  session.row("peers",
              {{"peer", fmt::format("trilinear look-ups in a loop ({}); ours {:.0f} a receiver of the {}",
                                    image ? "linear sampler" : profile.texels ? "texel buffer, by code" : "buffer, by code",
                                    looks / (s.params.width * s.params.height), s.world->name)},
               {"version", "-"},
               {"kernel", "cone_trace"},
               {"size", fmt::format("{0}x{0}x{0}", s.world->side)},
               {"time_ms", to_json(summarise(pair.value().b))},
               {"error", nullptr},
               {"ratio", ratio.median},
               {"q1", ratio.q1},
               {"q3", ratio.q3},
               {"device", session.device()},
               {"options",
                {{"format", name(s.params.format)},
                 {"variant", s.params.variant == ConeVariant::isotropic ? "isotropic" : "anisotropic"}}},
               {"own_ms", to_json(summarise(pair.value().a))},
               {"own_error", nullptr},
               {"goal", 0.7}});
  return {};
}

// 25 cones a pixel against a 5 x 5 pattern of one, without the blur that both need.
Status interleaved(Session& session, const std::shared_ptr<const ConeWorld>& box) {
  ConeSetting all = setting_for(box, ConeVariant::isotropic, Format::f32x4, "25"), one = all;
  one.params.pattern_x = one.params.pattern_y = 5;
  ConeScenes first, second;
  const auto a = first.on(session.context(), all), b = second.on(session.context(), one);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value(), all.params), timed(b.value(), one.params), "25 cones, 5 x 5");
  if (!pair) return pair.status();
  const Sample r = summarise(ratios(pair.value().a, pair.value().b));
  session.row("reproduction",
              {{"claim", "one of 25 cones a pixel in a 5 x 5 pattern is faster than 25 cones a pixel (time ratio)"},
               {"source", "seed 004, 4.4 (figure 70; no number is printed)"},
               {"source_value", nullptr},
               {"measured", r.median},
               {"q1", r.q1},
               {"q3", r.q3},
               {"verdict", r.q1 > 1 ? "confirmed" : "not confirmed"},
               {"reason", "a twenty-fifth of the look-ups; neighbours look in different directions, which costs caches "
                          "and lanes some of it"},
               {"device", session.device()}});
  return {};
}

}  // namespace

std::vector<Job> cone_left_out(Session& session) {
  const bool quick = session.settings().quick;
  const auto box = cone_box(64, quick ? 32 : 64, quick ? 16 : 32);
  std::vector<Job> jobs;
  const auto pair = [&](const std::string& what, int level, const ConeSetting& more, const ConeSetting& fewer,
                        int channels) {
    jobs.push_back({"cone_trace left out: " + what,
                    [=, &session] { return compare(session, more, fewer, what, level, channels); }});
  };
  for (const Format f : {Format::f32x4, Format::unorm8x4}) {
    ConeSetting more = setting_for(box, ConeVariant::isotropic, f), fewer = more;
    more.params.skip_empty = false;
    pair(fmt::format("the finer of two levels where the coarser is empty, {}", name(f)), 2, more, fewer, 4);
  }
  const ConeSetting all = setting_for(box, ConeVariant::isotropic, Format::f32x4);
  ConeSetting other = all;
  other.params.error = 0.01;
  other.params.radiance_max = 3;
  pair("cones that cannot add more than 0.01 to the radiance", 2, all, other, 4);
  other = all;
  other.params.occlusion = false;
  pair("occlusion", 1, all, other, 3);
  ConeSetting counted = all;
  counted.params.count = true;
  pair("counters", 1, counted, all, 4);
  return jobs;
}

std::vector<Job> cone_reproduction(Session& session) {
  const auto box = cone_box(64, session.settings().quick ? 40 : 160, session.settings().quick ? 20 : 80);
  return {{"cone_trace reproduction: 25 cones against a pattern", [&session, box] { return interleaved(session, box); }}};
}

std::vector<Job> cone_peers(Session& session) {
  if (session.is_cpu()) return {};
  std::vector<Job> jobs;
  const bool quick = session.settings().quick;
  const int width = quick ? 64 : 256, height = quick ? 32 : 128;
  for (const auto& world : {cone_box(64, width, height), cone_fog(64, width, height)})
    for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic})
      for (const Input input : {Input::buffer, Input::image}) {
        ConeSetting s = setting_for(world, v, Format::f32x4);
        s.params.input = input;
        s.params.skip_empty = false;  // a driver that runs neighbours in step reads what one of them needs
        jobs.push_back({fmt::format("cone_trace peer: sampling, {}{}, {}",
                                    v == ConeVariant::isotropic ? "isotropic" : "anisotropic",
                                    input == Input::image ? ", image" : "", world->name),
                        [&session, s] { return beside_sampling(session, s); }});
      }
  return jobs;
}

}  // namespace luxel::report

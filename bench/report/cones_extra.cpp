// What cone_trace leaves out where it is not needed, a claim measured again, and the driver's rate of sampling.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/claims.h"
#include "bench/report/cones.h"
#include "bench/report/limits.h"
#include "bench/scene/interleaved.h"
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
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
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
                           {"saved_ms", saved.median},
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
      timed(scene.value(), s.params), timed(run), "peer: sampling in a loop");
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
               {"time_ms", cell_of(summarise(pair.value().b))},
               {"error", nullptr},
               {"ratio", ratio.median},
               {"q1", ratio.q1},
               {"q3", ratio.q3},
               {"device", session.device()},
               {"options",
                {{"format", name(s.params.format)},
                 {"variant", s.params.variant == ConeVariant::isotropic ? "isotropic" : "anisotropic"}}},
               {"own_ms", cell_of(summarise(pair.value().a))},
               {"own_error", nullptr},
               {"goal", 0.7}});
  return {};
}

// Milliseconds of the device, of one trace.
Session::Timed traced(scene::VoxelScene& voxels, const ConeTraceParams& p, const std::vector<float>& receivers) {
  return [&]() -> Result<double> {
    const auto light = voxels.trace(p, receivers, {});
    if (!light) return light.status();
    double ms = 0;
    for (const scene::VoxelStep& s : voxels.shade_steps()) ms += s.ms;
    return ms;
  };
}

// What the picture of a generated scene loses by a pattern, after the blur that both need.
Status interleaved_picture(Session& session, int width, int height) {
  auto read = scene::built_in("cornell");
  if (!read) return read.status();
  const scene::Scene& cornell = read.value();
  const auto rays = scene::Rays::make(cornell);
  if (!rays) return rays.status();
  const scene::GBuffer seen = scene::gbuffer(rays.value(), cornell.camera, width, height);
  scene::VoxelSceneSettings settings;
  settings.resolution = 64;
  const std::shared_ptr<Context> context(std::shared_ptr<Context>(), &session.context());  // the session's
  auto built = scene::VoxelScene::build(context, cornell, settings);
  if (!built) return built.status();
  scene::VoxelScene& voxels = built.value();
  if (Status s = voxels.light(); !s) return s;
  const std::vector<float> receivers = receivers_of(seen, voxels.grid());
  ConeTraceParams all;
  all.width = width;
  all.height = height;
  all.cones = cone_set(25).value();
  all.occlusion = false;
  ConeTraceParams one = all;
  one.pattern_x = one.pattern_y = 5;
  const auto pair =
      session.interleave(traced(voxels, all, receivers), traced(voxels, one, receivers), "cornell, 25 cones, 5 x 5");
  if (!pair) return pair.status();
  const Sample faster = summarise(ratios(pair.value().a, pair.value().b));
  const auto reference = voxels.trace(all, receivers, {});
  if (!reference) return reference.status();
  for (const bool turned : {false, true}) {
    one.rotate = turned;
    const auto light = voxels.trace(one, receivers, {});
    if (!light) return light.status();
    constexpr double sigma = 2.5;  // pixels: half of the pattern's 5
    const auto d = picture_difference(session.context(), seen, reference.value().indirect, light.value().indirect, sigma);
    if (!d) return d.status();
    add(session, {fmt::format("a 5 x 5 pattern of 25 cones{}, blurred, is within 0.1 of all 25 at every pixel, blurred alike (share of "
                              "pixels; sum over channels)",
                              turned ? ", turned at random for each tile" : ""),
                  "Hong 2015, 4.4 (figures 70 to 72)", nullptr, once(d.value().within), {"0.95 or more", d.value().within >= 0.95},
                  fmt::format("cornell 64^3, {}x{}, sigma {} px, {:+.2f} stops (1 % of the pixels above 1): mean {:.4f}, p95 {:.4f}, "
                              "max {:.3f}; {:.1f} times as fast",
                              width, height, sigma, d.value().exposure, d.value().mean, d.value().p95, d.value().max, faster.median)});
  }
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
  add(session, {"one of 25 cones a pixel in a 5 x 5 pattern is faster than 25 cones a pixel (time ratio)",
                "Hong 2015, 4.4 (figure 70; no number is printed)", nullptr, r, above_one(r),
                "a twenty-fifth of the look-ups; neighbours look in different directions, which costs caches and lanes some of it"});
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
  std::vector<Job> jobs{
      {"cone_trace reproduction: 25 cones against a pattern", [&session, box] { return interleaved(session, box); }}};
  if (!session.is_cpu())
    jobs.push_back({"cone_trace reproduction: a picture of 25 cones against a pattern", [&session] {
                      return session.settings().quick ? interleaved_picture(session, 160, 90)
                                                      : interleaved_picture(session, 640, 360);
                    }});
  return jobs;
}

std::vector<Job> cone_peers(Session& session) {
  if (session.is_cpu()) return {};
  std::vector<Job> jobs;
  const bool quick = session.settings().quick;
  const int width = quick ? 64 : 256, height = quick ? 32 : 128;
  const auto fog = cone_fog(64, width, height);  // where no cone ends early
  for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic})
    for (const Input input : {Input::buffer, Input::image}) {
      ConeSetting s = setting_for(fog, v, Format::f32x4);
      s.params.input = input;
      s.params.skip_empty = false;  // a driver that runs neighbours in step reads what one of them needs
      jobs.push_back({fmt::format("cone_trace peer: sampling, {}{}, {}", v == ConeVariant::isotropic ? "isotropic" : "anisotropic",
                                  input == Input::image ? ", image" : "", fog->name),
                      [&session, s] { return beside_sampling(session, s); }});
    }
  return jobs;
}

}  // namespace luxel::report

// What gaussian_blur leaves out where it is not needed, and claims about it that are measured again.
#include <cmath>

#include <fmt/format.h>

#include "bench/report/claims.h"
#include "bench/report/gaussian.h"
#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/gaussian_blur_support.h"

namespace luxel::report {
namespace {

using Shared = std::shared_ptr<const Scene>;

Result<std::vector<double>> result_of(Session& session, const BlurSetting& s) {
  return cases::blur(session.context(), s.params, in_format(*s.scene, s.params.format));
}

void left_out(Session& session, const BlurSetting& s, const std::string& what, int level, double saved_ms,
              double saved_bytes, double error) {
  session.row("left_out", {{"kernel", "gaussian_blur"},
                           {"scene", fmt::format("{} {}", s.scene->name, size_text(s.params.width, s.params.height))},
                           {"what", what},
                           {"level", level},
                           {"saved_ms", saved_ms},
                           {"saved_bytes", saved_bytes},
                           {"error", error},
                           {"device", session.device()}});
}

// `more` computes what `fewer` leaves out: time saved, traffic saved, and how far the results are apart over full
// scale.
Status compare(Session& session, const BlurSetting& more, const BlurSetting& fewer, const std::string& what,
               int level) {
  const auto a = timed_blur(session, more);
  if (!a) return a.status();
  const auto b = timed_blur(session, fewer);
  if (!b) return b.status();
  const auto pair = session.interleave(a.value(), b.value(), what);
  if (!pair) return pair.status();
  const auto first = result_of(session, more);
  if (!first) return first.status();
  const auto second = result_of(session, fewer);
  if (!second) return second.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  const Profile& profile = session.context().profile();
  const Result<Plan> plan_more = plan(more.params, profile), plan_fewer = plan(fewer.params, profile);
  // With fewer channels there is nothing to compare: what is left is filtered as before.
  double error = 0;
  if (first.value().size() == second.value().size()) error = cases::max_difference(first.value(), second.value());
  double full_scale = 0;
  for (const double v : in_format(*more.scene, more.params.format)) full_scale = std::fmax(full_scale, std::fabs(v));
  error /= full_scale;
  left_out(session, fewer, what, level, saved.median, plan_more.value().bytes - plan_fewer.value().bytes,
           error);
  return {};
}

// What pairs are timed on: where the C++ execution takes part in a quick report, a sixteenth will do.
Shared pairs_scene(const Session& session) {
  const int part = session.is_cpu() && session.settings().quick ? 4 : 1;
  return std::make_shared<Scene>(landscape(960 / part, 540 / part));
}

Status skipped_pass(Session& session) {
  // sigma 0 is one pass that copies. Not skipping would be the same pass twice, through scratch: as long again.
  const Shared scene = pairs_scene(session);
  const BlurSetting once{scene, params_for(*scene, 0, 3), 3};
  const auto one = timed_blur(session, once), other = timed_blur(session, once);
  if (!one) return one.status();
  if (!other) return other.status();
  const Session::Timed twice = [&]() -> Result<double> {
    const Result<double> a = one.value()(), b = other.value()();
    if (!a) return a;
    if (!b) return b;
    return a.value() + b.value();
  };
  const auto pair = session.interleave(twice, one.value(), "left out: a pass of radius 0");
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  left_out(session, once, "a pass of radius 0 is skipped", 3, saved.median, 2.0 * 16 * 960 * 540, 0);
  return {};
}

Job job(std::string what, std::function<Status()> run) { return {"gaussian_blur " + std::move(what), std::move(run)}; }

// The ratio of times of `slow` over `fast` beside a claimed value; `close`: the factor within which it counts as kept.
Status reproduce(Session& session, const BlurSetting& slow, const BlurSetting& fast, const std::string& claim,
                 const std::string& source, double value, double close, const std::string& reason) {
  const auto a = timed_blur(session, slow);
  if (!a) return a.status();
  const auto b = timed_blur(session, fast);
  if (!b) return b.status();
  const auto pair = session.interleave(a.value(), b.value(), claim);
  if (!pair) return pair.status();
  const Sample r = summarise(ratios(pair.value().a, pair.value().b));
  add(session, {claim, source, value, r, within(r.median, value, close), reason});
  return {};
}

// What truncation at k sigma costs along one axis: half the L1 norm, on an image of one row.
Status reproduce_truncation(Session& session, double k, double claimed) {
  const double sigma = 12;
  const int reach = static_cast<int>(std::ceil(8.3 * sigma)) + 1, side = 2 * reach + 1;
  const Shared row =
      std::make_shared<Scene>(Scene{"impulse (generated)", side, 1, 1, scene::impulse(side, 1, 1, reach, 0)});
  BlurSetting s{row, params_for(*row, sigma, k, Format::f32x1), k, BlurMetric::half_l1};
  const auto out = result_of(session, s);
  if (!out) return out.status();
  const double error = blur_error(s, row->values, out.value());
  add(session, {fmt::format("truncation at k = {} sigma costs this much per axis (half L1, sigma 12)", k),
                k == 3 ? "Real-Time Rendering 4e, 12.1 (3 sigma rule); erfc(3/sqrt 2) = 2.7e-3" : "erfc(4/sqrt 2) = 6.3e-5",
                claimed, once(error), within(error, claimed, 1.25),
                "the weight that is cut off: a little less than the integral beyond k sigma, since the last tap stands "
                "for half a pixel more"});
  return {};
}

}  // namespace

std::vector<Job> gaussian_left_out(Session& session) {
  const Shared hd = pairs_scene(session);
  std::vector<Job> jobs;
  jobs.push_back(job("left out: a pass of radius 0", [&session] { return skipped_pass(session); }));
  const auto pair = [&](const char* what, int level, GaussianBlurParams more, GaussianBlurParams fewer, double k) {
    jobs.push_back(
        job(fmt::format("left out: {}", what), [&session, hd, what = std::string(what), level, more, fewer, k] {
          return compare(session, {hd, more, k}, {hd, fewer, k}, what, level);
        }));
  };
  GaussianBlurParams all = params_for(*hd, 4, 3), less = all;
  less.keep_alpha = true;
  pair("a constant alpha is copied, not filtered (keep_alpha)", 1, all, less, 3);
  less = params_for(*hd, 4, 3, Format::f32x1);
  pair("three channels that are not there are not moved (f32x1 for f32x4)", 1, all, less, 3);
  for (const Format format : {Format::unorm8x4, Format::f16x4}) {
    if (session.settings().quick && format == Format::f16x4) continue;
    all = less = params_for(*hd, 4, 6, format);
    less.drop_taps = true;
    pair(format == Format::unorm8x4 ? "taps below half a step of unorm8 (drop_taps, k = 6)"
                                    : "taps below half a step of f16 (drop_taps, k = 6)",
         1, all, less, 6);
  }
  return jobs;
}

std::vector<Job> gaussian_reproduction(Session& session) {
  const Shared scene = std::make_shared<Scene>(landscape(512, 288));
  const char* rtr = "Real-Time Rendering 4e, 12.1";
  std::vector<Job> jobs;
  const bool quick = session.settings().quick;
  std::vector<int> radii = quick ? std::vector<int>{4} : std::vector<int>{2, 4};
  if (!session.is_cpu() && !quick) radii.insert(radii.end(), {8, 12});
  for (const int radius : radii)
    jobs.push_back(job(fmt::format("reproduction: d^2 against 2d, R {}", radius), [=, &session] {
      GaussianBlurParams direct = params_for(*scene, radius / 3.0, 3, Format::f32x4, GaussianVariant::direct),
                         separable = direct;
      separable.variant = GaussianVariant::separable;
      const double d = 2 * radius + 1;
      return reproduce(
          session, {scene, direct, 3}, {scene, separable, 3},
          fmt::format("a filter of {0}x{0} costs d^2 taps in one pass and 2d in two: time ratio d/2", d), rtr, d / 2,
          1.5, "less: the separable form writes and reads an image between its passes; more: it loads a tap once for all results of "
               "a block, the direct form for each result anew; the count of taps leaves out both");
    }));
  for (const int radius : quick ? std::vector<int>{12} : std::vector<int>{4, 12})
    jobs.push_back(job(fmt::format("reproduction: two texels a tap, R {}", radius), [=, &session] {
      GaussianBlurParams image = params_for(*scene, radius / 3.0, 3), sampler = image;
      image.input = Input::image;
      sampler.input = Input::image;
      sampler.variant = GaussianVariant::sampler;
      const double taps = 2 * radius + 1, fetches = 2 * ((radius + 1) / 2) + 1;
      return reproduce(
          session, {scene, image, 3}, {scene, sampler, 3},
          fmt::format("bilinear taps read two texels at once: {} fetches for {} taps, time ratio of both forms",
                      fetches, taps),
          "Real-Time Rendering 4e, 12.1 (Rideout)", taps / fetches, 1.25,
          "holds where the sampler is hardware; a software driver filters with instructions");
    }));
  jobs.push_back(
      job("reproduction: truncation at 3 sigma", [&session] { return reproduce_truncation(session, 3, 2.3e-3); }));
  if (!quick)
    jobs.push_back(
      job("reproduction: truncation at 4 sigma", [&session] { return reproduce_truncation(session, 4, 5e-5); }));
  return jobs;
}

}  // namespace luxel::report

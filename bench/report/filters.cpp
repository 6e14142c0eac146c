// Approximations of bilateral beside the filter, and what its terms cost.
#include "bench/report/filters.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/claims.h"
#include "bench/report/filter_rows.h"
#include "bench/report/scenes.h"
#include "bench/truth/bilateral_truth.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;

const std::vector<std::string> filter_metrics{"max |x - direct| / max |input|", "1 / PSNR, as rms / max |input|"};

BilateralParams plain(BilateralVariant variant, int radius) {
  BilateralParams p;
  p.width = p.height = 192;
  p.variant = variant;
  p.radius = radius;
  p.sigma_space = radius / 2.0;
  p.sigma_range = 0.1;
  return p;
}

Status measure_filter(Session& session, const BilateralParams& p, int radius, const std::string& label) {
  // A landscape shown as on a display: between 0 and 1.
  const Scene scene = landscape(p.width, p.height);
  cases::BilateralImages images;
  images.src = in_format(scene, p.format);
  for (double& v : images.src) v = static_cast<float>(v / (1 + v));
  BilateralParams truth = p;
  truth.variant = BilateralVariant::direct;
  truth.radius = radius;
  truth.step = 1;
  truth.sigma_space = radius / 2.0;
  truth.adaptive = false;
  double most = 0;
  for (const double v : images.src) most = std::max(most, std::fabs(v));
  const auto apart = [&](const Values& a, const Values& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
    return std::vector{cases::max_difference(a, b) / most, std::sqrt(squares / static_cast<double>(a.size())) / most};
  };
  Result<Run> made = Run::make(session.context(), plan(p, session.context().profile()));
  if (!made) return made.status();
  if (Status s = made.value().write("src", images.src); !s) return s;
  const Result<Sample> ms = session.time(made.value(), label);
  if (!ms) return ms.status();
  const auto out = made.value().read("dst");
  if (!out) return out.status();
  const auto errors = session.errors(
      label, filter_metrics, hash_values(out.value()), true,
      [&]() -> Result<std::vector<Oracle>> {
        const auto single = cases::filter(session.cpu_float(), p, images),
                   exact = cases::filter(session.cpu_double(), p, images);
        if (!single) return single.status();
        if (!exact) return exact.status();
        const std::vector<double> rounding = apart(single.value().dst, exact.value().dst);
        const std::vector<double> method = apart(exact.value().dst, truth::bilateral(truth, images).src);
        const std::uint64_t bits = hash_values(single.value().dst);
        return std::vector<Oracle>{{bits, rounding[0], 0, method[0]}, {bits, rounding[1], 0, method[1]}};
      },
      [&]() -> Result<std::vector<double>> {
        const auto single = cases::filter(session.cpu_float(), p, images);
        if (!single) return single.status();
        return apart(out.value(), single.value().dst);
      });
  if (!errors) return errors.status();
  for (const ErrorSplit& error : errors.value()) {
    FrontierRow row;
    row.kernel = "bilateral";
    row.variant = variant_text(p);
    row.scene = scene.name;
    row.size = size_text(p.width, p.height);
    row.options = options_of(p);
    row.knobs = knobs_of(p);
    row.group = fmt::format("direct of radius {}", radius);
    row.error = error;
    row.shade = cell_of(ms.value());
    row.costs_of(made.value());
    session.frontier(row);
  }
  return {};
}

}  // namespace

std::vector<Job> filter_grid(Session& session) {
  std::vector<Job> jobs;
  const auto add = [&](const BilateralParams& p, int radius, const std::string& text) {
    const std::string label = fmt::format("bilateral beside direct R {}: {}", radius, text);
    jobs.push_back({label, [&session, p, radius, label] { return measure_filter(session, p, radius, label); }});
  };
  const Settings& wanted = session.settings();
  const auto plain_of = [&](BilateralVariant variant, int radius) {
    BilateralParams p = plain(variant, radius);
    if (wanted.width > 0) p.width = wanted.width, p.height = wanted.height;
    return p;
  };
  for (const int radius : wanted.radius > 0 ? std::vector{wanted.radius} : wanted.quick ? std::vector{4} : std::vector{4, 12}) {
    add(plain_of(BilateralVariant::direct, radius), radius, "direct");
    BilateralParams p = plain_of(BilateralVariant::direct, radius);
    p.step = 2;
    add(p, radius, "step 2");
    p = plain_of(BilateralVariant::separable, radius);
    add(p, radius, "separable");
    p.adaptive = true;
    add(p, radius, "adaptive");
    p = plain_of(BilateralVariant::atrous, radius);
    p.levels = radius <= 4 ? 2 : 3;
    add(p, radius, fmt::format("atrous {} levels", p.levels));
    p = plain_of(BilateralVariant::grid, radius);
    add(p, radius, "grid");
  }
  return jobs;
}

namespace {

// Two settings of direct beside each other on the built-in picture, the second of which leaves something out.
struct Setting {
  BilateralParams params;
  cases::BilateralImages images;
};

struct Pair {
  std::vector<double> first, second;  // dst
  double saved_ms, saved_bytes;
};

Setting setting(const std::string& terms, int side = 512) {
  const BilateralParams p = cases::bilateral_params(side, side, terms);
  return {p, cases::bilateral_images(p, 1)};
}

struct TimedPair {
  std::array<std::shared_ptr<Run>, 2> runs;
  Session::Pair times;
};

Result<TimedPair> timed_pair(Session& session, const Setting& first, const Setting& second, const std::string& what) {
  TimedPair pair;
  for (const std::size_t k : {0, 1}) {
    const Setting& s = k == 0 ? first : second;
    Result<Run> made = Run::make(session.context(), plan(s.params, session.context().profile()));
    if (!made) return made.status();
    if (Status status = write_inputs(made.value(), {{"src", &s.images.src},
                                                    {"guide", &s.images.guide},
                                                    {"depth", &s.images.depth},
                                                    {"normals", &s.images.normals}});
        !status)
      return status;
    pair.runs[k] = std::make_shared<Run>(std::move(made).value());
  }
  auto times = session.interleave(timed(pair.runs[0]), timed(pair.runs[1]), what);
  if (!times) return times.status();
  pair.times = std::move(times).value();
  return pair;
}

Result<Pair> compared(Session& session, const Setting& first, const Setting& second, const std::string& what) {
  const auto pair = timed_pair(session, first, second, "left out: " + what);
  if (!pair) return pair.status();
  const auto& [runs, times] = pair.value();
  const Sample saved = summarise(differences(times.a, times.b));
  auto a = runs[0]->read("dst"), b = runs[1]->read("dst");
  if (!a) return a.status();
  if (!b) return b.status();
  return Pair{std::move(a).value(), std::move(b).value(), saved.median, runs[0]->plan().bytes - runs[1]->plan().bytes};
}

void add_left_out(Session& session, const std::string& scene, const std::string& what, int level, double ms, double bytes,
                  double error) {
  session.row("left_out", {{"kernel", "bilateral"},
                           {"scene", scene},
                           {"what", what},
                           {"level", level},
                           {"saved_ms", ms},
                           {"saved_bytes", bytes},
                           {"error", error},
                           {"device", session.device()}});
}

}  // namespace

// What a term costs that is left out where it is not asked for.
std::vector<Job> filter_left_out(Session& session) {
  std::vector<Job> jobs;
  const std::string room = "a floor, a wall and a box 512x512";
  for (const auto& [term, what] :
       {std::pair{'d', "the depth term"}, {'n', "the normal term"}, {'g', "the colour term"}}) {
    if (session.settings().quick && term != 'd') continue;  // each compiles a window of its own
    jobs.push_back({fmt::format("bilateral left out {}", what), [=, &session, term = term, what = what]() -> Status {
                      std::string fewer = "gdn";
                      std::erase(fewer, term);
                      const auto pair = compared(session, setting("gdn"), setting(fewer), what);
                      if (!pair) return pair.status();
                      add_left_out(session, room, fmt::format("{} is not asked for: neither compiled nor bound", what), 1,
                                   pair.value().saved_ms, pair.value().saved_bytes, 0);
                      return {};
                    }});
  }
  // Sky is not filtered; the same picture with a surface there is.
  jobs.push_back({"bilateral left out sky", [&session]() -> Status {
                    const Setting surface = setting("dn");
                    Setting sky = surface;
                    const std::size_t half = sky.images.depth.size() / 2;
                    for (std::size_t i = 0; i < half; ++i) sky.images.depth[i] = HUGE_VAL;
                    const auto pair = compared(session, surface, sky, "sky");
                    if (!pair) return pair.status();
                    // What was not filtered is the input to the bit.
                    const double changed = cases::max_difference(std::span(pair.value().second).first(4 * half),
                                                                 std::span(sky.images.src).first(4 * half));
                    add_left_out(session, "sky above a wall and a box 512x512",
                                 "the half of the picture that is sky is not filtered", 2, pair.value().saved_ms, 0, changed);
                    return {};
                  }});
  // Tiles without edges are blurred by rows and columns.
  jobs.push_back({"bilateral left out flat tiles", [=, &session]() -> Status {
                    const Setting all = setting("dn");
                    Setting some = all;
                    some.params.flat = 0.05;
                    const auto pair = compared(session, all, some, "flat tiles");
                    if (!pair) return pair.status();
                    add_left_out(session, room,
                                 "tiles without edges in depth and normals (flat 0.05) are blurred by space alone", 3,
                                 pair.value().saved_ms, 0, cases::max_difference(pair.value().first, pair.value().second));
                    return {};
                  }});
  return jobs;
}

// Dammertz et al. 2010: levels whose taps lie 1, 2, 4, ... pixels apart, 25 each, reach as far as a window with all its taps.
std::vector<Job> filter_reproduction(Session& session) {
  std::vector<Job> jobs;
  const bool quick = session.settings().quick;
  for (const int levels : quick ? std::vector{4} : std::vector{4, 5})
    jobs.push_back({fmt::format("bilateral reproduction: atrous of {} levels", levels), [&session, levels]() -> Status {
                      const int reach = 2 * ((1 << levels) - 1), wide = 2 * reach + 1;
                      Setting direct = setting("gdn", 128);
                      direct.params.radius = reach;
                      direct.params.sigma_space = reach / 2.0;
                      Setting atrous = direct;
                      atrous.params.variant = BilateralVariant::atrous;
                      atrous.params.levels = levels;
                      const auto runs = timed_pair(session, direct, atrous, fmt::format("bilateral reproduction: atrous {}", levels));
                      if (!runs) return runs.status();
                      const Sample r = summarise(ratios(runs.value().times.a, runs.value().times.b));
                      const double claimed = levels == 4 ? 40.96 : 125.0;
                      add(session, {fmt::format("{} passes of 25 taps reach as far as {} x {}: {} taps for {}, time ratio", levels, wide,
                                                wide, 25 * levels, wide * wide),
                                    levels == 4 ? "count of taps, 4,096 against 100 for 64 pixels; levels as Dammertz et al. 2010"
                                                : "count of taps, 15,625 against 125 for 125 pixels; levels as Dammertz et al. 2010",
                                    claimed, r, within(r.median, claimed, 1.5),
                                    "a pass reads and writes an image, and weighs taps that lie far apart; the window's taps beyond "
                                    "the picture, 128 x 128, are left out"});
                      return {};
                    }});
  return jobs;
}

}  // namespace luxel::report

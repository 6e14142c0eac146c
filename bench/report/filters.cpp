// Approximations of bilateral beside the filter, and what its terms cost.
#include "bench/report/filters.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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
    row.shade = to_json(ms.value());
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

}  // namespace

// What a term costs that is left out where it is not asked for.
std::vector<Job> filter_left_out(Session& session) {
  std::vector<Job> jobs;
  if (session.is_cpu() && session.settings().quick) return jobs;  // 10 s that nobody runs it for
  for (const auto& [term, what] :
       {std::pair{'d', "the depth term"}, {'n', "the normal term"}, {'g', "the colour term"}}) {
    if (session.settings().quick && term != 'd') continue;  // each compiles a window of its own
    jobs.push_back(
        {fmt::format("bilateral left out {}", what), [&session, term = term, what = what]() -> Status {
           const std::string all = "gdn";
           std::string fewer;
           for (const char t : all)
             if (t != term) fewer += t;
           std::vector<std::shared_ptr<Run>> runs;
           for (const std::string& terms : {all, fewer}) {
             const BilateralParams p = cases::bilateral_params(512, 512, terms);
             const cases::BilateralImages images = cases::bilateral_images(p, 1);
             Result<Run> made = Run::make(session.context(), plan(p, session.context().profile()));
             if (!made) return made.status();
             if (Status s = write_inputs(made.value(), {{"src", &images.src},
                                                        {"guide", &images.guide},
                                                        {"depth", &images.depth},
                                                        {"normals", &images.normals}});
                 !s)
               return s;
             runs.push_back(std::make_shared<Run>(std::move(made).value()));
           }
           const auto pair = session.interleave(timed(runs[0]), timed(runs[1]), fmt::format("left out: {}", what));
           if (!pair) return pair.status();
           std::vector<double> saved;
           for (std::size_t i = 0; i < pair.value().a.size(); ++i)
             saved.push_back(pair.value().a[i] - pair.value().b[i]);
           session.row("left_out", {{"kernel", "bilateral"},
                                    {"scene", "a floor, a wall and a box 512x512"},
                                    {"what", fmt::format("{} is not asked for: neither compiled nor bound", what)},
                                    {"level", 1},
                                    {"saved_ms", summarise(saved).median},
                                    {"saved_bytes", runs[0]->plan().bytes - runs[1]->plan().bytes},
                                    {"error", 0},
                                    {"device", session.device()}});
           return {};
         }});
  }
  // Sky is not filtered; the same picture with a surface there is.
  jobs.push_back({"bilateral left out sky", [&session]() -> Status {
                    const BilateralParams p = cases::bilateral_params(512, 512, "dn");
                    cases::BilateralImages surface = cases::bilateral_images(p, 1), sky = surface;
                    for (std::size_t i = 0; i < sky.depth.size() / 2; ++i) sky.depth[i] = HUGE_VAL;
                    std::vector<std::shared_ptr<Run>> runs;
                    for (const cases::BilateralImages* images : {&surface, &sky}) {
                      Result<Run> made = Run::make(session.context(), plan(p, session.context().profile()));
                      if (!made) return made.status();
                      if (Status s = write_inputs(made.value(), {{"src", &images->src},
                                                                 {"depth", &images->depth},
                                                                 {"normals", &images->normals}});
                          !s)
                        return s;
                      runs.push_back(std::make_shared<Run>(std::move(made).value()));
                    }
                    const auto pair = session.interleave(timed(runs[0]), timed(runs[1]), "left out: sky");
                    if (!pair) return pair.status();
                    std::vector<double> saved;
                    for (std::size_t i = 0; i < pair.value().a.size(); ++i)
                      saved.push_back(pair.value().a[i] - pair.value().b[i]);
                    // What was not filtered is the input to the bit.
                    const auto out = runs[1]->read("dst");
                    if (!out) return out.status();
                    const std::size_t half = sky.src.size() / 2;
                    const double changed = cases::max_difference(Values(out.value().begin(), out.value().begin() + half),
                                                                 Values(sky.src.begin(), sky.src.begin() + half));
                    session.row("left_out", {{"kernel", "bilateral"},
                                             {"scene", "sky above a wall and a box 512x512"},
                                             {"what", "the half of the picture that is sky is not filtered"},
                                             {"level", 2},
                                             {"saved_ms", summarise(saved).median},
                                             {"saved_bytes", 0},
                                             {"error", changed},
                                             {"device", session.device()}});
                    return {};
                  }});
  // Tiles without edges are blurred by rows and columns.
  jobs.push_back({"bilateral left out flat tiles", [&session]() -> Status {
                    BilateralParams p = cases::bilateral_params(512, 512, "dn");
                    const cases::BilateralImages images = cases::bilateral_images(p, 1);
                    std::vector<std::shared_ptr<Run>> runs;
                    for (const double flat : {0.0, 0.05}) {
                      p.flat = flat;
                      Result<Run> made = Run::make(session.context(), plan(p, session.context().profile()));
                      if (!made) return made.status();
                      if (Status s = write_inputs(made.value(), {{"src", &images.src},
                                                                 {"depth", &images.depth},
                                                                 {"normals", &images.normals}});
                          !s)
                        return s;
                      runs.push_back(std::make_shared<Run>(std::move(made).value()));
                    }
                    const auto pair = session.interleave(timed(runs[0]), timed(runs[1]), "left out: flat tiles");
                    if (!pair) return pair.status();
                    std::vector<double> saved;
                    for (std::size_t i = 0; i < pair.value().a.size(); ++i)
                      saved.push_back(pair.value().a[i] - pair.value().b[i]);
                    const auto all = runs[0]->read("dst"), some = runs[1]->read("dst");
                    if (!all) return all.status();
                    if (!some) return some.status();
                    session.row("left_out", {{"kernel", "bilateral"},
                                             {"scene", "a floor, a wall and a box 512x512"},
                                             {"what", "tiles without edges in depth and normals (flat 0.05) are blurred by space alone"},
                                             {"level", 3},
                                             {"saved_ms", summarise(saved).median},
                                             {"saved_bytes", 0},
                                             {"error", cases::max_difference(all.value(), some.value())},
                                             {"device", session.device()}});
                    return {};
                  }});
  return jobs;
}

}  // namespace luxel::report

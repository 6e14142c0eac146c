#include "bench/report/propagation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/report/bench.h"
#include "bench/report/claims.h"
#include "bench/report/limits.h"
#include "tests/cases/compare.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;
constexpr double pi = std::numbers::pi;

// A cosine lobe of axial intensity 1 W/sr in the middle of a grid, in every channel; an isotropic light never makes a
// negative lobe.
constexpr std::array<double, 3> axis = {0.6, 0, 0.8};
Values point_light(const LpvPropagateParams& p) {
  const auto& e = p.grid.extent;
  const std::size_t cells = lpv_pixels(p.grid, 2, 1), channel = lpv_pixels(p.grid, p.bands, 1);
  Values light(4 * lpv_pixels(p.grid, p.bands, p.channels), 0);
  const std::size_t at = static_cast<std::size_t>((e[2] / 2 * e[1] + e[1] / 2) * e[0] + e[0] / 2);
  for (int c = 0; c < p.channels; ++c)
    for (int i = 0; i < p.bands * p.bands; ++i)
      light[4 * (static_cast<std::size_t>(c) * channel + static_cast<std::size_t>(i / 4) * cells + at) + static_cast<std::size_t>(i % 4)] =
          cases::lpv_cosine(i, axis, pi);
  return light;
}

// Irradiance, times the squared distance, on surfaces that face the light in cells 2 to `reach` cells away; without pixels
// what the light sends there.
Values irradiance(const LpvPropagateParams& p, const Values& pixels, double reach) {
  const auto& e = p.grid.extent;
  const std::size_t cells = lpv_pixels(p.grid, 2, 1);
  Values out;
  for (int z = 0; z < e[2]; ++z)
    for (int y = 0; y < e[1]; ++y)
      for (int x = 0; x < e[0]; ++x) {
        const double d[3] = {double(x - e[0] / 2), double(y - e[1] / 2), double(z - e[2] / 2)};
        const double r = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        if (r < 2 || r > reach) continue;
        const std::array<double, 3> n = {d[0] / r, d[1] / r, d[2] / r};
        const std::size_t cell = static_cast<std::size_t>((z * e[1] + y) * e[0] + x);
        if (pixels.empty()) {
          out.push_back(std::max(0.0, n[0] * axis[0] + n[1] * axis[1] + n[2] * axis[2]));
          continue;
        }
        double sum = 0;
        for (int i = 0; i < p.bands * p.bands; ++i)  // c . (the lobe <n|w>+)
          sum += pixels[4 * (static_cast<std::size_t>(i / 4) * cells + cell) + static_cast<std::size_t>(i % 4)] *
                 cases::lpv_cosine(i, n, pi);
        out.push_back(sum * r * r);
      }
  return out;
}

// Root mean square of a - b.
double apart(const Values& a, const Values& b) {
  if (a.size() != b.size()) return std::nan("");
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::string label(const LpvPropagateParams& p) {
  return fmt::format("light_propagation {} {} bands {} {} channels {} steps{} {}^3", cases::name(p.lobes), p.bands,
                     luxel::name(p.format), p.channels, p.iterations, p.geometry ? " geometry" : p.active ? " active" : "", p.grid.extent[0]);
}

LpvPropagateParams setting(int side, LpvLobes lobes, int bands, Format format, int iterations) {
  LpvPropagateParams p = cases::lpv_params({side, side, side}, bands, lobes);
  p.channels = 3, p.format = format, p.iterations = iterations;
  return p;
}

Result<std::shared_ptr<Run>> ready(Context& context, const LpvPropagateParams& p, const Values& light, const Values& blocks = {}) {
  Result<Run> made = Run::make(context, plan(p, context.profile()));
  if (!made) return made.status();
  const auto run = std::make_shared<Run>(std::move(made).value());
  if (Status s = run->write("injected", light); !s) return s;
  if (p.geometry)
    if (Status s = run->write("geometry", blocks); !s) return s;
  return run;
}

Result<Values> result_of(Context& context, const LpvPropagateParams& p, std::uint64_t* bits = nullptr) {
  const auto run = ready(context, p, point_light(p));
  if (!run) return run.status();
  if (Status s = run.value()->go(); !s) return s;
  if (bits) {
    const auto bytes = run.value()->bytes("result");
    if (!bytes) return bytes.status();
    *bits = hash_bytes(bytes.value());
  }
  return run.value()->read("result");
}

Status measure(Session& session, const LpvPropagateParams& p) {
  const double reach = p.grid.extent[0] / 4.0;
  const std::string where = label(p);
  const auto run = ready(session.context(), p, point_light(p));
  if (!run) return run.status();
  const Result<Sample> ms = session.time(*run.value(), where);
  if (!ms) return ms.status();
  const auto bytes = run.value()->bytes("result");
  if (!bytes) return bytes.status();
  const Values own = irradiance(p, cases::fetch(bytes.value(), p.format, session.context().real64()), reach);

  const auto errors = session.errors(
      where,
      {fmt::format("rms of E r^2 against the linear operator, r of 2..{:g} cells; truth at most 1", reach),
       fmt::format("rms of E r^2 against the inverse square, r of 2..{:g} cells; truth at most 1", reach)},
      hash_bytes(bytes.value()), true,
      [&]() -> Result<std::vector<Oracle>> {
        Oracle linear;
        LpvPropagateParams f32 = p, one = p, plain = p;
        f32.format = Format::f32x4;
        one.channels = plain.channels = 1, one.format = plain.format = Format::f32x4;
        plain.lobes = LpvLobes::linear;
        const auto exact = result_of(session.cpu_double(), one);
        const auto stored = result_of(session.cpu_float(), p, &linear.bits);
        const auto unrounded = p.format == Format::f32x4 ? stored : result_of(session.cpu_float(), f32);
        if (!exact) return exact.status();
        if (!stored) return stored.status();
        if (!unrounded) return unrounded.status();
        const Values light = truth::lpv_from_pixels(p.grid, p.bands, point_light(one));
        const Values truth = irradiance(p, truth::lpv_to_pixels(p.grid, p.bands, truth::lpv_propagated(plain, light, {})), reach);
        const Values d = irradiance(p, exact.value(), reach), s = irradiance(p, stored.value(), reach),
                     f = irradiance(p, unrounded.value(), reach);
        linear.rounding = apart(f, d), linear.storage = apart(s, f), linear.method = apart(d, truth);
        Oracle square = linear;
        square.method = apart(d, irradiance(p, {}, reach));
        return std::vector<Oracle>{linear, square};
      },
      [&]() -> Result<std::vector<double>> {
        const auto expected = result_of(session.cpu_float(), p);
        if (!expected) return expected.status();
        const double d = apart(own, irradiance(p, expected.value(), reach));
        return std::vector<double>{d, d};
      });
  if (!errors) return errors.status();
  for (std::size_t metric = 0; metric < 2; ++metric) {
    FrontierRow row{"light_propagation", cases::name(p.lobes), "one light in free space", fmt::format("{0}x{0}x{0}", p.grid.extent[0]),
                    {{"format", luxel::name(p.format)}, {"channels", p.channels}},
                    {{"bands", p.bands}, {"iterations", p.iterations}},
                    metric == 0 ? fmt::format("{} steps", p.iterations) : "any", errors.value()[metric]};
    row.update = cell_of(ms.value());
    row.costs_of(*run.value());
    session.frontier(row);
  }
  return {};
}

// `more` makes what `fewer` leaves out; `error`: how many values of fewer's result differ.
Status compare(Session& session, const std::string& what, int level, const LpvPropagateParams& more, const Values& light_more,
               const LpvPropagateParams& fewer, const Values& light_fewer) {
  const Values nothing = more.geometry ? Values(4 * lpv_geometry_pixels(more.grid), 0) : Values();
  const auto a = ready(session.context(), more, light_more, nothing), b = ready(session.context(), fewer, light_fewer);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), "left out: " + what);
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  auto x = a.value()->read("result");
  const auto y = b.value()->read("result");
  if (!x) return x.status();
  if (!y) return y.status();
  Values kept = x.value();
  kept.resize(std::min(kept.size(), y.value().size()));
  double most = 0;
  for (const double v : kept) most = std::max(most, std::fabs(v));
  session.row("left_out", {{"kernel", "light_propagation"},
                           {"scene", fmt::format("{0}x{0}x{0}", fewer.grid.extent[0])},
                           {"what", fmt::format("{}: {:.0f} % of the time is left", what, 100 * summarise(ratios(pair.value().b, pair.value().a)).median)},
                           {"level", level},
                           {"saved_ms", saved.median},
                           {"saved_bytes", a.value()->plan().bytes - b.value()->plan().bytes},
                           {"error", cases::max_difference(kept, y.value()) / std::max(most, 1e-300)},
                           {"device", session.device()}});
  return {};
}

// The share of a cube's cells that a light in its middle has reached, mean over the steps' ends: one ring of faces a step.
double lit_share(int side, int steps) {
  double lit = 0;
  const int middle = side / 2;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        lit += std::max(0, steps - std::max(1, std::abs(x - middle) + std::abs(y - middle) + std::abs(z - middle)) + 1);
  return lit / steps / (static_cast<double>(side) * side * side);
}

Cell row_of(Session& session, const std::string& peer, const LpvPropagateParams& p, const Session::Pair& pair, double scale, Cell goal) {
  std::vector<double> r = ratios(pair.b, pair.a);
  for (double& v : r) v *= scale;
  const Sample ratio = summarise(r);
  return {{"peer", peer},
          {"version", "-"},
          {"kernel", "light_propagation"},
          {"size", fmt::format("{0}x{0}x{0}", p.grid.extent[0])},
          {"time_ms", cell_of(summarise(pair.b))},
          {"error", nullptr},
          {"ratio", ratio.median},
          {"q1", ratio.q1},
          {"q3", ratio.q3},
          {"device", session.device()},
          {"options", {{"bands", p.bands}, {"format", luxel::name(p.format)}, {"iterations", p.iterations}}},
          {"own_ms", cell_of(summarise(pair.a))},
          {"own_error", nullptr},
          {"goal", std::move(goal)}};
}

// A copy or triad of as many bytes as the plan has to move at least.
Status beside_limit(Session& session, const LpvPropagateParams& p, bool triad, Cell goal) {
  Values light = point_light(p);
  const auto own = ready(session.context(), p, light);
  if (!own) return own.status();
  const double bytes = own.value()->plan().bytes, moved = triad ? 48 : 32;
  const int width = 1024, height = static_cast<int>(bytes / moved / width);
  const double scale = bytes / (moved * width * height);
  const Values half(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 0.5);
  Cell best;
  double least = HUGE_VAL;  // ms
  const auto beside = [&](const std::string& name, const Result<Plan>& plan, std::initializer_list<const char*> inputs) -> Status {
    Result<Run> made = Run::make(session.context(), plan);
    if (!made) return made.status();
    const auto run = std::make_shared<Run>(std::move(made).value());
    for (const char* const input : inputs)
      if (Status s = run->write(input, half); !s) return s;
    const auto pair = session.interleave(timed(own.value()), timed(run), "peer: " + name);
    if (!pair) return pair.status();
    const double ms = summarise(pair.value().b).median;
    if (ms < least) best = row_of(session, name, p, pair.value(), scale, goal);
    least = std::min(least, ms);
    return {};
  };
  const Profile& profile = session.context().profile();
  if (triad) {
    if (Status s = beside("triad of as many bytes", triad_plan(width, height, profile), {"b", "c"}); !s) return s;
  } else {
    for (const CopyForm& form : copy_forms(session))
      if (Status s = beside(fmt::format("best copy of as many bytes by a compute shader ({})", form.name),
                            copy_plan(width, height, 16, form, profile), {"src"});
          !s)
        return s;
  }
  session.row("peers", best);
  return {};
}

}  // namespace

std::vector<Job> propagation_grid(Session& session) {
  const bool quick = session.settings().quick;
  std::vector<Job> jobs;
  const auto add = [&](const LpvPropagateParams& p) {
    jobs.push_back({label(p), [&session, p] { return measure(session, p); }});
  };
  if (quick) {
    add(setting(16, LpvLobes::linear, 2, Format::f32x4, 8));
    add(setting(16, LpvLobes::rescale, 2, Format::f16x4, 8));
    add_copies(session, jobs, "16x16x16", 16 * 16, 16 * 3);
    return jobs;
  }
  for (const int iterations : {4, 8, 16, 32})
    for (const LpvLobes lobes : cases::all_lobes)
      for (const int bands : {2, 3}) {
        add(setting(32, lobes, bands, Format::f32x4, iterations));
        if (iterations == 8) add(setting(32, lobes, bands, Format::f16x4, iterations));
      }
  for (const int iterations : {8, 32}) add(setting(64, LpvLobes::linear, 2, Format::f32x4, iterations));
  for (const int side : {32, 64}) add_copies(session, jobs, fmt::format("{0}x{0}x{0}", side), side * side, side * 3);
  return jobs;
}

std::vector<Job> propagation_left_out(Session& session) {
  const bool quick = session.settings().quick;
  const int side = quick ? 16 : 32;
  const LpvPropagateParams plain = setting(side, LpvLobes::linear, 2, Format::f32x4, 8);
  LpvPropagateParams blocked = plain, one = plain;
  blocked.geometry = true, one.channels = 1;
  const Values light = point_light(plain);
  std::vector<Job> jobs;
  const auto pair = [&](const std::string& what, int level, const LpvPropagateParams& more, const LpvPropagateParams& fewer) {
    jobs.push_back({"light_propagation left out: " + what,
                    [&session, what, level, more, fewer] { return compare(session, what, level, more, point_light(more), fewer, point_light(fewer)); }});
  };
  pair("the geometry volume where nothing blocks", 1, blocked, plain);
  pair("channels that equal the first (one for three)", 2, plain, one);
  for (const int steps : quick ? std::vector<int>{8} : std::vector<int>{2, 8, 32}) {
    LpvPropagateParams all = setting(quick ? side : 64, LpvLobes::linear, 2, Format::f32x4, steps);
    all.channels = 1;
    LpvPropagateParams lit = all;
    lit.active = true;
    pair(fmt::format("cells that no light has reached (one light, {} steps, {:.2g} % of all cells lit)", steps,
                     100 * lit_share(all.grid.extent[0], steps)),
         2, all, lit);
  }
  LpvPropagateParams ended = one;
  ended.active = true, ended.error = 0.01;
  one.iterations = ended.iterations = 64;
  pair("steps after the largest coefficient fell to 1 % (one light, at most 64 steps)", 3, one, ended);
  return jobs;
}

std::vector<Job> propagation_reproduction(Session& session) {
  if (session.settings().quick && !session.is_cpu()) return {};
  const int side = session.settings().quick ? 16 : 32;
  return {
      {"light_propagation reproduction: iterations", [&session, side]() -> Status {
         LpvPropagateParams p = setting(side, LpvLobes::linear, 2, Format::f32x4, side / 4);
         p.channels = 1;
         const auto few = result_of(session.context(), p);
         p.iterations = 8 * side / 4;
         const auto many = result_of(session.context(), p);
         if (!few) return few.status();
         if (!many) return many.status();
         const Values a = irradiance(p, few.value(), side / 4.0), b = irradiance(p, many.value(), side / 4.0);
         double sum = 0, all = 0;
         for (std::size_t i = 0; i < a.size(); ++i) sum += a[i], all += b[i];
         add(session, {fmt::format("8 iterations are enough for 32^3: share of the light after {} steps that {} bring to 2..{} cells",
                                   8 * side / 4, side / 4, side / 4),
                       "Hong 2015, 2.5.2.8 (Kaplanyan and Dachsbacher 2010)", 1, once(sum / all), {"above 0.95", sum / all > 0.95},
                       "light takes a step a cell at least, and as a diffusion about the square of the distance: what 8 steps bring is "
                       "near the light"});
         return {};
       }},
      {"light_propagation reproduction: f16", [&session, side]() -> Status {
         LpvPropagateParams p = setting(side, LpvLobes::linear, 2, Format::f32x4, 8);
         p.channels = 1;
         const auto wide = result_of(session.context(), p);
         p.format = Format::f16x4;
         const auto half = result_of(session.context(), p);
         if (!wide) return wide.status();
         if (!half) return half.status();
         const double error = apart(irradiance(p, wide.value(), side / 4.0), irradiance(p, half.value(), side / 4.0));
         add(session, {"16-bit floats keep the quality: rms that they add to E r^2",
                       "Hong 2015, 2.5.2.8 (Kaplanyan and Dachsbacher 2010; no number is printed)", nullptr, once(error),
                       {"1e-3 or less", error <= 1e-3}, "volumes in f16, f32 between steps"});
         return {};
       }}};
}

std::vector<Job> propagation_peers(Session& session) {
  if (session.is_cpu()) return {};
  const std::string& profile = session.context().profile().name;
  const Cell triad_goal = profile == "pocl" ? Cell(0.5) : Cell(), copy_goal = profile == "lavapipe" ? Cell(0.8) : Cell();
  const int side = session.settings().quick || profile == "lavapipe" ? 32 : 64;  // lavapipe binds 128 MiB at most
  std::vector<Job> jobs;
  for (const int bands : session.settings().quick ? std::vector<int>{2} : std::vector<int>{2, 3}) {
    const LpvPropagateParams p = setting(side, LpvLobes::linear, bands, Format::f32x4, 8);
    jobs.push_back({fmt::format("light_propagation peer: triad, {} bands", bands), [=, &session] { return beside_limit(session, p, true, triad_goal); }});
    jobs.push_back({fmt::format("light_propagation peer: copy, {} bands", bands), [=, &session] { return beside_limit(session, p, false, copy_goal); }});
  }
  return jobs;
}

std::vector<BenchSetting> light_propagation_settings(const Profile& profile) {
  std::vector<BenchSetting> settings;
  const auto add = [&](const LpvPropagateParams& p) {
    const Result<Plan> made = plan(p, profile);
    if (!made) return;
    BenchSetting s{label(p).substr(std::string("light_propagation ").size()), made.value(), {"injected"}};
    if (p.geometry) s.fill.push_back("geometry");
    settings.push_back(std::move(s));
  };
  for (const LpvLobes lobes : cases::all_lobes) add(setting(32, lobes, 2, Format::f32x4, 8));
  add(setting(32, LpvLobes::linear, 2, Format::f16x4, 8));
  add(setting(32, LpvLobes::linear, 3, Format::f32x4, 8));
  LpvPropagateParams p = setting(32, LpvLobes::linear, 2, Format::f32x4, 8);
  p.geometry = true;
  add(p);
  p.geometry = false, p.active = true;
  add(p);
  add(setting(64, LpvLobes::linear, 2, Format::f32x4, 8));
  return settings;
}

}  // namespace luxel::report

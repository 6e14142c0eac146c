// What mip_build leaves out where it is not needed, claims measured again, and peers.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "bench/report/claims.h"
#include "bench/report/limits.h"
#include "bench/report/mips.h"
#include "bench/report/march.h"
#include "bench/scene/volumes.h"
#include "bench/truth/mip_truth.h"
#include "tests/cases/compare.h"

namespace luxel::report {
namespace {

using Clock = std::chrono::steady_clock;

// `more` makes what `fewer` leaves out. What both make must have the same bits: the error is the number that differ.
Status compare(Session& session, const MipSetting& more, const MipSetting& fewer, const std::string& what, int level,
               bool same_values) {
  const auto a = ready_mips(session, more), b = ready_mips(session, fewer);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), "left out: " + what);
  if (!pair) return pair.status();
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  double different = 0;
  if (same_values)
    for (const std::string& name : cases::mip_names(fewer.params)) {
      const auto x = a.value()->read(name), y = b.value()->read(name);
      if (!x) return x.status();
      if (!y) return y.status();
      different += cases::count_different(x.value(), y.value());
    }
  session.row("left_out", {{"kernel", "mip_build"},
                           {"scene", fewer.scene->name + " " + size_text(fewer.scene->extent)},
                           {"what", what},
                           {"level", level},
                           {"saved_ms", saved.median},
                           {"saved_bytes", mip_bytes(session, more) - mip_bytes(session, fewer)},
                           {"error", different},
                           {"device", session.device()}});
  return {};
}

double resource_bytes(const Plan& plan) {
  double sum = 0;
  for (const Resource& r : plan.resources) sum += static_cast<double>(r.bytes);
  return sum;
}

// The isotropic means of one volume, 2 x 2 x 2, by plain loops on two threads: what somebody writes without a library.
class PlainMips {
 public:
  explicit PlainMips(int side) {
    for (int n = side; n >= 1; n /= 2) levels_.emplace_back(static_cast<std::size_t>(n) * n * n * 4);
    const std::vector<double> room = scene::voxel_room(side);
    std::copy(room.begin(), room.end(), levels_[0].begin());
  }

  double run() {
    const auto begin = Clock::now();
    for (std::size_t l = 1; l < levels_.size(); ++l) {
      const int m = 1 << (levels_.size() - 1 - l);
      const auto slices = [&](int first, int last) {
        reduce(levels_[l - 1].data(), levels_[l].data(), m, first, last);
      };
      if (m < 8) {
        slices(0, m);
        continue;
      }
      std::thread other([&] { slices(m / 2, m); });
      slices(0, m / 2);
      other.join();
    }
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  }

  const std::vector<float>& level(std::size_t l) const { return levels_[l]; }

 private:
  static void reduce(const float* from, float* to, int m, int first, int last) {
    const std::size_t row = static_cast<std::size_t>(m) * 2 * 4, slice = row * m * 2;
    for (int z = first; z < last; ++z)
      for (int y = 0; y < m; ++y) {
        const float* a = from + 2 * z * slice + 2 * y * row;
        float* out = to + (static_cast<std::size_t>(z) * m + y) * m * 4;
        for (int x = 0; x < m; ++x, a += 8, out += 4)
          for (int c = 0; c < 4; ++c)
            out[c] = (((a[c] + a[c + 4]) + (a[row + c] + a[row + c + 4])) +
                      ((a[slice + c] + a[slice + c + 4]) + (a[slice + row + c] + a[slice + row + c + 4]))) *
                     0.125f;
      }
  }
  std::vector<std::vector<float>> levels_;
};

Cell peer_row(Session& session, const std::string& peer, const std::string& version, const MipSetting& s,
              const Session::Pair& pair, Cell error, Cell own_error, double ratio_scale, Cell goal) {
  std::vector<double> r = ratios(pair.b, pair.a);
  for (double& v : r) v *= ratio_scale;
  const Sample ratio = summarise(r);
  return {{"peer", peer},
          {"version", version},
          {"kernel", "mip_build"},
          {"size", size_text(s.scene->extent)},
          {"time_ms", cell_of(summarise(pair.b))},
          {"error", std::move(error)},
          {"ratio", ratio.median},
          {"q1", ratio.q1},
          {"q3", ratio.q3},
          {"device", session.device()},
          {"options", {{"format", name(s.params.format)}, {"variant", cases::name(s.params.variant)}}},
          {"own_ms", cell_of(summarise(pair.a))},
          {"own_error", std::move(own_error)},
          {"goal", std::move(goal)}};
}

MipSetting peer_setting() {
  const auto room =
      std::make_shared<MipScene>(MipScene{"room (generated)", {128, 128, 128}, 4, scene::voxel_room(128)});
  return setting_for(room, MipVariant::isotropic, Format::f32x4);
}

Status beside_loop(Session& session, Cell goal) {
  const MipSetting s = peer_setting();
  const auto own = ready_mips(session, s);
  if (!own) return own.status();
  PlainMips loop(128);
  const auto pair = session.interleave(
      timed(own.value()), [&]() -> Result<double> { return loop.run(); }, "peer: plain C++ loop");
  if (!pair) return pair.status();
  const auto truth = truth::pyramid(s.params, s.scene->values);
  double error = 0, own_error = 0;
  for (int level = 1; level <= mip_levels(s.params); ++level) {
    const auto v = own.value()->read(mip_level_name(level));
    if (!v) return v.status();
    const std::vector<float>& other = loop.level(static_cast<std::size_t>(level));
    own_error = std::max(own_error, cases::max_difference(v.value(), truth[level].values));
    error =
        std::max(error, cases::max_difference(std::vector<double>(other.begin(), other.end()), truth[level].values));
  }
  session.row("peers", peer_row(session, "plain C++ loops, 2 threads", __VERSION__, s, pair.value(), error, own_error,
                                1, std::move(goal)));
  return {};
}

// The best copy of the driver, of as many bytes as the pyramid moves: read and written the same number.
Status beside_copy(Session& session, Cell goal) {
  const MipSetting s = peer_setting();
  const auto own = ready_mips(session, s);
  if (!own) return own.status();
  const double bytes = mip_bytes(session, s);
  const int width = 1024, height = static_cast<int>(bytes / 2 / 16 / width);
  const double scale = bytes / (2.0 * 16 * width * height);
  Cell best;
  double least = HUGE_VAL;  // ms
  for (const CopyForm& form : copy_forms(session)) {
    Result<cases::Run> copy =
        cases::Run::make(session.context(), copy_plan(width, height, 16, form, session.context().profile()));
    if (!copy) return copy.status();
    const auto run = std::make_shared<cases::Run>(std::move(copy).value());
    if (Status status = run->write("src", std::vector<double>(static_cast<std::size_t>(width) * height * 4, 0.5));
        !status)
      return status;
    const auto pair = session.interleave(timed(own.value()), timed(run), "peer: copy");
    if (!pair) return pair.status();
    const double ms = summarise(pair.value().b).median;
    if (ms >= least) continue;
    least = ms;
    best = peer_row(session, fmt::format("best copy of as many bytes by a compute shader ({})", form.name), "-", s, pair.value(),
                    nullptr, nullptr, scale, goal);
  }
  session.row("peers", best);
  return {};
}

}  // namespace

std::vector<Job> mip_left_out(Session& session, const MipScenes& scenes) {
  std::vector<Job> jobs;
  const auto pair = [&](const char* what, int level, const MipSetting& more, const MipSetting& fewer,
                        bool same_values) {
    jobs.push_back({fmt::format("mip_build left out: {}", what),
                    [&session, what = std::string(what), level, more, fewer, same_values] {
                      return compare(session, more, fewer, what, level, same_values);
                    }});
  };
  const MipSetting six = setting_for(scenes.room, MipVariant::anisotropic, Format::f32x4);
  MipSetting fewer = six;
  fewer.params.directions = mip_px | mip_pz;
  pair("directional volumes that no cone looks up (four of six)", 3, six, fewer, true);
  MipSetting all = setting_for(scenes.room, MipVariant::isotropic, Format::f32x4);
  fewer = all;
  fewer.params.levels = 3;
  pair("levels above the coarsest that the widest cone reads (all but three)", 3, all, fewer, true);
  MipSetting counted = all;
  counted.params.count = true;
  pair("counters of what was cleaned", 1, counted, all, true);
  pair("three channels that are not there (f32x1 for f32x4)", 1, all,
       setting_for(scenes.room, MipVariant::isotropic, Format::f32x1), false);
  const MipSetting full = setting_for(scenes.hall, MipVariant::min, Format::f32x1);
  fewer = full;
  fewer.params.ratio = 16;
  pair("levels between the finest and 1/16 (two-level distance maps)", 3, full, fewer, false);
  return jobs;
}

std::vector<Job> mip_reproduction(Session& session, const MipScenes& scenes) {
  std::vector<Job> jobs;
  jobs.push_back({"mip_build reproduction: memory of directional volumes", [&session, scenes]() -> Status {
                    const Profile& profile = session.context().profile();
                    const Result<Plan> six =
                        plan(setting_for(scenes.room, MipVariant::anisotropic, Format::f32x4).params, profile);
                    const Result<Plan> one =
                        plan(setting_for(scenes.room, MipVariant::isotropic, Format::f32x4).params, profile);
                    if (!six) return six.status();
                    if (!one) return one.status();
                    const double more = resource_bytes(six.value()) / resource_bytes(one.value());
                    add(session, {"directional volumes take 1.5 times the memory of the isotropic pyramid",
                                  "Hong 2015, 2.5.3.3.10 (after Crassin et al. 2011)", 1.5, once(more),
                                  {"within 0.05", std::fabs(more - 1.5) < 0.05},
                                  "13/8: the finest level is shared, six volumes stand on it (1 + 6/7 against 1 + 1/7); 1.5 more of "
                                  "what is above it would be 12/7"});
                    return {};
                  }});
  return jobs;
}

// Marches on the host: how many levels pay does not depend on who built them.
std::vector<Job> mip_marches(Session& session, const MipScenes& scenes) {
  return {{"mip_build reproduction: two levels against the full hierarchy", [&session, scenes]() -> Status {
         const MarchScene march = make_march_scene(*scenes.hall);
         std::vector<double> full, two;
         MarchResult a, b;
         const auto pair = session.interleave(
             [&]() -> Result<double> {
               a = march_full(march);
               return a.ms;
             },
             [&]() -> Result<double> {
               b = march_two(march);
               return b.ms;
             },
             "march");
         if (!pair) return pair.status();
         if (a.hits != b.hits || a.sum != b.sum) return {Code::internal, "the two marches found different hits"};
         const Sample r = summarise(ratios(pair.value().a, pair.value().b));
         add(session, {"two levels (full and 1/16) beat the full hierarchy for distance maps (time ratio of the marches)",
                       "McGuire et al. 2017, 4.2 (no number is printed)", nullptr, r, above_one(r),
                       fmt::format("on a CPU core with a cache there is no stack to spill; steps a ray: full {:.1f}, two levels {:.1f}, "
                                   "{} rays of which {} hit, the same in both",
                                   a.steps, b.steps, a.rays, a.hits)});
         return {};
       }}};
}

std::vector<Job> mip_peers(Session& session) {
  if (session.is_cpu()) return {};
  const std::string& profile = session.context().profile().name;
  const Cell loop_goal = profile == "pocl" ? Cell(0.85) : Cell(),
             copy_goal = profile == "lavapipe" ? Cell(0.8) : Cell();
  return {{"mip_build peer: plain C++ loop", [=, &session] { return beside_loop(session, loop_goal); }},
          {"mip_build peer: copy", [=, &session] { return beside_copy(session, copy_goal); }}};
}

}  // namespace luxel::report

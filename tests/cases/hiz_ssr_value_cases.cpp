// What else is promised: caps, self-hits, scale, outcomes, bits.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "tests/cases/compare.h"
#include "tests/cases/hiz_ssr_cases.h"
#include "tests/cases/hiz_ssr_support.h"

namespace luxel::cases {
namespace {

using std::numbers::pi;

Case cap_case(SsrVariant variant, const char* name) {
  return {"", fmt::format("step cap, {}", name),
          "a ray that reaches the cap is counted as such and is no hit; others are as without it (answers that are not)", 0,
          [=](Context& context) -> Result<double> {
            HizSsrParams p = ssr_params(80, 50, variant);
            p.rays = 400;
            p.count = true;
            p.max_distance = 8;
            const Values stored = height_field(80, 50, 61), rays = screen_rays(p, p.rays, 62);
            const auto free = follow(context, p, stored, rays);
            if (!free) return free.status();
            double bad = 0;
            for (std::size_t i = 0; i < 400; ++i) bad += free.value().outcome(i) == SsrOutcome::capped;
            for (const int cap : {1, 5, 20}) {
              p.max_steps = cap;
              const auto r = follow(context, p, stored, rays);
              if (!r) return r.status();
              double capped = 0;
              for (std::size_t i = 0; i < 400; ++i) {
                const bool reaches = free.value().paths[4 * i + 3] > cap;
                capped += reaches;
                if (reaches) {
                  bad += r.value().outcome(i) != SsrOutcome::capped;
                  for (std::size_t c = 0; c < 4; ++c) bad += r.value().hits[4 * i + c] != 0;
                } else {
                  bad += r.value().outcome(i) != free.value().outcome(i);
                  for (std::size_t c = 0; c < 4; ++c) bad += !same(r.value().hits[4 * i + c], free.value().hits[4 * i + c]);
                }
              }
              bad += capped == 0;
              bad += r.value().counters[static_cast<std::size_t>(SsrOutcome::capped)] != capped;
            }
            return bad;
          }};
}

// A plane through (0, 0, -3) with its normal tilted by so many degrees from the view axis, as the screen sees it. Depth to
// the rounding of f32; no surface where it is not seen from its front.
void tilted_plane(const HizSsrParams& p, double degrees, double turn, Values& stored, Values& normals) {
  const double a = degrees * pi / 180;
  const std::array<double, 3> n{std::sin(a) * std::cos(turn), std::sin(a) * std::sin(turn), std::cos(a)};
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const double facing = n[0] * (x + 0.5 - p.centre_x) / p.focal_x + n[1] * (p.centre_y - y - 0.5) / p.focal_y - n[2];
      const double d = facing < -1e-3 ? -3 * n[2] / facing : HUGE_VAL;
      stored.push_back(d < 1e6 ? stored_depth(p, d) : stored_depth(p, HUGE_VAL));
      for (const double v : {n[0], n[1], n[2], 0.0}) normals.push_back(static_cast<float>(v));
    }
}

// Mirror rays of planes at all tilts that hit the plane itself, in parts of all rays.
Result<double> self_hits(Context& context, double bias, std::initializer_list<double> tilts) {
  double hits = 0, rays = 0;
  for (const double degrees : tilts)
    for (const double turn : {0.0, 0.7, pi / 2, 4.0}) {
      HizSsrParams p = ssr_params(96, 64);
      p.bias = bias;
      p.count = true;
      p.near_plane = 0.05;
      Values stored, normals;
      tilted_plane(p, degrees, turn, stored, normals);
      const auto r = follow(context, p, stored, normals);
      if (!r) return r.status();
      hits += r.value().counters[static_cast<std::size_t>(SsrOutcome::hit)];
      rays += r.value().counters[static_cast<std::size_t>(SsrOutcome::rays)];
    }
  return rays > 0 ? hits / rays : std::numeric_limits<double>::quiet_NaN();
}

Case acne_case(double bias, double bound, std::initializer_list<double> tilts, const std::string& which, const char* promise) {
  const std::vector<double> all(tilts);
  return {"", fmt::format("planes {} reflect nothing of themselves, bias {}", which, bias), promise, bound,
          [=](Context& context) -> Result<double> {
            double most = 0;
            for (const double degrees : all) {
              const auto part = self_hits(context, bias, {degrees});
              if (!part) return part.status();
              most = std::max(most, part.value());
            }
            return most;
          }};
}

// A floor and a wall that meets it: what the bias does to where mirror rays of the floor meet the wall.
Case bias_case() {
  return {"", "what the bias costs", "the wall is met within a pixel of where rays from the floor itself meet it (pixels, 99 of 100 rays)", 1,
          [](Context& context) -> Result<double> {
            HizSsrParams p = ssr_params(160, 120);
            p.near_plane = 0.05;
            // Floor at y = -1, wall at z = -6.
            Values stored, normals;
            for (int y = 0; y < p.height; ++y)
              for (int x = 0; x < p.width; ++x) {
                const double down = (y + 0.5 - p.centre_y) / p.focal_y;
                const bool floor = down > 0 && 1 / down < 6;
                stored.push_back(static_cast<float>(floor ? 1 / down : 6));
                for (const double v : {0.0, floor ? 1.0 : 0.0, floor ? 0.0 : 1.0, floor ? 0.0 : 2.0}) normals.push_back(v);
              }
            const auto r = follow(context, p, stored, normals);
            if (!r) return r.status();
            Values off;
            for (int y = 0; y < p.height; ++y)
              for (int x = 0; x < p.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * p.width + x;
                if (normals[4 * i + 3] != 0 || r.value().outcome(i) != SsrOutcome::hit) continue;
                // Straight from the floor: met at height 2 (6 - d) / d ... of the mirrored eye's line.
                const double d = stored[i], down = (y + 0.5 - p.centre_y) / p.focal_y;
                const double height = -1 + (6 - d) * down;
                const double v = p.centre_y - p.focal_y * height / 6;
                off.push_back(std::fabs(r.value().hits[4 * i + 1] * p.height - v));
              }
            if (off.size() < 1000) return std::numeric_limits<double>::quiet_NaN();
            std::sort(off.begin(), off.end());
            return off[off.size() * 99 / 100];
          }};
}

Case scale_case() {
  return {"", "scene scaled by 1e-3 to 1e4", "the same scene in other units hits the same pixels (answers that differ otherwise than by ties)",
          0, [](Context& context) -> Result<double> {
            double bad = 0;
            for (const double scale : {1e-3, 1.0, 37.0, 1e4}) {
              HizSsrParams p = ssr_params(96, 60);
              p.rays = 400;
              p.near_plane = 0.05 * scale;
              p.thickness = 0.4 * scale;
              Values stored = height_field(96, 60, 71), rays = screen_rays(ssr_params(96, 60), p.rays, 72);
              for (double& d : stored) d = static_cast<float>(d * scale);
              for (std::size_t i = 0; i < rays.size(); ++i)
                if (i % 8 < 4) rays[i] = static_cast<float>(rays[i] * scale);
              const auto r = follow(context, p, stored, rays);
              if (!r) return r.status();
              const Agreement a = compare(p, stored, rays, r.value());
              bad += a.wrong + a.broken + (a.hits < 100);
            }
            return bad;
          }};
}

Case counters_case(SsrVariant variant, const char* name) {
  return {"", fmt::format("counters, {}", name), "the counters are the sums of what the rays report (difference)", 0,
          [=](Context& context) -> Result<double> {
            HizSsrParams p = ssr_params(64, 48, variant);
            p.rays = 500;
            p.count = true;
            p.thickness = 0.5;
            p.max_distance = 6;
            const auto r = follow(context, p, height_field(64, 48, 81), screen_rays(p, p.rays, 82));
            if (!r) return r.status();
            Values sums(ssr_outcomes, 0.0);
            for (std::size_t i = 0; i < 500; ++i) {
              const int outcome = static_cast<int>(r.value().outcome(i));
              ++sums[static_cast<std::size_t>(outcome)];
              if (outcome >= 1 && outcome <= 5) ++sums[static_cast<std::size_t>(SsrOutcome::rays)];
              sums[static_cast<std::size_t>(SsrOutcome::hidden)] += r.value().paths[4 * i + 2];
              sums[static_cast<std::size_t>(SsrOutcome::steps)] += r.value().paths[4 * i + 3];
            }
            return max_difference(sums, r.value().counters) + (sums[1] == 0) + (sums[2] == 0) + (sums[3] == 0);
          }};
}

// A plane at a depth of 1000 with the near plane at 1e-3: what the stored depth resolves, and no more, is lost.
Case resolution_case(SsrDepth depth, double bound) {
  const char* const how = depth == SsrDepth::standard ? "standard" : depth == SsrDepth::reversed ? "reversed" : "linear";
  return {"", fmt::format("plane at 1000, near plane 1e-3, {} depth", how),
          "the hit lies where stored f32 depth has the plane (scene units off)", bound, [=](Context& context) -> Result<double> {
            HizSsrParams p = ssr_params(48, 36);
            p.depth = depth;
            p.near_plane = 1e-3;
            p.thickness = 200;
            p.rays = 8;
            const Values stored = stored_depths(p, Values(48 * 36, 1000.0));
            Values rays;
            for (int i = 0; i < p.rays; ++i) add_ray(rays, {0.01 * i, 0.02, -1.0 - i}, {0.01 * i, 0.02, -1.0 - i});
            const auto r = follow(context, p, stored, rays);
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < 8; ++i) {
              if (r.value().outcome(i) != SsrOutcome::hit) return std::numeric_limits<double>::quiet_NaN();
              most = std::max(most, std::fabs(r.value().hits[4 * i + 2] - 1000));
            }
            return most;
          }};
}

}  // namespace

void add_ssr_value_cases(std::vector<Case>& cases) {
  // A reciprocal depth of size w is rounded by w 2^-24, which moves a depth of 1000 by 1000^2 w 2^-24: stored values have
  // w = 1 / near, the rays, which start at a depth of 1, w = 1.
  cases.push_back(resolution_case(SsrDepth::standard, 60));
  cases.push_back(resolution_case(SsrDepth::reversed, 0.06));
  cases.push_back(resolution_case(SsrDepth::linear, 0.06));
  cases.push_back(cap_case(SsrVariant::hiz, "hiz"));
  cases.push_back(cap_case(SsrVariant::dda, "dda"));
  cases.push_back(cap_case(SsrVariant::linear, "linear"));
  const char* none = "mirror rays of a plane never hit it, at any tilt (share that does, worst tilt)";
  cases.push_back(acne_case(0.5, 0, {0, 15, 30, 45, 60, 75, 85}, "of all tilts", none));
  cases.push_back(bias_case());
  cases.push_back(scale_case());
  cases.push_back(counters_case(SsrVariant::hiz, "hiz"));
  cases.push_back(counters_case(SsrVariant::dda, "dda"));
  cases.push_back(counters_case(SsrVariant::linear, "linear"));
}

std::vector<Case> hiz_ssr_cases() {
  std::vector<Case> cases;
  add_ssr_walk_cases(cases);
  add_ssr_value_cases(cases);
  add_ssr_shade_cases(cases);
  for (Case& c : cases) c.kernel = "hiz_ssr";
  return cases;
}

}  // namespace luxel::cases

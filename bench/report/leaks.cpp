#include "bench/report/leaks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bench/truth/path_truth.h"

namespace luxel::report {
namespace {

using glm::dvec3;

// Whether a point on a surface lies inside something, whose backs it sees along its normal.
bool inside(const scene::Rays& rays, dvec3 p, dvec3 n) {
  const auto hit = rays.first(p + rays.offset() * n, n);
  if (!hit) return false;
  const scene::Scene& s = rays.scene();
  const glm::uvec3 t = s.indices[hit->triangle];
  return glm::dot(glm::cross(s.positions[t.y] - s.positions[t.x], s.positions[t.z] - s.positions[t.x]), n) > 0;
}

// Middles of equal parts of every triangle of one room, on its front.
void add_room(LeakStage& stage, bool dark, double step) {
  const scene::Scene& s = stage.scene;
  for (std::size_t i = 0; i < s.indices.size(); ++i) {
    const dvec3 a = s.positions[s.indices[i].x], b = s.positions[s.indices[i].y], c = s.positions[s.indices[i].z];
    const dvec3 cross = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
    const double area = glm::length(cross) / 2;
    // What lies in the wall's own thickness belongs to no room, nor do undersides of blocks; emitters hold what they send.
    if (area == 0 || (middle.x > 0) != dark || std::fabs(middle.x) < 0.0099 || s.material_of(i).emission != dvec3(0)) continue;
    const dvec3 n = cross / (2 * area);
    if (n.y < -0.5 && middle.y < 1e-3) continue;
    const int cuts = std::max(1, static_cast<int>(std::ceil(std::sqrt(2 * area) / step)));
    for (int v = 0; v < cuts; ++v)
      for (int u = 0; u < 2 * (cuts - v) - 1; ++u) {
        const double third = u % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const dvec3 p = a + ((u / 2) + third) / cuts * (b - a) + (v + third) / cuts * (c - a);
        if (inside(*stage.rays, p, n)) continue;
        for (const double x : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) stage.receivers.push_back(static_cast<float>(x));
        stage.area.push_back(area / cuts / cuts);
        stage.dark += dark;
      }
  }
}

double mean(std::span<const double> v, std::size_t i, int channels) {
  const std::size_t at = i * static_cast<std::size_t>(channels);
  return (v[at] + v[at + 1] + v[at + 2]) / 3;
}

Leak measured(const LeakStage& stage, std::span<const double> x1, std::span<const double> x2, int channels) {
  Leak l;
  double lit = 0, truth = 0, squares = 0, area = 0, sum = 0;
  for (std::size_t i = 0; i < stage.count(); ++i) {
    const double x = (mean(x1, i, channels) + mean(x2, i, channels)) / 2, t = (mean(stage.t1, i, 3) + mean(stage.t2, i, 3)) / 2;
    if (i < stage.dark) {
      l.dark += stage.area[i] * x / stage.injected;
      continue;
    }
    lit += stage.area[i] * x;
    truth += stage.area[i] * t;
    area += stage.area[i];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = i * static_cast<std::size_t>(channels) + c;
      squares += stage.area[i] / 3 * (x1[at] - stage.t1[3 * i + c]) * (x2[at] - stage.t2[3 * i + c]);
      sum += stage.area[i] / 3 * (stage.t1[3 * i + c] + stage.t2[3 * i + c]) / 2;
    }
  }
  l.lit = lit / truth;
  l.relative = squares / area / (sum / area * sum / area);
  return l;
}

}  // namespace

Result<std::shared_ptr<const LeakStage>> leak_stage(bool quick) {
  static std::map<bool, std::shared_ptr<const LeakStage>> made;
  if (made.contains(quick)) return made[quick];
  auto found = scene::built_in("two_rooms");
  if (!found) return found.status();
  auto stage = std::make_shared<LeakStage>();
  stage->scene = std::move(found).value();
  auto rays = scene::Rays::make(stage->scene);
  if (!rays) return rays.status();
  stage->rays = rays.value();
  for (const bool dark : {true, false}) add_room(*stage, dark, quick ? 0.5 : 0.25);
  const scene::Scene& s = stage->scene;
  for (std::size_t i = 0; i < s.indices.size(); ++i) {
    const dvec3 a = s.positions[s.indices[i].x], e = s.material_of(i).emission;
    const double area = glm::length(glm::cross(s.positions[s.indices[i].y] - a, s.positions[s.indices[i].z] - a)) / 2;
    stage->injected += std::numbers::pi * area * (e.x + e.y + e.z) / 3;  // its back faces the ceiling's outside
  }
  std::vector<truth::Receiver> receivers(stage->count());
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const float* r = &stage->receivers[8 * i];
    receivers[i].position = {r[0], r[1], r[2]};
    receivers[i].normal = glm::normalize(dvec3(r[4], r[5], r[6]));
  }
  truth::PathSettings settings;
  settings.samples = quick ? 128 : 512;
  settings.bounces = 1;
  settings.glossy = false;
  const auto traced = truth::path_truth(*stage->rays, receivers, settings);
  if (!traced) return traced.status();
  stage->t1 = traced.value().indirect.t1;
  stage->t2 = traced.value().indirect.t2;
  made[quick] = stage;
  return made[quick];
}

Leak leak(const LeakStage& stage, std::span<const double> irradiance, int channels) {
  return measured(stage, irradiance, irradiance, channels);
}

Leak leak_of_truth(const LeakStage& stage) { return measured(stage, stage.t1, stage.t2, 3); }

}  // namespace luxel::report

#include "bench/truth/probe_scene.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <thread>

#include "bench/truth/path_lights.h"

namespace luxel::truth {
namespace {

using glm::dvec3;

void for_each(std::size_t n, const std::function<void(std::size_t)>& work) {
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < n; i += count) work(i);
    });
  for (std::thread& thread : threads) thread.join();
}

dvec3 anywhere(Random& random) {
  const double z = 2 * random.next() - 1, a = 2 * M_PI * random.next(), s = std::sqrt(1 - z * z);
  return {s * std::cos(a), s * std::sin(a), z};
}

bool shows_front(const scene::Scene& scene, const scene::Hit& hit, dvec3 d) {
  const glm::uvec3 t = scene.indices[hit.triangle];
  const dvec3 a = scene.positions[t.x];
  return glm::dot(glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a), d) < 0;
}

SceneRays random_rays(const scene::Rays& rays, std::size_t count, std::uint32_t seed, bool surface) {
  const scene::Scene& scene = rays.scene();
  const scene::Bounds box = scene::bounds(scene);
  SceneRays made;
  made.rays.assign(8 * count, 0);
  made.met.assign(count, scene::Rays::forever);
  for_each(count, [&](std::size_t i) {
    Random random(seed, i, 0);
    dvec3 from = scene.camera.eye, way = anywhere(random);
    for (int attempt = 0; attempt < 64; ++attempt) {
      const dvec3 place = box.low + (box.high - box.low) * dvec3(random.next(), random.next(), random.next());
      const dvec3 d = anywhere(random);
      const auto hit = rays.first(place, d);
      if (!hit || !shows_front(scene, *hit, d)) continue;
      from = surface ? hit->position + rays.offset() * hit->normal : place;
      way = surface ? cosine_direction(hit->normal, {random.next(), random.next()}) : anywhere(random);
      break;
    }
    double* r = &made.rays[8 * i];
    for (int k = 0; k < 3; ++k) r[k] = static_cast<float>(from[k]), r[4 + k] = static_cast<float>(way[k]);
    r[7] = static_cast<float>(1e30);
    const dvec3 d = glm::normalize(dvec3(r[4], r[5], r[6]));
    if (const auto hit = rays.first({r[0], r[1], r[2]}, d)) made.met[i] = hit->distance;
  });
  return made;
}

double quantile(std::vector<double>& v, double q) {
  if (v.empty()) return 0;
  const std::size_t at = std::min(v.size() - 1, static_cast<std::size_t>(q * static_cast<double>(v.size())));
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(at), v.end());
  return v[at];
}

}  // namespace

SceneRays surface_rays(const scene::Rays& rays, std::size_t count, std::uint32_t seed) {
  return random_rays(rays, count, seed, true);
}

SceneRays open_rays(const scene::Rays& rays, std::size_t count, std::uint32_t seed) {
  return random_rays(rays, count, seed, false);
}

ProbeAgreement agreement(const SceneRays& rays, std::span<const double> hits, std::span<const double> texels,
                         std::span<const double> distances, int size) {
  ProbeAgreement a;
  std::vector<double> errors, relative;
  const double n = static_cast<double>(rays.size());
  double known = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto outcome = static_cast<ProbeOutcome>(static_cast<int>(hits[4 * i + 1]));
    const bool assumed = outcome == ProbeOutcome::assumed, hit = outcome == ProbeOutcome::hit || assumed;
    a.unknown += assumed || outcome == ProbeOutcome::unknown;
    a.capped += outcome == ProbeOutcome::capped;
    a.probes += hits[4 * i + 2];
    a.steps += hits[4 * i + 3];
    const bool meets = std::isfinite(rays.met[i]);
    const bool is_known = outcome == ProbeOutcome::hit || outcome == ProbeOutcome::miss;
    known += is_known;
    if (!meets) {
      a.agree += outcome == ProbeOutcome::miss;
      a.right += outcome == ProbeOutcome::miss;
      a.known_right += outcome == ProbeOutcome::miss;
      continue;
    }
    if (!hit) continue;
    a.agree += 1;
    const auto texel = static_cast<std::size_t>(texels[i]);
    const int x = static_cast<int>(texel % static_cast<std::size_t>(size)),
              y = static_cast<int>(texel / static_cast<std::size_t>(size) % static_cast<std::size_t>(size));
    const dvec3 d = scene::texel_direction(x, y, size);
    const double q = 1 / (std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z));
    const double foot = distances[texel] * 2 / (size * std::pow(q, 1.5)), off = std::fabs(hits[4 * i] - rays.met[i]);
    if (!std::isfinite(foot)) continue;
    errors.push_back(off / foot);
    relative.push_back(off / rays.met[i]);
    const bool right = off <= std::max(2 * foot, 0.01 * rays.met[i]);
    a.right += right;
    a.known_right += right && is_known;
  }
  if (known > 0) a.known_right /= known;
  for (double* v : {&a.agree, &a.right, &a.unknown, &a.capped, &a.probes, &a.steps}) *v /= n;
  a.median = quantile(errors, 0.5);
  a.p95 = quantile(errors, 0.95);
  a.relative = quantile(relative, 0.5);
  return a;
}

}  // namespace luxel::truth

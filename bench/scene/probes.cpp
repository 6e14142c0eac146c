#include "bench/scene/probes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include "bench/scene/images.h"
#include "bench/truth/path_lights.h"

namespace luxel::scene {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;

dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// `work` for every index, by all cores; each index's result depends on it alone.
void for_each(std::size_t n, const std::function<void(std::size_t)>& work) {
  std::vector<std::thread> threads;
  std::atomic<std::size_t> next = 0;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&] {
      for (std::size_t i = next++; i < n; i = next++) work(i);
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace

std::vector<double> Probes::positions() const {
  std::vector<double> all;
  for (std::size_t i = 0; i < size(); ++i)
    for (const double v : {centres[i].x, centres[i].y, centres[i].z, static_cast<double>(alive[i])}) all.push_back(v);
  return all;
}

Probes place_probes(const Scene& scene, std::array<int, 3> count, double jitter, std::uint32_t seed) {
  Probes p;
  const Bounds box = bounds(scene);
  const dvec3 side = box.high - box.low;
  p.grid.count = count;
  for (int k = 0; k < 3; ++k) {
    const double most = std::max({side.x, side.y, side.z, 1e-12});
    // Floats, so that float and double kernels stand at the same places.
    p.grid.spacing[k] = static_cast<float>(std::max(side[k], 1e-6 * most) / count[k]);
    p.grid.origin[k] = static_cast<float>(box.low[k] + p.grid.spacing[k] / 2);
  }
  p.grid.placed = jitter > 0;
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x) {
        const std::array<int, 3> at{x, y, z};
        dvec3 c;
        for (int k = 0; k < 3; ++k) {
          const auto index = static_cast<std::uint32_t>(3 * p.centres.size() + static_cast<std::size_t>(k));
          c[k] = static_cast<float>(p.grid.origin[k] + at[k] * p.grid.spacing[k] +
                                    jitter * (random01(index, seed) - 0.5) * p.grid.spacing[k]);
        }
        p.centres.push_back(c);
      }
  p.alive.assign(p.centres.size(), 1);
  return p;
}

dvec3 texel_direction(int x, int y, int size) {
  const double u = (2.0 * x + 1 - size) / size, v = (2.0 * y + 1 - size) / size;
  const double z = 1 - std::fabs(u) - std::fabs(v);
  if (z >= 0) return glm::normalize(dvec3(u, v, z));
  return glm::normalize(dvec3(std::copysign(1 - std::fabs(v), u), std::copysign(1 - std::fabs(u), v), z));
}

glm::dvec2 octahedral_place(dvec3 d) {
  const double sum = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
  if (!(sum > 0)) return glm::dvec2(0);
  const double x = d.x / sum, y = d.y / sum;
  if (d.z >= 0) return {x, y};
  return {std::copysign(1 - std::fabs(y), x), std::copysign(1 - std::fabs(x), y)};
}

void find_dead_probes(Probes& probes, const Rays& rays, int rays_a_probe) {
  const Scene& scene = rays.scene();
  const int side = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(rays_a_probe))));
  for_each(probes.size(), [&](std::size_t i) {
    int seen = 0, backs = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const dvec3 d = texel_direction(x, y, side);
        const auto hit = rays.first(probes.centres[i], d);
        if (!hit) continue;
        ++seen;
        const glm::uvec3 t = scene.indices[hit->triangle];
        const dvec3 a = scene.positions[t.x];
        backs += glm::dot(glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a), d) > 0;
      }
    probes.alive[i] = 2 * backs > seen ? 0 : 1;
  });
  for (const std::uint8_t a : probes.alive) probes.grid.placed = probes.grid.placed || a == 0;
}

DirectLight::DirectLight(const Rays& rays, const ProbeLight& light)
    : rays_(rays), light_(light), lights_(voxel_lights_of(rays.scene(), light.lamp_pieces)) {}

dvec3 DirectLight::irradiance(dvec3 position, dvec3 normal) const {
  dvec3 sum(0);
  const dvec3 from = position + rays_.offset() * normal;
  for (const VoxelLight& l : lights_) {
    dvec3 to = vector_of(l.place);
    double share = 1, reach = Rays::forever;
    if (l.kind != VoxelLight::Kind::sun) {
      to -= position;
      const double squared = glm::dot(to, to);
      if (squared == 0) continue;
      reach = std::sqrt(squared) * (1 - 1e-3);
      to /= std::sqrt(squared);
      share = std::max(0.0, -glm::dot(to, glm::normalize(vector_of(l.normal)))) / (squared + l.area / pi);
    }
    share *= glm::dot(normal, to);
    if (share > 0 && !rays_.blocked(from, to, reach)) sum += share * vector_of(l.power);
  }
  for (int s = 0; s < light_.sky_samples; ++s) {
    // Points of the additive recurrence of the plastic number (Roberts 2018), the same for every point.
    const glm::dvec2 u(std::fmod(0.5 + s * 0.7548776662466927, 1.0), std::fmod(0.5 + s * 0.5698402909980532, 1.0));
    const dvec3 d = truth::cosine_direction(normal, u);
    if (!rays_.blocked(from, d)) sum += pi / light_.sky_samples * rays_.scene().sky.toward(d);
  }
  return sum;
}

dvec3 DirectLight::radiance(const std::optional<Hit>& hit, dvec3 direction) const {
  if (!hit) return light_.sky ? rays_.scene().sky.toward(glm::normalize(direction)) : dvec3(0);
  dvec3 sum(0);
  if (light_.emitted) sum += rays_.scene().material_of(hit->triangle).emission;
  if (light_.reflected)
    sum += rays_.scene().surface(hit->triangle, hit->b1, hit->b2).albedo / pi * irradiance(hit->position, hit->normal);
  return sum;
}

ProbeHits cast_probes(const Probes& probes, const Rays& rays, int size, const ProbeLight* light, int samples) {
  ProbeHits h;
  h.size = size;
  const std::size_t each = static_cast<std::size_t>(size) * static_cast<std::size_t>(size), n = probes.size() * each;
  h.distance.assign(n, Rays::forever);
  h.normal.assign(4 * n, 0);
  std::optional<DirectLight> direct;
  if (light != nullptr) {
    h.radiance.assign(4 * n, 0);
    direct.emplace(rays, *light);
  }
  for_each(probes.size() * static_cast<std::size_t>(size), [&](std::size_t row) {
    const std::size_t probe = row / static_cast<std::size_t>(size);
    const int y = static_cast<int>(row % static_cast<std::size_t>(size));
    const dvec3 from = probes.centres[probe];
    for (int x = 0; x < size; ++x) {
      const std::size_t i = row * static_cast<std::size_t>(size) + static_cast<std::size_t>(x);
      const dvec3 d = texel_direction(x, y, size);
      const auto hit = rays.first(from, d);
      if (hit) {
        h.distance[i] = hit->distance;
        for (int k = 0; k < 3; ++k) h.normal[4 * i + static_cast<std::size_t>(k)] = hit->normal[k];
      }
      if (!direct) continue;
      dvec3 sum(0);
      for (int s = 0; s < samples * samples; ++s) {
        const dvec3 to = texel_direction(x * samples + s % samples, y * samples + s / samples, size * samples);
        sum += samples == 1 ? direct->radiance(hit, d) : direct->radiance(rays.first(from, to), to);
      }
      for (int k = 0; k < 3; ++k) h.radiance[4 * i + static_cast<std::size_t>(k)] = sum[k] / (samples * samples);
    }
  });
  return h;
}

}  // namespace luxel::scene

#include "bench/scene/rsm.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <thread>

#include "bench/truth/path_lights.h"

namespace luxel::scene {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;

// What each of n indices sees, in order, by all cores.
void cast(std::size_t n, std::vector<VirtualLight>& lights,
          const std::function<std::optional<VirtualLight>(std::size_t)>& texel) {
  std::vector<std::optional<VirtualLight>> seen(n);
  std::vector<std::thread> threads;
  std::atomic<std::size_t> next = 0;
  constexpr std::size_t chunk = 256;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&] {
      for (std::size_t first = chunk * next++; first < n; first = chunk * next++)
        for (std::size_t i = first; i < std::min(n, first + chunk); ++i) seen[i] = texel(i);
    });
  for (std::thread& thread : threads) thread.join();
  for (const auto& s : seen)
    if (s) lights.push_back(*s);
}

// A map of parallel rays that come from `to`, over the scene's bounds.
void parallel(const Rays& rays, const Bounds& box, dvec3 to, dvec3 irradiance, int texels, std::vector<VirtualLight>& lights) {
  const dvec3 axis = std::fabs(to.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
  const dvec3 right = glm::normalize(glm::cross(axis, to)), up = glm::cross(to, right);
  dvec3 low(1e300), high(-1e300);
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                  corner & 4 ? box.high.z : box.low.z);
    const dvec3 q(glm::dot(p, right), glm::dot(p, up), glm::dot(p, to));
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  const dvec3 size = high - low;
  const double texel = std::max(size.x, size.y) / texels;
  if (!(texel > 0)) return;
  const std::size_t width = static_cast<std::size_t>(std::max(1.0, std::ceil(size.x / texel - 1e-9))),
                    height = static_cast<std::size_t>(std::max(1.0, std::ceil(size.y / texel - 1e-9)));
  const double du = size.x / static_cast<double>(width), dv = size.y / static_cast<double>(height);
  const double start = high.z + 1e-3 * glm::length(size);
  cast(width * height, lights, [&](std::size_t i) -> std::optional<VirtualLight> {
    const double u = low.x + (static_cast<double>(i % width) + 0.5) * du, v = low.y + (static_cast<double>(i / width) + 0.5) * dv;
    const auto hit = rays.first(u * right + v * up + start * to, -to);
    if (!hit) return {};
    const Surface s = rays.scene().surface(hit->triangle, hit->b1, hit->b2);
    const double cosine = std::max(glm::dot(hit->normal, to), 1e-3);
    return VirtualLight{hit->position, hit->normal, s.albedo * irradiance * (du * dv), du * dv / cosine};
  });
}

// Points of the additive recurrence of a generalised golden ratio in four dimensions (Roberts 2018).
double recurrence(std::size_t i, int dimension) {
  constexpr double step[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101};
  const double v = 0.5 + static_cast<double>(i + 1) * step[dimension];
  return v - std::floor(v);
}

void lamps(const Rays& rays, int count, std::vector<VirtualLight>& lights) {
  const Scene& scene = rays.scene();
  struct Emitter {
    std::size_t triangle;
    double area, weight;
  };
  std::vector<Emitter> emitters;
  double total = 0;
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    const dvec3 e = scene.material_of(i).emission;
    if (e == dvec3(0) || !finite(scene, i)) continue;
    const dvec3 a = scene.positions[scene.indices[i].x], b = scene.positions[scene.indices[i].y],
                c = scene.positions[scene.indices[i].z];
    const double area = glm::length(glm::cross(b - a, c - a)) / 2;
    if (!(area > 0)) continue;
    emitters.push_back({i, area, area * (e.x + e.y + e.z)});
    total += emitters.back().weight;
  }
  std::size_t first = 0;
  for (const Emitter& lamp : emitters) {
    const glm::uvec3 t = scene.indices[lamp.triangle];
    const dvec3 a = scene.positions[t.x], b = scene.positions[t.y], c = scene.positions[t.z];
    const dvec3 front = glm::normalize(glm::cross(b - a, c - a)), radiance = scene.material_of(lamp.triangle).emission;
    // As many of each side; weak lamps have two rays at least.
    const std::size_t n = 2 * static_cast<std::size_t>(std::max(1.0, std::round(count / 2.0 * lamp.weight / total)));
    cast(n, lights, [&](std::size_t k) -> std::optional<VirtualLight> {
      const std::size_t i = first + k / 2;
      const double root = std::sqrt(recurrence(i, 0)), along = recurrence(i, 1);
      const dvec3 p = (1 - root) * a + root * (1 - along) * b + root * along * c;
      const dvec3 n_side = k % 2 == 0 ? front : -front;
      const dvec3 d = truth::cosine_direction(n_side, {recurrence(i, 2), recurrence(i, 3)});
      const auto hit = rays.first(p + rays.offset() * n_side, d);
      if (!hit) return {};
      const Surface s = scene.surface(hit->triangle, hit->b1, hit->b2);
      const double cosine = std::max(-glm::dot(hit->normal, d), 1e-3), away = std::max(glm::dot(n_side, d), 1e-3);
      const double share = 2 * lamp.area / static_cast<double>(n);  // of the lamp's two sides
      // All lamps of a side together, seen from far away, send rays of density count / 2 cos / pi.
      const double area = hit->distance * hit->distance * pi / (std::max(1.0, count / 2.0) * away * cosine);
      return VirtualLight{hit->position, hit->normal, s.albedo * radiance * (pi * share), area};
    });
    first += n / 2;
  }
}

void add_pieces(dvec3 a, dvec3 b, dvec3 c, double area, std::vector<VirtualLight>& pieces) {
  const dvec3 across = glm::cross(b - a, c - a);
  const double mine = glm::length(across) / 2;
  if (!(mine > 0)) return;
  if (mine > area) {
    const dvec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    add_pieces(a, ab, ca, area, pieces);
    add_pieces(ab, b, bc, area, pieces);
    add_pieces(ca, bc, c, area, pieces);
    add_pieces(ab, bc, ca, area, pieces);
    return;
  }
  pieces.push_back({(a + b + c) / 3.0, across / (2 * mine), dvec3(0), mine});
}

void append(std::vector<float>& list, dvec3 v, double w) {
  for (const double c : {v.x, v.y, v.z, w}) list.push_back(static_cast<float>(c));
}

}  // namespace

std::vector<VirtualLight> reflective_shadow_maps(const Rays& rays, const RsmSettings& settings) {
  const Scene& scene = rays.scene();
  std::vector<VirtualLight> lights;
  const Bounds box = bounds(scene);
  if (scene.sun.irradiance != dvec3(0)) parallel(rays, box, scene.sun.direction, scene.sun.irradiance, settings.sun_texels, lights);
  if (!scene.sky.dark())
    for (int i = 0; i < settings.sky_directions; ++i) {
      // Points of equal area on a spiral (Vogel 1979), each for its share of the sphere.
      const double z = 1 - (2 * i + 1.0) / settings.sky_directions, r = std::sqrt(1 - z * z),
                   angle = pi * (3 - std::sqrt(5.0)) * i;
      const dvec3 to(r * std::cos(angle), z, r * std::sin(angle));
      const dvec3 radiance = scene.sky.toward(to);
      if (radiance != dvec3(0))
        parallel(rays, box, to, radiance * (4 * pi / settings.sky_directions), settings.sky_texels, lights);
    }
  lamps(rays, settings.lamp_rays, lights);
  return lights;
}

std::vector<VirtualLight> surface_pieces(const Scene& scene, double area) {
  std::vector<VirtualLight> pieces;
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    if (!finite(scene, i)) continue;
    const glm::uvec3 t = scene.indices[i];
    add_pieces(scene.positions[t.x], scene.positions[t.y], scene.positions[t.z], area, pieces);
  }
  return pieces;
}

std::vector<float> lights_list(const std::vector<VirtualLight>& lights, dvec3 origin) {
  std::vector<float> list;
  list.reserve(lights.size() * 12);
  for (const VirtualLight& l : lights) {
    append(list, l.position - origin, 0);
    append(list, l.normal, 0);
    append(list, l.flux, 0);
  }
  return list;
}

std::vector<float> surfels_list(const std::vector<VirtualLight>& lights, dvec3 origin) {
  std::vector<float> list;
  list.reserve(lights.size() * 8);
  for (const VirtualLight& l : lights) {
    append(list, l.position - origin, l.area);
    append(list, l.normal, 0);
  }
  return list;
}

}  // namespace luxel::scene

#include "bench/truth/ssr_scene.h"

#include <cmath>
#include <thread>

namespace luxel::truth {
namespace {

Mirrored mirror_of(const scene::Rays& rays, const scene::GBuffer& g, const scene::View& view, std::size_t i, double tolerance) {
  Mirrored m;
  if (!g.surface_at(i) || g.at(g.specular, i) == glm::dvec3(0)) return m;
  const glm::dvec3 p = g.at(g.position, i), n = g.at(g.normal, i), sight = glm::normalize(p - view.eye);
  const auto hit = rays.first(p + rays.offset() * n, glm::reflect(sight, n));
  if (!hit) {
    m.seen = Seen::sky;
    return m;
  }
  m.distance = hit->distance;
  const glm::dvec3 to = hit->position - view.eye;
  const double depth = -glm::dot(to, view.back);
  m.seen = Seen::off_screen;
  if (!(depth > 0)) return m;
  const double pixels = g.height / (2 * view.tangent);
  m.x = g.width / 2.0 + pixels * glm::dot(to, view.right) / depth;
  m.y = g.height / 2.0 - pixels * glm::dot(to, view.up) / depth;
  if (!(m.x >= 0 && m.y >= 0 && m.x < g.width && m.y < g.height)) return m;
  const std::size_t at = static_cast<std::size_t>(m.y) * static_cast<std::size_t>(g.width) + static_cast<std::size_t>(m.x);
  m.seen = Seen::hidden;
  if (!g.surface_at(at)) return m;
  // The surface of that pixel, as a plane, below the very point.
  const glm::dvec3 facing = g.at(g.normal, at);
  const double above = std::fabs(glm::dot(facing, hit->position - g.at(g.position, at)));
  const bool same_side = glm::dot(facing, hit->normal) > 0;
  if (same_side && above <= tolerance * depth) m.seen = Seen::on_screen;
  return m;
}

}  // namespace

std::vector<Mirrored> mirrored(const scene::Rays& rays, const scene::GBuffer& g, const scene::Camera& camera, double tolerance) {
  std::vector<Mirrored> all(g.pixels());
  const scene::View view = scene::view_of(camera);
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < g.pixels(); i += count) all[i] = mirror_of(rays, g, view, i, tolerance);
    });
  for (std::thread& thread : threads) thread.join();
  return all;
}

}  // namespace luxel::truth

#include "bench/scene/gbuffer.h"

#include <cmath>
#include <numbers>

namespace luxel::scene {
namespace {

void put(std::vector<float>& values, std::size_t pixel, glm::dvec3 v) {
  for (int c = 0; c < 3; ++c) values[3 * pixel + static_cast<std::size_t>(c)] = static_cast<float>(v[c]);
}

}  // namespace

glm::dvec3 View::direction(double x, double y, int width, int height) const {
  const double sx = (2 * x / width - 1) * tangent * width / height, sy = (1 - 2 * y / height) * tangent;
  return sx * right + sy * up - back;
}

View view_of(const Camera& camera) {
  const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
  const glm::dvec3 vertical =
      std::abs(back.y) < 1 - 1e-12 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, back.y > 0 ? -1 : 1);
  const glm::dvec3 right = glm::normalize(glm::cross(vertical, back));
  return {camera.eye, right, glm::cross(back, right), back, std::tan(camera.fov * std::numbers::pi / 360)};
}

GBuffer gbuffer(const Rays& rays, const Camera& camera, int width, int height) {
  GBuffer g;
  g.width = width, g.height = height;
  const std::size_t n = g.pixels();
  for (auto* three : {&g.position, &g.normal, &g.albedo, &g.specular, &g.emission}) three->assign(3 * n, 0.0f);
  g.depth.assign(n, std::numeric_limits<float>::infinity());
  g.roughness.assign(n, 1.0f);
  g.triangle.assign(n, GBuffer::no_triangle);
  const Scene& scene = rays.scene();
  const View view = view_of(camera);
  for (std::size_t i = 0; i < n; ++i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(width)),
              y = static_cast<int>(i / static_cast<std::size_t>(width));
    const glm::dvec3 direction = view.direction(x + 0.5, y + 0.5, width, height);
    const auto hit = rays.first(view.eye, direction);
    if (!hit) {
      put(g.emission, i, scene.sky.toward(glm::normalize(direction)));
      continue;
    }
    const Material& material = scene.material_of(hit->triangle);
    const Surface surface = scene.surface(hit->triangle, hit->b1, hit->b2);
    put(g.position, i, hit->position);
    put(g.normal, i, hit->normal);
    put(g.albedo, i, surface.albedo);
    put(g.specular, i, surface.specular);
    put(g.emission, i, material.emission);
    g.depth[i] = static_cast<float>(hit->distance);
    g.roughness[i] = static_cast<float>(material.roughness);
    g.triangle[i] = static_cast<std::uint32_t>(hit->triangle);
  }
  return g;
}

}  // namespace luxel::scene

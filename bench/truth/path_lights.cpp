#include "bench/truth/path_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxel::truth {
namespace {

constexpr double pi = std::numbers::pi;

double luminance(glm::dvec3 c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

glm::dvec3 doubled_area(const scene::Scene& scene, std::size_t triangle) {
  const glm::uvec3 t = scene.indices[triangle];
  const glm::dvec3 a = scene.positions[t.x];
  return glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a);
}

}  // namespace

glm::dvec3 about(glm::dvec3 n, glm::dvec3 local) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  const glm::dvec3 t(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), s(b, sign + n.y * n.y * a, -n.y);
  return local.x * t + local.y * s + local.z * n;
}

glm::dvec3 cosine_direction(glm::dvec3 normal, glm::dvec2 u) {
  const double r = std::sqrt(u.x), p = 2 * pi * u.y;
  return about(normal, {r * std::cos(p), r * std::sin(p), std::sqrt(1 - u.x)});
}

glm::dvec2 stratified(int s, int n, Random& random) {
  const glm::dvec2 u(random.next(), random.next());
  const int columns = static_cast<int>(std::sqrt(static_cast<double>(n))), rows = n / columns;
  if (s >= columns * rows) return u;
  return {(s % columns + u.x) / columns, (s / columns + u.y) / rows};
}

Distribution::Distribution(const std::vector<double>& weights) {
  double sum = 0;
  for (const double w : weights) sums_.push_back(sum += w);
}

std::size_t Distribution::draw(double u) const {
  const auto found = std::upper_bound(sums_.begin(), sums_.end(), u * total());
  return std::min(static_cast<std::size_t>(found - sums_.begin()), sums_.size() - 1);
}

Lights::Lights(const scene::Scene& scene) : scene_(scene) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    const double l = luminance(scene.material_of(i).emission);
    if (!(l > 0) || !finite(scene, i)) continue;
    emitting_.push_back(static_cast<std::uint32_t>(i));
    weights.push_back(l * glm::length(doubled_area(scene, i)) / 2);
  }
  emitters_ = Distribution(weights);
  const scene::Sky& sky = scene.sky;
  if (sky.image.empty() || sky.dark()) return;
  std::vector<double> texels;
  for (int y = 0; y < sky.height; ++y) {
    const double band = std::cos(pi * y / sky.height) - std::cos(pi * (y + 1) / sky.height);
    for (int x = 0; x < sky.width; ++x) {
      const float* c = &sky.image[3 * (static_cast<std::size_t>(y) * sky.width + x)];
      texels.push_back(luminance(sky.radiance * glm::dvec3(c[0], c[1], c[2])) * band * 2 * pi / sky.width);
    }
  }
  sky_ = Distribution(texels);
}

std::optional<LightSample> Lights::emitter(glm::dvec3 from, Random& random) const {
  const std::size_t triangle = emitting_[emitters_.draw(random.next())];
  const glm::uvec3 t = scene_.indices[triangle];
  const double r = std::sqrt(random.next()), b1 = r * random.next(), b2 = 1 - r;
  LightSample s;
  s.point = scene_.positions[t.x] * (1 - b1 - b2) + scene_.positions[t.y] * b1 + scene_.positions[t.z] * b2;
  const glm::dvec3 way = s.point - from;
  const double distance = glm::length(way);
  s.direction = way / distance;
  s.density = emitter_density(triangle, distance, s.direction);
  if (!(s.density > 0) || !std::isfinite(s.density) || scene_.surface(triangle, b1, b2).alpha < 0.5)
    return std::nullopt;
  s.normal = glm::normalize(doubled_area(scene_, triangle));
  if (glm::dot(s.normal, s.direction) > 0) s.normal = -s.normal;
  s.radiance = scene_.material_of(triangle).emission;
  return s;
}

double Lights::emitter_density(std::size_t triangle, double distance, glm::dvec3 direction) const {
  const double l = luminance(scene_.material_of(triangle).emission);
  if (!(l > 0) || !has_emitters()) return 0;
  const double cosine = std::abs(glm::dot(glm::normalize(doubled_area(scene_, triangle)), direction));
  return l / emitters_.total() * distance * distance / cosine;
}

LightSample Lights::sky(Random& random) const {
  const scene::Sky& sky = scene_.sky;
  const std::size_t texel = sky_.draw(random.next());
  const std::size_t x = texel % static_cast<std::size_t>(sky.width), y = texel / static_cast<std::size_t>(sky.width);
  const double top = std::cos(pi * static_cast<double>(y) / sky.height),
               bottom = std::cos(pi * static_cast<double>(y + 1) / sky.height);
  const double c = top + (bottom - top) * random.next(), s = std::sqrt(std::max(0.0, 1 - c * c));
  const double p = (static_cast<double>(x) + random.next()) / sky.width * 2 * pi - pi;
  LightSample sample;
  sample.direction = {s * std::cos(p), c, s * std::sin(p)};
  sample.radiance = sky.toward(sample.direction);
  sample.density = sky_density(sample.direction);
  return sample;
}

double Lights::sky_density(glm::dvec3 direction) const {
  return luminance(scene_.sky.toward(direction)) / sky_.total();
}

}  // namespace luxel::truth

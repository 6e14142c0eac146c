#include "bench/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace luxel::scene {
namespace {

// IEC 61966-2-1.
double from_srgb(std::uint8_t code) {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> t{};
    for (int i = 0; i < 256; ++i) {
      const double v = i / 255.0;
      t[static_cast<std::size_t>(i)] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    return t;
  }();
  return table[code];
}

int wrapped(double i, int n) {
  const double r = i - std::floor(i / n) * n;
  return std::clamp(static_cast<int>(r), 0, n - 1);
}

bool finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

glm::dvec4 Texture::texel(int x, int y) const {
  const std::size_t at = 4 * (static_cast<std::size_t>(wrapped(y, height)) * width + wrapped(x, width));
  const std::uint8_t* p = &rgba[at];
  if (srgb) return {from_srgb(p[0]), from_srgb(p[1]), from_srgb(p[2]), p[3] / 255.0};
  return glm::dvec4(p[0], p[1], p[2], p[3]) / 255.0;
}

glm::dvec4 Texture::sample(glm::dvec2 uv) const {
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return texel(0, 0);
  // The whole part goes first, so that far repetitions keep their fraction.
  const double x = (uv.x - std::floor(uv.x)) * width - 0.5, y = (uv.y - std::floor(uv.y)) * height - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  return (texel(i, j) * (1 - fx) + texel(i + 1, j) * fx) * (1 - fy) +
         (texel(i, j + 1) * (1 - fx) + texel(i + 1, j + 1) * fx) * fy;
}

glm::dvec3 Sky::toward(glm::dvec3 d) const {
  if (image.empty()) return radiance;
  const double t = std::acos(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi;
  const double p = std::atan2(d.z, d.x) / (2 * std::numbers::pi) + 0.5;
  const int row = std::clamp(static_cast<int>(t * height), 0, height - 1);
  const int column = std::clamp(static_cast<int>(p * width), 0, width - 1);
  const float* c = &image[3 * (static_cast<std::size_t>(row) * width + column)];
  return radiance * glm::dvec3(c[0], c[1], c[2]);
}

bool Scene::emissive() const {
  return std::any_of(triangle_materials.begin(), triangle_materials.end(),
                     [&](std::uint32_t m) { return materials[m].emission != glm::dvec3(0); });
}

Surface Scene::surface(std::size_t triangle, double b1, double b2) const {
  const Material& m = material_of(triangle);
  Surface s{m.base_color, m.alpha};
  if (m.texture >= 0 && !uvs.empty()) {
    const glm::uvec3 v = indices[triangle];
    const glm::dvec4 t =
        textures[static_cast<std::size_t>(m.texture)].sample(uvs[v.x] * (1 - b1 - b2) + uvs[v.y] * b1 + uvs[v.z] * b2);
    s.base_color *= glm::dvec3(t);
    s.alpha *= t.a;
  }
  if (m.alpha_mode == AlphaMode::opaque) s.alpha = 1;
  if (m.alpha_mode == AlphaMode::mask) s.alpha = s.alpha >= m.alpha_cutoff ? 1 : 0;
  s.albedo = s.base_color * (1 - m.metallic);
  s.specular = glm::mix(glm::dvec3(m.specular), s.base_color, m.metallic);
  return s;
}

bool finite(const Scene& scene, std::size_t triangle) {
  const glm::uvec3 v = scene.indices[triangle];
  return finite(scene.positions[v.x]) && finite(scene.positions[v.y]) && finite(scene.positions[v.z]);
}

Bounds bounds(const Scene& scene) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Bounds b{glm::dvec3(far), glm::dvec3(-far)};
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    if (!finite(scene, i)) continue;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p = scene.positions[scene.indices[i][k]];
      b.low = glm::min(b.low, p);
      b.high = glm::max(b.high, p);
    }
  }
  return b.low.x <= b.high.x ? b : Bounds{};
}

}  // namespace luxel::scene

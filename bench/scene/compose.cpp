#include "bench/scene/compose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxel::scene {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double smoothest = 1e-3;  // alpha of what is called a mirror: its highlight stays a number

double alpha_of(double roughness) { return std::max(roughness * roughness, smoothest); }

// Lambda of Smith's masking for GGX (Heitz 2014, equation 72).
double lambda(double cosine, double alpha) {
  const double c2 = cosine * cosine;
  return (std::sqrt(1 + alpha * alpha * (1 - c2) / c2) - 1) / 2;
}

double schlick(double cosine) { return std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5.0); }

// A and B for one roughness and view cosine: the mean of (1 - S) G2/G1 and of S G2/G1 over visible normals, S Schlick's
// weight; midpoints of a grid over the visible disc (Heitz 2018, section 3.2), dense at its rim, where the lobe's tail is.
glm::dvec2 integrate(double alpha, double cosine) {
  constexpr int radii = 24, angles = 48;
  const glm::dvec3 view(std::sqrt(1 - cosine * cosine), 0, cosine);
  const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * view.x, 0, view.z));
  const glm::dvec3 t1(0, 1, 0), t2 = glm::cross(stretched, t1);
  const double w = 0.5 * (1 + stretched.z);
  glm::dvec2 sum(0);
  for (int i = 0; i < radii; ++i)
    for (int j = 0; j < angles; ++j) {
      const double q = 1 - (i + 0.5) / radii, r = std::sqrt(1 - q * q), p = 2 * pi * (j + 0.5) / angles;
      const double a = r * std::cos(p), b = (1 - w) * std::sqrt(1 - a * a) + w * r * std::sin(p);
      const glm::dvec3 n = a * t1 + b * t2 + std::sqrt(std::max(0.0, 1 - a * a - b * b)) * stretched;
      const glm::dvec3 half = glm::normalize(glm::dvec3(alpha * n.x, alpha * n.y, std::max(0.0, n.z)));
      const double along = glm::dot(view, half), out = 2 * along * half.z - view.z;
      if (!(out > 0)) continue;
      const double shown = (1 + lambda(cosine, alpha)) / (1 + lambda(cosine, alpha) + lambda(out, alpha));
      sum += glm::dvec2(1 - schlick(along), schlick(along)) * (shown * 2 * q);
    }
  return sum / static_cast<double>(radii * angles);
}

constexpr int side = 32;

}  // namespace

glm::dvec3 directional_albedo(glm::dvec3 specular, double roughness, double cosine) {
  if (specular == glm::dvec3(0)) return glm::dvec3(0);
  static const std::vector<glm::dvec2> table = [] {
    std::vector<glm::dvec2> t;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        t.push_back(integrate(alpha_of(y / (side - 1.0)), std::max(x / (side - 1.0), 1e-3)));
    return t;
  }();
  const double x = std::clamp(cosine, 0.0, 1.0) * (side - 1), y = std::clamp(roughness, 0.0, 1.0) * (side - 1);
  const int i = std::min(static_cast<int>(x), side - 2), j = std::min(static_cast<int>(y), side - 2);
  const auto at = [&](int dx, int dy) { return table[static_cast<std::size_t>((j + dy) * side + i + dx)]; };
  const glm::dvec2 ab = glm::mix(glm::mix(at(0, 0), at(1, 0), x - i), glm::mix(at(0, 1), at(1, 1), x - i), y - j);
  return specular * ab.x + ab.y;
}

glm::dvec3 ggx_reflection(glm::dvec3 specular, double roughness, glm::dvec3 normal, glm::dvec3 view, glm::dvec3 light) {
  const double nv = glm::dot(normal, view), nl = glm::dot(normal, light);
  if (specular == glm::dvec3(0) || !(nv > 0) || !(nl > 0)) return glm::dvec3(0);
  const double alpha = alpha_of(roughness), a2 = alpha * alpha;
  const glm::dvec3 half = glm::normalize(view + light);
  const double nh = glm::dot(normal, half), d = nh * nh * (a2 - 1) + 1, distribution = a2 / (pi * d * d);
  const double s = schlick(glm::dot(view, half)), masking = 1 / (1 + lambda(nv, alpha) + lambda(nl, alpha));
  return (specular * (1 - s) + s) * (distribution * masking / (4 * nv * nl));
}

Parts compose(const GBuffer& g, const Lighting& light, glm::dvec3 eye, const Sun& sun) {
  const std::size_t n = g.pixels();
  Parts p;
  for (auto* part : {&p.emission, &p.direct, &p.diffuse_indirect, &p.specular_indirect}) part->assign(n, glm::dvec3(0));
  p.ambient_occlusion.assign(n, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    p.emission[i] = g.at(g.emission, i);
    if (!g.surface_at(i)) continue;
    const glm::dvec3 normal = g.at(g.normal, i), view = glm::normalize(eye - g.at(g.position, i)),
                     specular = g.at(g.specular, i);
    const glm::dvec3 mirrored = directional_albedo(specular, g.roughness[i], glm::dot(normal, view));
    const glm::dvec3 diffuse = (1.0 - mirrored) * g.at(g.albedo, i) / pi;
    p.direct[i] = diffuse * (light.sun[i] + light.direct[i]) +
                  ggx_reflection(specular, g.roughness[i], normal, view, sun.direction) * light.sun[i];
    p.diffuse_indirect[i] = diffuse * light.indirect[i];
    p.specular_indirect[i] = mirrored * light.glossy[i];
    p.ambient_occlusion[i] = light.visibility[i];
  }
  return p;
}

std::vector<glm::dvec3> picture(const Parts& parts) {
  std::vector<glm::dvec3> sum = parts.emission;
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] += parts.direct[i] + parts.diffuse_indirect[i] + parts.specular_indirect[i];
  return sum;
}

glm::dvec3 display(glm::dvec3 radiance, double exposure) {
  glm::dvec3 out;
  for (int c = 0; c < 3; ++c) {
    const double v = std::clamp(radiance[c] * std::exp2(exposure), 0.0, 1.0);
    out[c] = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  }
  return out;
}

}  // namespace luxel::scene

// Triangles of the generated scenes: patches of a surface given by two parameters.
#pragma once
#include <algorithm>
#include <cmath>

#include "bench/scene/scene.h"

namespace luxel::scene {

class MeshBuilder {
 public:
  /// `counting`: triangles are counted and not made.
  explicit MeshBuilder(bool counting = false) : counting_(counting) {}

  Scene scene;

  std::uint32_t material(Material m) {
    scene.materials.push_back(std::move(m));
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
  }

  std::size_t triangles() const { return count_; }

  /// nu by nv quadrilaterals, two triangles each, of point(u, v) with u and v in 0..1; the front is du x dv.
  /// Texture coordinates are (u, v) * uv_scale.
  template <class Point>
  void patch(int nu, int nv, std::uint32_t material, const Point& point, glm::dvec2 uv_scale = glm::dvec2(1)) {
    nu = std::max(nu, 1), nv = std::max(nv, 1);
    count_ += 2 * static_cast<std::size_t>(nu) * nv;
    if (counting_) return;
    const auto first = static_cast<std::uint32_t>(scene.positions.size());
    for (int j = 0; j <= nv; ++j)
      for (int i = 0; i <= nu; ++i) {
        const double u = static_cast<double>(i) / nu, v = static_cast<double>(j) / nv;
        scene.positions.push_back(point(u, v));
        scene.uvs.push_back(glm::dvec2(u, v) * uv_scale);
      }
    const auto row = static_cast<std::uint32_t>(nu + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(nv); ++j)
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(nu); ++i) {
        const std::uint32_t a = first + j * row + i;
        scene.indices.push_back({a, a + 1, a + row + 1});
        scene.indices.push_back({a, a + row + 1, a + row});
        scene.triangle_materials.insert(scene.triangle_materials.end(), 2, material);
      }
  }

  /// The parallelogram at `corner` with sides `du` and `dv`.
  void quad(glm::dvec3 corner, glm::dvec3 du, glm::dvec3 dv, std::uint32_t material, int nu = 1, int nv = 1,
            glm::dvec2 uv_scale = glm::dvec2(1)) {
    patch(nu, nv, material, [=](double u, double v) { return corner + u * du + v * dv; }, uv_scale);
  }

  /// The block from `low` to `high`, front outside, turned by `angle` (radians) about the vertical through its middle;
  /// quadrilaterals of about `step`.
  void block(glm::dvec3 low, glm::dvec3 high, std::uint32_t material, double angle = 0, double step = 1e9) {
    const glm::dvec3 middle = (low + high) * 0.5, size = high - low;
    const double c = std::cos(angle), s = std::sin(angle);
    const auto turned = [=](glm::dvec3 p) {
      const glm::dvec3 d = p - middle;
      return middle + glm::dvec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
    };
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const int a = (axis + 1 + (side == 0 ? 1 : 0)) % 3, b = (axis + 1 + side) % 3;
        patch(static_cast<int>(std::lround(size[a] / step)), static_cast<int>(std::lround(size[b] / step)), material,
              [&](double u, double v) {
                glm::dvec3 p = low;
                p[axis] = side == 0 ? low[axis] : high[axis];
                p[a] = low[a] + u * size[a];
                p[b] = low[b] + v * size[b];
                return turned(p);
              });
      }
  }

 private:
  bool counting_;
  std::size_t count_ = 0;
};

/// The scene atrium with at most `triangles`.
Scene atrium(int triangles);

}  // namespace luxel::scene

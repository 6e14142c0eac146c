// What a camera sees of a scene at pixel centres, by casting rays.
#pragma once
#include <cstdint>
#include <vector>

#include "bench/scene/rays.h"

namespace luxel::scene {

/// A camera's axes: unit, right-handed; it looks along -back, `up` is image-up.
struct View {
  glm::dvec3 eye, right, up, back;
  double tangent;  // of half the vertical field

  /// Direction through (x, y) in pixels, x to the right from the left edge, y down from the top edge; its length is
  /// such that a step of 1 is a depth of 1.
  glm::dvec3 direction(double x, double y, int width, int height) const;
};

/// y is up in the image; looking straight up or down, -z or +z is.
View view_of(const Camera& camera);

/// Row 0 on top, three values a pixel where not said otherwise, as floats: what a kernel is given, and what truth
/// starts from.
struct GBuffer {
  int width = 0, height = 0;
  std::vector<float> position;          // world; 0 where there is no surface
  std::vector<float> normal;            // world, geometric, unit, on the camera's side of the surface; else 0
  std::vector<float> depth;             // 1 a pixel: distance along the view axis; infinity where there is no surface
  std::vector<float> albedo;            // diffuse reflectance: base colour times 1 - metallic
  std::vector<float> specular;          // reflectance at normal incidence; 0 where a surface is diffuse alone
  std::vector<float> roughness;         // 1 a pixel: perceptual; 1 where there is no surface
  std::vector<float> emission;          // radiance of the surface itself, or of the sky where there is none
  std::vector<std::uint32_t> triangle;  // 1 a pixel; no_triangle where there is none

  static constexpr std::uint32_t no_triangle = 0xffffffffu;
  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  bool surface_at(std::size_t pixel) const { return triangle[pixel] != no_triangle; }
  glm::dvec3 at(const std::vector<float>& values, std::size_t pixel) const {
    return {values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]};
  }
};

/// width and height 1..16384 (larger is a defect of the caller). The camera's fov is the vertical one.
GBuffer gbuffer(const Rays& rays, const Camera& camera, int width, int height);

}  // namespace luxel::scene

// Rays through a scene, by Embree.
#pragma once
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

#include "bench/scene/scene.h"

namespace luxel::scene {

struct Hit {
  std::size_t triangle = 0;
  double b1 = 0, b2 = 0;        // barycentric weights of the second and third vertex
  double distance = 0;          // in lengths of the direction
  glm::dvec3 position{0};       // on the triangle, to the rounding of double
  glm::dvec3 normal{0};         // geometric, unit, on the side that the ray came from
};

/// Threads may share one. Triangles with a vertex that is no finite number, or without area, are not there; where a
/// surface's alpha is below 1/2, neither is the surface. Embree computes in float about the scene's middle; what is
/// returned is computed again in double.
class Rays {
 public:
  static constexpr double forever = std::numeric_limits<double>::infinity();

  /// Keeps a pointer to `scene`. Errors: out_of_memory, internal.
  static Result<Rays> make(const Scene& scene);

  const Scene& scene() const;

  /// How far off a surface a ray must start so as not to meet it again: 2^-18 of the largest coordinate.
  double offset() const;

  /// The nearest surface along the ray, closer than `reach`.
  std::optional<Hit> first(glm::dvec3 origin, glm::dvec3 direction, double reach = forever) const;

  /// Whether any surface is closer than `reach`.
  bool blocked(glm::dvec3 origin, glm::dvec3 direction, double reach = forever) const;

 private:
  struct State;
  explicit Rays(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace luxel::scene

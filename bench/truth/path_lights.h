// Lights of a scene as a path tracer samples them.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "bench/scene/scene.h"

namespace luxel::truth {

/// Uniform numbers in (0, 1) that depend on the key and on how many were taken: SplitMix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t a, std::uint64_t b) : state_(mixed(mixed(mixed(seed) + a) + b)) {}
  double next() {
    state_ += 0x9e3779b97f4a7c15ull;
    return (static_cast<double>(mixed(state_) >> 12) + 0.5) * 0x1p-52;
  }

 private:
  std::uint64_t state_;
  static std::uint64_t mixed(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
    return v ^ (v >> 31);
  }
};

/// Unit vector `local` (z along the normal) in world space, for a unit normal (Duff et al. 2017).
glm::dvec3 about(glm::dvec3 normal, glm::dvec3 local);

/// Direction about the normal with density cos / pi (Malley's method) from two uniform numbers.
glm::dvec3 cosine_direction(glm::dvec3 normal, glm::dvec2 u);

/// Two uniform numbers for sample `s` of `n`: one in each cell of the squarest grid of at most n cells, the rest anywhere.
/// Neighbours in s are neighbours in the grid.
glm::dvec2 stratified(int s, int n, Random& random);

/// A picture of weights to draw from.
class Distribution {
 public:
  Distribution() = default;
  explicit Distribution(const std::vector<double>& weights);
  double total() const { return sums_.empty() ? 0 : sums_.back(); }
  /// Index drawn with probability weight / total; `u` in (0, 1). total() must not be 0.
  std::size_t draw(double u) const;
  double weight(std::size_t i) const { return sums_[i] - (i == 0 ? 0 : sums_[i - 1]); }

 private:
  std::vector<double> sums_;
};

/// A sampled direction towards a light.
struct LightSample {
  glm::dvec3 direction{0};  // unit
  glm::dvec3 point{0};      // on the emitter; unused for the sky
  glm::dvec3 normal{0};     // of the emitter, towards the point that asked
  glm::dvec3 radiance{0};
  double density = 0;       // per steradian
};

class Lights {
 public:
  explicit Lights(const scene::Scene& scene);

  bool has_emitters() const { return emitters_.total() > 0; }
  /// Whether the sky is worth sampling: one without an image is met well enough by chance.
  bool samples_sky() const { return sky_.total() > 0; }

  /// A point on an emitting triangle, drawn by area times luminance, seen from `from`. Empty where it lies edge-on.
  std::optional<LightSample> emitter(glm::dvec3 from, Random& random) const;
  /// The density per steradian with which emitter() draws a point of a triangle along a unit direction; 0 where it emits
  /// nothing.
  double emitter_density(std::size_t triangle, double distance, glm::dvec3 direction) const;

  LightSample sky(Random& random) const;
  double sky_density(glm::dvec3 direction) const;

 private:
  const scene::Scene& scene_;
  std::vector<std::uint32_t> emitting_;  // triangles
  Distribution emitters_, sky_;
};

}  // namespace luxel::truth

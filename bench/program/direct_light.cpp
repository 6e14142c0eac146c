#include "direct_light.h"

#include <cmath>
#include <numbers>
#include <thread>

namespace luxel::program {
namespace {

using glm::dvec3;

dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// Irradiance by one light on a surface, with a shadow ray: the formula of voxel_inject.
dvec3 irradiance(const scene::Rays& rays, const VoxelLight& light, dvec3 position, dvec3 normal) {
  dvec3 to = vector_of(light.place);
  double share = 1, reach = scene::Rays::forever;
  if (light.kind != VoxelLight::Kind::sun) {
    to -= position;
    const double squared = glm::dot(to, to);
    if (squared == 0) return dvec3(0);
    reach = std::sqrt(squared) * (1 - 1e-3);
    to /= std::sqrt(squared);
    share = std::max(0.0, -glm::dot(to, glm::normalize(vector_of(light.normal)))) /
            (squared + light.area / std::numbers::pi);
  }
  share *= glm::dot(normal, to);
  if (!(share > 0) || rays.blocked(position + rays.offset() * normal, to, reach)) return dvec3(0);
  return share * vector_of(light.power);
}

}  // namespace

std::vector<dvec3> direct(const RenderInput& input, const std::vector<VoxelLight>& lights, bool sun) {
  const scene::GBuffer& g = input.gbuffer;
  std::vector<dvec3> sum(g.pixels(), dvec3(0));
  std::vector<std::thread> threads;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < g.pixels(); i += count)
        if (g.surface_at(i))
          for (const VoxelLight& light : lights)
            if ((light.kind == VoxelLight::Kind::sun) == sun)
              sum[i] += irradiance(input.rays, light, g.at(g.position, i), g.at(g.normal, i));
    });
  for (std::thread& thread : threads) thread.join();
  return sum;
}

}  // namespace luxel::program

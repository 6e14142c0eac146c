#include "bench/truth/vpl_truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

namespace luxel::truth {

using glm::dvec3;

std::vector<double> vpl_irradiance(const scene::Rays& rays, const std::vector<scene::VirtualLight>& lights,
                                   const std::vector<dvec3>& places, const std::vector<dvec3>& normals) {
  std::vector<double> result(3 * places.size());
  std::atomic<std::size_t> next = 0;
  std::vector<std::thread> threads;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&] {
      for (std::size_t i = next++; i < places.size(); i = next++) {
        const dvec3 from = places[i] + rays.offset() * normals[i];
        dvec3 sum(0);
        for (const scene::VirtualLight& l : lights) {
          const dvec3 to = l.position + rays.offset() * l.normal - from;
          const double here = glm::dot(to, normals[i]), there = -glm::dot(to, l.normal), squared = glm::dot(to, to);
          if (!(here > 0 && there > 0) || l.flux == dvec3(0)) continue;
          if (rays.blocked(from, to, 1 - 1e-6)) continue;
          sum += l.flux * (here * there / (std::numbers::pi * squared * (squared + l.area / std::numbers::pi)));
        }
        for (int c = 0; c < 3; ++c) result[3 * i + static_cast<std::size_t>(c)] = sum[c];
      }
    });
  for (std::thread& thread : threads) thread.join();
  return result;
}

}  // namespace luxel::truth

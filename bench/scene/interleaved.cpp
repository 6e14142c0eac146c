#include "bench/scene/interleaved.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <luxel/gaussian_blur.h>

namespace luxel::scene {
namespace {

Result<std::vector<float>> blurred(Context& context, const GBuffer& seen, const std::vector<float>& values, double sigma) {
  GaussianBlurParams p;
  p.width = seen.width;
  p.height = seen.height;
  p.sigma = sigma;
  const auto plan = luxel::plan(p, context.profile());
  if (!plan) return plan.status();
  const auto program = context.compile(plan.value());
  if (!program) return program.status();
  std::vector<Named> named;
  for (const Resource& r : plan.value().resources) {
    auto memory = context.make(r);
    if (!memory) return memory.status();
    named.push_back({r.name, memory.value()});
    if (r.name == "src")
      if (Status s = context.upload(*memory.value(), values.data(), values.size() * 4); !s) return s;
  }
  if (Status s = context.run(*program.value(), named); !s) return s;
  std::vector<float> result(values.size());
  for (const Named& n : named)
    if (n.name == "dst")
      if (Status s = context.download(*n.memory, result.data(), result.size() * 4); !s) return s;
  return result;
}

}  // namespace

Result<PictureDifference> picture_difference(Context& context, const GBuffer& seen, const std::vector<float>& first,
                                             const std::vector<float>& second, double sigma) {
  const auto a = blurred(context, seen, first, sigma), b = blurred(context, seen, second, sigma);
  if (!a) return a.status();
  if (!b) return b.status();
  std::vector<double> bright, differences;
  for (std::size_t i = 0; i < seen.pixels(); ++i) {
    if (!seen.surface_at(i)) continue;
    double most = 0, sum = 0;
    for (std::size_t c = 4 * i; c < 4 * i + 3; ++c) {
      most = std::max<double>(most, a.value()[c]);
      sum += std::fabs(static_cast<double>(a.value()[c]) - static_cast<double>(b.value()[c]));
    }
    bright.push_back(most / std::numbers::pi);
    differences.push_back(sum / std::numbers::pi);
  }
  PictureDifference d;
  if (bright.empty()) return d;
  std::sort(bright.begin(), bright.end());
  const double white = bright[(bright.size() - 1) * 99 / 100];
  if (!(white > 0)) return d;
  d.exposure = -std::log2(white);
  std::sort(differences.begin(), differences.end());
  for (double& v : differences) v /= white, d.mean += v, d.within += v <= 0.1;
  d.mean /= static_cast<double>(differences.size());
  d.within /= static_cast<double>(differences.size());
  d.p95 = differences[(differences.size() - 1) * 95 / 100];
  d.max = differences.back();
  return d;
}

std::vector<float> receivers_of(const GBuffer& seen, const VoxelGrid& grid) {
  const glm::dvec3 origin(grid.origin[0], grid.origin[1], grid.origin[2]);
  std::vector<float> receivers;
  for (std::size_t i = 0; i < seen.pixels(); ++i) {
    const glm::dvec3 p = seen.at(seen.position, i) - origin, n = seen.at(seen.normal, i);
    for (const double v : {p.x, p.y, p.z, static_cast<double>(seen.roughness[i]), n.x, n.y, n.z, 0.0})
      receivers.push_back(static_cast<float>(v));
  }
  return receivers;
}

}  // namespace luxel::scene

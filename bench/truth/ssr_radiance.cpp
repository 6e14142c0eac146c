#include "bench/truth/ssr_radiance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/scene/screen.h"
#include "bench/truth/path_truth.h"

namespace luxel::truth {

Result<ScreenTruth> screen_truth(const scene::Scene& scene, const scene::Rays& rays, int width, int height, bool mirror, int samples) {
  ScreenTruth s;
  s.g = scene::gbuffer(rays, scene.camera, width, height);
  s.params = scene::screen_params(s.g, scene.camera);
  const scene::Bounds box = scene::bounds(scene);
  s.params.thickness = glm::length(box.high - box.low) / 64;
  const glm::dvec3 sky = scene.sky.radiance;
  s.params.environment = {sky.x, sky.y, sky.z};
  s.params.fade_edge = 0;
  s.params.shade = true;
  s.normals = scene::screen_normals(s.g, scene.camera);
  std::vector<Receiver> points = receivers(s.g, scene.camera.eye);
  if (mirror) {
    for (Receiver& r : points) r.roughness = 0;
    for (std::size_t i = 3; i < s.normals.size(); i += 4) s.normals[i] = s.normals[i] < 1.5f ? 0 : s.normals[i];
  }
  PathSettings settings;
  settings.samples = samples;
  const auto traced = path_truth(rays, points, settings);
  if (!traced) return traced.status();
  const PathTruth& t = traced.value();
  s.seen = mirrored(rays, s.g, scene.camera);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < s.g.pixels(); ++i) {
    const glm::dvec3 leaves = s.g.at(s.g.emission, i) + s.g.at(s.g.albedo, i) / std::numbers::pi *
                                                           (t.sun.rgb(i) + t.emitted.rgb(i) + t.sky.rgb(i) + t.indirect_all.rgb(i));
    for (const double v : {leaves.x, leaves.y, leaves.z, 1.0}) s.colour.push_back(static_cast<float>(v));
    ++s.pixels[static_cast<std::size_t>(s.seen[i].seen)];
    for (std::size_t j = 3 * i; j < 3 * i + 3; ++j) {
      s.t1.push_back(t.glossy_all.t1[j] + t.glossy_sky.t1[j] + t.glossy_emitted.t1[j]);
      s.t2.push_back(t.glossy_all.t2[j] + t.glossy_sky.t2[j] + t.glossy_emitted.t2[j]);
      if (s.seen[i].seen == Seen::nothing) continue;
      sum += (s.t1.back() + s.t2.back()) / 2;
      ++count;
    }
  }
  s.mean = sum / std::max(count, 1.0);
  return s;
}

ScreenErrors screen_errors(const ScreenTruth& s, std::span<const float> radiance) {
  std::array<double, seen_classes> sum{}, count{};
  double squares = 0, all = 0;
  for (std::size_t i = 0; i < s.seen.size(); ++i) {
    const auto c = static_cast<std::size_t>(s.seen[i].seen);
    if (c == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = radiance[4 * i + k], v = (x - s.t1[3 * i + k]) * (x - s.t2[3 * i + k]) / (s.mean * s.mean);
      sum[c] += v;
      squares += v * v;
      ++count[c];
      ++all;
    }
  }
  ScreenErrors e;
  for (std::size_t c = 0; c < seen_classes; ++c) {
    e.of[c] = count[c] > 0 ? sum[c] / count[c] : 0;
    e.part[c] = sum[c] / all;
    e.all += e.part[c];
  }
  e.standard_error = std::sqrt(std::max(0.0, squares / all - e.all * e.all) / all);
  return e;
}

}  // namespace luxel::truth

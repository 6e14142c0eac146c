#include "bench/report/stage.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "bench/report/scenes.h"
#include "bench/truth/path_truth.h"

namespace luxel::report {

std::vector<Place> places(std::vector<std::string>& missing) {
  std::vector<Place> found{{"cornell (generated)", "cornell", {{}, {}, 0}},
                            {"atrium (generated)", "atrium:20000", {{}, {}, 0}}};
  const std::string sponza = data_folder() + "/crytek_sponza/sponza.glb";
  if (!std::filesystem::exists(sponza))
    missing.push_back(sponza + " is missing");
  else
    found.push_back({"Sponza", sponza, {{-60, 12, -3}, {60, 25, -2}, 65}});
  return found;
}

Result<std::shared_ptr<const Stage>> stage_of(const Place& place, bool quick) {
  static std::map<std::pair<std::string, bool>, std::shared_ptr<const Stage>> stages;
  const std::pair key{place.name, quick};
  if (stages.contains(key)) return stages[key];
  auto read = scene::scene_from(place.scene);
  if (!read) return read.status();
  auto stage = std::make_shared<Stage>();
  stage->scene = std::move(read).value();
  if (place.camera.fov > 0) stage->scene.camera = place.camera;
  auto rays = scene::Rays::make(stage->scene);
  if (!rays) return rays.status();
  stage->rays = rays.value();
  stage->seen = scene::gbuffer(rays.value(), stage->scene.camera, quick ? 48 : 96, quick ? 27 : 54);
  truth::PathSettings settings;
  settings.samples = quick ? 256 : 1024;
  settings.bounces = 1;
  auto traced = path_truth(rays.value(), truth::receivers(stage->seen, stage->scene.camera.eye), settings);
  if (!traced) return traced.status();
  for (std::size_t i = 0; i < stage->seen.pixels(); ++i) {
    if (!stage->seen.surface_at(i)) continue;
    stage->pixels.push_back(i);
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      stage->t1.push_back(traced.value().indirect.t1[c]);
      stage->t2.push_back(traced.value().indirect.t2[c]);
      stage->mean += (stage->t1.back() + stage->t2.back()) / 2;
    }
  }
  stage->mean /= static_cast<double>(std::max<std::size_t>(stage->t1.size(), 1));
  stages[key] = stage;
  return stages[key];
}

Relative relative(const std::vector<double>& a1, const std::vector<double>& a2, const std::vector<double>& b1,
                  const std::vector<double>& b2, double mean) {
  const double n = static_cast<double>(a1.size());
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < a1.size(); ++i) {
    const double v = (a1[i] - b1[i]) * (a2[i] - b2[i]) / (mean * mean);
    sum += v;
    squares += v * v;
  }
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / n / n) / n)};
}

}  // namespace luxel::report

// Whole scenes that methods of global illumination are compared on: the same receivers and the same truth for each.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/scene/gbuffer.h"
#include "bench/scene/rays.h"

namespace luxel::report {

struct Place {
  std::string name, scene;  // as the report shows it, and as scene_from takes it
  scene::Camera camera;     // fov 0: the scene's own
};

/// A scene, what its camera sees, and the truth there.
struct Stage {
  scene::Scene scene;
  std::optional<scene::Rays> rays;  // through `scene`
  scene::GBuffer seen;
  std::vector<double> t1, t2;  // irradiance after one bounce, 3 a pixel that has a surface
  std::vector<std::size_t> pixels;  // those that have one: the receivers
  double mean = 0;
};

/// Cornell box and atrium, generated, and Sponza; `missing` receives a line where its file is absent.
std::vector<Place> places(std::vector<std::string>& missing);

/// Made once in a process. `quick`: 48x27 receivers and 256 paths for each half, else 96x54 and 1024.
Result<std::shared_ptr<const Stage>> stage_of(const Place& place, bool quick);

/// mean((a1 - b1)(a2 - b2)) / mean^2, and its standard error.
struct Relative {
  double value = 0, error = 0;
};
Relative relative(const std::vector<double>& a1, const std::vector<double>& a2, const std::vector<double>& b1,
                  const std::vector<double>& b2, double mean);

/// What `metric` of such rows says.
inline constexpr const char* bounce_metric = "irradiance after one bounce: mean((x - t1)(x - t2)) / (mean t)^2";

}  // namespace luxel::report

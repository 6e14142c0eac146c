// Light that leaks, as a number: energy that reaches the dark one of two rooms over the energy that the lamp sends into the other.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/report/session.h"
#include "bench/scene/rays.h"

namespace luxel::report {

/// The scene two_rooms and points all over its surfaces. One bounce is compared: light that reached a surface from the lamp, and
/// from there the point. The wall is closed: the truth in the dark room is 0, which path tracing confirms.
struct LeakStage {
  scene::Scene scene;
  std::optional<scene::Rays> rays;     // through `scene`
  std::vector<float> receivers;        // two vec4 each: position, 1; normal, 0. The dark room's first
  std::vector<double> area;            // that a receiver stands for
  std::size_t dark = 0;                // how many are in the dark room
  double injected = 0;                 // flux of the lamp, mean of the three channels
  std::vector<double> t1, t2;          // irradiance after one bounce, 3 a receiver, two independent halves
  std::size_t count() const { return area.size(); }
};

/// Made once in a process. `quick`: points farther apart, fewer paths.
Result<std::shared_ptr<const LeakStage>> leak_stage(bool quick);

struct Leak {
  double dark = 0;     // energy that reaches the dark room's surfaces, over the lamp's
  double lit = 0;      // energy that reaches the lit room's, over the truth's: a method that is dark everywhere leaks nothing
  double relative = 0; // of the lit room: mean((x - t1)(x - t2)) / (mean t)^2, by area
};
/// `irradiance` after one bounce, `channels` (3 or 4) a receiver, the first three meant.
Leak leak(const LeakStage& stage, std::span<const double> irradiance, int channels);
/// The same of path tracing itself.
Leak leak_of_truth(const LeakStage& stage);

inline constexpr const char* leak_metric = "energy in the dark room over energy of the lamp";

}  // namespace luxel::report

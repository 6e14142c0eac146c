// Reflections on the screen beside path tracing: a G-buffer with the light of its surfaces, and the radiance that each pixel's
// lobe receives, in two independent halves.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <luxel/hiz_ssr.h>

#include "bench/truth/ssr_scene.h"

namespace luxel::truth {

struct ScreenTruth {
  scene::GBuffer g;
  HizSsrParams params;          // the view; thickness 1/64 of the scene's diagonal; the environment is the scene's sky
  std::vector<float> normals;   // as hiz_ssr takes them
  std::vector<float> colour;    // radiance that leaves each pixel's surface diffusely, path-traced; 4 a pixel
  std::vector<Mirrored> seen;
  std::array<int, seen_classes> pixels{};  // of each class
  std::vector<double> t1, t2;   // radiance in the lobe, 3 a pixel
  double mean = 0;              // over all pixels that reflect
};

/// What the scene's camera sees. `mirror`: every surface that reflects is a mirror; else its own roughness. `samples`: paths of
/// each half for a pixel. Errors: of path_truth.
Result<ScreenTruth> screen_truth(const scene::Scene& scene, const scene::Rays& rays, int width, int height, bool mirror, int samples);

/// mean((x - t1)(x - t2)) / mean^2 over all pixels that reflect, misses with what they fell back on.
struct ScreenErrors {
  double all = 0, standard_error = 0;
  std::array<double, seen_classes> of{};    // the same over the pixels of a class alone
  std::array<double, seen_classes> part{};  // what a class adds to `all`: they sum to it
};

/// `radiance`: 4 a pixel, as hiz_ssr writes it.
ScreenErrors screen_errors(const ScreenTruth& truth, std::span<const float> radiance);

}  // namespace luxel::truth

// What light a scene really sends to points: path tracing in double, in two independent halves, with standard errors.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "bench/scene/gbuffer.h"

namespace luxel::truth {

/// A point where light is asked for.
struct Receiver {
  glm::dvec3 position{0};
  glm::dvec3 normal{0};     // unit; zero: there is no surface, and every answer is 0
  glm::dvec3 view{0};       // unit, towards the viewer; used where glossy
  double roughness = 1;     // perceptual, 0..1; used where glossy
  bool glossy = false;      // whether radiance in the specular lobe is asked for
};

/// The pixels of a G-buffer, in order. Glossy where the specular reflectance is not zero.
std::vector<Receiver> receivers(const scene::GBuffer& gbuffer, glm::dvec3 eye);

struct PathSettings {
  int samples = 64;              // paths of each half for a receiver, 1..1048576
  int bounces = 0;               // diffuse bounces that indirect_all counts; 0: without end, by Russian roulette
  double ao_falloff = 0;         // gamma of f(r) = 1 / (1 + gamma r), 1 / scene unit
  double ao_distance = scene::Rays::forever;  // surfaces beyond it do not occlude
  bool glossy = true;            // whether the glossy estimates are made; they take as long as all others
  std::uint32_t seed = 1;
  int threads = 0;               // 0: as many as there are cores. Results do not depend on it
  bool cached = true;            // whether a result may come from, and go to, the disk (luxel::cache_directory)
  std::function<void(double)> progress{};  // where given, told now and then which share is done, by one thread at a time
};

/// An estimate for every receiver: two independent halves, and the standard error of their mean. Half the width of the
/// 95 % confidence interval is 1.96 error. The error comes from differences of neighbouring strata, and so is too large
/// rather than too small (Cochran 1977, Sampling Techniques, section 5A.12, collapsed strata).
struct Estimate {
  int channels = 3;
  std::vector<double> t1, t2, error;  // channels * receivers

  double mean(std::size_t i) const { return (t1[i] + t2[i]) / 2; }
  glm::dvec3 rgb(std::size_t receiver) const {
    return {mean(3 * receiver), mean(3 * receiver + 1), mean(3 * receiver + 2)};
  }
};

/// Every surface reflects diffusely with its albedo; nothing but the receiver's own lobe is glossy. Irradiance is on the
/// receiver, without its albedo; direct light falls into three buffers, so that nothing is counted twice:
struct PathTruth {
  Estimate visibility;       // 1 channel: 1 - 1/pi int f(r) cos dw over the directions that meet a surface
  Estimate sun;              // irradiance from the sun; exact
  Estimate emitted;          // irradiance from emitting surfaces, seen directly
  Estimate sky;              // irradiance from the sky, seen directly
  Estimate indirect;         // irradiance after one diffuse bounce: int L1 cos dw, L1 = albedo / pi (sun + emitted + sky)
  Estimate indirect_all;     // after one and more
  Estimate glossy_emitted;   // mean radiance in the lobe, below, of emitting surfaces
  Estimate glossy_sky;       // of the sky
  Estimate glossy;           // of surfaces: L1 as above
  Estimate glossy_all;       // of surfaces, after all bounces
  double seconds = 0;        // of computation; 0 where it came from the disk
};

/// Names and estimates, in the order above.
std::vector<std::pair<std::string, const Estimate*>> estimates(const PathTruth& truth);

/// The lobe of a glossy receiver: the view direction mirrored at normals that GGX with alpha = roughness^2 shows to the
/// viewer (Heitz 2018, Sampling the GGX Distribution of Visible Normals), of the directions above the surface; the mean
/// is over these, so that a uniform environment gives its own radiance.
/// Diffuse paths: cosine-weighted directions, the first of a path stratified, and lights sampled (emitting triangles by area and luminance, a sky with
/// an image by its luminance), weighted by the balance heuristic (Veach and Guibas 1995). Nothing is clamped.
Result<PathTruth> path_truth(const scene::Rays& rays, const std::vector<Receiver>& receivers,
                             const PathSettings& settings);

}  // namespace luxel::truth

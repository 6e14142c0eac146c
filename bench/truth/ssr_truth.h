// What rays on the screen should meet, in double, without walking: every pixel of the image is asked for the part of the ray
// that is seen through it.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <luxel/hiz_ssr.h>

namespace luxel::truth {

/// A ray in view space; `reach` is a length, infinite allowed.
struct ScreenRay {
  std::array<double, 3> origin{}, direction{};  // unit
  double reach = 0;
};

/// The first pixel in which the ray's depths meet [d, d + thickness], and where.
struct ScreenHit {
  int x = -1, y = -1;    // -1: none
  double t = 0;          // along the ray, where it first lies within
  double middle = 0;     // along the ray, of its part in the pixel
  double depth = 0;      // at t
};

/// How far a decision may be off and still be a matter of rounding: pixels, and depth (relative to it, times the growth of
/// depth along the ray).
struct Slack {
  double pixels = 0, depth = 0;
};

/// What the rounding of f32 can do in an image of this size: four units in the last place of each quantity.
Slack f32_slack(const HizSsrParams& params);

/// Depth of a stored value; infinite where there is no surface.
double depth_of(const HizSsrParams& params, double stored);

/// The mirror ray of a pixel, from in front of its surface by the kernel's bias. False where there is none.
bool mirror_ray(const HizSsrParams& params, int x, int y, double stored, const std::array<double, 3>& normal,
                ScreenRay& ray);

/// The first hit, every pixel and every depth range taken larger by the slack (smaller where it is below 0).
ScreenHit first_hit(const HizSsrParams& params, std::span<const double> depth, const ScreenRay& ray, Slack slack = {});

/// What an answer of the kernel is worth: `outcome` and, for a hit, its pixel.
enum class Verdict { equal, tie, wrong };
Verdict judge(const HizSsrParams& params, std::span<const double> depth, const ScreenRay& ray, SsrOutcome outcome, int x,
              int y);

}  // namespace luxel::truth

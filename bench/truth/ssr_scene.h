// What mirror rays of a G-buffer's pixels meet in the scene itself, and how much of that the screen can know.
#pragma once
#include <vector>

#include "bench/scene/gbuffer.h"

namespace luxel::truth {

/// Where a pixel's mirror ray ends in the scene, as the image shows it.
enum class Seen {
  nothing,    // the pixel does not reflect
  on_screen,  // a surface that the image shows there
  off_screen, // a surface outside the image or behind the camera
  hidden,     // a surface inside the image, behind another, or seen from its other side
  sky         // no surface
};
constexpr int seen_classes = 5;

struct Mirrored {
  Seen seen = Seen::nothing;
  double distance = 0;   // to the surface
  double x = 0, y = 0;   // pixel coordinates where it lies; on_screen and hidden
};

/// One for each pixel; those with specular reflectance reflect. `tolerance`: of depth, relative, within which the image shows
/// the surface, beside its slope over a pixel.
std::vector<Mirrored> mirrored(const scene::Rays& rays, const scene::GBuffer& gbuffer, const scene::Camera& camera,
                               double tolerance = 0.01);

}  // namespace luxel::truth

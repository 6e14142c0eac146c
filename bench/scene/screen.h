// Reflections on the screen, from arrays to arrays: the pyramids of depth and colour, the split-sum table, and the rays, all
// on a device.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <luxel/device.h>
#include <luxel/hiz_ssr.h>

#include "bench/scene/gbuffer.h"

namespace luxel::scene {

/// What hiz_ssr is given, as its resources of these names, without the levels behind level 0; empty where the parameters do not
/// ask for it.
struct ScreenInput {
  std::span<const float> depth, normals, rays, colour, fallback, specular;
};

struct ScreenStep {
  std::string name;
  double ms = 0;  // of the device where it has a clock, else of the host
};

struct ScreenOutput {
  std::vector<float> hits, paths, directions, radiance;
  std::vector<std::uint32_t> counters;
  std::vector<ScreenStep> steps;
};

/// Errors: of the kernels; unsupported for cpu:double.
Result<ScreenOutput> reflect(Context& context, const HizSsrParams& params, const ScreenInput& input);

/// The view of a G-buffer's camera (linear depth), and its normals in view space with roughness, four values a pixel.
HizSsrParams screen_params(const GBuffer& gbuffer, const Camera& camera);
std::vector<float> screen_normals(const GBuffer& gbuffer, const Camera& camera);

/// Four values a pixel from three.
std::vector<float> padded(std::span<const float> three, float fourth = 0);

}  // namespace luxel::scene

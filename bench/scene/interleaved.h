// Interleaved sampling against all cones at every pixel, as a picture shows it.
#pragma once
#include "bench/scene/gbuffer.h"
#include "bench/scene/voxel_scene.h"

namespace luxel::scene {

/// Two lists of irradiance (4 values a pixel) at the pixels of a G-buffer, each blurred alike (gaussian_blur, `sigma` pixels,
/// border clamp), exposed so that the brighter 1 % of the first is above 1 in its largest channel, and compared: the sum of
/// the channels' absolute differences, over pixels that show a surface.
struct PictureDifference {
  double mean = 0, p95 = 0, max = 0;
  double within = 0;    // share of pixels at no more than 0.1
  double exposure = 0;  // stops that irradiance / pi is brightened by
};
Result<PictureDifference> picture_difference(Context& context, const GBuffer& seen, const std::vector<float>& first,
                                             const std::vector<float>& second, double sigma);

/// Receivers of a G-buffer for VoxelScene::trace; pixels without a surface have no normal.
std::vector<float> receivers_of(const GBuffer& seen, const VoxelGrid& grid);

}  // namespace luxel::scene

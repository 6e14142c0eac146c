// What a Gaussian blur should give: convolution in double, written apart from the kernels.
#pragma once
#include <span>
#include <vector>

#include <luxel/gaussian_blur.h>

namespace luxel::truth {

/// Radius beyond which a normalised Gaussian's weights sum to less than 1e-16: ceil(8.3 sigma), by the complementary error
/// function (erfc(8.3 / sqrt 2) = 1.0e-16).
int full_radius(double sigma);

/// The image blurred: `src` has width * height * channels values, interleaved. A Gaussian is separable, and so are the
/// four borders, so two passes of 2 radius + 1 taps are exact. `radius` -1: full_radius(sigma).
std::vector<double> gaussian(std::span<const double> src, int width, int height, int channels, double sigma,
                             Border border, int radius = -1);

}  // namespace luxel::truth

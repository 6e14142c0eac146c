// The bilateral filter by its formula, in double, with library functions: truth for kernels/bilateral.
#pragma once
#include <vector>

#include <luxel/bilateral.h>

namespace luxel::truth {

/// Images of a filter: width * height pixels, channels interleaved. What a term does not need may be empty.
struct BilateralImages {
  std::vector<double> src;       // channels of the format
  std::vector<double> guide;     // channels of guide_format
  std::vector<double> depth;     // 1
  std::vector<double> normals;   // 4: x, y, z, -1..1
  std::vector<double> variance;  // 1
};

/// The images with src (and, for atrous, variance) as the filter leaves them: every tap, weights by exp and pow, nothing
/// cut off. Variants direct and atrous; separable as direct, which it approximates. For values that are finite, and sky.
BilateralImages bilateral(const BilateralParams& params, const BilateralImages& images);

}  // namespace luxel::truth

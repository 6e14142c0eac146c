// What the cases of bilateral share.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <luxel/bilateral.h>

#include "bench/truth/bilateral_truth.h"
#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;
using truth::BilateralImages;

/// Values as the formats of `params` hold them: noise on two levels of colour, a floor, a wall and a box with their
/// normals, the variance of that noise. With `sky`, depth is 1e10 in the upper left and infinite in one pixel.
BilateralImages bilateral_images(const BilateralParams& params, std::uint32_t seed, bool sky = false);

struct Filtered {
  Values dst, variance_out, counters;
  std::string part;  // the kernel file of the last pass
};

/// Filters on a device, or as on one of another profile. What the kernel does not write stays NaN (255 in unorm8).
Result<Filtered> filter(Context& context, const BilateralParams& params, const BilateralImages& images);
Result<Filtered> filter(Context& context, const BilateralParams& params, const BilateralImages& images,
                        const Profile& profile);

/// The usual settings: R 4, sigma_space 2, sigma_range 0.2, the terms by name: a string of the letters c (self) g (guide)
/// d (plane) s (svgf) n (normal) l (luminance).
BilateralParams bilateral_params(int width, int height, const std::string& terms, Format format = Format::f32x4,
                                 Border border = Border::clamp);

/// Cases in these files, in the order of bilateral_cases().
void add_bilateral_formula_cases(std::vector<Case>& cases);
void add_bilateral_value_cases(std::vector<Case>& cases);
void add_bilateral_guide_cases(std::vector<Case>& cases);
void add_bilateral_equality_cases(std::vector<Case>& cases);
void add_bilateral_left_out_cases(std::vector<Case>& cases);
void add_bilateral_variant_cases(std::vector<Case>& cases);  // with the kernels beside: each names its kernel

}  // namespace luxel::cases

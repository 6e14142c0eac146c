// What the cases of gaussian_blur share.
#pragma once
#include <span>
#include <string>
#include <vector>

#include <luxel/gaussian_blur.h>

#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

constexpr Format pixel_formats[] = {Format::f32x1, Format::f32x2, Format::f32x4, Format::f16x4, Format::unorm8x4};
constexpr Border borders[] = {Border::clamp, Border::mirror, Border::wrap, Border::zero};
const char* name(Border border);
const char* name(GaussianVariant variant);

/// Whether a radius means anything to it.
inline bool has_taps(GaussianVariant variant) { return variant < GaussianVariant::recursive; }

/// Parameters by what the cases vary; the radius stays -1 where a variant has none, `pyramid` has a level where sigma allows.
GaussianBlurParams blur_params(int width, int height, double sigma, int radius, Format format = Format::f32x4,
                               Border border = Border::clamp, GaussianVariant variant = GaussianVariant::separable);

/// Blurs on a device. What the kernel does not write stays NaN (255 in unorm8).
Result<Values> blur(Context& context, const GaussianBlurParams& params, std::span<const double> src);

/// Rounding of `separable` in f32 against exact arithmetic, relative to the largest value, to first order in the unit
/// roundoff u = 2^-24: a pass makes R + 2 roundings one after another (a product, R + 1 sums), its weights are off by
/// u/2 each and their centre by (R + 1) u/2, and there are two passes.
double rounding_bound(int radius);

/// The value that every pixel tends to as sigma grows: the mean, with mirror (which does not repeat the edge) edge pixels
/// counted half, with clamp the mean of the corners.
double limit_of(const Values& src, int width, int height, Border border);

/// One channel as four alike: for images whose channels do not matter, so that they run in the form that most cases run in,
/// which a driver has compiled already.
Values as_four(const Values& src);

/// What exact arithmetic makes of an impulse in the middle of a row of n pixels, worked out once a process: at sigma 500 it
/// takes longer than all the blurs that are compared with it.
const Values& impulse_truth(int n, double sigma);

/// Cases in these files, in the order of gaussian_blur_cases().
void add_sigma_cases(std::vector<Case>& cases);
void add_value_cases(std::vector<Case>& cases);
void add_storage_cases(std::vector<Case>& cases);
void add_equality_cases(std::vector<Case>& cases);
void add_recursive_cases(std::vector<Case>& cases);
void add_box_cases(std::vector<Case>& cases);
void add_pyramid_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

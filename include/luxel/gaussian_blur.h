/// \file
/// gaussian_blur: Gaussian blur of an image, separable or direct (Akenine-Moeller et al., Real-Time Rendering 4e, 12.1, eq. 12.1).
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// What a pixel outside the image is taken to be.
enum class Border {
  clamp,   ///< the nearest edge pixel
  mirror,  ///< reflected, the edge pixel not repeated
  wrap,    ///< the image repeats
  zero     ///< nothing: the weights of the pixels inside are renormalised
};

/// Forms of the blur; what each costs and errs by is in kernels/gaussian_blur.
enum class GaussianVariant {
  separable,  ///< a pass along rows, a pass along columns: 2(2R+1) taps
  direct,     ///< one pass of (2R+1)^2 taps: the baseline
  sampler,    ///< separable, two texels per tap through the linear sampler; clamp and wrap only; src is an image
  recursive,  ///< poles, forward and backward along each axis: the same cost for every sigma
  box,        ///< repeated boxes of fractional width: the same cost for every sigma
  pyramid     ///< blurred at a coarser level of the image: the larger sigma, the fewer pixels
};

/// How `pyramid` goes from level to level.
enum class PyramidFilter {
  linear,  ///< 4 binomial taps down, linear interpolation up
  cubic    ///< 6 binomial taps down, a cubic B-spline up
};

/// An image is blurred by a Gaussian.
struct GaussianBlurParams {
  int width = 0;              ///< pixels, 1..65535
  int height = 0;             ///< pixels, 1..65535
  int src_stride = 0;         ///< pixels from row to row of src (buffers); 0: width
  int dst_stride = 0;         ///< pixels from row to row of dst; 0: width
  double sigma = 1.0;         ///< standard deviation in pixels, 0..10000
  int radius = -1;            ///< taps on each side, 0..4095; -1: ceil(3 sigma); -1 where a variant has no taps (recursive, box, pyramid)
  int order = 5;              ///< recursive: poles of a direction, 3..5
  int passes = 3;             ///< box: boxes one after another, 1..5
  int levels = -1;            ///< pyramid: levels that halve the image, 0..12 as far as sigma allows; -1: chosen by sigma
  PyramidFilter filter = PyramidFilter::linear;  ///< pyramid
  Border border = Border::clamp;  ///< what lies outside the image
  GaussianVariant variant = GaussianVariant::separable;  ///< which form is run
  Format format = Format::f32x4;  ///< of src and dst: f32x1, f32x2, f32x4, f16x4, unorm8x4
  Input input = Input::buffer;  ///< how src is bound
  bool difference = false;    ///< x + sum w (x_t - x): a constant image stays constant to the bit
  bool keep_alpha = false;    ///< four channels: alpha is copied, not filtered (for a constant alpha)
  bool drop_taps = false;     ///< leave out outer taps whose weights sum to less than half a step of unorm8 or f16
};

/// Resources of the plan: `src`, `dst`, `scratch`; `sampler` with two passes also `middle`, an image of src's size (f32 of
/// src's channels) that is written and then sampled. src and dst may be the same buffer where both extents are above 1 and
/// there is something to blur, but for `direct` and `sampler`; elsewhere an execution refuses that.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const GaussianBlurParams& params);

/// The passes that blur with these parameters on a device of this profile.
Result<Plan> plan(const GaussianBlurParams& params, const Profile& profile);

/// Radius that is really used: -1 resolved, dropped taps taken away.
int effective_radius(const GaussianBlurParams& params);

/// Levels that `pyramid` really uses: -1 resolved, so that the coarsest level is blurred by 1.8 of its pixels at least.
int effective_levels(const GaussianBlurParams& params);

/// Normalised weights 0..radius in double (index 0 is the centre; the others count twice).
/// `rounded`: values that are floats and sum to 1.0f when added as the kernel adds them.
std::vector<double> gaussian_weights(double sigma, int radius, bool rounded);

}  // namespace luxel

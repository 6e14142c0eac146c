/// \file
/// Edge-preserving filters: averages whose weights fall with distance in the image and with differences of colour, depth,
/// normal and luminance (Tomasi and Manduchi 1998; Petschnigg et al. 2004; Dammertz et al. 2010; Schied et al. 2017).
#pragma once
#include <luxel/gaussian_blur.h>
#include <luxel/plan.h>

namespace luxel {

/// How weights are taken together.
enum class BilateralVariant {
  direct,     ///< (2R/step + 1)^2 taps
  separable,  ///< rows, then columns: 2 (2R/step + 1) taps, an approximation
  atrous,     ///< levels of 25 (or 9) taps, their distance doubled from level to level (Dammertz et al. 2010)
  grid,       ///< bilateral grid: the same cost for every sigma_space; by luminance alone (Chen et al. 2007)
  discontinuity  ///< Gaussian along rows and columns that stops at the edges of discontinuity_mask; no other term
};

/// Differences of colour: none, of src, of the image `guide`.
enum class RangeTerm { off, self, guide };
/// How they are measured: sqrt of the sum of squares, or sum of absolute differences (OpenCV's).
enum class RangeNorm { l2, l1 };
/// What the radius bounds.
enum class FilterWindow { square, circle };

/// Differences of depth. plane: from the plane through p, measured in footprints of a pixel at p; exact on planes.
/// svgf: from p, measured by the gradient of z at p (Schied et al. 2017, eq. 3).
enum class DepthTerm { off, plane, svgf };

/// An image is filtered by terms that are multiplied: distance in the image, colour, depth, normal, luminance.
struct BilateralParams {
  int width = 0;       ///< pixels, 1..65535
  int height = 0;      ///< pixels, 1..65535
  int src_stride = 0;  ///< pixels from row to row of src, width..1048576; 0: width
  int dst_stride = 0;  ///< the same of dst
  BilateralVariant variant = BilateralVariant::direct;  ///< which form is run

  double sigma_space = 3;  ///< pixels, 0..infinity (all taps alike); 0: the result is the input; grid: 1..1024, a cell's side
  int radius = -1;         ///< pixels, 0..96 (separable, discontinuity 0..1024); -1: ceil(3 sigma_space)
  int step = 1;            ///< pixels from tap to tap, 1..16; taps beyond the radius are not taken
  FilterWindow window = FilterWindow::square;  ///< what the radius bounds
  bool adaptive = false;   ///< separable: the outer half of the window in pairs of averaged pixels

  double low = 0;          ///< grid: luminance of the first cell; what is beyond counts as there
  double high = 1;         ///< grid: of the last cell, at most 256 steps of sigma_range from the first

  int levels = 5;          ///< atrous: 1..6; the taps of level i lie 2^i pixels apart
  int taps = 5;            ///< atrous: 5 (B3 spline, 25 taps a level) or 3 (9 taps); sigma_space, radius, step count not

  RangeTerm range = RangeTerm::self;  ///< differences of which colours count
  double sigma_range = 0.1;  ///< in units of the image, 0..infinity (no colour term); 0: the result is the input
  RangeNorm range_norm = RangeNorm::l2;  ///< how they are measured
  Format guide_format = Format::f32x4;  ///< of `guide`: as format; three channels of x4 count

  DepthTerm depth = DepthTerm::off;  ///< differences of depth
  double sigma_depth = 1;     ///< plane: footprints off the plane for each pixel of distance; svgf: gradients; above 0
  double footprint = 0.001;   ///< width of a pixel at distance 1, 2 tan(fov/2)/height; above 0

  /// Differences of normals count.
  bool normal = false;
  double sigma_normal = 128;             ///< power of the cosine, 0.01..4096
  Format normal_format = Format::f32x4;  ///< of `normals`: f32x4 or f16x4 (-1..1), unorm8x4 (n/2 + 1/2)

  bool luminance = false;         ///< weights by luminance over its standard deviation; asks for `variance`
  double sigma_luminance = 4;     ///< standard deviations, above 0
  double epsilon = 1e-6;          ///< luminance added to what differences are divided by; above 0
  double variance_target = 0;     ///< pixels whose variance (gauss3x3 of it) is below keep their value; at every level of atrous,
                                  ///< so that levels end where enough is gained. Squared luminance, 0..1e30; 0: none
  bool carry_variance = false;    ///< atrous: `variance_out`, the variance of the result

  Border border = Border::clamp;  ///< what lies outside the image
  Format format = Format::f32x4;  ///< of src and dst: f32x1, f32x2, f32x4, f16x4, unorm8x4
  double flat = 0;                ///< direct: tiles of 16 x 16 pixels all of whose weights but the one of space are surely 1 - flat
                                  ///< or more get that one alone, by rows and columns, at the cost of a Gaussian; the result
                                  ///< differs by at most a quarter of flat (1 + flat) of what colours differ by within a window.
                                  ///< Square window, step 1, depth off or plane; 0..0.5, 0: none
  bool alpha = false;             ///< x4: the fourth channel is filtered and part of colour; else it is copied
  bool count = false;             ///< `counters`: pixels that are not finite in src [0], guide [1], depth that is no
                                  ///< surface [2] (sky, zero, negative, NaN), normals that are zero or not finite [3]
};

/// Resources of the plan: `src`, `dst`; where terms ask for them `guide` (colours), `depth` (f32x1, view space; 1e10 and
/// more is sky), `normals`, `variance` (f32x1, of src's luminance), `variance_out` (f32x1), `counters` (4 uint, which the
/// caller clears), discontinuity: `mask` (of discontinuity_mask). Guides are width * height pixels, rows without gaps. A pixel that is not finite keeps its value and
/// weighs nothing elsewhere; so does one whose guides are no number or no surface.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const BilateralParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const BilateralParams& params, const Profile& profile);

/// Taps on each side that weigh at least 2^-64 beside the centre, `step` apart; 0 where the result is the input.
int effective_taps(const BilateralParams& params);

/// An image of 1/ratio the size at full size, guided by the depth, and normals, of both (joint bilateral upsampling, Kopf et al.
/// 2007). The pixel (i, j) of src covers the ratio x ratio pixels from (i ratio, j ratio) on, and is taken to lie in their
/// middle.
struct BilateralUpsampleParams {
  int width = 0;   ///< pixels of dst, 1..65535
  int height = 0;  ///< pixels of dst, 1..65535; src has ceil(width / ratio) x ceil(height / ratio)
  int ratio = 2;   ///< 2 or 4
  bool nearest_depth = false;  ///< always the tap of nearest depth (Jansen and Bavoil 2011); else where no tap fits
  double sigma_depth = 1;      ///< as BilateralParams
  double footprint = 0.001;    ///< as BilateralParams
  /// Differences of normals count.
  bool normal = false;
  double sigma_normal = 32;    ///< power of the cosine, 0.01..4096
  double least = 0.001;        ///< sum of weights (1 where every tap fits) below which the nearest depth is taken, 1e-12..1
  Format format = Format::f32x4;  ///< of src and dst: f32x1, f32x4, f16x4
};

/// Resources of the plan: `src`, `depth_low`, `depth`, `dst`; `normals_low`, `normals` (f32x4). Depth of 1e10 and more is sky,
/// which takes from sky. Taps that are not finite do not count. Errors: invalid_argument, naming field, value and range.
Status validate(const BilateralUpsampleParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const BilateralUpsampleParams& params, const Profile& profile);

}  // namespace luxel

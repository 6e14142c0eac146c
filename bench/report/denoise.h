// A noisy render made smooth: outliers clamped, variance estimated, an à-trous filter guided by depth, normals and variance,
// all on light without albedo. What `luxel denoise` runs and the report measures.
#pragma once
#include <string>
#include <vector>

#include <luxel/bilateral.h>
#include <luxel/device.h>
#include <luxel/outlier_clamp.h>

namespace luxel::report {

/// Images of width * height pixels; `albedo`, `normals` and `depth` may be empty.
struct NoisyRender {
  int width = 0, height = 0;
  std::vector<double> color;    // 4 channels: linear radiance, and what is copied
  std::vector<double> albedo;   // 4 channels, three are used
  std::vector<double> normals;  // 4 channels, unit x, y, z
  std::vector<double> depth;    // view space; 1e10 and more is sky
};

struct DenoiseParams {
  double footprint = 0.001;  // width of a pixel at depth 1
  double sigma_depth = 1, sigma_normal = 64, sigma_luminance = 6;
  double sigma_albedo = 0.02;  // differences of albedo weigh too; 0: they do not
  double variance_target = 0;  // as BilateralParams; of light without albedo
  int levels = 5;
  bool clamp = true;  // outlier_clamp first
  double k = 4;       // its deviations
  int radius = 3;     // its window
};

struct Denoised {
  std::vector<double> color;                  // 4 channels
  double ms = 0;                              // of all kernels
  std::uint32_t clamped = 0, not_finite = 0;  // pixels
};

/// Light without albedo: color / max(albedo, 1e-3), and back.
std::vector<double> without_albedo(const NoisyRender& render, const std::vector<double>& color);
std::vector<double> with_albedo(const NoisyRender& render, const std::vector<double>& light);

Result<Denoised> denoise(Context& context, const NoisyRender& render, const DenoiseParams& params);

}  // namespace luxel::report

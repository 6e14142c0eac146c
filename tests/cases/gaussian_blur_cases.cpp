#include "tests/cases/gaussian_blur_cases.h"

#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "bench/truth/gaussian_truth.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/run.h"

namespace luxel::cases {

const char* name(Border border) {
  static const char* const names[] = {"clamp", "mirror", "wrap", "zero"};
  return names[static_cast<int>(border)];
}

const char* name(GaussianVariant variant) {
  static const char* const names[] = {"separable", "direct", "sampler", "recursive", "box", "pyramid"};
  return names[static_cast<int>(variant)];
}

GaussianBlurParams blur_params(int width, int height, double sigma, int radius, Format format, Border border,
                               GaussianVariant variant) {
  GaussianBlurParams p;
  p.width = width;
  p.height = height;
  p.sigma = sigma;
  p.radius = has_taps(variant) ? radius : -1;
  p.format = format;
  p.border = border;
  p.variant = variant;
  if (variant == GaussianVariant::pyramid && sigma > 1.3) p.levels = 1;
  if (variant == GaussianVariant::sampler) p.input = Input::image;
  return p;
}

Result<Values> blur(Context& context, const GaussianBlurParams& params, std::span<const double> src) {
  Result<Run> made = Run::make(context, plan(params, context.profile()));
  if (!made) return made.status();
  Run& run = made.value();
  if (Status status = run.write("src", src); !status) return status;
  const double unwritten = params.format == Format::unorm8x4 ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  const int stride = params.dst_stride > 0 ? params.dst_stride : params.width;
  const std::size_t pixels = static_cast<std::size_t>(params.height - 1) * stride + params.width;
  if (Status status = run.write("dst", Values(pixels * channels(params.format), unwritten)); !status) return status;
  if (Status status = run.go(); !status) return status;
  return run.read("dst");
}

double rounding_bound(int radius) { return 2 * ((radius + 2) + 0.5 + 0.5 * (radius + 1)) * std::ldexp(1.0, -24); }

double limit_of(const Values& src, int width, int height, Border border) {
  double sum = 0, total = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool edge_x = x == 0 || x == width - 1, edge_y = y == 0 || y == height - 1;
      double w = 1;
      if (border == Border::clamp) w = edge_x && edge_y ? 1 : 0;
      if (border == Border::mirror) w = (edge_x ? 0.5 : 1.0) * (edge_y ? 0.5 : 1.0);
      sum += w * src[static_cast<std::size_t>(y) * width + x];
      total += w;
    }
  return sum / total;
}

Values as_four(const Values& src) {
  Values four;
  for (const double v : src) four.insert(four.end(), 4, v);
  return four;
}

const Values& impulse_truth(int n, double sigma) {
  static std::mutex mutex;
  static std::map<std::pair<int, double>, Values> known;
  const std::lock_guard lock(mutex);
  Values& truth = known[{n, sigma}];
  if (truth.empty()) {
    Values impulse(n, 0.0);
    impulse[n / 2] = 1;
    truth = truth::gaussian(impulse, n, 1, 1, sigma, Border::clamp);
  }
  return truth;
}

std::vector<Case> gaussian_blur_cases() {
  std::vector<Case> cases;
  add_sigma_cases(cases);
  add_value_cases(cases);
  add_storage_cases(cases);
  add_equality_cases(cases);
  add_recursive_cases(cases);
  add_box_cases(cases);
  add_pyramid_cases(cases);
  for (Case& c : cases) c.kernel = "gaussian_blur";
  return cases;
}

}  // namespace luxel::cases

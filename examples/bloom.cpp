// Bloom: light that spills from very bright pixels over their neighbours (Akenine-Moeller et al., Real-Time Rendering 4e,
// 12.3). No threshold: the whole HDR picture is blurred, so that nothing pops as it crosses one. What a lens does has a
// narrow peak and wide skirts, which one Gaussian has not: four are added, each twice to four times as wide as the last.
// The weights sum to 1, so that light is spread and none is made.
//
//   bloom IN.hdr OUT.png [DEVICE [EXPOSURE]]     DEVICE: opencl (default), vulkan, cpu; EXPOSURE: stops, default 0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <luxel/device.h>
#include <luxel/gaussian_blur.h>

#include "bench/io/image.h"

namespace {

struct Part {
  double sigma;  // pixels
  float weight;
};
constexpr Part parts[] = {{2, 0.06f}, {6, 0.04f}, {18, 0.03f}, {54, 0.02f}};

int complain(const luxel::Status& status) {
  std::fprintf(stderr, "bloom: %s\n", status.message().c_str());
  return 1;
}

// The picture blurred by a pyramid, which costs the less the wider the blur is.
luxel::Status blur(luxel::Context& context, int width, int height, double sigma, const std::vector<float>& rgba,
                   std::vector<float>& blurred) {
  luxel::GaussianBlurParams params;
  params.width = width;
  params.height = height;
  params.sigma = sigma;
  params.variant = luxel::GaussianVariant::pyramid;
  params.filter = luxel::PyramidFilter::cubic;  // a bright pixel that moves must not flicker
  const auto plan = luxel::plan(params, context.profile());
  if (!plan) return plan.status();
  const auto program = context.compile(plan.value());
  if (!program) return program.status();
  const auto src = context.make(plan.value().resources[0]), dst = context.make(plan.value().resources[1]);
  if (!src) return src.status();
  if (!dst) return dst.status();
  if (auto s = context.upload(*src.value(), rgba.data(), rgba.size() * sizeof(float)); !s) return s;
  if (auto s = context.run(*program.value(), {{"src", src.value()}, {"dst", dst.value()}}); !s) return s;
  blurred.resize(rgba.size());
  return context.download(*dst.value(), blurred.data(), blurred.size() * sizeof(float));
}

float srgb(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3 || argc > 5) {
    std::fprintf(stderr, "usage: bloom IN.hdr OUT.png [DEVICE [EXPOSURE]]\n");
    return 2;
  }
  const auto read = luxel::io::read_image(argv[1]);
  if (!read) return complain(read.status());
  const luxel::io::Image& image = read.value();
  const auto context = luxel::Context::open(argc > 3 ? argv[3] : "opencl");
  if (!context) return complain(context.status());
  const float exposure = std::exp2(argc > 4 ? std::strtof(argv[4], nullptr) : 0.0f);

  // Four channels, the last unused: a pixel is then one vector on every device.
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  const int colours = std::min(image.channels, 3);
  std::vector<float> rgba(4 * pixels, 0.0f);
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c) rgba[4 * i + c] = image.pixels[image.channels * i + std::min(c, colours - 1)];

  float kept = 1;
  for (const Part& part : parts) kept -= part.weight;
  std::vector<float> sum(rgba.size()), blurred;
  for (std::size_t i = 0; i < rgba.size(); ++i) sum[i] = kept * rgba[i];
  for (const Part& part : parts) {
    if (auto s = blur(*context.value(), image.width, image.height, part.sigma, rgba, blurred); !s) return complain(s);
    for (std::size_t i = 0; i < rgba.size(); ++i) sum[i] += part.weight * blurred[i];
  }

  luxel::io::Image out{image.width, image.height, 3, std::vector<float>(3 * pixels)};
  double before = 0, after = 0;
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < 3; ++c) {
      before += rgba[4 * i + c];
      after += sum[4 * i + c];
      out.pixels[3 * i + c] = srgb(exposure * sum[4 * i + c]);
    }
  if (auto s = luxel::io::write_image(argv[2], out); !s) return complain(s);
  std::printf("%s: %dx%d; light after by before: %.4f\n", argv[2], image.width, image.height, after / before);
  return 0;
}

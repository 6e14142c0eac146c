// gaussian_blur: its weights, what validate() refuses, the passes it leaves out, and the outputs of another program.
// The extreme cases stand in cases/gaussian_blur_*_cases.cpp.
#include <luxel/gaussian_blur.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "bench/io/array.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

// OpenCV computes its weights in double and sums in float; its two code paths differ by 7e-7 between themselves.
constexpr double opencv_tolerance = 5e-6;

std::string data(const std::string& file) {
  const char* folder = std::getenv("LUXEL_DATA");
  return std::string(folder ? folder : "../shared/data") + "/" + file;
}

TEST(GaussianBlurWeights, SumToOneInTheOrderOfUseAndStayCloseToTheGaussian) {
  for (const double sigma : {0.3, 0.5, 0.8, 1.0, 2.0, 4.0, 5.0, 12.0, 33.0, 100.0, 1000.0})
    for (const int k : {1, 3, 6}) {
      const int radius = std::min(4095, static_cast<int>(std::ceil(k * sigma)));
      const std::vector<double> rounded = gaussian_weights(sigma, radius, true);
      const std::vector<double> exact = gaussian_weights(sigma, radius, false);
      float sum = static_cast<float>(rounded[0]);
      for (int t = 1; t <= radius; ++t) sum += static_cast<float>(rounded[t]) * 2.0f;
      EXPECT_EQ(sum, 1.0f) << "sigma " << sigma << " radius " << radius;
      double exact_sum = exact[0];
      for (int t = 1; t <= radius; ++t) exact_sum += 2 * exact[t];
      EXPECT_NEAR(exact_sum, 1.0, 1e-14);
      for (int t = 0; t <= radius; ++t) {
        EXPECT_EQ(rounded[t], static_cast<double>(static_cast<float>(rounded[t])));
        // Adding 2R+1 numbers in float can miss 1 by R roundings of half a unit; that much the weights may move in all.
        EXPECT_NEAR(rounded[t], exact[t], (radius + 2) * std::ldexp(1.0, -24)) << "sigma " << sigma << " t " << t;
      }
      for (int t = 1; t <= radius; ++t) EXPECT_NEAR(exact[t] / exact[0], std::exp(-t * t / (2 * sigma * sigma)), 1e-14);
    }
}

TEST(GaussianBlurRadius, FollowsThreeSigmaAndDropsWhatCannotBeSeen) {
  GaussianBlurParams p;
  p.width = p.height = 64;
  p.sigma = 4;
  EXPECT_EQ(effective_radius(p), 12);
  p.sigma = 4.01;
  EXPECT_EQ(effective_radius(p), 13);
  p.sigma = 0;
  EXPECT_EQ(effective_radius(p), 0);
  p.sigma = 1e-3;  // exp(-1/2e-6) is 0: a tap of weight 0 must not turn a neighbouring infinity into NaN
  EXPECT_EQ(effective_radius(p), 0);
  p.sigma = 4;
  p.radius = 24;
  p.format = Format::unorm8x4;
  EXPECT_EQ(effective_radius(p), 24);
  p.drop_taps = true;
  const int radius = effective_radius(p);
  const std::vector<double> w = gaussian_weights(4, 24, false);
  double dropped = 0;
  for (int t = 24; t > radius; --t) dropped += 2 * w[t];
  EXPECT_LT(radius, 24);
  EXPECT_LE(dropped, 1.0 / 510.0);
  EXPECT_GT(dropped + 2 * w[radius], 1.0 / 510.0) << "one more tap could go";
}

TEST(GaussianBlurPlan, LeavesOutPassesThatChangeNothing) {
  GaussianBlurParams p;
  p.sigma = 4;
  const auto passes = [&](int width, int height, double sigma) {
    p.width = width;
    p.height = height;
    p.sigma = sigma;
    const Result<Plan> made = plan(p, profile("reference"));
    EXPECT_TRUE(made.ok());
    return made.ok() ? made.value().passes.size() : 0;
  };
  EXPECT_EQ(passes(64, 32, 4), 2u);
  EXPECT_EQ(passes(64, 1, 4), 1u);
  EXPECT_EQ(passes(1, 32, 4), 1u);
  EXPECT_EQ(passes(64, 32, 0), 1u) << "a copy";
  p.variant = GaussianVariant::recursive;
  EXPECT_EQ(passes(64, 32, 4), 4u) << "forward and backward along two axes";
  EXPECT_EQ(passes(64, 1, 4), 2u);
  EXPECT_EQ(passes(1, 32, 4), 2u);
  EXPECT_EQ(passes(1, 1, 4), 1u) << "a copy";
  EXPECT_EQ(passes(64, 32, 0.01), 1u) << "a copy";
  p.variant = GaussianVariant::pyramid;
  EXPECT_EQ(passes(64, 32, 8), 6u) << "two levels down, two passes, two levels up";
  EXPECT_EQ(passes(64, 1, 8), 5u);
  EXPECT_EQ(passes(64, 32, 2), 2u) << "too small a sigma for a level";
  EXPECT_EQ(passes(64, 32, 0.01), 1u) << "a copy";
  p.variant = GaussianVariant::box;
  EXPECT_EQ(passes(64, 32, 4), 6u) << "three along two axes";
  EXPECT_EQ(passes(64, 1, 4), 3u);
  EXPECT_EQ(passes(64, 32, 0.01), 1u) << "a copy";
}

struct Refusal {
  const char* message;
  std::function<void(GaussianBlurParams&)> spoil;
};

TEST(GaussianBlurValidate, NamesFieldValueAndRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Refusal refusals[] = {
      {"GaussianBlurParams.width is 0; expected 1..65535", [](auto& p) { p.width = 0; }},
      {"GaussianBlurParams.width is -5; expected 1..65535", [](auto& p) { p.width = -5; }},
      {"GaussianBlurParams.height is 65536; expected 1..65535", [](auto& p) { p.height = 65536; }},
      {"GaussianBlurParams.src_stride is 7; expected 64..1048576", [](auto& p) { p.src_stride = 7; }},
      {"GaussianBlurParams.dst_stride is -1; expected 64..1048576", [](auto& p) { p.dst_stride = -1; }},
      {"GaussianBlurParams.sigma is -1; expected 0..10000", [](auto& p) { p.sigma = -1; }},
      {"GaussianBlurParams.sigma is nan; expected 0..10000", [=](auto& p) { p.sigma = nan; }},
      {"GaussianBlurParams.sigma is inf; expected 0..10000", [](auto& p) { p.sigma = HUGE_VAL; }},
      {"GaussianBlurParams.sigma is 2000; expected 0..1365, or a radius given (0..4095)", [](auto& p) { p.sigma = 2000; }},
      {"GaussianBlurParams.radius is 4096; expected -1..4095", [](auto& p) { p.radius = 4096; }},
      {"GaussianBlurParams.radius is -2; expected -1..4095", [](auto& p) { p.radius = -2; }},
      {"GaussianBlurParams.format is u32; expected f32x1, f32x2, f32x4, f16x4 or unorm8x4", [](auto& p) { p.format = Format::u32; }},
      {"GaussianBlurParams.format is f16x2; expected f32x1, f32x2, f32x4, f16x4 or unorm8x4", [](auto& p) { p.format = Format::f16x2; }},
      {"GaussianBlurParams.border is 9; expected 0..3", [](auto& p) { p.border = static_cast<Border>(9); }},
      {"GaussianBlurParams.variant is 7; expected 0..5", [](auto& p) { p.variant = static_cast<GaussianVariant>(7); }},
      {"GaussianBlurParams.keep_alpha is true; expected false for a format of fewer than four channels",
       [](auto& p) { p.keep_alpha = true; p.format = Format::f32x1; }},
      {"GaussianBlurParams.radius of variant direct is 97; expected 0..96",
       [](auto& p) { p.variant = GaussianVariant::direct; p.sigma = 90; p.radius = 97; }},
      {"GaussianBlurParams.input is buffer; expected image for variant sampler", [](auto& p) { p.variant = GaussianVariant::sampler; }},
      {"GaussianBlurParams.border is mirror; expected clamp or wrap for variant sampler",
       [](auto& p) { p.variant = GaussianVariant::sampler; p.input = Input::image; p.border = Border::mirror; }},
      {"GaussianBlurParams.order is 6; expected 3..5", [](auto& p) { p.variant = GaussianVariant::recursive; p.order = 6; }},
      {"GaussianBlurParams.radius is 12; expected -1 for variant recursive",
       [](auto& p) { p.variant = GaussianVariant::recursive; p.radius = 12; }},
      {"GaussianBlurParams.input is storage_image; expected buffer or image for variant recursive",
       [](auto& p) { p.variant = GaussianVariant::recursive; p.input = Input::storage_image; }},
      {"GaussianBlurParams.difference is true; expected false for variant recursive",
       [](auto& p) { p.variant = GaussianVariant::recursive; p.difference = true; }},
      {"GaussianBlurParams.height is 20000; expected 2 x width x height x channels of at most 2147483647 for variant recursive",
       [](auto& p) { p.variant = GaussianVariant::recursive; p.width = p.height = 20000; }},
      {"GaussianBlurParams.passes is 6; expected 1..5", [](auto& p) { p.variant = GaussianVariant::box; p.passes = 6; }},
      {"GaussianBlurParams.difference is true; expected false for variant box",
       [](auto& p) { p.variant = GaussianVariant::box; p.difference = true; }},
      {"GaussianBlurParams.sigma is 10000; expected lines that reach passes x sigma beyond the image, of at most 2147483647 values, "
       "for variant box",
       [](auto& p) { p.variant = GaussianVariant::box; p.passes = 5; p.sigma = 10000; p.width = p.height = 11000; }},
      {"GaussianBlurParams.levels is 4; expected -1..3",
       [](auto& p) { p.variant = GaussianVariant::pyramid; p.sigma = 8; p.levels = 4; }},
      {"GaussianBlurParams.levels is 0; expected -1, or 1 at least",
       [](auto& p) { p.variant = GaussianVariant::pyramid; p.sigma = 1500; p.levels = 0; }},
      {"GaussianBlurParams.filter is 2; expected 0..1",
       [](auto& p) { p.variant = GaussianVariant::pyramid; p.filter = static_cast<PyramidFilter>(2); }},
      {"GaussianBlurParams.keep_alpha is true; expected false for variant pyramid",
       [](auto& p) { p.variant = GaussianVariant::pyramid; p.keep_alpha = true; }},
      {"GaussianBlurParams.sigma is 10000; expected a level that reaches 4 sigma beyond the image, of at most 2147483647 values, "
       "for variant pyramid",
       [](auto& p) { p.variant = GaussianVariant::pyramid; p.sigma = 10000; }},
      {"GaussianBlurParams.height is 65535; expected stride x height x channels of at most 2147483647",
       [](auto& p) { p.width = p.height = 65535; }},
  };
  GaussianBlurParams good;
  good.width = 64;
  good.height = 48;
  EXPECT_TRUE(validate(good).ok()) << validate(good).message();
  for (const Refusal& refusal : refusals) {
    GaussianBlurParams p = good;
    refusal.spoil(p);
    EXPECT_EQ(validate(p).message(), refusal.message);
    EXPECT_EQ(validate(p).code(), Code::invalid_argument);
    for (const char* device : {"reference", "pocl", "lavapipe", "gpu"})
      EXPECT_EQ(plan(p, profile(device)).status().message(), refusal.message) << "the same verdict for " << device;
  }
}

// Rounding: the float executions against the same source in double, on a picture between 0 and 1.
TEST(GaussianBlurRounding, StaysWithinItsBound) {
  for (const int radius : {1, 4, 12, 36, 96}) {
    const GaussianBlurParams p = cases::blur_params(97, 61, radius / 3.0, radius, Format::f32x4, Border::mirror);
    std::vector<float> picture(97 * 61 * 4);
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] = 0.5f + 0.5f * std::sin(i * i * 0.001f);
    Context& exact = test_context("cpu:double");
    const std::vector<Bytes> expected = run_bytes(exact, plan(p, exact.profile()).value(), {{"src", encode(p.format, picture, true)}}, {"dst"});
    for (const std::string& device : test_devices()) {
      Context& context = test_context(device);
      const std::vector<Bytes> got = run_bytes(context, plan(p, context.profile()).value(), {{"src", encode(p.format, picture)}}, {"dst"});
      const std::vector<double> a = decode(p.format, expected.at(0), true), b = decode(p.format, got.at(0));
      double worst = 0;
      for (std::size_t i = 0; i < a.size(); ++i) worst = std::abs(a[i] - b[i]) <= worst ? worst : std::abs(a[i] - b[i]);
      EXPECT_LE(worst, cases::rounding_bound(radius)) << device << " radius " << radius;
    }
  }
}

// Small enough for a checking simulator: every variant, format and way of reading, and every border, with tails. Radii are
// those of the equal bits' cases, so that drivers which keep what they compiled compile none of it twice.
TEST(GaussianBlurSmall, EveryVariantRuns) {
  for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::direct, GaussianVariant::sampler,
                                       GaussianVariant::recursive, GaussianVariant::box, GaussianVariant::pyramid})
    for (const Format format : cases::pixel_formats)
      for (const Border border : cases::borders)
        for (const Input input : {Input::buffer, Input::image}) {
          const int radius = variant == GaussianVariant::direct || variant == GaussianVariant::sampler ? 6 : 12;
          GaussianBlurParams p = cases::blur_params(19, 7, radius == 12 ? 3.7 : radius / 3.0, radius, format, border, variant);
          p.input = input;
          p.difference = variant == GaussianVariant::separable && border == Border::wrap;
          if (border != Border::clamp && format != Format::f32x4) continue;
          if (!validate(p)) continue;
          std::vector<float> picture(static_cast<std::size_t>(p.width) * p.height * channels(format), 0.5f);
          for (const std::string& device : test_devices()) {
            Context& context = test_context(device);
            if (input == Input::image && !context.make(plan(p, context.profile()).value().resources[0])) continue;
            const std::vector<Bytes> got =
                run_bytes(context, plan(p, context.profile()).value(), {{"src", encode(format, picture)}}, {"dst"});
            for (const double v : decode(format, got.at(0))) EXPECT_NEAR(v, 0.5, 1.0 / 255) << device;
          }
        }
}

struct OpenCvOutput { const char* file; const char* input; double sigma; int taps; Border border; int channels; };

TEST(GaussianBlurOpenCv, EqualsItsOutputs) {
  const OpenCvOutput outputs[] = {
      {"gauss_camera_s0.8_k5_REPLICATE.npy", "in_camera.npy", 0.8, 5, Border::clamp, 1},
      {"gauss_camera_s0.8_k5_REFLECT_101.npy", "in_camera.npy", 0.8, 5, Border::mirror, 1},
      {"gauss_camera_s2_k13_REPLICATE.npy", "in_camera.npy", 2, 13, Border::clamp, 1},
      {"gauss_camera_s2_k13_REFLECT_101.npy", "in_camera.npy", 2, 13, Border::mirror, 1},
      {"gauss_camera_s5_k31_REPLICATE.npy", "in_camera.npy", 5, 31, Border::clamp, 1},
      {"gauss_camera_s5_k31_REFLECT_101.npy", "in_camera.npy", 5, 31, Border::mirror, 1},
      {"gauss_candle_s0.8_k5_REPLICATE.npy", "in_candle.npy", 0.8, 5, Border::clamp, 3},
      {"gauss_candle_s2_k13_REPLICATE.npy", "in_candle.npy", 2, 13, Border::clamp, 3},
      {"gauss_candle_s5_k31_REPLICATE.npy", "in_candle.npy", 5, 31, Border::clamp, 3},
  };
  int compared = 0;
  for (const OpenCvOutput& output : outputs) {
    const auto input = io::read_npy(data(std::string("opencv_ref/") + output.input));
    const auto expected = io::read_npy(data(std::string("opencv_ref/") + output.file));
    if (!input.ok() || !expected.ok()) GTEST_SKIP() << (input.ok() ? expected.status() : input.status()).message();
    const int n = output.channels == 1 ? 1 : 4, size = 256;
    const std::vector<float> values = io::to_float(input.value());
    std::vector<float> pixels(static_cast<std::size_t>(size) * size * n);
    for (int i = 0; i < size * size; ++i)
      for (int c = 0; c < output.channels; ++c) pixels[i * n + c] = values[i * output.channels + c];
    const std::vector<float> truth = io::to_float(expected.value());
    const GaussianBlurParams p = cases::blur_params(size, size, output.sigma, output.taps / 2,
                                                    n == 1 ? Format::f32x1 : Format::f32x4, output.border);
    for (const std::string& device : test_devices()) {
      Context& context = test_context(device);
      const std::vector<Bytes> got = run_bytes(context, plan(p, context.profile()).value(), {{"src", encode(p.format, pixels)}}, {"dst"});
      const std::vector<double> result = decode(p.format, got.at(0));
      double worst = 0;
      for (int i = 0; i < size * size; ++i)
        for (int c = 0; c < output.channels; ++c) {
          const double difference = std::abs(result[i * n + c] - truth[i * output.channels + c]);
          worst = difference <= worst ? worst : difference;
        }
      EXPECT_LE(worst, opencv_tolerance) << output.file << " on " << device;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 9 * static_cast<int>(test_devices().size()));
}

}  // namespace
}  // namespace luxel

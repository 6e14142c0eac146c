// bilateral: its formula in double, its power of 2, what validate() refuses, passes that are left out, OpenCV's outputs.
// The extreme cases stand in cases/bilateral_*_cases.cpp.
#include <luxel/bilateral.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "bench/io/array.h"
#include "host/reference/words.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/support/run.h"

namespace luxel {
namespace in_float {
using reference::floatBitsToUint;
using reference::uint;
using reference::uintBitsToFloat;
#define FN inline
#include "kernels/math/exact.h"
#include "kernels/math/range_weight.h"
#undef FN
}  // namespace in_float

namespace {

using cases::Values;

std::string data(const std::string& file) {
  const char* folder = std::getenv("LUXEL_DATA");
  return std::string(folder ? folder : "../shared/data") + "/" + file;
}

TEST(BilateralWeight, PowerOfTwoIsWithinItsStatedError) {
  // 9.2e-8 of the polynomial and at most three roundings of 2^-24 after it.
  constexpr double bound = 9.2e-8 + 3 * 0x1p-24;
  double worst = 0;
  for (int i = 0; i <= 64 * 4096; ++i) {
    const float e = static_cast<float>(i) / -4096.0f;
    const double error = std::abs(in_float::range_weight(e) / std::exp2(static_cast<double>(e)) - 1);
    worst = error <= worst ? worst : error;
  }
  EXPECT_LE(worst, bound);
  EXPECT_EQ(in_float::range_weight(0), 1.0f);
  EXPECT_EQ(in_float::range_weight(-64), 0x1p-64f);
  for (const float e : {-64.001f, -1e30f, -HUGE_VALF, std::nanf("")}) EXPECT_EQ(in_float::range_weight(e), 0.0f) << e;
}

TEST(BilateralWeight, LogarithmOfACosineIsWithinItsStatedError) {
  EXPECT_EQ(in_float::log2_cosine(1), 0.0f);
  for (const float d : {0.0f, -1.0f, -HUGE_VALF, std::nanf("")}) EXPECT_EQ(in_float::log2_cosine(d), -1e30f) << d;
  for (int i = 0; i < 100000; ++i) {
    const float d = 1.0f - static_cast<float>(i) * 1e-5f;
    const double exact = std::log2(static_cast<double>(d));
    // 3e-8 near 1; further off, the roundings of a sum of the result's size.
    EXPECT_NEAR(in_float::log2_cosine(d), exact, 3e-8 + 2 * 0x1p-23 * std::abs(exact)) << d;
  }
}

TEST(Bilateral, EveryTermFollowsItsFormulaInDouble) {
  // The double execution misses the formula by its power of 2 (9.2e-8) and by weights below 2^-64; a cosine's logarithm,
  // whose series ends at z^11, is multiplied by sigma_normal.
  constexpr double formula_bound = 4e-7;
  for (const std::string terms : {"", "c", "g", "d", "s", "n", "l", "cdnl", "gsn"}) {
    const BilateralParams p = cases::bilateral_params(37, 29, terms);
    const cases::BilateralImages images = cases::bilateral_images(p, 1);
    const auto out = cases::filter(test_context("cpu:double"), p, images);
    ASSERT_TRUE(out.ok()) << out.status().message();
    EXPECT_LE(cases::max_difference(out.value().dst, truth::bilateral(p, images).src), formula_bound)
        << "terms " << terms;
  }
}

TEST(BilateralPlan, BindsAndRunsOnlyWhatTermsAskFor) {
  const auto made = [](const std::string& terms, auto change) {
    BilateralParams p = cases::bilateral_params(64, 48, terms);
    change(p);
    const Result<Plan> plan = luxel::plan(p, profile("reference"));
    EXPECT_TRUE(plan.ok()) << plan.status().message();
    std::string names;
    for (const Resource& r : plan.value().resources) names += r.name + " ";
    return names + std::to_string(plan.value().passes.size());
  };
  const auto nothing = [](auto&) {};
  EXPECT_EQ(made("", nothing), "src dst 3");
  EXPECT_EQ(made("c", nothing), "src dst 2");
  EXPECT_EQ(made("g", nothing), "src dst guide 4");
  EXPECT_EQ(made("cdnl", nothing), "src dst depth normals variance 6");
  EXPECT_EQ(made("gdnl", [](auto& p) { p.sigma_range = 0; }), "src dst 2") << "the input: no term is looked at";
  EXPECT_EQ(made("g", [](auto& p) { p.sigma_range = HUGE_VAL; }), "src dst 3") << "a term that changes nothing";
  EXPECT_EQ(made("c", [](auto& p) { p.variant = BilateralVariant::separable; }), "src dst 3");
  EXPECT_EQ(made("c", [](auto& p) { p.count = true; }), "src dst counters 3");
}

TEST(BilateralPlan, TapsEndWhereWeightsAreZero) {
  BilateralParams p;
  p.sigma_space = 4;
  EXPECT_EQ(effective_taps(p), 12);
  p.step = 2;
  EXPECT_EQ(effective_taps(p), 6);
  p.step = 1;
  p.radius = 96;
  p.sigma_space = 1;  // exp(-r^2/2) is above 2^-64 up to 9.4
  EXPECT_EQ(effective_taps(p), 9);
  p.sigma_range = 0;
  EXPECT_EQ(effective_taps(p), 0);
}

struct Refusal {
  const char* message;
  std::function<void(BilateralParams&)> spoil;
};

TEST(BilateralValidate, NamesFieldValueAndRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Refusal refusals[] = {
      {"BilateralParams.width is 0; expected 1..65535", [](auto& p) { p.width = 0; }},
      {"BilateralParams.height is 65536; expected 1..65535", [](auto& p) { p.height = 65536; }},
      {"BilateralParams.src_stride is 7; expected 64..1048576", [](auto& p) { p.src_stride = 7; }},
      {"BilateralParams.dst_stride is -1; expected 64..1048576", [](auto& p) { p.dst_stride = -1; }},
      {"BilateralParams.sigma_space is nan; expected 0..inf", [=](auto& p) { p.sigma_space = nan; }},
      {"BilateralParams.sigma_space is 33; expected 0..32, or a radius given (0..96)",
       [](auto& p) { p.sigma_space = 33; }},
      {"BilateralParams.radius is 97; expected -1..96", [](auto& p) { p.radius = 97; }},
      {"BilateralParams.step is 0; expected 1..16", [](auto& p) { p.step = 0; }},
      {"BilateralParams.levels is 7; expected 1..6",
       [](auto& p) {
         p.variant = BilateralVariant::atrous;
         p.levels = 7;
       }},
      {"BilateralParams.taps is 4; expected 3 or 5",
       [](auto& p) {
         p.variant = BilateralVariant::atrous;
         p.taps = 4;
       }},
      {"BilateralParams.adaptive is true; expected false but for variant separable",
       [](auto& p) { p.adaptive = true; }},
      {"BilateralParams.step is 2; expected 1 with adaptive",
       [](auto& p) {
         p.variant = BilateralVariant::separable;
         p.adaptive = true;
         p.step = 2;
       }},
      {"BilateralParams.border is zero; expected clamp, mirror or wrap with adaptive",
       [](auto& p) {
         p.variant = BilateralVariant::separable;
         p.adaptive = true;
         p.border = Border::zero;
       }},
      {"BilateralParams.window is circle; expected square but for variant direct",
       [](auto& p) {
         p.variant = BilateralVariant::separable;
         p.window = FilterWindow::circle;
       }},
      {"BilateralParams.sigma_range is -1; expected 0..inf", [](auto& p) { p.sigma_range = -1; }},
      {"BilateralParams.sigma_range is nan; expected 0..inf", [=](auto& p) { p.sigma_range = nan; }},
      {"BilateralParams.format is u32; expected f32x1, f32x2, f32x4, f16x4 or unorm8x4",
       [](auto& p) { p.format = Format::u32; }},
      {"BilateralParams.guide_format is f16x2; expected f32x1, f32x2, f32x4, f16x4 or unorm8x4",
       [](auto& p) {
         p.range = RangeTerm::guide;
         p.guide_format = Format::f16x2;
       }},
      {"BilateralParams.sigma_depth is 0; expected 1e-06..1e+06",
       [](auto& p) {
         p.depth = DepthTerm::plane;
         p.sigma_depth = 0;
       }},
      {"BilateralParams.footprint is nan; expected 1e-09..1000",
       [=](auto& p) {
         p.depth = DepthTerm::plane;
         p.footprint = nan;
       }},
      {"BilateralParams.sigma_normal is 0; expected 0.01..4096",
       [](auto& p) {
         p.normal = true;
         p.sigma_normal = 0;
       }},
      {"BilateralParams.normal_format is f32x1; expected f32x4, f16x4 or unorm8x4",
       [](auto& p) {
         p.normal = true;
         p.normal_format = Format::f32x1;
       }},
      {"BilateralParams.sigma_luminance is 0; expected 1e-06..1e+06",
       [](auto& p) {
         p.luminance = true;
         p.sigma_luminance = 0;
       }},
      {"BilateralParams.epsilon is 0; expected 1e-30..1e+30",
       [](auto& p) {
         p.luminance = true;
         p.epsilon = 0;
       }},
      {"BilateralParams.variance_target is 0.1; expected 0 without luminance",
       [](auto& p) { p.variance_target = 0.1; }},
      {"BilateralParams.variance_target is -1; expected 0..1e+30",
       [](auto& p) {
         p.luminance = true;
         p.variance_target = -1;
       }},
      {"BilateralParams.flat is 0.6; expected 0..0.5", [](auto& p) { p.flat = 0.6; }},
      {"BilateralParams.flat is 0.1; expected 0 but for variant direct, a square window, step 1, depth off or plane",
       [](auto& p) {
         p.flat = 0.1;
         p.window = FilterWindow::circle;
       }},
      {"BilateralParams.carry_variance is true; expected false but for variant atrous with luminance",
       [](auto& p) { p.carry_variance = true; }},
      {"BilateralParams.border is 9; expected 0..3", [](auto& p) { p.border = static_cast<Border>(9); }},
      {"BilateralParams.alpha is true; expected false for a format of fewer than four channels",
       [](auto& p) {
         p.alpha = true;
         p.format = Format::f32x1;
       }},
      {"BilateralParams.height is 65535; expected stride x height of at most 134217727",
       [](auto& p) { p.width = p.height = 65535; }},
  };
  BilateralParams good;
  good.width = 64;
  good.height = 48;
  EXPECT_TRUE(validate(good).ok()) << validate(good).message();
  for (const Refusal& refusal : refusals) {
    BilateralParams p = good;
    refusal.spoil(p);
    EXPECT_EQ(validate(p).message(), refusal.message);
    EXPECT_EQ(validate(p).code(), Code::invalid_argument);
    for (const char* device : {"reference", "pocl", "lavapipe", "gpu"})
      EXPECT_EQ(plan(p, profile(device)).status().message(), refusal.message) << "the same verdict for " << device;
  }
}

// Nothing is written past an end: every variant and format, with rows longer than the image.
TEST(BilateralSmall, EveryVariantKeepsWithinItsBuffers) {
  for (const BilateralVariant variant :
       {BilateralVariant::direct, BilateralVariant::separable, BilateralVariant::atrous})
    for (const Format format : {Format::f32x1, Format::f32x4, Format::unorm8x4}) {
      BilateralParams p = cases::bilateral_params(19, 7, "cl", format);
      p.variant = variant;
      p.radius = 2;
      p.levels = 2;
      p.carry_variance = variant == BilateralVariant::atrous;
      p.dst_stride = 23;
      const std::vector<float> picture(static_cast<std::size_t>(19) * 7 * channels(format), 0.5f),
          variance(19 * 7, 0.1f);
      for (const std::string& device : test_devices()) {
        Context& context = test_context(device);
        const std::vector<Bytes> got =
            run_bytes(context, plan(p, context.profile()).value(),
                      {{"src", encode(format, picture)}, {"variance", encode(Format::f32x1, variance)}}, {"dst"});
        EXPECT_NEAR(decode_at(format, got.at(0), 0), 0.5, 1.0 / 255) << device;
      }
    }
}

// The form of whole texels, on devices that do not choose it too, and the pass that marks guides.
TEST(BilateralSmall, PackedAndMarkedKeepWithinTheirBuffers) {
  for (const std::string terms : {"c", "g", "gd"}) {
    BilateralParams p = cases::bilateral_params(19, 7, terms, Format::f32x4);
    p.radius = 1;  // more is unrolled, and takes PoCL long to compile
    p.sigma_space = 1;
    p.dst_stride = 23;
    const cases::BilateralImages images = cases::bilateral_images(p, 31);
    const auto floats = [](const cases::Values& v) { return std::vector<float>(v.begin(), v.end()); };
    for (const std::string& device : test_devices()) {
      Context& context = test_context(device);
      if (context.info().api == Api::cpu) continue;  // plans of another profile are refused
      NamedBytes inputs{{"src", encode(p.format, floats(images.src))}};
      if (terms != "c") inputs.emplace_back("guide", encode(p.guide_format, floats(images.guide)));
      if (terms == "gd") inputs.emplace_back("depth", encode(Format::f32x1, floats(images.depth)));
      const Plan plan = luxel::plan(p, profile("lavapipe")).value();
      const auto has = [&](std::string_view label) {
        return std::any_of(plan.passes.begin(), plan.passes.end(), [&](const Pass& pass) { return pass.label == label; });
      };
      EXPECT_EQ(has("bilateral pack"), terms != "gd");
      EXPECT_EQ(has("bilateral mark"), terms == "gd");
      const std::vector<Bytes> got = run_bytes(context, plan, inputs, {"dst"});
      const cases::Values expected = truth::bilateral(p, images).src;
      for (int i = 0; i < 19 * 7; ++i)
        EXPECT_NEAR(decode_at(p.format, got.at(0), 4 * (i / 19 * 23 + i % 19)), expected[4 * i], 1e-5) << device << " " << i;
    }
  }
}

struct OpenCvOutput {
  const char* file;
  int d;
  double sigma_color, sigma_space;
};

TEST(BilateralOpenCv, EqualsItsOutputs) {
  // Both weigh a table of exp with linear interpolation between its entries: 4096 over the range of the picture, which
  // errs by up to 1e-7 of a weight, and sum in float.
  constexpr double tolerance = 1e-5;
  const OpenCvOutput outputs[] = {{"bilat_f32_camera_d5_c25_s2.npy", 5, 25.0 / 255, 2},
                                  {"bilat_f32_camera_d9_c50_s3.npy", 9, 50.0 / 255, 3},
                                  {"bilat_f32_camera_d15_c80_s5.npy", 15, 80.0 / 255, 5}};
  const auto input = io::read_npy(data("opencv_ref/in_camera.npy"));
  if (!input.ok()) GTEST_SKIP() << input.status().message();
  const std::vector<float> picture = io::to_float(input.value());
  for (const OpenCvOutput& output : outputs) {
    const auto read = io::read_npy(data(std::string("opencv_ref/") + output.file));
    ASSERT_TRUE(read.ok()) << read.status().message();
    const std::vector<float> truth = io::to_float(read.value());
    BilateralParams p;
    p.width = p.height = 256;
    p.format = Format::f32x1;
    p.radius = output.d / 2;
    p.sigma_space = output.sigma_space;
    p.sigma_range = output.sigma_color;
    p.window = FilterWindow::circle;
    p.range_norm = RangeNorm::l1;
    for (const std::string& device : test_devices()) {
      Context& context = test_context(device);
      const std::vector<Bytes> got =
          run_bytes(context, plan(p, context.profile()).value(), {{"src", encode(p.format, picture)}}, {"dst"});
      const std::vector<double> result = decode(p.format, got.at(0));
      EXPECT_LE(cases::max_difference(result, Values(truth.begin(), truth.end())), tolerance)
          << output.file << " on " << device;
    }
  }
}

}  // namespace
}  // namespace luxel

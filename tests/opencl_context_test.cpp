// The small layer on OpenCL and on C++: what it lists, opens and refuses, and that both give the same bits.
#if LUXEL_OPENCL
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include <luxel/gaussian_blur.h>

#include "host/opencl/context.h"
#include "host/reference/context.h"

namespace luxel {
namespace {

GaussianBlurParams blur_params(Input input, Format format = Format::f32x4) {
  GaussianBlurParams params;
  params.width = 53;
  params.height = 31;
  params.sigma = 1.5;
  params.input = input;
  params.format = format;
  return params;
}

std::shared_ptr<Context> opencl_device() {
  const Result<std::shared_ptr<Context>> context = opencl::open(0);
  EXPECT_TRUE(context.ok()) << context.status().message();
  if (!context.ok()) std::exit(1);
  return context.value();
}

/// Uploads `input` to src, runs, and downloads dst.
std::vector<std::uint8_t> run(Context& context, const GaussianBlurParams& params,
                              const std::vector<std::uint8_t>& input, int repeat = 1, Times* times = nullptr) {
  const Result<Plan> made = plan(params, context.profile());
  EXPECT_TRUE(made.ok()) << made.status().message();
  const auto src = context.make(made.value().resources[0], 0), dst = context.make(made.value().resources[1], 0);
  const auto program = context.compile(made.value());
  EXPECT_TRUE(src.ok() && dst.ok()) << src.status().message() << dst.status().message();
  EXPECT_TRUE(program.ok()) << program.status().message();
  if (!src.ok() || !dst.ok() || !program.ok()) return {};
  EXPECT_TRUE(context.upload(*src.value(), input.data(), input.size()).ok());
  std::vector<std::uint8_t> output(input.size());
  const std::vector<Named> names = {{"src", src.value()}, {"dst", dst.value()}};
  const Status status = context.run_many(*program.value(), names, repeat, times);
  EXPECT_TRUE(status.ok()) << status.message();
  EXPECT_TRUE(context.download(*dst.value(), output.data(), output.size()).ok());
  return output;
}

std::vector<std::uint8_t> picture(const GaussianBlurParams& params) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(params.width) * static_cast<std::size_t>(params.height) *
                                  bytes_per_pixel(params.format));
  if (params.format == Format::unorm8x4) {
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 2654435761u >> 11);
    return bytes;
  }
  auto* values = reinterpret_cast<float*>(bytes.data());
  for (std::size_t i = 0; i < bytes.size() / 4; ++i) values[i] = std::sin(static_cast<float>(i) * 0.7f);
  return bytes;
}

TEST(OpenClContext, ListsWhatItOpens) {
  std::string problem = "stale";
  const std::vector<DeviceInfo> infos = opencl::list(&problem);
  EXPECT_EQ(problem, "");
  ASSERT_FALSE(infos.empty());
  for (std::size_t i = 0; i < infos.size(); ++i) {
    EXPECT_EQ(infos[i].index, static_cast<int>(i));
    EXPECT_EQ(infos[i].api, Api::opencl);
    EXPECT_EQ(infos[i].id, "opencl:" + infos[i].name);
    EXPECT_FALSE(infos[i].driver.empty());
  }
  const auto context = opencl_device();
  EXPECT_EQ(context->info().name, infos[0].name);
  EXPECT_EQ(context->profile().name, infos[0].profile);
  EXPECT_FALSE(context->real64());
  const Status missing = opencl::open(static_cast<int>(infos.size())).status();
  EXPECT_EQ(missing.code(), Code::missing_driver);
  EXPECT_EQ(missing.message(), "OpenCL device " + std::to_string(infos.size()) + " does not exist; expected 0.." +
                                   std::to_string(infos.size() - 1));
  EXPECT_EQ(opencl::open(-1).status().code(), Code::missing_driver);
}

// The loader reads its folder of drivers once a process, hence a process of its own.
TEST(OpenClContextDeathTest, MissingDriverSaysWhatToInstall) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        setenv("OCL_ICD_VENDORS", "/nonexistent/", 1);
        unsetenv("OCL_ICD_FILENAMES");
        std::string problem;
        const bool none = opencl::list(&problem).empty();
        const Status status = opencl::open(0).status();
        std::cerr << problem;
        std::exit(none && status.code() == Code::missing_driver && status.message() == problem ? 0 : 1);
      },
      testing::ExitedWithCode(0),
      "^OpenCL: no OpenCL driver is installed; install a driver for your GPU, or one that runs on this CPU "
      ".Debian: apt-get install pocl-opencl-icd.$");
}

TEST(OpenClContext, GivesTheBitsOfTheCppExecution) {
  const auto device = opencl_device();
  const auto cpp = reference::open(0).value();
  for (const Input input : {Input::buffer, Input::image}) {
    for (const Format format : {Format::f32x1, Format::f32x4, Format::unorm8x4}) {
      const GaussianBlurParams params = blur_params(input, format);
      const std::vector<std::uint8_t> pixels = picture(params);
      EXPECT_EQ(run(*device, params, pixels), run(*cpp, params, pixels))
          << name(format) << (input == Input::image ? " image" : " buffer");
    }
  }
}

TEST(OpenClContext, ManyRunsGiveTheResultOfOneAndTheirTimes) {
  const auto device = opencl_device();
  const GaussianBlurParams params = blur_params(Input::buffer);
  const std::vector<std::uint8_t> pixels = picture(params);
  Times one, many;
  const std::vector<std::uint8_t> once = run(*device, params, pixels, 1, &one);
  EXPECT_EQ(run(*device, params, pixels, 20, &many), once);
  ASSERT_EQ(one.passes.size(), 2u);
  ASSERT_EQ(many.passes.size(), 2u);
  for (const Times& times : {one, many}) {
    EXPECT_GT(times.passes[0], 0.0);
    EXPECT_GT(times.passes[1], 0.0);
    EXPECT_LE(times.passes[0] + times.passes[1], times.total);
  }
}

TEST(OpenClContext, ImagesComeBackAsTheyWent) {
  const auto device = opencl_device();
  for (const Format format : {Format::f32x1, Format::f32x4, Format::f16x4, Format::unorm8x4}) {
    for (const int depth : {1, 3}) {
      Resource resource{"picture", ResourceKind::image, format};
      resource.extent = {7, 5, depth};
      const auto memory = device->make(resource, 0);
      ASSERT_TRUE(memory.ok()) << memory.status().message();
      std::vector<std::uint8_t> bytes(static_cast<std::size_t>(35 * depth) * bytes_per_pixel(format));
      std::vector<std::uint8_t> back(bytes.size());
      for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i % 60);
      ASSERT_TRUE(device->upload(*memory.value(), bytes.data(), bytes.size()).ok());
      ASSERT_TRUE(device->download(*memory.value(), back.data(), back.size()).ok());
      EXPECT_EQ(bytes, back) << name(format) << ", depth " << depth;
      EXPECT_EQ(device->upload(*memory.value(), bytes.data(), bytes.size() - 1).code(), Code::invalid_argument);
    }
  }
}

/// What both contexts refuse.
class Refusals : public testing::TestWithParam<bool> {};

TEST_P(Refusals, ForeignMissingAndMisfittingThings) {
  const auto open = [] { return GetParam() ? opencl_device() : reference::open(0).value(); };
  const auto context = open(), other = open();
  const Plan blur = plan(blur_params(Input::buffer), context->profile()).value();
  const auto program = context->compile(blur).value();
  const auto src = context->make(blur.resources[0]).value(), dst = context->make(blur.resources[1]).value(),
             foreign = other->make(blur.resources[1]).value();
  const auto refused = [&](Status status, const std::string& message) {
    EXPECT_EQ(status.code(), Code::invalid_argument);
    EXPECT_EQ(status.message(), message);
  };
  refused(context->run(*program, {{"src", src}, {"dst", foreign}}),
          "gaussian_blur: binding dst belongs to another device");
  refused(context->run(*program, {{"src", src}, {"dst", nullptr}}), "gaussian_blur: binding dst has no memory");
  EXPECT_EQ(context->run(*program, {{"src", src}}).code(), Code::invalid_argument);
  EXPECT_EQ(context->run(*program, {{"src", src}, {"dst", dst}, {"more", dst}}).code(), Code::invalid_argument);
  refused(context->run_many(*program, {{"src", src}, {"dst", dst}}, 0, nullptr),
          "gaussian_blur: repeat is 0; expected at least 1");
  EXPECT_EQ(other->run(*program, {{"src", src}, {"dst", dst}}).code(), Code::invalid_argument);
  std::vector<std::uint8_t> bytes(blur.resources[1].bytes + 1);
  EXPECT_EQ(context->upload(*dst, bytes.data(), bytes.size()).code(), Code::invalid_argument);
  EXPECT_EQ(context->download(*foreign, bytes.data(), 4).code(), Code::invalid_argument);

  Resource resource{"small", ResourceKind::buffer, Format::f32x4, 16};
  const auto small = context->make(resource).value();
  const std::string need = std::to_string(blur.resources[1].bytes);
  refused(context->run(*program, {{"src", src}, {"dst", small}}),
          "gaussian_blur: binding dst has 16 bytes; needs at least " + need);
  resource.kind = ResourceKind::image;
  const auto image = context->make(resource).value();
  refused(context->run(*program, {{"src", image}, {"dst", dst}}),
          "gaussian_blur: binding src is an image; expected a buffer");
  resource.extent = {0, 1, 1};
  refused(context->make(resource).status(), "Resource.extent of small has a side of 0; expected at least 1");
  EXPECT_TRUE(context->run(*program, {{"src", src}, {"dst", dst}}).ok()) << "still usable after every refusal";
}

INSTANTIATE_TEST_SUITE_P(Apis, Refusals, testing::Bool(),
                         [](const auto& info) { return info.param ? "opencl" : "cpp"; });

TEST(CppContext, ListsFloatAndDouble) {
  std::string problem = "stale";
  const std::vector<DeviceInfo> infos = reference::list(&problem);
  EXPECT_EQ(problem, "");
  ASSERT_EQ(infos.size(), 2u);
  EXPECT_EQ(infos[0].id, "cpu:float");
  EXPECT_EQ(infos[1].name, "C++ double");
  EXPECT_FALSE(reference::open(0).value()->real64());
  EXPECT_TRUE(reference::open(1).value()->real64());
  EXPECT_EQ(reference::open(2).status().code(), Code::missing_driver);
}

TEST(CppContext, DoubleTakesAndGivesDoubles) {
  const auto context = reference::open(1).value();
  const GaussianBlurParams params = blur_params(Input::buffer, Format::unorm8x4);
  const std::size_t values = static_cast<std::size_t>(params.width * params.height * 4);
  const std::vector<double> input(values, 0.12345678901234567);
  std::vector<std::uint8_t> bytes(values * sizeof(double));
  std::memcpy(bytes.data(), input.data(), bytes.size());
  const std::vector<std::uint8_t> output = run(*context, params, bytes);
  ASSERT_EQ(output.size(), bytes.size());
  for (std::size_t i = 0; i < values; ++i) {
    double value = 0;
    std::memcpy(&value, output.data() + i * sizeof value, sizeof value);
    ASSERT_NEAR(value, input[i], 1e-15) << "the weights sum to 1 within double rounding";
  }
}

}  // namespace
}  // namespace luxel
#endif

// mip_build: the formulas against reductions in double on every execution, forms that give the same bits, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "bench/truth/mip_truth.h"
#include "host/module.h"
#include "tests/support/pyramid.h"

namespace luxel {
namespace {

// Largest error in units of the format's last place, of the truth or of `scale` if that is larger.
double worst(const Bytes& level, const truth::Level& truth, Format format, bool real64, double scale) {
  const std::vector<double> values = decode(format, level, real64);
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error =
        std::fabs(values[i] - truth.values[i]) / step(format, std::max(std::fabs(truth.values[i]), scale));
    if (!(error <= most)) most = error;
  }
  return values.size() == truth.values.size() ? most : nan;
}

// Against the truth in units of the last place of the values' full scale (1 for colour; the value itself for distances).
// A level rounds by storage once (half a unit) and by arithmetic a few times in f32; errors of finer levels are averaged.
constexpr double f32_units_a_level = 4;
constexpr double storage_units_a_level = 0.5 + 1e-3;  // f16, unorm8: f32 arithmetic hardly counts
// Compositing carries the error of a front voxel to what lies behind: at most 3 times a level, measured below 1.3.
constexpr double directional_f32_units_a_level = 12;
constexpr double directional_storage_units_a_level = 1.5;
// The double execution against the truth: the same formula, other order; odd extents of anisotropic have a series that
// stops at 1e-10.
constexpr double double_bound = 1e-13;
constexpr double double_bound_layers = 1e-9;

void check_formula(const MipBuildParams& p) {
  ASSERT_TRUE(validate(p)) << validate(p).message();
  const Format finest = finest_format(p);
  const Bytes level_0 = encode(finest, level_0_values(p));
  const std::vector<double> exact = decode(finest, level_0);
  std::map<int, std::vector<truth::Level>> truths;
  for (const std::string& name : level_names(p))
    if (const int d = direction_of(name); !truths.contains(d)) truths[d] = truth::pyramid(p, exact, d);

  const bool directional = p.variant == MipVariant::anisotropic;
  const bool depth = p.variant >= MipVariant::min;
  const bool f32 = bytes_per_pixel(p.format) == 4 * static_cast<std::size_t>(channels(p.format));
  const double units = f32 ? (directional ? directional_f32_units_a_level : f32_units_a_level)
                           : (directional ? directional_storage_units_a_level : storage_units_a_level);
  const bool bounds = depth && p.variant != MipVariant::moments;

  const Levels oracle =
      build_levels(test_context("cpu:double"), p, encode(finest, std::vector<float>(exact.begin(), exact.end()), true));
  for (const auto& [name, bytes] : oracle) {
    const truth::Level& truth = truths.at(direction_of(name))[level_of(name)];
    const std::vector<double> values = decode(p.format, bytes, true);
    ASSERT_EQ(values.size(), truth.values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_LE(std::fabs(values[i] - truth.values[i]),
                (directional ? double_bound_layers : double_bound) * std::max(1.0, truth.values[i]))
          << "cpu:double " << name << " value " << i;
  }

  const Levels cpu = build_levels(test_context("cpu"), p, level_0);
  for (const auto& [name, bytes] : cpu) {
    const int level = level_of(name);
    const truth::Level& truth = truths.at(direction_of(name))[level];
    const double most = worst(bytes, truth, p.format, false, depth ? 0.0 : 1.0);
    if (!bounds) {
      EXPECT_LE(most, units * level) << name;
    } else if (p.format != Format::f16x2) {
      EXPECT_EQ(most, 0) << name;
    }
    testing::Test::RecordProperty(name, std::to_string(most));
  }
  for (const std::string& device : test_devices())
    if (device != "cpu") expect_same(build_levels(test_context(device), p, level_0), cpu, device);
}

class Formula : public testing::TestWithParam<MipBuildParams> {};
TEST_P(Formula, MatchesTheTruthAndEveryDeviceAlike) { check_formula(GetParam()); }

// The quick suite has every variant, format and kind of extent once; the full one has them together.
std::vector<MipBuildParams> formulas(bool full) {
  std::vector<MipBuildParams> all;
  using Extents = std::vector<std::array<int, 3>>;
  const auto add = [&](MipVariant v, Format f, const Extents& extents, auto change) {
    for (const auto& e : extents) {
      MipBuildParams p = params(v, f, e);
      change(p);
      all.push_back(p);
    }
  };
  const auto as_is = [](MipBuildParams&) {};
  const auto vertices = [](MipBuildParams& p) { p.samples = MipSamples::vertices; };
  const auto pairs = [](MipBuildParams& p) { p.pairs = true; };
  for (const Format f : colour_formats) {
    const bool some = (f == Format::f32x4) != full;
    add(MipVariant::isotropic, f, some ? Extents{{16, 16, 16}, {13, 7, 5}, {1, 9, 4}, {64, 33, 1}} : Extents{{17, 8, 9}}, as_is);
    add(MipVariant::anisotropic, f, some ? Extents{{16, 16, 16}, {9, 8, 7}, {1, 6, 5}, {12, 9, 1}} : Extents{{7, 4, 5}}, as_is);
    add(MipVariant::gaussian3, f, some ? Extents{{16, 8, 4}, {11, 6, 9}, {1, 19, 3}, {32, 27, 1}} : Extents{{10, 9, 4}}, as_is);
    add(MipVariant::gaussian3, f, some ? Extents{{17, 9, 5}, {3, 1, 33}, {33, 5, 1}} : Extents{{9, 9, 9}}, vertices);
  }
  add(MipVariant::isotropic, Format::f32x1, full ? Extents{{31, 17, 3}} : Extents{{40, 1, 1}}, as_is);
  add(MipVariant::gaussian3, Format::f32x1, full ? Extents{{15, 30, 1}} : Extents{{16, 6, 1}}, as_is);
  const Extents flat = full ? Extents{{64, 48, 1}, {1, 31, 1}, {127, 2, 1}} : Extents{{37, 53, 1}};
  for (const MipSizes sizes : {MipSizes::floor, MipSizes::ceil})
    for (const int ratio : {2, 16}) {
      const auto change = [&](MipBuildParams& p) { p.sizes = sizes, p.ratio = ratio; };
      add(MipVariant::min, Format::f32x1, flat, change);
      add(MipVariant::max, Format::f32x1, flat, change);
      for (const Format f : {Format::f32x2, Format::f16x2}) {
        add(MipVariant::minmax, f, flat, change);
        add(MipVariant::minmax, f, flat, [&](MipBuildParams& p) { change(p), pairs(p); });
      }
    }
  for (const Format f : {Format::f32x2, Format::f16x2}) {
    add(MipVariant::moments, f, flat, as_is);
    add(MipVariant::moments, f, flat, pairs);
  }
  return all;
}

std::string test_name(const testing::TestParamInfo<MipBuildParams>& info) { return text(info.param); }

class FormulaFull : public Formula {};
TEST_P(FormulaFull, MatchesTheTruthAndEveryDeviceAlike) { check_formula(GetParam()); }

INSTANTIATE_TEST_SUITE_P(MipBuild, Formula, testing::ValuesIn(formulas(false)), test_name);
INSTANTIATE_TEST_SUITE_P(MipBuild, FormulaFull, testing::ValuesIn(formulas(true)), test_name);

bool has_pass(const MipBuildParams& p, Profile profile, bool tiled, std::string_view part) {
  profile.workgroup_memory = tiled;
  const Result<Plan> made = plan(p, profile);
  if (!made) return false;
  return std::any_of(made.value().passes.begin(), made.value().passes.end(),
                     [&](const Pass& pass) { return pass.module->part == part; });
}

TEST(MipBuild, ThreeLevelsADispatchGiveTheSameBits) {
  std::vector<MipBuildParams> all;
  for (const Format f : {Format::f32x4, Format::f16x4, Format::unorm8x4, Format::f32x1})
    for (const auto e : {std::array{32, 16, 24}, {64, 1, 8}, {16, 2, 1}, {1, 48, 1}, {8, 2, 1}})
      all.push_back(params(MipVariant::isotropic, f, e));
  for (const auto e : {std::array{37, 53, 1}, {64, 48, 1}, {1, 100, 1}, {257, 3, 1}})
    for (const MipVariant v : {MipVariant::min, MipVariant::max, MipVariant::minmax})
      for (const Format f :
           v == MipVariant::minmax ? std::vector{Format::f32x2, Format::f16x2} : std::vector{Format::f32x1}) {
        MipBuildParams p = params(v, f, e);
        p.sizes = MipSizes::ceil;
        all.push_back(p);
        if (e[0] == 64) p.sizes = MipSizes::floor, all.push_back(p);
        if (e[0] == 64 && v == MipVariant::minmax) p.pairs = true, all.push_back(p);
      }
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (MipBuildParams p : all) {
    std::string_view part = p.variant == MipVariant::isotropic ? "mip_average_tile" : "mip_bounds_tile";
    for (const Input input : {Input::buffer, Input::image}) {
      p.input = input;
      for (const std::string& device : devices) {
        Context& context = test_context(device);
        if (!supported(context, p)) continue;
        ASSERT_TRUE(has_pass(p, context.profile(), true, part)) << text(p);
        ASSERT_FALSE(has_pass(p, context.profile(), false, part)) << text(p);
        const Bytes level_0 = encode(finest_format(p), level_0_values(p), context.real64());
        expect_same(build_levels(context, p, level_0, true), build_levels(context, p, level_0, false),
                    device + " " + text(p));
      }
    }
  }
}

TEST(MipBuild, AnOddStepIsLeftToThePlainForm) {
  const Profile gpu = profile("gpu");
  EXPECT_FALSE(has_pass(params(MipVariant::isotropic, Format::f32x4, {12, 8, 8}), gpu, true, "mip_average_tile"));
  EXPECT_TRUE(has_pass(params(MipVariant::isotropic, Format::f32x4, {12, 8, 8}), gpu, true, "mip_average"));
  EXPECT_FALSE(has_pass(params(MipVariant::min, Format::f32x1, {31, 15, 1}), gpu, true, "mip_bounds_tile"));
}

TEST(MipBuild, ImagesAndBuffersGiveTheSameBits) {
  std::vector<MipBuildParams> all;
  for (const Format f : {Format::f32x4, Format::f16x4, Format::unorm8x4})
    for (const auto e : {std::array{20, 14, 6}, {21, 13, 1}})
      for (const MipVariant v : {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3})
        all.push_back(params(v, f, e));
  all.push_back(params(MipVariant::isotropic, Format::f32x1, {20, 14, 6}));
  all.push_back(params(MipVariant::isotropic, Format::f32x1, {21, 13, 1}));
  all.push_back(params(MipVariant::min, Format::f32x1, {21, 13, 1}));
  all.push_back(params(MipVariant::max, Format::f32x1, {21, 13, 1}));
  for (const Format f : {Format::f32x2, Format::f16x2})
    for (const bool pairs : {false, true})
      for (const MipVariant v : {MipVariant::minmax, MipVariant::moments}) {
        all.push_back(params(v, f, {21, 13, 1}));
        all.back().pairs = pairs;
      }
  for (MipBuildParams p : all) {
    const Bytes level_0 = encode(finest_format(p), level_0_values(p));
    const Levels expected = build_levels(test_context("cpu"), p, level_0);
    p.input = Input::image;
    for (const std::string& device : test_devices()) {
      Context& context = test_context(device);
      if (supported(context, p)) expect_same(build_levels(context, p, level_0), expected, device + " " + text(p));
    }
  }
}

TEST(MipBuild, WhatIsLeftOutDoesNotChangeTheRest) {
  MipBuildParams p = params(MipVariant::anisotropic, Format::f32x4, {16, 12, 8});
  const Bytes level_0 = encode(p.format, level_0_values(p));
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Levels whole = build_levels(context, p, level_0);
    for (const unsigned directions : {1u, 2u, 12u, 48u, 21u}) {
      MipBuildParams some = p;
      some.directions = directions;
      const Result<Plan> made = plan(some, context.profile());
      ASSERT_TRUE(made.ok());
      EXPECT_EQ(made.value().resources.size(), 1u + 4 * static_cast<unsigned>(__builtin_popcount(directions)));
      for (const auto& [name, bytes] : build_levels(context, some, level_0))
        EXPECT_EQ(bytes, whole.at(name)) << device << " " << name;
    }
    for (int levels = 1; levels < 4; ++levels) {
      MipBuildParams some = p;
      some.levels = levels;
      const Levels built = build_levels(context, some, level_0);
      EXPECT_EQ(built.size(), 6u * static_cast<unsigned>(levels));
      for (const auto& [name, bytes] : built) EXPECT_EQ(bytes, whole.at(name)) << device << " " << name;
    }
  }
}

TEST(MipBuild, DirectionsAndLevelsLeftOutCostNothing) {
  const Profile any = profile("reference");
  MipBuildParams p = params(MipVariant::anisotropic, Format::f16x4, {64, 64, 64});
  const Plan whole = plan(p, any).value();
  EXPECT_EQ(whole.passes.size(), 1u + 6 * 5);
  p.directions = mip_px;
  const Plan one = plan(p, any).value();
  EXPECT_EQ(one.passes.size(), 6u);
  EXPECT_LT(one.bytes, whole.bytes);
  EXPECT_EQ(one.scratch_bytes, 0u);
  p.levels = 2;
  EXPECT_EQ(plan(p, any).value().passes.size(), 2u);
  p = params(MipVariant::isotropic, Format::f16x4, {64, 64, 64});
  EXPECT_EQ(plan(p, any).value().passes.size(), 6u);
  EXPECT_EQ(plan(p, profile("gpu")).value().passes.size(), 2u);
}

// The finest level is shared, so the six volumes take 1 + 6/7 of the isotropic pyramid's 1 + 1/7: 13/8.
TEST(MipBuild, SixDirectionsTakeThirteenEighthsOfTheIsotropicPyramid) {
  const auto bytes = [](MipVariant v) {
    double sum = 0;
    const Result<Plan> made = plan(params(v, Format::f32x4, {256, 256, 256}), profile("reference"));
    for (const Resource& r : made.value().resources) sum += static_cast<double>(r.bytes);
    return sum;
  };
  EXPECT_NEAR(bytes(MipVariant::anisotropic) / bytes(MipVariant::isotropic), 13.0 / 8, 1e-6);
}

struct Refusal {
  std::function<void(MipBuildParams&)> change;
  std::string message;
};

TEST(MipBuild, RefusesWithFieldValueAndRange) {
  const MipBuildParams good = params(MipVariant::isotropic, Format::f32x4, {16, 16, 16});
  ASSERT_TRUE(validate(good));
  const std::vector<Refusal> refusals = {
      {[](auto& p) { p.width = 0; }, "MipBuildParams.width is 0; expected 1..65535"},
      {[](auto& p) { p.height = -3; }, "MipBuildParams.height is -3; expected 1..65535"},
      {[](auto& p) { p.depth = 65536; }, "MipBuildParams.depth is 65536; expected 1..65535"},
      {[](auto& p) { p.width = p.height = 65535; },
       "MipBuildParams.height is 65535; expected width x height x depth x channels of at most 2147483647"},
      {[](auto& p) { p.width = p.height = p.depth = 1; },
       "MipBuildParams.width is 1; expected a level 0 of more than one texel"},
      {[](auto& p) { p.levels = 5; }, "MipBuildParams.levels is 5; expected 0..4"},
      {[](auto& p) { p.levels = -1; }, "MipBuildParams.levels is -1; expected 0..4"},
      {[](auto& p) { p.format = Format::u32; },
       "MipBuildParams.format is u32; expected f32x1, f32x4, f16x4 or unorm8x4 for variant isotropic"},
      {[](auto& p) { p.variant = MipVariant::anisotropic, p.format = Format::f32x1; },
       "MipBuildParams.format is f32x1; expected f32x4, f16x4 or unorm8x4 for variant anisotropic"},
      {[](auto& p) {
         p.variant = MipVariant::min;
         p.depth = 1;
       },
       "MipBuildParams.format is f32x4; expected f32x1 for variant min"},
      {[](auto& p) {
         p.variant = MipVariant::moments;
         p.depth = 1;
       },
       "MipBuildParams.format is f32x4; expected f32x2 or f16x2 for variant moments"},
      {[](auto& p) {
         p.variant = MipVariant::minmax;
         p.format = Format::f32x2;
       },
       "MipBuildParams.depth is 16; expected 1 for variant minmax"},
      {[](auto& p) { p.pairs = true; }, "MipBuildParams.pairs is true; expected false for variant isotropic"},
      {[](auto& p) { p.sizes = MipSizes::ceil; }, "MipBuildParams.sizes is ceil; expected floor for variant isotropic"},
      {[](auto& p) { p.ratio = 16; }, "MipBuildParams.ratio is 16; expected 2 for variant isotropic"},
      {[](auto& p) { p.ratio = 3, p.variant = MipVariant::max, p.format = Format::f32x1, p.depth = 1; },
       "MipBuildParams.ratio is 3; expected 2 or 16 for variant max"},
      {[](auto& p) { p.ratio = 16, p.variant = MipVariant::max, p.format = Format::f32x1, p.depth = 1, p.levels = 2; },
       "MipBuildParams.levels is 2; expected 0..1"},
      {[](auto& p) { p.samples = MipSamples::vertices; },
       "MipBuildParams.samples is vertices; expected cells for variant isotropic"},
      {[](auto& p) { p.variant = MipVariant::gaussian3, p.samples = MipSamples::vertices; },
       "MipBuildParams.width is 16; expected an extent that is odd, 1 or 2 at every level that is halved (samples on "
       "vertices); level 0 has 16"},
      {[](auto& p) {
         p.variant = MipVariant::gaussian3, p.samples = MipSamples::vertices, p.width = 11, p.height = p.depth = 9;
       },
       "MipBuildParams.width is 11; expected an extent that is odd, 1 or 2 at every level that is halved (samples on "
       "vertices); level 1 has 6; or MipBuildParams.levels of 1..1"},
      {[](auto& p) { p.directions = 3; }, "MipBuildParams.directions is 3; expected 63 for variant isotropic"},
      {[](auto& p) { p.variant = MipVariant::anisotropic, p.directions = 0; },
       "MipBuildParams.directions is 0; expected 1..63"},
      {[](auto& p) { p.variant = MipVariant::anisotropic, p.directions = 64; },
       "MipBuildParams.directions is 64; expected 1..63"},
      {[](auto& p) { p.count = true, p.format = Format::unorm8x4; },
       "MipBuildParams.count is true; expected false for unorm8x4, which holds neither NaN nor infinities"},
      {[](auto& p) { p.variant = static_cast<MipVariant>(7); }, "MipBuildParams.variant is 7; expected 0..6"},
      {[](auto& p) { p.input = static_cast<Input>(-1); }, "MipBuildParams.input is -1; expected 0..1"},
      {[](auto& p) { p.sizes = static_cast<MipSizes>(2); }, "MipBuildParams.sizes is 2; expected 0..1"},
      {[](auto& p) { p.samples = static_cast<MipSamples>(9); }, "MipBuildParams.samples is 9; expected 0..1"},
      {[](auto& p) { p.format = static_cast<Format>(77); },
       "MipBuildParams.format is unknown; expected f32x1, f32x4, f16x4 or unorm8x4 for variant isotropic"},
  };
  for (const Refusal& refusal : refusals) {
    MipBuildParams p = good;
    refusal.change(p);
    const Status status = validate(p);
    EXPECT_EQ(status.code(), Code::invalid_argument) << refusal.message;
    EXPECT_EQ(status.message(), refusal.message);
    for (const char* device : {"pocl", "lavapipe", "gpu", "reference"})
      EXPECT_EQ(plan(p, profile(device)).status().message(), refusal.message);
  }
}

}  // namespace
}  // namespace luxel

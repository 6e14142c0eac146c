// mip_build against reductions in double, on every execution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>

#include "bench/truth/mip_truth.h"
#include "host/module.h"
#include "tests/support/pyramid.h"

namespace luxel {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// A hash, so that numbers are the same with every standard library.
std::uint32_t mixed(std::uint32_t v) {
  v ^= v >> 16;
  v *= 0x7feb352du;
  v ^= v >> 15;
  v *= 0x846ca68bu;
  return v ^ (v >> 16);
}
float uniform(std::uint32_t i) { return static_cast<float>(mixed(i) >> 8) * 0x1p-24f; }

// Premultiplied colour of all kinds: empty, opaque, in between, and emission without opacity.
// Dim enough that no sum in front of an opaque voxel saturates unorm8.
std::vector<float> colours(std::size_t texels, int channels, std::uint32_t seed = 1) {
  std::vector<float> values(texels * channels);
  for (std::size_t i = 0; i < texels; ++i) {
    const auto n = static_cast<std::uint32_t>(i) * 8 + seed * 0x9e3779b9u;
    const float kind = uniform(n + 7);
    const float a = kind < 0.3f ? 0.0f : kind < 0.5f ? 1.0f : uniform(n);
    for (int c = 0; c < channels; ++c) {
      const float v = uniform(n + 1 + c);
      values[i * channels + c] = channels < 4 ? v : c == 3 ? a : kind < 0.05f ? 0.1f * v : 0.8f * a * v;
    }
  }
  return values;
}

// Distances from 0.1 to 1000, and pairs of them: ordered bounds, or mean and standard deviation.
std::vector<float> distances(std::size_t texels, const MipBuildParams& p, std::uint32_t seed = 1) {
  std::vector<float> values;
  for (std::size_t i = 0; i < texels; ++i) {
    const auto n = static_cast<std::uint32_t>(i) * 4 + seed * 0x9e3779b9u;
    const float v = 0.1f * std::exp2(uniform(n) * 13.3f);
    values.push_back(v);
    if (channels(finest_format(p)) == 2) values.push_back(p.variant == MipVariant::minmax ? v * (1 + uniform(n + 1)) : v * uniform(n + 1));
  }
  return values;
}

std::vector<float> level_0_values(const MipBuildParams& p, std::uint32_t seed = 1) {
  const std::size_t count = texels(mip_extent(p, 0));
  const bool depth = p.variant >= MipVariant::min;
  return depth ? distances(count, p, seed) : colours(count, channels(p.format), seed);
}

MipBuildParams params(MipVariant variant, Format format, std::array<int, 3> extent) {
  MipBuildParams p;
  p.variant = variant;
  p.format = format;
  p.width = extent[0];
  p.height = extent[1];
  p.depth = extent[2];
  return p;
}

const char* text(MipVariant v) {
  constexpr const char* names[] = {"isotropic", "anisotropic", "gaussian3", "min", "max", "minmax", "moments"};
  return names[static_cast<int>(v)];
}

std::string text(const MipBuildParams& p) {
  std::string s = std::string(text(p.variant)).append("_").append(name(p.format)).append("_").append(std::to_string(p.width));
  s.append("x").append(std::to_string(p.height));
  if (p.depth > 1) s.append("x").append(std::to_string(p.depth));
  if (p.sizes == MipSizes::ceil) s += "_ceil";
  if (p.ratio == 16) s += "_ratio16";
  if (p.pairs) s += "_pairs";
  if (p.samples == MipSamples::vertices) s += "_vertices";
  if (p.input == Input::image) s += "_image";
  return s;
}

void expect_same(const Levels& a, const Levels& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (const auto& [name, bytes] : a) {
    const Bytes& other = b.at(name);
    ASSERT_EQ(bytes.size(), other.size()) << what << " " << name;
    const auto differ = std::mismatch(bytes.begin(), bytes.end(), other.begin()).first;
    EXPECT_EQ(differ, bytes.end()) << what << ": " << name << " differs first in byte " << differ - bytes.begin();
  }
}

int direction_of(const std::string& name) {
  for (int d = 0; d < 6; ++d)
    if (name.ends_with(mip_level_name(0, d).substr(7))) return d;
  return -1;
}
int level_of(const std::string& name) { return std::stoi(name.substr(6)); }

// Distance from |v| to the next larger value of a format.
double step(Format format, double v) {
  if (format == Format::unorm8x4) return 1.0 / 255;
  const bool half = format == Format::f16x2 || format == Format::f16x4;
  const int least = half ? -14 : -126, digits = half ? 10 : 23;
  return std::ldexp(1.0, std::max(v == 0 ? least : std::ilogb(v), least) - digits);
}

// Largest error in units of the format's last place, of the truth or of `scale` if that is larger.
double worst(const Bytes& level, const truth::Level& truth, Format format, bool real64, double scale) {
  const std::vector<double> values = decode(format, level, real64);
  double most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = std::fabs(values[i] - truth.values[i]) / step(format, std::max(std::fabs(truth.values[i]), scale));
    if (!(error <= most)) most = error;
  }
  return values.size() == truth.values.size() ? most : nan;
}

// --- The formulas, on every execution ---------------------------------------------------------------------------------

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

class Formula : public testing::TestWithParam<MipBuildParams> {};

TEST_P(Formula, MatchesTheTruthAndEveryDeviceAlike) {
  const MipBuildParams& p = GetParam();
  ASSERT_TRUE(validate(p)) << validate(p).message();
  const Format finest = finest_format(p);
  const Bytes level_0 = encode(finest, level_0_values(p));
  const std::vector<double> exact = decode(finest, level_0);
  std::map<int, std::vector<truth::Level>> truths;
  for (const std::string& name : level_names(p))
    if (const int d = direction_of(name); !truths.contains(d)) truths[d] = truth::pyramid(p, exact, d);

  const bool directional = p.variant == MipVariant::anisotropic;
  const bool depth = p.variant >= MipVariant::min;
  const double units = channels(p.format) && (p.format == Format::f32x1 || p.format == Format::f32x2 || p.format == Format::f32x4)
                           ? (directional ? directional_f32_units_a_level : f32_units_a_level)
                           : (directional ? directional_storage_units_a_level : storage_units_a_level);
  const bool bounds = depth && p.variant != MipVariant::moments;

  const Levels oracle = build_levels(test_context("cpu:double"), p, encode(finest, std::vector<float>(exact.begin(), exact.end()), true));
  for (const auto& [name, bytes] : oracle) {
    const truth::Level& truth = truths.at(direction_of(name))[level_of(name)];
    const std::vector<double> values = decode(p.format, bytes, true);
    ASSERT_EQ(values.size(), truth.values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_LE(std::fabs(values[i] - truth.values[i]), (directional ? double_bound_layers : double_bound) * std::max(1.0, truth.values[i]))
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
    RecordProperty(name, std::to_string(most));
  }
  for (const std::string& device : test_devices())
    if (device != "cpu") expect_same(build_levels(test_context(device), p, level_0), cpu, device);
}

std::vector<MipBuildParams> formulas() {
  std::vector<MipBuildParams> all;
  const auto add = [&](MipVariant v, Format f, std::array<int, 3> e, auto change) {
    MipBuildParams p = params(v, f, e);
    change(p);
    all.push_back(p);
  };
  const auto as_is = [](MipBuildParams&) {};
  constexpr Format four[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};
  for (const Format f : four) {
    for (const auto e : {std::array{16, 16, 16}, {17, 16, 9}, {13, 7, 5}, {1, 9, 4}, {64, 33, 1}})
      add(MipVariant::isotropic, f, e, as_is);
    for (const auto e : {std::array{16, 16, 16}, {9, 8, 7}, {1, 6, 5}, {12, 9, 1}}) add(MipVariant::anisotropic, f, e, as_is);
    for (const auto e : {std::array{16, 8, 4}, {11, 6, 9}, {1, 19, 3}, {32, 27, 1}}) add(MipVariant::gaussian3, f, e, as_is);
    for (const auto e : {std::array{17, 9, 5}, {3, 1, 33}, {33, 5, 1}})
      add(MipVariant::gaussian3, f, e, [](MipBuildParams& p) { p.samples = MipSamples::vertices; });
  }
  for (const Format f : {Format::f32x1, Format::f32x2}) {
    add(MipVariant::isotropic, f, {31, 17, 3}, as_is);
    add(MipVariant::isotropic, f, {40, 1, 1}, as_is);
    add(MipVariant::gaussian3, f, {15, 30, 1}, as_is);
  }
  for (const auto e : {std::array{64, 48, 1}, {37, 53, 1}, {1, 31, 1}, {127, 2, 1}}) {
    for (const MipSizes sizes : {MipSizes::floor, MipSizes::ceil})
      for (const int ratio : {2, 16}) {
        const auto change = [&](MipBuildParams& p) { p.sizes = sizes; p.ratio = ratio; };
        add(MipVariant::min, Format::f32x1, e, change);
        add(MipVariant::max, Format::f32x1, e, change);
        for (const Format f : {Format::f32x2, Format::f16x2}) {
          add(MipVariant::minmax, f, e, change);
          add(MipVariant::minmax, f, e, [&](MipBuildParams& p) { change(p); p.pairs = true; });
        }
      }
    for (const Format f : {Format::f32x2, Format::f16x2}) {
      add(MipVariant::moments, f, e, as_is);
      add(MipVariant::moments, f, e, [](MipBuildParams& p) { p.pairs = true; });
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(MipBuild, Formula, testing::ValuesIn(formulas()), [](const auto& info) { return text(info.param); });

// --- Forms and options that change the work, never the bits -----------------------------------------------------------

bool has_pass(const MipBuildParams& p, Profile profile, bool tiled, std::string_view part) {
  profile.workgroup_memory = tiled;
  const Result<Plan> made = plan(p, profile);
  if (!made) return false;
  return std::any_of(made.value().passes.begin(), made.value().passes.end(), [&](const Pass& pass) { return pass.module->part == part; });
}

TEST(MipBuild, ThreeLevelsADispatchGiveTheSameBits) {
  std::vector<MipBuildParams> all;
  for (const Format f : {Format::f32x4, Format::f16x4, Format::unorm8x4, Format::f32x1, Format::f32x2})
    for (const auto e : {std::array{32, 16, 24}, {64, 1, 8}, {16, 2, 1}, {1, 48, 1}, {8, 2, 1}}) all.push_back(params(MipVariant::isotropic, f, e));
  for (const auto e : {std::array{37, 53, 1}, {64, 48, 1}, {1, 100, 1}, {257, 3, 1}})
    for (const MipVariant v : {MipVariant::min, MipVariant::max, MipVariant::minmax})
      for (const Format f : v == MipVariant::minmax ? std::vector{Format::f32x2, Format::f16x2} : std::vector{Format::f32x1}) {
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
        ASSERT_TRUE(has_pass(p, context.profile(), true, part)) << text(p);
        ASSERT_FALSE(has_pass(p, context.profile(), false, part)) << text(p);
        const Bytes level_0 = encode(finest_format(p), level_0_values(p), context.real64());
        expect_same(build_levels(context, p, level_0, true), build_levels(context, p, level_0, false), device + " " + text(p));
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
      for (const MipVariant v : {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3}) all.push_back(params(v, f, e));
  for (const Format f : {Format::f32x1, Format::f32x2}) {
    all.push_back(params(MipVariant::isotropic, f, {20, 14, 6}));
    all.push_back(params(MipVariant::isotropic, f, {21, 13, 1}));
  }
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
    for (const std::string& device : test_devices()) expect_same(build_levels(test_context(device), p, level_0), expected, device + " " + text(p));
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
      for (const auto& [name, bytes] : build_levels(context, some, level_0)) EXPECT_EQ(bytes, whole.at(name)) << device << " " << name;
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

// --- Promises ---------------------------------------------------------------------------------------------------------

constexpr MipVariant colour_variants[] = {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3};
constexpr Format colour_formats[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};

// All devices, the plain and the tiled form, and level 0 as buffer and as image.
template <class F>
void on_every_way(MipBuildParams p, F f) {
  for (const std::string& device : test_devices())
    for (const Input input : {Input::buffer, Input::image})
      for (const bool tiled : {false, true}) {
        if (tiled && (p.variant == MipVariant::anisotropic || p.variant == MipVariant::gaussian3)) continue;
        p.input = input;
        SCOPED_TRACE(device + " " + text(p) + (tiled ? " tiled" : ""));
        f(test_context(device), p, tiled);
      }
}

TEST(MipBuild, ColourWithoutOpacityThatIsNotFiniteDoesNotLeak) {
  for (const MipVariant v : colour_variants)
    for (const Format f : {Format::f32x4, Format::f16x4})
      for (const auto e : {std::array{8, 8, 8}, {5, 7, 3}, {9, 4, 1}}) {
        MipBuildParams p = params(v, f, e);
        std::vector<float> clean = level_0_values(p);
        Bytes dirty = encode(f, clean);
        const std::uint32_t bad[] = {0x7fc00000u, 0x7f800000u, 0xff800000u, 0xffc00001u};
        const std::uint16_t bad_half[] = {0x7e00u, 0x7c00u, 0xfc00u, 0xfe01u};
        for (std::size_t i = 0; i < clean.size() / 4; i += 3)
          for (int c = 0; c < 4; ++c) {
            clean[i * 4 + c] = 0;
            const std::size_t n = i * 4 + c;
            if (f == Format::f32x4) std::memcpy(&dirty[n * 4], c == 3 ? &clean[n] : reinterpret_cast<const float*>(&bad[(i + c) % 4]), 4);
            else std::memcpy(&dirty[n * 2], c == 3 ? reinterpret_cast<const std::uint16_t*>(&clean[n]) : &bad_half[(i + c) % 4], 2);
          }
        on_every_way(p, [&](Context& context, const MipBuildParams& q, bool tiled) {
          expect_same(build_levels(context, q, dirty, tiled), build_levels(context, q, encode(f, clean), tiled), "not finite and zero");
        });
      }
}

TEST(MipBuild, EmissionWithoutOpacityIsKept) {
  for (const Format f : colour_formats) {
    // One voxel of emission before an opaque one, along x.
    std::vector<float> values(8 * 4, 0.0f);
    values[0] = 0.5f;
    values[4 + 1] = 0.25f;
    values[4 + 3] = 1.0f;
    on_every_way(params(MipVariant::isotropic, f, {2, 2, 2}), [&](Context& context, const MipBuildParams& p, bool tiled) {
      const std::vector<double> v = decode(f, build_levels(context, p, encode(f, values), tiled).at("level_1"));
      EXPECT_NEAR(v[0], 0.5 / 8, step(f, 0.0625));
      EXPECT_NEAR(v[1], 0.25 / 8, step(f, 0.03));
      EXPECT_NEAR(v[3], 1.0 / 8, step(f, 0.125) * 0.5);
    });
    on_every_way(params(MipVariant::anisotropic, f, {2, 2, 2}), [&](Context& context, const MipBuildParams& p, bool tiled) {
      const Levels levels = build_levels(context, p, encode(f, values), tiled);
      const std::vector<double> px = decode(f, levels.at("level_1_px")), nx = decode(f, levels.at("level_1_nx"));
      EXPECT_NEAR(px[0], 0.5 / 4, step(f, 0.125)) << "in front: seen";
      EXPECT_EQ(nx[0], 0) << "behind opacity 1: hidden";
      EXPECT_NEAR(px[3], 0.25, step(f, 0.25) * 0.5);
      EXPECT_NEAR(nx[1], 0.25 / 4, step(f, 0.0625));
    });
  }
}

TEST(MipBuild, WhatLiesBehindOpacityOneDoesNotMatter) {
  std::vector<float> values{0.5f, 0.25f, 0.125f, 1.0f, nan, infinity, 3e38f, nan};
  for (const std::string& device : test_devices()) {
    const Levels levels = build_levels(test_context(device), params(MipVariant::anisotropic, Format::f32x4, {2, 1, 1}), encode(Format::f32x4, values));
    EXPECT_EQ(decode(Format::f32x4, levels.at("level_1_px")), (std::vector<double>{0.5, 0.25, 0.125, 1})) << device;
  }
}

TEST(MipBuild, OpacityOneStaysExactlyOne) {
  for (const MipVariant v : colour_variants)
    for (const Format f : colour_formats)
      for (const auto e : {std::array{16, 16, 16}, {15, 9, 27}, {257, 1, 1}, {31, 33, 1}, {3, 5, 7}}) {
        MipBuildParams p = params(v, f, e);
        std::vector<float> values = colours(texels(e), 4);
        for (std::size_t i = 3; i < values.size(); i += 4) values[i] = 1.0f;
        for (const std::string& device : test_devices())
          for (const auto& [name, bytes] : build_levels(test_context(device), p, encode(f, values))) {
            const std::vector<double> level = decode(f, bytes);
            for (std::size_t i = 3; i < level.size(); i += 4) ASSERT_EQ(level[i], 1.0) << device << " " << text(p) << " " << name;
          }
      }
}

TEST(MipBuild, ConstantsAreKeptToTheBit) {
  for (const auto e : {std::array{16, 8, 4}, {13, 7, 5}, {255, 3, 1}})
    for (const float value : {0.1f, 1.0f / 3, 0.7f, 1e-40f, 1.7e38f, -3.3f, 0.0f}) {
      for (const MipVariant v : {MipVariant::isotropic, MipVariant::gaussian3})
        for (const Format f : {Format::f32x1, Format::f16x4, Format::unorm8x4}) {
          const MipBuildParams p = params(v, f, e);
          const Bytes level_0 = encode(f, std::vector<float>(texels(e) * channels(f), value));
          for (const std::string& device : test_devices())
            for (const auto& [name, bytes] : build_levels(test_context(device), p, level_0))
              ASSERT_TRUE(std::equal(bytes.begin(), bytes.end(), level_0.begin())) << device << " " << text(p) << " " << name << " of " << value;
        }
      if (e[2] > 1 || value < 0 || value > 1e18f || value < 1e-18f) continue;
      MipBuildParams p = params(MipVariant::moments, Format::f32x2, e);
      p.pairs = true;
      const Bytes level_0 = encode(Format::f32x2, std::vector<float>(texels(e) * 2, value));
      for (const std::string& device : test_devices())
        for (const auto& [name, bytes] : build_levels(test_context(device), p, level_0))
          ASSERT_TRUE(std::equal(bytes.begin(), bytes.end(), level_0.begin())) << device << " " << text(p) << " " << name << " of " << value;
    }
}

TEST(MipBuild, HugeValuesStayFinite) {
  std::vector<float> values(64, 0.0f);
  values[21] = 1e30f;
  values[42] = 1.7e38f;
  for (const std::string& device : test_devices()) {
    const std::vector<double> top = decode(Format::f32x1, build_levels(test_context(device), params(MipVariant::isotropic, Format::f32x1, {4, 4, 4}), encode(Format::f32x1, values)).at("level_2"));
    EXPECT_NEAR(top[0] / ((1e30 + 1.7e38) / 64), 1.0, 1e-6) << device;
  }
}

TEST(MipBuild, DenormalsAreKept) {
  for (const Format f : {Format::f32x4, Format::f16x4}) {
    MipBuildParams p = params(MipVariant::isotropic, f, {8, 6, 5});
    std::vector<float> values = level_0_values(p);
    for (float& v : values) v *= f == Format::f32x4 ? 1e-39f : 3e-6f;
    const Levels cpu = build_levels(test_context("cpu"), p, encode(f, values));
    EXPECT_NE(decode(f, cpu.at("level_1"))[3], 0);
    for (const std::string& device : test_devices()) expect_same(build_levels(test_context(device), p, encode(f, values)), cpu, device);
  }
}

TEST(MipBuild, HalfSaturates) {
  std::vector<float> values(8 * 8 * 8 * 4);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 4 == 3 ? 0.0f : 65504.0f;  // emission adds up along a ray
  for (const std::string& device : test_devices()) {
    for (const MipVariant v : colour_variants)
      for (const auto& [name, bytes] : build_levels(test_context(device), params(v, Format::f16x4, {8, 8, 8}), encode(Format::f16x4, values)))
        for (const double value : decode(Format::f16x4, bytes)) ASSERT_TRUE(value == 0 || value == 65504) << device << " " << name << " " << value;
    for (const MipVariant v : {MipVariant::moments, MipVariant::minmax}) {
      const std::vector<double> pair = decode(Format::f16x2, build_levels(test_context(device), params(v, Format::f16x2, {2, 2, 1}), encode(Format::f32x1, {1e5f, 1e5f, 1e5f, 1e5f})).at("level_1"));
      EXPECT_EQ(pair[0], 65504) << device;
      EXPECT_EQ(pair[1], v == MipVariant::moments ? 0 : 65504) << device;
    }
  }
}

// Values of which E[z^2] would be infinite in f16, and E[z^2] - E[z]^2 noise in f32.
TEST(MipBuild, MomentsHoldInHalf) {
  constexpr double unit = 0x1p-11;  // half the last place of f16, relative
  for (const auto& [low, high] : {std::pair{256.0f, 60000.0f}, {10000.0f, 10064.0f}, {4096.0f, 4100.0f}}) {
    MipBuildParams p = params(MipVariant::moments, Format::f16x2, {64, 64, 1});
    std::vector<float> values;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) values.push_back(low + (high - low) * uniform(i));
    const auto truth = truth::pyramid(p, std::vector<double>(values.begin(), values.end()));
    for (const std::string& device : test_devices())
      for (const auto& [name, bytes] : build_levels(test_context(device), p, encode(Format::f32x1, values))) {
        const int level = level_of(name);
        const std::vector<double> v = decode(Format::f16x2, bytes);
        for (std::size_t i = 0; i < v.size(); i += 2) {
          const double mean = truth[level].values[i], sigma = truth[level].values[i + 1];
          ASSERT_LE(std::fabs(v[i] - mean), level * unit * mean) << device << " " << name;
          // sigma moves by its own rounding and by at most the rounding of the means it is made of.
          ASSERT_LE(std::fabs(v[i + 1] - sigma), level * unit * (sigma + mean)) << device << " " << name;
        }
      }
  }
}

TEST(MipBuild, MomentsOfNearlyEqualValuesDoNotCancel) {
  MipBuildParams p = params(MipVariant::moments, Format::f32x2, {32, 32, 1});
  std::vector<float> values;
  for (std::uint32_t i = 0; i < 32 * 32; ++i) values.push_back(1000.0f + 0.01f * uniform(i));
  const auto truth = truth::pyramid(p, std::vector<double>(values.begin(), values.end()));
  for (const std::string& device : test_devices()) {
    const std::vector<double> top = decode(Format::f32x2, build_levels(test_context(device), p, encode(Format::f32x1, values)).at("level_5"));
    EXPECT_NEAR(top[1] / truth[5].values[1], 1.0, 5 * 0x1p-14 / 0.003) << device;  // means are off by half of 2^-13 a level, sigma is 0.003
    EXPECT_GT(top[1], 0.002) << device;
  }
}

// The mean of every level is that of level 0, at any extent (the ends of vertices count half).
TEST(MipBuild, MeansAreKept) {
  for (const auto e : {std::array{16, 16, 16}, {15, 17, 13}, {31, 6, 1}, {1, 7, 9}, {257, 129, 1}})
    for (const MipVariant v : {MipVariant::isotropic, MipVariant::gaussian3}) {
      const MipBuildParams p = params(v, Format::f32x1, e);
      const std::vector<float> values = level_0_values(p);
      const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
      for (const auto& [name, bytes] : build_levels(test_context("cpu:double"), p, encode(p.format, values, true))) {
        const std::vector<double> level = decode(p.format, bytes, true);
        EXPECT_NEAR(std::accumulate(level.begin(), level.end(), 0.0) / static_cast<double>(level.size()), mean, 1e-13) << text(p) << " " << name;
      }
    }
  MipBuildParams p = params(MipVariant::gaussian3, Format::f32x1, {33, 17, 1});
  p.samples = MipSamples::vertices;
  const auto ends_half = [](const std::vector<double>& v, std::array<int, 3> e) {
    double sum = 0, weight = 0;
    for (int y = 0; y < e[1]; ++y)
      for (int x = 0; x < e[0]; ++x) {
        const auto end = [](int i, int n) { return n > 1 && (i == 0 || i == n - 1) ? 0.5 : 1.0; };
        const double w = end(x, e[0]) * end(y, e[1]);
        sum += w * v[static_cast<std::size_t>(y * e[0] + x)];
        weight += w;
      }
    return sum / weight;
  };
  const std::vector<float> values = level_0_values(p);
  const double mean = ends_half(std::vector<double>(values.begin(), values.end()), mip_extent(p, 0));
  for (const auto& [name, bytes] : build_levels(test_context("cpu:double"), p, encode(p.format, values, true)))
    EXPECT_NEAR(ends_half(decode(p.format, bytes, true), mip_extent(p, level_of(name))), mean, 1e-13) << name;
}

// Whatever the extents: what a whole line of voxels lets through is what its coarser lines let through.
TEST(MipBuild, DirectionalVolumesKeepTheTransmittanceOfALine) {
  for (const int n : {16, 15, 13, 33, 127}) {
    const MipBuildParams p = params(MipVariant::anisotropic, Format::f32x4, {n, 1, 1});
    std::vector<float> values = colours(static_cast<std::size_t>(n), 4, 5);
    double through = 1;
    for (int i = 0; i < n; ++i) {
      float& a = values[static_cast<std::size_t>(i) * 4 + 3];
      a *= 0.3f;
      through *= 1 - static_cast<double>(a);
    }
    for (const auto& [name, bytes] : build_levels(test_context("cpu:double"), p, encode(p.format, values, true))) {
      if (direction_of(name) > 1) continue;
      double coarse = 1;
      const std::vector<double> level = decode(p.format, bytes, true);
      for (std::size_t i = 3; i < level.size(); i += 4) coarse *= 1 - level[i];
      EXPECT_NEAR(coarse / through, 1.0, 1e-8) << n << " " << name;
    }
  }
}

TEST(MipBuild, NaNInBoundsIsIgnoredUnlessThereIsNothingElse) {
  std::vector<float> values(16 * 16);
  for (std::uint32_t i = 0; i < 256; ++i) values[i] = uniform(i) < 0.4f ? nan : uniform(i + 1000) < 0.1f ? infinity : uniform(i + 2000) - 0.5f;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) values[static_cast<std::size_t>(y * 16 + x)] = nan;
  for (const MipVariant v : {MipVariant::min, MipVariant::max, MipVariant::minmax})
    for (const MipSizes sizes : {MipSizes::floor, MipSizes::ceil})
      for (const int ratio : {2, 16}) {
        MipBuildParams p = params(v, v == MipVariant::minmax ? Format::f32x2 : Format::f32x1, {16, 16, 1});
        p.sizes = sizes;
        p.ratio = ratio;
        const auto truth = truth::pyramid(p, std::vector<double>(values.begin(), values.end()));
        on_every_way(p, [&](Context& context, const MipBuildParams& q, bool tiled) {
          for (const auto& [name, bytes] : build_levels(context, q, encode(Format::f32x1, values), tiled)) {
            const std::vector<double> level = decode(p.format, bytes);
            const std::vector<double>& expected = truth[level_of(name)].values;
            for (std::size_t i = 0; i < level.size(); ++i)
              ASSERT_TRUE(level[i] == expected[i] || (std::isnan(level[i]) && std::isnan(expected[i]))) << name << " " << i << ": " << level[i] << ", " << expected[i];
          }
        });
      }
}

TEST(MipBuild, WhatIsNotFiniteIsCounted) {
  std::vector<float> values(8 * 6 * 5 * 4, 0.25f);
  const auto set = [&](int i, float r, float a) {
    values[static_cast<std::size_t>(i) * 4] = r;
    values[static_cast<std::size_t>(i) * 4 + 3] = a;
  };
  set(3, nan, 0);
  set(17, infinity, 0);
  set(99, -infinity, 0);
  set(4, nan, 0.5f);
  set(5, 1, nan);
  set(100, infinity, 1);
  set(101, 7, 0);
  for (const Format f : {Format::f32x4, Format::f16x4}) {
    MipBuildParams p = params(MipVariant::isotropic, f, {8, 6, 5});
    p.count = true;
    Bytes level_0 = encode(f, values);
    if (f == Format::f16x4)  // encode saturates infinities
      for (const int i : {17, 99, 100}) {
        const std::uint16_t bits = i == 99 ? 0xfc00 : 0x7c00;
        std::memcpy(&level_0[static_cast<std::size_t>(i) * 8], &bits, 2);
      }
    on_every_way(p, [&](Context& context, const MipBuildParams& q, bool tiled) {
      const Bytes counters = build_levels(context, q, level_0, tiled).at("counters");
      const std::uint32_t expected[4] = {3, 2, 1, 0};
      EXPECT_EQ(std::memcmp(counters.data(), expected, 16), 0);
    });
  }
  MipBuildParams p = params(MipVariant::minmax, Format::f32x2, {5, 3, 1});
  p.count = true;
  std::vector<float> depths(15, 1.0f);
  depths[2] = depths[7] = nan;
  depths[14] = infinity;
  for (const std::string& device : test_devices()) {
    const Bytes counters = build_levels(test_context(device), p, encode(Format::f32x1, depths)).at("counters");
    const std::uint32_t expected[4] = {0, 2, 1, 0};
    EXPECT_EQ(std::memcmp(counters.data(), expected, 16), 0) << device;
  }
}

// --- Storage: drift over eight levels -----------------------------------------------------------------------------------

// Mean signed and largest absolute error of a level, in steps of unorm8 or units of the last place of full scale 1.
struct Drift {
  double mean = 0, most = 0;
};

Drift drift(const Bytes& level, const truth::Level& truth, Format format) {
  const std::vector<double> values = decode(format, level);
  Drift d;
  const double unit = step(format, 0.75);  // the values' mean is 1/2: units of [0.5, 1)
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double error = (values[i] - truth.values[i]) / unit;
    d.mean += error / static_cast<double>(values.size());
    d.most = std::max(d.most, std::fabs(error));
  }
  return d;
}

// Rounding up at ties would drift by 1/16 step a level.
constexpr double mean_drift_bound = 1.0 / 16;
constexpr double smallest_level = 16 * 16 * 16;

void check_drift(int side, const std::vector<std::string>& devices) {
  for (const Format f : colour_formats) {
    const MipBuildParams p = params(MipVariant::isotropic, f, {side, side, side});
    std::vector<float> values(texels(mip_extent(p, 0)) * 4);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = uniform(static_cast<std::uint32_t>(i));
    const Bytes level_0 = encode(f, values);
    const std::vector<double> exact = decode(f, level_0);
    const auto truth = truth::pyramid(p, exact);
    for (const std::string& device : devices) {
      MipBuildParams q = p;
      // 256 x 256 x 256 of f32x4 fits no storage buffer of some devices; images hold it.
      if (side == 256 && f == Format::f32x4 && device == "vulkan") q.input = Input::image;
      for (const auto& [name, bytes] : build_levels(test_context(device), q, level_0)) {
        const int level = level_of(name);
        const Drift d = drift(bytes, truth[static_cast<std::size_t>(level)], f);
        std::printf("%s %s %s: mean %+.5f, most %.4f steps\n", device.c_str(), luxel::name(f), name.c_str(), d.mean, d.most);
        EXPECT_LE(d.most, level * (f == Format::f32x4 ? f32_units_a_level : storage_units_a_level)) << device << " " << text(p) << " " << name;
        if (bytes.size() >= smallest_level * bytes_per_pixel(f)) {
          EXPECT_LE(std::fabs(d.mean), mean_drift_bound) << device << " " << text(p) << " " << name;
        }
      }
    }
  }
}

TEST(MipBuild, DoesNotDrift) { check_drift(64, test_devices()); }
TEST(MipBuildFull, DoesNotDriftOverEightLevels) { check_drift(256, test_devices()); }

TEST(MipBuild, Unorm8RoundsHalfToEven) {
  const MipBuildParams p = params(MipVariant::isotropic, Format::unorm8x4, {2 * 255, 1, 1});
  Bytes level_0;
  for (int k = 0; k < 255; ++k)
    for (int i = 0; i < 2; ++i) level_0.insert(level_0.end(), 4, static_cast<std::uint8_t>(k + i));  // the mean is k + 1/2
  for (const std::string& device : test_devices()) {
    const Bytes level = build_levels(test_context(device), p, level_0).at("level_1");
    for (int k = 0; k < 255; ++k) EXPECT_EQ(level[static_cast<std::size_t>(k) * 4], k + k % 2) << device << " half between " << k << " and " << k + 1;
  }
}

// --- Bounds: every width and height from 1 to 257 -----------------------------------------------------------------------

constexpr int largest = 257;

// Distances of a square that all sizes are cut from.
const std::vector<float>& square() {
  static const std::vector<float> values = [] {
    std::vector<float> v;
    for (std::uint32_t i = 0; i < largest * largest; ++i) v.push_back(uniform(i) * 100 + 1);
    return v;
  }();
  return values;
}

std::vector<float> cut(int width, int height) {
  std::vector<float> values;
  for (int y = 0; y < height; ++y) values.insert(values.end(), square().begin() + y * largest, square().begin() + y * largest + width);
  return values;
}

// Texels of level 0 outside the bounds of the texel that they are addressed to, over all levels.
std::size_t violations(const MipBuildParams& p, const std::vector<float>& values, const Levels& levels) {
  std::size_t count = 0;
  for (const auto& [name, bytes] : levels) {
    const int level = level_of(name), shift = p.ratio == 16 ? 4 : level;
    const auto e = mip_extent(p, level);
    const std::vector<double> bounds = decode(p.format, bytes);
    for (int y = 0; y < p.height; ++y) {
      const int cy = p.sizes == MipSizes::ceil ? y >> shift : std::min(y >> shift, e[1] - 1);
      for (int x = 0; x < p.width; ++x) {
        const int cx = p.sizes == MipSizes::ceil ? x >> shift : std::min(x >> shift, e[0] - 1);
        const double v = values[static_cast<std::size_t>(y) * p.width + x];
        const double* bound = &bounds[(static_cast<std::size_t>(cy) * e[0] + cx) * channels(p.format)];
        const bool kept = p.variant == MipVariant::minmax ? bound[0] <= v && v <= bound[1] : p.variant == MipVariant::min ? bound[0] <= v : v <= bound[0];
        count += kept ? 0 : 1;
      }
    }
  }
  return count;
}

std::vector<MipBuildParams> bound_kinds() {
  std::vector<MipBuildParams> kinds;
  for (const MipSizes sizes : {MipSizes::floor, MipSizes::ceil})
    for (const int ratio : {2, 16})
      for (const Format f : {Format::f32x2, Format::f16x2}) {
        kinds.push_back(params(MipVariant::minmax, f, {1, 1, 1}));
        kinds.back().sizes = sizes;
        kinds.back().ratio = ratio;
      }
  return kinds;
}

void check_bounds(const std::string& device, MipBuildParams p, int width, int height, bool tiled) {
  if (width * height == 1) return;
  p.width = width;
  p.height = height;
  const std::vector<float> values = cut(width, height);
  const Levels levels = build_levels(test_context(device), p, bytes_of(values), tiled);
  EXPECT_EQ(violations(p, values, levels), 0u) << device << " " << text(p) << (tiled ? " tiled" : "");
  if (p.format != Format::f32x2) return;
  const auto truth = truth::pyramid(p, std::vector<double>(values.begin(), values.end()));
  for (const auto& [name, bytes] : levels)
    EXPECT_EQ(decode(p.format, bytes), truth[static_cast<std::size_t>(level_of(name))].values) << device << " " << text(p) << " " << name << ": not the tightest bounds";
}

TEST(MipBuild, BoundsHoldForManySizes) {
  for (const std::string& device : test_devices())
    for (const MipBuildParams& p : bound_kinds())
      for (const auto& [width, height] : {std::pair{1, 257}, {257, 1}, {2, 3}, {3, 2}, {16, 16}, {17, 31}, {33, 15}, {127, 129}, {255, 257}})
        for (const bool tiled : {false, true}) check_bounds(device, p, width, height, tiled);
}

TEST(MipBuildFull, BoundsHoldForEveryWidthAndSomeHeightsOnDevices) {
  for (const std::string& device : test_devices())
    for (const MipBuildParams& p : bound_kinds())
      for (int width = 1; width <= largest; ++width)
        for (const int height : {1, 3, 32, 257}) check_bounds(device, p, width, height, width % 2 == 0);
}

TEST(MipBuildFull, BoundsHoldForEveryWidthAndHeight) {
  for (const MipBuildParams& kind : bound_kinds()) {
    if (kind.format != Format::f32x2) continue;
    for (int width = 1; width <= largest; ++width) {
      for (int height = 1; height <= largest; ++height) {
        if (width * height == 1) continue;
        MipBuildParams p = kind;
        p.width = width;
        p.height = height;
        const std::vector<float> values = cut(width, height);
        ASSERT_EQ(violations(p, values, build_levels(test_context("cpu"), p, bytes_of(values))), 0u) << text(p);
      }
    }
  }
}

// Why texels are addressed as documented: by normalised coordinates, all odd sizes but 3 break the bound.
TEST(MipBuild, AddressingByNormalisedCoordinatesBreaksTheBound) {
  int broken = 0;
  for (int n = 3; n <= largest; n += 2) {
    MipBuildParams p = params(MipVariant::minmax, Format::f32x2, {n, 1, 1});
    p.levels = 1;
    std::vector<float> values(static_cast<std::size_t>(n));
    std::iota(values.begin(), values.end(), 1.0f);  // no texel's bounds hold another's value
    const int m = mip_extent(p, 1)[0];
    const std::vector<double> bounds = decode(p.format, build_levels(test_context("cpu"), p, bytes_of(values)).at("level_1"));
    bool breaks = false;
    for (double x = 0.125; x < n; x += 0.25) {  // a ray passes anywhere in a texel
      const auto at = static_cast<std::size_t>(x / n * m);
      const float v = values[static_cast<std::size_t>(x)];
      breaks = breaks || !(bounds[at * 2] <= v && v <= bounds[at * 2 + 1]);
    }
    broken += breaks ? 1 : 0;
  }
  EXPECT_EQ(broken, 127);
}

// --- The red-green wall ---------------------------------------------------------------------------------------------------

// A red wall one voxel thick at x = at, a green one right behind it.
std::vector<float> two_walls(int side, int at) {
  std::vector<float> values(static_cast<std::size_t>(side) * side * side * 4, 0.0f);
  for (std::size_t i = 0; i < values.size() / 4; ++i) {
    const int x = static_cast<int>(i) % side;
    if (x != at && x != at + 1) continue;
    values[i * 4 + (x == at ? 0 : 1)] = 1.0f;
    values[i * 4 + 3] = 1.0f;
  }
  return values;
}

struct Seen {
  double red = 0, green = 0, opacity = 0;
};

void add_sample(Seen& seen, double red, double green, double a, double part) {
  // Premultiplied colour and opacity of a part of the reference length (cone_trace corrects likewise).
  const double corrected = a >= 1 ? 1 : 1 - std::pow(1 - a, part), scale = a > 0 ? corrected / a : part, through = 1 - seen.opacity;
  seen.red += through * red * scale;
  seen.green += through * green * scale;
  seen.opacity += through * corrected;
}

// Looks along +x through a level, sampling every voxel length from `start` voxels on, interpolating along x.
Seen look(const std::vector<double>& level, int side, double start, double part) {
  Seen seen;
  for (double at = start; at < side + 1; at += 1) {
    const double p = at - 0.5;
    const int low = static_cast<int>(std::floor(p));
    const double f = p - low;
    double v[4] = {0, 0, 0, 0};
    for (int k = 0; k < 2; ++k) {
      if (low + k < 0 || low + k >= side) continue;
      for (int c = 0; c < 4; ++c) v[c] += (k == 0 ? 1 - f : f) * level[static_cast<std::size_t>(low + k) * 4 + c];
    }
    add_sample(seen, v[0], v[1], v[3], part);
  }
  return seen;
}

TEST(MipBuild, TheRedGreenWall) {
  constexpr int side = 32;
  for (const std::string& device : test_devices())
    for (const int at : {14, 15}) {
      const Bytes level_0 = encode(Format::f32x4, two_walls(side, at));
      const Levels directional = build_levels(test_context(device), params(MipVariant::anisotropic, Format::f32x4, {side, side, side}), level_0);
      const Levels isotropic = build_levels(test_context(device), params(MipVariant::isotropic, Format::f32x4, {side, side, side}), level_0);
      double most_between = 0;
      for (int level = 1; level <= 4; ++level) {
        const int n = side >> level;
        const std::vector<double> px = decode(Format::f32x4, directional.at(mip_level_name(level, 0)));
        const std::vector<double> nx = decode(Format::f32x4, directional.at(mip_level_name(level, 1)));
        const std::vector<double> both = decode(Format::f32x4, isotropic.at(mip_level_name(level)));
        const Seen along = look(px, n, 0.5, 1);
        EXPECT_EQ(along.green, 0) << device << " level " << level << ": looking along +x";
        EXPECT_EQ(along.red, 1) << device;
        EXPECT_EQ(along.opacity, 1) << device;
        std::vector<double> turned(nx);
        for (int x = 0; x < n; ++x) std::copy_n(&nx[static_cast<std::size_t>(n - 1 - x) * 4], 4, &turned[static_cast<std::size_t>(x) * 4]);
        EXPECT_EQ(look(turned, n, 0.5, 1).red, 0) << device << " level " << level << ": looking along -x";
        // Between centres an opaque voxel is interpolated with an empty one.
        for (double start = -0.5; start < 0.5; start += 1.0 / 16) most_between = std::max(most_between, look(px, n, start, 1).green);
        // Isotropic opacity belongs to a finest voxel: a sample a voxel of the level apart stands for 2^level of them.
        const Seen mixed_up = look(both, n, 0.5, std::ldexp(1.0, level));
        std::printf("%s walls at %d, level %d: isotropic shows %.3f green, opacity %.3f\n", device.c_str(), at, level, mixed_up.green, mixed_up.opacity);
        EXPECT_GT(mixed_up.green, 0.15) << "the isotropic pyramid is known to leak";
        EXPECT_GE(mixed_up.opacity, 1 - std::exp(-2.0)) << "two voxels' thickness of wall lets at most 1/e^2 through";
      }
      std::printf("%s walls at %d: anisotropic between centres shows up to %.3f green\n", device.c_str(), at, most_between);
      EXPECT_LE(most_between, 0.25 + 1e-6);
      EXPECT_TRUE(at % 2 == 0 || most_between > 0.2) << "the sweep passes where it leaks most";
    }
}

// Off the axis three volumes are mixed, and those across the wall's normal see its edge: the leak is measured, not hidden.
TEST(MipBuild, TheRedGreenWallOffAxis) {
  constexpr int side = 32;
  const Levels levels = build_levels(test_context("cpu"), params(MipVariant::anisotropic, Format::f32x4, {side, side, side}), encode(Format::f32x4, two_walls(side, 15)));
  for (int level = 1; level <= 4; ++level) {
    const int n = side >> level;
    const std::vector<double> px = decode(Format::f32x4, levels.at(mip_level_name(level, 0))), py = decode(Format::f32x4, levels.at(mip_level_name(level, 2)));
    double before = 0;
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0}) {
      const double c = std::cos(degrees * 3.14159265358979 / 180), wx = c * c, wy = 1 - wx;
      // Walls look the same all along y: mixing the volumes voxel by voxel, steps of a voxel's width in x.
      std::vector<double> mixed_volumes(static_cast<std::size_t>(n) * 4);
      for (std::size_t i = 0; i < mixed_volumes.size(); ++i) mixed_volumes[i] = wx * px[i] + wy * py[i];
      const Seen seen = look(mixed_volumes, n, 0.5, 1 / c);
      std::printf("level %d, %2.0f degrees off the axis: %.3f green, opacity %.3f\n", level, degrees, seen.green, seen.opacity);
      EXPECT_TRUE(degrees > 0 || seen.green == 0);
      EXPECT_GE(seen.green, before - 0.02) << "the leak grows with the angle";
      EXPECT_LE(seen.green, 0.5);
      before = seen.green;
    }
  }
}

// --- Refusals -------------------------------------------------------------------------------------------------------------

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
      {[](auto& p) { p.width = p.height = 65535; }, "MipBuildParams.height is 65535; expected width x height x depth x channels of at most 2147483647"},
      {[](auto& p) { p.width = p.height = p.depth = 1; }, "MipBuildParams.width is 1; expected a level 0 of more than one texel"},
      {[](auto& p) { p.levels = 5; }, "MipBuildParams.levels is 5; expected 0..4"},
      {[](auto& p) { p.levels = -1; }, "MipBuildParams.levels is -1; expected 0..4"},
      {[](auto& p) { p.format = Format::u32; }, "MipBuildParams.format is u32; expected f32x1, f32x2, f32x4, f16x4 or unorm8x4 for variant isotropic"},
      {[](auto& p) { p.variant = MipVariant::anisotropic, p.format = Format::f32x1; }, "MipBuildParams.format is f32x1; expected f32x4, f16x4 or unorm8x4 for variant anisotropic"},
      {[](auto& p) { p.variant = MipVariant::min; p.depth = 1; }, "MipBuildParams.format is f32x4; expected f32x1 for variant min"},
      {[](auto& p) { p.variant = MipVariant::moments; p.depth = 1; }, "MipBuildParams.format is f32x4; expected f32x2 or f16x2 for variant moments"},
      {[](auto& p) { p.variant = MipVariant::minmax; p.format = Format::f32x2; }, "MipBuildParams.depth is 16; expected 1 for variant minmax"},
      {[](auto& p) { p.pairs = true; }, "MipBuildParams.pairs is true; expected false for variant isotropic"},
      {[](auto& p) { p.sizes = MipSizes::ceil; }, "MipBuildParams.sizes is ceil; expected floor for variant isotropic"},
      {[](auto& p) { p.ratio = 16; }, "MipBuildParams.ratio is 16; expected 2 for variant isotropic"},
      {[](auto& p) { p.ratio = 3, p.variant = MipVariant::max, p.format = Format::f32x1, p.depth = 1; }, "MipBuildParams.ratio is 3; expected 2 or 16 for variant max"},
      {[](auto& p) { p.ratio = 16, p.variant = MipVariant::max, p.format = Format::f32x1, p.depth = 1, p.levels = 2; }, "MipBuildParams.levels is 2; expected 0..1"},
      {[](auto& p) { p.samples = MipSamples::vertices; }, "MipBuildParams.samples is vertices; expected cells for variant isotropic"},
      {[](auto& p) { p.variant = MipVariant::gaussian3, p.samples = MipSamples::vertices; }, "MipBuildParams.width is 16; expected an extent that is odd, 1 or 2 at every level that is halved (samples on vertices); level 0 has 16"},
      {[](auto& p) { p.variant = MipVariant::gaussian3, p.samples = MipSamples::vertices, p.width = 11, p.height = p.depth = 9; }, "MipBuildParams.width is 11; expected an extent that is odd, 1 or 2 at every level that is halved (samples on vertices); level 1 has 6; or MipBuildParams.levels of 1..1"},
      {[](auto& p) { p.directions = 3; }, "MipBuildParams.directions is 3; expected 63 for variant isotropic"},
      {[](auto& p) { p.variant = MipVariant::anisotropic, p.directions = 0; }, "MipBuildParams.directions is 0; expected 1..63"},
      {[](auto& p) { p.variant = MipVariant::anisotropic, p.directions = 64; }, "MipBuildParams.directions is 64; expected 1..63"},
      {[](auto& p) { p.count = true, p.format = Format::unorm8x4; }, "MipBuildParams.count is true; expected false for unorm8x4, which holds neither NaN nor infinities"},
      {[](auto& p) { p.variant = static_cast<MipVariant>(7); }, "MipBuildParams.variant is 7; expected 0..6"},
      {[](auto& p) { p.input = static_cast<Input>(-1); }, "MipBuildParams.input is -1; expected 0..1"},
      {[](auto& p) { p.sizes = static_cast<MipSizes>(2); }, "MipBuildParams.sizes is 2; expected 0..1"},
      {[](auto& p) { p.samples = static_cast<MipSamples>(9); }, "MipBuildParams.samples is 9; expected 0..1"},
      {[](auto& p) { p.format = static_cast<Format>(77); }, "MipBuildParams.format is unknown; expected f32x1, f32x2, f32x4, f16x4 or unorm8x4 for variant isotropic"},
  };
  for (const Refusal& refusal : refusals) {
    MipBuildParams p = good;
    refusal.change(p);
    const Status status = validate(p);
    EXPECT_EQ(status.code(), Code::invalid_argument) << refusal.message;
    EXPECT_EQ(status.message(), refusal.message);
    for (const char* device : {"pocl", "lavapipe", "gpu", "reference"}) EXPECT_EQ(plan(p, profile(device)).status().message(), refusal.message);
  }
}

}  // namespace

void PrintTo(const MipBuildParams& p, std::ostream* out) { *out << text(p); }

}  // namespace luxel

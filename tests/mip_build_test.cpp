// mip_build against reductions in double, on every execution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bench/truth/mip_truth.h"
#include "tests/support/pyramid.h"

namespace luxel {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

// A hash, so that numbers are the same with every standard library.
std::uint32_t mixed(std::uint32_t v) {
  v = (v ^ 61) ^ (v >> 16);
  v *= 9;
  v ^= v >> 4;
  v *= 0x27d4eb2d;
  return v ^ (v >> 15);
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

}  // namespace

void PrintTo(const MipBuildParams& p, std::ostream* out) { *out << text(p); }

}  // namespace luxel

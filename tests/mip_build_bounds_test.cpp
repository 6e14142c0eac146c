// mip_build: bounds of every width and height from 1 to 257.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "bench/truth/mip_truth.h"
#include "tests/support/pyramid.h"

namespace luxel {
namespace {

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
  for (int y = 0; y < height; ++y)
    values.insert(values.end(), square().begin() + y * largest, square().begin() + y * largest + width);
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
        const bool kept = p.variant == MipVariant::minmax ? bound[0] <= v && v <= bound[1]
                          : p.variant == MipVariant::min  ? bound[0] <= v
                                                          : v <= bound[0];
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
    EXPECT_EQ(decode(p.format, bytes), truth[static_cast<std::size_t>(level_of(name))].values)
        << device << " " << text(p) << " " << name << ": not the tightest bounds";
}

TEST(MipBuild, BoundsHoldForManySizes) {
  for (const std::string& device : test_devices())
    for (const MipBuildParams& p : bound_kinds())
      for (const auto& [width, height] :
           {std::pair{1, 257}, {257, 1}, {2, 3}, {3, 2}, {16, 16}, {17, 31}, {33, 15}, {127, 129}, {255, 257}})
        for (const bool tiled : {false, true}) check_bounds(device, p, width, height, tiled);
}

TEST(MipBuildFull, BoundsHoldForEveryWidthAndSomeHeightsOnDevices) {
  for (const std::string& device : test_devices())
    for (const MipBuildParams& p : bound_kinds())
      for (int width = 1; width <= largest; ++width)
        for (const int height : {1, 3, 32, 257})
          if (p.format == Format::f32x2 || height == 3) check_bounds(device, p, width, height, width % 2 == 0);
}

// One bound alone, with the sizes that hiz_ssr walks: min, and max for reversed depth. mip_build_stability_test has both
// bounds at once.
TEST(MipBuildFull, OneBoundHoldsForEveryWidthAndHeight) {
  for (const MipVariant v : {MipVariant::min, MipVariant::max}) {
    MipBuildParams p = params(v, Format::f32x1, {1, 1, 1});
    p.sizes = MipSizes::ceil;
    for (p.width = 1; p.width <= largest; ++p.width) {
      for (p.height = 1; p.height <= largest; ++p.height) {
        if (p.width * p.height == 1) continue;
        const std::vector<float> values = cut(p.width, p.height);
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
    const std::vector<double> bounds =
        decode(p.format, build_levels(test_context("cpu"), p, bytes_of(values)).at("level_1"));
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

}  // namespace
}  // namespace luxel

// What mip_build promises in extreme and stiff cases: see kernels/mip_build/README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/truth/mip_truth.h"
#include "tests/support/pyramid.h"

namespace luxel {
namespace {

TEST(MipBuild, ColourWithoutOpacityThatIsNotFiniteDoesNotLeak) {
  for (const MipVariant v : colour_variants)
    for (const Format f : {Format::f32x4, Format::f16x4})
      for (const auto e : {std::array{8, 8, 8}, {5, 7, 3}, {9, 4, 1}}) {
        MipBuildParams p = params(v, f, e);
        std::vector<float> clean = level_0_values(p);
        Bytes dirty = encode(f, clean);
        const std::vector<std::uint32_t> bad{0x7fc00000u, 0x7f800000u, 0xff800000u, 0xffc00001u};
        const std::vector<std::uint16_t> bad_half{0x7e00u, 0x7c00u, 0xfc00u, 0xfe01u};
        const Bytes patterns = f == Format::f32x4 ? bytes_of(bad) : bytes_of(bad_half);
        const std::size_t size = patterns.size() / 4;
        for (std::size_t i = 0; i < clean.size() / 4; i += 3)
          for (std::size_t c = 0; c < 4; ++c) {
            clean[i * 4 + c] = 0;
            const auto to = dirty.begin() + static_cast<std::ptrdiff_t>((i * 4 + c) * size);
            if (c == 3) std::fill_n(to, size, std::uint8_t{0});
            else std::copy_n(patterns.begin() + static_cast<std::ptrdiff_t>((i + c) % 4 * size), size, to);
          }
        on_every_way(p, [&](Context& context, const MipBuildParams& q, bool tiled) {
          expect_same(build_levels(context, q, dirty, tiled), build_levels(context, q, encode(f, clean), tiled),
                      "not finite and zero");
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
    on_every_way(
        params(MipVariant::isotropic, f, {2, 2, 2}), [&](Context& context, const MipBuildParams& p, bool tiled) {
          const std::vector<double> v = decode(f, build_levels(context, p, encode(f, values), tiled).at("level_1"));
          EXPECT_NEAR(v[0], 0.5 / 8, step(f, 0.0625));
          EXPECT_NEAR(v[1], 0.25 / 8, step(f, 0.03));
          EXPECT_NEAR(v[3], 1.0 / 8, step(f, 0.125) * 0.5);
        });
    on_every_way(
        params(MipVariant::anisotropic, f, {2, 2, 2}), [&](Context& context, const MipBuildParams& p, bool tiled) {
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
    const Levels levels = build_levels(test_context(device), params(MipVariant::anisotropic, Format::f32x4, {2, 1, 1}),
                                       encode(Format::f32x4, values));
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
            for (std::size_t i = 3; i < level.size(); i += 4)
              ASSERT_EQ(level[i], 1.0) << device << " " << text(p) << " " << name;
          }
      }
}

TEST(MipBuild, ConstantsAreKeptToTheBit) {
  for (const auto e : {std::array{16, 8, 4}, {13, 7, 5}, {255, 3, 1}})
    for (const float value : {0.1f, 1.0f / 3, 0.7f, 1e-40f, 4e37f, -3.3f, 0.0f}) {
      for (const MipVariant v : {MipVariant::isotropic, MipVariant::gaussian3})
        for (const Format f : {Format::f32x1, Format::f16x4, Format::unorm8x4}) {
          const MipBuildParams p = params(v, f, e);
          const Bytes level_0 = encode(f, std::vector<float>(texels(e) * channels(f), value));
          for (const std::string& device : test_devices())
            for (const auto& [name, bytes] : build_levels(test_context(device), p, level_0))
              ASSERT_TRUE(std::equal(bytes.begin(), bytes.end(), level_0.begin()))
                  << device << " " << text(p) << " " << name << " of " << value;
        }
      if (e[2] > 1 || value < 0 || value > 1e18f || value < 1e-18f) continue;
      MipBuildParams p = params(MipVariant::moments, Format::f32x2, e);
      p.pairs = true;
      const Bytes level_0 = encode(Format::f32x2, std::vector<float>(texels(e) * 2, value));
      for (const std::string& device : test_devices())
        for (const auto& [name, bytes] : build_levels(test_context(device), p, level_0))
          ASSERT_TRUE(std::equal(bytes.begin(), bytes.end(), level_0.begin()))
              << device << " " << text(p) << " " << name << " of " << value;
    }
}

TEST(MipBuild, HugeValuesStayFinite) {
  std::vector<float> values(64, 0.0f);
  values[21] = 1e30f;
  values[42] = 4e37f;
  for (const std::string& device : test_devices()) {
    const std::vector<double> top = decode(
        Format::f32x1, build_levels(test_context(device), params(MipVariant::isotropic, Format::f32x1, {4, 4, 4}),
                                    encode(Format::f32x1, values))
                           .at("level_2"));
    EXPECT_NEAR(top[0] / ((1e30 + 4e37) / 64), 1.0, 1e-6) << device;
  }
}

TEST(MipBuild, DenormalsAreKept) {
  for (const Format f : {Format::f32x4, Format::f16x4}) {
    MipBuildParams p = params(MipVariant::isotropic, f, {8, 6, 5});
    std::vector<float> values = level_0_values(p);
    for (float& v : values) v *= f == Format::f32x4 ? 1e-39f : 3e-6f;
    const Levels cpu = build_levels(test_context("cpu"), p, encode(f, values));
    EXPECT_NE(decode(f, cpu.at("level_1"))[3], 0);
    for (const std::string& device : test_devices())
      expect_same(build_levels(test_context(device), p, encode(f, values)), cpu, device);
  }
}

TEST(MipBuild, HalfSaturates) {
  std::vector<float> values(8 * 8 * 8 * 4);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = i % 4 == 3 ? 0.0f : 65504.0f;  // emission adds up along a ray
  for (const std::string& device : test_devices()) {
    for (const MipVariant v : colour_variants)
      for (const auto& [name, bytes] :
           build_levels(test_context(device), params(v, Format::f16x4, {8, 8, 8}), encode(Format::f16x4, values)))
        for (const double value : decode(Format::f16x4, bytes))
          ASSERT_TRUE(value == 0 || value == 65504) << device << " " << name << " " << value;
    for (const MipVariant v : {MipVariant::moments, MipVariant::minmax}) {
      const std::vector<double> pair =
          decode(Format::f16x2, build_levels(test_context(device), params(v, Format::f16x2, {2, 2, 1}),
                                             encode(Format::f32x1, {1e5f, 1e5f, 1e5f, 1e5f}))
                                    .at("level_1"));
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
    const std::vector<double> top =
        decode(Format::f32x2, build_levels(test_context(device), p, encode(Format::f32x1, values)).at("level_5"));
    EXPECT_NEAR(top[1] / truth[5].values[1], 1.0, 5 * 0x1p-14 / 0.003)
        << device;  // means are off by half of 2^-13 a level, sigma is 0.003
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
        EXPECT_NEAR(std::accumulate(level.begin(), level.end(), 0.0) / static_cast<double>(level.size()), mean, 1e-13)
            << text(p) << " " << name;
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
  for (std::uint32_t i = 0; i < 256; ++i)
    values[i] = uniform(i) < 0.4f ? nan : uniform(i + 1000) < 0.1f ? infinity : uniform(i + 2000) - 0.5f;
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
              ASSERT_TRUE(level[i] == expected[i] || (std::isnan(level[i]) && std::isnan(expected[i])))
                  << name << " " << i << ": " << level[i] << ", " << expected[i];
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
  const double corrected = a >= 1 ? 1 : 1 - std::pow(1 - a, part), scale = a > 0 ? corrected / a : part,
               through = 1 - seen.opacity;
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
      const Levels directional = build_levels(
          test_context(device), params(MipVariant::anisotropic, Format::f32x4, {side, side, side}), level_0);
      const Levels isotropic =
          build_levels(test_context(device), params(MipVariant::isotropic, Format::f32x4, {side, side, side}), level_0);
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
        for (int x = 0; x < n; ++x)
          std::copy_n(&nx[static_cast<std::size_t>(n - 1 - x) * 4], 4, &turned[static_cast<std::size_t>(x) * 4]);
        EXPECT_EQ(look(turned, n, 0.5, 1).red, 0) << device << " level " << level << ": looking along -x";
        // Between centres an opaque voxel is interpolated with an empty one.
        for (double start = -0.5; start < 0.5; start += 1.0 / 16)
          most_between = std::max(most_between, look(px, n, start, 1).green);
        // Isotropic opacity belongs to a finest voxel: a sample a voxel of the level apart stands for 2^level of them.
        const Seen mixed_up = look(both, n, 0.5, std::ldexp(1.0, level));
        std::printf("%s walls at %d, level %d: isotropic shows %.3f green, opacity %.3f\n", device.c_str(), at, level,
                    mixed_up.green, mixed_up.opacity);
        EXPECT_GT(mixed_up.green, 0.15) << "the isotropic pyramid is known to leak";
        EXPECT_GE(mixed_up.opacity, 1 - std::exp(-2.0)) << "two voxels' thickness of wall lets at most 1/e^2 through";
      }
      std::printf("%s walls at %d: anisotropic between centres shows up to %.3f green\n", device.c_str(), at,
                  most_between);
      EXPECT_LE(most_between, 0.25 + 1e-6);
      EXPECT_TRUE(at % 2 == 0 || most_between > 0.2) << "the sweep passes where it leaks most";
    }
}

// Off the axis three volumes are mixed, and those across the wall's normal see its edge: the leak is measured, not hidden.
TEST(MipBuild, TheRedGreenWallOffAxis) {
  constexpr int side = 32;
  const Levels levels =
      build_levels(test_context("cpu"), params(MipVariant::anisotropic, Format::f32x4, {side, side, side}),
                   encode(Format::f32x4, two_walls(side, 15)));
  for (int level = 1; level <= 4; ++level) {
    const int n = side >> level;
    const std::vector<double> px = decode(Format::f32x4, levels.at(mip_level_name(level, 0))),
                              py = decode(Format::f32x4, levels.at(mip_level_name(level, 2)));
    double before = 0;
    for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0}) {
      const double c = std::cos(degrees * 3.14159265358979 / 180), wx = c * c, wy = 1 - wx;
      // Walls look the same all along y: mixing the volumes voxel by voxel, steps of a voxel's width in x.
      std::vector<double> mixed_volumes(static_cast<std::size_t>(n) * 4);
      for (std::size_t i = 0; i < mixed_volumes.size(); ++i) mixed_volumes[i] = wx * px[i] + wy * py[i];
      const Seen seen = look(mixed_volumes, n, 0.5, 1 / c);
      std::printf("level %d, %2.0f degrees off the axis: %.3f green, opacity %.3f\n", level, degrees, seen.green,
                  seen.opacity);
      EXPECT_TRUE(degrees > 0 || seen.green == 0);
      EXPECT_GE(seen.green, before - 0.02) << "the leak grows with the angle";
      EXPECT_LE(seen.green, 0.5);
      before = seen.green;
    }
  }
}

}  // namespace
}  // namespace luxel

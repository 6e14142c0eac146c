// voxel_inject with maps: the sun's shadow map, and points that a light sees.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/voxel_inject.h"

namespace luxel {
namespace {

// --- Shadow maps

// Depths of a map that sees a floor at height `low` and, before `edge`, a plate at `high`.
void see_floor(Grid& g, const VoxelShadow& s, const Vec& sun, double low, double high, double edge) {
  g.shadow.assign(static_cast<std::size_t>(s.width) * s.height, 1e30f);
  const auto along = [](const std::array<double, 4>& row, const Vec& p) {
    return row[0] * p[0] + row[1] * p[1] + row[2] * p[2];
  };
  for (int j = 0; j < s.height; ++j)
    for (int i = 0; i < s.width; ++i) {
      // The texel's ray, at depth 0.
      Vec p{};
      const double part[3] = {i + 0.5 - s.to_x[3], j + 0.5 - s.to_y[3], -s.to_depth[3]};
      int k = 0;
      for (const auto& row : {s.to_x, s.to_y, s.to_depth}) {
        for (int c = 0; c < 3; ++c) p[c] += part[k] * row[c] / along(row, {row[0], row[1], row[2]});
        ++k;
      }
      const double to_plate = (p[1] - high) / sun[1], to_floor = (p[1] - low) / sun[1];
      const double depth = p[0] - to_plate * sun[0] < edge ? to_plate : to_floor;
      g.shadow[static_cast<std::size_t>(j) * s.width + i] = static_cast<float>(depth);
    }
}

// The voxels hold no plate: only the map knows it.
TEST(VoxelInjectMap, AShadowMapGivesTheShareOfAVoxelThatIsLit) {
  Grid g(24, 12, 9);
  floor_at(g, 2);
  g.list_bricks();
  const double plate = 9, edge = 10.5, floor = 2.5;
  for (const double degrees : {0.0, 40.0, 80.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec sun{std::sin(angle), std::cos(angle), 0};
    const std::vector<float> light = voxel_lights({{VoxelLight::Kind::sun, sun, {1, 1, 1}, {}, 0}}, {0, 0, 0}, 1);
    const double full = 0.5 / std::numbers::pi * std::cos(angle);
    // The plate's shadow ends here. Texels count whole: 4 of them along the light's projection of a voxel.
    const double shade = edge - (plate - floor) * std::tan(angle), texel = 1 / (4 * std::cos(angle));
    std::vector<double> first;
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      p.shadow = voxel_shadow({24, 12, 9}, sun, 4);
      see_floor(g, p.shadow, sun, floor, plate, edge);
      const std::vector<double> r = radiance(device, g, p, light);
      ASSERT_EQ(r.size(), g.voxels() * 4);
      for (int x = 1; x < 23; ++x) {
        const double share = std::clamp(x + 1 - shade, 0.0, 1.0);
        EXPECT_NEAR(r[g.at(x, 2, 4) * 4], share * full, full * (share > 0 && share < 1 ? texel : float_bound))
            << device << " " << degrees << " " << x;
      }
      if (device == "cpu:double") continue;
      if (first.empty()) first = r;
      EXPECT_TRUE(r == first) << device;
    }
  }
}

TEST(VoxelInjectMap, WhereAMapTellsNothingRaysDo) {
  Grid g(12, 12, 12);
  floor_at(g, 2);
  for (int z = 0; z < 6; ++z) g.put(4, 9, z, {0, 0, 0, 1}, {0, 1, 0});
  g.list_bricks();
  const std::vector<float> light =
      voxel_lights({{VoxelLight::Kind::sun, {0.2, 1, 0.1}, {1, 1, 1}, {}, 0}}, {0, 0, 0}, 1);
  for (const std::string& device : all_devices()) {
    VoxelInjectParams p = g.params();
    p.lights = 1;
    const std::vector<double> without = radiance(device, g, p, light);
    p.shadow = voxel_shadow({12, 12, 12}, {0.2, 1, 0.1}, 2);
    g.shadow.assign(static_cast<std::size_t>(p.shadow.width) * p.shadow.height, 1e30f);
    EXPECT_TRUE(radiance(device, g, p, light) == without) << device;
  }
}

TEST(VoxelInjectMap, RefusesShadowMapsThatItCannotRead) {
  Grid g(8, 8, 8);
  floor_at(g, 1);
  g.list_bricks();
  VoxelInjectParams good = g.params();
  good.lights = 1;
  good.shadow = voxel_shadow({8, 8, 8}, {1, 2, 3}, 2);
  EXPECT_TRUE(validate(good)) << validate(good).message();
  VoxelInjectParams p = good;
  p.lights = 0;
  EXPECT_EQ(validate(p).message(), "VoxelInjectParams.lights is 0; expected 1..65536 with a shadow map");
  p = good;
  p.shadow.height = 0;
  EXPECT_EQ(validate(p).message(), "VoxelInjectParams.shadow.height is 0; expected 1..32768");
  p = good;
  for (double& v : p.shadow.to_x) v *= 8;
  EXPECT_FALSE(validate(p));
  p = good;
  p.shadow.to_y = p.shadow.to_x;
  EXPECT_FALSE(validate(p));
  p = good;
  p.shadow.to_depth[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(validate(p));
}

// --- Reflective shadow maps

struct Texels {
  std::vector<float> words;
  void add(float x, float y, float z, float valid, float r, float g, float b) {
    words.insert(words.end(), {x, y, z, valid, r, g, b, 0});
  }
};

TEST(VoxelInjectMap, AMapsTexelsAreAveragedInAnyOrder) {
  Grid g(12, 8, 20);
  floor_at(g, 3);
  g.list_bricks();
  Texels map;
  std::vector<double> sum(g.voxels() * 3), count(g.voxels());
  for (std::uint32_t i = 0; i < 64 * 32; ++i) {
    const float x = 12 * uniform(5 * i), z = 20 * uniform(5 * i + 1), y = 3 + uniform(5 * i + 2);
    const float e[3] = {2 * uniform(5 * i + 3), uniform(5 * i + 4), 0.5f};
    const bool valid = i % 7 != 0;
    map.add(x, y, z, valid, e[0], e[1], e[2]);
    if (!valid) continue;
    const std::size_t at = g.at(static_cast<int>(x), 3, static_cast<int>(z));
    count[at] += 1;
    for (int c = 0; c < 3; ++c) sum[at * 3 + c] += std::floor(e[c] * (16384 / 2.0) + 0.5) / (16384 / 2.0);
  }
  Texels turned;
  for (std::size_t i = map.words.size(); i > 0; i -= 8)
    turned.words.insert(turned.words.end(), &map.words[i - 8], &map.words[i - 8] + 8);
  VoxelInjectParams p = g.params();
  p.map_width = 64;
  p.map_height = 32;
  p.irradiance_max = 2;
  p.count = true;
  const std::vector<Bytes> cpu = inject("cpu", g, p, map.words);
  for (const std::string& device : all_devices()) {
    const std::vector<Bytes> out = inject(device, g, p, map.words);
    ASSERT_EQ(out.size(), 2u);
    if (device != "cpu:double") {
      EXPECT_EQ(out, cpu) << device;
    }
    EXPECT_EQ(inject(device, g, p, turned.words), out) << device;
    const std::vector<double> r = decode(p.format, out[0], test_context(device).real64());
    std::uint32_t unlit = 0;
    for (std::size_t at = 0; at < g.voxels(); ++at) {
      if (g.colour[at * 4 + 3] == 0) continue;
      unlit += count[at] == 0;
      for (int c = 0; c < 3; ++c) {
        const double expected =
            count[at] == 0 ? 0 : g.colour[at * 4 + c] / std::numbers::pi * sum[at * 3 + c] / count[at];
        EXPECT_NEAR(r[at * 4 + c], expected, float_bound * std::max(expected, 1.0));
      }
    }
    const std::vector<std::uint32_t> outcomes = words(out[1]);
    EXPECT_EQ(outcomes[static_cast<int>(VoxelInjectCount::unlit)], unlit);
    EXPECT_EQ(outcomes[static_cast<int>(VoxelInjectCount::dropped)], 0u);
  }
}

TEST(VoxelInjectMap, BadTexelsAreDroppedAndCounted) {
  Grid g(8, 8, 8);
  floor_at(g, 3);
  g.list_bricks();
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  Texels map;
  map.add(1.5f, 3.5f, 1.5f, 1, 1, 1, 1);
  map.add(1.5f, 3.5f, 1.5f, 1, 5, 1, 1);   // brighter than irradiance_max: saturated, kept as that
  map.add(1.5f, 6.5f, 1.5f, 1, 1, 1, 1);   // an empty voxel
  map.add(-0.5f, 3.5f, 1.5f, 1, 1, 1, 1);  // outside
  map.add(1.5f, 3.5f, 8.0f, 1, 1, 1, 1);   // on the outer face
  map.add(nan, 3.5f, 1.5f, 1, 1, 1, 1);
  map.add(1e30f, 3.5f, infinity, 1, 1, 1, 1);
  map.add(1.5f, 3.5f, 1.5f, 1, nan, 1, 1);
  map.add(1.5f, 3.5f, 1.5f, 1, 1, infinity, 1);
  map.add(1.5f, 3.5f, 1.5f, 1, 1, 1, -1);
  map.add(2.5f, 3.5f, 1.5f, nan, 1, 1, 1);  // not valid, and so not counted
  map.add(2.5f, 3.5f, 1.5f, 0, nan, 1, 1);
  VoxelInjectParams p = g.params();
  p.map_width = 4;
  p.map_height = 3;
  p.irradiance_max = 1;
  p.count = true;
  for (const std::string& device : all_devices()) {
    const std::vector<Bytes> out = inject(device, g, p, map.words);
    ASSERT_EQ(out.size(), 2u);
    EXPECT_EQ(words(out[1]), (std::vector<std::uint32_t>{1, 63, 8, 1, 0, 0, 0, 0})) << device;
    const std::vector<double> r = decode(p.format, out[0], test_context(device).real64());
    EXPECT_NEAR(r[g.at(1, 3, 1) * 4], 0.5 / std::numbers::pi, float_bound) << device;
  }
}

TEST(VoxelInjectMap, LightsAndAMapAddUp) {
  const Grid g = random_grid();
  Texels map;
  for (std::uint32_t i = 0; i < 1024; ++i)
    map.add(13 * uniform(4 * i), 10 * uniform(4 * i + 1), 17 * uniform(4 * i + 2), 1, uniform(4 * i + 3), 0.5f, 0);
  VoxelInjectParams p = g.params();
  p.map_width = 32;
  p.map_height = 32;
  const std::vector<float> lights = voxel_lights(several, {0, 0, 0}, 1);
  std::vector<float> both = lights;
  both.insert(both.end(), map.words.begin(), map.words.end());
  const std::vector<double> by_map = radiance("cpu:double", g, p, map.words);
  p.lights = 3;
  const std::vector<double> together = radiance("cpu:double", g, p, both);
  const std::vector<Bytes> expected = inject("cpu", g, p, both);
  for (const std::string& device : test_devices()) EXPECT_EQ(inject(device, g, p, both), expected) << device;
  p.map_width = p.map_height = 0;
  const std::vector<double> by_lights = radiance("cpu:double", g, p, lights);
  ASSERT_EQ(together.size(), by_map.size());
  for (std::size_t i = 0; i < together.size(); ++i)
    if (i % 4 < 3) {
      ASSERT_NEAR(together[i], by_map[i] + by_lights[i], 1e-12 * (1 + together[i]));
    }
}

// A tilted plane under a sun at the zenith, and maps of N texels a voxel. A voxel is missed where the part of the plane in it,
// seen from above, lies between texels.
TEST(VoxelInjectMap, CracksOfAMapCloseWithItsResolution) {
  const auto height = [](double x, double z) { return 0.37 * x + 0.21 * z + 2.3; };
  Grid g(32, 24, 32);
  std::size_t occupied = 0;
  for (int z = 0; z < 32; ++z)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 32; ++x)
        if (height(x, z) <= y + 1 && height(x + 1, z + 1) >= y) {
          g.put(x, y, z, {0.5f, 0.5f, 0.5f, 1}, {0, 1, 0});
          ++occupied;
        }
  g.list_bricks();
  for (const std::string& device : test_devices()) {
    double before = 1;
    // The share of voxels without a texel's point, counted on paper for each map.
    for (const double per_voxel : {0.5, 1.0, 2.0, 4.0}) {
      const int side = static_cast<int>(32 * per_voxel);
      std::vector<float> map;
      std::vector<char> hit(g.voxels());
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const double x = (i + 0.5) / per_voxel, z = (j + 0.5) / per_voxel;
          for (const double v : {x, height(x, z), z, 1.0, 1.0, 1.0, 1.0, 0.0}) map.push_back(static_cast<float>(v));
          hit[g.at(static_cast<int>(x), static_cast<int>(static_cast<float>(height(x, z))), static_cast<int>(z))] = 1;
        }
      VoxelInjectParams p = g.params();
      p.map_width = p.map_height = side;
      p.count = true;
      const auto out = inject(device, g, p, map);
      const std::vector<std::uint32_t> outcomes = words(out[1]);
      const auto expected = static_cast<std::uint32_t>(std::count(hit.begin(), hit.end(), 1));
      EXPECT_EQ(outcomes[0], expected) << device << " " << per_voxel;
      EXPECT_EQ(outcomes[0] + outcomes[1], occupied) << device;
      EXPECT_EQ(outcomes[2], 0u) << device << ": every point lies in a voxel";
      const double missed = static_cast<double>(outcomes[1]) / static_cast<double>(occupied);
      EXPECT_LT(missed, before) << device << " " << per_voxel;
      if (per_voxel == 0.5) {
        EXPECT_GT(missed, 0.75) << device << ": three columns of four have no texel";
      }
      if (per_voxel == 2) {
        EXPECT_GT(missed, 0.01) << device << ": twice the resolution is not enough for every voxel";
      }
      before = missed;
    }
    EXPECT_LT(before, 0.125) << device << ": what is left are parts of about a texel, 1/16 voxel^2, and less";
  }
}

}  // namespace
}  // namespace luxel

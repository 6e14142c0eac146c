// Whole scenes through voxelize, voxel_inject, mip_build and cone_trace, on every device.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/interleaved.h"
#include "bench/scene/voxel_scene.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using glm::dvec3;

std::shared_ptr<Context> shared_context(const std::string& device) {
  return {std::shared_ptr<Context>(), &test_context(device)};
}

// Receivers on the floor of a scene's middle, from the grid's origin.
std::vector<float> floor_receivers(const VoxelGrid& grid, const scene::Bounds& box, dvec3 low, dvec3 high) {
  std::vector<float> receivers;
  for (int z = 0; z < 8; ++z)
    for (int x = 0; x < 8; ++x) {
      const dvec3 share((x + 0.5) / 8, 0, (z + 0.5) / 8);
      const dvec3 p = box.low + (box.high - box.low) * (low + (high - low) * share);
      for (const double v : {p.x - grid.origin[0], p.y - grid.origin[1], p.z - grid.origin[2], 1.0, 0.0, 1.0, 0.0, 0.0})
        receivers.push_back(static_cast<float>(v));
    }
  return receivers;
}

double mean_red(const std::vector<float>& values) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); i += 4) sum += values[i];
  return sum / (static_cast<double>(values.size()) / 4);
}

struct Seen {
  scene::ConeLight light;
  std::vector<float> reflected;
  std::uint32_t occupied = 0;
};

Seen look(const std::string& device, const scene::Scene& s, const scene::VoxelSceneSettings& settings, dvec3 low,
          dvec3 high) {
  Seen seen;
  auto built = scene::VoxelScene::build(shared_context(device), s, settings);
  EXPECT_TRUE(built.ok()) << built.status().message();
  if (!built.ok()) return seen;
  const Status lit = built.value().light();
  EXPECT_TRUE(lit) << lit.message();
  if (!lit) return seen;
  seen.occupied = built.value().occupied();
  seen.reflected = built.value().reflected().value();
  const std::vector<float> receivers = floor_receivers(built.value().grid(), bounds(s), low, high);
  ConeTraceParams cones;
  cones.normal_offset = 2;
  auto traced = built.value().trace(cones, receivers, {});
  EXPECT_TRUE(traced.ok()) << traced.status().message();
  if (traced.ok()) seen.light = traced.value();
  for (const std::string& message : test_context(device).validation_messages()) ADD_FAILURE() << message;
  return seen;
}

// Every surface emits 1 and reflects a half: irradiance pi from emitters, and half of that after a bounce. A wall of one
// voxel whose opacity is interpolated lets exp(int ln|t| dt), -1 <= t <= 1, pass: e^-2, whatever the resolution; what two
// bounces lose of that is squared.
TEST(VoxelScene, AFurnaceLosesAtMostWhatInterpolatedWallsLeakAtEveryResolution) {
  const scene::Scene furnace = scene::built_in("furnace").value();
  const double least = 1 - std::exp(-2.0);
  for (const std::string& device : test_devices()) {
    std::vector<double> direct;
    for (const int resolution : {32, 64}) {
      if (device == "cpu" && resolution > 32) continue;
      scene::VoxelSceneSettings settings;
      settings.resolution = resolution;
      settings.lamp_pieces = 0;
      settings.two_sided = true;  // the room is a block, whose fronts are outside
      const Seen seen = look(device, furnace, settings, {0.1, 0, 0.1}, {0.3, 0, 0.3});
      ASSERT_FALSE(seen.light.direct.empty());
      direct.push_back(mean_red(seen.light.direct) / std::numbers::pi);
      EXPECT_GE(direct.back(), least) << device << " " << resolution;
      EXPECT_LE(direct.back(), 1) << device << " " << resolution;
      EXPECT_GE(mean_red(seen.light.indirect) / std::numbers::pi, least * least / 2) << device << " " << resolution;
      EXPECT_LE(mean_red(seen.light.indirect) / std::numbers::pi, 0.5) << device << " " << resolution;
    }
    // What leaks depends on where a cone's level changes inside a wall: by half of e^-2 at most.
    EXPECT_NEAR(direct.front(), direct.back(), std::exp(-2.0) / 2) << device << ": brightness by resolution";
  }
}

TEST(VoxelScene, TheSameBitsOnEveryDevice) {
  for (const char* name : {"cornell", "atrium:5000"}) {
    const scene::Scene s = scene::built_in(name).value();
    scene::VoxelSceneSettings settings;
    settings.resolution = 32;
    settings.variant = ConeVariant::anisotropic;
    const Seen expected = look("cpu", s, settings, {0.3, 0, 0.3}, {0.7, 0, 0.7});
    EXPECT_GT(mean_red(expected.light.indirect), 0);
    for (const std::string& device : test_devices()) {
      const Seen seen = look(device, s, settings, {0.3, 0, 0.3}, {0.7, 0, 0.7});
      EXPECT_EQ(seen.occupied, expected.occupied) << device;
      EXPECT_TRUE(seen.reflected == expected.reflected) << device << " " << name;
      EXPECT_TRUE(seen.light.direct == expected.light.direct) << device << " " << name;
      EXPECT_TRUE(seen.light.indirect == expected.light.indirect) << device << " " << name;
    }
  }
}

void add_quad(scene::Scene& s, dvec3 corner, dvec3 a, dvec3 b) {
  const auto first = static_cast<unsigned>(s.positions.size());
  for (const dvec3 p : {corner, corner + a, corner + a + b, corner + b}) s.positions.push_back(p);
  s.indices.insert(s.indices.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
  s.triangle_materials.insert(s.triangle_materials.end(), {0, 0});
}

// Sixteen slats, each as wide as the gap beside it, half a unit: in voxels of a quarter they close most of the gaps.
TEST(VoxelScene, AShadowMapLetsTheSunThroughSlats) {
  scene::Scene s;
  s.materials.resize(1);  // base colour 1/2
  add_quad(s, {-8, 0, 8}, {16, 0, 0}, {0, 0, -16});
  for (int i = 0; i < 16; ++i) add_quad(s, {-8.0 + i, 4, 8}, {0.5, 0, 0}, {0, 0, -16});
  s.sun = {{0, 1, 0}, dvec3(std::numbers::pi)};
  const auto rays = scene::Rays::make(s);
  ASSERT_TRUE(rays.ok());
  for (const std::string& device : test_devices())
    for (const bool map : {false, true}) {
      scene::VoxelSceneSettings settings;
      settings.resolution = 64;
      if (map) settings.rays = &rays.value();
      auto built = scene::VoxelScene::build(shared_context(device), s, settings);
      ASSERT_TRUE(built.ok()) << built.status().message();
      ASSERT_TRUE(built.value().light());
      const std::vector<float> values = built.value().reflected().value();
      const VoxelGrid& grid = built.value().grid();
      // Of the floor's middle: full light would be 1/2.
      const int y = static_cast<int>((0.0 - grid.origin[1]) / grid.voxel);
      double sum = 0;
      int count = 0;
      for (int z = 8; z < 56; ++z)
        for (int x = 8; x < 56; ++x, ++count) sum += values[4 * (static_cast<std::size_t>(z * 64 + y) * 64 + x)];
      // 0.5 of it, to 1/3 of a texel at each of two edges of a slat: 3 texels a voxel.
      const double lit = sum / count / 0.5;
      if (map)
        EXPECT_NEAR(lit, 0.5, 0.06) << device;
      else
        EXPECT_LT(lit, 0.35) << device;  // why there are maps
    }
}

// Radiance 1 + x of an image all around: a plane of normal n gets pi (1 + 2/3 n_x).
TEST(VoxelScene, AnImageOfASkyLightsFromItsDirection) {
  scene::Scene s;
  s.materials.resize(1);
  add_quad(s, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  s.sky = {dvec3(1), 128, 64, {}};
  for (int r = 0; r < 64; ++r)
    for (int c = 0; c < 128; ++c) {
      const double t = (r + 0.5) / 64 * std::numbers::pi, p = (c + 0.5) / 128 * 2 * std::numbers::pi - std::numbers::pi;
      for (int k = 0; k < 3; ++k) s.sky.image.push_back(static_cast<float>(1 + std::sin(t) * std::cos(p)));
    }
  for (const std::string& device : test_devices()) {
    scene::VoxelSceneSettings settings;
    settings.resolution = 16;
    auto built = scene::VoxelScene::build(shared_context(device), s, settings);
    ASSERT_TRUE(built.ok()) << built.status().message();
    ASSERT_TRUE(built.value().light());
    std::vector<float> receivers;
    for (const float side : {1.0f, -1.0f})  // above the floor, which lies behind them
      receivers.insert(receivers.end(), {1.0f, 1.9f, 1.0f, 1.0f, side, 1.0f, 0.0f, 0.0f});
    const auto light = built.value().trace({}, receivers, {});
    ASSERT_TRUE(light.ok()) << light.status().message();
    // Texels of 2.8 degrees and caps between points of 5.6 degrees: 1 %.
    for (const std::size_t i : {0u, 1u})
      EXPECT_NEAR(light.value().direct[4 * i] / std::numbers::pi, 1 + (i == 0 ? 1 : -1) * 2.0 / 3 / std::sqrt(2.0), 0.01)
          << device;
  }
}

TEST(VoxelScene, OcclusionHasAReachOfItsOwn) {
  const scene::Scene s = scene::built_in("cornell").value();
  for (const std::string& device : test_devices()) {
    scene::VoxelSceneSettings settings;
    settings.resolution = 32;
    auto built = scene::VoxelScene::build(shared_context(device), s, settings);
    ASSERT_TRUE(built.ok());
    ASSERT_TRUE(built.value().light());
    const auto receivers = floor_receivers(built.value().grid(), bounds(s), {0.2, 0, 0.85}, {0.8, 0, 0.95});
    const auto all = built.value().trace({}, receivers, {}), near = built.value().trace({}, receivers, {}, 0.15);
    ASSERT_TRUE(all.ok() && near.ok());
    double far_mean = 0, near_mean = 0;
    for (std::size_t i = 0; i < receivers.size() / 8; ++i) {
      EXPECT_GE(near.value().indirect[4 * i + 3], all.value().indirect[4 * i + 3]) << device;
      far_mean += all.value().indirect[4 * i + 3] / static_cast<double>(receivers.size() / 8);
      near_mean += near.value().indirect[4 * i + 3] / static_cast<double>(receivers.size() / 8);
      for (std::size_t c = 4 * i; c < 4 * i + 3; ++c)
        EXPECT_EQ(near.value().indirect[c], all.value().indirect[c]) << device;
    }
    // The box hides most of the sky from its floor; within 0.15 only the blocks' feet stand.
    EXPECT_LT(far_mean, 0.6) << device;
    EXPECT_GT(near_mean, 0.8) << device;
  }
}

// Seed 004, figures 71 and 72: a pattern of single cones, blurred, against all cones at every pixel, blurred alike.
TEST(VoxelScene, APatternIsNearAllConesAfterABlur) {
  const scene::Scene s = scene::built_in("cornell").value();
  const auto rays = scene::Rays::make(s);
  ASSERT_TRUE(rays.ok());
  const scene::GBuffer seen = scene::gbuffer(rays.value(), s.camera, 160, 90);
  const std::string device = test_devices().front();
  scene::VoxelSceneSettings settings;
  settings.resolution = 32;
  auto built = scene::VoxelScene::build(shared_context(device), s, settings);
  ASSERT_TRUE(built.ok());
  ASSERT_TRUE(built.value().light());
  const std::vector<float> receivers = receivers_of(seen, built.value().grid());
  ConeTraceParams p;
  p.width = 160;
  p.height = 90;
  p.cones = cone_set(25).value();
  p.occlusion = false;
  const auto all = built.value().trace(p, receivers, {});
  ASSERT_TRUE(all.ok());
  const auto difference = [&](const std::vector<float>& other) {
    return scene::picture_difference(test_context(device), seen, all.value().indirect, other, 2.5).value();
  };
  EXPECT_EQ(difference(all.value().indirect).max, 0);
  p.pattern_x = p.pattern_y = 5;
  for (const bool turned : {false, true}) {
    p.rotate = turned;
    const auto dealt = built.value().trace(p, receivers, {});
    ASSERT_TRUE(dealt.ok());
    const auto d = difference(dealt.value().indirect);
    EXPECT_LE(d.mean, d.p95);
    EXPECT_LE(d.p95, d.max);
    EXPECT_GT(d.max, 0);
    // Tiles that turn each on its own no longer hold the whole set in every 5 x 5 pixels.
    EXPECT_GT(d.within, turned ? 0.7 : 0.9) << d.mean << " " << d.p95 << " " << d.max;
  }
  p.pattern_x = p.pattern_y = 1;
  p.cones = {cone_set(25).value().back()};  // one for all is not
  const auto one = built.value().trace(p, receivers, {});
  EXPECT_LT(difference(one.value().indirect).within, 0.7);
}

TEST(VoxelScene, WhatASceneDoesNotHaveIsNotMade) {
  scene::Scene dark = scene::built_in("atrium:5000").value();
  dark.sky = {};
  scene::VoxelSceneSettings settings;
  settings.resolution = 32;
  const Seen seen = look(test_devices().front(), dark, settings, {0.3, 0, 0.3}, {0.7, 0, 0.7});
  EXPECT_TRUE(seen.light.direct.empty());
  EXPECT_TRUE(seen.light.glossy.empty());
  dark.sun.irradiance = dvec3(0);
  EXPECT_EQ(mean_red(look(test_devices().front(), dark, settings, {0.3, 0, 0.3}, {0.7, 0, 0.7}).light.indirect), 0);
}

}  // namespace
}  // namespace luxel

// Whole scenes through voxelize, voxel_inject, mip_build and cone_trace, on every device.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

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

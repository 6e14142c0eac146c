// Reflective shadow maps by ray casts against closed forms and path tracing, and scenes in light propagation volumes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/gbuffer.h"
#include "bench/scene/lpv_scene.h"
#include "bench/truth/path_truth.h"
#include "bench/truth/vpl_truth.h"
#include "tests/support/run.h"

namespace luxel::scene {
namespace {

using glm::dvec3;
constexpr double pi = std::numbers::pi;

void add_quad(Scene& s, dvec3 corner, dvec3 u, dvec3 v, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(s.positions.size());
  for (const dvec3 p : {corner, corner + u, corner + u + v, corner + v}) s.positions.push_back(p);
  s.indices.push_back({first, first + 1, first + 2});
  s.indices.push_back({first, first + 2, first + 3});
  s.triangle_materials.insert(s.triangle_materials.end(), 2, material);
}

Scene with_materials(dvec3 albedo, dvec3 emission = dvec3(0)) {
  Scene s;
  s.materials.resize(2);
  s.materials[0].base_color = albedo;
  s.materials[1].base_color = dvec3(0);
  s.materials[1].emission = emission;
  s.sun.irradiance = dvec3(0);
  s.sky.radiance = dvec3(0);
  return s;
}

dvec3 flux_of(const std::vector<VirtualLight>& lights) {
  dvec3 sum(0);
  for (const VirtualLight& l : lights) sum += l.flux;
  return sum;
}

TEST(Rsm, SunOnAFloorSendsOnAlbedoIrradianceCosineArea) {
  Scene s = with_materials({0.5, 0.25, 1});
  add_quad(s, {0, 0, 0}, {0, 0, 3}, {2, 0, 0}, 0);
  for (const double degrees : {0.0, 40.0, 75.0}) {
    const double angle = degrees * pi / 180;
    s.sun = {{std::sin(angle), std::cos(angle), 0}, {4, 5, 6}};
    const auto rays = Rays::make(s);
    ASSERT_TRUE(rays.ok());
    RsmSettings settings;
    settings.sun_texels = 200;
    const auto lights = reflective_shadow_maps(rays.value(), settings);
    const dvec3 flux = flux_of(lights), expected = dvec3(0.5 * 4, 0.25 * 5, 1 * 6) * (std::cos(angle) * 6);
    // Texels tile the floor's own rectangle: only those that a side cuts are whole or not there.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] / expected[c], 1, 0.02) << degrees;
    double area = 0;
    for (const VirtualLight& l : lights) {
      area += l.area;
      EXPECT_NEAR(l.normal.y, 1, 1e-9);
      EXPECT_NEAR(l.position.y, 0, 1e-9);
    }
    EXPECT_NEAR(area / 6, 1, 0.02) << degrees;
  }
}

TEST(Rsm, SkyLightsBothSidesOfAFloor) {
  Scene s = with_materials({0.5, 0.25, 1});
  add_quad(s, {0, 0, 0}, {0, 0, 3}, {2, 0, 0}, 0);
  s.sky.radiance = {1, 2, 3};
  const auto rays = Rays::make(s);
  ASSERT_TRUE(rays.ok());
  RsmSettings settings;
  settings.sky_directions = 64;
  settings.sky_texels = 48;
  const auto lights = reflective_shadow_maps(rays.value(), settings);
  const dvec3 flux = flux_of(lights), expected = dvec3(0.5, 0.5, 3) * (2 * pi * 6);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] / expected[c], 1, 0.03);
}

// A lamp in a closed room with white walls: all that it sends is sent on.
TEST(Rsm, ALampInAClosedRoomIsAllSentOn) {
  Scene s = with_materials({1, 0.5, 0.25}, {3, 2, 1});
  add_quad(s, {0, 0, 0}, {4, 0, 0}, {0, 0, 4}, 0);
  add_quad(s, {0, 4, 0}, {4, 0, 0}, {0, 0, 4}, 0);
  add_quad(s, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0);
  add_quad(s, {0, 0, 4}, {4, 0, 0}, {0, 4, 0}, 0);
  add_quad(s, {0, 0, 0}, {0, 0, 4}, {0, 4, 0}, 0);
  add_quad(s, {4, 0, 0}, {0, 0, 4}, {0, 4, 0}, 0);
  add_quad(s, {1, 3, 1}, {1, 0, 0}, {0, 0, 1}, 1);
  const auto rays = Rays::make(s);
  ASSERT_TRUE(rays.ok());
  const auto lights = reflective_shadow_maps(rays.value(), {});
  // Both of its sides emit; every ray meets a wall.
  const dvec3 flux = flux_of(lights), expected = dvec3(3, 1, 0.25) * (2 * pi);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(flux[c] / expected[c], 1, 1e-3);
  // Half of it goes up, where the ceiling is near.
  double up = 0;
  for (const VirtualLight& l : lights) up += l.position.y > 3 ? l.flux.x : 0;
  EXPECT_NEAR(up / flux.x, 0.5, 0.03);
}

TEST(Rsm, EveryGeneratedSceneHasLightsAndTheSameTwice) {
  for (const std::string_view name : built_in_names()) {
    const auto s = built_in(std::string(name) == "atrium" ? "atrium:5000" : std::string(name));
    ASSERT_TRUE(s.ok()) << name;
    const auto rays = Rays::make(s.value());
    ASSERT_TRUE(rays.ok());
    RsmSettings settings;
    settings.sun_texels = settings.sky_texels = 16;
    settings.lamp_rays = 1000;
    const auto a = reflective_shadow_maps(rays.value(), settings), b = reflective_shadow_maps(rays.value(), settings);
    EXPECT_GT(a.size(), 100u) << name;
    EXPECT_GT(flux_of(a).x, 0) << name;
    ASSERT_EQ(a.size(), b.size()) << name;
    EXPECT_EQ(lights_list(a, dvec3(0)), lights_list(b, dvec3(0))) << name;
    for (const VirtualLight& l : a) ASSERT_TRUE(std::isfinite(l.area) && l.area > 0 && std::fabs(glm::length(l.normal) - 1) < 1e-9) << name;
  }
}

TEST(Rsm, PiecesCoverEverySurface) {
  const auto s = built_in("cornell");
  ASSERT_TRUE(s.ok());
  double area = 0, pieces = 0;
  for (const auto& t : s.value().indices)
    area += glm::length(glm::cross(s.value().positions[t.y] - s.value().positions[t.x], s.value().positions[t.z] - s.value().positions[t.x])) / 2;
  for (const VirtualLight& p : surface_pieces(s.value(), 0.01)) {
    EXPECT_LE(p.area, 0.01);
    pieces += p.area;
  }
  EXPECT_NEAR(pieces / area, 1, 1e-12);
}

// Small lights with shadow rays are one bounce of path tracing, up to their number.
TEST(Rsm, SmallLightsGiveWhatPathTracingGives) {
  for (const char* name : {"cornell", "atrium:5000"}) {
    const auto s = built_in(name);
    ASSERT_TRUE(s.ok());
    const auto rays = Rays::make(s.value());
    ASSERT_TRUE(rays.ok());
    const GBuffer g = gbuffer(rays.value(), s.value().camera, 8, 6);
    truth::PathSettings settings;
    settings.samples = 1024;
    settings.bounces = 1;
    settings.glossy = false;
    const auto traced = truth::path_truth(rays.value(), truth::receivers(g, s.value().camera.eye), settings);
    ASSERT_TRUE(traced.ok());
    std::vector<dvec3> places, normals;
    double expected = 0;
    for (std::size_t i = 0; i < g.pixels(); ++i)
      if (g.surface_at(i)) {
        places.push_back(g.at(g.position, i));
        normals.push_back(g.at(g.normal, i));
        expected += traced.value().indirect.rgb(i).y;
      }
    RsmSettings maps;
    maps.sun_texels = 96;
    maps.sky_directions = 48;
    maps.sky_texels = 24;
    maps.lamp_rays = 8192;
    const auto e = truth::vpl_irradiance(rays.value(), reflective_shadow_maps(rays.value(), maps), places, normals);
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) sum += e[3 * i + 1];
    EXPECT_NEAR(sum / expected, 1, 0.06) << name;
  }
}

TEST(LpvScene, AScaledSceneGivesTheSameLight) {
  const auto s = built_in("cornell");
  ASSERT_TRUE(s.ok());
  for (const std::string& device : test_devices()) {
    std::vector<float> first;
    for (const double scale : {1.0, 1e-3, 1e4}) {
      Scene scaled = s.value();
      for (dvec3& p : scaled.positions) p *= scale;
      const auto rays = Rays::make(scaled);
      ASSERT_TRUE(rays.ok());
      LpvSceneSettings settings;
      settings.resolution = 8;
      auto built = LpvScene::build({std::shared_ptr<Context>(), &test_context(device)}, rays.value(), settings);
      ASSERT_TRUE(built.ok()) << built.status().message();
      LpvScene& volumes = built.value();
      std::vector<float> receivers;
      for (int i = 0; i < 40; ++i) {
        const dvec3 p = dvec3(-0.9 + 0.045 * i, i % 2 == 0 ? 0 : 1.99, 0.3) * scale - volumes.origin();
        for (const double v : {p.x, p.y, p.z, 1.0, 0.0, i % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0}) receivers.push_back(static_cast<float>(v));
      }
      ASSERT_TRUE(volumes.light({}, receivers).ok());
      const auto seen = volumes.sample({}, receivers);
      ASSERT_TRUE(seen.ok());
      double mean = 0, apart = 0;
      if (first.empty()) first = seen.value().irradiance;
      for (std::size_t i = 0; i < first.size(); ++i)
        if (i % 4 < 3) {
          mean += first[i] / 120;
          apart = std::max<double>(apart, std::fabs(seen.value().irradiance[i] - first[i]));
        }
      EXPECT_GT(mean, 0.02) << device;  // light is there
      // f16 between steps, and lights near a cell's face that rounding moves to its neighbour.
      EXPECT_LE(apart / mean, 0.02) << device << " " << scale;
    }
  }
}

TEST(LpvScene, CascadesThatNoReceiverReadsAreNotRun) {
  const auto s = built_in("cornell");
  ASSERT_TRUE(s.ok());
  const auto rays = Rays::make(s.value());
  ASSERT_TRUE(rays.ok());
  const std::string device = test_devices().front();
  LpvSceneSettings settings;
  settings.resolution = 16;
  settings.cascades = 3;
  settings.centre = {0, 1, 0};
  auto built = LpvScene::build({std::shared_ptr<Context>(), &test_context(device)}, rays.value(), settings);
  ASSERT_TRUE(built.ok()) << built.status().message();
  LpvScene& volumes = built.value();
  const auto at = [&](dvec3 p) {
    p -= volumes.origin();
    return std::vector<float>{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 1, 0, 1, 0, 0};
  };
  const std::vector<float> middle = at({0, 1, 0}), floor = at({0.9, 0.001, 0.9});
  ASSERT_TRUE(volumes.light({}, middle).ok());
  EXPECT_EQ(volumes.cascades_run(), (std::vector<bool>{true, false, false}));
  const auto alone = volumes.sample({}, middle);
  ASSERT_TRUE(volumes.light({}, floor).ok());
  EXPECT_FALSE(volumes.cascades_run()[0]);
  EXPECT_TRUE(volumes.cascades_run()[2]);
  ASSERT_TRUE(volumes.light().ok());
  const auto all = volumes.sample({}, middle);
  ASSERT_TRUE(alone.ok() && all.ok());
  EXPECT_EQ(alone.value().irradiance, all.value().irradiance);
  EXPECT_GT(all.value().irradiance[1], 0);
}

TEST(LpvScene, GreyLightIsOneChannelAndTheSame) {
  const auto s = built_in("furnace");
  ASSERT_TRUE(s.ok());
  const auto rays = Rays::make(s.value());
  ASSERT_TRUE(rays.ok());
  const std::string device = test_devices().front();
  std::vector<float> first;
  for (const bool grey : {true, false}) {
    LpvSceneSettings settings;
    settings.resolution = 8;
    settings.find_grey = grey;
    auto built = LpvScene::build({std::shared_ptr<Context>(), &test_context(device)}, rays.value(), settings);
    ASSERT_TRUE(built.ok());
    ASSERT_TRUE(built.value().light().ok());
    EXPECT_EQ(built.value().channels(), grey ? 1 : 3);
    const dvec3 p = dvec3(0.1, 0.2, 0.1) - built.value().origin();
    const auto seen = built.value().sample({}, {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 1, 0, 1, 0, 0});
    ASSERT_TRUE(seen.ok());
    if (first.empty()) first = seen.value().irradiance;
    EXPECT_EQ(seen.value().irradiance, first);
    EXPECT_GT(first[0], 0);
  }
}

}  // namespace
}  // namespace luxel::scene

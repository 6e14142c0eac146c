// voxel_inject against closed forms and against a walk that clips its ray by every cell, on every device.
#include <gtest/gtest.h>
#include <luxel/voxel_inject.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <limits>

#include "tests/support/voxel_inject.h"

namespace luxel {
namespace {

double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// --- Closed forms

TEST(VoxelInject, ASunOnAFloorGivesLambertsCosine) {
  Grid g(20, 12, 9);
  floor_at(g, 2);
  g.list_bricks();
  for (const double degrees : {0.0, 30.0, 60.0, 85.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const std::vector<float> light = voxel_lights(
        {{VoxelLight::Kind::sun, {std::sin(angle), std::cos(angle), 0}, {2, 3, 4}, {0, 0, 0}, 0}}, {0, 0, 0}, 1);
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      const std::vector<double> r = radiance(device, g, p, light);
      ASSERT_EQ(r.size(), g.voxels() * 4);
      for (int z = 0; z < g.n[2]; ++z)
        for (int x = 0; x < g.n[0]; ++x)
          for (int c = 0; c < 3; ++c) {
            const double expected = g.colour[g.at(x, 2, z) * 4 + c] / std::numbers::pi * (2 + c) * std::cos(angle);
            EXPECT_NEAR(r[g.at(x, 2, z) * 4 + c], expected, expected * float_bound + 1e-7 * std::cos(angle))
                << device << " " << degrees;
          }
      EXPECT_EQ(r[g.at(3, 3, 3) * 4 + 3], 0) << device;
      EXPECT_EQ(r[g.at(3, 2, 3) * 4 + 3], 1) << device;
    }
  }
}

TEST(VoxelInject, APointLightFallsOffWithTheSquareInSceneUnits) {
  Grid g(16, 16, 16);
  floor_at(g, 1);
  g.list_bricks();
  // Voxels of 1/4 unit whose corner is far from 0: the light hangs 2.5 units above the centre of voxel (8, 1, 8).
  const Vec origin{1e6, -2e6, 5e5};
  const double voxel = 0.25;
  const Vec place{origin[0] + 8.5 * voxel, origin[1] + 1.5 * voxel + 2.5, origin[2] + 8.5 * voxel};
  for (const auto kind : {VoxelLight::Kind::point, VoxelLight::Kind::patch}) {
    const std::vector<float> light = voxel_lights({{kind, place, {1, 1, 1}, {0, -3, 0}, 0}}, origin, voxel);
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      p.voxel = voxel;
      const std::vector<double> r = radiance(device, g, p, light);
      ASSERT_EQ(r.size(), g.voxels() * 4);
      for (int x = 0; x < 16; ++x) {
        const double across = (x - 8) * voxel, squared = across * across + 2.5 * 2.5, cosine = 2.5 / std::sqrt(squared);
        double expected = g.colour[g.at(x, 1, 8) * 4] / std::numbers::pi * cosine / squared;
        if (kind == VoxelLight::Kind::patch) expected *= cosine;
        EXPECT_NEAR(r[g.at(x, 1, 8) * 4], expected, expected * float_bound) << device << " " << x;
      }
    }
  }
}

TEST(VoxelInject, APatchThatTouchesSendsNoMoreThanItsRadiance) {
  Grid g(8, 8, 8);
  floor_at(g, 1);
  g.list_bricks();
  // A disc of radius 1/2 voxel, radiance 2, seen along its axis: E = pi L r^2 / (d^2 + r^2).
  const double radius = 0.5, area = std::numbers::pi * radius * radius;
  for (const double d : {1e-6, 0.25, 1.0, 4.0}) {
    const std::vector<float> light =
        voxel_lights({{VoxelLight::Kind::patch, {3.5, 1.5 + d, 3.5}, {2 * area, 2 * area, 2 * area}, {0, -1, 0}, area}},
                     {0, 0, 0}, 1);
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      const std::vector<double> r = radiance(device, g, p, light);
      ASSERT_EQ(r.size(), g.voxels() * 4);
      const double expected = 0.5 * 2 * radius * radius / (d * d + radius * radius);
      // The distance is a difference of floats of about 2.
      EXPECT_NEAR(r[g.at(3, 1, 3) * 4], expected, expected * (float_bound + (d < 1e-3 ? 1e-2 : 1e-6)))
          << device << " " << d;
    }
  }
}

TEST(VoxelInject, APlateCastsItsShadowAndGlassPassesItsShare) {
  for (const float opacity : {1.0f, 0.5f}) {
    Grid g(24, 16, 24);
    floor_at(g, 1);
    for (int z = 8; z < 16; ++z)
      for (int x = 8; x < 16; ++x) g.put(x, 9, z, {0, 0, 0, opacity}, {0, 1, 0});
    g.list_bricks();
    const std::vector<float> light = voxel_lights({{VoxelLight::Kind::sun, {0, 1, 0}, {1, 1, 1}, {}, 0}}, {0, 0, 0}, 1);
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      p.count = true;
      const std::vector<Bytes> out = inject(device, g, p, light);
      ASSERT_EQ(out.size(), 2u);
      const std::vector<double> r = decode(p.format, out[0], test_context(device).real64());
      for (int z = 0; z < 24; ++z)
        for (int x = 0; x < 24; ++x) {
          const bool under = x >= 8 && x < 16 && z >= 8 && z < 16;
          const double full = 0.5 / std::numbers::pi;
          EXPECT_NEAR(r[g.at(x, 1, z) * 4], under ? full * (1 - opacity) : full, full * float_bound) << device;
        }
      const std::vector<std::uint32_t> outcomes = words(out[1]);
      const std::uint32_t unlit = opacity == 1 ? 64u : 0u;
      EXPECT_EQ(outcomes[static_cast<int>(VoxelInjectCount::unlit)], unlit) << device;
      EXPECT_EQ(outcomes[static_cast<int>(VoxelInjectCount::lit)], 24u * 24 + 64 - unlit) << device;
    }
  }
}

// A ray that is moved off the floor must end below the ceiling that its lamp hangs in.
TEST(VoxelInject, LampsAtACeilingLightTheFloorBelow) {
  Grid g(16, 24, 16);
  floor_at(g, 1);
  for (int z = 0; z < 16; ++z)
    for (int x = 0; x < 16; ++x) g.put(x, 22, z, {0.5f, 0.5f, 0.5f, 1.0f}, {0, -1, 0});
  g.list_bricks();
  const double lamp = 22.5, under = 20.5, floor = 1.5;
  const std::vector<VoxelLight> lamps{{VoxelLight::Kind::patch, {8.5, lamp, 8.5}, {100, 100, 100}, {0, -1, 0}, 1},
                                      {VoxelLight::Kind::point, {8.5, under, 8.5}, {100, 100, 100}, {}, 0}};
  for (const VoxelLight& light : lamps)
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      const std::vector<double> r = radiance(device, g, p, voxel_lights({light}, {0, 0, 0}, 1));
      ASSERT_EQ(r.size(), g.voxels() * 4);
      const bool patch = light.kind == VoxelLight::Kind::patch;
      const double height = light.place[1] - floor;
      for (int x = 0; x < 16; ++x) {
        const double squared = (x - 8) * (x - 8) + height * height, cosine = height / std::sqrt(squared);
        const double e = 100 * cosine * (patch ? cosine / (squared + 1 / std::numbers::pi) : 1 / squared);
        EXPECT_NEAR(r[g.at(x, 1, 8) * 4], 0.5 / std::numbers::pi * e, e * float_bound) << device << " " << x;
      }
    }
}

TEST(VoxelInject, OnlyFrontsAreLitWhereThatIsAsked) {
  Grid g(16, 8, 16);
  floor_at(g, 3);
  g.list_bricks();
  for (const double up : {1.0, -1.0}) {
    const std::vector<float> light =
        voxel_lights({{VoxelLight::Kind::sun, {0, up, 0}, {1, 1, 1}, {}, 0}}, {0, 0, 0}, 1);
    for (const std::string& device : all_devices())
      for (const bool two_sided : {false, true}) {
        VoxelInjectParams p = g.params();
        p.lights = 1;
        p.two_sided = two_sided;
        const std::vector<double> r = radiance(device, g, p, light);
        ASSERT_EQ(r.size(), g.voxels() * 4);
        const double expected = up > 0 || two_sided ? 0.5 / std::numbers::pi : 0;
        EXPECT_NEAR(r[g.at(5, 3, 5) * 4], expected, float_bound) << device << " " << up;
      }
  }
}

// --- Any volume: against the product over all cells

double transmittance(const Grid& g, const Vec& from, const Vec& to, double reach) {
  double passed = 1;
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y)
      for (int x = 0; x < g.n[0]; ++x) {
        if (g.coverage(x, y, z) == 0) continue;
        double enter = 0, leave = reach;
        const int cell[3] = {x, y, z};
        for (int i = 0; i < 3; ++i) {
          const double a = (cell[i] - from[i]) / to[i], b = (cell[i] + 1 - from[i]) / to[i];
          enter = std::max(enter, std::min(a, b));
          leave = std::min(leave, std::max(a, b));
        }
        if (leave > enter) passed *= std::pow(1 - g.coverage(x, y, z), leave - enter);
      }
  return passed;
}

TEST(VoxelInject, LightsThroughAnyVolume) {
  const Grid g = random_grid();
  const double offset = 0.8;
  const std::vector<float> light = voxel_lights(several, {0, 0, 0}, 1);
  for (const std::string& device : all_devices()) {
    VoxelInjectParams p = g.params();
    p.lights = 3;
    p.normal_offset = offset;
    p.emission = true;
    const std::vector<double> r = radiance(device, g, p, light);
    ASSERT_EQ(r.size(), g.voxels() * 4);
    double worst = 0;
    int compared = 0, differ = 0;
    for (int z = 0; z < g.n[2]; ++z)
      for (int y = 0; y < g.n[1]; ++y)
        for (int x = 0; x < g.n[0]; ++x) {
          const std::size_t at = g.at(x, y, z) * 4;
          if (g.coverage(x, y, z) == 0) {
            for (int c = 0; c < 4; ++c) ASSERT_EQ(r[at + c], 0);
            continue;
          }
          const Vec n{g.normal[at], g.normal[at + 1], g.normal[at + 2]}, centre{x + 0.5, y + 0.5, z + 0.5};
          const double length = std::sqrt(inner(n, n));
          double e[3] = {0, 0, 0};
          for (std::size_t k = 0; k < several.size(); ++k) {
            Vec to{light[12 * k], light[12 * k + 1], light[12 * k + 2]};
            double reach = 1e9, share = 1, tilt = 1;
            if (k > 0) {
              for (int i = 0; i < 3; ++i) to[i] -= centre[i];
              reach = std::sqrt(inner(to, to));
              for (double& v : to) v /= reach;
              share = 1 / (reach * reach);
              if (k == 2) {
                tilt = std::max(1e-30, -(to[0] * light[32] + to[1] * light[33] + to[2] * light[34]));
                share *= tilt > 1e-30 ? tilt : 0;
              }
            }
            const double facing = inner(n, to);
            share *= std::abs(facing) + (1 - length) / 4;
            Vec from, above;
            for (int i = 0; i < 3; ++i) above[i] = (facing < 0 ? -1 : 1) * n[i] / length;
            for (int i = 0; i < 3; ++i) from[i] = centre[i] + offset * above[i];
            if (k == 1) reach -= offset * inner(above, to);
            if (k == 2) reach += offset * (inner(above, {light[32], light[33], light[34]}) - 1) / tilt;
            // Rays that begin outside see no voxels.
            bool inside = true;
            for (int i = 0; i < 3; ++i) inside = inside && from[i] >= 0 && from[i] < g.n[i];
            if (inside) share *= transmittance(g, from, to, reach);
            for (int c = 0; c < 3; ++c) e[c] += share * light[12 * k + 4 + c];
          }
          for (int c = 0; c < 3; ++c) {
            const double expected =
                g.coverage(x, y, z) * (g.colour[at + c] / std::numbers::pi * e[c] + g.emission[at + c]);
            const double error = std::abs(r[at + c] - expected) / std::max(1.0, expected);
            ++compared;
            if (error > 2e-5)
              ++differ;
            else
              worst = std::max(worst, error);
          }
        }
    EXPECT_GT(compared, 1000);
    // In float a ray that grazes an edge may take the other cell; opaque cells make that a step.
    EXPECT_LE(differ, device == "cpu:double" ? 0 : compared / 200) << device;
    EXPECT_LE(worst, device == "cpu:double" ? 1e-9 : 2e-5) << device;
  }
}

TEST(VoxelInject, SameBitsOnEveryDevice) {
  const Grid g = random_grid();
  const std::vector<float> light = voxel_lights(several, {0, 0, 0}, 1);
  for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4})
    for (const bool emission : {false, true}) {
      VoxelInjectParams p = g.params();
      p.format = format;
      p.lights = 3;
      p.emission = emission;
      p.scale = 0.25;
      p.count = true;
      const std::vector<Bytes> expected = inject("cpu", g, p, light);
      for (const std::string& device : test_devices())
        EXPECT_EQ(inject(device, g, p, light), expected) << device << " " << name(format);
    }
}

// --- What is left out, and refusals

TEST(VoxelInject, WithoutClearingOnlyTouchedBricksAreWritten) {
  Grid g(24, 8, 8);
  g.put(3, 3, 3, {1, 1, 1, 1}, {0, 1, 0});
  g.put(20, 3, 3, {1, 1, 1, 1}, {0, 1, 0});
  g.list_bricks();
  ASSERT_EQ(g.bricks.size(), 2u);
  const std::vector<float> light = voxel_lights({{VoxelLight::Kind::sun, {0, 1, 0}, {1, 1, 1}, {}, 0}}, {0, 0, 0}, 1);
  VoxelInjectParams p = g.params();
  p.lights = 1;
  p.clear = false;
  for (const std::string& device : test_devices()) {
    const std::vector<Bytes> out = inject(device, g, p, light, Bytes(g.voxels() * 16, 0x3e));
    ASSERT_EQ(out.size(), 1u);
    for (int x = 0; x < 24; ++x) {
      const bool between = x >= 8 && x < 16;
      EXPECT_EQ(out[0][g.at(x, 0, 0) * 16], between ? 0x3e : 0) << device << " " << x;
    }
    p.clear = true;
    const std::vector<Bytes> cleared = inject(device, g, p, light, Bytes(g.voxels() * 16, 0x3e));
    EXPECT_EQ(cleared[0][g.at(12, 0, 0) * 16], 0) << device;
    p.clear = false;
  }
}

TEST(VoxelInject, AVoxelWithoutANormalIsLitFromEverywhere) {
  Grid g(8, 8, 8);
  g.put(3, 3, 3, {1, 1, 1, 1}, {0, 0, 0});
  g.list_bricks();
  for (const Vec to : {Vec{0, 1, 0}, Vec{-1, 2, 0.5}}) {
    const std::vector<float> light = voxel_lights({{VoxelLight::Kind::sun, to, {1, 1, 1}, {}, 0}}, {0, 0, 0}, 1);
    for (const std::string& device : all_devices()) {
      VoxelInjectParams p = g.params();
      p.lights = 1;
      const std::vector<double> r = radiance(device, g, p, light);
      ASSERT_EQ(r.size(), g.voxels() * 4);
      EXPECT_NEAR(r[g.at(3, 3, 3) * 4], 0.25 / std::numbers::pi, float_bound) << device;
    }
  }
}

TEST(VoxelInject, RefusesWhatItCannotTake) {
  VoxelInjectParams good;
  good.width = good.height = good.depth = 16;
  good.bricks = 8;
  EXPECT_TRUE(validate(good));
  const auto refused = [&](auto change, const std::string& field) {
    VoxelInjectParams p = good;
    change(p);
    const Status status = validate(p);
    EXPECT_FALSE(status) << field;
    EXPECT_NE(status.message().find("VoxelInjectParams." + field + " is "), std::string::npos) << status.message();
  };
  using P = VoxelInjectParams;
  refused([](P& p) { p.width = 0; }, "width");
  refused([](P& p) { p.height = 2049; }, "height");
  refused([](P& p) { p.width = p.height = p.depth = 2048; }, "depth");
  refused([](P& p) { p.format = Format::f32x1; }, "format");
  refused([](P& p) { p.bricks = 9; }, "bricks");
  refused([](P& p) { p.lights = -1; }, "lights");
  refused([](P& p) { p.normal_offset = std::nan(""); }, "normal_offset");
  refused([](P& p) { p.voxel = 0; }, "voxel");
  refused([](P& p) { p.scale = std::numeric_limits<double>::infinity(); }, "scale");
  refused([](P& p) { p.map_height = 4; }, "map_width");
  refused([](P& p) { p.map_width = 4; }, "map_height");
  refused([](P& p) { p.irradiance_max = 0; }, "irradiance_max");
}

// --- Windows

// A hall with a few blocks, lit by a sun, a point, a patch and a map.
Grid hall() {
  Grid g(24, 16, 32);
  floor_at(g, 2);
  for (int z = 5; z < 30; ++z)
    for (int y = 3; y < 14; ++y) g.put(z % 7 + 9, y, z, {0.2f, 0.9f, 0.6f, y % 2 ? 1.0f : 0.4f}, {0.6f, 0, 0.3f});
  for (std::size_t i = 0; i < g.emission.size(); ++i) g.emission[i] = 0.01f * static_cast<float>(i % 17);
  g.list_bricks();
  return g;
}

// A volume as a window at `first` stores it.
std::vector<float> rolled(const Grid& g, const std::vector<float>& values, std::array<int, 3> first) {
  std::vector<float> out(values.size());
  const auto modulo = [](int a, int n) { return (a % n + n) % n; };
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y)
      for (int x = 0; x < g.n[0]; ++x)
        std::copy_n(&values[4 * g.at(x, y, z)], 4,
                    &out[4 * g.at(modulo(x + first[0], g.n[0]), modulo(y + first[1], g.n[1]), modulo(z + first[2], g.n[2]))]);
  return out;
}

TEST(VoxelInject, AWindowIsLitAsTheGridThatItHolds) {
  const Grid g = hall();
  std::vector<float> light = voxel_lights({{VoxelLight::Kind::sun, {0.3, 1, 0.4}, {3, 2, 1}, {}, 0},
                                           {VoxelLight::Kind::point, {4, 9, 10}, {50, 60, 70}, {}, 0},
                                           {VoxelLight::Kind::patch, {20, 13, 16}, {90, 60, 70}, {0, -1, 0}, 2}},
                                          {0, 0, 0}, 1);
  for (int i = 0; i < 40; ++i) {  // across several bricks, and a few in empty voxels
    const float at = static_cast<float>(i);
    light.insert(light.end(), {1.0f + at / 2, 2.5f, 4.0f + at * 0.7f, 1, 0.5f, 0.25f, at / 40, 0});
  }
  VoxelInjectParams p = g.params();
  p.lights = 3;
  p.map_width = 40;
  p.map_height = 1;
  p.emission = true;
  p.count = true;
  for (const std::string& device : all_devices()) {
    const std::vector<Bytes> plain = inject(device, g, p, light);
    const std::vector<double> expected = decode(p.format, plain[0], test_context(device).real64());
    for (const std::array<int, 3> first : {std::array{0, 0, 0}, std::array{8, -8, 40}, std::array{-13, 5, 101}}) {
      VoxelInjectParams q = p;
      q.toroidal = true;
      q.window = first;
      Grid window = g;
      for (std::vector<float>* v : {&window.colour, &window.normal, &window.emission}) *v = rolled(g, *v, first);
      window.bricks = voxel_all_bricks(q);
      EXPECT_EQ(window.bricks.size(), 4u * 3 * 5);
      window.counters[2] = static_cast<std::uint32_t>(window.bricks.size());
      q.bricks = static_cast<int>(window.bricks.size());
      const std::vector<Bytes> out = inject(device, window, q, light);
      const std::vector<double> found = decode(p.format, out[0], test_context(device).real64());
      const std::vector<float> as_floats(expected.begin(), expected.end());
      const std::vector<float> moved = rolled(g, as_floats, first);
      std::size_t different = 0;
      for (std::size_t i = 0; i < moved.size(); ++i) different += static_cast<float>(found[i]) != moved[i];
      EXPECT_EQ(different, 0u) << device << " window at " << first[0];
      EXPECT_EQ(words(out[1]), words(plain[1])) << device;
    }
  }
}

}  // namespace
}  // namespace luxel

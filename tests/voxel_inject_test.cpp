// voxel_inject against closed forms and against a walk that clips its ray by every cell, on every device.
#include <gtest/gtest.h>
#include <luxel/voxel_inject.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <limits>

#include "tests/support/pyramid.h"

namespace luxel {
namespace {

using Vec = std::array<double, 3>;

double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// A grid of voxels as voxelize would hand it over.
struct Grid {
  int n[3];
  std::vector<float> colour, normal, emission;
  std::vector<float> shadow;  // depths of a map
  std::vector<std::uint32_t> bricks, counters = std::vector<std::uint32_t>(16);

  Grid(int x, int y, int z) : n{x, y, z}, colour(voxels() * 4), normal(voxels() * 4), emission(voxels() * 4) {}
  std::size_t voxels() const { return static_cast<std::size_t>(n[0] * n[1] * n[2]); }
  std::size_t at(int x, int y, int z) const { return static_cast<std::size_t>((z * n[1] + y) * n[0] + x); }
  void put(int x, int y, int z, std::array<float, 4> c, std::array<float, 3> d) {
    std::copy(c.begin(), c.end(), &colour[at(x, y, z) * 4]);
    std::copy(d.begin(), d.end(), &normal[at(x, y, z) * 4]);
  }
  double coverage(int x, int y, int z) const { return colour[at(x, y, z) * 4 + 3]; }

  void list_bricks() {
    bricks.clear();
    const int b[3] = {(n[0] + 7) / 8, (n[1] + 7) / 8, (n[2] + 7) / 8};
    for (int i = 0; i < b[0] * b[1] * b[2]; ++i) {
      const int low[3] = {i % b[0] * 8, i / b[0] % b[1] * 8, i / b[0] / b[1] * 8};
      bool touched = false;
      for (int z = low[2]; z < std::min(low[2] + 8, n[2]); ++z)
        for (int y = low[1]; y < std::min(low[1] + 8, n[1]); ++y)
          for (int x = low[0]; x < std::min(low[0] + 8, n[0]); ++x) touched |= coverage(x, y, z) > 0;
      if (touched) bricks.push_back(static_cast<std::uint32_t>(i));
    }
    counters[2] = static_cast<std::uint32_t>(bricks.size());
  }

  VoxelInjectParams params() const {
    VoxelInjectParams p;
    p.width = n[0];
    p.height = n[1];
    p.depth = n[2];
    p.bricks = static_cast<int>(std::max<std::size_t>(bricks.size(), 1));
    return p;
  }
};

std::vector<Bytes> inject(const std::string& device, const Grid& g, const VoxelInjectParams& p,
                          const std::vector<float>& light, const Bytes& before = {}) {
  Context& context = test_context(device);
  const Result<Plan> made = plan(p, context.profile());
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made.ok()) return {};
  const bool wide = context.real64();
  std::vector<std::uint32_t> bricks = g.bricks;
  bricks.resize(static_cast<std::size_t>(p.bricks));
  NamedBytes inputs{{"colour", encode(p.format, g.colour, wide)},
                    {"bricks", bytes_of(bricks)},
                    {"voxel_counters", bytes_of(g.counters)}};
  if (p.lights > 0 || p.map_width == 0) {
    std::vector<float> normal = g.normal;
    if (p.format == Format::unorm8x4)
      for (float& v : normal) v = v / 2 + 0.5f;
    inputs.push_back({"normal", encode(p.format, normal, wide)});
  }
  const std::size_t lights = static_cast<std::size_t>(p.lights) * 12;
  if (lights > 0)
    inputs.push_back(
        {"lights", encode(Format::f32x4, {light.begin(), light.begin() + static_cast<std::ptrdiff_t>(lights)}, wide)});
  if (p.shadow.width > 0) inputs.push_back({"shadow", encode(Format::f32x1, g.shadow, wide)});
  if (p.map_width > 0)
    inputs.push_back(
        {"map", encode(Format::f32x4, {light.begin() + static_cast<std::ptrdiff_t>(lights), light.end()}, wide)});
  if (p.emission) inputs.push_back({"emission", encode(p.format, g.emission, wide)});
  if (!before.empty()) inputs.push_back({"radiance", before});
  std::vector<std::string> outputs{"radiance"};
  if (p.count) outputs.push_back("outcomes");
  return run_bytes(context, made.value(), inputs, outputs);
}

std::vector<double> radiance(const std::string& device, const Grid& g, const VoxelInjectParams& p,
                             const std::vector<float>& light) {
  const std::vector<Bytes> out = inject(device, g, p, light);
  return out.empty() ? std::vector<double>() : decode(p.format, out[0], test_context(device).real64());
}

std::vector<std::string> all_devices() {
  std::vector<std::string> all = test_devices();
  all.push_back("cpu:double");
  return all;
}

std::vector<std::uint32_t> words(const Bytes& bytes) {
  std::vector<std::uint32_t> w(bytes.size() / 4);
  std::memcpy(w.data(), bytes.data(), bytes.size());
  return w;
}

// A floor of voxels at height y, normal up, base colour 1/2.
void floor_at(Grid& g, int y) {
  for (int z = 0; z < g.n[2]; ++z)
    for (int x = 0; x < g.n[0]; ++x) g.put(x, y, z, {0.5f, 0.25f, 1.0f, 1.0f}, {0, 1, 0});
}

// --- Closed forms

// Float keeps 24 bits through about a dozen operations.
constexpr double float_bound = 16 * 0x1p-24;

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
TEST(VoxelInject, AShadowMapGivesTheShareOfAVoxelThatIsLit) {
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

TEST(VoxelInject, WhereAMapTellsNothingRaysDo) {
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

TEST(VoxelInject, RefusesShadowMapsThatItCannotRead) {
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

Grid random_grid() {
  Grid g(13, 10, 17);
  std::uint32_t i = 0;
  for (int z = 0; z < g.n[2]; ++z)
    for (int y = 0; y < g.n[1]; ++y)
      for (int x = 0; x < g.n[0]; ++x) {
        const float r[8] = {uniform(i),     uniform(i + 1), uniform(i + 2), uniform(i + 3),
                            uniform(i + 4), uniform(i + 5), uniform(i + 6), uniform(i + 7)};
        i += 8;
        if (r[0] < 0.8f) continue;
        g.put(x, y, z, {r[1], r[2], r[3], r[0] < 0.84f ? 1.0f : 0.05f + 0.9f * r[4]},
              {0.57f * (2 * r[5] - 1), 0.57f * (2 * r[6] - 1), 0.57f * (2 * r[7] - 1)});
        for (int c = 0; c < 3; ++c) g.emission[g.at(x, y, z) * 4 + c] = r[c + 4];
      }
  g.list_bricks();
  return g;
}

const std::vector<VoxelLight> several{{VoxelLight::Kind::sun, {0.3, 0.8, 0.2}, {1, 0.5, 0.25}, {}, 0},
                                      {VoxelLight::Kind::point, {6.3, 20.1, 8.2}, {100, 200, 300}, {}, 0},
                                      {VoxelLight::Kind::patch, {-5.2, 4.7, 3.1}, {50, 20, 10}, {2, 0.5, 0.1}, 0}};

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

// --- Reflective shadow maps

struct Texels {
  std::vector<float> words;
  void add(float x, float y, float z, float valid, float r, float g, float b) {
    words.insert(words.end(), {x, y, z, valid, r, g, b, 0});
  }
};

TEST(VoxelInject, AMapsTexelsAreAveragedInAnyOrder) {
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

TEST(VoxelInject, BadTexelsAreDroppedAndCounted) {
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

TEST(VoxelInject, LightsAndAMapAddUp) {
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

// A tilted plane under a sun at the zenith, and maps of N texels a voxel. A voxel is missed where the part of the plane in it,
// seen from above, lies between texels.
TEST(VoxelInject, CracksOfAMapCloseWithItsResolution) {
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

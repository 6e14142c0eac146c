// probe_build: maps from hits, latitude-longitude images and cubes, in every format; the minimum map.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::HeldPlan;
using cases::Values;
using Vec = truth::Vec3;

double random(std::size_t i, std::uint32_t seed) { return scene::random01(static_cast<std::uint32_t>(i), seed); }

// Smooth on the sphere, and different along all axes.
double shade(const Vec& d, int channel) {
  return 1.5 + (channel == 0 ? d[0] : channel == 1 ? d[1] : d[2]) + 0.3 * d[0] * d[1] - 0.2 * d[1] * d[2];
}

Vec equirect_direction(double column, double row, int w, int h) {
  const double t = row / h * M_PI, p = (column / w - 0.5) * 2 * M_PI;
  return {std::sin(t) * std::cos(p), std::cos(t), std::sin(t) * std::sin(p)};
}

// OpenGL 4.6, table 8.19 (Vulkan 1.3, 16.5.1): face, s and t from 0 to 1.
Vec cube_direction(int face, double s, double t) {
  const double u = 2 * s - 1, v = 2 * t - 1;
  const Vec d[6] = {{1, -v, -u}, {-1, -v, u}, {u, 1, v}, {u, -1, -v}, {u, -v, 1}, {-u, -v, -1}};
  const double l = std::sqrt(1 + u * u + v * v);
  return {d[face][0] / l, d[face][1] / l, d[face][2] / l};
}

struct Images {
  Values radiance, distance, normal;
};

Images images(ProbeSource source, int w, int h, bool planar) {
  Images v;
  for (int face = 0; face < (source == ProbeSource::cube ? 6 : 1); ++face)
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const Vec d = source == ProbeSource::cube ? cube_direction(face, (x + 0.5) / w, (y + 0.5) / h)
                                                  : equirect_direction(x + 0.5, y + 0.5, w, h);
        for (int k = 0; k < 3; ++k) v.radiance.push_back(shade(d, k));
        v.radiance.push_back(1);
        const double major = std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
        v.distance.push_back(2 * shade(d, 0) * (planar ? major : 1));
        for (const double c : d) v.normal.push_back(-c);
        v.normal.push_back(0);
      }
  return v;
}

// Every source, resampled, gives the function that it was made of, as far as its pixels resolve it.
TEST(ProbeBuild, ImagesAndCubesBecomeMaps) {
  for (const std::string device : {"cpu", "cpu:double"})
    for (const auto& [source, planar] : {std::pair{ProbeSource::equirect, false}, {ProbeSource::cube, false}, {ProbeSource::cube, true}}) {
      Context& context = test_context(device);
      ProbeBuildParams p;
      p.maps.size = 32;
      p.maps.radiance = ProbeRadiance::f32x4;
      p.maps.distance = ProbeDistance::f32;
      p.maps.normal = ProbeNormal::snorm16;
      p.source = source;
      p.width = source == ProbeSource::cube ? 128 : 512;
      p.height = source == ProbeSource::cube ? 128 : 256;
      p.samples = 4;
      p.planar = planar;
      auto run = HeldPlan::make(context, plan(p, context.profile()));
      ASSERT_TRUE(run.ok()) << run.status().message();
      const Images in = images(source, p.width, p.height, planar);
      ASSERT_TRUE(run.value().write("radiance_source", in.radiance).ok() && run.value().write("distance_source", in.distance).ok() &&
                  run.value().write("normal_source", in.normal).ok() && run.value().go().ok());
      const Values radiance = run.value().read("radiance").value(), distance = run.value().read("distances").value(),
                   normals = run.value().read("normals").value();
      double off = 0, far = 0, turned = 0;
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
          const std::size_t i = static_cast<std::size_t>(32 * y + x);
          const Vec d = truth::octahedral_direction((2.0 * x + 1) / 32 - 1, (2.0 * y + 1) / 32 - 1);
          for (int k = 0; k < 3; ++k) {
            double mean = 0;  // over the texel, as radiance is defined
            for (int s = 0; s < 16; ++s)
              mean += shade(truth::octahedral_direction((2.0 * (4 * x + s % 4) + 1) / 128 - 1, (2.0 * (4 * y + s / 4) + 1) / 128 - 1), k) / 16;
            off = std::max(off, std::fabs(radiance[4 * i + static_cast<std::size_t>(k)] - mean));
          }
          far = std::max(far, std::fabs(distance[i] - 2 * shade(d, 0)));
          const Vec n = truth::direction_of_code(static_cast<std::uint32_t>(normals[i]), 16);
          turned = std::max(turned, std::acos(std::min(1.0, -(n[0] * d[0] + n[1] * d[1] + n[2] * d[2]))));
        }
      // Bilinear between pixels of 1/80 radian: 1e-4, but at the edges of cubes' faces, where half a pixel is repeated; the nearest pixel: its half diagonal, .009 for images and .011 at most
      // for cubes, times the slope of 2.6 for distance.
      EXPECT_LE(off, source == ProbeSource::cube ? 1e-3 : 2e-4) << device;
      EXPECT_LE(far, 0.03);
      EXPECT_LE(turned, 0.0125);
      EXPECT_GE(turned, 1e-4);
    }
}

TEST(ProbeBuild, DevicesAgreeToTheBit) {
  for (const ProbeSource source : {ProbeSource::texels, ProbeSource::equirect, ProbeSource::cube})
    for (const bool compact : {false, true}) {
      ProbeBuildParams p;
      p.maps.size = 32;
      p.probes = 3;
      p.maps.radiance = source == ProbeSource::cube ? ProbeRadiance::f16x4 : compact ? ProbeRadiance::r11g11b10 : ProbeRadiance::f32x4;
      p.maps.distance = compact ? ProbeDistance::f16 : ProbeDistance::f32;
      p.maps.normal = compact ? ProbeNormal::snorm8 : ProbeNormal::snorm16;
      p.source = source;
      p.unit = 1.75;
      if (source != ProbeSource::texels) p.width = source == ProbeSource::cube ? 20 : 40, p.height = 20, p.samples = 2;
      std::vector<Values> all;
      for (const std::string& device : test_devices()) {
        Context& context = test_context(device);
        auto run = HeldPlan::make(context, plan(p, context.profile()));
        ASSERT_TRUE(run.ok()) << run.status().message();
        Values joined;
        for (const char* name : {"radiance_source", "distance_source", "normal_source"}) {
          std::size_t n = 0;
          for (const Resource& r : run.value().plan().resources)
            if (r.name == name) n = r.bytes / 4;
          Values v(n);
          for (std::size_t i = 0; i < n; ++i)
            v[i] = name[0] == 'n' ? random(i, 4) - 0.5 : static_cast<float>(std::exp2(12 * random(i, 5) - 6));
          ASSERT_TRUE(run.value().write(name, v).ok());
        }
        ASSERT_TRUE(run.value().go().ok());
        for (const char* name : {"radiance", "distances", "normals", "minimum"}) {
          const Values v = run.value().read(name).value();
          joined.insert(joined.end(), v.begin(), v.end());
        }
        all.push_back(joined);
        EXPECT_EQ(cases::count_different(all[0], all.back()), 0) << device;
        for (const std::string& message : context.validation_messages()) ADD_FAILURE() << message;
      }
    }
}

// The minimum map is the least of what is stored, for ratios that leave an odd number of cells; what is no number is 0.
TEST(ProbeBuild, MinimumIsTheLeastStored) {
  for (const std::string& device : test_devices())
    for (const ProbeDistance format : {ProbeDistance::f32, ProbeDistance::f16})
      for (const int ratio : {2, 16}) {
        Context& context = test_context(device);
        ProbeMaps m;
        m.size = 48;
        m.ratio = ratio;
        m.distance = format;
        m.normal = ProbeNormal::none;
        ProbeGrid g;
        g.count = {3, 1, 1};
        cases::TexelValues v;
        for (std::size_t i = 0; i < 3 * 48 * 48; ++i) v.distance.push_back(static_cast<float>(std::exp2(14 * random(i, 8) - 7)));
        v.distance[100] = std::numeric_limits<double>::quiet_NaN();
        v.distance[5000] = -3;
        v.distance[6000] = std::numeric_limits<double>::infinity();
        auto scene = cases::ProbeScene::make(context, m, g, v);
        ASSERT_TRUE(scene.ok()) << scene.status().message();
        const int across = 48 / ratio;
        const Values words = scene.value().maps().read("minimum").value();
        for (int probe = 0; probe < 3; ++probe) {
          const auto map = scene.value().decoded(probe, false).value();
          for (int c = 0; c < across * across; ++c) {
            double least = 1e30;
            for (int k = 0; k < ratio * ratio; ++k)
              least = std::min(least, map.distance[static_cast<std::size_t>((c / across * ratio + k / ratio) * 48 + c % across * ratio + k % ratio)]);
            const std::size_t i = static_cast<std::size_t>(probe * across * across + c);
            double stored = words[format == ProbeDistance::f32 ? i : i / 2];
            if (format == ProbeDistance::f16) {
              const std::uint32_t bits = static_cast<std::uint32_t>(stored) >> (16 * (i & 1)) & 0xffffu, e = bits >> 10, f = bits & 1023;
              stored = (e == 0 ? f * 0x1p-24 : std::ldexp(1024.0 + f, static_cast<int>(e) - 25));
              stored = stored >= 65504 ? 1e30 : stored * probe_unit(g);
            }
            ASSERT_EQ(stored, least) << device << " probe " << probe << " cell " << c;
          }
        }
      }
}

// f16 in units of the cage's diagonal: 2^-11 relative from 1e-3 to 1e5 of them is out of reach below 6e-5 units and from
// 65504 on; scene units 1e-3 to 1e5 in a cage of any size stay.
TEST(ProbeBuild, DistancesInF16) {
  Context& context = test_context("cpu");
  for (const double cage : {1e-2, 1.0, 1e3}) {
    ProbeGrid g;
    g.spacing = {cage, cage, cage};
    ProbeMaps m;
    m.size = 16;
    cases::TexelValues v;
    for (int i = 0; i < 256; ++i) v.distance.push_back(static_cast<float>(cage * std::exp2(-10 + 25.0 * i / 255)));
    v.normal.assign(4 * 256, 1);
    v.distance[255] = 1e30;
    auto scene = cases::ProbeScene::make(context, m, g, v);
    ASSERT_TRUE(scene.ok());
    const auto map = scene.value().decoded(0, false).value();
    for (std::size_t i = 0; i < 255; ++i) EXPECT_LE(std::fabs(map.distance[i] / v.distance[i] - 1), 0x1.01p-11) << cage << " " << i;
    EXPECT_GE(map.distance[255], 1e30);
  }
}

TEST(ProbeBuild, RefusesWhatCannotBe) {
  const auto message = [](auto change) {
    ProbeBuildParams p;
    change(p);
    return validate(p).message();
  };
  EXPECT_EQ(message([](auto&) {}), "");
  EXPECT_EQ(message([](auto& p) { p.maps.size = 15; }), "ProbeMaps.size is 15; expected 16..2048");
  EXPECT_EQ(message([](auto& p) { p.maps.size = 17; }), "ProbeMaps.size is 17; expected an even number");
  EXPECT_EQ(message([](auto& p) { p.maps.ratio = 3; }), "ProbeMaps.ratio is 3; expected a power of two that divides the size");
  EXPECT_EQ(message([](auto& p) { p.maps.ratio = 512; }), "ProbeMaps.ratio is 512; expected 1..256");
  EXPECT_EQ(message([](auto& p) { p.maps.size = 24; }), "ProbeMaps.ratio is 16; expected a power of two that divides the size");
  EXPECT_EQ(message([](auto& p) { p.probes = 0; }), "ProbeBuildParams.probes is 0; expected 1..65536");
  EXPECT_EQ(message([](auto& p) { p.probes = 65536; }), "ProbeMaps.size is 256; expected size x size x probes of at most 2147483647");
  EXPECT_EQ(message([](auto& p) { p.width = 4; }), "ProbeBuildParams.width is 4; expected 0..0");
  EXPECT_EQ(message([](auto& p) { p.source = ProbeSource::cube; p.width = 4; p.height = 5; }),
            "ProbeBuildParams.height is 5; expected the width: faces of cubes are square");
  EXPECT_EQ(message([](auto& p) { p.samples = 2; }), "ProbeBuildParams.samples is 2; expected 1..1");
  EXPECT_EQ(message([](auto& p) { p.planar = true; }), "ProbeBuildParams.planar is true; expected false but for cubes");
  EXPECT_EQ(message([](auto& p) { p.unit = 0; }), "ProbeBuildParams.unit is 0; expected 1e-15..1e+15");
  EXPECT_EQ(message([](auto& p) { p.radiance = p.distance = false; p.maps.normal = ProbeNormal::none; }),
            "ProbeBuildParams.radiance is false; expected true where neither distance nor normals are made");
}

}  // namespace
}  // namespace luxel

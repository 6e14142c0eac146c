// Probes cast in scenes, rays through them against rays through the scene, and maps of another program's images.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/io/image.h"
#include "bench/truth/probe_scene.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

struct Seen {
  truth::ProbeAgreement agreement;
  int dead = 0;
};

Result<Seen> see(const std::string& name, std::array<int, 3> count, int size, bool normals, double jitter = 0) {
  auto scene = scene::scene_from(name);
  if (!scene) return scene.status();
  auto rays = scene::Rays::make(scene.value());
  if (!rays) return rays.status();
  auto probes = scene::place_probes(scene.value(), count, jitter);
  scene::find_dead_probes(probes, rays.value());
  const auto hits = scene::cast_probes(probes, rays.value(), size);
  ProbeMaps maps;
  maps.size = size;
  cases::TexelValues values{hits.distance, hits.normal, {}};
  for (double& d : values.distance) d = std::min(d, 1e30);
  auto made = cases::ProbeScene::make(test_context("cpu"), maps, probes.grid, values, probes.positions());
  if (!made) return made.status();
  const auto asked = truth::surface_rays(rays.value(), 3000, 5);
  ProbeTraceParams p;
  p.bias = 1;
  if (!normals) {
    p.maps.normal = ProbeNormal::none;
    p.thickness = 2;
    p.bias = 2;
  }
  const auto traced = made.value().trace(p, asked.rays);
  if (!traced) return traced.status();
  Seen s;
  s.agreement = truth::agreement(asked, traced.value().hits, traced.value().texels, hits.distance, size);
  s.dead = static_cast<int>(std::count(probes.alive.begin(), probes.alive.end(), 0));
  return s;
}

// Bounds are a third above what was measured with 20000 rays (README): they fail where a hit is missed or a wall leaks.
TEST(ProbeScene, RaysMeetWhatEmbreeMeets) {
  for (const auto& [name, count, agree, known] : {std::tuple{"cornell", std::array{4, 4, 4}, 0.99, 0.985}, {"two_rooms", std::array{4, 2, 4}, 0.99, 0.985}}) {
    const auto s = see(name, count, 128, true);
    ASSERT_TRUE(s.ok()) << s.status().message();
    EXPECT_GE(s.value().agreement.agree, agree) << name;
    EXPECT_GE(s.value().agreement.known_right, known) << name;
    EXPECT_LE(s.value().agreement.median, 0.03) << name;
    EXPECT_LE(s.value().agreement.unknown, 0.025) << name;
    EXPECT_EQ(s.value().agreement.capped, 0) << name;
  }
}

TEST(ProbeScene, MoreTexelsAndMoreProbesKnowMore) {
  const auto coarse = see("cornell", {2, 2, 2}, 32, true), fine = see("cornell", {2, 2, 2}, 128, true), many = see("cornell", {4, 4, 4}, 128, true);
  ASSERT_TRUE(coarse.ok() && fine.ok() && many.ok());
  EXPECT_LT(coarse.value().agreement.known_right, fine.value().agreement.known_right);
  EXPECT_LT(fine.value().agreement.right, many.value().agreement.right);
  EXPECT_GT(fine.value().agreement.unknown, many.value().agreement.unknown);
  // Two of the eight stand inside the blocks.
  EXPECT_EQ(fine.value().dead, 2);
}

TEST(ProbeScene, WithoutNormalsAndWithJitter) {
  const auto bare = see("cornell", {4, 4, 4}, 128, false), jittered = see("cornell", {4, 4, 4}, 128, true, 0.5);
  ASSERT_TRUE(bare.ok() && jittered.ok());
  EXPECT_GE(bare.value().agreement.agree, 0.98);
  EXPECT_LE(bare.value().agreement.median, 0.5);
  EXPECT_GE(jittered.value().agreement.agree, 0.99);
}

// Four probes rendered by another program: the mean radiance over the sphere is that of its own projection, L00 / sqrt(4 pi),
// and distances are those of the positions that it wrote beside them. Probe 1 stands inside a block: black, and near.
TEST(ProbeScene, ImagesOfAnotherProgram) {
  const char* named = std::getenv("LUXEL_DATA");
  const std::string folder = std::string(named ? named : "../shared/data") + "/probes_cycles_cbox";
  if (!std::filesystem::exists(folder + "/probe0_color.exr")) GTEST_SKIP() << folder << " is missing; set LUXEL_DATA to the test data";
  const double expected[4][3] = {{0.812838, 0.421327, 0.113827}, {0, 0, 0}, {-1, 0, 0}, {-1, 0, 0}};
  const double places[4][3] = {{278, 273, 100}, {150, 100, 150}, {420, 450, 400}, {100, 420, 300}};
  ProbeBuildParams p;
  p.maps.size = 64;
  p.maps.radiance = ProbeRadiance::f32x4;
  p.maps.distance = ProbeDistance::f32;
  p.maps.normal = ProbeNormal::none;
  p.probes = 4;
  p.source = ProbeSource::equirect;
  p.samples = 4;
  cases::Values radiance, distance, position;
  for (int probe = 0; probe < 4; ++probe)
    for (const char* kind : {"color", "depth", "position"}) {
      const auto image = io::read_image(folder + "/probe" + std::to_string(probe) + "_" + kind + ".exr");
      ASSERT_TRUE(image.ok()) << image.status().message();
      p.width = image.value().width, p.height = image.value().height;
      const int c = image.value().channels;
      for (std::size_t i = 0; i < static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height); ++i) {
        const float* v = &image.value().pixels[i * static_cast<std::size_t>(c)];
        if (kind[0] == 'd') distance.push_back(v[0]);
        for (int k = 0; k < 4 && kind[0] != 'd'; ++k) (kind[0] == 'c' ? radiance : position).push_back(k < 3 ? v[k] : 0);
      }
    }
  Context& context = test_context("cpu");
  auto run = cases::HeldPlan::make(context, plan(p, context.profile()));
  ASSERT_TRUE(run.ok()) << run.status().message();
  ASSERT_TRUE(run.value().write("radiance_source", radiance).ok() && run.value().write("distance_source", distance).ok() && run.value().go().ok());
  const auto maps = run.value().read("radiance").value(), far = run.value().read("distances").value();
  for (int probe = 0; probe < 4; ++probe) {
    double sum[3] = {}, all = 0, off = 0, most = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const auto d = truth::octahedral_direction((2.0 * x + 1) / 64 - 1, (2.0 * y + 1) / 64 - 1);
        const double solid = std::pow(std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]), 3);
        const std::size_t i = static_cast<std::size_t>((probe * 64 + y) * 64 + x);
        for (std::size_t k = 0; k < 3; ++k) sum[k] += solid * maps[4 * i + k];
        all += solid;
        // The pixel that the direction falls into.
        const double t = std::acos(d[1]) / M_PI, a = std::atan2(d[2], d[0]) / (2 * M_PI) + 0.5;
        const std::size_t pixel = static_cast<std::size_t>(probe) * static_cast<std::size_t>(p.width * p.height) +
                                  static_cast<std::size_t>(std::min(p.height - 1, static_cast<int>(t * p.height))) * static_cast<std::size_t>(p.width) +
                                  static_cast<std::size_t>(std::min(p.width - 1, static_cast<int>(a * p.width)));
        double squared = 0;
        for (std::size_t k = 0; k < 3; ++k) squared += std::pow(position[4 * pixel + k] - places[probe][k], 2);
        if (distance[pixel] < 1e9) off += std::fabs(far[i] - std::sqrt(squared)) > 1e-3 * far[i], ++most;
      }
    for (int k = 0; k < 3 && expected[probe][0] >= 0; ++k) {
      EXPECT_NEAR(sum[k] / all, expected[probe][k] / std::sqrt(4 * M_PI), 0.01 * expected[probe][k] + 1e-6) << probe;
    }
    EXPECT_GT(most, 1000);
    EXPECT_LE(off, 0.005 * most) << "probe " << probe;
  }
}

}  // namespace
}  // namespace luxel

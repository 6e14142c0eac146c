// Path-traced truth against closed forms, against itself, and against another renderer.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/io/image.h"
#include "bench/scene/mesh_builder.h"
#include "bench/truth/path_truth.h"

namespace luxel::truth {
namespace {

using glm::dvec3;
using scene::Material;
using scene::Scene;

constexpr double pi = std::numbers::pi;
// Estimates are compared with closed forms at five standard errors: one wrong alarm in a million, and seeds are fixed.
constexpr double sigmas = 5;

PathTruth must(const Scene& s, const std::vector<Receiver>& receivers, PathSettings settings) {
  settings.cached = false;
  const auto rays = scene::Rays::make(s);
  EXPECT_TRUE(rays) << rays.status().message();
  auto truth = path_truth(rays.value(), receivers, settings);
  EXPECT_TRUE(truth) << truth.status().message();
  return std::move(truth).value();
}

void expect_estimate(const Estimate& e, std::size_t receiver, double wanted, double rounding = 1e-9) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(e.channels); ++c) {
    const std::size_t i = receiver * static_cast<std::size_t>(e.channels) + c;
    EXPECT_LE(std::abs(e.mean(i) - wanted), sigmas * e.error[i] + rounding)
        << "receiver " << receiver << " channel " << c;
  }
}

Receiver up_at(dvec3 position) { return {position, {0, 1, 0}, glm::normalize(dvec3(1, 1, 0)), 0.5, true}; }

TEST(PathTruth, FurnaceRadianceIsEmissionOverOneMinusAlbedo) {
  const Scene s = scene::built_in("furnace").value();  // e = 1, albedo 1/2
  std::vector<Receiver> list;
  for (int i = 0; i < 8; ++i) list.push_back(up_at({-0.9 + 0.2 * i, 0, 0.7}));
  list.push_back(up_at({0.999, 0, 0.999}));  // a corner
  PathSettings settings;
  settings.samples = 200;
  const PathTruth t = must(s, list, settings);
  for (std::size_t i = 0; i < list.size(); ++i) {
    expect_estimate(t.emitted, i, pi);
    expect_estimate(t.indirect, i, pi * 0.5);        // L1 = albedo / pi * pi e
    expect_estimate(t.indirect_all, i, pi * 1.0);    // so radiance is e + 1/2 (1 + 1) = 2 = e / (1 - albedo)
    expect_estimate(t.glossy_emitted, i, 1);
    expect_estimate(t.glossy, i, 0.5);
    expect_estimate(t.glossy_all, i, 1);
    expect_estimate(t.visibility, i, 0);             // closed, no falloff
    expect_estimate(t.sky, i, 0);
    EXPECT_LT(t.indirect_all.error[3 * i], 0.2) << "an estimate that says nothing";
    EXPECT_GT(t.indirect_all.error[3 * i], 0.0);
  }
  settings.bounces = 2;
  expect_estimate(must(s, list, settings).indirect_all, 0, pi * (0.5 + 0.25));
}

// A floor point before an infinite wall of height h at distance d sees 1/2 (1 - d / sqrt(d^2 + h^2)) of it; the wall here
// is long (its ends miss less than 1e-4).
TEST(PathTruth, OcclusionByAWallIsItsFormFactor) {
  scene::MeshBuilder b;
  const auto m = b.material({});
  b.quad({0, 0, -200}, {0, 0, 400}, {0, 1, 0}, m);
  PathSettings settings;
  settings.samples = 20000;
  const PathTruth t = must(b.scene, {up_at({0.5, 0, 0}), up_at({2, 0, 0})}, settings);
  expect_estimate(t.visibility, 0, 0.5 + 0.5 * 0.5 / std::hypot(0.5, 1), 1e-4);
  expect_estimate(t.visibility, 1, 0.5 + 0.5 * 2 / std::hypot(2, 1), 1e-4);
}

// Under a ceiling at height H: int 2 u / (1 + gamma H / u) du over u = cos = 0..1 is 1 - 2 g + 2 g^2 ln(1 + 1/g), g = gamma H.
TEST(PathTruth, OcclusionFallsOffWithDistance) {
  scene::MeshBuilder b;
  const auto m = b.material({});
  b.quad({-200, 2, -200}, {400, 0, 0}, {0, 0, 400}, m);
  constexpr double size_bound = 5e-4;  // its edge at cos 0.01 leaves out 1e-4; rays start 200 * 2^-18 above the point
  PathSettings settings;
  settings.samples = 20000;
  for (const double gamma : {0.0, 0.3, 2.0}) {
    settings.ao_falloff = gamma;
    const double g = 2 * gamma, occlusion = g == 0 ? 1 : 1 - 2 * g + 2 * g * g * std::log(1 + 1 / g);
    expect_estimate(must(b.scene, {up_at({0, 0, 0})}, settings).visibility, 0, 1 - occlusion, size_bound);
  }
  settings.ao_falloff = 0;
  settings.ao_distance = 4;  // reaches directions with cos >= 1/2: 1 - 1/4 of the weight
  expect_estimate(must(b.scene, {up_at({0, 0, 0})}, settings).visibility, 0, 0.25, size_bound);
}

// Light from a square of half side a at height h over the point: E = L pi F, F = 4/pi x/sqrt(1+x^2) atan(x/sqrt(1+x^2)),
// x = a / h (four times the corner formula of Howell's catalogue B-3 for equal sides).
TEST(PathTruth, IrradianceOfASquareLampIsItsFormFactor) {
  PathSettings settings;
  settings.samples = 5000;
  for (const double a : {0.05, 0.5, 4.0}) {
    scene::MeshBuilder b;
    const auto m = b.material({.emission = {3, 2, 1}});
    b.quad({-a, 1, -a}, {2 * a, 0, 0}, {0, 0, 2 * a}, m);
    const PathTruth t = must(b.scene, {up_at({0, 0, 0})}, settings);
    const double y = a / std::hypot(1, a), form = 4 / pi * y * std::atan(y);
    for (std::size_t c = 0; c < 3; ++c) {
      const double wanted = pi * form * (3.0 - static_cast<double>(c));
      EXPECT_LE(std::abs(t.emitted.mean(c) - wanted), sigmas * t.emitted.error[c]) << a;
      EXPECT_LE(t.emitted.error[c], 0.01 * wanted) << a;
    }
    EXPECT_EQ(t.indirect.mean(0), 0);
  }
}

TEST(PathTruth, SunIsCosineAndShadow) {
  scene::MeshBuilder b;
  const auto m = b.material({});
  b.quad({-1, 0, -1}, {2, 0, 0}, {0, 0, 2}, m);
  b.quad({0.2, 0.5, -1}, {0.8, 0, 0}, {0, 0, 2}, m);
  b.scene.sun = {glm::normalize(dvec3(0, 2, 1)), {5, 4, 3}};
  const PathTruth t = must(b.scene, {up_at({-0.5, 0, 0}), up_at({0.6, 0, 0})}, {.samples = 2});
  expect_estimate(t.sun, 1, 0);
  EXPECT_NEAR(t.sun.mean(0), 5 * 2 / std::sqrt(5), 1e-12);
  EXPECT_NEAR(t.sun.mean(2), 3 * 2 / std::sqrt(5), 1e-12);
}

// Two endless parallel planes, the upper lit by the sun through nothing: floor of albedo r under the sun, seen from above.
TEST(PathTruth, OneBounceOffASunlitFloor) {
  scene::MeshBuilder b;
  const auto m = b.material({.base_color = {0.8, 0.4, 0.2}});
  b.quad({-3000, 0, -3000}, {6000, 0, 0}, {0, 0, 6000}, m);
  b.scene.sun = {{0, 1, 0}, {2, 2, 2}};
  Receiver down{{0, 1, 0}, {0, -1, 0}, {0, -1, 0}, 0.3, true};
  const PathTruth t = must(b.scene, {down}, {.samples = 200});
  for (std::size_t c = 0; c < 3; ++c) {
    const double albedo = c == 0 ? 0.8 : c == 1 ? 0.4 : 0.2;
    EXPECT_NEAR(t.indirect.mean(c), albedo * 2, 1e-4);  // L = albedo / pi 2 everywhere; all but the horizon is floor
    EXPECT_NEAR(t.glossy.mean(c), albedo * 2 / pi, 1e-4);
    EXPECT_NEAR(t.indirect_all.mean(c), t.indirect.mean(c), 1e-12);
  }
}

TEST(PathTruth, SkyImagesAndConstantSkiesAgree) {
  scene::MeshBuilder b;
  const auto m = b.material({.base_color = dvec3(0.5)});
  b.quad({0, 0, -50}, {0, 0, 100}, {0, 50, 0}, m);  // a wall over half of the sky
  b.scene.sky.radiance = dvec3(2);
  const std::vector<Receiver> list{up_at({0.5, 0, 0}), {{0.5, 0, 0}, {0, 0, 1}, {0, 1, 1}, 0.4, true}};
  const PathTruth plain = must(b.scene, list, {.samples = 4000});
  b.scene.sky.width = 8, b.scene.sky.height = 4;
  b.scene.sky.image.assign(3 * 32, 1.0f);
  const PathTruth image = must(b.scene, list, {.samples = 4000, .seed = 7});
  for (const auto part : {&PathTruth::sky, &PathTruth::indirect, &PathTruth::glossy_sky})
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_LE(std::abs((plain.*part).mean(i) - (image.*part).mean(i)),
                sigmas * std::hypot((plain.*part).error[i], (image.*part).error[i]) + 1e-9);
  // A single bright texel: irradiance is radiance times the integral of cos over it, on an open plane.
  b.scene.sky.image.assign(3 * 32, 0.0f);
  for (int c = 0; c < 3; ++c)
    b.scene.sky.image[3 * 8 + c] = 50.0f;  // row 1, column 0: t in 45..90 degrees, p in -180..-135
  const PathTruth texel = must(b.scene, {up_at({-5, 0, 0})}, {.samples = 4000});
  const double wanted = 100 * (pi / 4) * 0.5 * (1 - 0.5);  // int cos t sin t dt dp
  expect_estimate(texel.sky, 0, wanted);
  EXPECT_LT(texel.sky.error[0], 0.03 * wanted);
}

TEST(PathTruth, AlphaMasksLetLightThrough) {
  scene::MeshBuilder b;
  b.scene.textures.push_back({"half", 2, 1, true, {255, 255, 255, 255, 255, 255, 255, 0}});
  const auto m = b.material({.alpha_mode = scene::AlphaMode::mask, .texture = 0});
  b.quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2},
         m);  // opaque for x < 0, a hole for x > 0 (bilinear: between -0.5 and 0.5 it turns)
  b.scene.sun = {{0, 1, 0}, {1, 1, 1}};
  const PathTruth t = must(b.scene, {up_at({-0.4, 0, 0}), up_at({0.4, 0, 0})}, {.samples = 1});
  EXPECT_EQ(t.sun.mean(0), 0);
  EXPECT_EQ(t.sun.mean(3), 1);
}

TEST(PathTruth, TheDarkRoomIsDarkAndTheLitOneIsNot) {
  const Scene s = scene::built_in("two_rooms").value();
  const PathTruth t = must(s, {up_at({-2, 0, 1.5}), up_at({2, 0, 1.5}), up_at({0.05, 0, 0})}, {.samples = 500});
  EXPECT_GT(t.indirect_all.mean(0), 0.1);
  for (const std::size_t receiver : {1, 2})
    for (const auto& [name, e] : estimates(t))
      if (name != "visibility") {
        EXPECT_EQ(e->rgb(receiver), dvec3(0)) << name;
      }
}

TEST(PathTruth, HalvesAreIndependentAndTheErrorIsHonest) {
  const Scene s = scene::built_in("cornell").value();
  const auto rays = scene::Rays::make(s).value();
  const auto g = scene::gbuffer(rays, s.camera, 32, 32);
  const PathTruth t = must(s, receivers(g, s.camera.eye), {.samples = 64});
  const PathTruth other = must(s, receivers(g, s.camera.eye), {.samples = 64, .seed = 99});
  double halves = 0, predicted = 0, covariance = 0, variance = 0;
  std::size_t inside = 0, of = 0;
  for (std::size_t i = 0; i < t.indirect.t1.size(); ++i) {
    const double d = t.indirect.t1[i] - t.indirect.t2[i], e = t.indirect.error[i];
    halves += d * d, predicted += 4 * e * e;  // var(t1 - t2) = 2 var / n; error^2 = var / (2 n)
    const double a = t.indirect.t1[i] - other.indirect.mean(i), b = t.indirect.t2[i] - other.indirect.mean(i);
    covariance += a * b, variance += other.indirect.error[i] * other.indirect.error[i];
    if (e > 0)
      ++of, inside +=
            std::abs(t.indirect.mean(i) - other.indirect.mean(i)) <= 1.96 * std::hypot(e, other.indirect.error[i]);
  }
  EXPECT_LE(halves / predicted, 1.1);  // strata differ among each other, so errors are stated too large
  EXPECT_GE(halves / predicted, 0.4);
  EXPECT_NEAR(covariance / variance, 1, 0.3);  // what is left of (x - t1)(x - t2) is x's own variance
  EXPECT_GE(static_cast<double>(inside) / static_cast<double>(of), 0.94);
}

TEST(PathTruth, ResultsDoNotDependOnThreadsAndComeBackFromTheCache) {
  const Scene s = scene::built_in("cornell").value();
  const auto rays = scene::Rays::make(s).value();
  const auto g = scene::gbuffer(rays, s.camera, 8, 8);
  const auto list = receivers(g, s.camera.eye);
  PathSettings settings{.samples = 4, .threads = 1, .cached = false};
  const auto one = path_truth(rays, list, settings).value();
  settings.threads = 3;
  const auto three = path_truth(rays, list, settings).value();
  const auto folder = std::filesystem::temp_directory_path() / ("luxel_truth_" + std::to_string(::getpid()));
  const char* before = std::getenv("LUXEL_CACHE");
  const std::string kept = before != nullptr ? before : "";
  setenv("LUXEL_CACHE", folder.c_str(), 1);
  settings.cached = true;
  const auto fresh = path_truth(rays, list, settings).value();
  const auto cached = path_truth(rays, list, settings).value();
  settings.seed = 2;
  const auto other = path_truth(rays, list, settings).value();
  if (before != nullptr) setenv("LUXEL_CACHE", kept.c_str(), 1); else unsetenv("LUXEL_CACHE");
  std::filesystem::remove_all(folder);
  EXPECT_GT(fresh.seconds, 0);
  EXPECT_EQ(cached.seconds, 0);
  EXPECT_GT(other.seconds, 0);
  for (std::size_t q = 0; q < estimates(one).size(); ++q)
    for (const auto part : {&Estimate::t1, &Estimate::t2, &Estimate::error}) {
      EXPECT_EQ(estimates(one)[q].second->*part, estimates(three)[q].second->*part);
      EXPECT_EQ(estimates(one)[q].second->*part, estimates(cached)[q].second->*part);
    }
  EXPECT_NE(one.indirect.t1, other.indirect.t1);
}

TEST(PathTruth, SettingsOutOfRangeAreRefused) {
  const Scene s = scene::built_in("cornell").value();
  const auto rays = scene::Rays::make(s).value();
  for (const PathSettings& settings :
       {PathSettings{.samples = 0}, PathSettings{.bounces = -1}, PathSettings{.ao_falloff = -1.0},
        PathSettings{.ao_falloff = NAN}, PathSettings{.ao_distance = 0}})
    EXPECT_EQ(path_truth(rays, {}, settings).status().code(), Code::invalid_argument);
}

TEST(GBuffer, ACornellPixelIsWhereTheCameraSays) {
  const Scene s = scene::built_in("cornell").value();
  const auto rays = scene::Rays::make(s).value();
  const auto g = scene::gbuffer(rays, s.camera, 65, 33);
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y) * 65 + static_cast<std::size_t>(x); };
  const double t = std::tan(39.3 * pi / 360);
  // Low in the middle is the floor.
  const std::size_t low = at(32, 31);
  const double slope = t * (1 - 2 * 31.5 / 33);
  EXPECT_NEAR(g.depth[low], 1 / -slope, 1e-5);
  EXPECT_NEAR(g.position[3 * low + 1], 0, 1e-6);
  EXPECT_NEAR(g.position[3 * low + 2], 3.9 + 1 / slope, 1e-5);
  EXPECT_EQ(g.at(g.normal, low), dvec3(0, 1, 0));
  // A column at the left edge sees nothing beside the box.
  EXPECT_FALSE(g.surface_at(at(0, 16)));
  EXPECT_TRUE(std::isinf(g.depth[at(0, 16)]));
  // Left of the middle is the red wall, its normal to the right.
  bool red = false;
  for (int x = 0; x < 32 && !red; ++x)
    if (g.surface_at(at(x, 16))) {
      EXPECT_EQ(g.at(g.normal, at(x, 16)), dvec3(1, 0, 0));
      EXPECT_GT(g.albedo[3 * at(x, 16)], 0.6);
      red = true;
    }
  EXPECT_TRUE(red);
}

// The scene of cornell/mitsuba_cbox (its .xml files give the numbers below) against what Blender Cycles rendered of it.
class CyclesFull : public testing::Test {
 protected:
  static std::string folder() {
    const char* f = std::getenv("LUXEL_DATA");
    return f != nullptr ? f : "../shared/data";
  }
  // `covered`: a black plate over the back of the lamp, which hangs half a unit under the ceiling.
  static Scene box(bool covered) {
    Scene all;
    const auto add = [&](const char* part, dvec3 color, dvec3 emission, double shift) {
      const auto read = scene::read_mesh(folder() + "/cornell/mitsuba_cbox/cbox_" + part + ".obj");
      ASSERT_TRUE(read) << read.status().message();
      const auto base = static_cast<std::uint32_t>(all.positions.size());
      for (const dvec3 p : read.value().positions) all.positions.push_back(p + dvec3(0, shift, 0));
      for (const glm::uvec3 t : read.value().indices) {
        all.indices.push_back(t + glm::uvec3(base));
        all.triangle_materials.push_back(static_cast<std::uint32_t>(all.materials.size()));
      }
      all.materials.push_back({.name = part, .base_color = color, .emission = emission});
    };
    const dvec3 white(0.885809, 0.698859, 0.666422), block(0.45, 0.30, 0.90);
    add("luminaire", {0.936461, 0.740433, 0.705267}, {18.387, 10.9873, 2.75357}, -0.5);
    if (covered) add("luminaire", dvec3(0), dvec3(0), -0.25);
    add("floor", white, dvec3(0), 0);
    add("ceiling", white, dvec3(0), 0);
    add("back", white, dvec3(0), 0);
    add("greenwall", {0.105421, 0.37798, 0.076425}, dvec3(0), 0);
    add("redwall", {0.570068, 0.0430135, 0.0443706}, dvec3(0), 0);
    add("smallbox", block, dvec3(0), 0);
    add("largebox", block, dvec3(0), 0);
    all.camera = {{278, 273, -800}, {278, 273, -799}, 39.3077};
    return all;
  }
};

TEST_F(CyclesFull, DirectAndIndirectDiffuseLightAgree) {
  const std::string pictures = folder() + "/gbuffer_cycles_cbox/";
  if (!std::filesystem::exists(pictures)) GTEST_SKIP() << "no files in " << pictures;
  const auto position = io::read_image(pictures + "n1_position.exr"),
             direct = io::read_image(pictures + "ref512_diffdir.exr"),
             indirect = io::read_image(pictures + "ref512_diffind.exr");
  ASSERT_TRUE(position && direct && indirect);
  const Scene s = box(false), covered = box(true);
  const auto rays = scene::Rays::make(s).value();
  const auto g = scene::gbuffer(rays, s.camera, 256, 256);
  const auto all = receivers(g, s.camera.eye);
  // Pixels of one surface with their neighbours (Cycles filters pixels), one of each 4 x 4.
  std::vector<Receiver> list;
  std::vector<std::size_t> pixels;
  double offset = 0;
  for (int y = 6; y < 250; y += 4)
    for (int x = 6; x < 250; x += 4) {
      const std::size_t i = static_cast<std::size_t>(y) * 256 + static_cast<std::size_t>(x);
      bool smooth = g.surface_at(i) && g.emission[3 * i] == 0;
      for (int dy = -2; dy <= 2 && smooth; ++dy)
        for (int dx = -2; dx <= 2 && smooth; ++dx) {
          const std::size_t j = i + static_cast<std::size_t>(dy * 256 + dx);
          smooth = g.surface_at(j) && g.at(g.normal, j) == g.at(g.normal, i) &&
                   std::abs(g.depth[j] - g.depth[i]) < 30 && g.emission[3 * j] == 0;
        }
      if (!smooth) continue;
      const auto n = static_cast<std::size_t>(position.value().channels);
      for (std::size_t c = 0; c < 3; ++c)
        offset =
            std::max(offset, std::abs(static_cast<double>(position.value().pixels[n * i + c]) - g.position[3 * i + c]));
      list.push_back(all[i]);
      pixels.push_back(i);
    }
  EXPECT_GT(list.size(), 2000u);
  RecordProperty("largest_position_offset", std::to_string(offset));
  // Four diffuse bounces are Blender's default; and it clamps indirect light to 10, which cuts most of what the lamp's back
  // sends into the gap above it. So theirs lies between ours with and without that back.
  constexpr double direct_bound = 0.01;           // means of surfaces differ by up to 0.8 %, with either sign
  constexpr double covered_least = 0.96, open_most = 1.05;
  const PathTruth with = must(s, list, {.samples = 128, .bounces = 4});
  const PathTruth without = must(covered, list, {.samples = 128, .bounces = 4});
  const auto sum = [&](const io::Image& image, std::size_t c) {
    double total = 0;
    for (const std::size_t i : pixels) total += image.pixels[static_cast<std::size_t>(image.channels) * i + c];
    return total * pi;  // they hold irradiance over pi
  };
  for (std::size_t c = 0; c < 3; ++c) {
    double ours[3] = {}, apart = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const std::size_t i = 3 * k + c;
      ours[0] += with.emitted.mean(i), ours[1] += with.indirect_all.mean(i), ours[2] += without.indirect_all.mean(i);
      apart += std::abs(with.emitted.mean(i) / pi -
                        direct.value().pixels[static_cast<std::size_t>(direct.value().channels) * pixels[k] + c]);
    }
    const double lamp = sum(direct.value(), c), bounced = sum(indirect.value(), c);
    std::printf("channel %zu: direct %.4f of theirs, mean difference %.4f; indirect %.4f to %.4f\n", c, ours[0] / lamp,
                apart * pi / lamp, ours[2] / bounced, ours[1] / bounced);
    EXPECT_NEAR(ours[0] / lamp, 1, direct_bound);
    EXPECT_LE(apart * pi / lamp, 0.03);  // noise of both and their filter of 1.5 pixels
    EXPECT_GE(ours[2] / bounced, covered_least);
    EXPECT_LE(ours[2] / bounced, 1);
    EXPECT_GE(ours[1] / bounced, 1);
    EXPECT_LE(ours[1] / bounced, open_most);
  }
}

}  // namespace
}  // namespace luxel::truth

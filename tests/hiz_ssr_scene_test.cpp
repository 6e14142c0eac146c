// hiz_ssr in the generated atrium: against the exhaustive walk over its G-buffer, against rays through the scene, and against
// path tracing in two halves, split into what the screen knows and what it cannot know.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bench/scene/compose.h"
#include "bench/scene/screen.h"
#include "bench/truth/path_truth.h"
#include "bench/truth/ssr_scene.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;
using scene::GBuffer;

struct Atrium {
  scene::Scene scene;
  std::unique_ptr<scene::Rays> rays;
  GBuffer g;

  static const Atrium& get(int width, int height) {
    static std::map<int, std::unique_ptr<Atrium>> made;
    auto& a = made[width];
    if (!a) {
      a = std::make_unique<Atrium>();
      a->scene = scene::built_in("atrium").value();
      a->rays = std::make_unique<scene::Rays>(scene::Rays::make(a->scene).value());
      a->g = scene::gbuffer(*a->rays, a->scene.camera, width, height);
    }
    return *a;
  }
};

// 1/64 of the scene's diagonal, as `luxel render` has it.
double thickness_of(const scene::Scene& s) {
  const scene::Bounds box = bounds(s);
  return glm::length(box.high - box.low) / 64;
}

TEST(HizSsrScene, AgreesWithTheExhaustiveWalkInTheAtrium) {
  const Atrium& a = Atrium::get(192, 108);
  HizSsrParams p = screen_params(a.g, a.scene.camera);
  p.thickness = thickness_of(a.scene);
  Values depth(a.g.depth.begin(), a.g.depth.end()), normals;
  for (const float v : screen_normals(a.g, a.scene.camera)) normals.push_back(v);
  // One pixel of 17, as every pixel of the image is looked at for each.
  for (std::size_t i = 0; i < a.g.pixels(); ++i)
    if (i % 17 != 0) normals[4 * i + 3] = 2;
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda}) {
    p.variant = v;
    const auto r = follow(test_context("cpu"), p, depth, normals);
    ASSERT_TRUE(r) << r.status().message();
    const Agreement agreed = compare(p, depth, normals, r.value());
    EXPECT_EQ(agreed.wrong + agreed.broken, 0);
    EXPECT_GT(agreed.rays, 400);
    EXPECT_GT(agreed.hits, 150);
    EXPECT_GE(agreed.equal, 0.99 * agreed.rays);
    std::printf("atrium 192x108: %d rays, %d hits, %d the exhaustive walk's, %d ties\n", agreed.rays, agreed.hits, agreed.equal, agreed.ties);
  }
}

struct Shares {
  std::array<int, truth::seen_classes> count{}, hit{}, right{};
};

// Of each class: rays, those that hit something on the screen, and those that hit within 2 pixels of the truth.
Shares shares_of(const Atrium& a, const HizSsrParams& params, const std::vector<truth::Mirrored>& truth) {
  HizSsrParams p = params;
  p.count = true;
  const std::vector<float> normals = screen_normals(a.g, a.scene.camera);
  const auto r = scene::reflect(test_context("cpu"), p, {a.g.depth, normals, {}, {}, {}, {}});
  EXPECT_TRUE(r) << r.status().message();
  Shares s;
  for (std::size_t i = 0; i < a.g.pixels(); ++i) {
    const auto c = static_cast<std::size_t>(truth[i].seen);
    const bool hit = static_cast<int>(r.value().paths[4 * i + 1]) == static_cast<int>(SsrOutcome::hit);
    ++s.count[c];
    s.hit[c] += hit;
    s.right[c] += hit && std::hypot(r.value().hits[4 * i] * static_cast<float>(p.width) - truth[i].x,
                                    r.value().hits[4 * i + 1] * static_cast<float>(p.height) - truth[i].y) <= 2;
  }
  return s;
}

TEST(HizSsrScene, FindsWhatTheScreenKnows) {
  const Atrium& a = Atrium::get(480, 270);
  const auto truth = truth::mirrored(*a.rays, a.g, a.scene.camera);
  HizSsrParams p = screen_params(a.g, a.scene.camera);
  p.thickness = thickness_of(a.scene);
  p.max_distance = 60;
  constexpr const char* names[] = {"nothing", "on screen", "off screen", "hidden", "sky"};
  double found[3] = {};
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda, SsrVariant::linear}) {
    p.variant = v;
    p.steps = 64;
    const Shares s = shares_of(a, p, truth);
    for (std::size_t c = 1; c < truth::seen_classes; ++c)
      std::printf("variant %d %-10s %6d rays, %5.1f %% hit, %5.1f %% within 2 pixels of the truth\n", static_cast<int>(v), names[c], s.count[c],
                  100.0 * s.hit[c] / std::max(s.count[c], 1), 100.0 * s.right[c] / std::max(s.count[c], 1));
    EXPECT_EQ(s.hit[0], 0);
    EXPECT_GT(s.count[1], 1000);
    found[static_cast<int>(v)] = static_cast<double>(s.right[1]) / s.count[1];
  }
  // What a hit is missed by: surfaces whose pixel is elsewhere than the ray by more than their thickness, and mirrored edges.
  EXPECT_GE(found[0], 0.95);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_LT(found[2], found[0]);
}

// relMSE of radiance in the lobe against two independent halves, of each class of mirror rays.
struct Errors {
  std::array<double, truth::seen_classes> relmse{};
};
Errors errors_of(const GBuffer& g, const std::vector<float>& radiance, const truth::PathTruth& t, const std::vector<truth::Mirrored>& seen) {
  std::array<double, truth::seen_classes> sum{}, count{};
  double mean = 0, all = 0;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const auto c = static_cast<std::size_t>(seen[i].seen);
    if (c == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t j = 3 * i + k;
      const double t1 = t.glossy_all.t1[j] + t.glossy_sky.t1[j] + t.glossy_emitted.t1[j];
      const double t2 = t.glossy_all.t2[j] + t.glossy_sky.t2[j] + t.glossy_emitted.t2[j];
      const double x = radiance[4 * i + k];
      sum[c] += (x - t1) * (x - t2);
      ++count[c];
      mean += (t1 + t2) / 2, ++all;
    }
  }
  mean /= all;
  Errors e;
  for (std::size_t c = 0; c < sum.size(); ++c) e.relmse[c] = count[c] > 0 ? sum[c] / count[c] / (mean * mean) : 0;
  return e;
}

class HizSsrTruthFull : public testing::TestWithParam<bool> {};

TEST_P(HizSsrTruthFull, IsNearestToPathTracingWhereTheScreenKnows) {
  const bool mirror = GetParam();
  const Atrium& a = Atrium::get(192, 108);
  auto receivers = truth::receivers(a.g, a.scene.camera.eye);
  if (mirror)
    for (auto& r : receivers) r.roughness = 0;
  truth::PathSettings settings;
  settings.samples = mirror ? 16 : 64;
  const auto traced = truth::path_truth(*a.rays, receivers, settings);
  ASSERT_TRUE(traced) << traced.status().message();
  const truth::PathTruth& t = traced.value();
  std::vector<float> colour;
  for (std::size_t i = 0; i < a.g.pixels(); ++i) {
    const glm::dvec3 l = a.g.at(a.g.emission, i) + a.g.at(a.g.albedo, i) / std::numbers::pi *
                                                       (t.sun.rgb(i) + t.emitted.rgb(i) + t.sky.rgb(i) + t.indirect_all.rgb(i));
    for (const double v : {l.x, l.y, l.z, 1.0}) colour.push_back(static_cast<float>(v));
  }
  std::vector<float> normals = screen_normals(a.g, a.scene.camera);
  if (mirror)
    for (std::size_t i = 3; i < normals.size(); i += 4) normals[i] = normals[i] < 1.5f ? 0 : normals[i];
  const auto seen = truth::mirrored(*a.rays, a.g, a.scene.camera);
  HizSsrParams p = screen_params(a.g, a.scene.camera);
  p.shade = true;
  p.thickness = thickness_of(a.scene);
  p.fade_edge = 0;
  p.variant = mirror ? SsrVariant::hiz : SsrVariant::stochastic;
  if (!mirror) p.rays_per_pixel = 4;
  const auto r = scene::reflect(test_context("cpu"), p, {a.g.depth, normals, {}, colour, {}, {}});
  ASSERT_TRUE(r) << r.status().message();
  const Errors e = errors_of(a.g, r.value().radiance, t, seen);
  const Errors dark = errors_of(a.g, std::vector<float>(4 * a.g.pixels(), 0.0f), t, seen);
  std::array<int, truth::seen_classes> count{};
  for (const truth::Mirrored& m : seen) ++count[static_cast<std::size_t>(m.seen)];
  constexpr const char* names[] = {"nothing", "on screen", "off screen", "hidden", "sky"};
  for (std::size_t c = 1; c < truth::seen_classes; ++c)
    std::printf("%s, %-10s %6d pixels: relMSE %.4f (without reflections %.4f)\n", mirror ? "mirror" : "glossy", names[c], count[c], e.relmse[c],
                dark.relmse[c]);
  // Where the screen knows, nearly all of the light is found; elsewhere what is shown is the environment's 0, or a wrong surface.
  EXPECT_LE(e.relmse[1], 0.25 * dark.relmse[1]);
}

INSTANTIATE_TEST_SUITE_P(MirrorAndGlossy, HizSsrTruthFull, testing::Bool());

}  // namespace
}  // namespace luxel

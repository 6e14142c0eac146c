// hiz_ssr in the generated atrium and in Sponza: against the exhaustive walk over its G-buffer, against rays through the scene, and against
// path tracing in two halves, split into what the screen knows and what it cannot know.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "bench/scene/screen.h"
#include "bench/truth/ssr_radiance.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;
using scene::GBuffer;

std::string scene_file(const std::string& name) {
  const char* data = std::getenv("LUXEL_DATA");
  return name == "atrium" ? name : std::string(data ? data : "../shared/data") + "/crytek_sponza/sponza.glb";
}

struct Stage {
  scene::Scene scene;
  std::unique_ptr<scene::Rays> rays;
  GBuffer g;

  static const Stage& get(const std::string& name, int width, int height) {
    static std::map<std::pair<std::string, int>, std::unique_ptr<Stage>> made;
    auto& a = made[{name, width}];
    if (!a) {
      a = std::make_unique<Stage>();
      a->scene = scene::scene_from(scene_file(name)).value();
      if (name != "atrium") a->scene.camera = {{-60, 12, -3}, {60, 25, -2}, 65};
      a->rays = std::make_unique<scene::Rays>(scene::Rays::make(a->scene).value());
      a->g = scene::gbuffer(*a->rays, a->scene.camera, width, height);
    }
    return *a;
  }
};

class HizSsrScene : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const std::string file = scene_file(GetParam());
    if (file != GetParam() && !std::filesystem::exists(file)) GTEST_SKIP() << file << " is missing; set LUXEL_DATA to the test data";
  }
};
std::string text_of(const testing::TestParamInfo<std::string>& info) { return info.param; }
INSTANTIATE_TEST_SUITE_P(Scenes, HizSsrScene, testing::Values("atrium", "Sponza"), text_of);

// 1/64 of the scene's diagonal, as `luxel render` has it.
double thickness_of(const scene::Scene& s) {
  const scene::Bounds box = bounds(s);
  return glm::length(box.high - box.low) / 64;
}

TEST_P(HizSsrScene, AgreesWithTheExhaustiveWalk) {
  const Stage& a = Stage::get(GetParam(), 192, 108);
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
    std::printf("%s 192x108: %d rays, %d hits, %d the exhaustive walk's, %d ties\n", GetParam().c_str(), agreed.rays, agreed.hits, agreed.equal, agreed.ties);
  }
}

struct Shares {
  std::array<int, truth::seen_classes> count{}, hit{}, right{};
};

// Of each class: rays, those that hit something on the screen, and those that hit within 2 pixels of the truth.
Shares shares_of(const Stage& a, const HizSsrParams& params, const std::vector<truth::Mirrored>& truth) {
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

TEST_P(HizSsrScene, FindsWhatTheScreenKnows) {
  const Stage& a = Stage::get(GetParam(), 480, 270);
  const auto truth = truth::mirrored(*a.rays, a.g, a.scene.camera);
  HizSsrParams p = screen_params(a.g, a.scene.camera);
  p.thickness = thickness_of(a.scene);
  p.max_distance = 64 * p.thickness;  // the scene's diagonal
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
  // Measured: 0.970 and 0.915, where columns and cloth hide one another more than thickness allows for.
  EXPECT_GE(found[0], GetParam() == "atrium" ? 0.95 : 0.9);
  EXPECT_EQ(found[0], found[1]);
  EXPECT_LT(found[2], found[0]);
}

struct Lobes {
  std::string scene;
  bool mirror = false;
  int width = 128, height = 72;
  double known = 0.25;  // of the error without reflections, at most, where the screen knows; measured, rounded up
};
class HizSsrTruthFull : public testing::TestWithParam<Lobes> {};

TEST_P(HizSsrTruthFull, IsNearestToPathTracingWhereTheScreenKnows) {
  const auto& [name, mirror, width, height, known] = GetParam();
  const Stage& a = Stage::get(name, width, height);
  const auto made = truth::screen_truth(a.scene, *a.rays, width, height, mirror, mirror ? 16 : 32);
  ASSERT_TRUE(made) << made.status().message();
  const truth::ScreenTruth& t = made.value();
  HizSsrParams p = t.params;
  p.variant = mirror ? SsrVariant::hiz : SsrVariant::stochastic;
  if (!mirror) p.rays_per_pixel = 4;
  const auto r = scene::reflect(test_context("cpu"), p, {t.g.depth, t.normals, {}, t.colour, {}, {}});
  ASSERT_TRUE(r) << r.status().message();
  p.environment = {0, 0, 0};
  const auto none = scene::reflect(test_context("cpu"), p, {t.g.depth, t.normals, {}, t.colour, {}, {}});
  ASSERT_TRUE(none) << none.status().message();
  const truth::ScreenErrors e = screen_errors(t, r.value().radiance), zero = screen_errors(t, none.value().radiance),
                            dark = screen_errors(t, std::vector<float>(4 * t.g.pixels(), 0.0f));
  constexpr const char* names[] = {"nothing", "on screen", "off screen", "hidden", "sky"};
  const auto line = [&](const char* what, int pixels, double with_sky, double with_zero, double without) {
    std::printf("%s %s, %-10s %6d pixels: relMSE %.4f, misses 0 %.4f, without reflections %.4f\n", name.c_str(),
                mirror ? "mirror" : "glossy", what, pixels, with_sky, with_zero, without);
  };
  int all = 0;
  for (std::size_t c = 1; c < truth::seen_classes; ++c) {
    line(names[c], t.pixels[c], e.of[c], zero.of[c], dark.of[c]);
    all += t.pixels[c];
  }
  line("all", all, e.all, zero.all, dark.all);
  std::printf("standard error of all: %.4f\n", e.standard_error);
  double parts = 0;
  for (const double part : e.part) parts += part;
  EXPECT_NEAR(parts, e.all, 1e-9 * std::fabs(e.all));
  EXPECT_GT(t.pixels[1], 1000);
  // Where the screen knows, most of the light is found; elsewhere what is shown is the fallback, or a wrong surface.
  EXPECT_LE(zero.of[1], known * dark.of[1]);
  // Mirror rays into the sky find the sky where it is the fallback.
  if (mirror) { EXPECT_LE(e.of[4], 0.05 * dark.of[4]); }
  EXPECT_LE(zero.all, dark.all + 4 * zero.standard_error);
}

INSTANTIATE_TEST_SUITE_P(MirrorAndGlossy, HizSsrTruthFull,
                         testing::Values(Lobes{"atrium", true}, Lobes{"atrium", false}, Lobes{"Sponza", true, 192, 108, 0.4},
                                         Lobes{"Sponza", false, 96, 54, 0.65}),
                         [](const auto& info) { return info.param.scene + (info.param.mirror ? "Mirror" : "Glossy"); });

}  // namespace
}  // namespace luxel

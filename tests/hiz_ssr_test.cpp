// hiz_ssr: hits on paper, equal bits on every execution, what each walk misses, agreement with the exhaustive walk, refusals.
#include <luxel/hiz_ssr.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/cases/compare.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/cases/storage.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;

std::vector<std::string> with_double() {
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  return devices;
}

Values mirrors(std::size_t pixels, std::array<double, 3> n) {
  Values v;
  for (std::size_t i = 0; i < pixels; ++i) v.insert(v.end(), {n[0], n[1], n[2], 0.25});
  return v;
}

TEST(HizSsr, ConfidenceFadesTowardsTheEdgesOfTheImage) {
  for (const std::string& device : with_double()) {
    HizSsrParams p = ssr_params(48, 40);
    p.rays = 300;
    p.fade_edge = 0.25;
    const Values depth = height_field(48, 40, 5), rays = screen_rays(p, p.rays, 6);
    const auto r = follow(test_context(device), p, depth, rays);
    ASSERT_TRUE(r) << r.status().message();
    int faded = 0, whole = 0;
    for (std::size_t i = 0; i < 300; ++i) {
      if (r.value().outcome(i) != SsrOutcome::hit) continue;
      const double u = r.value().hits[4 * i], v = r.value().hits[4 * i + 1], rim = std::min({u, 1 - u, v, 1 - v});
      EXPECT_NEAR(r.value().hits[4 * i + 3], std::min(rim / 0.25, 1.0), 1e-6) << device << " ray " << i;
      (rim < 0.25 ? faded : whole) += 1;
    }
    EXPECT_GT(faded, 10) << device;
    EXPECT_GT(whole, 10) << device;
  }
}

// A wall at depth 4 in the right half of the view, nothing in the left: a ray from (-1, 0, -2) along (3, 0, -2) meets it
// at (2, 0, -4), which is seen at 32.5 + 16 * 2 / 4 = 40.5.
TEST(HizSsr, ARayMeetsAWallWhereItDoesOnPaper) {
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda, SsrVariant::linear})
    for (const std::string& device : with_double()) {
      HizSsrParams p;
      p.width = 64;
      p.height = 33;
      p.variant = v;
      p.focal_x = p.focal_y = 16;
      p.centre_x = 32.5;
      p.centre_y = 16.5;
      p.rays = 4;
      p.max_distance = 50;
      p.fade_distance = 1;
      p.fade_edge = 0;
      Values depth, rays;
      for (int i = 0; i < 64 * 33; ++i) depth.push_back(i % 64 < 36 ? HUGE_VAL : 4);
      add_ray(rays, {-1, 0, -2}, {3, 0, -2});
      add_ray(rays, {-1, 0, -2}, {-1, 0, 0});   // out of the image, whose edge is at x = -32.5 / 16 * 2
      add_ray(rays, {-1, 0, -2}, {1, 0, 2});    // to the camera
      add_ray(rays, {-1, 0, -2}, {0, 0, -1});   // into the sky
      const auto r = follow(test_context(device), p, depth, rays);
      ASSERT_TRUE(r) << r.status().message();
      const SsrResult& got = r.value();
      EXPECT_EQ(got.outcome(0), SsrOutcome::hit) << device;
      EXPECT_NEAR(got.hits[0], 40.5 / 64, 1e-5) << device;
      EXPECT_NEAR(got.hits[1], 0.5, 1e-6) << device;
      EXPECT_NEAR(got.hits[2], 4, 1e-5) << device;
      EXPECT_NEAR(got.paths[0], std::sqrt(13.0), 1e-5) << device;
      EXPECT_NEAR(got.hits[3], 1 - std::sqrt(13.0) / 50, 1e-5) << device;  // fades over its whole length
      EXPECT_EQ(got.outcome(1), SsrOutcome::left) << device;
      EXPECT_NEAR(got.paths[4], 4.0625 - 1, 1e-5) << device;
      EXPECT_EQ(got.outcome(2), SsrOutcome::behind) << device;
      EXPECT_NEAR(got.paths[8], (2 - p.near_plane) * std::sqrt(5.0) / 2, 1e-4) << device;
      EXPECT_EQ(got.outcome(3), SsrOutcome::miss) << device;
      EXPECT_NEAR(got.paths[12], 50, 1e-3) << device;
    }
}

// Behind a plate at depth 2 with thickness 1 the ray at depth 4 goes on, and is marked; the wall at 5 is met.
TEST(HizSsr, BehindASurfaceTheWalkGoesOn) {
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda}) {
    HizSsrParams p = ssr_params(64, 8, v);
    p.thickness = 1;
    p.rays = 1;
    Values depth, rays;
    for (int i = 0; i < 64 * 8; ++i) depth.push_back(i % 64 < 16 ? HUGE_VAL : i % 64 < 40 ? 2 : i % 64 < 50 ? HUGE_VAL : 4);
    add_ray(rays, {(4 - p.centre_x) / p.focal_x * 4.5, 0.01, -4.5}, {1, 0, 0});
    for (const std::string& device : with_double()) {
      auto r = follow(test_context(device), p, depth, rays);
      ASSERT_TRUE(r) << r.status().message();
      EXPECT_EQ(r.value().outcome(0), SsrOutcome::hit);
      EXPECT_EQ(std::floor(r.value().hits[0] * 64), 50);
      EXPECT_EQ(r.value().paths[2], 1);
    }
  }
}

struct Form {
  std::string name;
  std::function<void(HizSsrParams&)> change;
};

TEST(HizSsr, EveryDeviceGivesTheSameBits) {
  const Form forms[] = {
      {"hiz", [](HizSsrParams&) {}},
      {"hiz from level 3", [](HizSsrParams& p) { p.start_level = 3, p.levels = 5; }},
      {"dda", [](HizSsrParams& p) { p.variant = SsrVariant::dda; }},
      {"linear", [](HizSsrParams& p) { p.variant = SsrVariant::linear, p.max_distance = 9; }},
      {"standard", [](HizSsrParams& p) { p.depth = SsrDepth::standard, p.near_plane = 0.1, p.far_plane = 40; }},
      {"reversed", [](HizSsrParams& p) { p.depth = SsrDepth::reversed, p.near_plane = 0.1; }},
      {"fades", [](HizSsrParams& p) { p.max_distance = 6, p.fade_distance = 0.7, p.fade_thickness = 0.5, p.fade_back = 0.5; }}};
  for (const Form& form : forms)
    for (const bool list : {true, false})
      for (const bool count : {false, true}) {
        if (count && form.name != "hiz") continue;
        HizSsrParams p = ssr_params(71, 43);
        p.thickness = 0.7;
        form.change(p);
        p.rays = list ? 300 : 0;
        p.count = count;
        const Values stored = stored_depths(p, height_field(71, 43, 5));
        Values source = list ? screen_rays(p, 300, 6) : mirrors(71 * 43, {0.2, 0.6, 0.7});
        for (double& v : source) v = static_cast<float>(v);
        const auto expected = follow(test_context("cpu"), p, stored, source);
        ASSERT_TRUE(expected) << expected.status().message();
        double hits = 0;
        for (std::size_t i = 0; 4 * i < expected.value().paths.size(); ++i)
          hits += expected.value().outcome(i) == SsrOutcome::hit;
        EXPECT_GT(hits, 30) << form.name;
        for (const std::string& device : test_devices()) {
          const auto r = follow(test_context(device), p, stored, source);
          ASSERT_TRUE(r) << r.status().message();
          EXPECT_EQ(count_different(r.value().hits, expected.value().hits), 0) << device << " " << form.name;
          EXPECT_EQ(count_different(r.value().paths, expected.value().paths), 0) << device << " " << form.name;
          EXPECT_EQ(count_different(r.value().counters, expected.value().counters), 0) << device << " " << form.name;
        }
      }
}

TEST(HizSsr, EveryDeviceShadesWithTheSameBits) {
  const Values stored = height_field(71, 43, 5);
  SsrColours colours;
  for (std::size_t i = 0; i < 4 * stored.size(); ++i) {
    colours.colour.push_back(static_cast<float>(0.01 * static_cast<double>(i % 397)));
    colours.fallback.push_back(0.125);
    colours.specular.push_back(0.0625 * static_cast<double>(i % 4));
  }
  colours.split_sum = split_sum_table(test_context("cpu"), 8, 64).value();
  Values normals;
  for (int i = 0; i < 71 * 43; ++i)
    for (const double v : {0.1 * (i % 3), 0.6, 0.7, 0.05 * (i / 71 % 21)}) normals.push_back(static_cast<float>(v));
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::stochastic})
    for (const bool more : {false, true}) {
      HizSsrParams p = ssr_params(71, 43, v);
      p.shade = true;
      p.thickness = 0.5;
      p.fade_back = 0.25;
      p.fallback = p.factor = more;
      p.split_sum_size = 8;
      p.seed = more ? 3 : 0;
      if (v == SsrVariant::stochastic) p.half_resolution = more, p.rays_per_pixel = more ? 3 : 1, p.reuse = more ? 2 : 0;
      const auto expected = follow(test_context("cpu"), p, stored, normals, colours);
      ASSERT_TRUE(expected) << expected.status().message();
      EXPECT_GT(*std::max_element(expected.value().radiance.begin(), expected.value().radiance.end()), 0.1);
      for (const std::string& device : test_devices()) {
        EXPECT_EQ(count_different(split_sum_table(test_context(device), 8, 64).value(), colours.split_sum), 0) << device;
        const auto r = follow(test_context(device), p, stored, normals, colours);
        ASSERT_TRUE(r) << r.status().message();
        for (std::size_t i = 0; i < r.value().directions.size(); ++i) {  // there are none where there is no ray
          const SsrOutcome outcome = expected.value().outcome(i / 4);
          if (outcome == SsrOutcome::none || outcome == SsrOutcome::degenerate) continue;
          ASSERT_TRUE(same(r.value().directions[i], expected.value().directions[i])) << device;
        }
        EXPECT_EQ(count_different(r.value().hits, expected.value().hits), 0) << device;
        EXPECT_EQ(count_different(r.value().radiance, expected.value().radiance), 0) << device;
      }
    }
}

// Every part once, small enough for Oclgrind; widths and heights that leave tiles and workgroups partly filled.
TEST(HizSsrSmall, EveryPartRuns) {
  constexpr int width = 19, height = 11;
  const Values stored = height_field(width, height, 5);
  SsrColours colours;
  for (std::size_t i = 0; i < 4 * stored.size(); ++i) {
    colours.colour.push_back(0.5);
    colours.fallback.push_back(0.5);
    colours.specular.push_back(0.25);
  }
  Values normals = mirrors(stored.size(), {0, 0.6, 0.8});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) normals[4 * static_cast<std::size_t>(y * width + x) + 3] = 2;  // a tile that reflects nothing
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    colours.split_sum = split_sum_table(context, 4, 8).value();
    for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda, SsrVariant::linear, SsrVariant::stochastic})
      for (const bool more : {false, true}) {
        if (more && (v == SsrVariant::dda || v == SsrVariant::linear)) continue;
        HizSsrParams p = ssr_params(width, height, v);
        p.shade = true;
        p.thickness = 0.5;
        p.max_distance = 9;
        p.environment = {0.5, 0.5, 0.5};
        p.fallback = p.factor = p.count = more;
        p.split_sum_size = 4;
        if (v == SsrVariant::stochastic) p.half_resolution = more, p.rays_per_pixel = more ? 2 : 1, p.reuse = more ? 1 : 0;
        const auto r = follow(context, p, stored, normals, colours);
        ASSERT_TRUE(r) << r.status().message();
        double lit = 0;
        for (std::size_t i = 0; i < stored.size(); ++i) {
          const double radiance = r.value().radiance[4 * i];
          if (i % width < 8 && i / width < 8) { EXPECT_EQ(radiance, 0) << device << " " << i; }
          if (!more && radiance != 0) { EXPECT_NEAR(radiance, 0.5, 1e-5) << device; }
          lit += radiance != 0;
        }
        EXPECT_GT(lit, 20) << device << " variant " << static_cast<int>(v);
      }
    HizSsrParams p = ssr_params(width, height);
    p.rays = 40;
    EXPECT_TRUE(follow(context, p, stored, screen_rays(p, p.rays, 3))) << device;
  }
}

TEST(HizSsr, AgreesWithTheExhaustiveWalkOnAlmostAllRays) {
  // Equal without any slack; the rest are ties by rounding (hiz_ssr_stability_test has none wrong).
  constexpr double least_float = 0.99, least_double = 0.999;
  for (const std::string& device : {std::string("cpu"), std::string("cpu:double")}) {
    HizSsrParams p = ssr_params(160, 90);
    p.thickness = 0.5;
    p.rays = 2000;
    const Values stored = height_field(160, 90, 9), rays = screen_rays(p, p.rays, 10);
    const auto r = follow(test_context(device), p, stored, rays);
    ASSERT_TRUE(r) << r.status().message();
    const Agreement a = compare(p, stored, rays, r.value());
    EXPECT_EQ(a.wrong + a.broken, 0);
    EXPECT_GT(a.hits, 500);
    EXPECT_GE(a.equal, (device == "cpu" ? least_float : least_double) * a.rays) << a.ties << " ties on " << device;
    RecordProperty(device == "cpu" ? "equal_float" : "equal_double", a.equal);
  }
}

TEST(HizSsr, UniformStepsMissThinFeaturesThatTheOthersFind) {
  HizSsrParams p = ssr_params(200, 60);
  p.thickness = 0.2;
  p.rays = 300;
  p.max_distance = 20;
  Values stored, rays;
  for (int i = 0; i < 200 * 60; ++i) stored.push_back(i % 200 % 37 == 20 ? 3 : HUGE_VAL);  // poles, one pixel wide
  for (int i = 0; i < p.rays; ++i) add_ray(rays, {-2.7, -0.5 + i / 300.0, -3.01 - 0.15 * i / 300}, {1, 0, 0});
  int found[3] = {};
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda, SsrVariant::linear}) {
    p.variant = v;
    p.steps = 32;
    const auto r = follow(test_context("cpu"), p, stored, rays);
    ASSERT_TRUE(r) << r.status().message();
    // Of six poles ahead the first: column 57.
    for (std::size_t i = 0; i < 300; ++i) found[static_cast<int>(v)] += std::floor(r.value().hits[4 * i] * 200) == 57;
  }
  EXPECT_EQ(found[0], 300);
  EXPECT_EQ(found[1], 300);
  EXPECT_LT(found[2], 150);
}

TEST(HizSsr, ThePyramidSavesLooks) {
  HizSsrParams p = ssr_params(512, 64);
  p.rays = 1;
  p.count = true;
  Values rays;
  add_ray(rays, {-2, 0.01, -2}, {1, 0, 0});
  Values looks;
  for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda}) {
    p.variant = v;
    const auto r = follow(test_context("cpu"), p, Values(512 * 64, 50.0), rays);
    ASSERT_TRUE(r) << r.status().message();
    looks.push_back(r.value().counters[static_cast<std::size_t>(SsrOutcome::steps)]);
  }
  EXPECT_GT(looks[1], 300);
  EXPECT_LT(looks[0], 20);
}

TEST(HizSsr, WritesNothingPastAnyEndAndEveryRay) {
  for (const std::string& device : test_devices())
    // The last has more tiles than one invocation of the list counts.
    for (const auto& [rays, width, height] : {std::array{0, 37, 23}, {77, 37, 23}, {0, 520, 40}}) {
      HizSsrParams p = ssr_params(width, height);
      p.rays = rays;
      p.count = true;
      const Values stored = height_field(width, height, 11);
      Context& context = test_context(device);
      const auto all = with_pyramid(context, p, stored);
      ASSERT_TRUE(all) << all.status().message();
      const Values source = rays > 0 ? screen_rays(p, rays, 12) : mirrors(static_cast<std::size_t>(width * height), {0, 1, 0.2});
      const auto floats = [](const Values& v) { return std::vector<float>(v.begin(), v.end()); };
      const std::vector<Bytes> out =
          run_bytes(context, plan(p, context.profile()).value(),
                    {{"depth", encode(Format::f32x1, floats(all.value()))},
                     {rays > 0 ? "rays" : "normals", encode(Format::f32x4, floats(source))},
                     {"counters", Bytes(4 * ssr_outcomes, 0)}},
                    {"paths"});
      ASSERT_EQ(out.size(), 1u);
      for (const double v : decode(Format::f32x4, out[0])) EXPECT_GE(v, 0) << device;  // the guards' pattern is negative
    }
}

TEST(HizSsr, RefusesWhatIsOutOfRange) {
  const auto refused = [](const std::function<void(HizSsrParams&)>& change) {
    HizSsrParams p = ssr_params(64, 48);
    EXPECT_TRUE(validate(p).ok()) << validate(p).message();
    change(p);
    return validate(p).message();
  };
  using P = HizSsrParams;
  EXPECT_EQ(refused([](P& p) { p.width = 0; }), "HizSsrParams.width is 0; expected 1..65535");
  EXPECT_EQ(refused([](P& p) { p.height = 65536; }), "HizSsrParams.height is 65536; expected 1..65535");
  EXPECT_EQ(refused([](P& p) { p.width = p.height = 32768; }),
            "HizSsrParams.height is 32768; expected width x height of at most 268435456");
  EXPECT_EQ(refused([](P& p) { p.near_plane = 0; }), "HizSsrParams.near_plane is 0; expected 1e-6..1e9");
  EXPECT_EQ(refused([](P& p) { p.far_plane = 9; }), "HizSsrParams.far_plane is 9; expected 0 for linear depth");
  EXPECT_EQ(refused([](P& p) { p.depth = SsrDepth::standard, p.far_plane = 0.001; }),
            "HizSsrParams.far_plane is 0.001; expected 0 (infinite), or more than near_plane");
  EXPECT_EQ(refused([](P& p) { p.focal_y = 0; }), "HizSsrParams.focal_y is 0; expected 1e-3..1e9 pixels");
  EXPECT_EQ(refused([](P& p) { p.centre_x = std::nan(""); }), "HizSsrParams.centre_x is nan; expected -1e+09..1e+09");
  EXPECT_EQ(refused([](P& p) { p.rays = -1; }), "HizSsrParams.rays is -1; expected 0..67108864");
  EXPECT_EQ(refused([](P& p) { p.levels = 8; }), "HizSsrParams.levels is 8; expected 0..7");
  EXPECT_EQ(refused([](P& p) { p.levels = 3, p.start_level = 3; }), "HizSsrParams.start_level is 3; expected 0..2");
  EXPECT_EQ(refused([](P& p) { p.steps = 0; }), "HizSsrParams.steps is 0; expected 1..65536");
  EXPECT_EQ(refused([](P& p) { p.refinements = 25; }), "HizSsrParams.refinements is 25; expected 0..24");
  EXPECT_EQ(refused([](P& p) { p.thickness = -1; }), "HizSsrParams.thickness is -1; expected 0 or more");
  EXPECT_EQ(refused([](P& p) { p.variant = SsrVariant::linear; }),
            "HizSsrParams.max_distance is 0; expected more than 0 for variant linear");
  EXPECT_EQ(refused([](P& p) { p.bias = 65; }), "HizSsrParams.bias is 65; expected 0..64");
  EXPECT_EQ(refused([](P& p) { p.cutoff = 3; }), "HizSsrParams.cutoff is 3; expected 0..2");
  EXPECT_EQ(refused([](P& p) { p.fade_edge = 1; }), "HizSsrParams.fade_edge is 1; expected 0..0.5");
  EXPECT_EQ(refused([](P& p) { p.rays = 4, p.shade = true; }), "HizSsrParams.rays is 4; expected 0 with shade");
  EXPECT_EQ(refused([](P& p) { p.rays = 4, p.variant = SsrVariant::stochastic; }),
            "HizSsrParams.rays is 4; expected 0 for variant stochastic");
  EXPECT_EQ(refused([](P& p) { p.rays_per_pixel = 2; }), "HizSsrParams.rays_per_pixel is 2; expected 1..1");
  EXPECT_EQ(refused([](P& p) { p.half_resolution = true; }),
            "HizSsrParams.half_resolution is true; expected false but for variant stochastic");
  EXPECT_EQ(refused([](P& p) { p.reuse = 5; }), "HizSsrParams.reuse is 5; expected 0..4");
  EXPECT_EQ(refused([](P& p) { p.seed = -1; }), "HizSsrParams.seed is -1; expected 0..16777215");
  EXPECT_EQ(refused([](P& p) { p.colour_levels = 8; }), "HizSsrParams.colour_levels is 8; expected 0..7");
  EXPECT_EQ(refused([](P& p) { p.prefilter = 17; }), "HizSsrParams.prefilter is 17; expected 0..16");
  EXPECT_EQ(refused([](P& p) { p.environment[1] = -1; }), "HizSsrParams.environment is -1; expected 0..1e+30");
  EXPECT_EQ(refused([](P& p) { p.fallback = true; }), "HizSsrParams.fallback is true; expected false without shade");
  EXPECT_EQ(refused([](P& p) { p.split_sum_size = 1; }), "HizSsrParams.split_sum_size is 1; expected 2..1024");
  EXPECT_EQ(validate(SplitSumParams{1, 4}).message(), "SplitSumParams.size is 1; expected 2..1024");
  EXPECT_EQ(validate(SplitSumParams{4, 0}).message(), "SplitSumParams.samples is 0; expected 1..65536");
}

}  // namespace
}  // namespace luxel

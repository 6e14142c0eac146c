// More rounds of loops in an invocation than some drivers run: Mesa's llvmpipe ends all loops of an invocation after 65,535
// together, and says nothing (lp_limits.h, LP_MAX_TGSI_LOOP_ITERATIONS). What may need more has the same bits all the same.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <luxel/voxel_inject.h>

#include "bench/scene/images.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/run.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::Values;

// A member of what a run gave.
template <class R>
Result<Values> part(const Result<R>& given, Values R::*member) {
  if (!given) return given.status();
  return given.value().*member;
}

// Numbers in 0..1 without order.
double noise(int i) { return (scene::hash(static_cast<std::uint32_t>(i)) >> 8) * 0x1p-24; }

class LongLoopsFull : public testing::TestWithParam<std::string> {
 protected:
  // What `on` makes on this device has the bits of C++ in float; `refused`: or a driver that ends loops says that it would.
  template <class On>
  void same_bits(const On& on, bool refused = true) {
    const Result<Values> own = on(test_context(GetParam())), expected = on(test_context("cpu:float"));
    ASSERT_TRUE(expected) << expected.status().message();
    // Something was done.
    EXPECT_GE(std::set<double>(expected.value().begin(), expected.value().end()).size(), 3u);
    if (refused && test_context(GetParam()).profile().name == "lavapipe") {
      EXPECT_EQ(own.status().code(), Code::unsupported);
      EXPECT_NE(own.status().message().find("ends all loops of an invocation after 65535 rounds; pass "), std::string::npos)
          << own.status().message();
      return;
    }
    ASSERT_TRUE(own) << own.status().message();
    EXPECT_EQ(cases::count_different(own.value(), expected.value()), 0);
  }
};
INSTANTIATE_TEST_SUITE_P(Devices, LongLoopsFull, testing::ValuesIn(test_devices()));

TEST_P(LongLoopsFull, TilesOfALargeFrame) {
  HizSsrParams p = cases::ssr_params(2400, 2400, SsrVariant::dda);
  p.max_steps = 40;
  const std::size_t pixels = 2400 * 2400;
  const Values depth(pixels, 4.0);
  Values normals;
  // One pixel of each third tile.
  for (std::size_t i = 0; i < pixels; ++i)
    normals.insert(normals.end(), {0, 0.6, 0.8, i % 2400 % 24 == 5 && i / 2400 % 8 == 3 ? 0.0 : 2.0});
  same_bits([&](Context& context) { return part(cases::follow(context, p, depth, normals), &cases::SsrResult::paths); }, false);
}

// Each of the rest twice: the most that no driver refuses or nearly, and many more.

TEST_P(LongLoopsFull, Lights) {
  constexpr int side = 24;
  for (const int lights : {885, 4000}) {
    VoxelInjectParams p;
    p.width = p.height = p.depth = side;
    p.bricks = 27;
    p.lights = lights;
    std::vector<VoxelLight> list;
    for (int i = 0; i < lights; ++i) {
      VoxelLight light;
      light.place = {1, 0.01 * (i % 7), 0.01 * (i % 11)};
      light.power = {1, 0.5, 0.25};
      list.push_back(light);
    }
    Values colour(side * side * side * 4, 0.0), normal = colour, bricks, counters(16, 0.0), words;
    const std::size_t at = ((12 * side + 12) * side) * 4;
    for (std::size_t c = 0; c < 4; ++c) colour[at + c] = 1;
    normal[at] = 1;
    for (int i = 0; i < p.bricks; ++i) bricks.push_back(i);
    counters[2] = p.bricks;
    for (const float w : voxel_lights(list, {0, 0, 0}, p.voxel)) words.push_back(w);
    same_bits([&](Context& context) -> Result<Values> {
      auto run = cases::Run::make(context, plan(p, context.profile()));
      if (!run) return run.status();
      for (const auto& [name, values] :
           {std::pair{"colour", &colour}, {"normal", &normal}, {"bricks", &bricks}, {"voxel_counters", &counters}, {"lights", &words}})
        if (Status s = run.value().write(name, *values); !s) return s;
      if (Status s = run.value().go(); !s) return s;
      return run.value().read("radiance");
    }, lights > 1000);
  }
}

TEST_P(LongLoopsFull, CellsOfAGrid) {
  for (const double cell : {250.0, 300.0}) {
    BilateralParams p = cases::bilateral_params(700, 700, "c");
    p.variant = BilateralVariant::grid;
    p.sigma_space = cell;
    p.high = 2;
    const auto images = cases::bilateral_images(p, 1);
    same_bits([&](Context& context) { return part(cases::filter(context, p, images), &cases::Filtered::dst); }, cell > 250);
  }
}

TEST_P(LongLoopsFull, MapsAveraged) {
  for (const int size : {512, 2048}) {
    ProbeIrradianceParams p;
    p.grid.count = {1, 1, 1};
    p.maps = {size, 1, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
    p.samples = 4;
    p.irradiance_size = p.moments_size = 4;
    p.irradiance_format = Format::f32x4;
    p.moments_format = Format::f32x2;
    cases::ProbeSeen seen;
    for (int i = 0; i < size * size; ++i) {
      const double v = noise(i);
      seen.radiance.insert(seen.radiance.end(), {v, v * v, 1 - v, 0});
      seen.distance.push_back(static_cast<float>(0.1 + v));
    }
    for (Values cases::ProbeFiltered::*const map : {&cases::ProbeFiltered::irradiance, &cases::ProbeFiltered::moments})
      same_bits([&](Context& context) { return part(cases::filter(context, p, seen), map); }, size > 512);
  }
}

TEST_P(LongLoopsFull, ConesInSmallSteps) {
  for (const double step : {0.25, 1.0 / 16}) {
    ConeTraceParams p = cases::cone_params(128);
    p.cones = {};
    for (int i = 0; i < 64; ++i) p.cones.push_back({{0.3 * std::cos(i), 0.3 * std::sin(i), 0.9}, 1, 0.01});
    p.footprint = 1.0 / 16;
    p.step_scale = step;
    Values receivers;
    cases::add_receiver(receivers, {0.5, 0.02, 0.5}, {0, 1, 0});
    const Values volume = cases::uniform_volume(128, {1e-5, 2e-5, 3e-5, 1e-4});
    same_bits([&](Context& context) { return part(cases::trace(context, p, volume, receivers), &cases::ConeResult::irradiance); },
              step < 0.25);
  }
}

TEST_P(LongLoopsFull, UniformStepsOfARay) {
  for (const int steps : {8000, 65536}) {
    HizSsrParams p = cases::ssr_params(1024, 8, SsrVariant::linear);
    p.steps = steps;
    p.max_distance = 100;
    p.rays = 4;
    p.thickness = 0.1;
    Values depth(1024 * 8, HUGE_VAL), rays;
    for (std::size_t y = 0; y < 8; ++y) depth[y * 1024 + 900] = 4;
    for (int i = 0; i < 4; ++i) cases::add_ray(rays, {-1.9, -0.001 * i, -4.005}, {1, 0, 0});
    same_bits([&](Context& context) { return part(cases::follow(context, p, depth, rays), &cases::SsrResult::paths); }, steps > 8000);
  }
}

TEST_P(LongLoopsFull, SamplesOfTheSplitSum) {
  for (const int samples : {3500, 65536})
    same_bits([&](Context& context) { return cases::split_sum_table(context, 4, samples); }, samples > 3500);
}

// Windows of 34,641 pixels, and lines that are begun again for the period of their border.
TEST_P(LongLoopsFull, LongestLines) {
  for (const GaussianVariant v : {GaussianVariant::box, GaussianVariant::recursive}) {
    GaussianBlurParams p = cases::blur_params(65535, 1, 10000, -1, Format::f32x1, Border::wrap, v);
    if (v == GaussianVariant::box) p.passes = 1;
    Values src;
    for (int i = 0; i < p.width; ++i) src.push_back(noise(i));
    SCOPED_TRACE(cases::name(v));
    same_bits([&](Context& context) { return cases::blur(context, p, src); });
  }
}

TEST_P(LongLoopsFull, LinesOfAnImage) {
  for (const GaussianVariant v : {GaussianVariant::box, GaussianVariant::recursive, GaussianVariant::separable})
    for (const auto& [width, height] : {std::pair{60000, 1}, {1, 60000}, {600, 2}}) {
      if ((v == GaussianVariant::box) != (width == 600)) continue;
      const int radius = v == GaussianVariant::separable ? 4095 : -1;
      const GaussianBlurParams p = cases::blur_params(width, height, 10000, radius, Format::f32x1, Border::clamp, v);
      Values src;
      for (int i = 0; i < width * height; ++i) src.push_back(noise(i));
      SCOPED_TRACE(std::string(cases::name(v)) + " " + std::to_string(width));
      same_bits([&](Context& context) { return cases::blur(context, p, src); }, false);
    }
}

}  // namespace
}  // namespace luxel

// lpv_inject, lpv_inject_geometry, lpv_sample and lpv_filter: refusals, guard bands, and what cascades promise. Their values
// are tested by the cases (lpv_stability_test).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/lpv_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases::lpv;

template <class Params>
void refused(Params p, const char* expected) {
  const Status s = validate(p);
  EXPECT_EQ(s.code(), Code::invalid_argument);
  EXPECT_EQ(s.message(), expected);
  for (const std::string& device : test_devices()) EXPECT_FALSE(plan(p, test_context(device).profile()).ok()) << device;
}

LpvInjectParams lights_of(int width, int height, int depth) {
  LpvInjectParams p;
  p.grid = grid_of(width, height, depth);
  return p;
}

TEST(LpvInject, RefusesWithFieldValueAndRange) {
  const auto with = [](auto change) {
    LpvInjectParams p = lights_of(4, 4, 4);
    change(p);
    return p;
  };
  EXPECT_TRUE(validate(lights_of(4, 4, 4)).ok());
  refused(with([](auto& p) { p.grid.extent[1] = 0; }), "LpvInjectParams.grid.extent[1] is 0; expected 1..1024");
  refused(with([](auto& p) { p.grid.cell = 0; }), "LpvInjectParams.grid.cell is 0; expected 1e-15..1e+15");
  refused(with([](auto& p) { p.grid.origin[2] = std::nan(""); }), "LpvInjectParams.grid.origin[2] is nan; expected -1e+30..1e+30");
  refused(with([](auto& p) { p.lights = -1; }), "LpvInjectParams.lights is -1; expected 0..16777216");
  refused(with([](auto& p) { p.bands = 4; }), "LpvInjectParams.bands is 4; expected 2..3");
  refused(with([](auto& p) { p.channels = 2; }), "LpvInjectParams.channels is 2; expected 1 or 3");
  refused(with([](auto& p) { p.format = Format::unorm8x4; }), "LpvInjectParams.format is unorm8x4; expected f32x4 or f16x4");
  refused(with([](auto& p) { p.flux_max = 0; }), "LpvInjectParams.flux_max is 0; expected 1e-30..1e+30");
  refused(with([](auto& p) { p.offset = 5; }), "LpvInjectParams.offset is 5; expected -4..4");
  refused(with([](auto& p) { p.grid.extent = {1024, 1024, 64}; }),
          "LpvInjectParams.grid.extent[2] is 64; expected a grid whose sums, three words each, are at most 2147483647 words");
}

TEST(LpvInjectGeometry, RefusesWithFieldValueAndRange) {
  const auto with = [](auto change) {
    LpvInjectGeometryParams p;
    p.grid = grid_of(4, 4, 4);
    p.surfels = {1, 0, 0, 0};
    change(p);
    return p;
  };
  refused(with([](auto& p) { p.grid.extent[0] = 1025; }), "LpvInjectGeometryParams.grid.extent[0] is 1025; expected 1..1024");
  refused(with([](auto& p) { p.surfels[2] = -1; }), "LpvInjectGeometryParams.surfels[2] is -1; expected 0..4194304");
  refused(with([](auto& p) { p.surfels = {4194304, 1, 0, 0}; }), "LpvInjectGeometryParams.surfels is 4194305; expected 0..4194304 in all");
  refused(with([](auto& p) { p.format = Format::f32x1; }), "LpvInjectGeometryParams.format is f32x1; expected f32x4 or f16x4");
  refused(with([](auto& p) { p.area_max = 65; }), "LpvInjectGeometryParams.area_max is 65; expected 9.53674e-07..64");
  refused(with([](auto& p) { p.offset = -5; }), "LpvInjectGeometryParams.offset is -5; expected -4..4");
}

TEST(LpvSample, RefusesWithFieldValueAndRange) {
  const auto with = [](auto change) {
    LpvSampleParams p;
    p.grids = lpv_cascades({8, 8, 8}, 1, {0, 0, 0}, 2);
    p.receivers = 1;
    change(p);
    return p;
  };
  EXPECT_TRUE(validate(with([](auto&) {})).ok());
  refused(with([](auto& p) { p.grids.clear(); }), "LpvSampleParams.grids.size() is 0; expected 1..3");
  refused(with([](auto& p) { p.grids[1].extent[2] = 9; }), "LpvSampleParams.grids[1].extent[2] is 9; expected that of the first cascade");
  refused(with([](auto& p) { p.grids[1].cell = 0.5; }), "LpvSampleParams.grids[1].cell is 0.5; expected a grid that holds the cascade before it");
  refused(with([](auto& p) { p.receivers = 0; }), "LpvSampleParams.receivers is 0; expected 1..16777216");
  refused(with([](auto& p) { p.bands = 1; }), "LpvSampleParams.bands is 1; expected 2..3");
  refused(with([](auto& p) { p.channels = 4; }), "LpvSampleParams.channels is 4; expected 1 or 3");
  refused(with([](auto& p) { p.format = Format::u32; }), "LpvSampleParams.format is u32; expected f32x4 or f16x4");
  refused(with([](auto& p) { p.offset = -4.5; }), "LpvSampleParams.offset is -4.5; expected -4..4");
  refused(with([](auto& p) { p.damping = 1.5; }), "LpvSampleParams.damping is 1.5; expected 0..1");
  refused(with([](auto& p) { p.blend = 5; }), "LpvSampleParams.blend is 5; expected 0.125..4");
  refused(with([](auto& p) { p.gain = 0; }), "LpvSampleParams.gain is 0; expected 1e-30..1e+30");
  refused(with([](auto& p) { p.glossy_steps = 65; }), "LpvSampleParams.glossy_steps is 65; expected 0..64");
}

TEST(LpvFilter, RefusesWithFieldValueAndRange) {
  LpvFilterParams p;
  p.grid = grid_of(4, 4, 4);
  EXPECT_TRUE(validate(p).ok());
  p.weight = 0.5;
  refused(p, "LpvFilterParams.weight is 0.5; expected 0..0.333333");
  p.weight = 0.25;
  p.channels = 0;
  refused(p, "LpvFilterParams.channels is 0; expected 1..4");
}

// Sizes that fill no workgroup; run_bytes looks behind every resource.
TEST(LpvInject, WritesAllOfItsVolumeAndNothingBehind) {
  for (const std::string& device : test_devices())
    for (const Format format : {Format::f32x4, Format::f16x4})
      for (const int bands : {2, 3}) {
        Context& context = test_context(device);
        LpvInjectParams p = lights_of(5, 3, 7);
        p.format = format;
        p.bands = bands;
        p.count = true;
        const Values list = list_of(random_lights(333, p.grid.extent, 3));
        p.lights = 333;
        const auto made = plan(p, context.profile());
        ASSERT_TRUE(made.ok()) << made.status().message();
        const auto out = run_bytes(context, made.value(), {{"lights", encode(Format::f32x4, {list.begin(), list.end()}, context.real64())}},
                                   {"injected", "outcomes"});
        ASSERT_EQ(out.size(), 2u);
        std::size_t lit = 0;
        for (const double v : decode(format, out[0], context.real64())) {
          ASSERT_TRUE(std::isfinite(v) && std::fabs(v) < 100) << device;  // the pattern is neither
          lit += v != 0;
        }
        EXPECT_GT(lit, 500u);
      }
}

TEST(LpvInjectGeometry, WritesAllOfItsVolumeAndNothingBehind) {
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    LpvInjectGeometryParams p;
    p.grid = grid_of(5, 3, 7);
    p.surfels = {100, 133, 0, 100};
    p.count = true;
    const Values list = list_of(random_surfels(333, p.grid.extent, 3));
    const auto made = plan(p, context.profile());
    ASSERT_TRUE(made.ok()) << made.status().message();
    const auto out = run_bytes(context, made.value(), {{"surfels", encode(Format::f32x4, {list.begin(), list.end()}, context.real64())}},
                               {"geometry", "outcomes"});
    ASSERT_EQ(out.size(), 2u);
    const auto v = decode(Format::f32x4, out[0], context.real64());
    ASSERT_EQ(v.size(), 4u * 6 * 4 * 8);
    for (const double c : v) ASSERT_TRUE(std::isfinite(c) && std::fabs(c) < 100) << device;
  }
}

TEST(LpvSample, WritesEveryReceiverAndNothingBehind) {
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    LpvSampleParams p;
    p.grids = {grid_of(3, 3, 3)};
    p.receivers = 77;
    p.glossy_steps = 2;
    p.count = true;
    const std::vector<float> light(lpv_sample_offset(p, 1) * 4, 1.0f);
    const Values places = receivers_at(random_surfels(77, {3, 3, 3}, 5));
    const std::vector<float> views(77 * 4, 1.0f);
    const auto made = plan(p, context.profile());
    ASSERT_TRUE(made.ok()) << made.status().message();
    const auto out = run_bytes(context, made.value(),
                               {{"light", encode(Format::f32x4, light, context.real64())},
                                {"receivers", encode(Format::f32x4, {places.begin(), places.end()}, context.real64())},
                                {"views", encode(Format::f32x4, views, context.real64())}},
                               {"irradiance", "specular", "outcomes"});
    ASSERT_EQ(out.size(), 3u);
    for (std::size_t i = 0; i < 2; ++i)
      for (const double c : decode(Format::f32x4, out[i], context.real64())) ASSERT_TRUE(c >= 0 && c < 100) << device;
  }
}

TEST(LpvCascades, LieInEachOtherAtMultiplesOfTheirCells) {
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Vec centre{100 * uniform(3 * i) - 50, 3 * uniform(3 * i + 1), -1000 * uniform(3 * i + 2)};
    const double cell = 0.01 + uniform(i + 1000);
    LpvSampleParams p;
    p.grids = lpv_cascades({16, 8, 4}, cell, centre, 3);
    p.receivers = 1;
    ASSERT_EQ(p.grids.size(), 3u);
    EXPECT_TRUE(validate(p).ok()) << validate(p).message();
    for (std::size_t k = 0; k < 3; ++k) {
      const LpvGrid& g = p.grids[k];
      EXPECT_EQ(g.cell, cell * (1 << k));
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(g.origin[a] / g.cell, std::round(g.origin[a] / g.cell), 1e-9);
        EXPECT_LE(std::fabs(g.origin[a] + g.cell * g.extent[a] / 2 - centre[a]), g.cell / 2 * (1 + 1e-12));
      }
    }
  }
}

}  // namespace
}  // namespace luxel

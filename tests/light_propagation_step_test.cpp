// lpv_propagate: the step against its definition on every execution, forms that give the same bits, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/cases/compare.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/run.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::Values;

Values result_of(const std::string& device, const LpvPropagateParams& p, const Values& injected, const Values& geometry = {}) {
  Context& context = test_context(device);
  const Result<Values> got = cases::propagate(context, p, injected, geometry);
  EXPECT_TRUE(got.ok()) << device << ": " << got.status().message();
  for (const std::string& message : context.validation_messages()) ADD_FAILURE() << message;
  return got.ok() ? got.value() : Values();
}

double largest(const Values& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::fabs(x));
  return most;
}

// Relative to the largest coefficient: 8 steps of some forty operations in f32, errors that partly cancel.
constexpr double f32_bound = 2e-6;
// The solid angles' digits are those of f32 (math/lobe.h).
constexpr double f64_bound = 1e-7;

struct Setting {
  std::array<int, 3> extent;
  int bands, iterations;
  LpvLobes lobes;
  LpvBorder border;
  bool geometry;
};

std::string text(const Setting& s) {
  return std::to_string(s.extent[0]) + "x" + std::to_string(s.extent[1]) + "x" + std::to_string(s.extent[2]) + "_bands" +
         std::to_string(s.bands) + "_" + cases::name(s.lobes) + (s.border == LpvBorder::periodic ? "_periodic" : "_open") +
         (s.geometry ? "_geometry" : "") + "_" + std::to_string(s.iterations);
}

class LpvStep : public testing::TestWithParam<Setting> {};

TEST_P(LpvStep, IsTheDefinitionAndHasTheSameBitsEverywhere) {
  const Setting& s = GetParam();
  LpvPropagateParams p = cases::lpv_params(s.extent, s.bands, s.lobes);
  p.iterations = s.iterations, p.border = s.border, p.geometry = s.geometry, p.keep_injected = s.iterations % 2 == 1;
  p.channels = 2;
  const Values red = cases::lpv_lights(p.grid, s.bands, 5, 1), green = cases::lpv_lights(p.grid, s.bands, 9, 2);
  const Values blocks = s.geometry ? cases::lpv_surfels(p.grid, 1.5, 3) : Values();
  Values injected = truth::lpv_to_pixels(p.grid, s.bands, red), expected;
  const Values second = truth::lpv_to_pixels(p.grid, s.bands, green);
  injected.insert(injected.end(), second.begin(), second.end());
  for (const Values& light : {red, green}) {
    const Values one = truth::lpv_to_pixels(p.grid, s.bands, truth::lpv_propagated(p, light, blocks));
    expected.insert(expected.end(), one.begin(), one.end());
  }
  const Values cpu = result_of("cpu", p, injected, blocks);
  const double scale = largest(expected);
  ASSERT_GT(scale, 0);
  EXPECT_LE(cases::max_difference(cpu, expected) / scale, f32_bound);
  EXPECT_LE(cases::max_difference(result_of("cpu:double", p, injected, blocks), expected) / scale, f64_bound);
  for (const std::string& device : test_devices())
    if (device != "cpu") {
      EXPECT_EQ(cases::count_different(result_of(device, p, injected, blocks), cpu), 0) << device;
    }
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (const int bands : {2, 3})
    for (const LpvLobes lobes : cases::all_lobes)
      for (const bool geometry : {false, true})
        all.push_back({{19, 6, 5}, bands, lobes == LpvLobes::linear ? 5 : 4, lobes,
                       geometry == (bands == 2) ? LpvBorder::open : LpvBorder::periodic, geometry});
  all.push_back({{1, 1, 1}, 2, 3, LpvLobes::linear, LpvBorder::open, true});
  all.push_back({{1, 1, 1}, 2, 2, LpvLobes::linear, LpvBorder::periodic, false});
  all.push_back({{16, 1, 2}, 3, 2, LpvLobes::clamp, LpvBorder::open, false});
  all.push_back({{32, 3, 1}, 2, 4, LpvLobes::rescale, LpvBorder::periodic, true});
  all.push_back({{1, 17, 4}, 2, 1, LpvLobes::shrink, LpvBorder::open, true});
  return all;
}

INSTANTIATE_TEST_SUITE_P(LightPropagation, LpvStep, testing::ValuesIn(settings()),
                         [](const auto& info) { return text(info.param); });

TEST(LightPropagation, DISABLED_Time) {
  for (const std::string& device : {std::string("opencl")})
    for (const int side : {32, 64})
      for (const int bands : {2})
        for (const bool geometry : {false})
          for (const LpvLobes lobes : {LpvLobes::linear}) {
            LpvPropagateParams p = cases::lpv_params({side, side, side}, bands, lobes);
            p.geometry = geometry, p.channels = 3, p.iterations = 16;
            Context& context = test_context(device);
            auto run = cases::Run::make(context, plan(p, context.profile()));
            const Values light = cases::lpv_lights(p.grid, bands, 5, 1);
            Values px = truth::lpv_to_pixels(p.grid, bands, light), all;
            for (int c = 0; c < 3; ++c) all.insert(all.end(), px.begin(), px.end());
            ASSERT_TRUE(run.value().write("injected", all).ok());
            if (geometry) { ASSERT_TRUE(run.value().write("geometry", cases::lpv_surfels(p.grid, 1, 3)).ok()); }
            Times best;
            best.total = 1e9;
            for (int k = 0; k < 10; ++k) {
              Times t;
              ASSERT_TRUE(run.value().go(1, &t).ok());
              if (t.total < best.total) best = t;
            }
            const double cells = double(side) * side * side * 3;
            const double step = best.passes.empty() ? 0 : best.passes[best.passes.size() - 3];
            std::printf("%s %d^3 bands %d geo %d %s: total %.2f ms start %.2f step %.3f finish %.2f: %.1f GB/s of floor\n",
                        device.c_str(), side, bands, geometry, cases::name(lobes), best.total,
                        best.passes.empty() ? 0 : best.passes[0], step, best.passes.empty() ? 0 : best.passes.back(),
                        cells * 16 * (bands == 3 ? 6 : 4) / step * 1e-6);
            if (bands == 2 && !geometry && lobes == LpvLobes::linear)
              for (double t : best.passes) std::printf("  %.3f", t);
            std::printf("\n");
          }
}

}  // namespace
}  // namespace luxel

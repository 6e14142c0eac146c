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

}  // namespace
}  // namespace luxel

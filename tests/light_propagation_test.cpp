// lpv_propagate against closed forms: one light in free space, flux of the printed formula, constants; and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "host/module.h"
#include "tests/cases/compare.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/run.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::Values;
constexpr double pi = std::numbers::pi;

// Irradiance on a surface that faces the light, per cell^2: sum c_i sh_cosine(i, direction).
double irradiance(const Values& pixels, std::size_t at, const std::array<double, 3>& d) {
  return pi / std::sqrt(4 * pi) * pixels[at] +
         2 * pi / 3 * std::sqrt(3 / (4 * pi)) * (pixels[at + 1] * d[1] + pixels[at + 2] * d[2] + pixels[at + 3] * d[0]);
}

// One light of intensity 1 W/sr in every direction, 64 steps in 65^3 cells. The step is a diffusion that keeps .37 of the
// direction: far from I / r^2, and these are the factors.
TEST(LightPropagation, OneLightInFreeSpaceAgainstTheInverseSquare) {
  LpvPropagateParams p = cases::lpv_params({65, 65, 65});
  p.iterations = 64;
  Values light(4 * lpv_pixels(p.grid, 2, 1), 0);
  const auto at = [](int x, int y, int z) { return static_cast<std::size_t>(4 * ((z * 65 + y) * 65 + x)); };
  light[at(32, 32, 32)] = std::sqrt(4 * pi);
  {
    const std::string& device = test_devices().front();  // bits are equal: light_propagation_step_test.cpp
    const Result<Values> got = cases::propagate(test_context(device), p, light);
    ASSERT_TRUE(got.ok()) << got.status().message();
    const double expected[3][2] = {{2, 2.082}, {4, 2.377}, {8, 1.399}};
    for (const auto& [r, ratio] : expected) {
      const double e = irradiance(got.value(), at(32 + static_cast<int>(r), 32, 32), {1, 0, 0}) * r * r;
      EXPECT_NEAR(e, ratio, 0.005) << device << " at " << r << " cells";
    }
    // Around a sphere: cells whose middle lies 5.5 to 6.5 cells away.
    double least = 1e9, most = 0;
    for (int z = -7; z <= 7; ++z)
      for (int y = -7; y <= 7; ++y)
        for (int x = -7; x <= 7; ++x) {
          const double r = std::sqrt(static_cast<double>(x * x + y * y + z * z));
          if (r < 5.5 || r >= 6.5) continue;
          const double e = irradiance(got.value(), at(32 + x, 32 + y, 32 + z), {x / r, y / r, z / r}) * r * r;
          least = std::min(least, e), most = std::max(most, e);
        }
    EXPECT_LE(most / least, 1.18) << device;
    EXPECT_GE(most / least, 1.0);
    RecordProperty(device + "_anisotropy", std::to_string(most / least));
  }
}

// The share of a sphere is not the factor of a flux: with it a step keeps 1 / (4 pi), 8 %.
TEST(LightPropagation, FluxIsTheSolidAngleTimesTheIntensity) {
  LpvPropagateParams p = cases::lpv_params({9, 9, 9});
  p.iterations = 1;
  const Values light = cases::lpv_lights(LpvGrid{{3, 3, 3}, {}, 1}, 2, 1, 5);
  Values injected(4 * lpv_pixels(p.grid, 2, 1), 0);
  std::copy_n(light.begin(), 4, injected.begin() + 4 * (4 * 81 + 4 * 9 + 4));
  const double flux = injected[4 * (4 * 81 + 4 * 9 + 4)];
  const truth::LpvStep printed = truth::lpv_step(p.grid, 2, p.lobes, p.border, injected, {}, 1 / (4 * pi));
  EXPECT_NEAR(printed.ledger.held / flux, 1 / (4 * pi), 1e-12);
  for (const std::string& device : test_devices()) {
    const Result<Values> got = cases::propagate(test_context(device), p, injected);
    ASSERT_TRUE(got.ok()) << got.status().message();
    EXPECT_NEAR(cases::lpv_flux(got.value(), 729) / flux, 1, 1e-6) << device;
  }
}

TEST(LightPropagation, SolidAnglesOfTheFaces) {
  const auto [front, side] = truth::lpv_solid_angles();
  EXPECT_NEAR(front, 0.4006697, 5e-8);
  EXPECT_NEAR(side, 0.4234314, 5e-8);
  EXPECT_NEAR(front + 4 * side, 2 * pi / 3, 1e-15);
  // By the definition, numerically: the side of the cell beyond the shared face.
  double sum = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double x = 0.5 + (i + 0.5) / n, z = (j + 0.5) / n - 0.5;
      sum += 0.5 / std::pow(x * x + 0.25 + z * z, 1.5) / (n * n);
    }
  EXPECT_NEAR(sum, side, 1e-6);
}

// What a thousand steps make of constants that do not sum up exactly.
TEST(LightPropagation, ConstantsKeepTheFluxExactly) {
  constexpr float side = 0.20217357575893402f, front = 0.19130569696426392f;  // kernels/math/lobe.h
  EXPECT_EQ(front + 4 * side, 1.0f);
  EXPECT_EQ(static_cast<double>(front) + 4.0 * static_cast<double>(side), 1.0);
  const auto [f, s] = truth::lpv_solid_angles();
  // The same in f32 as a factor for each face, without the quotient by six.
  const double naive = 6.0 * (static_cast<double>(static_cast<float>(f / (4 * pi))) + 4.0 * static_cast<double>(static_cast<float>(s / (4 * pi))));
  const double sixth = 6.0 * static_cast<double>(1.0f / 6);
  EXPECT_GE(std::fabs(std::pow(naive, 1000) - 1) + std::fabs(std::pow(sixth, 1000) - 1), 2e-5);
  RecordProperty("drift_of_naive_constants", std::to_string(std::pow(naive, 1000) - 1));
  RecordProperty("drift_of_a_sixth", std::to_string(std::pow(sixth, 1000) - 1));
}

// Leaving work out changes no bit: channels, the geometry volume, the injected light.
TEST(LightPropagation, WhatIsLeftOutDoesNotChangeTheRest) {
  LpvPropagateParams p = cases::lpv_params({18, 5, 4});
  p.iterations = 3, p.lobes = LpvLobes::clamp;
  const Values red = truth::lpv_to_pixels(p.grid, 2, cases::lpv_lights(p.grid, 2, 6, 1));
  const Values green = truth::lpv_to_pixels(p.grid, 2, cases::lpv_lights(p.grid, 2, 6, 2));
  const Values nothing(4 * lpv_geometry_pixels(p.grid), 0);
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Values plain = cases::propagate(context, p, red).value();
    LpvPropagateParams blocked = p;
    blocked.geometry = true;
    EXPECT_EQ(cases::propagate(context, blocked, red, nothing).value(), plain) << device;
    LpvPropagateParams both = p;
    both.channels = 2;
    Values two = green;
    two.insert(two.end(), red.begin(), red.end());
    const Values of_two = cases::propagate(context, both, two).value();
    EXPECT_EQ(Values(of_two.begin() + static_cast<std::ptrdiff_t>(green.size()), of_two.end()), plain) << device;
    // Light that goes on from where it stood: the sums of both halves are those of the whole, to rounding.
    LpvPropagateParams whole = p, half = p;
    whole.lobes = half.lobes = LpvLobes::linear;
    whole.iterations = 4, half.iterations = 2;
    whole.geometry = half.geometry = true;
    const Values blocks = cases::lpv_surfels(p.grid, 1, 8);
    Values all = cases::propagate(context, whole, red, blocks).value();
    auto run = cases::Run::make(context, plan([&] { auto q = half; q.travelling = true; return q; }(), context.profile()));
    ASSERT_TRUE(run.value().write("injected", red).ok());
    ASSERT_TRUE(run.value().write("geometry", blocks).ok());
    ASSERT_TRUE(run.value().go().ok());
    const Values before = run.value().read("result").value(), on = run.value().read("travelling").value();
    half.continued = true;
    const Values after = cases::propagate(context, half, on, blocks).value();
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_NEAR(before[i] + after[i], all[i], 1e-6) << device;
  }
}

// Cells that no light has reached are left out, and no bit changes.
struct ActiveSetting {
  std::array<int, 3> extent;
  int bands, every;  // a light in one of so many cells
  LpvLobes lobes;
  LpvBorder border;
  bool geometry, keep;
  std::vector<int> alone = {};  // cells that have all the light
  int steps = 5;
};

void expect_active_equals_all(const ActiveSetting& s, const std::vector<std::string>& devices) {
  LpvPropagateParams p = cases::lpv_params(s.extent, s.bands, s.lobes);
  p.iterations = s.steps, p.border = s.border, p.geometry = s.geometry, p.keep_injected = s.keep, p.channels = 2;
  Values light = truth::lpv_to_pixels(p.grid, s.bands, cases::lpv_lights(p.grid, s.bands, s.every, 31));
  const std::size_t cells = lpv_pixels(p.grid, 2, 1);
  for (std::size_t at = 0; at < light.size() && !s.alone.empty(); ++at)
    if (std::count(s.alone.begin(), s.alone.end(), static_cast<int>(at / 4 % cells)) == 0) light[at] = 0;
  Values other(light.size(), 0);
  if (s.every < 1000 && s.alone.empty()) other[4 * 18 + 1] = 2, other[4 * 20 + 3] = -0.0;  // no flux, only a direction
  light.insert(light.end(), other.begin(), other.end());
  const Values blocks = s.geometry ? cases::lpv_surfels(p.grid, 1, 32) : Values();
  for (const std::string& device : devices) {
    p.active = false;
    const Result<Values> all = cases::propagate(test_context(device), p, light, blocks);
    p.active = true;
    const Result<Values> some = cases::propagate(test_context(device), p, light, blocks);
    ASSERT_TRUE(all.ok()) << all.status().message();
    ASSERT_TRUE(some.ok()) << some.status().message();
    EXPECT_EQ(cases::count_different(some.value(), all.value()), 0) << device << " " << cases::name(s.lobes) << s.bands;
    for (const std::string& message : test_context(device).validation_messages()) ADD_FAILURE() << message;
  }
}

// Few lights, many, none, beside borders, of c0 = 0; one in the middle of a long grid, one whose light comes back on the other
// side, two far apart along each axis, two in a row.
TEST(LightPropagation, ActiveCellsGiveTheBitsOfAll) {
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (const ActiveSetting& s : std::vector<ActiveSetting>{
           {{35, 6, 7}, 2, 300, LpvLobes::linear, LpvBorder::open, false, true},
           {{33, 5, 6}, 2, 300, LpvLobes::rescale, LpvBorder::periodic, true, false},
           {{20, 4, 9}, 3, 90, LpvLobes::linear, LpvBorder::open, false, true},
           {{16, 3, 3}, 2, 1000000, LpvLobes::linear, LpvBorder::open, false, true},
           {{70, 15, 14}, 2, 1, LpvLobes::linear, LpvBorder::open, true, true, {(7 * 15 + 6) * 70 + 40}},
           {{53, 14, 15}, 3, 1, LpvLobes::linear, LpvBorder::periodic, false, true, {(13 * 14 + 7) * 53 + 2}},
           {{53, 20, 19}, 2, 1, LpvLobes::shrink, LpvBorder::open, false, true, {(8 * 20 + 7) * 53 + 18, (10 * 20 + 9) * 53 + 36}},
           {{53, 9, 8}, 2, 1, LpvLobes::linear, LpvBorder::open, false, true, {(4 * 9 + 4) * 53 + 3, (4 * 9 + 4) * 53 + 45}}})
    expect_active_equals_all(s, devices);
}

// Small enough for Oclgrind.
TEST(LightPropagationSmall, ActiveCellsGiveTheBitsOfAll) {
  expect_active_equals_all({{20, 3, 4}, 2, 1, LpvLobes::linear, LpvBorder::open, false, true, {(1 * 3 + 1) * 20 + 9}, 1}, test_devices());
}

// Steps end when what travels is a share of what was injected: the result is that of as many steps.
TEST(LightPropagation, StepsEndBelowTheErrorAskedFor) {
  LpvPropagateParams p = cases::lpv_params({20, 9, 8});
  const Values light = truth::lpv_to_pixels(p.grid, 2, cases::lpv_lights(p.grid, 2, 400, 5));
  double most = 0;
  for (std::size_t at = 0; at < light.size(); at += 4) most = std::max(most, light[at]);
  for (const double error : {0.2, 0.03, 0.004})
    for (const std::string& device : test_devices()) {
      // As many steps as it takes: what travels after k of them, from the difference of two sums.
      Values before(light.size(), 0), sum;
      int steps = 0;
      for (double travels = most; travels > error * most && steps < 40; before = sum) {
        p.active = false, p.error = 0, p.iterations = ++steps;
        sum = cases::propagate(test_context(device), p, light).value();
        travels = 0;
        for (std::size_t at = 0; at < sum.size(); at += 4) travels = std::max(travels, std::fabs(sum[at] - before[at]));
      }
      p.active = true, p.error = error, p.iterations = 40;
      EXPECT_GT(steps, 1);
      EXPECT_LT(steps, 40);
      EXPECT_EQ(cases::propagate(test_context(device), p, light).value(), sum) << device << " " << error << ", " << steps;
    }
}

struct Refusal {
  std::function<void(LpvPropagateParams&)> change;
  std::string message;
};

TEST(LightPropagation, RefusesWithFieldValueAndRange) {
  const LpvPropagateParams good = cases::lpv_params({8, 8, 8});
  ASSERT_TRUE(validate(good));
  const std::vector<Refusal> refusals = {
      {[](auto& p) { p.grid.extent[0] = 0; }, "LpvPropagateParams.grid.extent[0] is 0; expected 1..1024"},
      {[](auto& p) { p.grid.extent[1] = 1025; }, "LpvPropagateParams.grid.extent[1] is 1025; expected 1..1024"},
      {[](auto& p) { p.grid.extent[2] = -1; }, "LpvPropagateParams.grid.extent[2] is -1; expected 1..1024"},
      {[](auto& p) { p.grid.extent = {1024, 1024, 1024}; },
       "LpvPropagateParams.grid.extent[2] is 1024; expected a grid whose coefficients, in f32 and with 16 cells more along "
       "each axis, take at most 2147483647 bytes"},
      {[](auto& p) { p.bands = 4; }, "LpvPropagateParams.bands is 4; expected 2..3"},
      {[](auto& p) { p.channels = 0; }, "LpvPropagateParams.channels is 0; expected 1..4"},
      {[](auto& p) { p.format = Format::f32x1; }, "LpvPropagateParams.format is f32x1; expected f32x4 or f16x4"},
      {[](auto& p) { p.iterations = 0; }, "LpvPropagateParams.iterations is 0; expected 1..1000"},
      {[](auto& p) { p.iterations = 1001; }, "LpvPropagateParams.iterations is 1001; expected 1..1000"},
      {[](auto& p) { p.lobes = static_cast<LpvLobes>(4); }, "LpvPropagateParams.lobes is 4; expected 0..3"},
      {[](auto& p) { p.border = static_cast<LpvBorder>(2); }, "LpvPropagateParams.border is 2; expected 0..1"},
      {[](auto& p) { p.active = true, p.error = 0.6; }, "LpvPropagateParams.error is 0.6; expected 0..0.5"},
      {[](auto& p) { p.error = 0.1; },
       "LpvPropagateParams.error is 0.1; expected 0 without active, whose steps find out what travels"},
      {[](auto& p) { p.active = p.travelling = true; },
       "LpvPropagateParams.travelling is true; expected false with active, whose last step is not known before"},
      {[](auto& p) { p.active = p.energy = true; },
       "LpvPropagateParams.energy is true; expected false with active, which leaves out cells"},
      {[](auto& p) { p.geometry = true, p.geometry_format = Format::unorm8x4; },
       "LpvPropagateParams.geometry_format is unorm8x4; expected f32x4 or f16x4"},
  };
  for (const Refusal& refusal : refusals) {
    LpvPropagateParams p = good;
    refusal.change(p);
    EXPECT_EQ(validate(p).code(), Code::invalid_argument) << refusal.message;
    EXPECT_EQ(validate(p).message(), refusal.message);
    for (const char* device : {"pocl", "lavapipe", "gpu", "reference"})
      EXPECT_EQ(plan(p, profile(device)).status().message(), refusal.message);
  }
}

}  // namespace
}  // namespace luxel

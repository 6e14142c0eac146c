// cone_trace: sets of cones, the recurrence in closed form, equal bits on every execution, refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/volumes.h"
#include "bench/truth/cone_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/storage.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;
using std::numbers::pi;

TEST(ConeSet, HasTheMomentsOfTheCosine) {
  constexpr double solved = 1e-10;  // of the nodes' bisection and two small linear systems
  const int bands[][2] = {{1, 1}, {4, 2}, {5, 2}, {6, 2}, {8, 3}, {9, 3}, {16, 4}, {25, 6}};
  for (const auto [count, exact] : bands) {
    const std::vector<Cone> set = cone_set(count).value();
    ASSERT_EQ(set.size(), static_cast<std::size_t>(count));
    const ConeSetResponse r = cone_set_response(set);
    for (int l = 0; l <= exact; ++l) {
      if (l != 3 && l != 5) {
        EXPECT_NEAR(r.band[l], 1, solved) << count << " cones, band " << l;
      }
      EXPECT_NEAR(r.stray[l], 0, solved) << count << " cones, band " << l;
    }
    for (const Cone& c : set) {
      EXPECT_GT(c.weight, 0);
      // Above the horizon, caps and all.
      EXPECT_LE(std::acos(c.direction[2]) + c.aperture / 2, pi / 2 + 1e-9) << count;
    }
  }
}

TEST(ConeSet, OfSixIsTheOneOnPaper) {
  const std::vector<Cone> set = cone_set(6, pi / 3).value();
  EXPECT_NEAR(set[0].weight, 0.26277, 5e-6);
  EXPECT_NEAR(set[1].weight, 0.14745, 5e-6);
  EXPECT_NEAR(std::acos(set[1].direction[2]) * 180 / pi, 52.209, 5e-4);
  const ConeSetResponse classic = cone_set_response(classic_cones());
  EXPECT_NEAR(classic.band[1], 0.875, 5e-4);
  EXPECT_NEAR(classic.band[2], 0.505, 5e-4);
  // Of (1 + z) / 2 the classic set returns .875 of z: an error of .0625 z, whose root mean square over the sphere is
  // .036; what the higher bands add is less.
  EXPECT_NEAR(cone_set_half_spaces(classic_cones()).rms, 0.0389, 5e-5);
  EXPECT_NEAR(cone_set_half_spaces(set).rms, 0.0066, 5e-5);
}

TEST(ConeSet, RefusesWhatDoesNotExist) {
  EXPECT_EQ(cone_set(7).status().message(), "cone_set count is 7; expected 1, 4, 5, 6, 8, 9, 16 or 25");
  EXPECT_EQ(cone_set(6, 3).status().message(), "cone_set aperture is 3; expected 0..2.6");
  EXPECT_FALSE(cone_set(6, 2.2));  // below the horizon
  EXPECT_FALSE(cone_set(6, std::nan("")));
}

TEST(SpecularAperture, GrowsWithRoughness) {
  EXPECT_NEAR(specular_aperture(0), 0, 1e-6);
  for (int i = 1; i <= 60; ++i) EXPECT_GT(specular_aperture(i / 64.0), specular_aperture((i - 1) / 64.0));
  EXPECT_EQ(specular_aperture(1), 2.6);
}

// A homogeneous medium: every cone's way out of the box has a closed form, whatever the steps.
TEST(ConeTrace, AHomogeneousMediumHasItsClosedForm) {
  constexpr int n = 16;
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (const double a : {1e-7, 1e-4, 0.02, 0.3, 0.9}) {
    ConeTraceParams p = cone_params(n);
    p.cones = {{{0, 0, 1}, 1, 0.5}};
    p.normal_offset = 0;
    Values receivers;
    add_receiver(receivers, {0.5, 0.5, 0.25}, {0, 0, 1});
    const double stored = static_cast<float>(a);
    const double hidden = -std::expm1(12 * std::log1p(-stored));
    for (const std::string& device : devices) {
      Context& context = test_context(device);
      const auto r = trace(context, p, uniform_volume(n, {3 * stored, 2 * stored, stored, stored}), receivers);
      ASSERT_TRUE(r) << r.status().message();
      // Two roundings of f32 for each of some 20 steps; in double the series of log and exp stop at 1e-10.
      const double bound = context.real64() ? 1e-9 : 40 * 0x1p-24;
      EXPECT_NEAR(r.value().irradiance[3], 1 - hidden, bound) << device << " " << a;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(r.value().irradiance[c] / (pi * (3 - c) * hidden), 1, bound) << device << " " << a;
    }
  }
}

std::vector<ConeTraceParams> variants() {
  std::vector<ConeTraceParams> all;
  for (const Format f : {Format::f32x4, Format::f16x4, Format::unorm8x4})
    for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
      ConeTraceParams p = cone_params(16, v, f);
      p.width = 13;
      p.height = 11;
      p.gamma = 2;
      p.environment = {0.25, 0.5, 1};
      p.origin = {-0.25, 0.5, 0};
      all.push_back(p);
      p.extent = {13, 9, 21};
      p.step_scale = 1;
      p.skip_empty = false;
      p.cones = cone_set(9).value();
      p.pattern_x = 3;
      p.error = 0.01;
      all.push_back(p);
    }
  return all;
}

Values room_for(const ConeTraceParams& p) {
  const Values room = scene::voxel_room(32);
  Values values;
  for (int z = 0; z < p.extent[2]; ++z)
    for (int y = 0; y < p.extent[1]; ++y)
      for (int x = 0; x < p.extent[0]; ++x) {
        const int at = ((z * 32 / p.extent[2]) * 32 + y * 32 / p.extent[1]) * 32 + x * 32 / p.extent[0];
        values.insert(values.end(), room.begin() + at * 4, room.begin() + at * 4 + 4);
      }
  return quantise(values, p.format);
}

TEST(ConeTrace, EveryDeviceGivesTheSameBits) {
  for (const ConeTraceParams& p : variants()) {
    const Values room = room_for(p), receivers = cone_receivers(p, p.width * p.height, 7);
    const auto cpu = trace(test_context("cpu"), p, room, receivers);
    ASSERT_TRUE(cpu) << cpu.status().message();
    for (const std::string& device : test_devices()) {
      const auto r = trace(test_context(device), p, room, receivers);
      ASSERT_TRUE(r) << device << ": " << r.status().message();
      EXPECT_EQ(count_different(r.value().irradiance, cpu.value().irradiance), 0)
          << device << " " << name(p.format) << " " << static_cast<int>(p.variant);
      for (const std::string& message : test_context(device).validation_messages()) ADD_FAILURE() << message;
    }
  }
}

TEST(ConeTrace, FloatIsNearDouble) {
  for (const ConeTraceParams& p : variants()) {
    if (p.format != Format::f32x4) continue;
    const Values room = room_for(p), receivers = cone_receivers(p, p.width * p.height, 7);
    const auto f = trace(test_context("cpu"), p, room, receivers), d = trace(test_context("cpu:double"), p, room, receivers);
    ASSERT_TRUE(f && d);
    // (1-a)^k of half a voxel, k = 1/2, has an infinite slope at a = 1: there half a step of a, 2^-25, becomes its root,
    // 1.7e-4, of a cone's light. Elsewhere some 400 roundings add up to less.
    EXPECT_LE(max_difference(f.value().irradiance, d.value().irradiance), 2 * std::sqrt(0x1p-25));
  }
}

TEST(ConeTrace, RefusesWhatIsOutOfRange) {
  ConeTraceParams p = cone_params(16);
  EXPECT_TRUE(validate(p).ok());
  p.step_scale = 0.01;
  EXPECT_EQ(validate(p).message(), "ConeTraceParams.step_scale is 0.01; expected 0.0625..4");
  p = cone_params(16);
  p.extent[1] = 0;
  EXPECT_EQ(validate(p).message(), "ConeTraceParams.extent[1] is 0; expected 1..2048");
  p = cone_params(16);
  p.levels = 6;
  EXPECT_EQ(validate(p).message(), "ConeTraceParams.levels is 6; expected 0..5");
  p = cone_params(16);
  p.cones = {{{0, 0, 0}, 1, 1}};
  EXPECT_FALSE(validate(p).ok());
  p.cones = {{{0, 0, 1}, 1, 3}};
  EXPECT_EQ(validate(p).message(), "ConeTraceParams.cones[0].aperture is 3; expected 0..2.6");
  p = cone_params(16);
  p.voxel = std::nan("");
  EXPECT_FALSE(validate(p).ok());
  p = cone_params(16);
  p.radiance = p.occlusion = false;
  EXPECT_FALSE(validate(p).ok());
}

}  // namespace
}  // namespace luxel

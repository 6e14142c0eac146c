// probe_shade: the formula written out, the examples on paper, equal bits on every execution, scale, refusals.
#include <luxel/probe_shade.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/storage.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;

struct Maps {
  Values light, moments, positions;
  truth::ProbeScene scene() const { return {light, moments, positions}; }
};

// Moments such that most receivers are seen by some of their probes only.
Maps random_maps(const ProbeShadeParams& p, std::uint32_t seed, int dead = 5) {
  Maps m;
  const std::size_t probes = probe_count(p.grid);
  const auto random = [&](std::size_t i, std::uint32_t s) { return scene::random01(static_cast<std::uint32_t>(i), s); };
  for (std::size_t i = 0; i < 4 * probe_map_texels(probes, p.irradiance_size); ++i) m.light.push_back(2 * random(i, seed));
  for (std::size_t i = 0; i < probe_map_texels(probes, p.moments_size); ++i) {
    m.moments.push_back(0.1 + 0.9 * random(i, seed + 1));
    m.moments.push_back(0.2 * random(i, seed + 2) * random(i, seed + 3));
  }
  const bool half = p.irradiance_format == Format::f16x4;
  m.light = quantise(m.light, half ? Format::f16x4 : Format::f32x4);
  m.moments = quantise(m.moments, half ? Format::f16x2 : Format::f32x2);
  m.positions = probe_positions(p.grid, 0.3, dead, seed + 4);
  return m;
}

struct Form {
  std::string name;
  std::function<void(ProbeShadeParams&)> change;
};

const Form forms[] = {{"as it is", [](ProbeShadeParams&) {}},
                      {"placed", [](ProbeShadeParams& p) { p.grid.placed = true; }},
                      {"plain", [](ProbeShadeParams& p) { p.visibility = false; }},
                      {"plain, placed", [](ProbeShadeParams& p) { p.visibility = false, p.grid.placed = true; }},
                      {"all alike", [](ProbeShadeParams& p) { p.facing = ProbeFacing::all, p.sharpen = 1; }},
                      {"cosine, dark", [](ProbeShadeParams& p) { p.facing = ProbeFacing::cosine, p.hidden = ProbeHidden::dark, p.sharpen = 8; }},
                      {"in a row", [](ProbeShadeParams& p) { p.grid.count = {1, 5, 1}; }}};

ProbeShadeParams shade_params(bool half = false) {
  ProbeShadeParams p = probe_set_up({3, 2, 4}, half).shade;
  p.moments_size = 10;
  p.width = 25;
  p.height = 16;
  return p;
}

TEST(ProbeShade, EveryDeviceGivesTheSameBits) {
  for (const Form& form : forms)
    for (const bool half : {false, true})
      for (const bool count : {false, true}) {
        ProbeShadeParams p = shade_params(half);
        form.change(p);
        p.count = count;
        const Maps maps = random_maps(p, 23);
        const Values receivers = random_receivers(p.grid, 400, 29);
        const auto expected = shade(test_context("cpu"), p, maps.scene(), receivers);
        ASSERT_TRUE(expected) << expected.status().message();
        for (const std::string& device : test_devices()) {
          const auto r = shade(test_context(device), p, maps.scene(), receivers);
          ASSERT_TRUE(r) << device << ": " << r.status().message();
          EXPECT_EQ(count_different(r.value().irradiance, expected.value().irradiance), 0) << device << " " << form.name;
          EXPECT_EQ(count_different(r.value().counters, expected.value().counters), 0) << device << " " << form.name;
        }
      }
}

// The double execution against the formula, and float against double. Where a receiver is nearly hidden, its light is the
// quotient of two small sums, whose visibilities carry the rounding of r - mean.
TEST(ProbeShade, TheFormulaWrittenOut) {
  for (const Form& form : forms) {
    ProbeShadeParams p = shade_params();
    form.change(p);
    const Maps maps = random_maps(p, 31);
    const Values receivers = random_receivers(p.grid, 400, 37);
    const auto exact = shade(test_context("cpu:double"), p, maps.scene(), receivers), single = shade(test_context("cpu"), p, maps.scene(), receivers);
    ASSERT_TRUE(exact && single);
    const Values formula = truth::probe_shade_all(p, maps.scene(), receivers);
    EXPECT_LE(max_difference(exact.value().irradiance, formula), 1e-11) << form.name;
    EXPECT_LE(max_difference(exact.value().irradiance, single.value().irradiance), 2e-5) << form.name;
    double different = 0;
    for (std::size_t i = 3; i < formula.size(); i += 4) different += p.visibility && formula[i] < 0.9;
    if (p.visibility) {
      EXPECT_GT(different, 60) << form.name;
    }
  }
}

// Half of what a probe sees is at 1, half at 3; a receiver at 3.05 is hidden from it, but Chebyshev's bound is 1 / (1 + 1.05^2)
// = .476. Beside it stands a probe that sees it.
TEST(ProbeShade, ChebyshevsBoundIsAnUpperOne) {
  ProbeShadeParams p = probe_set_up({2, 1, 1}).shade;
  p.grid.origin = {0, 0, 0};
  p.grid.spacing = {6.1, 1, 1};
  p.facing = ProbeFacing::all;
  p.normal_bias = 0;
  p.footprint = 0;
  p.sharpen = 1;
  p.width = 1;
  const double unit = probe_unit(p.grid);
  Values light = even_map(2, 8, {0, 0, 0, 1}), moments = even_map(2, 8, {2 / unit, 1 / unit});
  for (std::size_t i = 0; i < light.size() / 2; i += 4) light[i] = 1;                                       // the first sends 1
  for (std::size_t i = moments.size() / 2; i < moments.size(); i += 2) moments[i] = 4 / unit, moments[i + 1] = 0;  // the second sees far
  Values receivers;
  add_probe_receiver(receivers, {3.05, 0, 0}, {0, 1, 0});
  const double bound = 1 / (1 + 1.05 * 1.05);
  EXPECT_NEAR(bound, 0.4756, 1e-4);
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (const std::string& device : devices) {
    const auto r = shade(test_context(device), p, {light, moments, {}}, receivers);
    ASSERT_TRUE(r) << r.status().message();
    EXPECT_NEAR(r.value().irradiance[0], bound / (1 + bound), 1e-6) << device;
    EXPECT_NEAR(r.value().irradiance[3], (1 + bound) / 2, 1e-6) << device;
  }
}

// Maps hold distances in diagonals of a cage, biases are parts of a spacing: powers of two change no bit.
TEST(ProbeShade, ScenesOfAnyScaleLookTheSame) {
  const ProbeShadeParams p = shade_params(true);
  const Maps maps = random_maps(p, 41);
  const Values receivers = random_receivers(p.grid, 400, 43);
  for (const std::string& device : test_devices()) {
    const auto here = shade(test_context(device), p, maps.scene(), receivers);
    ASSERT_TRUE(here);
    for (const double scale : {0x1p-20, 1e-3, 1e4, 0x1p30}) {
      ProbeShadeParams q = p;
      for (std::size_t k = 0; k < 3; ++k) q.grid.origin[k] *= scale, q.grid.spacing[k] *= scale;
      Values scaled = receivers;
      for (std::size_t i = 0; i < scaled.size(); ++i)
        if (i % 8 < 3) scaled[i] = static_cast<float>(scaled[i] * scale);
      const auto there = shade(test_context(device), q, maps.scene(), scaled);
      ASSERT_TRUE(there);
      const bool exact = std::exp2(std::round(std::log2(scale))) == scale;
      EXPECT_LE(max_difference(here.value().irradiance, there.value().irradiance), exact ? 0 : 2e-5) << device << " " << scale;
    }
  }
}

struct Refusal {
  std::function<void(ProbeShadeParams&)> change;
  const char* message;
};

TEST(ProbeShade, RefusesWhatItCannotDo) {
  const Refusal refusals[] = {
      {[](auto& p) { p.grid.spacing[1] = 0; }, "ProbeGrid.spacing is 0; expected 1e-15..1e+15"},
      {[](auto& p) { p.grid.count = {64, 64, 16}; }, "ProbeShadeParams.grid.count is 65536; expected at most 65535 probes"},
      {[](auto& p) { p.width = 0; }, "ProbeShadeParams.width is 0; expected 1..1048576"},
      {[](auto& p) { p.height = 65536; }, "ProbeShadeParams.height is 65536; expected 1..65535"},
      {[](auto& p) { p.width = 1 << 20, p.height = 1000; }, "ProbeShadeParams.height is 1000; expected width x height of at most 268435456"},
      {[](auto& p) { p.irradiance_size = 2; }, "ProbeShadeParams.irradiance_size is 2; expected 4..128"},
      {[](auto& p) { p.moments_size = 200; }, "ProbeShadeParams.moments_size is 200; expected 4..128"},
      {[](auto& p) { p.irradiance_format = Format::unorm8x4; }, "ProbeShadeParams.irradiance_format is unorm8x4; expected f32x4 or f16x4"},
      {[](auto& p) { p.sharpen = 9; }, "ProbeShadeParams.sharpen is 9; expected 1..8"},
      {[](auto& p) { p.least_visibility = 0; }, "ProbeShadeParams.least_visibility is 0; expected 1e-06..1"},
      {[](auto& p) { p.footprint = -1; }, "ProbeShadeParams.footprint is -1; expected 0..8"},
      {[](auto& p) { p.least_facing = std::nan(""); }, "ProbeShadeParams.least_facing is nan; expected 0..1"},
      {[](auto& p) { p.normal_bias = 2; }, "ProbeShadeParams.normal_bias is 2; expected 0..1"},
  };
  for (const Refusal& refusal : refusals) {
    ProbeShadeParams p = shade_params();
    ASSERT_TRUE(validate(p)) << validate(p).message();
    refusal.change(p);
    EXPECT_EQ(validate(p).message(), refusal.message);
    for (const std::string& device : test_devices()) EXPECT_EQ(plan(p, test_context(device).profile()).status().message(), refusal.message);
  }
}

}  // namespace
}  // namespace luxel

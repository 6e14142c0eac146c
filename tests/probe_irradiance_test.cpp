// probe_irradiance: closed forms, quadrature, equal bits on every execution, borders, lists, what came before, refusals.
#include <luxel/probe_irradiance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/storage.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;
using Vec = std::array<double, 3>;
constexpr double pi = std::numbers::pi;

double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// One probe, nothing but what is asked for.
ProbeIrradianceParams one_probe(int size, int made) {
  ProbeIrradianceParams p = probe_set_up({1, 1, 1}).filter;
  p.maps.size = size;
  p.samples = std::min(size, 64);
  p.irradiance_size = p.moments_size = made;
  return p;
}

std::size_t texel_at(int x, int y, int size) {
  return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(size + 2) + static_cast<std::size_t>(x + 1);
}

Vec direction_of(int x, int y, int size) { return truth::octahedral_direction((2.0 * x + 1) / size - 1, (2.0 * y + 1) / size - 1); }

// Radiance of directions, as its mean over each texel.
Values map_of(int size, const truth::Radiance& radiance) {
  Values map(static_cast<std::size_t>(4 * size * size), 0), all(map.size() / 4, 0);
  truth::over_sphere(size, 8, [&](int texel, const Vec& d, double solid) {
    const auto i = static_cast<std::size_t>(texel);
    const Vec l = radiance(d);
    for (std::size_t c = 0; c < 3; ++c) map[4 * i + c] += l[c] * solid;
    all[i] += solid;
  });
  for (std::size_t i = 0; i < map.size(); ++i) map[i] /= all[i / 4];
  return map;
}

// L = 1, a d, (b d)^2: pi, 2/3 pi a n, pi/4 (b b + (b n)^2).
TEST(ProbeIrradiance, ClosedFormsOfTheFirstThreeBands) {
  const Vec a{0.2, -0.7, 0.4}, b{0.5, 0.1, -0.9};
  double before = 0;
  for (const int size : {16, 32, 64}) {
    const ProbeIrradianceParams p = one_probe(size, 8);
    const Values map = map_of(size, [&](const Vec& d) { return Vec{1, inner(a, d), inner(b, d) * inner(b, d)}; });
    const auto r = filter(test_context("cpu:double"), p, {map, Values(map.size() / 4, 1.0)});
    ASSERT_TRUE(r) << r.status().message();
    double most = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        const Vec n = direction_of(x, y, 8);
        const double* e = &r.value().irradiance[4 * texel_at(x, y, 8)];
        EXPECT_NEAR(e[0], pi, 1e-12);
        most = std::max({most, std::fabs(e[1] - 2 * pi / 3 * inner(a, n)), std::fabs(e[2] - pi / 4 * (inner(b, b) + inner(b, n) * inner(b, n)))});
      }
    // Texels across the horizon: the error falls with their area.
    EXPECT_LE(most, 3.9 / size / size) << size;
    if (before > 0) {
      EXPECT_LE(most, before / 2.8) << size;
    }
    before = most;
  }
}

// Weights and averages written out, their areas by quadrature of 128 points a cell and axis, good to 1e-6: the tables and solid
// angles are exact.
TEST(ProbeIrradiance, WeightsAreTheTexelsExactAreas) {
  ProbeIrradianceParams p = one_probe(64, 8);
  p.samples = 8;
  const ProbeSeen seen = random_probes(p, 3);
  const auto r = filter(test_context("cpu:double"), p, seen);
  ASSERT_TRUE(r) << r.status().message();
  constexpr int cells = 64;
  std::vector<Vec> mean(cells, Vec{}), area(cells, Vec{});
  std::vector<double> solid(cells, 0), distance(cells, 0), squares(cells, 0);
  const double unit = probe_unit(p.grid);
  const auto cell = [](int texel) { return static_cast<std::size_t>(texel / 64 / 8 * 8 + texel % 64 / 8); };
  const auto far = [&](int texel) { return std::min(seen.distance[static_cast<std::size_t>(texel)] / unit, p.max_distance); };
  truth::over_sphere(64, 16, [&](int texel, const Vec& d, double w) {
    const std::size_t k = cell(texel);
    solid[k] += w;
    distance[k] += w * far(texel);
    for (std::size_t c = 0; c < 3; ++c) {
      area[k][c] += w * d[c];
      mean[k][c] += w * seen.radiance[4 * static_cast<std::size_t>(texel) + c];
    }
  });
  truth::over_sphere(64, 16, [&](int texel, const Vec&, double w) {
    const std::size_t k = cell(texel);
    squares[k] += w * std::pow(far(texel) - distance[k] / solid[k], 2);
  });
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Vec n = direction_of(x, y, 8);
      Vec e{};
      double all = 0, lobe = 0, mu = 0, second = 0;
      for (std::size_t k = 0; k < cells; ++k) {
        const double w = std::max(0.0, inner(n, area[k])), size = std::sqrt(inner(area[k], area[k]));
        all += w;
        for (std::size_t c = 0; c < 3; ++c) e[c] += w * mean[k][c] / solid[k];
        const double v = size * std::pow(w / size, p.power);
        lobe += v;
        mu += v * distance[k] / solid[k];
      }
      mu /= lobe;
      for (std::size_t k = 0; k < cells; ++k) {
        const double w = std::max(0.0, inner(n, area[k])), size = std::sqrt(inner(area[k], area[k]));
        second += size * std::pow(w / size, p.power) * (squares[k] / solid[k] + std::pow(distance[k] / solid[k] - mu, 2));
      }
      const std::size_t at = texel_at(x, y, 8);
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(r.value().irradiance[4 * at + c], pi * e[c] / all, 4e-6);
      EXPECT_NEAR(r.value().moments[2 * at], mu, 2e-5);
      EXPECT_NEAR(r.value().moments[2 * at + 1], std::sqrt(second / lobe), 2e-5);
    }
}

// Against quadrature that cuts texels at the horizon: a map of noise, the worst there is.
TEST(ProbeIrradiance, NoiseAgreesWithQuadrature) {
  ProbeIrradianceParams p = one_probe(32, 8);
  const ProbeSeen seen = random_probes(p, 5);
  const auto r = filter(test_context("cpu:double"), p, seen);
  ASSERT_TRUE(r) << r.status().message();
  double worst = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const Vec n = direction_of(x, y, 8);
      const Vec e = truth::probe_irradiance(32, seen.radiance, n);
      const auto m = truth::probe_moments(p, seen.distance, n);
      const std::size_t at = texel_at(x, y, 8);
      for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::fabs(r.value().irradiance[4 * at + c] / e[c] - 1));
      EXPECT_NEAR(r.value().moments[2 * at], m[0], 0.03);
      EXPECT_NEAR(r.value().moments[2 * at + 1], m[1], 0.03);
    }
  EXPECT_LE(worst, 4e-3);
  EXPECT_GT(worst, 1e-6);
}

struct Form {
  std::string name;
  std::function<void(ProbeIrradianceParams&)> change;
};

TEST(ProbeIrradiance, EveryDeviceGivesTheSameBits) {
  const Form forms[] = {{"f32", [](ProbeIrradianceParams&) {}},
                        {"halves", [](ProbeIrradianceParams& p) { p.maps.radiance = ProbeRadiance::f16x4, p.maps.distance = ProbeDistance::f16, p.irradiance_format = Format::f16x4, p.moments_format = Format::f16x2; }},
                        {"packed", [](ProbeIrradianceParams& p) { p.maps.radiance = ProbeRadiance::r11g11b10, p.maps.distance = ProbeDistance::f16; }},
                        {"irradiance alone", [](ProbeIrradianceParams& p) { p.moments_size = 0, p.irradiance_size = 11; }},
                        {"moments alone", [](ProbeIrradianceParams& p) { p.irradiance_size = 0, p.power = 5; }},
                        {"averaged", [](ProbeIrradianceParams& p) { p.samples = 4; }}};
  for (const Form& form : forms)
    for (const bool listed : {false, true})
      for (const bool previous : {false, true}) {
        ProbeIrradianceParams p = probe_set_up({2, 1, 2}).filter;
        form.change(p);
        p.listed = listed ? 2 : 0;
        p.previous = previous;
        p.hysteresis = 0.75;
        ProbeSeen seen = random_probes(p, 7);
        if (p.maps.radiance == ProbeRadiance::f16x4) seen.radiance = quantise(seen.radiance, Format::f16x4);
        if (p.maps.distance == ProbeDistance::f16) {
          for (double& d : seen.distance) d = std::min(d / probe_unit(p.grid), 65504.0);
          seen.distance = pack_f16(seen.distance);
        }
        if (p.maps.radiance == ProbeRadiance::r11g11b10) seen.radiance = pack_r11g11b10(seen.radiance);
        ProbeFiltered before;
        if (previous) {
          before.irradiance = scene::noise(static_cast<int>(4 * probe_map_texels(4, p.irradiance_size)), 1, 1, 8);
          before.moments = scene::noise(static_cast<int>(2 * probe_map_texels(4, p.moments_size)), 1, 1, 9);
          before.irradiance = quantise(before.irradiance, Format::f16x4);
          before.moments = quantise(before.moments, Format::f16x2);
        }
        const auto expected = filter(test_context("cpu"), p, seen, {3, 1}, before);
        ASSERT_TRUE(expected) << expected.status().message();
        for (const std::string& device : test_devices()) {
          const auto r = filter(test_context(device), p, seen, {3, 1}, before);
          ASSERT_TRUE(r) << device << " " << form.name << ": " << r.status().message();
          EXPECT_EQ(count_different(r.value().irradiance, expected.value().irradiance), 0) << device << " " << form.name << listed << previous;
          EXPECT_EQ(count_different(r.value().moments, expected.value().moments), 0) << device << " " << form.name << listed << previous;
        }
        // Float against double: sums of 256 weights.
        ProbeIrradianceParams wide = p;
        wide.irradiance_format = Format::f32x4, wide.moments_format = Format::f32x2;
        const auto single = filter(test_context("cpu"), wide, seen, {3, 1}, before), exact = filter(test_context("cpu:double"), wide, seen, {3, 1}, before);
        ASSERT_TRUE(single && exact);
        if (p.irradiance_size > 0) {
          EXPECT_LE(max_difference(single.value().irradiance, exact.value().irradiance), 8e-6) << form.name;
        }
        if (p.moments_size > 0) {
          EXPECT_LE(max_difference(single.value().moments, exact.value().moments), 4e-6) << form.name;
        }
      }
}

TEST(ProbeIrradiance, PackedFormatsAreReadAsTheValuesTheyStandFor) {
  ProbeIrradianceParams p = probe_set_up({2, 1, 2}).filter;
  ProbeSeen seen = random_probes(p, 17);
  for (double& d : seen.distance) d = std::min(d / probe_unit(p.grid), 65504.0);
  const Values words = pack_r11g11b10(seen.radiance), halves = pack_f16(seen.distance);
  ProbeIrradianceParams packed = p;
  packed.maps.radiance = ProbeRadiance::r11g11b10;
  packed.maps.distance = ProbeDistance::f16;
  ProbeSeen plain{unpack_r11g11b10(words), quantise(seen.distance, Format::f16x2)};
  for (double& d : plain.distance) d *= probe_unit(p.grid);
  for (const std::string& device : test_devices()) {
    const auto a = filter(test_context(device), packed, {words, halves}), b = filter(test_context(device), p, plain);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(count_different(a.value().irradiance, b.value().irradiance), 0) << device;
    EXPECT_LE(max_difference(a.value().moments, b.value().moments), 1e-6) << device;  // times the diagonal and back
  }
}

// Each border texel holds the texel that lies across the edge, and the map between is what a map of the same size has.
TEST(ProbeIrradiance, BordersHoldWhatLiesAcrossTheEdge) {
  for (const int size : {4, 7, 8}) {
    ProbeIrradianceParams p = probe_set_up({2, 1, 1}).filter;
    p.irradiance_size = p.moments_size = size;
    for (const std::string& device : test_devices()) {
      const auto r = filter(test_context(device), p, random_probes(p, 11));
      ASSERT_TRUE(r) << r.status().message();
      for (std::size_t probe = 0; probe < 2; ++probe)
        for (int y = -1; y <= size; ++y)
          for (int x = -1; x <= size; ++x) {
            int u = x, v = y;
            if (x < 0 || x == size) u = x < 0 ? 0 : size - 1, v = size - 1 - v;
            if (v < 0 || v >= size) v = v < 0 ? 0 : size - 1, u = size - 1 - u;
            const std::size_t first = probe * probe_map_texels(1, size), a = first + texel_at(x, y, size), b = first + texel_at(u, v, size);
            for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(r.value().irradiance[4 * a + c], r.value().irradiance[4 * b + c]) << x << " " << y;
            for (std::size_t c = 0; c < 2; ++c) EXPECT_EQ(r.value().moments[2 * a + c], r.value().moments[2 * b + c]) << x << " " << y;
            EXPECT_NE(r.value().irradiance[4 * a], 7) << "not written: " << x << " " << y;
          }
    }
  }
}

TEST(ProbeIrradiance, ProbesThatAreNotListedStayAsTheyAre) {
  ProbeIrradianceParams p = probe_set_up({2, 1, 2}).filter;
  const ProbeSeen seen = random_probes(p, 13);
  for (const std::string& device : test_devices()) {
    const auto all = filter(test_context(device), p, seen);
    ProbeIrradianceParams some = p;
    some.listed = 2;
    const auto r = filter(test_context(device), some, seen, {2, 0});
    ASSERT_TRUE(all && r);
    const std::size_t each = 4 * probe_map_texels(1, 8);
    for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
      EXPECT_EQ(r.value().irradiance[i], i / each % 2 == 0 ? all.value().irradiance[i] : 7);
    for (std::size_t i = 0; i < r.value().moments.size(); ++i)
      EXPECT_EQ(r.value().moments[i], i / (each / 2) % 2 == 0 ? all.value().moments[i] : 7);
  }
}

// new = h old + (1 - h) fresh, and of distances the mixture.
TEST(ProbeIrradiance, WhatCameBeforeIsMixedIn) {
  ProbeIrradianceParams p = one_probe(16, 8);
  p.hysteresis = 0.6;
  const ProbeSeen seen = random_probes(p, 19);
  Context& context = test_context("cpu:double");
  const auto fresh = filter(context, p, seen);
  p.previous = true;
  ProbeFiltered before{even_map(1, 8, {1, 2, 3, 1}), even_map(1, 8, {0.75, 0.25})};
  before.irradiance[4 * texel_at(2, 2, 8) + 1] = std::nan("");
  before.moments[2 * texel_at(3, 2, 8) + 1] = HUGE_VAL;
  const auto mixed = filter(context, p, seen, {}, before);
  ASSERT_TRUE(fresh && mixed);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const std::size_t at = texel_at(x, y, 8);
      for (std::size_t c = 0; c < 3; ++c) {
        const double f = fresh.value().irradiance[4 * at + c], h = x == 2 && y == 2 ? 0 : 0.6;
        EXPECT_NEAR(mixed.value().irradiance[4 * at + c], h == 0 ? f : h * static_cast<double>(c + 1) + (1 - h) * f, 1e-13);
      }
      const double mu = fresh.value().moments[2 * at], sigma = fresh.value().moments[2 * at + 1], h = x == 3 && y == 2 ? 0 : 0.6;
      const double mean = h * 0.75 + (1 - h) * mu;
      const double variance = h * (0.0625 + std::pow(0.75 - mean, 2)) + (1 - h) * (sigma * sigma + std::pow(mu - mean, 2));
      EXPECT_NEAR(mixed.value().moments[2 * at], mean, 1e-13);
      EXPECT_NEAR(mixed.value().moments[2 * at + 1], std::sqrt(variance), 1e-13);
    }
}

// What the mixture is for: distances about 1000 that differ by 1/100. E[r^2] - E[r]^2 in f32 is off by the variance or more
// (the rounding of 10^6), and r^2 in halves is infinite from 256 on.
TEST(ProbeIrradiance, DifferencesOfSquaresWouldFail) {
  ProbeIrradianceParams p = one_probe(16, 4);
  p.irradiance_size = 0;
  p.grid.spacing = {1000, 1000, 1000};
  Values distance;
  for (std::size_t i = 0; i < 256; ++i) distance.push_back(static_cast<float>(1000 + ((i ^ (i >> 4)) % 2 == 0 ? 0.01 : -0.01)));
  float mean = 0, squares = 0;
  for (const double d : distance) mean += static_cast<float>(d) / 256, squares += static_cast<float>(d) * static_cast<float>(d) / 256;
  EXPECT_GE(std::fabs(squares - mean * mean - 1e-4f), 0.99e-4f);  // all of it is lost, or more
  EXPECT_EQ(quantise(std::vector<double>{256.0 * 256}, Format::f16x2)[0], 65504);  // r^2: no room
  for (const std::string& device : test_devices()) {
    const auto r = filter(test_context(device), p, {{}, distance});
    ASSERT_TRUE(r) << r.status().message();
    for (std::size_t i = 1; i < r.value().moments.size(); i += 2) EXPECT_NEAR(r.value().moments[i] * probe_unit(p.grid), 0.01, 0.002) << device;
  }
}

struct Refusal {
  std::function<void(ProbeIrradianceParams&)> change;
  const char* message;
};

TEST(ProbeIrradiance, RefusesWhatItCannotDo) {
  const Refusal refusals[] = {
      {[](auto& p) { p.grid.count[0] = 0; }, "ProbeGrid.count is 0; expected 1..1024"},
      {[](auto& p) { p.grid.count = {64, 64, 16}; }, "ProbeIrradianceParams.grid.count is 65536; expected at most 65535 probes"},
      {[](auto& p) { p.maps.size = 17; }, "ProbeMaps.size is 17; expected an even number"},
      {[](auto& p) { p.listed = 5; }, "ProbeIrradianceParams.listed is 5; expected 0..4"},
      {[](auto& p) { p.samples = 6; }, "ProbeIrradianceParams.samples is 6; expected an even divisor of the maps' size, 4..64"},
      {[](auto& p) { p.maps.size = 128, p.samples = 128; }, "ProbeIrradianceParams.samples is 128; expected an even divisor of the maps' size, 4..64"},
      {[](auto& p) { p.maps.size = 2 * 37; }, "ProbeIrradianceParams.maps.size is 74; expected a size with an even divisor in 4..32"},
      {[](auto& p) { p.irradiance_size = 129; }, "ProbeIrradianceParams.irradiance_size is 129; expected 0..128"},
      {[](auto& p) { p.moments_size = 3; }, "ProbeIrradianceParams.moments_size is 3; expected 0 or 4..128"},
      {[](auto& p) { p.irradiance_size = p.moments_size = 0; }, "ProbeIrradianceParams.irradiance_size is 0; expected 4..128 without moments"},
      {[](auto& p) { p.power = 0; }, "ProbeIrradianceParams.power is 0; expected 1..256"},
      {[](auto& p) { p.max_distance = std::nan(""); }, "ProbeIrradianceParams.max_distance is nan; expected 1e-06..65504"},
      {[](auto& p) { p.hysteresis = 1.5; }, "ProbeIrradianceParams.hysteresis is 1.5; expected 0..1"},
      {[](auto& p) { p.irradiance_format = Format::f32x2; }, "ProbeIrradianceParams.irradiance_format is f32x2; expected f32x4 or f16x4"},
      {[](auto& p) { p.moments_format = Format::f32x4; }, "ProbeIrradianceParams.moments_format is f32x4; expected f32x2 or f16x2"},
  };
  for (const Refusal& refusal : refusals) {
    ProbeIrradianceParams p = probe_set_up({2, 1, 2}).filter;
    ASSERT_TRUE(validate(p)) << validate(p).message();
    refusal.change(p);
    EXPECT_EQ(validate(p).message(), refusal.message);
    for (const std::string& device : test_devices()) EXPECT_EQ(plan(p, test_context(device).profile()).status().message(), refusal.message);
  }
}

}  // namespace
}  // namespace luxel

// The octahedral map, and directions and colours in bits, on every execution.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <luxel/octahedral_map.h>

#include "bench/scene/images.h"
#include "bench/truth/probe_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::HeldPlan;
using cases::Values;
using Vec = truth::Vec3;

Vec anywhere(int i, std::uint32_t seed) {
  const auto u = [&](int k) { return scene::random01(static_cast<std::uint32_t>(2 * i + k), seed); };
  const double z = 2 * u(0) - 1, a = 2 * M_PI * u(1), s = std::sqrt(1 - z * z);
  return {s * std::cos(a), s * std::sin(a), z};
}

struct Coded {
  Values codes, places, values;
};

Result<Coded> code(Context& context, const Values& values, OctahedralCode which) {
  OctahedralMapParams p;
  p.count = static_cast<int>(values.size() / 4);
  p.code = which;
  Coded c;
  auto encode = HeldPlan::make(context, plan(p, context.profile()));
  if (!encode) return encode.status();
  if (Status s = encode.value().write("values", values); !s) return s;
  if (Status s = encode.value().go(); !s) return s;
  c.codes = encode.value().read("codes").value();
  c.places = encode.value().read("places").value();
  p.decode = true;
  auto decode = HeldPlan::make(context, plan(p, context.profile()), {{"codes", encode.value().memory("codes")}});
  if (!decode) return decode.status();
  if (Status s = decode.value().go(); !s) return s;
  c.values = decode.value().read("values").value();
  return c;
}

double degrees(const Vec& a, const double* b) {
  const Vec c{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return std::atan2(std::sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / M_PI;
}

std::vector<std::string> everywhere() {
  auto all = test_devices();
  all.push_back("cpu:double");
  return all;
}

// Cigolle et al. 2014, table 1: 16 bits .33709 degrees on average and .94424 at most, 32 bits .00131 and .00365. The most
// is a sample's: half a step along both coordinates at the middle of a face of the octahedron turns a direction by
// sqrt(18) / 254 = .9571 degrees, and by sqrt(18) / 65534 = .0037091.
TEST(OctahedralMap, DirectionsInBitsAreAsFarOffAsPublished) {
  Values values;
  std::vector<Vec> directions;
  for (int i = 0; i < 60000; ++i) {
    const Vec d = anywhere(i, 3);
    directions.push_back(d);
    for (const double v : {d[0], d[1], d[2], 0.0}) values.push_back(static_cast<float>(v));
  }
  for (const auto& [which, most, mean] : {std::tuple{OctahedralCode::snorm8, 0.9571, 0.3375}, {OctahedralCode::snorm16, 0.003715, 0.00132}})
    for (const std::string& device : everywhere()) {
      const auto c = code(test_context(device), values, which);
      ASSERT_TRUE(c.ok()) << c.status().message();
      double largest = 0, sum = 0;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const double e = degrees(directions[i], &c.value().values[4 * i]);
        if (!(e <= largest)) largest = e;
        sum += e;
      }
      EXPECT_LE(largest, most) << device;
      EXPECT_GE(largest, 0.9 * most) << device;  // no better than such codes can be: they were used
      EXPECT_LE(sum / static_cast<double>(directions.size()), mean) << device;
    }
}

TEST(OctahedralMap, CodesHaveTheSameBitsEverywhere) {
  Values values;
  for (int i = 0; i < 20000; ++i) {
    const Vec d = anywhere(i, 5);
    const double scale = std::exp2(30 * scene::random01(static_cast<std::uint32_t>(i), 6) - 15);
    for (const double v : {d[0] * scale, d[1] * scale, d[2] * scale, 0.0}) values.push_back(static_cast<float>(v));
  }
  for (const OctahedralCode which : {OctahedralCode::snorm8, OctahedralCode::snorm16, OctahedralCode::r11g11b10}) {
    std::vector<Coded> all;
    for (const std::string& device : test_devices()) {
      auto c = code(test_context(device), values, which);
      ASSERT_TRUE(c.ok()) << c.status().message();
      all.push_back(c.value());
      EXPECT_EQ(cases::count_different(all[0].codes, all.back().codes), 0) << device;
      EXPECT_EQ(cases::count_different(all[0].places, all.back().places), 0) << device;
      EXPECT_EQ(cases::count_different(all[0].values, all.back().values), 0) << device;
    }
  }
}

// Axes come back exactly, and mirror images of a direction have mirrored codes. Unsigned codes have no 0 at the middle of
// the map: the nearest of 256 is half a step away along both axes, .32 degrees at the poles.
TEST(OctahedralMap, AxesAreExact) {
  const Values axes{1, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 0};
  const double places[6][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {0, 0}, {1, 1}};
  for (const std::string& device : everywhere())
    for (const OctahedralCode which : {OctahedralCode::snorm8, OctahedralCode::snorm16}) {
      const auto c = code(test_context(device), axes, which);
      ASSERT_TRUE(c.ok());
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(c.value().values[4 * i + k], axes[4 * i + k]) << device << " axis " << i;
        EXPECT_EQ(c.value().places[4 * i], places[i][0]);
        EXPECT_EQ(c.value().places[4 * i + 1], places[i][1]);
      }
    }
  const double unorm = 2 * (std::floor(0.5 * 255 + 0.5) / 255) - 1;
  const Vec off = truth::octahedral_direction(unorm, unorm);
  EXPECT_NEAR(degrees({0, 0, 1}, off.data()), 0.32, 0.005);
}

// Places on the seams (z = 0, and x = 0 or y = 0 below) lie on them to the bit, and directions come back to rounding.
TEST(OctahedralMap, SeamsAreExact) {
  Values values;
  std::vector<Vec> directions;
  for (int i = 0; i < 3000; ++i) {
    Vec d = anywhere(i, 11);
    if (i % 3 == 2) d[2] = 0;
    else d[static_cast<std::size_t>(i % 3)] = 0, d[2] = -std::fabs(d[2]);
    directions.push_back(d);
    for (const double v : {d[0], d[1], d[2], 0.0}) values.push_back(static_cast<float>(v));
  }
  for (const std::string& device : everywhere()) {
    const auto c = code(test_context(device), values, OctahedralCode::snorm16);
    ASSERT_TRUE(c.ok());
    const bool real64 = device == "cpu:double";
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double u = c.value().places[4 * i], v = c.value().places[4 * i + 1];
      // x = 0: |v| is 1; y = 0: |u|; z = 0: their sum, to rounding.
      if (i % 3 < 2) {
        EXPECT_EQ(std::fabs(i % 3 == 0 ? v : u), 1) << i;
      } else {
        EXPECT_LE(std::fabs(std::fabs(u) + std::fabs(v) - 1), real64 ? 3e-16 : 1.2e-7);
      }
      const double l = std::sqrt(values[4 * i] * values[4 * i] + values[4 * i + 1] * values[4 * i + 1] + values[4 * i + 2] * values[4 * i + 2]);
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_LE(std::fabs(c.value().places[4 * i + 2 + k] - values[4 * i + k] / l), real64 ? 1e-15 : 3e-7) << device;
    }
  }
}

TEST(OctahedralMap, NoDirectionLiesAtThePole) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Values values{0, 0, 0, 0, nan, 1, 0, 0, inf, 0, 0, 0, 0, -inf, 0, 0, -0.0, -0.0, -0.0, 0};
  for (const std::string& device : everywhere()) {
    const auto c = code(test_context(device), values, OctahedralCode::snorm8);
    ASSERT_TRUE(c.ok());
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(c.value().values[4 * i], 0) << device << i;
      EXPECT_EQ(c.value().values[4 * i + 1], 0);
      EXPECT_EQ(c.value().values[4 * i + 2], 1);
    }
  }
}

// R11G11B10: every code comes back as itself; values between are at most half a step off; nothing is negative.
TEST(OctahedralMap, ColoursInBits) {
  Values values;
  for (int e = 0; e < 31; ++e)
    for (int m = 0; m < 64; ++m) {
      const double red = e == 0 ? std::ldexp(m, -20) : std::ldexp(64.0 + m, e - 21);
      const double blue = e == 0 ? std::ldexp(m / 2, -19) : std::ldexp(32.0 + m / 2, e - 20);
      for (const double v : {red, red, blue, 0.0}) values.push_back(v);
    }
  const std::size_t exact = values.size() / 4;
  for (int i = 0; i < 4000; ++i)
    for (int k = 0; k < 4; ++k)
      values.push_back(static_cast<float>(std::exp2(24 * scene::random01(static_cast<std::uint32_t>(4 * i + k), 9) - 10)));
  const std::size_t tail = values.size() / 4;
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double v : {-1.0, nan, inf, 0.0, 1e30, 65024.0, 64512.0, 0.0}) values.push_back(v);
  for (const std::string& device : everywhere()) {
    const auto c = code(test_context(device), values, OctahedralCode::r11g11b10);
    ASSERT_TRUE(c.ok());
    const Values& back = c.value().values;
    for (std::size_t i = 0; i < 4 * exact; ++i)
      ASSERT_EQ(back[i], i % 4 < 3 ? values[i] : 0) << device << " " << i;
    for (std::size_t i = 4 * exact; i < 4 * tail; ++i)
      ASSERT_LE(i % 4 < 3 ? std::fabs(back[i] / values[i] - 1) : 0, i % 4 < 2 ? 0x1p-7 : 0x1p-6) << device;
    const double expected[] = {0, 0, 64512, 0, 65024, 65024, 64512};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(back[4 * tail + i], expected[i]) << device << " " << i;
  }
}

TEST(OctahedralMap, RefusesWhatCannotBe) {
  EXPECT_EQ(validate(OctahedralMapParams{}).message(), "OctahedralMapParams.count is 0; expected 1..268435456");
  OctahedralMapParams p;
  p.count = 1;
  p.code = static_cast<OctahedralCode>(3);
  EXPECT_EQ(validate(p).message(), "OctahedralMapParams.code is 3; expected 0..2");
}

}  // namespace
}  // namespace luxel

// Spherical harmonics: the basis against its definition by Legendre polynomials and against quadrature, its signs and order
// against a published table of irradiance, lobes and rotations against integrals. On every execution.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

#include "host/module.h"
#include "tests/support/run.h"

namespace luxel::built_in {
extern const std::span<const Module* const> sh_probe;
}

namespace luxel {
namespace {

using Vec = std::array<double, 3>;
constexpr double pi = std::numbers::pi;
constexpr int functions = 25, words = 83;

// Rounding of the f32 executions: values up to 3 from polynomials of degree 4 with a dozen operations.
constexpr double f32_bound = 2e-6;
constexpr double f64_bound = 1e-13;
// 50 products summed in f32.
constexpr double f32_rotation_bound = 5e-6;

struct Tables {
  std::vector<double> values;     // directions x words
  std::vector<double> rotations;  // band x 9 x 9
};

// Runs the probe on a device.
Tables run_probe(const std::string& device, const std::vector<Vec>& directions, const std::array<Vec, 3>& axes) {
  Context& context = test_context(device);
  const int count = static_cast<int>(directions.size());
  Plan plan;
  plan.kernel = "sh_probe";
  const auto add = [&](const char* name, std::size_t n, bool written) {
    Resource r{name};
    r.format = Format::f32x1;
    r.bytes = n * 4;
    r.written = written;
    plan.resources.push_back(r);
  };
  add("directions", 3 * directions.size() + 9, false);
  add("values", words * directions.size(), true);
  add("rotations", 5 * 81, true);
  Pass pass;
  pass.module = built_in::sh_probe[0];
  pass.label = "sh_probe";
  for (int i = 0; i < 3; ++i) pass.slots.push_back({Slot::Source::resource, i});
  pass.parameters = {static_cast<double>(count)};
  pass.workgroup = {32, 1, 1};
  pass.groups = {static_cast<std::uint32_t>(count + 31) / 32, 1, 1};
  plan.passes = {pass};
  std::vector<float> in;
  std::vector<double> in64;
  const auto put = [&](const Vec& v) {
    for (const double x : v) in.push_back(static_cast<float>(x)), in64.push_back(x);
  };
  for (const Vec& d : directions) put(d);
  for (const Vec& a : axes) put(a);
  const auto out = run_bytes(context, plan, {{"directions", context.real64() ? bytes_of(in64) : bytes_of(in)}},
                             {"values", "rotations"});
  return {decode(Format::f32x1, out[0], context.real64()), decode(Format::f32x1, out[1], context.real64())};
}

std::array<Vec, 3> a_rotation() {
  // By 1.1 about (1, 2, -3) / |.|: Rodrigues' formula.
  const double n = std::sqrt(14.0), x = 1 / n, y = 2 / n, z = -3 / n, c = std::cos(1.1), s = std::sin(1.1), t = 1 - c;
  return {Vec{t * x * x + c, t * x * y + s * z, t * x * z - s * y}, Vec{t * x * y - s * z, t * y * y + c, t * y * z + s * x},
          Vec{t * x * z + s * y, t * y * z - s * x, t * z * z + c}};
}

// Unit directions all over the sphere, the six axes first.
std::vector<Vec> some_directions(int count) {
  std::vector<Vec> all = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2.0 * k + 1) / count, a = k * 2.399963229728653, r = std::sqrt(1 - z * z);
    all.push_back({r * std::cos(a), r * std::sin(a), z});
  }
  return all;
}

// The definition: K sqrt2 {cos m phi, sin |m| phi} P_l^|m| without the alternating sign.
double defined(int l, int m, const Vec& d) {
  const int a = std::abs(m);
  double factorials = 1;
  for (int k = l - a + 1; k <= l + a; ++k) factorials *= k;
  const double k = std::sqrt((2 * l + 1) / (4 * pi * factorials));
  const double p = std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(a), d[2]);
  const double phi = std::atan2(d[1], d[0]);
  return m == 0 ? k * p : std::sqrt(2.0) * k * p * (m > 0 ? std::cos(a * phi) : std::sin(a * phi));
}

double bound_of(const std::string& device) { return device == "cpu:double" ? f64_bound : f32_bound; }
std::vector<std::string> all_devices() {
  std::vector<std::string> all = test_devices();
  all.push_back("cpu:double");
  return all;
}

TEST(Sh, BasisIsTheDefinitionAndHasTheSameBitsEverywhere) {
  const auto directions = some_directions(200);
  const Tables cpu = run_probe("cpu", directions, a_rotation());
  for (const std::string& device : all_devices()) {
    const Tables got = run_probe(device, directions, a_rotation());
    ASSERT_EQ(got.values.size(), directions.size() * words);
    for (std::size_t k = 0; k < directions.size(); ++k)
      for (int l = 0; l <= 4; ++l)
        for (int m = -l; m <= l; ++m)
          ASSERT_LE(std::fabs(got.values[k * words + static_cast<std::size_t>(l * l + l + m)] - defined(l, m, directions[k])),
                    bound_of(device))
              << device << " l " << l << " m " << m;
    if (device != "cpu:double") {
      EXPECT_EQ(got.values, cpu.values) << device;
      EXPECT_EQ(got.rotations, cpu.rotations) << device;
    }
  }
}

// Nodes of a product rule in double, of which polynomials up to degree 2 n - 1 are exact.
std::vector<std::pair<Vec, double>> quadrature(int n) {
  std::vector<std::pair<Vec, double>> all;
  for (int i = 0; i < n; ++i) {
    double z = std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int turn = 0; turn < 50; ++turn) {
      const double p = std::legendre(static_cast<unsigned>(n), z), q = std::legendre(static_cast<unsigned>(n - 1), z);
      slope = n * (q - z * p) / (1 - z * z);
      z -= p / slope;
    }
    const double w = 2 / ((1 - z * z) * slope * slope);
    for (int k = 0; k < 2 * n; ++k) {
      const double a = pi * k / n, r = std::sqrt(1 - z * z);
      all.push_back({{r * std::cos(a), r * std::sin(a), z}, w * pi / n});
    }
  }
  return all;
}

TEST(Sh, BasisIsOrthonormal) {
  const auto nodes = quadrature(8);
  std::vector<Vec> directions;
  for (const auto& node : nodes) directions.push_back(node.first);
  for (const std::string& device : {std::string("cpu"), std::string("cpu:double")}) {
    const Tables got = run_probe(device, directions, a_rotation());
    for (std::size_t i = 0; i < functions; ++i)
      for (std::size_t j = 0; j < functions; ++j) {
        double sum = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k)
          sum += nodes[k].second * got.values[k * words + i] * got.values[k * words + j];
        EXPECT_LE(std::fabs(sum - (i == j)), device == "cpu" ? f32_bound : 1e-12) << i << " " << j;
      }
  }
}

// The lobe <n|w>+ and a zonal lobe, projected by quadrature about their own axis, where both are smooth on a half.
TEST(Sh, LobesAreTheirProjections) {
  const auto directions = some_directions(40);
  const auto half = quadrature(40);  // z of -1..1, mapped to 0..1
  for (const std::string& device : all_devices()) {
    const Tables got = run_probe(device, directions, a_rotation());
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const Vec n = directions[k];
      const Vec side = std::fabs(n[0]) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
      Vec u = {n[1] * side[2] - n[2] * side[1], n[2] * side[0] - n[0] * side[2], n[0] * side[1] - n[1] * side[0]};
      const double length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
      for (double& x : u) x /= length;
      const Vec v = {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
      std::array<double, functions> cosine{};
      for (const auto& [d, w] : half) {
        const double z = (d[2] + 1) / 2, stretch = d[2] * d[2] < 1 ? std::sqrt((1 - z * z) / (1 - d[2] * d[2])) : 0;
        Vec e;
        for (std::size_t a = 0; a < 3; ++a) e[a] = d[0] * stretch * u[a] + d[1] * stretch * v[a] + z * n[a];
        for (int l = 0; l <= 4; ++l)
          for (int m = -l; m <= l; ++m) cosine[static_cast<std::size_t>(l * l + l + m)] += w / 2 * z * defined(l, m, e);
      }
      for (std::size_t i = 0; i < functions; ++i)
        ASSERT_LE(std::fabs(got.values[k * words + 25 + i] - cosine[i]), device == "cpu:double" ? 1e-9 : f32_bound)
            << device << " " << i;
      // A zonal lobe is sqrt(4 pi / (2 l + 1)) Y(axis); its value along the axis is that of the lobe along +z.
      for (int l = 0; l <= 4; ++l) {
        double along = 0;
        for (int m = -l; m <= l; ++m) {
          const auto i = static_cast<std::size_t>(l * l + l + m);
          along += got.values[k * words + 50 + i] * defined(l, m, n);
        }
        ASSERT_LE(std::fabs(along - defined(l, 0, {0, 0, 1})), device == "cpu:double" ? 1e-12 : 4e-6) << l;
      }
      for (std::size_t i = 0; i < 4; ++i) {
        ASSERT_LE(std::fabs(got.values[k * words + 75 + i] - got.values[k * words + i]), f64_bound);
        ASSERT_LE(std::fabs(got.values[k * words + 79 + i] - got.values[k * words + 25 + i]), bound_of(device));
      }
    }
  }
}

// Radiance of the light probe "Grace Cathedral" (Debevec): coefficients as published with seven digits.
constexpr double grace[9][3] = {
    {.7953949, .4405923, .5459412},    {.3981450, .3526911, .6097158},    {-.3424573, -.1838151, -.2715583},
    {-.2944621, -.0560606, .0095193},  {-.1123051, -.0513088, -.1232869}, {-.2645007, -.2257996, -.4785847},
    {-.1569444, -.0954703, -.1485053}, {.5646247, .2161586, .1402643},    {.2137442, -.0547578, -.3061700}};
// The table's irradiance comes from factors of six digits (c1..c5 of eq. 13).
constexpr double grace_bound = 3e-6;

TEST(Sh, IrradianceIsThatOfThePublishedTable) {
  const char* const data = std::getenv("LUXEL_DATA");
  std::ifstream file(std::string(data ? data : "../shared/data") + "/numeric/sh_grace_irradiance_expected.csv");
  if (!file) GTEST_SKIP() << "needs LUXEL_DATA/numeric/sh_grace_irradiance_expected.csv";
  std::vector<Vec> normals, expected;
  for (std::string line; std::getline(file, line);) {
    double v[6];
    char comma;
    std::istringstream text(line);
    if (text >> v[0] >> comma >> v[1] >> comma >> v[2] >> comma >> v[3] >> comma >> v[4] >> comma >> v[5]) {
      normals.push_back({v[0], v[1], v[2]});
      expected.push_back({v[3], v[4], v[5]});
    }
  }
  ASSERT_EQ(normals.size(), 14u);
  for (const std::string& device : all_devices()) {
    const Tables got = run_probe(device, normals, a_rotation());
    double most = 0;
    for (std::size_t k = 0; k < normals.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        double e = 0;
        for (std::size_t i = 0; i < 9; ++i) e += grace[i][c] * got.values[k * words + 25 + i];
        most = std::max(most, std::fabs(e - expected[k][c]));
      }
    EXPECT_LE(most, grace_bound) << device;
    RecordProperty(device, std::to_string(most));
  }
}

TEST(Sh, RotationMovesTheFunction) {
  const auto directions = some_directions(60);
  std::array<Vec, 3> mirrored = a_rotation();
  for (double& x : mirrored[1]) x = -x;
  for (const auto& axes : {a_rotation(), mirrored})
    for (const std::string& device : all_devices()) {
      const Tables got = run_probe(device, directions, axes);
      const double bound = device == "cpu:double" ? 1e-12 : f32_rotation_bound;
      for (int l = 0; l <= 4; ++l)
        for (const Vec& w : directions) {
          // R^-1 w: the axes' images are orthonormal.
          Vec back{};
          for (std::size_t a = 0; a < 3; ++a) back[a] = axes[a][0] * w[0] + axes[a][1] * w[1] + axes[a][2] * w[2];
          for (int n = -l; n <= l; ++n) {
            double rotated = 0;
            for (int m = -l; m <= l; ++m)
              rotated += got.rotations[static_cast<std::size_t>(81 * l + 9 * (m + 4) + n + 4)] * defined(l, m, w);
            ASSERT_LE(std::fabs(rotated - defined(l, n, back)), bound) << device << " l " << l << " n " << n;
          }
        }
    }
}

}  // namespace
}  // namespace luxel

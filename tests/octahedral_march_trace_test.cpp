// probe_trace: the same answers on every execution, with and without the minimum map, and as an exhaustive search in double
// gives them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::ProbeScene;
using cases::Ray;
using cases::Values;
using Vec = std::array<double, 3>;

double random(int index, std::uint32_t seed) { return scene::random01(static_cast<std::uint32_t>(index), seed); }

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Seen from c along d: a room of -1..1 with a round window to the sky towards +x, and balls in it.
double see_room(const Vec& c, const Vec& d, Vec& n) {
  double t = 1e30;
  for (std::size_t k = 0; k < 3; ++k)
    if (d[k] != 0) {
      const double side = d[k] > 0 ? 1 : -1, at = (side - c[k]) / d[k];
      if (at > 0 && at < t) t = at, n = {0, 0, 0}, n[k] = -side;
    }
  if (n[0] < 0 && std::hypot(c[1] + t * d[1], c[2] + t * d[2]) < 0.4) t = 1e30;
  const Vec balls[] = {{0.55, 0.1, 0.2}, {-0.3, -0.55, 0.4}, {-0.5, 0.5, -0.6}, {0.2, -0.4, -0.6}};
  const double radii[] = {0.2, 0.25, 0.3, 0.12};
  for (int i = 0; i < 4; ++i) {
    const Vec o{c[0] - balls[i][0], c[1] - balls[i][1], c[2] - balls[i][2]};
    const double b = dot(o, d), under = b * b - dot(o, o) + radii[i] * radii[i];
    if (under < 0) continue;
    const double at = -b - std::sqrt(under);
    if (at > 0 && at < t) {
      t = at;
      for (std::size_t k = 0; k < 3; ++k) n[k] = (o[k] + t * d[k]) / radii[i];
    }
  }
  return t;
}

ProbeGrid room_grid(std::array<int, 3> count) {
  ProbeGrid g;
  g.count = count;
  for (std::size_t k = 0; k < 3; ++k) {
    g.spacing[k] = 1.9375 / count[k];
    g.origin[k] = -0.96875 + g.spacing[k] / 2;
  }
  return g;
}

cases::TexelValues room_values(const ProbeGrid& g, int size) {
  return cases::texel_values(size, static_cast<int>(probe_count(g)), [&](int p, const Vec& d, Vec& n) {
    const int at[3] = {p % g.count[0], p / g.count[0] % g.count[1], p / g.count[0] / g.count[1]};
    Vec c;
    for (std::size_t k = 0; k < 3; ++k) c[k] = g.origin[k] + at[k] * g.spacing[k];
    return see_room(c, d, n);
  });
}

// From anywhere in the room; lengths of all kinds.
std::vector<Ray> room_rays(int count, std::uint32_t seed) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    const auto u = [&](int k) { return random(8 * i + k, seed); };
    Ray r;
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] = 1.9 * u(static_cast<int>(k)) - 0.95;
    const double z = 2 * u(3) - 1, a = 2 * M_PI * u(4), s = std::sqrt(1 - z * z);
    r.direction = {s * std::cos(a), s * std::sin(a), z};
    r.reach = u(5) < 0.6 ? 1e30 : 3 * u(6);
    rays.push_back(r);
  }
  return rays;
}

struct Setting {
  const char* name;
  ProbeDistance distance;
  ProbeNormal normal;
  double bias = 0;
  double thickness = 1;
};
const Setting settings[] = {{"f32 with normals", ProbeDistance::f32, ProbeNormal::snorm16},
                            {"f32", ProbeDistance::f32, ProbeNormal::none, 0, 2},
                            {"f16 with normals", ProbeDistance::f16, ProbeNormal::snorm8, 1},
                            {"f16", ProbeDistance::f16, ProbeNormal::none, 1.5, 4}};

ProbeMaps maps_of(const Setting& s, int size, int ratio = 16) {
  ProbeMaps m;
  m.size = size;
  m.ratio = ratio;
  m.distance = s.distance;
  m.normal = s.normal;
  return m;
}

ProbeTraceParams params_of(const Setting& s) {
  ProbeTraceParams p;
  p.maps.normal = s.normal;
  p.bias = s.bias;
  p.thickness = s.thickness;
  return p;
}

// The double execution, one probe: every texel in every octant, clipped from the ray in space, finds the same.
TEST(ProbeTrace, ExhaustiveSearchFindsTheSame) {
  Context& context = test_context("cpu:double");
  const ProbeGrid grid = room_grid({1, 1, 1});
  const std::vector<Ray> rays = room_rays(1500, 7);
  const Values values = cases::ray_values(rays);
  for (const Setting& s : settings) {
    auto scene = ProbeScene::make(context, maps_of(s, 48), grid, room_values(grid, 48));
    ASSERT_TRUE(scene.ok()) << scene.status().message();
    ProbeTraceParams p = params_of(s);
    p.probe = 0;
    const auto traced = scene.value().trace(p, values);
    ASSERT_TRUE(traced.ok()) << traced.status().message();
    const auto map = scene.value().decoded(0, s.normal != ProbeNormal::none);
    ASSERT_TRUE(map.ok());
    int wrong = 0, ties = 0, kinds[10] = {};
    double far = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      truth::ProbeRay ray;
      for (std::size_t k = 0; k < 3; ++k) ray.origin[k] = values[8 * i + k] - grid.origin[k], ray.direction[k] = values[8 * i + 4 + k];
      const double l = std::sqrt(dot(ray.direction, ray.direction));
      for (double& c : ray.direction) c /= l;
      ray.reach = std::min(values[8 * i + 7], 1e30);
      const truth::ProbeAnswer a = truth::probe_truth(map.value(), ray, p);
      ++kinds[static_cast<int>(a.outcome)];
      const double texel = traced.value().texels[i];
      const bool equal = a.outcome == traced.value().outcome(i) &&
                         (a.texel < 0 ? texel == 0xffffffffu : texel == a.texel);
      // Ties: decisions that hang on 1e-9 of what is compared.
      if (!equal) {
        if (a.margin < 1e-9) ++ties;
        else if (++wrong < 6)
          ADD_FAILURE() << s.name << " ray " << i << ": outcome " << static_cast<int>(a.outcome) << " texel " << a.texel << " t "
                        << a.t << " margin " << a.margin << ", kernel " << static_cast<int>(traced.value().outcome(i)) << " "
                        << texel << " " << traced.value().t(i);
      } else if (a.outcome != ProbeOutcome::miss) {
        far = std::max(far, std::fabs(a.t - traced.value().t(i)));
      }
    }
    EXPECT_EQ(wrong, 0) << s.name;
    EXPECT_LE(ties, 2) << s.name;
    EXPECT_LE(far, 1e-9) << s.name;
    EXPECT_GT(kinds[1], 100);  // the scene has all kinds of rays
    EXPECT_GT(kinds[2], 100);
    EXPECT_GT(kinds[3], 100);
  }
}

// The minimum map changes nothing but the number of looks: every ray, every bit.
TEST(ProbeTrace, FlatAndTwoLevelsAgree) {
  Context& context = test_context("cpu");
  const ProbeGrid grid = room_grid({2, 2, 2});
  const Values rays = cases::ray_values(room_rays(20000, 21));
  for (const Setting& s : settings)
    for (const int ratio : {2, 8, 16}) {
      auto scene = ProbeScene::make(context, maps_of(s, 64, ratio), grid, room_values(grid, 64));
      ASSERT_TRUE(scene.ok()) << scene.status().message();
      ProbeTraceParams p = params_of(s);
      p.count = true;
      const auto two = scene.value().trace(p, rays);
      p.maps.ratio = 1;
      const auto flat = scene.value().trace(p, rays);
      ASSERT_TRUE(two.ok() && flat.ok());
      int different = 0;
      for (std::size_t i = 0; 8 * i < rays.size(); ++i)
        different += two.value().hits[4 * i] != flat.value().hits[4 * i] || two.value().hits[4 * i + 1] != flat.value().hits[4 * i + 1] ||
                     two.value().texels[i] != flat.value().texels[i];
      EXPECT_EQ(different, 0) << s.name << " ratio " << ratio;
      if (ratio == 16) {
        EXPECT_LT(two.value().counters[9], 0.7 * flat.value().counters[9]) << s.name;
      }
    }
}

// All executions in float give the same bits.
TEST(ProbeTrace, DevicesAgreeToTheBit) {
  const ProbeGrid plain = room_grid({2, 3, 2});
  const Values rays = cases::ray_values(room_rays(4000, 33));
  for (const Setting& s : settings)
    for (const bool placed : {false, true})
      for (const bool flat : {false, true}) {
        if (flat && placed) continue;
        ProbeGrid grid = plain;
        grid.placed = placed;
        Values positions;
        for (int i = 0; i < 12; ++i)
          for (const double v : {grid.origin[0] + i % 2 * grid.spacing[0], grid.origin[1] + i / 2 % 3 * grid.spacing[1],
                                 grid.origin[2] + i / 6 * grid.spacing[2], i == 5 ? 0.0 : 1.0})
            positions.push_back(v);
        std::vector<Values> all;
        for (const std::string& device : test_devices()) {
          Context& context = test_context(device);
          auto scene = ProbeScene::make(context, maps_of(s, 32, 8), grid, room_values(plain, 32), positions);
          ASSERT_TRUE(scene.ok()) << scene.status().message();
          ProbeTraceParams p = params_of(s);
          p.count = !placed;
          p.order = placed ? ProbeOrder::farthest : ProbeOrder::plus3;
          if (flat) p.maps.ratio = 1;
          auto traced = scene.value().trace(p, rays);
          ASSERT_TRUE(traced.ok()) << device << ": " << traced.status().message();
          Values v = traced.value().hits;
          v.insert(v.end(), traced.value().texels.begin(), traced.value().texels.end());
          v.insert(v.end(), traced.value().counters.begin(), traced.value().counters.end());
          all.push_back(v);
          for (const std::string& message : context.validation_messages()) ADD_FAILURE() << message;
        }
        for (std::size_t i = 1; i < all.size(); ++i)
          EXPECT_EQ(cases::count_different(all[0], all[i]), 0) << s.name << " on " << test_devices()[i];
      }
}

template <class Params>
void refused(const Params& p, const char* expected) {
  EXPECT_EQ(validate(p).code(), Code::invalid_argument) << expected;
  EXPECT_EQ(validate(p).message(), expected);
  for (const std::string& device : test_devices()) EXPECT_EQ(plan(p, test_context(device).profile()).status().message(), expected) << device;
}

TEST(ProbeTrace, RefusesWhatCannotBe) {
  const auto with = [](auto change) {
    ProbeTraceParams p;
    p.grid.count = {2, 3, 4};
    p.rays = 1;
    change(p);
    return p;
  };
  const double nan = std::nan("");
  EXPECT_TRUE(validate(with([](auto&) {})).ok());
  EXPECT_TRUE(validate(with([](auto& p) { p.probe = 23, p.tries = 24, p.bias = 64, p.slope = 0, p.thickness = 0.125; })).ok());
  refused(with([](auto& p) { p.grid.count[1] = 0; }), "ProbeGrid.count is 0; expected 1..1024");
  refused(with([](auto& p) { p.grid.count = {1024, 65, 1}; }), "ProbeGrid.count is 66560; expected at most 65536 probes in all");
  refused(with([](auto& p) { p.grid.origin[2] = 1e16; }), "ProbeGrid.origin is 1e+16; expected -1e+15..1e+15");
  refused(with([](auto& p) { p.grid.spacing[0] = 0; }), "ProbeGrid.spacing is 0; expected 1e-15..1e+15");
  refused(with([=](auto& p) { p.grid.spacing[0] = nan; }), "ProbeGrid.spacing is nan; expected 1e-15..1e+15");
  refused(with([](auto& p) { p.maps.size = 14; }), "ProbeMaps.size is 14; expected 16..2048");
  refused(with([](auto& p) { p.maps.ratio = 0; }), "ProbeMaps.ratio is 0; expected 1..256");
  refused(with([](auto& p) { p.maps.distance = static_cast<ProbeDistance>(2); }), "ProbeMaps.distance is 2; expected 0..1");
  refused(with([](auto& p) { p.maps.normal = static_cast<ProbeNormal>(-1); }), "ProbeMaps.normal is -1; expected 0..2");
  refused(with([](auto& p) { p.rays = 0; }), "ProbeTraceParams.rays is 0; expected 1..67108864");
  refused(with([](auto& p) { p.probe = 24; }), "ProbeTraceParams.probe is 24; expected -1..23");
  refused(with([](auto& p) { p.probe = -2; }), "ProbeTraceParams.probe is -2; expected -1..23");
  refused(with([](auto& p) { p.tries = 25; }), "ProbeTraceParams.tries is 25; expected 1..24");
  refused(with([](auto& p) { p.order = static_cast<ProbeOrder>(2); }), "ProbeTraceParams.order is 2; expected 0..1");
  refused(with([](auto& p) { p.max_steps = -1; }), "ProbeTraceParams.max_steps is -1; expected 0..16777216");
  refused(with([](auto& p) { p.thickness = 0.1; }), "ProbeTraceParams.thickness is 0.1; expected 0.125..64");
  refused(with([](auto& p) { p.slope = 65; }), "ProbeTraceParams.slope is 65; expected 0..64");
  refused(with([=](auto& p) { p.bias = nan; }), "ProbeTraceParams.bias is nan; expected 0..64");
}

TEST(ProbeFetch, RefusesWhatCannotBe) {
  const auto with = [](auto change) {
    ProbeFetchParams p;
    p.rays = 1;
    change(p);
    return p;
  };
  EXPECT_TRUE(validate(with([](auto&) {})).ok());
  refused(with([](auto& p) { p.probes = 0; }), "ProbeFetchParams.probes is 0; expected 1..65536");
  refused(with([](auto& p) { p.probes = 65536; }), "ProbeMaps.size is 256; expected size x size x probes of at most 2147483647");
  refused(with([](auto& p) { p.maps.radiance = static_cast<ProbeRadiance>(3); }), "ProbeMaps.radiance is 3; expected 0..2");
  refused(with([](auto& p) { p.rays = (1 << 26) + 1; }), "ProbeFetchParams.rays is 67108865; expected 1..67108864");
  refused(with([](auto& p) { p.environment[1] = -1; }), "ProbeFetchParams.environment is -1; expected 0..1e+30");
  refused(with([](auto& p) { p.environment[2] = std::nan(""); }), "ProbeFetchParams.environment is nan; expected 0..1e+30");
}

}  // namespace
}  // namespace luxel

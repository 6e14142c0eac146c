// cone_trace through clipmaps: against the pyramid, closed forms across the windows' borders, equal bits everywhere.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/images.h"
#include "bench/scene/volumes.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/storage.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;
using std::numbers::pi;
using Voxel = std::array<int, 3>;

// Levels of `n`^3 voxels about a place (in finest voxels, the unit of the scene).
ConeTraceParams clipmap_params(int n, int levels, Voxel centre, Format format = Format::f32x4) {
  ConeTraceParams p = cone_params(n, ConeVariant::isotropic, format);
  p.voxel = 1;
  p.clipmap = cone_trace_windows(p, {centre[0] + 0.0, centre[1] + 0.0, centre[2] + 0.0}, levels);
  return p;
}

// What a world has in each voxel of each level, as the windows store it. world(level, voxel) -> q, a.
template <class World>
Values stored(const ConeTraceParams& p, World world) {
  const int n = p.extent[0];
  Values values(p.clipmap.size() * static_cast<std::size_t>(n) * n * n * 4);
  const auto modulo = [&](int v) { return static_cast<std::size_t>((v % n + n) % n); };
  for (std::size_t level = 0; level < p.clipmap.size(); ++level)
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const Voxel& first = p.clipmap[level];
          const Voxel v{first[0] + x, first[1] + y, first[2] + z};
          const std::array<double, 4> q = world(static_cast<int>(level), v);
          const std::size_t i = ((level * n + modulo(v[2])) * n + modulo(v[1])) * n + modulo(v[0]);
          std::copy(q.begin(), q.end(), &values[4 * i]);
        }
  return values;
}

ConeResult clipmap_trace(Context& context, const ConeTraceParams& p, const Values& volume, const Values& receivers,
                         const Values& views = {}) {
  const Result<Plan> made = plan(p, context.profile());
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made) return {};
  const auto bytes = [&](const Values& v, Format f) {
    const std::vector<std::byte> data = store(v, f, context.real64());
    return Bytes(reinterpret_cast<const std::uint8_t*>(data.data()),
                 reinterpret_cast<const std::uint8_t*>(data.data()) + data.size());
  };
  NamedBytes inputs{{"clipmap", bytes(volume, p.format)}, {"receivers", bytes(receivers, Format::f32x4)}};
  if (p.specular) inputs.emplace_back("views", bytes(views, Format::f32x4));
  std::vector<std::string> names;
  if (p.radiance || p.occlusion) names.push_back("irradiance");
  if (p.specular) names.push_back("specular");
  if (p.count) inputs.emplace_back("counters", Bytes(cone_outcomes * 4)), names.push_back("counters");
  const std::vector<Bytes> out = run_bytes(context, made.value(), inputs, names);
  ConeResult result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Format f = names[i] == "counters" ? Format::u32 : Format::f32x4;
    const Values values = fetch(std::as_bytes(std::span(out[i])), f, context.real64());
    (names[i] == "counters" ? result.counters : names[i] == "specular" ? result.specular : result.irradiance) = values;
  }
  return result;
}

std::vector<std::string> all_devices() {
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  return devices;
}

// Where cones are nowhere wider than the windows allow, a clipmap of a pyramid's own levels is that pyramid.
TEST(ConeTraceClipmap, EqualsThePyramidWhereBothKnowTheScene) {
  constexpr int whole = 64, n = 16;
  std::vector<Values> levels{quantise(scene::voxel_room(whole), Format::f32x4)};
  for (int size = whole / 2; size >= n; size /= 2) {
    const Values& fine = levels.back();
    Values coarse;
    for (int z = 0; z < size; ++z)
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
          for (int c = 0; c < 4; ++c) {
            double sum = 0;
            for (int k = 0; k < 8; ++k)
              sum += fine[4 * ((static_cast<std::size_t>(2 * z + k / 4) * 2 * size + 2 * y + k / 2 % 2) * 2 * size + 2 * x + k % 2) + c];
            coarse.push_back(sum / 8);
          }
    levels.push_back(quantise(coarse, Format::f32x4));
  }
  ConeTraceParams p = clipmap_params(n, 3, {32, 32, 32});
  ASSERT_EQ(p.clipmap[2], (Voxel{0, 0, 0})) << "the outermost window holds the whole volume";
  p.clipmap_own_length = false;
  p.footprint = 1;  // voxels become wider before a window ends
  p.gamma = 0.1;
  p.environment = {0.25, 0.5, 1};
  p.width = 200;
  Values receivers;
  for (int i = 0; i < p.width; ++i) {
    const auto random = [&](int k) { return scene::random01(static_cast<std::uint32_t>(i * 8 + k), 3); };
    add_receiver(receivers, {30.5 + 3 * random(0), 30.5 + 3 * random(1), 30.5 + 3 * random(2)},
                 {2 * random(3) - 1, 2 * random(4) - 1, 2 * random(5) - 1});
  }
  const Values volume = stored(p, [&](int level, Voxel v) {
    const int size = whole >> level;
    const double* const at = &levels[level][4 * ((static_cast<std::size_t>(v[2]) * size + v[1]) * size + v[0])];
    return std::array<double, 4>{at[0], at[1], at[2], at[3]};
  });
  ConeTraceParams pyramid = p;
  pyramid.clipmap.clear();
  pyramid.extent = {whole, whole, whole};
  pyramid.levels = 3;
  for (const std::string& device : all_devices()) {
    Context& context = test_context(device);
    const auto expected = trace(context, pyramid, levels[0], receivers);
    ASSERT_TRUE(expected) << expected.status().message();
    const ConeResult found = clipmap_trace(context, p, volume, receivers);
    // Places count from another corner, mips are rounded in another order: roundings of f32, amplified near opaque voxels
    // as in FloatIsNearDouble. In double only the mips' (f32) remain.
    EXPECT_LE(max_difference(found.irradiance, expected.value().irradiance), 2 * std::sqrt(0x1p-25)) << device;
    EXPECT_GT(max_difference(expected.value().irradiance, Values(expected.value().irradiance.size(), 0)), 0.5);
  }
}

std::array<double, 4> random_voxel(int level, Voxel v) {
  const auto i = static_cast<std::uint32_t>((v[0] * 73856093) ^ (v[1] * 19349663) ^ (v[2] * 83492791)) + 977u * static_cast<std::uint32_t>(level);
  const auto random = [&](std::uint32_t k) { return scene::random01(8 * i + k, 11); };
  const double a = random(0) < 0.6 ? 0 : random(0) > 0.95 ? 1 : 0.3 * random(1);
  return {a * random(2), a * random(3), a * random(4), a};
}

TEST(ConeTraceClipmap, EveryDeviceGivesTheSameBits) {
  for (const Format f : {Format::f32x4, Format::f16x4, Format::unorm8x4})
    for (const bool extras : {false, true}) {
      ConeTraceParams p = clipmap_params(16, 4, {-5, 103, 8}, f);
      p.width = 17;
      p.height = 5;
      p.environment = {0.25, 0.5, 1};
      p.specular = p.count = extras;
      p.gamma = extras ? 0.2 : 0;
      p.start = extras ? 0.5 : 0;
      p.clipmap_own_length = !extras;
      const Values volume = quantise(stored(p, random_voxel), f);
      ConeTraceParams around = p;  // receivers in all windows, and outside
      around.origin = {-80, 30, -70};
      around.voxel = 10;
      const Values receivers = cone_receivers(around, 85, 4);
      Values views;
      for (int i = 0; i < 340; ++i) views.push_back(2 * scene::random01(static_cast<std::uint32_t>(i), 6) - 1);
      const ConeResult cpu = clipmap_trace(test_context("cpu"), p, volume, receivers, views);
      for (const std::string& device : test_devices()) {
        const ConeResult r = clipmap_trace(test_context(device), p, volume, receivers, views);
        EXPECT_EQ(count_different(r.irradiance, cpu.irradiance), 0) << device << " " << name(f);
        EXPECT_EQ(count_different(r.specular, cpu.specular), 0) << device << " " << name(f);
        EXPECT_EQ(r.counters, cpu.counters) << device;
      }
      if (extras) {
        EXPECT_EQ(cpu.counters[static_cast<int>(ConeOutcome::capped)], 0);
        EXPECT_EQ(cpu.counters[static_cast<int>(ConeOutcome::not_finite)], 0);
        EXPECT_GT(cpu.counters[static_cast<int>(ConeOutcome::left)], 0);
      }
    }
}

// Where the windows stand changes where voxels are stored and nothing else.
TEST(ConeTraceClipmap, AMovedWorldGivesTheSameBits) {
  ConeTraceParams p = clipmap_params(16, 3, {8, 8, 8});
  p.width = 40;
  p.environment = {0.25, 0.5, 1};
  ConeTraceParams around = p;
  around.origin = {-16, -16, -16};
  around.voxel = 3;
  const Values receivers = cone_receivers(around, 40, 4);
  const ConeResult here = clipmap_trace(test_context("cpu"), p, stored(p, random_voxel), receivers);
  for (const Voxel& by : {Voxel{4, 0, 0}, Voxel{-28, 1024, 44}}) {  // whole voxels of the coarsest level
    ConeTraceParams q = p;
    for (std::size_t l = 0; l < 3; ++l)
      for (std::size_t k = 0; k < 3; ++k) q.clipmap[l][k] += by[k] >> l;
    for (std::size_t k = 0; k < 3; ++k) q.origin[k] = -by[k];
    const auto moved = [&](int level, Voxel v) {
      return random_voxel(level, {v[0] - (by[0] >> level), v[1] - (by[1] >> level), v[2] - (by[2] >> level)});
    };
    for (const std::string& device : test_devices()) {
      const ConeResult there = clipmap_trace(test_context(device), q, stored(q, moved), receivers);
      EXPECT_EQ(count_different(there.irradiance, here.irradiance), 0) << device;
    }
  }
}

TEST(ConeTraceClipmap, TheFurnaceHoldsAcrossAllWindows) {
  ConeTraceParams p = clipmap_params(16, 4, {0, 0, 0});
  p.width = 300;
  p.environment = {1, 1, 1};
  const Values volume = stored(p, [](int level, Voxel v) {
    const double a = static_cast<float>(random_voxel(level, v)[3]);
    return std::array<double, 4>{a, a, a, a};
  });
  ConeTraceParams around = p;
  around.origin = {-70, -70, -70};
  around.voxel = 140 / 16.0;
  const Values receivers = cone_receivers(around, p.width, 8);
  for (const NamedSet& set : cone_sets()) {
    p.cones = set.cones;
    for (const std::string& device : test_devices()) {
      const ConeResult r = clipmap_trace(test_context(device), p, volume, receivers);
      // C and A run the same recurrence: a cone's light differs from 1 by a rounding of each of its steps.
      for (std::size_t i = 0; i < r.irradiance.size(); ++i)
        if (i % 4 < 3) {
          ASSERT_NEAR(r.irradiance[i] / pi, 1, 100 * 0x1p-23) << device << " " << set.name;
        }
    }
  }
}

// A homogeneous medium, each level with the opacity of its own voxels: the way out has a closed form, whatever windows the
// cone crosses and wherever it starts.
TEST(ConeTraceClipmap, AHomogeneousMediumHasNoSeam) {
  ConeTraceParams p = clipmap_params(16, 4, {0, 0, 0});
  p.cones = {{{0, 0, 1}, 1, 0.5}};
  p.normal_offset = 0;
  p.width = 121;
  Values receivers;
  for (int i = 0; i < p.width; ++i) add_receiver(receivers, {i * 1.0 - 60, 3.3, -2.7}, {1, 0, 0});
  for (const double a : {0.003, 0.04}) {
    const Values volume = stored(p, [&](int level, Voxel) {
      const double own = static_cast<float>(-std::expm1(std::ldexp(std::log1p(-a), level)));
      return std::array<double, 4>{own, own, own, own};
    });
    for (const std::string& device : all_devices()) {
      const ConeResult r = clipmap_trace(test_context(device), p, volume, receivers);
      for (int i = 0; i < p.width; ++i) {
        const double hidden = -std::expm1((64 - (i * 1.0 - 60)) * std::log1p(-a));
        // Opacities are stored in f32, a relative error 2^-24 of each of some 60 steps.
        EXPECT_NEAR(r.irradiance[4 * i + 3], 1 - hidden, 60 * 0x1p-23) << device << " " << a << " at " << i - 60;
      }
    }
  }
}

// A floor under a lit ceiling, both opaque and one voxel thick at every level as voxelize makes them: what receivers on the
// floor get as they cross the windows' borders; 1 with infinitely fine voxels. The floor lies near the lower side of
// its voxels, so that cones begin within reach of their interpolation, which hides the more the wider they are.
TEST(ConeTraceClipmap, SeamsInAHallAreBounded) {
  const int n = 32;
  ConeTraceParams p = clipmap_params(n, 3, {0, 0, 0});
  p.environment = {0.5, 0.5, 0.5};
  const double height = 9.3;  // of the ceiling: in the finest window, as the floor
  const Values volume = stored(p, [&](int level, Voxel v) {
    const auto touches = [&](double y) { return std::ldexp(v[1], level) <= y && y <= std::ldexp(v[1] + 1, level); };
    const double a = touches(0.3) || touches(height) ? 1 : 0, lit = touches(height) ? 1 : 0;
    return std::array<double, 4>{lit, 0.5 * lit, 0.25 * lit, a};
  });
  p.width = 121;
  Values receivers;
  for (int i = 0; i < p.width; ++i) add_receiver(receivers, {0.5 * i - 30, 0.3, 0.7}, {0, 1, 0});
  for (const std::string& device : test_devices()) {
    const ConeResult r = clipmap_trace(test_context(device), p, volume, receivers);
    double least = 1e9, most = 0, jump = 0;
    for (int i = 0; i < p.width; ++i) {
      const double e = r.irradiance[4 * i] / pi;
      least = std::min(least, e);
      most = std::max(most, e);
      if (i > 0) jump = std::max(jump, std::fabs(e - r.irradiance[4 * (i - 1)] / pi));
    }
    EXPECT_GE(least, 0.75) << device;
    EXPECT_LE(most, 1 + 1e-5) << device;
    EXPECT_LE(jump, 0.06) << device << ": between receivers half a voxel apart";
  }
}

// Levels that contradict each other: what a thin cone sees goes from one to the next over the border's width, evenly.
TEST(ConeTraceClipmap, LevelsGiveWayToEachOtherEvenly) {
  ConeTraceParams p = clipmap_params(16, 3, {0, 0, 0});
  p.clipmap_border = 2;
  p.cones = {{{0, 0, 1}, 1, 0}};
  p.normal_offset = 0;
  p.max_distance = 1;
  const Values volume = stored(p, [](int level, Voxel) { return std::array<double, 4>{1.0 + level, 0, 0, 1}; });
  p.width = 20 * 16;
  Values receivers;
  for (int i = 0; i < p.width; ++i) add_receiver(receivers, {i / 16.0, 0.5, 0.5}, {0, 1, 0});
  for (const std::string& device : test_devices()) {
    const ConeResult r = clipmap_trace(test_context(device), p, volume, receivers);
    for (int i = 0; i < p.width; ++i) {
      const double x = i / 16.0, into[] = {x - (8 - 2.5), (x - (16 - 5)) / 2};  // voxels of the two windows' borders
      const double level = std::clamp(into[0] / 2, 0.0, 1.0) + std::clamp(into[1] / 2, 0.0, 1.0);
      EXPECT_NEAR(r.irradiance[4 * i] / pi, 1 + level, 1e-5) << device << " at " << x;
    }
  }
}

TEST(ConeTraceClipmap, RefusesWhatIsOutOfRange) {
  const ConeTraceParams good = clipmap_params(16, 3, {5, 6, 7});
  EXPECT_TRUE(validate(good));
  const auto message = [&](auto change) {
    ConeTraceParams p = good;
    change(p);
    return validate(p).message();
  };
  EXPECT_EQ(message([](auto& p) { p.extent[1] = 20; }),
            "ConeTraceParams.extent is 20; expected multiples of 8 from 16 on with a clipmap");
  EXPECT_EQ(message([](auto& p) { p.clipmap.resize(1); }), "ConeTraceParams.clipmap's size is 1; expected 2..16");
  EXPECT_EQ(message([](auto& p) { p.variant = ConeVariant::anisotropic; }),
            "ConeTraceParams.variant is anisotropic; expected isotropic with a clipmap");
  EXPECT_EQ(message([](auto& p) { p.input = Input::image; }),
            "ConeTraceParams.input is image; expected buffer with a clipmap");
  EXPECT_EQ(message([](auto& p) { p.levels = 2; }), "ConeTraceParams.levels is 2; expected 0 with a clipmap, which has its own");
  EXPECT_NE(message([](auto& p) { p.clipmap[1][2] += 2; }).find("ConeTraceParams.clipmap[1] leaves the level before it"),
            std::string::npos);
  EXPECT_NE(message([](auto& p) { p.clipmap_border = 5; }).find("ConeTraceParams.clipmap_border is 5"), std::string::npos);
  for (int centre = -9; centre < 9; ++centre) EXPECT_TRUE(validate(clipmap_params(16, 8, {centre, 3 * centre, -centre})));
}

}  // namespace
}  // namespace luxel

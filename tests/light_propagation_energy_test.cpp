// lpv_propagate's `energy`: what left the grid, what blocking took, what clamping added, against the definition's ledger; and
// that the form of the step which accounts for it has the bits of the other.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/compare.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/run.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using cases::Values;

struct Setting {
  std::array<int, 3> extent;
  int bands;
  LpvLobes lobes;
  LpvBorder border;
  bool geometry;
  Format format = Format::f32x4;
};

struct Ledger {
  Values result, travelling, energy;
};

Result<Ledger> accounted(Context& context, const LpvPropagateParams& p, const Values& light, const Values& blocks) {
  auto run = cases::Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write("injected", light); !s) return s;
  if (p.geometry)
    if (Status s = run.value().write("geometry", blocks); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  Ledger l;
  l.result = run.value().read("result").value();
  l.travelling = run.value().read("travelling").value();
  if (p.energy) l.energy = run.value().read("energy").value();
  return l;
}

// Eight steps of f32 and sums over some hundred cells, as a share of what was injected.
constexpr double account_bound = 2e-6;

void check(const Setting& s) {
  LpvPropagateParams p = cases::lpv_params(s.extent, s.bands, s.lobes);
  p.border = s.border, p.geometry = s.geometry, p.geometry_format = s.format, p.channels = 2, p.iterations = 8, p.travelling = true;
  const std::size_t cells = lpv_pixels(p.grid, 2, 1);
  Values blocks = s.geometry ? cases::lpv_surfels(p.grid, 2, 4) : Values();
  if (s.format == Format::f16x4) blocks = decode(s.format, encode(s.format, {blocks.begin(), blocks.end()}, false), false);
  Values light;
  std::array<std::vector<truth::LpvLedger>, 2> ledgers;
  std::array<double, 2> injected{};
  for (std::size_t c = 0; c < 2; ++c) {
    Values lights = cases::lpv_lights(p.grid, s.bands, 3, static_cast<std::uint32_t>(5 + c));
    if (cells == 1)
      for (int i = 0; i < 4; ++i) lights[static_cast<std::size_t>(i)] = cases::lpv_cosine(i, {0.6, 0, 0.8}, 1);
    truth::lpv_propagated(p, lights, blocks, &ledgers[c]);
    const Values pixels = truth::lpv_to_pixels(p.grid, s.bands, lights);
    injected[c] = cases::lpv_flux(pixels, cells);
    light.insert(light.end(), pixels.begin(), pixels.end());
  }
  for (const std::string& device : test_devices()) {
    SCOPED_TRACE(device + " " + cases::name(s.lobes) + std::to_string(s.bands));
    p.energy = false;
    const auto plain = accounted(test_context(device), p, light, blocks);
    p.energy = true;
    const auto got = accounted(test_context(device), p, light, blocks);
    ASSERT_TRUE(plain.ok()) << plain.status().message();
    ASSERT_TRUE(got.ok()) << got.status().message();
    EXPECT_EQ(cases::count_different(got.value().result, plain.value().result), 0);
    EXPECT_EQ(cases::count_different(got.value().travelling, plain.value().travelling), 0);
    for (const std::string& message : test_context(device).validation_messages()) ADD_FAILURE() << message;
    for (std::size_t c = 0; c < 2; ++c) {
      std::array<double, 4> sum{};
      for (std::size_t i = 0; i < 4 * cells; ++i) sum[i % 4] += got.value().energy[4 * cells * c + i];
      truth::LpvLedger all;
      for (const truth::LpvLedger& step : ledgers[c]) all.left += step.left, all.absorbed += step.absorbed, all.clamped += step.clamped;
      all.held = ledgers[c].back().held;
      EXPECT_LE(std::fabs(sum[0] - all.left) / injected[c], account_bound);
      EXPECT_LE(std::fabs(sum[1] - all.absorbed) / injected[c], account_bound);
      EXPECT_LE(std::fabs(sum[2] - all.clamped) / injected[c], account_bound);
      EXPECT_LE(std::fabs(sum[3] - all.held) / injected[c], account_bound);
      EXPECT_LE(std::fabs(injected[c] + sum[2] - sum[0] - sum[1] - sum[3]) / injected[c], account_bound);
      // Each of them is something here.
      EXPECT_EQ(s.border == LpvBorder::open, sum[0] > 0.05 * injected[c]);
      EXPECT_EQ(s.geometry && cells > 1, sum[1] > 0.05 * injected[c]);
      EXPECT_EQ(s.lobes == LpvLobes::clamp, sum[2] > 0.05 * injected[c]);
    }
  }
}

TEST(LightPropagationEnergy, InjectedAndAddedIsLeftAndTakenAndHeld) {
  for (const Setting& s : {Setting{{19, 6, 5}, 2, LpvLobes::linear, LpvBorder::open, true},
                           {{9, 6, 5}, 2, LpvLobes::clamp, LpvBorder::periodic, true, Format::f16x4},
                           {{17, 6, 5}, 2, LpvLobes::shrink, LpvBorder::open, false},
                           {{9, 6, 5}, 3, LpvLobes::rescale, LpvBorder::open, true}})
    check(s);
}

TEST(LightPropagationEnergy, OneCell) { check({{1, 1, 1}, 2, LpvLobes::linear, LpvBorder::open, true}); }

}  // namespace
}  // namespace luxel

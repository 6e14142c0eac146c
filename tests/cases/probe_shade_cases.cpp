#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/probe_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kernel = "probe_shade";

struct Maps {
  Values light, moments, positions;
  truth::ProbeScene scene() const { return {light, moments, positions}; }
};

double random(std::size_t i, std::uint32_t seed) { return scene::random01(static_cast<std::uint32_t>(i), seed); }

Maps random_maps(const ProbeShadeParams& p, std::uint32_t seed) {
  Maps m;
  const std::size_t probes = probe_count(p.grid);
  for (std::size_t i = 0; i < 4 * probe_map_texels(probes, p.irradiance_size); ++i) m.light.push_back(static_cast<float>(2 * random(i, seed)));
  for (std::size_t i = 0; i < probe_map_texels(probes, p.moments_size); ++i) {
    m.moments.push_back(static_cast<float>(0.1 + 0.9 * random(i, seed + 1)));
    m.moments.push_back(static_cast<float>(0.2 * random(i, seed + 2)));
  }
  m.positions = probe_positions(p.grid, 0.3, 5, seed + 4);
  return m;
}

ProbeShadeParams params_of(int receivers, std::array<int, 3> count = {3, 2, 4}, bool half = false) {
  ProbeShadeParams p = probe_set_up(count, half).shade;
  p.width = receivers;
  p.count = true;
  return p;
}

double counted(const ProbeLit& lit, ProbeShadeOutcome o) { return lit.counters[static_cast<std::size_t>(o)]; }

Case furnace_case(bool half) {
  return {kernel, fmt::format("even light, {}", half ? "halves" : "f32"), "maps with the same light everywhere give it at every receiver (relative difference)",
          6e-7, [=](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(300, {3, 2, 4}, half);
            p.grid.placed = true;
            Maps m = random_maps(p, 61);
            m.light = even_map(24, 8, {0.75, 3, 1024, 1});
            const auto r = shade(context, p, m.scene(), random_receivers(p.grid, 300, 63));
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < 300; ++i)
              for (std::size_t c = 0; c < 3; ++c)
                most = std::max(most, std::fabs(r.value().irradiance[4 * i + c] / m.light[c] - 1));
            return most;
          }};
}

// From radiance to receivers: pi times what every probe sees everywhere.
Case whole_furnace_case() {
  return {kernel, "furnace", "probes that see the same radiance everywhere light every receiver with pi times it (relative difference)", 2e-6,
          [](Context& context) -> Result<double> {
            ProbeSetUp s = probe_set_up();
            const ProbeSeen seen = random_probes(s.filter, 65);
            Values radiance;
            for (std::size_t i = 0; i < seen.distance.size(); ++i) radiance.insert(radiance.end(), {1, 1, 1, 0});
            const auto maps = filter(context, s.filter, {radiance, seen.distance});
            if (!maps) return maps.status();
            s.shade.width = 300;
            const auto r = shade(context, s.shade, {maps.value().irradiance, maps.value().moments, {}}, random_receivers(s.shade.grid, 300, 67));
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 0; i < r.value().irradiance.size(); ++i)
              if (i % 4 < 3) most = std::max(most, std::fabs(r.value().irradiance[i] / std::numbers::pi - 1));
            return most;
          }};
}

Case hidden_case(bool dark) {
  return {kernel, fmt::format("all eight hidden, {}", dark ? "dark" : "unfiltered"),
          dark ? "a receiver that no probe sees is dark, and is counted (largest value)"
               : "a receiver that no probe sees gets what it would without visibility, and is counted (largest difference)",
          dark ? 1e-30 : 2e-6, [=](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(200);
            p.hidden = dark ? ProbeHidden::dark : ProbeHidden::unfiltered;
            p.footprint = 0;
            Maps m = random_maps(p, 71);
            m.moments = even_map(24, 8, {0x1p-20, 0});
            Values receivers = random_receivers(p.grid, 200, 73);
            const auto r = shade(context, p, m.scene(), receivers);
            p.visibility = false;
            const auto plain = shade(context, p, m.scene(), receivers);
            if (!r) return r.status();
            if (!plain) return plain.status();
            if (counted(r.value(), ProbeShadeOutcome::hidden) != 200) return nan;
            double most = 0;
            for (std::size_t i = 0; i < r.value().irradiance.size(); ++i) {
              const double expected = dark || i % 4 == 3 ? 0 : plain.value().irradiance[i];
              most = std::max(most, std::fabs(r.value().irradiance[i] - expected));
            }
            return most;
          }};
}

Case formula_case(const std::string& name, const char* promise, std::array<int, 3> count, const std::function<void(ProbeShadeParams&, Maps&)>& change,
                  double bound = 2e-5) {  // of quotients of small sums, as in the tests
  return {kernel, name, promise, bound, [=](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(300, count);
            Maps m = random_maps(p, 75);
            change(p, m);
            const Values receivers = random_receivers(p.grid, 300, 77);
            const auto r = shade(context, p, m.scene(), receivers);
            if (!r) return r.status();
            return max_difference(r.value().irradiance, truth::probe_shade_all(p, m.scene(), receivers));
          }};
}

Case at_probes_case(double away) {
  return {kernel, fmt::format("receivers {} of a probe", away == 0 ? "in the place" : fmt::format("{} spacings", away)),
          "see that probe and get its light alone (largest difference)", 1e-6 + 60 * away,  // others weigh three times that, and up to 21 times more where this faces away
          [=](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(24);
            p.normal_bias = 0;
            p.grid.origin = {0, 0, 0};
            p.grid.spacing = {1, 1, 1};
            Maps m = random_maps(p, 79);
            Values receivers;
            for (int i = 0; i < 24; ++i)
              add_probe_receiver(receivers, {i % 3 + away, i / 3 % 2 + away, i / 6 + away}, {0.1 * (i % 5), 0.3, i % 2 - 0.5});
            const auto r = shade(context, p, m.scene(), receivers);
            if (!r) return r.status();
            p.visibility = false;
            p.facing = ProbeFacing::all;
            const Values alone = truth::probe_shade_all(p, m.scene(), receivers);
            double most = 0;
            for (std::size_t i = 0; i < alone.size(); ++i)
              most = std::max(most, std::fabs(r.value().irradiance[i] - (i % 4 == 3 ? 1 : alone[i])));
            return most;
          }};
}

// .476 although nothing of the half that lies at 1 and nothing at 3 is beyond 3.05.
Case chebyshev_case() {
  return {kernel, "half the texels at 1, half at 3, receiver at 3.05", "hidden, but Chebyshev's bound is an upper one: 1 / (1 + 1.05^2), .476 (difference)",
          2e-6, [](Context& context) -> Result<double> {
            ProbeSetUp s = probe_set_up({1, 1, 1});
            s.filter.grid.origin = s.shade.grid.origin = {0, 0, 0};
            s.filter.grid.spacing = s.shade.grid.spacing = {4, 4, 4};
            s.filter.power = 1;
            // Alternating texels: the lobe sees both halves alike.
            ProbeSeen seen;
            for (int y = 0; y < 16; ++y)
              for (int x = 0; x < 16; ++x) {
                seen.distance.push_back((x + y) % 2 == 0 ? 1 : 3);
                seen.radiance.insert(seen.radiance.end(), {1, 1, 1, 0});
              }
            const auto maps = filter(context, s.filter, seen);
            if (!maps) return maps.status();
            s.shade.width = 1;
            s.shade.normal_bias = s.shade.footprint = 0;
            s.shade.sharpen = 1;
            Values receivers;
            add_probe_receiver(receivers, {3.05, 0, 0}, {0, 1, 0});
            const auto r = shade(context, s.shade, {maps.value().irradiance, maps.value().moments, {}}, receivers);
            if (!r) return r.status();
            return std::fabs(r.value().irradiance[3] - 1 / (1 + 1.05 * 1.05));
          }};
}

Case outside_case() {
  return {kernel, "receivers outside the grid, and on its border", "without facing and visibility they get what the nearest point of the grid gets; those outside are counted (largest difference)",
          2e-6, [](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(3 * 64);
            p.visibility = false;
            p.facing = ProbeFacing::all;
            p.grid.origin = {0, 0, 0};
            p.grid.spacing = {1, 1, 1};
            const Maps m = random_maps(p, 81);
            Values outside, inside;
            double beyond = 0;
            for (std::size_t i = 0; i < 3 * 64; ++i) {
              std::array<double, 3> a{}, b{};
              bool is = false;
              for (std::size_t k = 0; k < 3; ++k) {
                const double side = p.grid.count[k] - 1;
                const double v = side * (3 * random(3 * i + k, 83) - 1);
                a[k] = static_cast<float>(i % 3 == 0 ? std::clamp(v, 0.0, side) : i % 3 == 1 ? v : v * 1e9);
                b[k] = std::clamp(a[k], 0.0, side);
                is = is || a[k] != b[k];
              }
              beyond += is;
              add_probe_receiver(outside, a, {0, 1, 0.5});
              add_probe_receiver(inside, b, {0, 1, 0.5});
            }
            const auto x = shade(context, p, m.scene(), outside), y = shade(context, p, m.scene(), inside);
            if (!x) return x.status();
            if (!y) return y.status();
            if (counted(x.value(), ProbeShadeOutcome::outside) != beyond || counted(y.value(), ProbeShadeOutcome::outside) != 0) return nan;
            return max_difference(x.value().irradiance, y.value().irradiance);
          }};
}

Case far_case() {
  return {kernel, "all distances at the far limit", "every probe sees every receiver of its cage (1 - share that is seen)", 0,
          [](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(300, {3, 2, 4}, true);
            Maps m = random_maps(p, 85);
            m.moments = even_map(24, 8, {1.5, 0});
            const auto r = shade(context, p, m.scene(), random_receivers(p.grid, 300, 87, 0));
            if (!r) return r.status();
            double most = 0;
            for (std::size_t i = 3; i < r.value().irradiance.size(); i += 4) most = std::max(most, std::fabs(r.value().irradiance[i] - 1));
            return most;
          }};
}

// A sheet without thickness between dark probes at x = 0 and bright ones at x = 1, seen from probes exactly; receivers on its dark
// side, as near as `away`.
Case sheet_case(double away, double bound) {
  return {kernel, fmt::format("a sheet between dark and bright probes, receivers {} spacings off its dark side", away),
          "light that comes through it, over that of the bright side", bound, [=](Context& context) -> Result<double> {
            ProbeSetUp s = probe_set_up({2, 2, 2});
            s.filter.grid.origin = s.shade.grid.origin = {0, 0, 0};
            s.filter.grid.spacing = s.shade.grid.spacing = {1, 1, 1};
            s.filter.maps.size = 64;
            s.filter.irradiance_size = s.shade.irradiance_size = 8;
            s.filter.moments_size = s.shade.moments_size = 16;
            ProbeSeen seen;
            for (int probe = 0; probe < 8; ++probe)
              for (int y = 0; y < 64; ++y)
                for (int x = 0; x < 64; ++x) {
                  const auto d = truth::octahedral_direction((2 * x + 1) / 64.0 - 1, (2 * y + 1) / 64.0 - 1);
                  const double towards = probe % 2 == 0 ? d[0] : -d[0], light = probe % 2 == 0 ? 0 : 1;
                  seen.distance.push_back(static_cast<float>(towards > 0 ? 0.5 / towards : 1e30));
                  seen.radiance.insert(seen.radiance.end(), {light, light, light, 0});
                }
            const auto maps = filter(context, s.filter, seen);
            if (!maps) return maps.status();
            Values receivers;
            for (int i = 0; i < 256; ++i) add_probe_receiver(receivers, {0.5 - away, (i % 16 + 0.5) / 16, (i / 16 + 0.5) / 16}, {-1, 0, 0});
            s.shade.width = 256;
            const auto r = shade(context, s.shade, {maps.value().irradiance, maps.value().moments, {}}, receivers);
            if (!r) return r.status();
            double sum = 0;
            for (std::size_t i = 0; i < r.value().irradiance.size(); i += 4) sum += r.value().irradiance[i] / 256 / std::numbers::pi;
            return sum;
          }};
}

Case hostile_case() {
  return {kernel, "NaN and infinite receivers, maps and positions",
          "such a receiver is 0; such a probe counts nothing, whatever its other values; each is counted (values that are wrong)", 0,
          [](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(12);
            p.grid.placed = true;
            p.grid.origin = {0, 0, 0};
            p.grid.spacing = {1, 1, 1};
            Maps m = random_maps(p, 91);
            m.positions = probe_positions(p.grid, 0, 0, 1);
            m.moments = even_map(24, 8, {1.5, 0});
            // Probe 0 has no light that is a number, 1 no distance, 3 no place.
            const std::size_t light = 4 * probe_map_texels(1, 8), moments = light / 2;
            for (std::size_t i = 0; i < light; ++i) m.light[i] = i % 2 == 0 ? nan : HUGE_VAL;
            for (std::size_t i = moments; i < 2 * moments; ++i) m.moments[i] = nan;
            m.positions[4 * 3] = nan;
            Maps clean = m;
            for (std::size_t i = 0; i < light; ++i) clean.light[i] = 0;
            for (std::size_t i = 0; i < clean.moments.size(); ++i) clean.moments[i] = i % 2 == 0 ? 1.5 : 0;
            clean.positions[4 * 3] = 0;
            for (const std::size_t probe : {0, 1, 3}) clean.positions[4 * probe + 3] = 0;
            Values receivers;
            for (int i = 0; i < 6; ++i) add_probe_receiver(receivers, {0.3, 0.1 + 0.15 * i, 0.4}, {0, 1, 0});
            add_probe_receiver(receivers, {nan, 0, 0}, {0, 1, 0});
            add_probe_receiver(receivers, {0, HUGE_VAL, 0}, {0, 1, 0});
            add_probe_receiver(receivers, {0.5, 0.5, 0.5}, {0, nan, 0});
            add_probe_receiver(receivers, {0.5, 0.5, 0.5}, {0, 0, 0});
            add_probe_receiver(receivers, {0.5, 0.5, 0.5}, {0, HUGE_VAL, 0});
            add_probe_receiver(receivers, {1e30, 0.5, 0.5}, {0, 1, 0});
            const auto a = shade(context, p, m.scene(), receivers), b = shade(context, p, clean.scene(), receivers);
            if (!a) return a.status();
            if (!b) return b.status();
            double wrong = 0;
            for (std::size_t i = 0; i < 48; ++i) wrong += !(a.value().irradiance[i] == (i < 24 ? b.value().irradiance[i] : 0));
            for (std::size_t i = 0; i < 24; ++i) wrong += !std::isfinite(a.value().irradiance[i]);
            wrong += std::fabs(counted(a.value(), ProbeShadeOutcome::degenerate) - 6) + std::fabs(counted(a.value(), ProbeShadeOutcome::dropped) - 18) +
                     std::fabs(counted(a.value(), ProbeShadeOutcome::receivers) - 12);
            return wrong;
          }};
}

Case dead_case() {
  return {kernel, "dead probes", "count nothing, whatever their maps hold; receivers without a live one are 0 and counted (values that are wrong)", 0,
          [](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(200, {4, 2, 2});
            p.grid.placed = true;
            Maps m = random_maps(p, 95);
            m.positions = probe_positions(p.grid, 0, 0, 1);
            for (std::size_t i = 0; i < 16; ++i) m.positions[4 * i + 3] = i % 4 == 3 ? 1 : 0;  // those at the far end live
            Maps other = m;
            const std::size_t light = 4 * probe_map_texels(1, 8);
            for (std::size_t i = 0; i < other.light.size(); ++i)
              if (i / light % 4 != 3) other.light[i] = nan, other.moments[i / 2] = nan;
            const Values receivers = random_receivers(p.grid, 200, 97, 0);
            const auto a = shade(context, p, m.scene(), receivers), b = shade(context, p, other.scene(), receivers);
            if (!a) return a.status();
            if (!b) return b.status();
            double wrong = count_different(a.value().irradiance, b.value().irradiance), lost = 0;
            for (std::size_t i = 0; i < 200; ++i) {
              const bool is = receivers[8 * i] <= p.grid.origin[0] + 2 * p.grid.spacing[0];
              lost += is;
              wrong += is == (a.value().irradiance[4 * i] != 0);
            }
            return wrong + std::fabs(counted(a.value(), ProbeShadeOutcome::lost) - lost) + counted(b.value(), ProbeShadeOutcome::dropped);
          }};
}

Case scale_case(double scale) {
  return {kernel, fmt::format("a scene scaled by {}", scale), "looks the same (largest difference)", 2e-5, [=](Context& context) -> Result<double> {
            ProbeShadeParams p = params_of(300, {3, 2, 4}, true), q = p;
            const Maps m = random_maps(p, 99);
            Values a = random_receivers(p.grid, 300, 101), b = a;
            for (std::size_t k = 0; k < 3; ++k) q.grid.origin[k] *= scale, q.grid.spacing[k] *= scale;
            for (std::size_t i = 0; i < b.size(); ++i)
              if (i % 8 < 3) b[i] = static_cast<float>(b[i] * scale);
            const auto x = shade(context, p, m.scene(), a), y = shade(context, q, m.scene(), b);
            if (!x) return x.status();
            if (!y) return y.status();
            return max_difference(x.value().irradiance, y.value().irradiance);
          }};
}

}  // namespace

void add_probe_shade_cases(std::vector<Case>& cases) {
  cases.push_back(furnace_case(false));
  cases.push_back(furnace_case(true));
  cases.push_back(whole_furnace_case());
  cases.push_back(hidden_case(false));
  cases.push_back(hidden_case(true));
  cases.push_back(formula_case("two probes in one place", "share what falls to them (difference to the formula)", {3, 2, 4}, [](ProbeShadeParams& p, Maps& m) {
    p.grid.placed = true;
    m.positions = probe_positions(p.grid, 0, 0, 1);
    for (std::size_t i = 0; i < 24; i += 2)
      for (std::size_t k = 0; k < 3; ++k) m.positions[4 * i + k] = m.positions[4 * (i + 1) + k];
  }));
  for (const std::array<int, 3> count : {std::array{1, 5, 1}, {1, 1, 1}, {6, 1, 2}})
    cases.push_back(formula_case(fmt::format("a grid of {}x{}x{}", count[0], count[1], count[2]), "the probe of an axis counts alone (difference to the formula)",
                                 count, [](ProbeShadeParams&, Maps&) {}));
  for (const double away : {0.0, 1e-30, 1e-6, 1e-3}) cases.push_back(at_probes_case(away));
  cases.push_back(chebyshev_case());
  cases.push_back(outside_case());
  cases.push_back(far_case());
  cases.push_back(sheet_case(0, 0.02));
  cases.push_back(sheet_case(0.1, 0.002));
  cases.push_back(hostile_case());
  cases.push_back(dead_case());
  for (const double scale : {1e-3, 1e4}) cases.push_back(scale_case(scale));
}

}  // namespace luxel::cases

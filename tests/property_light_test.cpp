// Contracts of light on random input: a furnace shows nothing but its light, propagation turns with the cube, even probes light evenly.
// On the C++ execution: the others have its bits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/probe_support.h"
#include "tests/support/property.h"
#include "tests/support/run.h"

namespace luxel::cases {
namespace {

using std::numbers::pi;

Context& cpu() { return test_context("cpu"); }

double random(std::size_t index, int seed) { return scene::random01(static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(seed)); }

// What is kept apart from rounding: a mean of up to 6 cones of at most 100 steps, eight probes of 64 texels.
constexpr double mean_rounding = 4e-6;

TEST(PropertyOfLight, ConesInAFurnaceSeeItsLight) {
  for_all({{"side", 2, 12}, {"anisotropic", 0, 1}, {"share of empty voxels, tenths", 0, 10}, {"step, eighths", 2, 16}, {"light", 1, 1000}, {"seed", 0, 1000}},
          300, [](const std::vector<int>& c) -> std::string {
            ConeTraceParams p = cone_params(c[0], c[1] == 0 ? ConeVariant::isotropic : ConeVariant::anisotropic);
            p.width = 5;
            p.step_scale = c[3] / 8.0;
            const double light = c[4] / 16.0;
            p.environment = {light, light, light};
            Values volume;
            for (std::size_t i = 0; i < static_cast<std::size_t>(c[0]) * c[0] * c[0]; ++i) {
              const double a = 10 * random(2 * i, c[5]) < c[2] ? 0 : static_cast<float>(std::pow(random(2 * i + 1, c[5]), 3));
              for (int k = 0; k < 3; ++k) volume.push_back(static_cast<float>(light * a));
              volume.push_back(a);
            }
            const auto r = trace(cpu(), p, volume, cone_receivers(p, p.width, static_cast<std::uint32_t>(c[5])));
            if (!r) return r.status().message();
            for (int i = 0; i < p.width; ++i)
              for (int k = 0; k < 3; ++k) {
                const double off = std::fabs(r.value().irradiance[4 * i + k] / (pi * light) - 1);
                if (!(off <= mean_rounding)) return "receiver " + std::to_string(i) + " is off by " + std::to_string(off);
              }
            return "";
          });
}

TEST(PropertyOfLight, PropagationTurnsWithTheCube) {
  for_all({{"side", 1, 7}, {"steps", 1, 5}, {"form for lobes", 0, 3}, {"blocking", 0, 1}, {"periodic", 0, 1}, {"symmetry", 0, 47}, {"seed", 0, 1000}},
          300, [](const std::vector<int>& c) -> std::string {
            LpvPropagateParams p = lpv_params({c[0], c[0], c[0]}, 2, all_lobes[c[2]]);
            p.iterations = c[1];
            p.geometry = c[3] != 0;
            // A surfel's corner belongs to one side alone where the grid is periodic: what turns then is not the same volume.
            if (c[4] != 0 && !p.geometry) p.border = LpvBorder::periodic;
            const auto seed = static_cast<std::uint32_t>(c[6]);
            const Values light = lpv_lights(p.grid, 2, 4, seed), blocks = p.geometry ? lpv_surfels(p.grid, 1.5, seed + 1) : Values();
            const auto plain = propagate(cpu(), p, light, blocks);
            const auto got = propagate(cpu(), p, lpv_turned(light, c[0], c[5]), p.geometry ? lpv_turned(blocks, c[0] + 1, c[5]) : Values());
            if (!plain) return plain.status().message();
            if (!got) return got.status().message();
            double scale = 1e-30;
            for (const double v : plain.value()) scale = std::max(scale, std::fabs(v));
            const double off = max_difference(got.value(), lpv_turned(plain.value(), c[0], c[5])) / scale;
            return off <= mean_rounding ? "" : "off by " + std::to_string(off) + " of the largest";
          });
}

TEST(PropertyOfLight, EvenProbesLightEvenly) {
  for_all({{"probes along x", 1, 4}, {"along y", 1, 3}, {"along z", 1, 4}, {"every so many dead", 0, 5}, {"jitter, tenths", 0, 4}, {"light", 1, 1000}, {"seed", 0, 1000}},
          300, [](const std::vector<int>& c) -> std::string {
            ProbeSetUp s = probe_set_up({c[0], c[1], c[2]});
            const auto seed = static_cast<std::uint32_t>(c[6]);
            const double light = c[5] / 16.0;
            ProbeSeen seen = random_probes(s.filter, seed);
            for (std::size_t i = 0; i < seen.radiance.size(); ++i) seen.radiance[i] = i % 4 < 3 ? light : 1;
            const auto maps = filter(cpu(), s.filter, seen);
            if (!maps) return maps.status().message();
            s.shade.width = 12;
            s.shade.height = 1;
            s.shade.grid.placed = true;
            // One probe at least lives where every second or later one is dead.
            const Values positions = probe_positions(s.shade.grid, c[4] / 10.0, c[3] == 1 ? 2 : c[3], seed);
            bool alive = false;
            for (std::size_t i = 3; i < positions.size(); i += 4) alive = alive || positions[i] != 0;
            if (!alive) return "";
            const auto lit = shade(cpu(), s.shade, {maps.value().irradiance, maps.value().moments, positions}, random_receivers(s.shade.grid, 12, seed));
            if (!lit) return lit.status().message();
            for (std::size_t i = 0; i < 12; ++i) {
              if (c[3] != 0 && lit.value().irradiance[4 * i] == 0) continue;  // all probes of its cage are dead
              for (std::size_t k = 0; k < 3; ++k) {
                const double off = std::fabs(lit.value().irradiance[4 * i + k] / (pi * light) - 1);
                if (!(off <= mean_rounding)) return "receiver " + std::to_string(i) + " is off by " + std::to_string(off);
              }
            }
            return "";
          });
}

}  // namespace
}  // namespace luxel::cases

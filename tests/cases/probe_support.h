// What the cases and tests of probe_irradiance and probe_shade share.
#pragma once
#include <span>
#include <vector>

#include <luxel/probe_irradiance.h>
#include <luxel/probe_shade.h>

#include "bench/truth/probe_light_truth.h"
#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

/// Radiance (4 a texel) and distance of maps, as values; packed as the parameters' formats say.
struct ProbeSeen {
  Values radiance, distance;
};
/// Floats of all kinds, the same on every machine: radiance to 3, distances to 2 diagonals of a cage.
ProbeSeen random_probes(const ProbeIrradianceParams& params, std::uint32_t seed);
/// Words of r11g11b10, made of 3 codes of 4 values each; and the values that they stand for.
Values pack_r11g11b10(std::span<const double> rgba);
Values unpack_r11g11b10(std::span<const double> words);
/// Halves, two to a word.
Values pack_f16(std::span<const double> values);

struct ProbeFiltered {
  Values irradiance, moments;  // with borders; empty where not wanted
};
/// Runs probe_irradiance. `radiance`, `distance`: as the formats hold them (words as values). What no probe of the list makes
/// holds the value 7.
Result<ProbeFiltered> filter(Context& context, const ProbeIrradianceParams& params, const ProbeSeen& seen, const Values& list = {},
                             const ProbeFiltered& previous = {});

struct ProbeLit {
  Values irradiance, counters;
};
Result<ProbeLit> shade(Context& context, const ProbeShadeParams& params, const truth::ProbeScene& scene, std::span<const double> receivers);

/// Parameters of both parts that belong together: 3 x 2 x 4 probes or what is given, 16 x 16 texels seen, maps of 8 + border.
struct ProbeSetUp {
  ProbeIrradianceParams filter;
  ProbeShadeParams shade;
};
ProbeSetUp probe_set_up(std::array<int, 3> count = {3, 2, 4}, bool half = false);

/// Maps of moments and irradiance with the same values everywhere.
Values even_map(std::size_t probes, int size, std::vector<double> texel);

/// Receivers in and around a grid, all kinds of normals, floats.
Values random_receivers(const ProbeGrid& grid, int count, std::uint32_t seed, double beyond = 0.2);
void add_probe_receiver(Values& receivers, std::array<double, 3> position, std::array<double, 3> normal);

/// Positions of a grid's probes, 4 a probe: moved by up to `jitter` spacings; every `dead`th (0: none) is dead.
Values probe_positions(const ProbeGrid& grid, double jitter, int dead, std::uint32_t seed);

/// Cases in these files, in the order of probe_cases().
void add_probe_filter_cases(std::vector<Case>& cases);
void add_probe_shade_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

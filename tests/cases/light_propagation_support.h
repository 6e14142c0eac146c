// What the cases and tests of light_propagation share.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <luxel/light_propagation.h>

#include "bench/truth/lpv_truth.h"
#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

/// Parameters of one channel with the injected light left out of the result.
LpvPropagateParams lpv_params(std::array<int, 3> extent, int bands = 2, LpvLobes lobes = LpvLobes::linear);

/// The result of a device for light volumes in pixels of four (all channels), as it lies in memory.
Result<Values> propagate(Context& context, const LpvPropagateParams& params, std::span<const double> injected,
                         std::span<const double> geometry = {});

/// Cosine lobes of random direction and flux in about one of `every` cells; cells x coefficients, one channel.
Values lpv_lights(const LpvGrid& grid, int bands, int every, std::uint32_t seed);

/// Blocking by random surfels on the corners, up to `most` times a whole face; [k][j][i][4].
Values lpv_surfels(const LpvGrid& grid, double most, std::uint32_t seed);

/// Coefficient i of flux / pi <n|w>+.
double lpv_cosine(int i, const std::array<double, 3>& n, double flux);

/// Sum of c0 over the cells of light volumes of one channel.
double lpv_flux(std::span<const double> pixels, std::size_t cells);

/// A cube of side^3 pixels of two bands under one of the cube's 48 symmetries: axes permuted and turned round.
Values lpv_turned(const Values& pixels, int side, int symmetry);

constexpr LpvLobes all_lobes[] = {LpvLobes::linear, LpvLobes::clamp, LpvLobes::shrink, LpvLobes::rescale};
const char* name(LpvLobes lobes);

}  // namespace luxel::cases

// The propagation of light through a grid of cells by its definition, in double: thirty faces with their solid angles and
// directions, lobes by quadrature-free closed forms, one cell after the other.
#pragma once
#include <array>
#include <span>
#include <vector>

#include <luxel/light_propagation.h>

namespace luxel::truth {

/// Where the flux of one step went. Fluxes are in units of c0 (times 1 / Y0 for flux).
struct LpvLedger {
  double held = 0;      // in the grid after the step
  double left = 0;      // through the grid's border
  double absorbed = 0;  // by the geometry volume
  double clamped = 0;   // added by leaving out negative fluxes
};

struct LpvStep {
  std::vector<double> light;  // cells x coefficients, [z][y][x][i]
  LpvLedger ledger;
};

/// Coefficients a cell has: 4 or 9.
int lpv_coefficients(int bands);

/// What one step makes of `light` (one channel). `geometry`: [k][j][i][4] on the corners, or empty. `factor`: of a face's
/// flux in units of its solid angle; 1 is right, 1 / (4 pi) is what is sometimes printed.
LpvStep lpv_step(const LpvGrid& grid, int bands, LpvLobes lobes, LpvBorder border, std::span<const double> light,
                 std::span<const double> geometry, double factor = 1);

/// The sum over `iterations` steps as lpv_propagate has it, one channel. `ledgers`: of each step, where given.
std::vector<double> lpv_propagated(const LpvPropagateParams& params, std::span<const double> injected,
                                   std::span<const double> geometry, std::vector<LpvLedger>* ledgers = nullptr);

/// Between coefficients one after the other for each cell (one channel) and pixels of four as light volumes hold them.
std::vector<double> lpv_to_pixels(const LpvGrid& grid, int bands, std::span<const double> light);
std::vector<double> lpv_from_pixels(const LpvGrid& grid, int bands, std::span<const double> pixels);

/// Solid angle of the far face of a neighbour, and of one of its sides.
std::array<double, 2> lpv_solid_angles();

}  // namespace luxel::truth

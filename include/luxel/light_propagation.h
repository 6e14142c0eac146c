/// \file
/// light_propagation: light of many small sources carried through a grid of cells as spherical harmonics (Kaplanyan and
/// Dachsbacher, Cascaded Light Propagation Volumes for Real-Time Indirect Illumination, 2010).
///
/// A light volume holds for every cell the intensity of the light that passes through it, I(w) = sum over i of c_i Y_i(w), flux
/// per steradian, in the basis of kernels/math/sh.h. In the flat order: c0 (band 0), c1 (y), c2 (z), c3 (x), c4 (xy), c5 (yz),
/// c6 (3 z^2 - 1), c7 (xz), c8 (x^2 - y^2). The flux through a cell is the integral of I: c0 / Y0 = 3.5449077 c0. As radiance
/// it counts I(w) / cell^2, so that irradiance on a surface of normal n (light arrives along w, against n) is
/// sum c_i sh_cosine(i, -n) / cell^2: w points the way that light goes.
///
/// In memory: four coefficients a pixel. 2 bands: pixel (c0, c1, c2, c3) a cell. 3 bands: three volumes one after the other,
/// (c0..c3), (c4..c7), (c8, 0, 0, 0): the first is a volume of 2 bands. Volumes are [z][y][x]; channels (red, green, blue) follow
/// each other in one buffer. So coefficient i of channel c in cell (x, y, z) is component i % 4 of pixel
/// (((c quads + i / 4) depth + z) height + y) width + x, quads = 1 or 3.
///
/// The geometry volume holds blocking: one channel, 2 bands, B(w) = sum b_i Y_i(w) for surfels whose normal is along w,
/// without unit (area over cell^2). It is shifted by half a cell: its pixel (i, j, k), 0..width x 0..height x 0..depth, lies
/// on the corner origin + cell (i, j, k) of the grid. Extent: one more than the grid's. Light that moves along w meets B(-w),
/// taken at the middle of the face between two cells (the mean of its four corners) and clamped to 0..1.
#pragma once
#include <luxel/plan.h>

namespace luxel {

/// Cells of a grid in space.
struct LpvGrid {
  std::array<int, 3> extent{0, 0, 0};      ///< cells along x, y, z, 1..1024 each
  std::array<double, 3> origin{0, 0, 0};   ///< outer corner of cell (0, 0, 0), scene units
  double cell = 1;                         ///< side of a cell, scene units, above 0
};

/// Pixels of four coefficients of a light volume, all channels. bands: 2 or 3.
std::size_t lpv_pixels(const LpvGrid& grid, int bands, int channels);
/// Pixels of four coefficients of a geometry volume.
std::size_t lpv_geometry_pixels(const LpvGrid& grid);

// lpv_propagate --------------------------------------------------------------------------------------------------------

/// What is done where a lobe of few bands is negative.
enum class LpvLobes {
  linear,  ///< nothing, the least error as well as the fastest: the step is a constant matrix a neighbour. Flux is kept, growth is at most 1
  clamp,   ///< negative fluxes count as none, the published form. Adds 11 to 14 % of flux in the first step
  shrink,  ///< band 1 (and 2) of a cell are scaled down until no direction is negative. Flux is kept
  rescale  ///< as clamp, then the thirty fluxes of a cell are scaled so that their sum is the linear one. Flux is kept
};

/// What lies beyond the grid.
enum class LpvBorder {
  open,     ///< nothing: light leaves
  periodic  ///< the opposite side
};

/// Light goes from cell to cell, so many steps.
struct LpvPropagateParams {
  LpvGrid grid;                           ///< origin and cell have no influence: a step is a cell
  int bands = 2;                          ///< 2 or 3
  int channels = 3;                       ///< 1..4 volumes one after the other; equal channels need one
  Format format = Format::f32x4;          ///< of injected and result: f32x4 or f16x4; between steps light is f32
  int iterations = 8;                     ///< steps, 1..1000
  LpvLobes lobes = LpvLobes::linear;  ///< negative lobes
  LpvBorder border = LpvBorder::open;  ///< what lies beyond the grid
  bool geometry = false;                  ///< a geometry volume blocks, from the second step on
  bool continued = false;                 ///< injected has travelled already: the first step is blocked too
  Format geometry_format = Format::f32x4; ///< f32x4 or f16x4
  bool keep_injected = true;              ///< result holds the injected light as well as that of every step
  bool active = false;                    ///< works only where light has come: one ring of cells more a step
  double error = 0;                       ///< active: no further steps when the largest c0 that travels is at most this share
                                          ///< of the largest injected; 0..0.5, 0: all steps
  bool travelling = false;                ///< adds `travelling`: the light after the last step, to go on from
  bool energy = false;                    ///< adds `energy`: where light went; not with active
};

/// Resources: `injected` (read), `geometry` (read; with geometry), `result` (written): the sum over steps of the light that
/// travels; `travelling` (written; where asked for); `energy` (written; where asked for): a vec4 a cell of each channel, in
/// units of c0 (3.5449077 times it is flux): light that left the grid from this cell, that blocking took where it came into
/// it, that leaving out negative fluxes added to it (clamp alone), over all steps; and what it holds at the end. Over all
/// cells injected + added = left + taken + held. Scratch: Plan::scratch_bytes; lpv_propagate needs nothing cleared.
/// A coefficient that is not finite spreads by one ring of cells a step and no further.
/// Errors: invalid_argument, naming field, value and range.
Status validate(const LpvPropagateParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const LpvPropagateParams& params, const Profile& profile);

}  // namespace luxel

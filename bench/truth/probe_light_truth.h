// What maps of probes and receivers lit by them should be: quadrature and the formulas written out, in double.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <vector>

#include <luxel/probe_irradiance.h>
#include <luxel/probe_shade.h>

#include "bench/truth/probe_truth.h"

namespace luxel::truth {

/// `visit(direction, solid angle)` for points of a map of size x size texels, each texel by `parts` x `parts` points:
/// the middles of equal parts of the map, with its exact area element.
void over_sphere(int size, int parts, const std::function<void(int texel, const std::array<double, 3>&, double)>& visit);

/// Irradiance on a surface of unit normal n under a radiance of directions, by quadrature over 2^22 points or so.
using Radiance = std::function<std::array<double, 3>(const std::array<double, 3>&)>;
std::array<double, 3> probe_irradiance(const Radiance& radiance, const std::array<double, 3>& n, int size = 256, int parts = 4);
/// Of a map that is even within its texels ([size][size][4]).
std::array<double, 3> probe_irradiance(int size, std::span<const double> radiance, const std::array<double, 3>& n, int parts = 16);

/// Mean and standard deviation of a map of distances ([size][size]), in units and clamped as the parameters say, weighted by the
/// power of the cosine.
std::array<double, 2> probe_moments(const ProbeIrradianceParams& params, std::span<const double> distance,
                                    const std::array<double, 3>& n, int parts = 8);

/// The formula of probe_shade, for one receiver (position, normal; 8 values). `light`, `moments`: maps with their borders, as the
/// kernel reads them; `positions`: 4 a probe, where the grid is placed.
struct ProbeScene {
  std::span<const double> light, moments, positions;
};
std::array<double, 4> probe_shade(const ProbeShadeParams& params, const ProbeScene& scene, std::span<const double> receiver);

/// The same for all receivers, [n][4].
std::vector<double> probe_shade_all(const ProbeShadeParams& params, const ProbeScene& scene, std::span<const double> receivers);

}  // namespace luxel::truth

// What cones should gather: rays in double through the finest voxels, each a homogeneous cell, without any pyramid.
#pragma once
#include <array>
#include <functional>
#include <span>
#include <vector>

#include <luxel/cone_trace.h>

namespace luxel::truth {

/// Premultiplied radiance and opacity, [z][y][x][4]. Opacity 0 with radiance is emission.
struct Voxels {
  std::array<int, 3> extent{1, 1, 1};
  std::span<const double> values;
};

/// Along a ray from p (in voxels) in the unit direction d, between the distances start and reach (voxels): radiance,
/// occlusion weighted by 1 / (1 + gamma r) with r in voxels, and the transmittance that is left.
struct Seen {
  std::array<double, 3> radiance{};
  double occlusion = 0;
  double transmittance = 1;
};
Seen see(const Voxels& voxels, const std::array<double, 3>& p, const std::array<double, 3>& d, double start, double reach,
         double gamma);

using Radiance = std::function<std::array<double, 3>(const std::array<double, 3>&)>;

/// Irradiance and visibility of each receiver ([n][8], as luxel::ConeTraceParams has them), by `rays` directions
/// distributed as the cosine, with the params' own offset, start, distance, gamma and
/// environment (a sky where `sky` gives the radiance of unit directions); [n][4].
/// `halves` (optional): the same by two sets of half as many directions, [2][n][4], of which the result is the mean.
std::vector<double> irradiance(const ConeTraceParams& params, const Voxels& voxels, std::span<const double> receivers,
                               int rays, std::vector<double>* halves = nullptr,
                               const Radiance& sky = {});

/// Mean radiance and visibility of a cap of full angle `aperture` around a direction, uniform over the cap.
std::array<double, 4> cap(const ConeTraceParams& params, const Voxels& voxels, const std::array<double, 3>& position,
                          const std::array<double, 3>& normal, const std::array<double, 3>& direction, double aperture,
                          int rays);

}  // namespace luxel::truth

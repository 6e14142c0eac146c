// Lights, surfels and receivers of light volumes, for cases and tests, and what they come to in double.
#pragma once
#include <array>
#include <vector>

#include <luxel/lpv_inject.h>
#include <luxel/lpv_sample.h>

#include "tests/cases/run.h"

namespace luxel::cases::lpv {

using Vec = std::array<double, 3>;
using Values = std::vector<double>;

/// Float keeps 24 bits through about a dozen operations.
constexpr double float_bound = 16 * 0x1p-24;

/// 0..1 by a hash.
double uniform(std::uint32_t i);
/// A unit vector by a hash, each component a float.
Vec direction(std::uint32_t i);
double inner(const Vec& a, const Vec& b);

struct Light {
  Vec place{0, 0, 0}, normal{0, 1, 0}, flux{1, 1, 1};
};
struct Surfel {
  Vec place{0, 0, 0}, normal{0, 1, 0};
  double area = 1;
};

/// The resources `lights`, `surfels` and `receivers`; every value a float.
Values list_of(const std::vector<Light>& lights);
Values list_of(const std::vector<Surfel>& surfels);
Values receivers_at(const std::vector<Surfel>& places);

/// Lights whose places, once moved by half a cell, lie at least 0.01 cells off every face. Cells of 1 from (0, 0, 0).
std::vector<Light> random_lights(int count, const std::array<int, 3>& extent, std::uint32_t seed);
std::vector<Surfel> random_surfels(int count, const std::array<int, 3>& extent, std::uint32_t seed);

/// A grid of cells of 1 from (0, 0, 0).
LpvGrid grid_of(int width, int height, int depth);

/// Coefficient i of <n|w>+ in closed form: sqrt(pi)/2, sqrt(pi/3) n, and of band 2 sqrt(15 pi)/8 and sqrt(5 pi)/16 times its
/// polynomials. Without n the mean over all n.
double cosine_lobe(int i, const Vec& n);

/// What the kernels write, and their outcomes where asked for.
Result<Values> injected(Context& context, LpvInjectParams p, const Values& lights, Values* outcomes = nullptr);
Result<Values> injected_geometry(Context& context, LpvInjectGeometryParams p, const Values& surfels,
                                 const Values& kept = {}, Values* outcomes = nullptr);
struct Sampled {
  Values irradiance, specular, outcomes;
};
Result<Sampled> sampled(Context& context, LpvSampleParams p, const Values& light, const Values& receivers,
                        const Values& views = {});
Result<Values> filtered(Context& context, const LpvFilterParams& p, const Values& volume);

/// The light volume, and the geometry volume of one source, in long double.
Values injected_truth(const LpvInjectParams& p, const std::vector<Light>& lights);
Values geometry_truth(const LpvInjectGeometryParams& p, const std::vector<Surfel>& surfels);
/// Irradiance by one cascade without damping, 4 a receiver.
Values sampled_truth(const LpvSampleParams& p, const Values& light, const Values& receivers);

/// A turn or mirror of the cube's 48: axis a goes to axis to[a], times sign[a].
struct Turn {
  std::array<int, 3> to;
  std::array<double, 3> sign;
  Vec of(const Vec& v) const {
    Vec r{};
    for (std::size_t a = 0; a < 3; ++a) r[static_cast<std::size_t>(to[a])] = sign[a] * v[a];
    return r;
  }
  /// Of a place in a cube whose side is `side`.
  Vec about(const Vec& v, double side) const {
    Vec r = of({v[0] - side / 2, v[1] - side / 2, v[2] - side / 2});
    for (double& c : r) c += side / 2;
    return r;
  }
};
std::vector<Turn> turns();

/// Largest |a - b| over the largest |b|.
double relative_error(const Values& a, const Values& b);

}  // namespace luxel::cases::lpv

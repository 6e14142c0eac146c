#include "bench/truth/ssr_lobe.h"

#include <cmath>
#include <numbers>

namespace luxel::truth {
namespace {

// Smith's Lambda of GGX.
double lambda(double cosine, double alpha) {
  const double tan2 = 1 / (cosine * cosine) - 1;
  return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

}  // namespace

std::array<double, 2> split_sum(double cosine, double alpha, int steps) {
  const double sine = std::sqrt(1 - cosine * cosine);
  double a = 0, b = 0;
  for (int i = 0; i < steps; ++i) {
    // D cos has tan^2 = alpha^2 u / (1 - u) for even u; u = 1 - x^3 lays more steps into the long tail.
    const double x = (i + 0.5) / steps, rest = x * x * x, tan2 = alpha * alpha * (1 - rest) / rest;
    const double h_z = 1 / std::sqrt(1 + tan2), h_r = std::sqrt(tan2) * h_z;
    for (int j = 0; j < steps; ++j) {
      const double phi = std::numbers::pi * (j + 0.5) / steps;  // the other half mirrors it
      const double v_h = sine * h_r * std::cos(phi) + cosine * h_z, l_z = 2 * v_h * h_z - cosine;
      if (v_h <= 0 || l_z <= 0) continue;
      const double weight =
          3 * x * x * v_h / (cosine * h_z * (1 + lambda(cosine, alpha) + lambda(l_z, alpha)));
      const double fresnel = std::pow(1 - v_h, 5);
      a += (1 - fresnel) * weight;
      b += fresnel * weight;
    }
  }
  const double n = static_cast<double>(steps) * steps;
  return {a / n, b / n};
}

}  // namespace luxel::truth

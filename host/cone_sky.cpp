#include <algorithm>
#include <cmath>
#include <numbers>

#include <luxel/cone_trace.h>

namespace luxel {
namespace {

using Vec = std::array<double, 3>;

// The direction at a point of the octahedral map (-1..1), where kernels/math/octahedral.h has it.
Vec direction_at(double x, double y) {
  const double z = 1 - std::fabs(x) - std::fabs(y);
  Vec d{x, y, z};
  if (z < 0) d = {std::copysign(1 - std::fabs(y), x), std::copysign(1 - std::fabs(x), y), z};
  const double length = std::hypot(d[0], d[1], d[2]);
  for (double& c : d) c /= length;
  return d;
}

// Direction k of `count` that lie evenly over a cap around n: equal shares of the solid angle, the golden angle apart.
Vec in_cap(const Vec& n, double cosine, int k, int count) {
  const double z = 1 - (1 - cosine) * (k + 0.5) / count, r = std::sqrt(std::max(0.0, 1 - z * z));
  const double turn = k * std::numbers::pi * (3 - std::sqrt(5.0));
  // A frame without a seam but at -z (Duff et al., Building an Orthonormal Basis, Revisited, JCGT 2017).
  const double sign = std::copysign(1.0, n[2]), a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  const Vec u{1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]}, v{b, sign + n[1] * n[1] * a, -n[1]};
  Vec d;
  for (std::size_t i = 0; i < 3; ++i) d[i] = r * std::cos(turn) * u[i] + r * std::sin(turn) * v[i] + z * n[i];
  return d;
}

}  // namespace

std::vector<float> cone_sky(const ConeTraceParams& p, const std::function<Vec(const Vec&)>& radiance, int rays) {
  std::vector<float> texels;
  for (int level = 0; level < p.sky_levels; ++level) {
    const double cosine = std::cos(std::ldexp(p.sky_aperture, -level) / 2);
    for (int j = 0; j < p.sky_size; ++j)
      for (int i = 0; i < p.sky_size; ++i) {
        const Vec n = direction_at(2.0 * i / (p.sky_size - 1) - 1, 2.0 * j / (p.sky_size - 1) - 1);
        Vec sum{};
        for (int k = 0; k < rays; ++k) {
          const Vec seen = radiance(in_cap(n, cosine, k, rays));
          for (std::size_t c = 0; c < 3; ++c) sum[c] += seen[c];
        }
        for (const double c : sum) texels.push_back(static_cast<float>(c / rays));
        texels.push_back(0);
      }
  }
  return texels;
}

}  // namespace luxel

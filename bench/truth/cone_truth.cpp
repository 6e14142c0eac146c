#include "bench/truth/cone_truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

namespace luxel::truth {
namespace {

using Vec = std::array<double, 3>;
using std::numbers::pi;

Vec unit(const Vec& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

// Base 2 digits of i, mirrored at the point.
double radical_inverse(std::uint32_t i) {
  double sum = 0;
  for (double digit = 0.5; i != 0; i >>= 1, digit /= 2) sum += digit * (i & 1u);
  return sum;
}

// Two unit vectors that stand on n and each other.
std::array<Vec, 2> frame(const Vec& n) {
  const Vec axis = std::fabs(n[0]) < 0.6 ? Vec{1, 0, 0} : Vec{0, 1, 0};
  const Vec a = unit({n[1] * axis[2] - n[2] * axis[1], n[2] * axis[0] - n[0] * axis[2], n[0] * axis[1] - n[1] * axis[0]});
  return {a, Vec{n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]}};
}

Vec tilted(const std::array<Vec, 2>& f, const Vec& n, double cosine, double angle) {
  const double s = std::sqrt(std::max(0.0, 1 - cosine * cosine)), x = s * std::cos(angle), y = s * std::sin(angle);
  Vec d;
  for (int i = 0; i < 3; ++i) d[i] = x * f[0][i] + y * f[1][i] + cosine * n[i];
  return d;
}

struct Place {
  Vec position, normal;  // voxels
  bool good;
};

Place place_of(const ConeTraceParams& p, std::span<const double> r) {
  Place place;
  const Vec n{r[4], r[5], r[6]};
  place.good = std::isfinite(r[0] + r[1] + r[2]) && std::isfinite(n[0] + n[1] + n[2]) &&
               std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])}) >= 1e-30;
  if (!place.good) return place;
  place.normal = unit(n);
  for (int i = 0; i < 3; ++i)
    place.position[i] = (r[static_cast<std::size_t>(i)] - p.origin[i]) / p.voxel + p.normal_offset * place.normal[i];
  return place;
}

double reach_of(const ConeTraceParams& p) { return p.max_distance > 0 ? p.max_distance / p.voxel : 1e300; }

std::array<double, 4> with_environment(const ConeTraceParams& p, const Seen& s, const Vec& d, const Radiance& sky) {
  const Vec behind = sky ? sky(d) : Vec{1, 1, 1};
  std::array<double, 4> v;
  for (std::size_t c = 0; c < 3; ++c) v[c] = s.radiance[c] + s.transmittance * p.environment[c] * behind[c];
  v[3] = s.occlusion;
  return v;
}

template <class Work>
void in_parallel(std::size_t count, Work work) {
  std::atomic<std::size_t> next{0};
  const auto loop = [&] {
    for (std::size_t i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) others.emplace_back(loop);
  loop();
}

}  // namespace

Seen see(const Voxels& voxels, const Vec& p, const Vec& d, double start, double reach, double gamma) {
  Seen seen;
  double from = start, to = reach;
  for (int i = 0; i < 3; ++i) {
    const double n = voxels.extent[i];
    if (d[i] == 0) {
      if (p[i] < 0 || p[i] > n) return seen;
      continue;
    }
    const double a = -p[i] / d[i], b = (n - p[i]) / d[i];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  if (!(from < to)) return seen;
  int cell[3], step[3];
  double next[3], each[3];  // distance to the next wall of cells along each axis, and from wall to wall
  for (int i = 0; i < 3; ++i) {
    const double at = p[i] + from * d[i];
    cell[i] = std::clamp(static_cast<int>(std::floor(at)), 0, voxels.extent[i] - 1);
    step[i] = d[i] > 0 ? 1 : -1;
    each[i] = d[i] == 0 ? 1e300 : 1 / std::fabs(d[i]);
    next[i] = d[i] == 0 ? 1e300 : (cell[i] + (d[i] > 0 ? 1 : 0) - p[i]) / d[i];
  }
  for (double t = from; t < to;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const double leave = std::min(next[axis], to), chord = std::max(0.0, leave - t);
    const std::size_t at = (static_cast<std::size_t>(cell[2]) * voxels.extent[1] + cell[1]) * voxels.extent[0] + cell[0];
    const double* v = &voxels.values[at * 4];
    const double depth = v[3] >= 1 ? 1e300 : -std::log1p(-v[3]);  // optical depth of a voxel's width
    const double hidden = chord > 0 ? -std::expm1(-depth * chord) : 0;
    const double part = v[3] > 0 ? hidden / v[3] : chord;
    for (int c = 0; c < 3; ++c) seen.radiance[c] += seen.transmittance * part * v[c];
    if (hidden > 0) {
      // In pieces along the chord, since the weight changes with distance.
      const int pieces = gamma > 0 && v[3] < 1 ? 8 : 1;
      double through = seen.transmittance;
      for (int i = 0; i < pieces; ++i) {
        const double r = v[3] >= 1 ? t : t + chord * (i + 0.5) / pieces;
        const double blocked = through * -std::expm1(-depth * chord / pieces);
        seen.occlusion += blocked / (1 + gamma * r);
        through -= blocked;
      }
    }
    seen.transmittance *= 1 - hidden;
    if (seen.transmittance <= 0) break;
    t = leave;
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= voxels.extent[axis]) break;
    next[axis] += each[axis];
  }
  return seen;
}

std::vector<double> irradiance(const ConeTraceParams& p, const Voxels& voxels, std::span<const double> receivers,
                               int rays, std::vector<double>* halves, const Radiance& sky) {
  const std::size_t count = receivers.size() / 8;
  std::vector<double> result(count * 4);
  if (halves) halves->assign(2 * count * 4, 0);
  in_parallel(count, [&](std::size_t i) {
    const Place place = place_of(p, receivers.subspan(i * 8, 8));
    if (!place.good) return;
    const auto f = frame(place.normal);
    std::array<std::array<double, 4>, 2> sums{};
    // Each half is a Hammersley set of its own, the second moved along both axes.
    const int each = (rays + 1) / 2;
    for (std::size_t h = 0; h < 2; ++h)
      for (int k = 0; k < each; ++k) {
        const double u = (k + (h == 0 ? 0.25 : 0.75)) / each;
        const double turn = radical_inverse(static_cast<std::uint32_t>(k)) + (h == 0 ? 0 : 0.6180339887498949);
        const Vec d = tilted(f, place.normal, std::sqrt(1 - u), 2 * pi * turn);
        const auto v = with_environment(
            p, see(voxels, place.position, d, p.start, reach_of(p), p.gamma * p.voxel), d, sky);
        for (int c = 0; c < 4; ++c) sums[h][c] += v[c];
      }
    for (int c = 0; c < 4; ++c) {
      const auto out = [&](double mean) { return c < 3 ? pi * mean : 1 - mean; };
      result[i * 4 + c] = out((sums[0][c] + sums[1][c]) / (2 * each));
      for (std::size_t h = 0; halves && h < 2; ++h) (*halves)[(h * count + i) * 4 + c] = out(sums[h][c] / each);
    }
  });
  return result;
}

std::array<double, 4> cap(const ConeTraceParams& p, const Voxels& voxels, const Vec& position, const Vec& normal,
                          const Vec& direction, double aperture, int rays) {
  const std::array<double, 8> receiver{position[0], position[1], position[2], 0, normal[0], normal[1], normal[2], 0};
  const Place place = place_of(p, receiver);
  std::array<double, 4> sum{};
  if (!place.good) return sum;
  const Vec axis = unit(direction);
  const auto f = frame(axis);
  for (int k = 0; k < rays; ++k) {
    const double cosine = 1 - (1 - std::cos(aperture / 2)) * (k + 0.5) / rays;
    const Vec d = tilted(f, axis, cosine, 2 * pi * radical_inverse(static_cast<std::uint32_t>(k)));
    const auto v =
        with_environment(p, see(voxels, place.position, d, p.start, reach_of(p), p.gamma * p.voxel), d, {});
    for (int c = 0; c < 4; ++c) sum[c] += v[c] / rays;
  }
  sum[3] = 1 - sum[3];
  return sum;
}

}  // namespace luxel::truth

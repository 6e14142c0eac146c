#include "bench/truth/lpv_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace luxel::truth {
namespace {

using Vec = std::array<double, 3>;
constexpr double pi = std::numbers::pi;

double y(int i, const Vec& d) {
  const double k1 = std::sqrt(3 / (4 * pi)), k2 = std::sqrt(15 / (4 * pi));
  switch (i) {
    case 0: return std::sqrt(1 / (4 * pi));
    case 1: return k1 * d[1];
    case 2: return k1 * d[2];
    case 3: return k1 * d[0];
    case 4: return k2 * d[0] * d[1];
    case 5: return k2 * d[1] * d[2];
    case 6: return k2 / std::sqrt(12.0) * (2 * d[2] * d[2] - d[0] * d[0] - d[1] * d[1]);
    case 7: return k2 * d[0] * d[2];
    default: return k2 / 2 * (d[0] * d[0] - d[1] * d[1]);
  }
}

// Coefficient i of the cosine lobe <n|w>+.
double cosine(int i, const Vec& n) { return (i == 0 ? pi : i < 4 ? 2 * pi / 3 : pi / 4) * y(i, n); }

struct Face {
  std::array<int, 3> towards;  // the neighbour that receives, from the cell that sends
  Vec direction;               // from the sending cell's middle to the middle of the face
  Vec normal;
  double angle;                // sr
};

std::vector<Face> thirty_faces() {
  const auto [front, side] = lpv_solid_angles();
  std::vector<Face> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const int way : {1, -1}) {
      std::array<int, 3> to{};
      to[static_cast<std::size_t>(axis)] = way;
      const Vec m = {double(to[0]), double(to[1]), double(to[2])};
      all.push_back({to, m, m, front});
      for (int across = 0; across < 3; ++across)
        for (const int up : {1, -1}) {
          if (across == axis) continue;
          Vec n{}, d = m;
          n[static_cast<std::size_t>(across)] = up;
          d[static_cast<std::size_t>(across)] = 0.5 * up;
          for (double& x : d) x /= std::sqrt(1.25);
          all.push_back({to, d, n, side});
        }
    }
  return all;
}

double sum_squares(const double* c, int first, int last) {
  double sum = 0;
  for (int i = first; i < last; ++i) sum += c[i] * c[i];
  return sum;
}

}  // namespace

std::array<double, 2> lpv_solid_angles() {
  // A square of side 1 at distance 3/2 (Van Oosterom and Strackee; for a rectangle on its axis an arc tangent).
  const double front = 4 * std::atan(0.25 / (1.5 * std::sqrt(0.25 + 0.25 + 2.25)));
  // The shared face takes a sixth of the sphere, which the five others of the neighbour share.
  return {front, (4 * pi / 6 - front) / 4};
}

int lpv_coefficients(int bands) { return bands * bands; }

LpvStep lpv_step(const LpvGrid& grid, int bands, LpvLobes lobes, LpvBorder border, std::span<const double> light,
                 std::span<const double> geometry, double factor) {
  static const std::vector<Face> faces = thirty_faces();
  const auto [nx, ny, nz] = grid.extent;
  const int n = lpv_coefficients(bands);
  const double y0 = y(0, {0, 0, 1});
  LpvStep out;
  out.light.assign(light.size(), 0);
  for (int z = 0; z < nz; ++z)
    for (int yy = 0; yy < ny; ++yy)
      for (int x = 0; x < nx; ++x) {
        const double* const from = light.data() + static_cast<std::ptrdiff_t>(((z * ny + yy) * nx + x)) * n;
        std::array<double, 9> c{};
        std::copy(from, from + n, c.begin());
        if (lobes == LpvLobes::shrink) {
          const double reach = std::sqrt(3.0) * std::sqrt(sum_squares(from, 1, 4)) + std::sqrt(5.0) * std::sqrt(sum_squares(from, 4, n));
          const double keep = reach <= c[0] ? 1 : c[0] > 0 ? c[0] / reach : 0;
          for (int i = 1; i < n; ++i) c[static_cast<std::size_t>(i)] *= keep;
        }
        std::array<double, 30> flux{};
        double linear = 0, sent = 0;
        for (std::size_t f = 0; f < 30; ++f) {
          double intensity = 0;
          for (int i = 0; i < n; ++i) intensity += c[static_cast<std::size_t>(i)] * y(i, faces[f].direction);
          flux[f] = factor * faces[f].angle * intensity;
          linear += flux[f];
          if (lobes == LpvLobes::clamp || lobes == LpvLobes::rescale) flux[f] = std::max(0.0, flux[f]);
          sent += flux[f];
        }
        if (lobes == LpvLobes::rescale) {
          const double scale = sent <= linear ? 1 : linear > 0 ? linear / sent : 0;
          for (double& f : flux) f *= scale;
          sent *= scale;
        }
        out.ledger.clamped += (sent - linear) * y0;
        for (std::size_t f = 0; f < 30; ++f) {
          const auto& to = faces[f].towards;
          std::array<int, 3> p = {x + to[0], yy + to[1], z + to[2]};
          bool inside = true;
          for (std::size_t a = 0; a < 3; ++a) {
            if (border == LpvBorder::periodic) p[a] = (p[a] + grid.extent[a]) % grid.extent[a];
            inside = inside && p[a] >= 0 && p[a] < grid.extent[a];
          }
          if (!inside) {
            out.ledger.left += flux[f] * y0;
            continue;
          }
          double passed = flux[f];
          if (!geometry.empty()) {
            // The shared face as the receiving cell has it: its lower or upper side along the axis.
            double b = 0;
            const Vec back = {-faces[f].direction[0], -faces[f].direction[1], -faces[f].direction[2]};
            for (int k = 0; k < 8; ++k) {
              const std::array<int, 3> corner = {k & 1, k >> 1 & 1, k >> 2};
              bool on = true;
              for (std::size_t a = 0; a < 3; ++a)
                if (to[a] != 0) on = on && corner[a] == (to[a] > 0 ? 0 : 1);
              if (!on) continue;
              const int at = ((p[2] + corner[2]) * (ny + 1) + p[1] + corner[1]) * (nx + 1) + p[0] + corner[0];
              for (int i = 0; i < 4; ++i) b += 0.25 * geometry[static_cast<std::size_t>(4 * at + i)] * y(i, back);
            }
            passed *= 1 - std::clamp(b, 0.0, 1.0);
          }
          out.ledger.absorbed += (flux[f] - passed) * y0;
          double* const there = out.light.data() + static_cast<std::ptrdiff_t>((p[2] * ny + p[1]) * nx + p[0]) * n;
          for (int i = 0; i < n; ++i) there[i] += passed / pi * cosine(i, faces[f].normal);
        }
      }
  for (std::size_t i = 0; i < out.light.size(); i += static_cast<std::size_t>(n)) out.ledger.held += out.light[i];
  return out;
}

std::vector<double> lpv_propagated(const LpvPropagateParams& p, std::span<const double> injected,
                                   std::span<const double> geometry, std::vector<LpvLedger>* ledgers) {
  std::vector<double> light(injected.begin(), injected.end()), sum(injected.size(), 0);
  if (p.keep_injected) sum = light;
  for (int step = 0; step < p.iterations; ++step) {
    LpvStep next = lpv_step(p.grid, p.bands, p.lobes, p.border, light,
                            p.geometry && (step > 0 || p.continued) ? geometry : std::span<const double>());
    if (ledgers) ledgers->push_back(next.ledger);
    light = std::move(next.light);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += light[i];
  }
  return sum;
}

std::vector<double> lpv_to_pixels(const LpvGrid& grid, int bands, std::span<const double> light) {
  const std::size_t n = static_cast<std::size_t>(lpv_coefficients(bands)), cells = light.size() / n;
  std::vector<double> pixels(4 * lpv_pixels(grid, bands, 1), 0);
  for (std::size_t at = 0; at < cells; ++at)
    for (std::size_t i = 0; i < n; ++i) pixels[(i / 4 * cells + at) * 4 + i % 4] = light[at * n + i];
  return pixels;
}

std::vector<double> lpv_from_pixels(const LpvGrid& grid, int bands, std::span<const double> pixels) {
  const std::size_t n = static_cast<std::size_t>(lpv_coefficients(bands)), cells = lpv_pixels(grid, 2, 1);
  std::vector<double> light(cells * n);
  for (std::size_t at = 0; at < cells; ++at)
    for (std::size_t i = 0; i < n; ++i) light[at * n + i] = pixels[(i / 4 * cells + at) * 4 + i % 4];
  return light;
}

}  // namespace luxel::truth

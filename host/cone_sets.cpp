// Sets of cones whose weighted sum has the moments of the cosine-weighted mean, and what a set gets wrong.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <luxel/cone_trace.h>

#include "host/check.h"

namespace luxel {
namespace {

using std::numbers::pi;
constexpr double widest_aperture = 2.6;

double legendre(int l, double x) {
  double before = 1, now = x;
  if (l == 0) return before;
  for (int n = 2; n <= l; ++n) before = std::exchange(now, ((2 * n - 1) * x * now - (n - 1) * before) / n);
  return now;
}

// Mean of P_l over a cap of cosine c around the pole: the factor by which a cap damps band l.
double cap_band(int l, double c) {
  if (l == 0) return 1;
  if (1 - c < 1e-6) return 1 - l * (l + 1) * (1 - c) / 4;  // to first order: no difference of equal numbers
  return (legendre(l - 1, c) - legendre(l + 1, c)) / ((2 * l + 1) * (1 - c));
}

// Integral of 2 x P_l(x) over 0..1: 1, 2/3, 1/4, 0, -1/24, 0, 1/64.
constexpr std::array<double, 7> lobe_band{1, 2.0 / 3, 1.0 / 4, 0, -1.0 / 24, 0, 1.0 / 64};

// A set: cones along the normal (0 or 1), and in rings from the normal outward.
struct Layout {
  int axis;
  std::vector<int> rings;
  double half_angle;
};

Result<Layout> layout_of(int count) {
  // 1 - cos h = 4/5 / count: the caps cover 4/5 of the hemisphere.
  const double h = std::acos(1 - 0.8 / count);
  switch (count) {
    case 1: return Layout{1, {}, std::acos(1.0 / 3)};
    case 4: return Layout{1, {3}, h};
    case 5: return Layout{1, {4}, h};
    case 6: return Layout{1, {5}, pi / 6};
    case 8: return Layout{0, {4, 4}, h};
    case 9: return Layout{0, {4, 5}, h};
    case 16: return Layout{1, {6, 9}, h};
    case 25: return Layout{1, {7, 8, 9}, h};
  }
  return out_of_range("cone_set count", count, "1, 4, 5, 6, 8, 9, 16 or 25");
}

// Solves a small linear system by elimination with pivots; rows hold the right side last.
std::vector<double> solve(std::vector<std::vector<double>> rows) {
  const std::size_t n = rows.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t j = i + 1; j < n; ++j)
      if (std::fabs(rows[j][i]) > std::fabs(rows[pivot][i])) pivot = j;
    std::swap(rows[i], rows[pivot]);
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const double factor = rows[j][i] / rows[i][i];
      for (std::size_t k = i; k <= n; ++k) rows[j][k] -= factor * rows[i][k];
    }
  }
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = rows[i][n] / rows[i][i];
  return x;
}

// Real roots in (0, 1) of the monic polynomial with these lower coefficients, by bisection; largest first.
std::vector<double> roots(const std::vector<double>& lower) {
  const auto value = [&](double x) {
    double v = 1;
    for (std::size_t i = lower.size(); i-- > 0;) v = v * x + lower[i];
    return v;
  };
  std::vector<double> found;
  constexpr int pieces = 4096;
  for (int i = 0; i < pieces; ++i) {
    double a = static_cast<double>(i) / pieces, b = (i + 1.0) / pieces;
    if ((value(a) < 0) == (value(b) < 0)) continue;
    for (int n = 0; n < 60; ++n) ((value(0.5 * (a + b)) < 0) == (value(a) < 0) ? a : b) = 0.5 * (a + b);
    found.push_back(0.5 * (a + b));
  }
  std::reverse(found.begin(), found.end());
  return found;
}

// Cosines and weights of the rings (the axis first): the Gauss rule of the lobe whose Legendre moments are
// lobe_band / cap_band; with an axis the Gauss-Radau rule with a node at 1. Empty where there is none.
std::vector<std::array<double, 2>> rule(int axis, int rings, double cap) {
  const int count = 2 * rings + axis;
  // Powers of x by Legendre polynomials, x P_l = ((l+1) P_(l+1) + l P_(l-1)) / (2l+1), give the moments of powers.
  std::vector<double> power(static_cast<std::size_t>(count)), expansion(static_cast<std::size_t>(count) + 1);
  expansion[0] = 1;
  for (int j = 0; j < count; ++j) {
    for (int l = 0; l <= j; ++l) power[j] += expansion[l] * lobe_band[l] / cap_band(l, cap);
    std::vector<double> next(expansion.size());
    for (int l = 0; l <= j && l + 1 < static_cast<int>(expansion.size()); ++l) {
      next[l + 1] += expansion[l] * (l + 1) / (2 * l + 1);
      if (l > 0) next[l - 1] += expansion[l] * l / (2 * l + 1);
    }
    expansion = next;
  }
  std::vector<double> nodes;
  if (rings > 0) {
    std::vector<double> m = power;
    if (axis == 1)
      for (int j = 0; j + 1 < count; ++j) m[j] = power[j] - power[j + 1];  // moments of (1 - x) times the lobe
    std::vector<std::vector<double>> rows;
    for (int i = 0; i < rings; ++i) {
      rows.emplace_back(m.begin() + i, m.begin() + i + rings);
      rows.back().push_back(-m[static_cast<std::size_t>(i + rings)]);
    }
    nodes = roots(solve(rows));
    if (static_cast<int>(nodes.size()) != rings) return {};
  }
  if (axis == 1) nodes.insert(nodes.begin(), 1.0);
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    rows.emplace_back();
    for (const double x : nodes) rows.back().push_back(std::pow(x, static_cast<double>(i)));
    rows.back().push_back(power[i]);
  }
  const std::vector<double> weights = solve(rows);
  std::vector<std::array<double, 2>> result;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!(weights[i] > 0)) return {};
    result.push_back({nodes[i], weights[i]});
  }
  return result;
}

void add_ring(std::vector<Cone>& cones, int count, double cosine, double weight, double turn, double aperture) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * (i + turn) / count;
    cones.push_back({{sine * std::cos(angle), sine * std::sin(angle), cosine}, weight / count, aperture});
  }
}

}  // namespace

Result<std::vector<Cone>> cone_set(int count, double aperture) {
  const Result<Layout> layout = layout_of(count);
  if (!layout) return layout.status();
  const Layout& l = layout.value();
  LUXEL_CHECK(check_range("cone_set aperture", aperture, 0.0, widest_aperture));
  const double h = aperture > 0 ? aperture / 2 : l.half_angle;
  const auto nodes = rule(l.axis, static_cast<int>(l.rings.size()), std::cos(h));
  const Status none = out_of_range("cone_set aperture", 2 * h,
                                   "an aperture at which " + std::to_string(count) +
                                       " cones above the horizon have the moments of the cosine; 0 takes a fitting one");
  if (nodes.empty()) return none;
  std::vector<Cone> cones;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto [cosine, weight] = nodes[i];
    if (l.axis == 1 && i == 0) {
      cones.push_back({{0, 0, 1}, weight, 2 * h});
      continue;
    }
    if (std::acos(cosine) + h > pi / 2) return none;
    // Every other ring is turned by half a step, so that cones do not stand in line.
    add_ring(cones, l.rings[i - static_cast<std::size_t>(l.axis)], cosine, weight, i % 2 == 0 ? 0.5 : 0.0, 2 * h);
  }
  return cones;
}

std::vector<Cone> classic_cones() {
  std::vector<Cone> cones{{{0, 0, 1}, 0.25, pi / 3}};
  add_ring(cones, 5, 0.5, 0.75, 0, pi / 3);
  return cones;
}

namespace {

struct Unit {
  double x, y, z, weight;
};

// Unit directions, and weights that sum to 1.
std::vector<Unit> normalised(const std::vector<Cone>& cones) {
  std::vector<Unit> result;
  double sum = 0;
  for (const Cone& c : cones) sum += c.weight;
  for (const Cone& c : cones) {
    const double length = std::hypot(c.direction[0], c.direction[1], c.direction[2]);
    result.push_back({c.direction[0] / length, c.direction[1] / length, c.direction[2] / length, c.weight / sum});
  }
  return result;
}

// Associated Legendre functions with Schmidt's normalisation: maxima about 1.
double schmidt(int l, int m, double x) {
  double value = 1, norm = m == 0 ? 1 : 2;
  const double s = std::sqrt(std::max(0.0, 1 - x * x));
  for (int i = 1; i <= m; ++i) value *= (2 * i - 1) * s;
  for (int i = l - m + 1; i <= l + m; ++i) norm /= i;
  double before = value, now = x * (2 * m + 1) * value;
  if (l == m) return value * std::sqrt(norm);
  for (int n = m + 2; n <= l; ++n)
    before = std::exchange(now, ((2 * n - 1) * x * now - (n + m - 1) * before) / (n - m));
  return now * std::sqrt(norm);
}

}  // namespace

ConeSetResponse cone_set_response(const std::vector<Cone>& cones) {
  ConeSetResponse response;
  const std::vector<Unit> units = normalised(cones);
  for (int l = 0; l < 7; ++l)
    for (int m = 0; m <= l; ++m) {
      double even = 0, odd = 0;
      for (std::size_t i = 0; i < units.size(); ++i) {
        const double angle = m * std::atan2(units[i].y, units[i].x);
        const double part =
            units[i].weight * cap_band(l, std::cos(cones[i].aperture / 2)) * schmidt(l, m, units[i].z);
        even += part * std::cos(angle);
        odd += part * std::sin(angle);
      }
      const bool wanted = m == 0 && lobe_band[l] != 0;
      if (wanted) response.band[l] = even / lobe_band[l];
      else response.stray[l] = std::max(response.stray[l], std::hypot(even, odd));
    }
  return response;
}

HalfSpaceError cone_set_half_spaces(const std::vector<Cone>& cones, int samples) {
  const std::vector<Unit> units = normalised(cones);
  // Part of a cap of half-angle h whose axis is at angle a from the half-space's normal, by rings about the cap's axis.
  const auto part = [](double h, double cosine) {
    if (h <= 0) return cosine > 0 ? 1.0 : 0.0;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    double sum = 0;
    constexpr int rings = 32;
    for (int i = 0; i < rings; ++i) {
      const double c = 1 - (1 - std::cos(h)) * (i + 0.5) / rings, s = std::sqrt(1 - c * c);
      const double x = sine * s > 0 ? -cosine * c / (sine * s) : cosine * c > 0 ? -2 : 2;  // cos of the arc inside
      sum += x <= -1 ? 1 : x >= 1 ? 0 : std::acos(x) / pi;
    }
    return sum / rings;
  };
  double squares = 0, most = 0;
  for (int i = 0; i < samples; ++i) {
    const double z = 1 - 2 * (i + 0.5) / samples, angle = 2 * pi * std::fmod(i * 0.6180339887498949, 1.0);
    const double s = std::sqrt(1 - z * z), x = s * std::cos(angle), y = s * std::sin(angle);
    double seen = 0;
    for (std::size_t k = 0; k < units.size(); ++k)
      seen += units[k].weight * part(cones[k].aperture / 2, units[k].x * x + units[k].y * y + units[k].z * z);
    const double error = seen - (1 + z) / 2;  // a half-space's form factor
    squares += error * error;
    most = std::max(most, std::fabs(error));
  }
  return {std::sqrt(squares / samples), most};
}

// GGX (Walter et al. 2007), alpha = roughness^2: with tan^2 = alpha^2 u / (1 - u), u uniform in 0..1, half-vectors are
// distributed by D cos; the mirrored direction is at twice the angle, and counts by its masking G1. The lobe's median
// cosine m is where half of that is passed; half of a cap's solid angle lies within (1 + cos h) / 2.
double specular_aperture(double roughness) {
  const double r = std::clamp(roughness, 0.0, 1.0), alpha2 = r * r * r * r;
  constexpr int pieces = 8192;
  std::vector<std::array<double, 2>> lobe;  // cosine, weight passed up to it
  double passed = 0;
  for (int i = 0; i < pieces; ++i) {
    const double u = (i + 0.5) / pieces, tan2 = alpha2 * u / (1 - u);
    const double c = (1 - tan2) / (1 + tan2);  // cosine of twice the angle
    if (c <= 0) break;
    passed += 2 * c / (c + std::sqrt(alpha2 + (1 - alpha2) * c * c));
    lobe.push_back({c, passed});
  }
  const auto half = std::find_if(lobe.begin(), lobe.end(), [&](const auto& at) { return at[1] >= passed / 2; });
  return 2 * std::acos(std::clamp(2 * (*half)[0] - 1, -1.0, 1.0));
}

}  // namespace luxel

#include "bench/truth/mip_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxel::truth {
namespace {

using Extent = std::array<int, 3>;

std::size_t at(const Level& l, int x, int y, int z) {
  return ((static_cast<std::size_t>(z) * l.extent[1] + y) * l.extent[0] + x) * l.channels;
}

// A weight on fine index k.
struct Weight {
  int k;
  double w;
};

// Lengths that cell i of m has in common with each of n cells of the same interval, in cells of n.
std::vector<Weight> overlaps(int i, int m, int n) {
  const double low = static_cast<double>(i) * n / m, high = static_cast<double>(i + 1) * n / m;
  std::vector<Weight> found;
  for (int k = static_cast<int>(low); k < n && k < high; ++k) {
    const double length = std::min(high, k + 1.0) - std::max(low, static_cast<double>(k));
    if (length > 1e-9) found.push_back({k, length});
  }
  return found;
}

std::vector<Weight> area(int i, int m, int n) {
  std::vector<Weight> weights = overlaps(i, m, n);
  for (Weight& w : weights) w.w *= static_cast<double>(m) / n;
  return weights;
}

// 1-2-1 round k, by mirror or by repeated ends.
void add_121(std::vector<Weight>& to, int k, int n, double w, bool mirror) {
  for (int d = -1; d <= 1; ++d) {
    int at = k + d;
    if (mirror) at = at < 0 ? -at : at >= n ? 2 * (n - 1) - at : at;
    to.push_back({std::clamp(at, 0, n - 1), w * (d == 0 ? 0.5 : 0.25)});
  }
}

std::vector<Weight> weights(const MipBuildParams& p, int i, int m, int n) {
  if (n == 1) return {{0, 1.0}};
  if (p.variant != MipVariant::gaussian3) return area(i, m, n);
  std::vector<Weight> all;
  if (p.samples == MipSamples::vertices) {
    if (n == 2) return area(i, m, n);
    add_121(all, 2 * i, n, 1.0, true);
    return all;
  }
  for (const Weight& w : area(i, m, n)) add_121(all, w.k, n, w.w, false);
  return all;
}

// Calls f(weight, texel of `fine`) for all that texel (x, y, z) of `coarse` is made of.
template <class F>
void each(const MipBuildParams& p, const Level& coarse, const Level& fine, int x, int y, int z, F f) {
  const auto wx = weights(p, x, coarse.extent[0], fine.extent[0]);
  const auto wy = weights(p, y, coarse.extent[1], fine.extent[1]);
  const auto wz = weights(p, z, coarse.extent[2], fine.extent[2]);
  for (const Weight& c : wz)
    for (const Weight& b : wy)
      for (const Weight& a : wx) f(a.w * b.w * c.w, &fine.values[at(fine, a.k, b.k, c.k)]);
}

template <class Texel>
void fill(Level& level, Texel texel) {
  for (int z = 0; z < level.extent[2]; ++z)
    for (int y = 0; y < level.extent[1]; ++y)
      for (int x = 0; x < level.extent[0]; ++x) texel(x, y, z, &level.values[at(level, x, y, z)]);
}

void average(const MipBuildParams& p, Level& coarse, const Level& fine) {
  fill(coarse, [&](int x, int y, int z, double* to) {
    std::fill_n(to, coarse.channels, 0.0);
    each(p, coarse, fine, x, y, z, [&](double w, const double* v) {
      for (int c = 0; c < coarse.channels; ++c) to[c] += w * v[c];
    });
  });
}

void moments(const MipBuildParams& p, Level& coarse, const Level& fine) {
  fill(coarse, [&](int x, int y, int z, double* to) {
    double mean = 0, variance = 0;
    each(p, coarse, fine, x, y, z, [&](double w, const double* v) { mean += w * v[0]; });
    each(p, coarse, fine, x, y, z,
         [&](double w, const double* v) { variance += w * (v[1] * v[1] + (v[0] - mean) * (v[0] - mean)); });
    to[0] = mean;
    to[1] = std::sqrt(variance);
  });
}

// Part `length` of a voxel's thickness, by the exponential law of absorption.
std::array<double, 4> layer(const double* v, double length) {
  const double a = v[3];
  const double part = length >= 1 || a >= 1 ? 1.0 : a == 0 ? length : -std::expm1(length * std::log1p(-a)) / a;
  return {v[0] * part, v[1] * part, v[2] * part, a * part};
}

void directional(const MipBuildParams& p, Level& coarse, const Level& fine, int direction) {
  const int axis = direction / 2, n = fine.extent[axis], m = coarse.extent[axis];
  fill(coarse, [&](int x, int y, int z, double* to) {
    const int i[3] = {x, y, z};
    std::vector<Weight> along = n == 1 ? std::vector<Weight>{{0, 1.0}} : overlaps(i[axis], m, n);
    if (direction % 2 == 1) std::reverse(along.begin(), along.end());
    std::vector<Weight> across[3];
    for (int a = 0; a < 3; ++a)
      across[a] = a == axis ? std::vector<Weight>{{0, 1.0}} : weights(p, i[a], coarse.extent[a], fine.extent[a]);
    std::fill_n(to, 4, 0.0);
    for (const Weight& wz : across[2])
      for (const Weight& wy : across[1])
        for (const Weight& wx : across[0]) {
          std::array<double, 4> seen{0, 0, 0, 0};
          for (const Weight& step : along) {
            int k[3] = {wx.k, wy.k, wz.k};
            k[axis] = step.k;
            const auto c = layer(&fine.values[at(fine, k[0], k[1], k[2])], step.w);
            const double through = 1 - seen[3];
            if (through > 0)
              for (int channel = 0; channel < 4; ++channel) seen[channel] += through * c[channel];
          }
          for (int channel = 0; channel < 4; ++channel) to[channel] += wx.w * wy.w * wz.w * seen[channel];
        }
  });
}

void bounds(const MipBuildParams& p, Level& coarse, const Level& finest, int level) {
  const int shift = p.ratio == 16 ? 4 * level : level;
  const bool both = p.variant == MipVariant::minmax;
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::fill(coarse.values.begin(), coarse.values.end(), none);
  for (int y = 0; y < finest.extent[1]; ++y)
    for (int x = 0; x < finest.extent[0]; ++x) {
      const int cx = std::min(x >> shift, coarse.extent[0] - 1), cy = std::min(y >> shift, coarse.extent[1] - 1);
      const double* v = &finest.values[at(finest, x, y, 0)];
      double* to = &coarse.values[at(coarse, cx, cy, 0)];
      for (int c = 0; c < coarse.channels; ++c) {
        const bool upper = both ? c == 1 : p.variant == MipVariant::max;
        if (std::isnan(v[c])) continue;
        to[c] = std::isnan(to[c]) ? v[c] : upper ? std::max(to[c], v[c]) : std::min(to[c], v[c]);
      }
    }
}

}  // namespace

std::vector<Level> pyramid(const MipBuildParams& p, std::span<const double> level_0, int direction) {
  const bool pairs = p.variant == MipVariant::minmax || p.variant == MipVariant::moments;
  std::vector<Level> levels(static_cast<std::size_t>(mip_levels(p)) + 1);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    levels[l].extent = mip_extent(p, static_cast<int>(l));
    levels[l].channels = channels(p.format);
    const Extent& e = levels[l].extent;
    levels[l].values.resize(static_cast<std::size_t>(e[0]) * e[1] * e[2] * levels[l].channels);
  }
  if (pairs && !p.pairs) {
    for (std::size_t i = 0; i < level_0.size(); ++i) {
      levels[0].values[2 * i] = level_0[i];
      levels[0].values[2 * i + 1] = p.variant == MipVariant::minmax ? level_0[i] : 0.0;
    }
  } else {
    levels[0].values.assign(level_0.begin(), level_0.end());
  }
  for (std::size_t l = 1; l < levels.size(); ++l) {
    if (p.variant == MipVariant::anisotropic) directional(p, levels[l], levels[l - 1], direction);
    else if (p.variant == MipVariant::moments) moments(p, levels[l], levels[l - 1]);
    else if (p.variant == MipVariant::isotropic || p.variant == MipVariant::gaussian3) average(p, levels[l], levels[l - 1]);
    else bounds(p, levels[l], levels[0], static_cast<int>(l));
  }
  return levels;
}

}  // namespace luxel::truth

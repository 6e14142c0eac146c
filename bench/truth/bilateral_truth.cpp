#include "bench/truth/bilateral_truth.h"

#include <algorithm>
#include <cmath>

namespace luxel::truth {
namespace {

int border_at(Border border, int i, int n) {
  if (i >= 0 && i < n) return i;
  switch (border) {
    case Border::clamp: return std::clamp(i, 0, n - 1);
    case Border::wrap: return ((i % n) + n) % n;
    case Border::mirror: {
      if (n == 1) return 0;
      const int period = 2 * n - 2, j = ((i % period) + period) % period;
      return j < n ? j : period - j;
    }
    case Border::zero: return -1;
  }
  return -1;
}

class Filter {
 public:
  Filter(const BilateralParams& p, const BilateralImages& images) : p_(p), m_(images) {}

  BilateralImages run() {
    if (p_.variant == BilateralVariant::atrous) {
      for (int level = 0; level < p_.levels; ++level) pass(p_.taps / 2 << level, 1 << level);
    } else if (p_.sigma_space > 0) {
      pass(p_.radius >= 0 ? p_.radius : static_cast<int>(std::ceil(3 * p_.sigma_space)), p_.step);
    }
    return m_;
  }

 private:
  void pass(int radius, int step) {
    if (p_.range != RangeTerm::off && p_.sigma_range == 0) return;
    step_ = step;
    const int n = channels(p_.format), filtered = n == 4 && !p_.alpha ? 3 : n, reach = radius / step * step;
    BilateralImages out = m_;
    for (int y = 0; y < p_.height; ++y)
      for (int x = 0; x < p_.width; ++x) {
        std::vector<double> sum(filtered, 0.0);
        double total = 0, variance = 0;
        for (int dy = -reach; dy <= reach; dy += step)
          for (int dx = -reach; dx <= reach; dx += step) {
            if (p_.window == FilterWindow::circle && dx * dx + dy * dy > radius * radius) continue;
            const int qx = border_at(p_.border, x + dx, p_.width), qy = border_at(p_.border, y + dy, p_.height);
            if (qx < 0 || qy < 0) continue;
            const double w = dx == 0 && dy == 0 ? 1 : weight(x, y, qx, qy, dx, dy);
            total += w;
            if (p_.luminance) variance += w * w * m_.variance[at(qx, qy, 1)];
            for (int c = 0; c < filtered; ++c) sum[c] += w * m_.src[at(qx, qy, n) + c];
          }
        for (int c = 0; c < filtered; ++c) out.src[at(x, y, n) + c] = sum[c] / total;
        if (p_.luminance) out.variance[at(x, y, 1)] = variance / (total * total);
      }
    m_ = out;
  }

  std::size_t at(int x, int y, int n) const { return (static_cast<std::size_t>(y) * p_.width + x) * n; }

  double apart2(const std::vector<double>& image, int n, int counted, int x, int y, int qx, int qy) const {
    double sum = 0;
    for (int c = 0; c < counted; ++c) {
      const double d = image[at(x, y, n) + c] - image[at(qx, qy, n) + c];
      sum += p_.range_norm == RangeNorm::l1 ? std::fabs(d) : d * d;
    }
    return p_.range_norm == RangeNorm::l1 ? sum * sum : sum;
  }

  double depth_at(int x, int y) const {
    const double z = m_.depth[at(x, y, 1)], v = p_.depth == DepthTerm::plane ? 1 / z : z;
    return z < 1e10 ? v : NAN;
  }

  double slope(double before, double here, double after) const {
    const double a = here - before, b = after - here;
    if (std::isnan(a)) return std::isnan(b) ? 0 : b;
    if (std::isnan(b)) return a;
    return std::fabs(a) <= std::fabs(b) ? a : b;
  }

  double luminance(int x, int y) const {
    const int n = channels(p_.format);
    const double* v = &m_.src[at(x, y, n)];
    return n == 1 ? v[0] : n == 2 ? (v[0] + v[1]) / 2 : 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
  }

  double weight(int x, int y, int qx, int qy, int dx, int dy) const {
    const int n = channels(p_.format);
    double w = std::isinf(p_.sigma_space) ? 1 : std::exp(-(dx * dx + dy * dy) / (2 * p_.sigma_space * p_.sigma_space));
    if (p_.variant == BilateralVariant::atrous) {
      const double five[] = {1, 4.0 / 6, 1.0 / 6}, three[] = {1, 0.5};
      const double* const h = p_.taps == 5 ? five : three;
      w = h[std::abs(dx) / step_] * h[std::abs(dy) / step_];
    }
    if (p_.range == RangeTerm::self)
      w *= std::exp(-apart2(m_.src, n, n == 4 && !p_.alpha ? 3 : n, x, y, qx, qy) /
                    (2 * p_.sigma_range * p_.sigma_range));
    if (p_.range == RangeTerm::guide) {
      const int g = channels(p_.guide_format);
      w *= std::exp(-apart2(m_.guide, g, std::min(g, 3), x, y, qx, qy) / (2 * p_.sigma_range * p_.sigma_range));
    }
    if (p_.depth != DepthTerm::off) {
      const double here = depth_at(x, y);
      const double gx = slope(x > 0 ? depth_at(x - 1, y) : NAN, here, x + 1 < p_.width ? depth_at(x + 1, y) : NAN);
      const double gy = slope(y > 0 ? depth_at(x, y - 1) : NAN, here, y + 1 < p_.height ? depth_at(x, y + 1) : NAN);
      const double change = gx * dx + gy * dy, there = depth_at(qx, qy), z = m_.depth[at(x, y, 1)];
      const double epsilon = 4 * std::ldexp(z, -23);
      const double e = p_.depth == DepthTerm::plane
                           ? std::fabs(there - here - change) * z * z /
                                 (p_.sigma_depth * std::hypot(dx, dy) * p_.footprint * z + epsilon)
                           : std::fabs(there - here) / (p_.sigma_depth * std::fabs(change) + epsilon);
      w = std::isnan(e) ? 0 : w * std::exp(-e);
    }
    if (p_.normal) {
      double cosine = 0;
      for (int c = 0; c < 3; ++c) cosine += m_.normals[at(x, y, 4) + c] * m_.normals[at(qx, qy, 4) + c];
      w *= std::pow(std::max(0.0, cosine), p_.sigma_normal);
    }
    if (p_.luminance) {
      double variance = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          variance += (2 - std::abs(i)) * (2 - std::abs(j)) / 16.0 *
                      m_.variance[at(std::clamp(x + i, 0, p_.width - 1), std::clamp(y + j, 0, p_.height - 1), 1)];
      if (variance < p_.variance_target) return 0;
      w *= std::exp(-std::fabs(luminance(x, y) - luminance(qx, qy)) /
                    (p_.sigma_luminance * std::sqrt(variance) + p_.epsilon));
    }
    return w;
  }

  const BilateralParams& p_;
  BilateralImages m_;
  int step_ = 1;
};

}  // namespace

BilateralImages bilateral(const BilateralParams& params, const BilateralImages& images) {
  return Filter(params, images).run();
}

}  // namespace luxel::truth

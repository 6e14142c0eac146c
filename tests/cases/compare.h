// Numbers that say how far two lists of values are apart. NaN and lists of different length give NaN, which keeps no
// bound.
#pragma once
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace luxel::cases {

/// Equal bits, or both NaN.
inline bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

/// How many values differ in any bit.
inline double count_different(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::quiet_NaN();
  double count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += same(a[i], b[i]) ? 0 : 1;
  return count;
}

/// Largest |a - b|. Equal infinities are 0 apart.
inline double max_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::quiet_NaN();
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = a[i] == b[i] ? 0 : std::fabs(a[i] - b[i]);
    if (!(d <= most)) most = d;
    if (std::isnan(most)) return most;
  }
  return most;
}

/// Half the sum of |a - b|.
inline double half_l1(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::fabs(a[i] - b[i]);
  return sum / 2;
}

}  // namespace luxel::cases

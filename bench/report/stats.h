// Medians and quartiles of times.
#pragma once
#include <vector>

#include "bench/report/cell.h"

namespace luxel::report {

struct Sample {
  double median = 0, q1 = 0, q3 = 0;
  int n = 0;
  bool busy = false;  // the machine did something else meanwhile
};

/// Quartiles by linear interpolation between order statistics. An empty list gives zeros.
Sample summarise(std::vector<double> values);

Cell cell_of(const Sample& sample);

/// a[i] / b[i].
std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b);
/// a[i] - b[i].
std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace luxel::report

// Which settings are worth having: those that no other beats in both error and time.
#pragma once
#include <vector>

#include "bench/report/json.h"

namespace luxel::report {

/// Sum of a frontier row's parts of the error: by the triangle inequality no less than |result - truth|. Parts that are
/// null do not count. NaN where a part is not a number.
double total_error(const Json& row);

/// The row's time, all phases together (median, first and third quartile); n is 0 where nothing was timed.
struct Span {
  double median = 0, q1 = 0, q3 = 0;
};
Span total_time(const Json& row);

/// Whether a setting dominates another of its group: its error is not larger, and the third quartile of its time lies below the
/// other's first.
bool beats(const Json& row, const Json& other);

/// Sets `on_frontier` of every row and takes `group` away. Rows compare within a group: equal receivers, format, size,
/// metric and device.
void mark_frontier(std::vector<Json>& rows);

}  // namespace luxel::report

#include "bench/report/frontier.h"

#include <limits>
#include <map>
#include <string>

namespace luxel::report {

double total_error(const Json& row) {
  double sum = 0;
  for (const char* part : {"rounding", "storage", "device", "method"}) {
    const Json& v = row.at("error").at(part);
    if (v.is_number())
      sum += v.get<double>();
    else if (!v.is_null())
      sum = std::numeric_limits<double>::quiet_NaN();
  }
  return sum;
}

Span total_time(const Json& row) {
  Span span;
  for (const char* phase : {"build", "update", "shade"}) {
    const Json& t = row.at("time_ms").at(phase);
    if (t.is_null()) continue;
    span.median += t.at("median").get<double>();
    span.q1 += t.at("q1").get<double>();
    span.q3 += t.at("q3").get<double>();
  }
  return span;
}

namespace {

struct Point {
  std::size_t row;
  double error;
  Span time;
};

bool beats(const Point& a, const Point& b) { return a.error <= b.error && a.time.q3 < b.time.q1; }

}  // namespace

bool beats(const Json& row, const Json& other) {
  return beats(Point{0, total_error(row), total_time(row)}, Point{0, total_error(other), total_time(other)});
}

void mark_frontier(std::vector<Json>& rows) {
  std::map<std::string, std::vector<Point>> groups;
  for (std::size_t i = 0; i < rows.size(); ++i)
    groups[rows[i].value("group", std::string())].push_back({i, total_error(rows[i]), total_time(rows[i])});
  for (const auto& [name, points] : groups)
    for (const Point& p : points) {
      bool beaten = !(p.error >= 0);  // a result that is not a number is on no frontier
      for (const Point& other : points) beaten = beaten || beats(other, p);
      rows[p.row]["on_frontier"] = !beaten;
    }
  for (Json& row : rows) row.erase("group");
}

}  // namespace luxel::report

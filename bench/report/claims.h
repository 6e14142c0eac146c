// What the sources claim, measured again.
#pragma once
#include <string>

#include "bench/report/cell.h"
#include "bench/report/stats.h"

namespace luxel::report {

class Session;

struct Claim {
  std::string text, source;
  Cell source_value;  ///< null: the source prints no number
  Sample measured;      ///< n 1: no quartiles
  bool kept = false;
  std::string rule;  ///< when it counts as confirmed
  std::string reason;
};

/// A row of `reproduction`.
void add(Session& session, const Claim& claim);

/// A measurement that is taken once, as it is the same in every run.
inline Sample once(double value) { return {value, value, value, 1}; }
/// Whether `measured` is within this factor of what is claimed.
bool within(double measured, double claimed, double factor);
/// That, as a rule.
std::string within_factor(double factor);

/// The rule of ratios without a number to compare with.
inline constexpr const char* quartile_above_one = "lower quartile above 1";

}  // namespace luxel::report

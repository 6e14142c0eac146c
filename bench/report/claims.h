// What the sources claim, measured again.
#pragma once
#include <string>

#include "bench/report/cell.h"
#include "bench/report/stats.h"

namespace luxel::report {

class Session;

/// When a claim counts as confirmed, and whether it does.
struct Rule {
  std::string text;
  bool kept = false;
};

struct Claim {
  std::string text, source;
  Cell source_value;  ///< null: the source prints no number
  Sample measured;    ///< n 1: no quartiles
  Rule rule;
  std::string reason;
};

/// A row of `reproduction`.
void add(Session& session, const Claim& claim);

/// A measurement that is taken once, as it is the same in every run.
inline Sample once(double value) { return {value, value, value, 1}; }
/// Within this factor of what is claimed.
Rule within(double measured, double claimed, double factor);
/// Of ratios without a number to compare with.
inline Rule above_one(const Sample& ratio) { return {"lower quartile above 1", ratio.q1 > 1}; }

}  // namespace luxel::report

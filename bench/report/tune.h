// The cheapest setting of a kernel within an error, or the most exact within a time, found by measuring its grid.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/frontier.h"
#include "bench/report/settings.h"

namespace luxel::report {

struct TuneRequest {
  Settings settings;                 // kernels: the one that is tuned; devices: one at most; quick, width, height, sigma, radius
  std::optional<double> max_error;   // one of the two
  std::optional<double> max_ms;
  std::string scene, metric, json;   // part of a name; empty: the grid's first. json: a file, empty: none
  std::vector<std::pair<std::string, std::string>> fixed;  // option, knob, "variant" or "size", and its value
};

/// A frontier row as a choice.
struct Choice {
  Json row;
  double error = 0;
  Span ms;
};

/// The best of some choices under a request, and what else is worth saying of them. `found` is empty where none fits; then `nearest`
/// is the one that comes nearest: the most exact (the fastest).
struct Answer {
  std::optional<Choice> found, nearest;
  std::vector<Choice> as_fast;  // fit, and their quartiles of time overlap those of `found`, which is the faster by its median
};
Answer answer_of(const TuneRequest& request, const std::vector<Choice>& choices);

/// How a setting is written down.
struct Spelled {
  std::string command;  // `luxel ...`, files by placeholder names; empty where no command takes the setting
  std::string cpp;      // a function that returns the parameters, with its includes
};
Spelled spelled(const Json& row);

/// Measures, prints, writes the JSON. The program's exit status: 0, 1 (no setting fits, or measuring failed), 2 (wrong use).
int run_tune(const TuneRequest& request);

}  // namespace luxel::report

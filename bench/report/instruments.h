// What `luxel stability` finds out by experiment, beside the cases of the tests: gain of what is iterated or fed back,
// growth of rounding, storage formats, and how far behind a documented limit things go wrong.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bench/report/session.h"

namespace luxel::report {

/// A number, and where it was found.
struct Found {
  double measured = 0;
  std::string where;
};

/// An experiment on a device whose number is kept where it is <= bound.
struct Instrument {
  std::string family;   // as `luxel stability` takes it: one of measured_kernels()
  std::string kernel;   // the kernel or the part of it
  std::string name;     // begins with "gain: ", "growth: ", "storage: " or "edge: "
  std::string promise;  // a sentence
  double bound = 0;
  /// `exact`: the C++ execution in double. `quick`: as few sizes as say something.
  std::function<Result<Found>(Context& device, Context& exact, bool quick)> measure;
};

void add_gains(std::vector<Instrument>& all);
void add_growths(std::vector<Instrument>& all);
void add_storages(std::vector<Instrument>& all);
void add_edges(std::vector<Instrument>& all);

/// All of these.
std::vector<Instrument> instruments();

/// A stability row for each instrument of the kernels that are asked for.
std::vector<Job> instrument_jobs(Session& session);

/// The power p of error = c size^p, least squares of logarithms; with all points as text. Points without error are left
/// out; with fewer than two others there is no growth: 0.
Found fitted_power(const std::string& what, const std::vector<std::pair<double, double>>& points);

/// By bisection of logarithms between `good`, which works, and `bad`, which does not: the last value that works, to within
/// a part of `precision`. Where `bad` works as well it is `bad`, and where `good` does not it is NaN.
Result<double> edge_between(double good, double bad, const std::function<Result<bool>(double)>& works, double precision = 1e-3);

}  // namespace luxel::report

// Measuring on one device, in the child process: rows handed to the parent, times with their guard, errors with their
// oracle.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <luxel/device.h>

#include "bench/report/frontier_row.h"
#include "bench/report/guard.h"
#include "bench/report/settings.h"
#include "bench/report/stats.h"
#include "bench/report/workers.h"

namespace luxel::report {

struct KeptJob;

/// One thing that is measured.
struct Job {
  std::string label;
  std::function<Status()> run;
};

/// Errors that do not depend on the device, and what the C++ execution in float gave.
struct Oracle {
  std::uint64_t bits = 0;  // hash of the stored result of the C++ execution in float
  double rounding = 0;     // C++ float against C++ double
  double storage = 0;      // rounding by the storage format alone
  double method = 0;       // C++ double against the truth
};

/// FNV-1a over bytes.
std::uint64_t hash_bytes(const std::vector<std::byte>& bytes);
/// The same of values.
std::uint64_t hash_values(const std::vector<double>& values);

class Session {
 public:
  /// `rows`: file descriptor that takes a JSON object a line.
  Session(std::shared_ptr<Context> context, Settings settings, int rows, double best_guard);

  Context& context() { return *context_; }
  Context& cpu_float();
  Context& cpu_double();
  const Settings& settings() const { return settings_; }
  const std::string& device() const { return context_->info().id; }
  bool is_cpu() const { return context_->info().api == Api::cpu; }

  /// A row of a section of the report.
  void row(const std::string& section, const Cell& row);
  /// A line of `devices[].limits`, `first_use` or `problems` of this device.
  void note(const std::string& list, const Cell& entry);
  void progress(std::size_t done, std::size_t of, const std::string& label);

  /// Runs jobs in order. A job that fails becomes a problem of the device, and unless the code is `unsupported` (a
  /// device may lack a feature) a broken promise. Jobs that an earlier run finished, by kernels whose text is still the
  /// same, are named as kept and not run again; those that failed are.
  void run(const std::vector<Job>& jobs);

  /// Milliseconds of one run, warm, several runs a sample where one is short. Taken again while the machine is busy;
  /// flagged in the report where that did not help. `label` names it there. The first run's time is kept in
  /// `first_use`.
  Result<Sample> time(cases::Run& run, const std::string& label);
  /// a and b in turn: a, b, a, b ... Each returns the milliseconds of one run.
  using Timed = std::function<Result<double>()>;
  struct Pair {
    std::vector<double> a, b;
  };
  Result<Pair> interleave(const Timed& a, const Timed& b, const std::string& label);

  /// The error of a result by each of some metrics. Rounding, storage and method come from `oracles` (one a metric;
  /// computed once in a report for a `label`, and shared by its devices through a file). The device's own part is 0
  /// where `bits` are the oracle's, else `device` finds it (one number a metric). `promised`: the bits must be equal.
  Result<std::vector<ErrorSplit>> errors(const std::string& label, const std::vector<std::string>& metrics,
                                         std::uint64_t bits, bool promised,
                                         const std::function<Result<std::vector<Oracle>>()>& oracles,
                                         const std::function<Result<std::vector<double>>()>& device);
  /// Numbers that every device would find alike, and that take long: computed once in a report for a `label`, and shared by its
  /// devices through a file.
  Result<std::vector<double>> shared(const std::string& label, const std::function<Result<std::vector<double>>()>& compute);
  /// Sends a row of the frontier.
  void frontier(const FrontierRow& row);

  /// True the first time that it is asked with this text.
  bool first_time(const std::string& what) { return seen_.insert(what).second; }

  /// Promises that hold for the whole grid, each a stability row at the end: how many results differ in any bit from
  /// those of C++ float, and the largest share of a bound that was used up.
  void promise_bits(const std::string& kernel, bool equal, const std::string& label);
  void promise_share(const std::string& kernel, const std::string& name, const std::string& promise, double share,
                     const std::string& label);
  void emit_promises();

 private:
  std::shared_ptr<Context> noting(std::shared_ptr<Context> context);
  void send(nlohmann::ordered_json message);
  void load_oracles();
  void save_oracle(const std::string& key, const char* what, nlohmann::ordered_json value);
  bool keep(const std::string& key, const std::string& label);
  void add_bits(const std::string& kernel, bool equal, const std::string& label);
  void add_share(const std::string& kernel, const std::string& name, const std::string& promise, double share,
                 const std::string& label);
  Result<std::vector<Oracle>> oracles(const std::string& key,
                                      const std::function<Result<std::vector<Oracle>>()>& compute);
  template <class Take>
  auto guarded(const Take& take, const std::string& label) -> decltype(take());

  std::shared_ptr<Context> context_, cpu_float_, cpu_double_;
  Settings settings_;
  int rows_;
  Guard guard_;
  Workers workers_;
  int timed_ = 0, retaken_ = 0;
  std::map<std::string, std::vector<Oracle>> oracles_;
  std::map<std::string, std::vector<double>> numbers_;  // of shared()
  std::set<std::string> seen_;
  std::shared_ptr<const std::map<std::string, KeptJob>> kept_;  // of an earlier run, by key
  std::string job_, kernel_;  // the job that runs: its key, and its label's kernel; empty: none
  // Hash by module, of all that jobs of a kernel compiled: scenes and oracles that one of them made serve the next.
  std::map<std::string, std::map<std::string, std::string>> compiled_;
  struct Bits {
    double checked = 0, different = 0;
    std::string first;
  };
  std::map<std::string, Bits> bits_;
  struct Share {
    std::string promise, worst;
    double most = 0;
  };
  std::map<std::pair<std::string, std::string>, Share> shares_;
};

/// Milliseconds of one run of `run`, for Session::interleave.
Session::Timed timed(const std::shared_ptr<cases::Run>& run);

}  // namespace luxel::report

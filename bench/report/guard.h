// Guard against a busy machine: a loop of multiply-adds on two threads, whose rate falls when something else runs.
#pragma once

namespace luxel::report {

class Guard {
 public:
  /// `best`: the best rate seen so far in this session, GFLOP/s; 0: none.
  explicit Guard(double best = 0) : best_(best) {}

  /// Runs the loop for about two milliseconds and returns its rate in GFLOP/s.
  double measure();
  double best() const { return best_; }
  /// Whether a rate says that the machine was ours.
  bool quiet(double rate) const { return rate >= 0.9 * best_; }

 private:
  double best_ = 0;
};

}  // namespace luxel::report

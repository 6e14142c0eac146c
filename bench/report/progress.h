// How far a report is, on stderr: a bar that rewrites its line at a terminal, a line now and then elsewhere.
#pragma once
#include <chrono>
#include <string>

namespace luxel::report {

class Progress {
 public:
  Progress();
  /// Begins the part of one device.
  void begin(const std::string& part);
  void update(double done, double of, const std::string& label);
  /// A line of its own, above the bar.
  void line(const std::string& text);
  /// Takes the bar away.
  void end();

 private:
  bool terminal_;
  std::string part_;
  int shown_tenth_ = -1;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace luxel::report

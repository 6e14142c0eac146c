// The threads on which a CPU driver runs kernels, each kept on a core of its own. Left to the system, two of them share one core
// for tens of milliseconds while another idles: runs then take 1.5 times as long, alike enough that quartiles do not show it.
#pragma once
#include <functional>
#include <vector>

namespace luxel::report {

/// The cores that this process may use.
std::vector<int> cores();
/// Keeps a thread (0: the one that calls) on a core.
void keep_on(int thread, int core);

class Workers {
 public:
  /// Calls `run`, which uses all cores, for ten milliseconds and places the threads that were busy: those but for the one that
  /// calls, where they are as many as the cores. Else (a GPU, a kernel too small) it tries again the next times that it is asked.
  void place(const std::function<bool()>& run);

 private:
  int tries_ = 20;
};

}  // namespace luxel::report

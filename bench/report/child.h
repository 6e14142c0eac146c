// A program run as a child, its lines read as they come. A child that dies or hangs takes only itself along, and none
// outlives this program.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace luxel::report {

struct Ended {
  int status = 0;       // exit status; meaningful where signal is 0 and hung is false
  int signal = 0;       // the signal that ended it
  bool hung = false;    // it wrote nothing for `silence_s` and was killed
  bool started = true;  // false: it could not be run
  bool interrupted = false;  // this program was, and the child was killed

  bool died() const { return signal != 0 || hung || !started; }
  /// "signal 11 (Segmentation fault)", "no answer for 300 s" ...
  std::string reason(int silence_s) const;
};

/// The descriptor on which a child writes its lines.
constexpr int child_fd = 3;

/// While one exists, SIGINT, SIGTERM and SIGHUP do not end this program: `interrupted` tells of them, and run_child kills its child.
class Interruptible {
 public:
  Interruptible();
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;
};
bool interrupted();

/// Runs argv[0] with `environment` added to this process's, in a process group of its own. What it writes to `child_fd` comes
/// line by line to `line`; stdout and stderr go to the file `log`.
Ended run_child(const std::vector<std::string>& argv, const std::vector<std::string>& environment,
                const std::string& log, int silence_s, const std::function<void(const std::string&)>& line);

}  // namespace luxel::report

#include "bench/report/child.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include <fmt/format.h>

extern char** environ;

namespace luxel::report {
namespace {

constexpr std::array ending_signals{SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t asked_to_end = 0;
std::array<struct sigaction, ending_signals.size()> usual;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> p;
  for (std::string& word : words) p.push_back(word.data());
  p.push_back(nullptr);
  return p;
}

// This process's environment with some variables set anew.
std::vector<std::string> merged(const std::vector<std::string>& changes) {
  std::vector<std::string> all = changes;
  for (char** v = environ; *v != nullptr; ++v) {
    const std::string_view entry = *v, name = entry.substr(0, entry.find('='));
    const bool set = std::any_of(changes.begin(), changes.end(),
                                 [&](const std::string& c) { return c.substr(0, c.find('=')) == name; });
    if (!set) all.emplace_back(entry);
  }
  return all;
}

}  // namespace

Interruptible::Interruptible() {
  asked_to_end = 0;
  struct sigaction action{};
  action.sa_handler = [](int) { asked_to_end = 1; };  // no SA_RESTART: poll returns
  for (std::size_t i = 0; i < ending_signals.size(); ++i) ::sigaction(ending_signals[i], &action, &usual[i]);
}

Interruptible::~Interruptible() {
  for (std::size_t i = 0; i < ending_signals.size(); ++i) ::sigaction(ending_signals[i], &usual[i], nullptr);
}

bool interrupted() { return asked_to_end != 0; }

std::string Ended::reason(int silence_s) const {
  if (!started) return "could not be started";
  if (hung) return fmt::format("no answer for {} s", silence_s);
  if (signal != 0) return fmt::format("signal {} ({})", signal, strsignal(signal));
  return fmt::format("exit status {}", status);
}

Ended run_child(const std::vector<std::string>& argv, const std::vector<std::string>& environment,
                const std::string& log, int silence_s, const std::function<void(const std::string&)>& line) {
  std::vector<std::string> words = argv, variables = merged(environment);
  const std::vector<char*> word_pointers = pointers(words), variable_pointers = pointers(variables);
  Ended ended;
  int ends[2];
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out < 0 || ::pipe2(ends, O_CLOEXEC) != 0) {
    if (out >= 0) ::close(out);
    ended.started = false;
    return ended;
  }
  const pid_t parent = ::getpid(), pid = ::fork();
  if (pid == 0) {  // only calls that are safe between fork and exec
    ::setpgid(0, 0);  // what the driver starts (a linker) ends with it
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
    ::dup2(out, 1);
    ::dup2(out, 2);
    if (ends[1] == child_fd)
      ::fcntl(child_fd, F_SETFD, 0);
    else
      ::dup2(ends[1], child_fd);
    ::execve(word_pointers[0], word_pointers.data(), variable_pointers.data());
    ::_exit(127);
  }
  ::close(out);
  ::close(ends[1]);
  if (pid < 0) {
    ::close(ends[0]);
    ended.started = false;
    return ended;
  }

  ::setpgid(pid, pid);  // whichever of the two comes first
  std::string text;
  char buffer[1 << 16];
  auto heard = std::chrono::steady_clock::now();
  for (;;) {
    pollfd wait{ends[0], POLLIN, 0};
    const int ready = ::poll(&wait, 1, 200);  // not longer: a signal may come just before
    ended.interrupted = interrupted();
    ended.hung = ready == 0 && std::chrono::steady_clock::now() - heard > std::chrono::seconds(silence_s);
    if (ended.interrupted || ended.hung) {
      ::kill(-pid, SIGKILL);
      break;
    }
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    heard = std::chrono::steady_clock::now();
    const ssize_t n = ::read(ends[0], buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    text.append(buffer, static_cast<std::size_t>(n));
    for (std::size_t end; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
      line(text.substr(0, end));
  }
  ::close(ends[0]);
  int state = 0;
  while (::waitpid(pid, &state, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(state)) ended.signal = WTERMSIG(state);
  if (WIFEXITED(state)) ended.status = WEXITSTATUS(state);
  if (ended.status == 127) ended.started = false;
  return ended;
}

}  // namespace luxel::report

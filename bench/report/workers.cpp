#include "bench/report/workers.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace luxel::report {
namespace {

// Nanoseconds that each thread but the one that calls has run, by its id.
std::map<int, double> spent() {
  std::map<int, double> ns;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", failed)) {
    const int thread = std::stoi(entry.path().filename().string());
    if (thread != ::gettid()) std::ifstream(entry.path() / "schedstat") >> ns[thread];
  }
  return ns;
}

}  // namespace

std::vector<int> cores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<int> found;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return found;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &allowed)) found.push_back(core);
  return found;
}

void keep_on(int thread, int core) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  ::sched_setaffinity(thread, sizeof one, &one);
}

void Workers::place(const std::function<bool()>& run) {
  if (tries_ == 0) return;
  --tries_;
  std::map<int, double> before = spent();
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(10))
    if (!run()) return;
  std::map<int, double> ran = spent();
  double most = 0;
  for (auto& [thread, ns] : ran) most = std::max(most, ns -= before[thread]);
  std::erase_if(ran, [&](const auto& entry) { return entry.second < 0.5 * most; });
  const std::vector<int> places = cores();
  if (most < 1e6 || ran.size() != places.size()) return;
  for (std::size_t i = 0; const auto& [thread, ns] : ran) keep_on(thread, places[i++]);
  tries_ = 0;
}

}  // namespace luxel::report

#include "bench/report/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

namespace luxel::report {
namespace {

std::size_t columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1), begin_(std::chrono::steady_clock::now()) {}

void Progress::begin(const std::string& part) {
  part_ = part;
  shown_tenth_ = -1;
}

void Progress::update(double done, double of, const std::string& label) {
  const double share = of > 0 ? done / of : 1;
  const auto seconds =
      std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin_).count();
  if (terminal_) {
    constexpr int width = 24;
    const int full = std::clamp(static_cast<int>(share * width), 0, width);
    std::string text = fmt::format("{:>3}:{:02} [{}{}] {:.0f}/{:.0f} {}: {}", seconds / 60, seconds % 60,
                                   std::string(full, '#'), std::string(width - full, '.'), done, of, part_, label);
    if (text.size() > columns() - 1) text.resize(columns() - 1);
    std::fprintf(stderr, "\r\033[K%s", text.c_str());
    std::fflush(stderr);
    return;
  }
  const int tenth = static_cast<int>(share * 10);
  if (tenth == shown_tenth_) return;
  shown_tenth_ = tenth;
  std::fprintf(stderr, "luxel: %s: %d %% after %d:%02d\n", part_.c_str(), tenth * 10, static_cast<int>(seconds / 60),
               static_cast<int>(seconds % 60));
}

void Progress::line(const std::string& text) {
  if (terminal_) std::fprintf(stderr, "\r\033[K");
  std::fprintf(stderr, "luxel: %s\n", text.c_str());
}

void Progress::end() {
  if (terminal_) std::fprintf(stderr, "\r\033[K");
}

}  // namespace luxel::report

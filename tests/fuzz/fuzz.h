// Bytes, as a fuzzer makes them, taken apart; and what must hold.
#pragma once
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include <luxel/status.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace luxel::fuzz {

/// Ends the run where a promise is broken, also in a release build.
inline void require(bool holds, const char* what, const std::string& detail = {}) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: broken: %s %s\n", what, detail.c_str());
  std::abort();
}

/// A refusal is one line, and says something.
inline void require_one_line(const Status& status) {
  require(!status.message().empty() && status.message().find('\n') == std::string::npos, "a refusal is one line:",
          status.message());
}

/// Numbers and choices from bytes; zeros once they are used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const std::uint8_t value = rest_[0];
    rest_ = rest_.subspan(1);
    return value;
  }

  std::size_t below(std::size_t count) { return byte() % count; }

  template <class T>
  T value() {
    std::uint8_t raw[sizeof(T)];
    for (std::uint8_t& b : raw) b = byte();
    T made;
    std::memcpy(&made, raw, sizeof made);
    return made;
  }

  std::string text(std::size_t most) {
    std::string made;
    for (std::size_t n = below(most + 1); n > 0 && !empty(); --n) made += static_cast<char>(byte());
    return made;
  }

  bool empty() const { return rest_.empty(); }

 private:
  std::span<const std::uint8_t> rest_;
};

/// A file in memory, with a path for readers that take one.
class MemoryFile {
 public:
  MemoryFile(const void* data, std::size_t size) : fd_(memfd_create("luxel-fuzz", 0)) {
    require(fd_ >= 0 && ::write(fd_, data, size) == static_cast<ssize_t>(size), "a file in memory can be made");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

}  // namespace luxel::fuzz

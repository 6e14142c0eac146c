// What of this process lies in memory, for tests that nothing is kept.
#pragma once
#include <cstddef>
#include <cstdio>
#include <unistd.h>

namespace luxel {

inline std::size_t resident_bytes() {
  long pages = 0, all = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%ld %ld", &all, &pages) != 2) pages = 0;
    std::fclose(file);
  }
  return static_cast<std::size_t>(pages) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Allocators keep what they once had: growth below this is none. 10,000 leaks of 64 bytes are above it.
constexpr std::size_t resident_noise = 512 * 1024;

}  // namespace luxel

// What of this process lies in memory, for tests that nothing is kept.
#pragma once
#include <malloc.h>

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

/// What the allocator has handed out: what lies in memory hides small leaks in room that was free before.
inline std::size_t allocated_bytes() {
  const auto heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

/// Drivers' threads may hold some at any moment; 9000 leaks of 16 bytes are above it.
constexpr std::size_t allocated_noise = 128 * 1024;

/// Allocators keep what they once had: growth below this is none.
/// (AddressSanitizer keeps what is freed for a while, and finds leaks itself.)
#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t resident_noise = std::size_t{1} << 30;
#else
constexpr std::size_t resident_noise = 512 * 1024;
#endif

}  // namespace luxel

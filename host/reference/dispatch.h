// What the C++ execution hands to a kernel: memory, values, and the range of workgroups to run.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include <luxel/plan.h>

namespace luxel::reference {

/// Memory behind one binding.
struct Memory {
  void* data = nullptr;
  std::size_t bytes = 0;
  std::array<int, 3> extent{1, 1, 1};   // images, texels
  Format format = Format::f32x4;        // images
  Address address = Address::clamp;     // sampled images
};

/// A range of workgroups [first, last) of one pass, counted x first.
struct Dispatch {
  std::span<const Memory> bindings;     // in the order of the module's bindings
  std::span<const double> parameters;
  std::span<const double> constants;
  std::array<int, 3> workgroup{1, 1, 1};
  std::array<int, 3> groups{1, 1, 1};
  std::size_t first = 0;
  std::size_t last = 0;
  std::atomic<std::size_t>* outside = nullptr;  // accesses that were out of bounds, and were not made
};

}  // namespace luxel::reference

/// \file
/// Running luxel plans as C++ on this CPU, in float (the devices' bits) or in double (the oracle).
#pragma once
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <luxel/plan.h>

/// Plans as C++ on this CPU.
namespace luxel::reference {

/// real32: floats and storage formats as on a device. real64: the same source in double; every pixel
/// channel of every format is a double (so bytes per pixel is 8 times the channels), u32 stays u32.
enum class Precision { real32, real64 };

/// One resource of a plan. Images: texels tightly packed, row after row, slice after slice.
struct Binding {
  std::string_view name;  ///< of the resource, or `scratch`
  void* data = nullptr;  ///< aligned to 16 bytes
  std::size_t bytes = 0;  ///< that `data` holds
};

/// Runs the plan on `threads` threads (0: all cores). Scratch comes from the heap unless bound as `scratch`
/// (real32 only). Errors: invalid_argument as on the devices; internal when the kernel left a binding's bounds.
Status run(const Plan& plan, const std::vector<Binding>& bindings, Precision precision = Precision::real32, int threads = 0);

/// Least bytes of a resource of a plan in a precision.
std::size_t resource_bytes(const Resource& resource, Precision precision);

}  // namespace luxel::reference

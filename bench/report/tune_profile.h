// The shapes that a device is fastest with, found by measuring, one after the other.
#pragma once
#include <string>

namespace luxel::report {

/// Measures lanes, block, unrolling, splitting and workgroups of each of a profile's shapes by the kernel that leans on it most,
/// workgroup memory and texel buffers; a value replaces another only where all quartiles of the pairwise ratio of times, taken
/// in turn, say so and the result has the same bits. Writes the device's profile file (profile_file.h) or, with `path`, that
/// file; prints what changed. The program's exit status.
int run_tune_profile(const std::string& device, const std::string& path, bool quick);

}  // namespace luxel::report

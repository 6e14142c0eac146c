// Values as a device stores them, and back, through doubles: nothing is lost between executions.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <luxel/plan.h>

namespace luxel::cases {

/// Channel values as `format` stores them, `channels(format)` a pixel. `real64`: doubles, whatever the format (u32
/// stays).
std::vector<std::byte> store(std::span<const double> values, Format format, bool real64);

/// The channel values in `data`, as store lays them out.
std::vector<double> fetch(std::span<const std::byte> data, Format format, bool real64);

/// The values that `format` holds of these: rounded as kernels/math/packing.h rounds.
std::vector<double> quantise(std::span<const double> values, Format format);

/// Distance from |value| to the next larger value of the format: 1/255 for unorm8, 1 for u32.
double step(Format format, double value);

}  // namespace luxel::cases

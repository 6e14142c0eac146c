// Values of files as devices store them, and back.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <luxel/plan.h>

namespace luxel::io {

/// Format that holds `channels` (1..4) values per pixel: `base` is f32x1 (f32x1, f32x2 or f32x4 are chosen), f16x4 or
/// unorm8x4. Three channels take four.
Format format_for(Format base, int channels);

/// Pixels as a device stores them in `format`. `values` are interleaved, `channels` per pixel, at most those of the
/// format; further channels of the format are filled with `fill`. `real64`: every channel is a double, whatever the
/// format.
std::vector<std::uint8_t> pack(std::span<const float> values, int channels, Format format, bool real64,
                               float fill = 0.0f);

/// The first `channels` channels of each pixel in `data`, as pack lays them out.
std::vector<float> unpack(std::span<const std::uint8_t> data, Format format, bool real64, int channels);

}  // namespace luxel::io

#include "pixels.h"

#include <algorithm>
#include <cstring>

namespace luxel::io {
namespace {

using uint = unsigned int;
uint floatBitsToUint(float v) { uint u; std::memcpy(&u, &v, 4); return u; }
float uintBitsToFloat(uint u) { float v; std::memcpy(&v, &u, 4); return v; }
#define FN inline
#include "kernels/math/packing.h"
#undef FN

template <class T, class Encode>
std::vector<std::uint8_t> pack_as(std::span<const float> values, std::size_t from, std::size_t to, float fill,
                                  Encode encode) {
  const std::size_t pixels = values.size() / from;
  std::vector<std::uint8_t> out(pixels * to * sizeof(T));
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < to; ++c) {
      const T v = static_cast<T>(encode(c < from ? values[p * from + c] : fill));
      std::memcpy(out.data() + (p * to + c) * sizeof(T), &v, sizeof(T));
    }
  return out;
}

template <class T, class Decode>
std::vector<float> unpack_as(std::span<const std::uint8_t> data, std::size_t from, std::size_t to, Decode decode) {
  const std::size_t pixels = data.size() / (from * sizeof(T));
  std::vector<float> out(pixels * to);
  for (std::size_t p = 0; p < pixels; ++p)
    for (std::size_t c = 0; c < to; ++c) {
      T v;
      std::memcpy(&v, data.data() + (p * from + c) * sizeof(T), sizeof(T));
      out[p * to + c] = static_cast<float>(decode(v));
    }
  return out;
}

}  // namespace

Format format_for(Format base, int channels) {
  if (base != Format::f32x1) return base;
  return channels == 1 ? Format::f32x1 : channels == 2 ? Format::f32x2 : Format::f32x4;
}

std::vector<std::uint8_t> pack(std::span<const float> values, int count, Format format, bool real64, float fill) {
  const auto from = static_cast<std::size_t>(count), to = static_cast<std::size_t>(channels(format));
  if (real64) return pack_as<double>(values, from, to, fill, [](float v) { return double(v); });
  switch (format) {
    case Format::f16x2: case Format::f16x4: return pack_as<std::uint16_t>(values, from, to, fill, f16_bits);
    case Format::unorm8x4: return pack_as<std::uint8_t>(values, from, to, fill, unorm8_bits);
    case Format::u32:  // up to the largest float below 2^32
      return pack_as<std::uint32_t>(values, from, to, fill,
                                    [](float v) { return v > 0.0f ? std::min(v, 4294967040.0f) : 0.0f; });
    case Format::f32x1: case Format::f32x2: case Format::f32x4: break;
  }
  return pack_as<float>(values, from, to, fill, [](float v) { return v; });
}

std::vector<float> unpack(std::span<const std::uint8_t> data, Format format, bool real64, int count) {
  const auto from = static_cast<std::size_t>(channels(format)), to = static_cast<std::size_t>(count);
  if (real64) return unpack_as<double>(data, from, to, [](double v) { return v; });
  switch (format) {
    case Format::f16x2: case Format::f16x4: return unpack_as<std::uint16_t>(data, from, to, f16_value);
    case Format::unorm8x4: return unpack_as<std::uint8_t>(data, from, to, unorm8_value);
    case Format::u32: return unpack_as<std::uint32_t>(data, from, to, [](std::uint32_t v) { return v; });
    case Format::f32x1: case Format::f32x2: case Format::f32x4: break;
  }
  return unpack_as<float>(data, from, to, [](float v) { return v; });
}

}  // namespace luxel::io

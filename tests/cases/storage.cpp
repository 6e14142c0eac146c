#include "tests/cases/storage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace luxel::cases {
namespace {

using uint = unsigned int;
uint floatBitsToUint(float v) {
  uint u;
  std::memcpy(&u, &v, 4);
  return u;
}
float uintBitsToFloat(uint u) {
  float v;
  std::memcpy(&v, &u, 4);
  return v;
}
#define FN inline
#include "kernels/math/packing.h"
#undef FN

template <class T, class Encode>
std::vector<std::byte> store_as(std::span<const double> values, Encode encode) {
  std::vector<std::byte> data(values.size() * sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const T v = static_cast<T>(encode(values[i]));
    std::memcpy(data.data() + i * sizeof(T), &v, sizeof(T));
  }
  return data;
}

template <class T, class Decode>
std::vector<double> fetch_as(std::span<const std::byte> data, Decode decode) {
  std::vector<double> values(data.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    T v;
    std::memcpy(&v, data.data() + i * sizeof(T), sizeof(T));
    values[i] = static_cast<double>(decode(v));
  }
  return values;
}

enum class Channel { f32, f16, unorm8, u32 };

Channel channel_of(Format format) {
  switch (format) {
    case Format::f16x2:
    case Format::f16x4: return Channel::f16;
    case Format::unorm8x4: return Channel::unorm8;
    case Format::u32: return Channel::u32;
    default: return Channel::f32;
  }
}

}  // namespace

std::vector<std::byte> store(std::span<const double> values, Format format, bool real64) {
  const Channel channel = channel_of(format);
  if (channel == Channel::u32) return store_as<std::uint32_t>(values, [](double v) { return v; });
  if (real64) return store_as<double>(values, [](double v) { return v; });
  if (channel == Channel::f16)
    return store_as<std::uint16_t>(values, [](double v) { return f16_bits(static_cast<float>(v)); });
  if (channel == Channel::unorm8)
    return store_as<std::uint8_t>(values, [](double v) { return unorm8_bits(static_cast<float>(v)); });
  return store_as<float>(values, [](double v) { return v; });
}

std::vector<double> fetch(std::span<const std::byte> data, Format format, bool real64) {
  const Channel channel = channel_of(format);
  if (channel == Channel::u32) return fetch_as<std::uint32_t>(data, [](std::uint32_t v) { return v; });
  if (real64) return fetch_as<double>(data, [](double v) { return v; });
  if (channel == Channel::f16) return fetch_as<std::uint16_t>(data, [](std::uint16_t v) { return f16_value(v); });
  if (channel == Channel::unorm8) return fetch_as<std::uint8_t>(data, [](std::uint8_t v) { return unorm8_value(v); });
  return fetch_as<float>(data, [](float v) { return v; });
}

std::vector<double> quantise(std::span<const double> values, Format format) {
  return fetch(store(values, format, false), format, false);
}

double step(Format format, double value) {
  const double size = std::fabs(value);
  switch (channel_of(format)) {
    case Channel::unorm8: return 1.0 / 255.0;
    case Channel::u32: return 1.0;
    case Channel::f16: return std::ldexp(1.0, (size < 0x1p-14 ? -14 : std::min(std::ilogb(size), 15)) - 10);
    case Channel::f32: break;
  }
  return std::ldexp(1.0, (size < 0x1p-126 ? -126 : std::min(std::ilogb(size), 127)) - 23);
}

}  // namespace luxel::cases

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>

#include <fmt/format.h>

#include "codecs.h"
#include "stb.h"

namespace luxel::io {
namespace {

constexpr std::string_view magic("\x89PNG\r\n\x1a\n", 8);
constexpr std::size_t largest_bytes = std::size_t{1} << 30;  // stb counts in int
constexpr std::size_t most_expansion = 1032;  // of deflate: 258 bytes from two bits

std::uint32_t big_endian(const std::uint8_t* p) {
  return std::uint32_t{p[0]} << 24 | std::uint32_t{p[1]} << 16 | std::uint32_t{p[2]} << 8 | p[3];
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t i = 0; i < 256; ++i) {
      t[i] = i;
      for (int k = 0; k < 8; ++k) t[i] = (t[i] & 1) != 0 ? t[i] >> 1 ^ 0xedb88320u : t[i] >> 1;
    }
    return t;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const std::uint8_t b : bytes) crc = table[(crc ^ b) & 255] ^ crc >> 8;
  return ~crc;
}

// stb_image reads neither checksums nor the end of the file, and allocates before it looks at the data. So the chunks
// are walked first.
Status check_chunks(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (bytes.size() < 8 || std::memcmp(bytes.data(), magic.data(), 8) != 0)
    return failure(file, "is not a PNG file", "check the name and the format");
  std::size_t at = 8, compressed = 0;
  double needed = 0;
  while (true) {
    if (bytes.size() - at < 12) return failure(file, "ends within the PNG data", damaged);
    const std::size_t length = big_endian(&bytes[at]);
    if (length > bytes.size() - at - 12) return failure(file, "ends within the PNG data", damaged);
    const std::uint8_t* data = &bytes[at + 8];
    const std::string_view type(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (crc32(bytes.subspan(at + 4, length + 4)) != big_endian(data + length))
      return failure(file, fmt::format("has a wrong checksum in the PNG chunk at byte {}", at), damaged);
    if (at == 8) {
      if (type != "IHDR" || length != 13) return failure(file, "does not begin with a PNG header", damaged);
      const std::uint32_t width = big_endian(data), height = big_endian(data + 4);
      if (width < 1 || height < 1 || width > largest_side || height > largest_side)
        return failure(file, fmt::format("is {}x{} pixels; expected 1..{} each way", width, height, largest_side),
                       "crop or scale the image");
      const int samples = data[9] == 2 ? 3 : data[9] == 4 ? 2 : data[9] == 6 ? 4 : 1;
      needed = double(height) * std::ceil(double(width) * samples * data[8] / 8);
    }
    if (type == "IDAT") compressed += length;
    at += 12 + length;
    if (type == "IEND") break;
  }
  if (needed > double(largest_bytes) || bytes.size() > largest_bytes)
    return failure(file, "exceeds 1 GiB", "save it as NPY or EXR");
  if (needed > double(compressed) * most_expansion) return failure(file, "holds too few bytes for its size", damaged);
  return {};
}

struct Free {
  void operator()(void* p) const { stbi_image_free(p); }
};

template <class T>
Image normalised(const T* values, int width, int height, int channels) {
  const std::size_t count = std::size_t(width) * std::size_t(height) * std::size_t(channels);
  Image image{width, height, channels, std::vector<float>(count)};
  for (std::size_t i = 0; i < count; ++i)
    image.pixels[i] = static_cast<float>(values[i]) / static_cast<float>(std::numeric_limits<T>::max());
  return image;
}

}  // namespace

Result<Image> decode_png(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (Status s = check_chunks(bytes, file); !s) return s;
  const auto length = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_is_16_bit_from_memory(bytes.data(), length)) {
    const std::unique_ptr<stbi_us, Free> values(
        stbi_load_16_from_memory(bytes.data(), length, &width, &height, &channels, 0));
    if (values) return normalised(values.get(), width, height, channels);
  } else {
    const std::unique_ptr<stbi_uc, Free> values(
        stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 0));
    if (values) return normalised(values.get(), width, height, channels);
  }
  return failure(file, "holds PNG data that cannot be decoded", damaged);
}

Result<Bytes> encode_png(const Image& image, const std::string& file, WriteReport& report) {
  if (image.pixels.size() > largest_bytes)
    return Status(Code::invalid_argument, fmt::format("{}: an image of {}x{}x{} exceeds 1 GiB as PNG; write NPY or EXR",
                                                      file, image.width, image.height, image.channels));
  Bytes values(image.pixels.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float v = image.pixels[i];
    if (std::isnan(v)) ++report.not_finite;
    else if (v < 0.0f || v > 1.0f) ++report.out_of_range;
    values[i] = v > 0.0f ? static_cast<std::uint8_t>(std::nearbyint(std::min(v, 1.0f) * 255.0f)) : 0;  // half to even
  }
  Bytes out;
  const auto append = [](void* context, void* data, int size) {
    const auto* p = static_cast<const std::uint8_t*>(data);
    static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), p, p + size);
  };
  if (!stbi_write_png_to_func(append, &out, image.width, image.height, image.channels, values.data(), 0))
    return Status(Code::out_of_memory, file + ": encoding does not fit into memory; use a smaller image");
  return out;
}

}  // namespace luxel::io

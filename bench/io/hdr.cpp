#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "codecs.h"
#include "stb.h"

namespace luxel::io {
namespace {

// Largest value of a pixel: mantissa 255 with exponent 127 + 128, below the power of two that would overflow the
// exponent.
constexpr float largest = 255.0f / 256.0f * 0x1p127f;

// Radiance RGBE. Written here since stb_image reads damaged files without end or past them.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool line(std::string_view& text) {
    const auto end = std::find(rest_.begin(), rest_.end(), std::uint8_t{'\n'});
    if (end == rest_.end()) return false;
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    text = std::string_view(reinterpret_cast<const char*>(rest_.data()), length);
    if (text.ends_with('\r')) text.remove_suffix(1);
    rest_ = rest_.subspan(length + 1);
    return true;
  }

  /// One scanline of `width` RGBE pixels. False at the end of the file or for a run that leaves the line.
  bool scanline(std::span<std::uint8_t> rgbe) {
    const std::size_t width = rgbe.size() / 4;
    const bool runs =
        rest_.size() >= 4 && rest_[0] == 2 && rest_[1] == 2 && rest_[2] < 128 && width >= 8 && width < 32768;
    return runs ? planes(rgbe, width) : pixels(rgbe, width);
  }

 private:
  // The channels one after the other, each in runs and literal pieces.
  bool planes(std::span<std::uint8_t> rgbe, std::size_t width) {
    if ((std::size_t{rest_[2]} << 8 | rest_[3]) != width) return false;
    rest_ = rest_.subspan(4);
    for (std::size_t channel = 0; channel < 4; ++channel)
      for (std::size_t x = 0; x < width;) {
        if (rest_.empty()) return false;
        const bool run = rest_[0] > 128;
        const std::size_t count = run ? rest_[0] - 128u : rest_[0];
        const std::size_t bytes = run ? 1 : count;
        if (count == 0 || count > width - x || rest_.size() < 1 + bytes) return false;
        for (std::size_t i = 0; i < count; ++i, ++x) rgbe[4 * x + channel] = rest_[run ? 1 : 1 + i];
        rest_ = rest_.subspan(1 + bytes);
      }
    return true;
  }

  // Pixel by pixel; 1 1 1 n repeats the pixel before, and consecutive ones shift n by eight bits more.
  bool pixels(std::span<std::uint8_t> rgbe, std::size_t width) {
    std::size_t x = 0;
    for (int shift = 0; x < width;) {
      if (rest_.size() < 4) return false;
      if (rest_[0] == 1 && rest_[1] == 1 && rest_[2] == 1) {
        const std::size_t count = shift > 16 ? width : std::size_t{rest_[3]} << shift;
        if (x == 0 || count > width - x) return false;
        for (std::size_t i = 0; i < 4 * count; ++i) rgbe[4 * x + i] = rgbe[4 * (x - 1) + i % 4];
        x += count;
        shift += 8;
      } else {
        std::copy_n(rest_.begin(), 4, rgbe.begin() + static_cast<std::ptrdiff_t>(4 * x));
        ++x;
        shift = 0;
      }
      rest_ = rest_.subspan(4);
    }
    return true;
  }

  std::span<const std::uint8_t> rest_;
};

// "-Y height +X width": rows from the top, pixels from the left.
bool resolution(std::string_view text, long& width, long& height) {
  const auto number = [&](std::string_view prefix, long& value) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc();
  };
  return number("-Y ", height) && number(" +X ", width) && text.empty();
}

}  // namespace

Result<Image> decode_hdr(std::span<const std::uint8_t> bytes, const std::string& file) {
  Reader reader(bytes);
  std::string_view text;
  if (!reader.line(text) || !(text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE")))
    return failure(file, "is not a Radiance HDR file", "check the name and the format");
  bool rgbe = false;
  while (true) {
    if (!reader.line(text)) return failure(file, "ends within the HDR header", damaged);
    if (text.empty()) break;
    if (text.starts_with("FORMAT=")) rgbe = text == "FORMAT=32-bit_rle_rgbe";
  }
  if (!rgbe) return failure(file, "is not in the format 32-bit_rle_rgbe", "convert it to RGBE or to EXR");
  long width = 0, height = 0;
  if (!reader.line(text)) return failure(file, "ends within the HDR header", damaged);
  if (!resolution(text, width, height))
    return failure(file, "has no resolution line of the form -Y height +X width", "convert it to rows from the top");
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    return failure(file, fmt::format("is {}x{} pixels; expected 1..{} each way", width, height, largest_side),
                   "crop or scale the image");

  // Pixels are appended as they are decoded, so that a false size in the header allocates nothing.
  const auto w = static_cast<std::size_t>(width), h = static_cast<std::size_t>(height);
  Image image{static_cast<int>(width), static_cast<int>(height), 3, {}};
  std::vector<std::uint8_t> line(4 * w);
  for (std::size_t y = 0; y < h; ++y) {
    if (!reader.scanline(line))
      return failure(file, fmt::format("is truncated or damaged in row {} of {}", y, h), damaged);
    for (std::size_t x = 0; x < w; ++x) {
      const float scale = line[4 * x + 3] == 0 ? 0.0f : std::ldexp(1.0f, line[4 * x + 3] - 136);
      for (std::size_t c = 0; c < 3; ++c) image.pixels.push_back(static_cast<float>(line[4 * x + c]) * scale);
    }
  }
  return image;
}

Result<Bytes> encode_hdr(const Image& image, const std::string& file, WriteReport& report) {
  const auto refuse = [&](const char* what) {
    return Status(Code::invalid_argument, fmt::format("{}: {}", file, what));
  };
  if (image.pixels.size() > std::size_t{1} << 30)  // stb counts in int
    return refuse("the image has more than 2^30 values, too many for HDR; write EXR or NPY");
  if (image.channels == 2) return refuse("HDR files hold 1 or 3 channels, the image has 2; write EXR or NPY");
  if (image.channels == 4)
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
      if (image.pixels[i] != 1.0f)
        return refuse("HDR files hold no alpha, and the image's is not 1 everywhere; write EXR or NPY");
  std::vector<float> values(image.pixels.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float v = image.pixels[i];
    if (!std::isfinite(v)) ++report.not_finite;
    else if (v < 0.0f || v > largest) ++report.out_of_range;
    values[i] = v > 0.0f ? std::min(v, largest) : 0.0f;
  }
  Bytes out;
  const auto append = [](void* context, void* data, int size) {
    const auto* p = static_cast<const std::uint8_t*>(data);
    static_cast<Bytes*>(context)->insert(static_cast<Bytes*>(context)->end(), p, p + size);
  };
  if (!stbi_write_hdr_to_func(append, &out, image.width, image.height, image.channels, values.data()))
    return Status(Code::out_of_memory, file + ": encoding does not fit into memory; use a smaller image");
  return out;
}

}  // namespace luxel::io

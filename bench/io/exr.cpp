#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <fmt/format.h>

#include "codecs.h"

namespace luxel::io {
namespace {

// What a compression can do, by its number in the file: rows in a chunk, and most bytes of pixels from a byte of file.
struct Compression {
  int rows;
  double expansion;
};
constexpr std::array<Compression, 10> compressions{{
    {1, 1},                           // none
    {1, 64},                          // RLE: 128 bytes from 2
    {1, 1032}, {16, 1032},            // ZIPS, ZIP: deflate makes 258 bytes from two bits
    {32, 512},                        // PIZ: 256 halves from a code, a run code and 8 bits
    {16, 1376},                       // PXR24: deflate, and floats of 3 bytes
    {32, 11}, {32, 11},               // B44, B44A: 4x4 halves from 3 bytes
    {32, 64 * 1032}, {256, 64 * 1032} // DWAA, DWAB: 8x8 halves from one coefficient of 2 bytes, then deflate
}};
constexpr double small = 16.0 * 1024 * 1024;  // bytes of pixels that any file may ask for

class MemoryIn final : public Imf::IStream {
 public:
  MemoryIn(std::span<const std::uint8_t> bytes, const std::string& file) : IStream(file.c_str()), bytes_(bytes) {}

  bool read(char out[], int n) override {
    if (n < 0 || std::uint64_t(n) > bytes_.size() - at_) throw Iex::InputExc("unexpected end of the file");
    std::memcpy(out, bytes_.data() + at_, std::size_t(n));
    at_ += std::size_t(n);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw Iex::InputExc("an offset beyond the end of the file");
    at_ = std::size_t(position);
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

class MemoryOut final : public Imf::OStream {
 public:
  explicit MemoryOut(const std::string& file) : OStream(file.c_str()) {}

  void write(const char c[], int n) override {
    const auto count = std::size_t(n);
    if (bytes.size() < at_ + count) bytes.resize(at_ + count);
    std::memcpy(bytes.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = std::size_t(position); }

  Bytes bytes;

 private:
  std::size_t at_ = 0;
};

// OpenEXR allocates what a header asks for before it looks for the data. So headers are walked first: every attribute
// must lie in the file, and the pixels must be what so many bytes can hold.
class Walk {
 public:
  Walk(std::span<const std::uint8_t> bytes, const std::string& file) : rest_(bytes), all_(bytes), file_(file) {}

  Status check() {
    std::uint32_t magic = 0, version = 0;
    if (!number(magic) || magic != 20000630)
      return failure(file_, "is not an OpenEXR file", "check the name and the format");
    if (!number(version)) return truncated();
    if ((version & 255) != 2)
      return failure(file_, fmt::format("has OpenEXR version {}; expected 2", version & 255), damaged);
    const bool multipart = (version & 0x1000) != 0;
    if ((version & 0x800) != 0 && !multipart) return failure(file_, "holds only deep data", "flatten it");
    const bool tiled = (version & 0x200) != 0;
    bool end = false;
    do {
      if (Status s = header(end); !s) return s;
    } while (multipart && !end);
    return multipart || tiled ? Status() : chunks();
  }

 private:
  Status truncated() const { return failure(file_, "ends within the OpenEXR header", damaged); }

  template <class T>
  bool number(T& value) {
    return take(rest_, value);
  }

  template <class T>
  static bool take(std::span<const std::uint8_t>& from, T& value) {
    if (from.size() < sizeof value) return false;
    std::memcpy(&value, from.data(), sizeof value);
    from = from.subspan(sizeof value);
    return true;
  }

  static bool text(std::span<const std::uint8_t>& from, std::string_view& value) {
    const auto end = std::find(from.begin(), from.end(), std::uint8_t{0});
    if (end == from.end()) return false;
    const auto length = static_cast<std::size_t>(end - from.begin());
    value = std::string_view(reinterpret_cast<const char*>(from.data()), length);
    from = from.subspan(length + 1);
    return true;
  }

  // OpenEXR reads attributes of these types by the size of the type, so that another size would shift what follows.
  static bool has_size_of(std::string_view type, std::span<const std::uint8_t> data) {
    static const std::map<std::string_view, std::size_t> sizes{
        {"box2i", 16}, {"box2f", 16}, {"chromaticities", 32}, {"compression", 1}, {"deepImageState", 1}, {"double", 8},
        {"envmap", 1}, {"float", 4}, {"int", 4}, {"keycode", 28}, {"lineOrder", 1}, {"m33f", 36},
        {"m33d", 72}, {"m44f", 64}, {"m44d", 128}, {"rational", 8}, {"tiledesc", 9}, {"timecode", 8},
        {"v2i", 8}, {"v2f", 8}, {"v2d", 16}, {"v3i", 12}, {"v3f", 12}, {"v3d", 24}};
    if (type == "preview") {
      std::array<std::uint32_t, 2> extent{};
      return take(data, extent) && double(extent[0]) * double(extent[1]) * 4 == double(data.size());
    }
    const auto known = sizes.find(type);
    return known == sizes.end() || known->second == data.size();
  }

  // `end`: nothing but the mark that no further part follows.
  Status header(bool& end) {
    std::array<std::int32_t, 4> window{0, 0, -1, -1};
    double pixel_bytes = 0, tile = 0;
    std::uint8_t compression = 0;
    bool first = true;
    subsampled_ = false;
    while (true) {
      std::string_view name, type;
      std::int32_t size = 0;
      if (!text(rest_, name)) return truncated();
      if (name.empty()) break;
      if (!text(rest_, type) || !number(size) || size < 0 || std::size_t(size) > rest_.size()) return truncated();
      first = false;
      std::span<const std::uint8_t> data = rest_.first(std::size_t(size));
      rest_ = rest_.subspan(std::size_t(size));
      if (!has_size_of(type, data))
        return failure(file_,
                       fmt::format("has an OpenEXR attribute of {} bytes, which is not what its type needs", size),
                       damaged);
      if (name == "compression" && !take(data, compression)) return truncated();
      if (name == "dataWindow" && !take(data, window)) return truncated();
      if (name == "tiles") {
        std::array<std::uint32_t, 2> extent{};
        if (!take(data, extent)) return truncated();
        tile = double(extent[0]) * double(extent[1]);
      }
      if (name == "channels") {
        std::string_view channel;
        std::array<std::int32_t, 4> entry{};  // type, flags, sampling in x and y
        while (true) {
          if (!text(data, channel) || channel.empty() != data.empty() || (!channel.empty() && !take(data, entry)))
            return failure(file_, "has a malformed list of channels", damaged);
          if (channel.empty()) break;
          subsampled_ |= entry[2] != 1 || entry[3] != 1;
          pixel_bytes += entry[0] == 1 ? 2 : 4;
        }
      }
    }
    end = first;
    if (first) return {};
    if (compression >= compressions.size())
      return failure(file_, fmt::format("has OpenEXR compression {}; expected 0..9", compression),
                     "export it with ZIP");
    compression_ = compressions[compression];
    const double width = double(window[2]) - window[0] + 1, height = double(window[3]) - window[1] + 1;
    if (!(width >= 1 && height >= 1 && width <= largest_side && height <= largest_side))
      return failure(
          file_, fmt::format("has a data window of {}x{} pixels; expected 1..{} each way", width, height, largest_side),
          "crop the image");
    if (std::max(width * height, tile) * pixel_bytes > small + compression_.expansion * double(all_.size()))
      return failure(file_, fmt::format("holds too few bytes for {}x{} pixels", width, height), damaged);
    height_ = static_cast<int>(height);
    row_bytes_ = width * pixel_bytes;
    return {};
  }

  // The chunks of a plain file: each must lie in it and be long enough for its rows. Uncompressed rows must have their
  // exact length, since OpenEXR would take what is missing from memory it never wrote.
  Status chunks() {
    for (int y = 0; y < height_; y += compression_.rows) {
      std::uint64_t offset = 0;
      std::array<std::int32_t, 2> chunk{};  // y, bytes
      if (!number(offset)) return truncated();
      std::span<const std::uint8_t> at = all_.subspan(std::size_t(std::min<std::uint64_t>(offset, all_.size())));
      const double wanted = row_bytes_ * std::min(compression_.rows, height_ - y);
      const bool there = take(at, chunk) && chunk[1] >= 0 && std::size_t(chunk[1]) <= at.size();
      if (!there || (!subsampled_ && (wanted > chunk[1] * compression_.expansion ||
                                      (compression_.expansion == 1 && wanted != chunk[1]))))
        return failure(file_, fmt::format("is damaged in row {} of {}", y, height_), damaged);
    }
    return {};
  }

  std::span<const std::uint8_t> rest_, all_;
  const std::string& file_;
  // Of the last header:
  Compression compression_{};
  bool subsampled_ = false;
  int height_ = 0;
  double row_bytes_ = 0;
};

// Channels of a layer: name without the layer, and with it.
using Layer = std::map<std::string, std::string>;

// The channels that make up an image, in its order; empty where they do not.
std::vector<std::string> image_channels(const Layer& layer) {
  static const std::vector<std::vector<std::string>> known{{"R", "G", "B", "A"}, {"R", "G", "B"}, {"X", "Y", "Z"},
                                                           {"Y", "A"},           {"Y"},           {"U", "V"},
                                                           {"Z"}};
  if (layer.size() == 1) return {layer.begin()->second};
  if (layer.contains("RY") || layer.contains("BY")) return {};
  for (const auto& names : known) {
    if (!std::all_of(names.begin(), names.end(), [&](const std::string& n) { return layer.contains(n); })) continue;
    std::vector<std::string> full;
    for (const std::string& n : names) full.push_back(layer.at(n));
    return full;
  }
  return {};
}

std::vector<std::string> choose_channels(const Imf::ChannelList& list) {
  std::map<std::string, Layer> layers;  // the unnamed one sorts first
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string full = it.name();
    const std::size_t dot = full.rfind('.');
    if (dot == std::string::npos) layers[""][full] = full;
    else layers[full.substr(0, dot)][full.substr(dot + 1)] = full;
  }
  std::vector<std::string> any;
  for (const auto& [name, layer] : layers) {
    std::vector<std::string> found = image_channels(layer);
    if (found.empty()) continue;
    if (name.empty() || layer.contains("R")) return found;
    if (any.empty()) any = std::move(found);
  }
  return any;
}

std::string all_channels(const Imf::ChannelList& list) {
  std::string text;
  for (auto it = list.begin(); it != list.end() && text.size() < 80; ++it) text += fmt::format("{} ", it.name());
  for (char& c : text)
    if (c < 32 || c > 126) c = '?';
  return text.empty() ? "none" : text.substr(0, text.size() - 1);
}

// What OpenEXR says, as one readable line.
std::string reason(const std::exception& e) {
  std::string text = e.what();
  for (char& c : text)
    if (c < 32 || c > 126) c = ' ';
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

Result<Image> decode(std::span<const std::uint8_t> bytes, const std::string& file) {
  MemoryIn stream(bytes, file);
  Imf::MultiPartInputFile input(stream, 0, false);
  for (int part = 0; part < input.parts(); ++part) {
    const Imf::Header& header = input.header(part);
    if (header.hasType() && header.type().starts_with("deep")) continue;
    const Imf::ChannelList& list = header.channels();
    const std::vector<std::string> names = choose_channels(list);
    if (names.empty())
      return failure(file,
                     fmt::format("has the channels {}; expected R G B (A), X Y Z, Y (A), U V, Z or a single one",
                                 all_channels(list)),
                     "export it as RGB");
    const Imath::Box2i window = header.dataWindow();
    const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
    Image image{width, height, static_cast<int>(names.size()), {}};
    image.pixels.resize(std::size_t(width) * std::size_t(height) * names.size());
    const std::size_t pixel = names.size() * sizeof(float);
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < names.size(); ++c) {
      const Imf::Channel& channel = list[names[c].c_str()];
      if (channel.xSampling != 1 || channel.ySampling != 1)
        return failure(file, fmt::format("has the subsampled channel {}", names[c]), "export it at full resolution");
      frame.insert(names[c],
                   Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, window, pixel, pixel * std::size_t(width)));
    }
    Imf::InputPart in(input, part);
    in.setFrameBuffer(frame);
    in.readPixels(window.min.y, window.max.y);
    return image;
  }
  return failure(file, "holds only deep data", "flatten it");
}

}  // namespace

Result<Image> decode_exr(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (Status s = Walk(bytes, file).check(); !s) return s;
  try {
    return decode(bytes, file);
  } catch (const std::bad_alloc&) {
    return Status(Code::out_of_memory, file + ": does not fit into memory; use a smaller file");
  } catch (const std::exception& e) {
    return failure(file, "cannot be decoded: " + reason(e), damaged);
  }
}

Result<Bytes> encode_exr(const Image& image, const std::string& file) {
  static constexpr std::array<std::array<const char*, 4>, 4> names{
      {{"Y"}, {"Y", "A"}, {"R", "G", "B"}, {"R", "G", "B", "A"}}};
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t pixel = channels * sizeof(float);
    for (std::size_t c = 0; c < channels; ++c) {
      const char* name = names[channels - 1][c];
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, header.dataWindow(), pixel,
                                          pixel * static_cast<std::size_t>(image.width)));
    }
    MemoryOut stream(file);
    {
      Imf::OutputFile output(stream, header, 0);
      output.setFrameBuffer(frame);
      output.writePixels(image.height);
    }
    return std::move(stream.bytes);
  } catch (const std::bad_alloc&) {
    return Status(Code::out_of_memory, file + ": encoding does not fit into memory; use a smaller image");
  } catch (const std::exception& e) {
    return failure(file, "cannot be encoded as EXR: " + reason(e), "write NPY");
  }
}

}  // namespace luxel::io

#include "image.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "host/files.h"
#include "codecs.h"

namespace luxel::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* known = "expected .exr, .hdr, .png or .npy";

std::string extension(const std::string& path) {
  std::string e = fs::path(path).extension().string();
  std::transform(e.begin(), e.end(), e.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

Status invalid(const std::string& file, const std::string& what) {
  return Status(Code::invalid_argument, file + ": " + what);
}

Result<Image> decode(const Bytes& bytes, const std::string& kind, const std::string& path) {
  if (kind == ".exr") return decode_exr(bytes, path);
  if (kind == ".hdr") return decode_hdr(bytes, path);
  if (kind == ".png") return decode_png(bytes, path);
  const Result<Array> array = decode_npy(bytes, path);
  if (!array) return array.status();
  return image_from_array(array.value(), path);
}

Result<Bytes> encode(const Image& image, const std::string& kind, const std::string& path, WriteReport& report) {
  if (kind == ".exr") return encode_exr(image, path);
  if (kind == ".hdr") return encode_hdr(image, path, report);
  if (kind == ".png") return encode_png(image, path, report);
  std::vector<std::size_t> shape{static_cast<std::size_t>(image.height), static_cast<std::size_t>(image.width)};
  if (image.channels > 1) shape.push_back(static_cast<std::size_t>(image.channels));
  return encode_npy(make_array(std::move(shape), image.pixels));
}

}  // namespace

Status failure(const std::string& file, const std::string& what, const std::string& remedy) {
  return Status(Code::io, fmt::format("{}: {}; {}", file, what, remedy));
}

Result<Bytes> read_bytes(const std::string& path) try {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) return failure(path, "does not exist", "check the name");
  if (!fs::is_regular_file(status)) return failure(path, "is not a file", "name a file");
  Bytes bytes;
  if (!read_file(path, bytes)) return failure(path, "cannot be read", "check its permissions");
  return bytes;
} catch (const std::bad_alloc&) {
  return Status(Code::out_of_memory, path + ": does not fit into memory; use a smaller file");
}

Status check_image_path(const std::string& path) {
  const std::string kind = extension(path);
  for (const char* e : {".exr", ".hdr", ".png", ".npy"})
    if (kind == e) return {};
  return invalid(path, kind.empty() ? fmt::format("has no extension; {}", known)
                                    : fmt::format("has the unknown extension {}; {}", kind, known));
}

Result<Image> image_from_array(const Array& array, const std::string& file) {
  const std::size_t n = array.shape.size();
  if (n != 2 && n != 3)
    return failure(file, fmt::format("has {} dimensions; an image has 2 (y, x) or 3 (y, x, channel)", n),
                   "reshape the array");
  const std::size_t h = array.shape[0], w = array.shape[1], c = n == 3 ? array.shape[2] : 1;
  if (h < 1 || w < 1 || h > largest_side || w > largest_side)
    return failure(file, fmt::format("is {}x{} pixels; expected 1..{} each way", w, h, largest_side),
                   "crop or pad the array");
  if (c < 1 || c > 4)
    return failure(file, fmt::format("has {} channels; expected 1..4", c), "save the channels you need");
  return Image{static_cast<int>(w), static_cast<int>(h), static_cast<int>(c), to_float(array)};
}

Result<Image> read_image(const std::string& path) try {
  if (Status s = check_image_path(path); !s) return Status(Code::io, s.message());
  const Result<Bytes> bytes = read_bytes(path);
  if (!bytes) return bytes.status();
  return decode(bytes.value(), extension(path), path);
} catch (const std::bad_alloc&) {
  return Status(Code::out_of_memory, path + ": does not fit into memory; use a smaller file");
}

Status write_image(const std::string& path, const Image& image, WriteReport* report) try {
  if (Status s = check_image_path(path); !s) return s;
  if (image.width < 1 || image.height < 1 || image.width > largest_side || image.height > largest_side)
    return invalid(path, fmt::format("the image is {}x{} pixels; expected 1..{} each way", image.width, image.height,
                                     largest_side));
  if (image.channels < 1 || image.channels > 4)
    return invalid(path, fmt::format("the image has {} channels; expected 1..4", image.channels));
  if (image.pixels.size() != std::size_t(image.width) * std::size_t(image.height) * std::size_t(image.channels))
    return invalid(path, fmt::format("the image holds {} values; {}x{}x{} needs another number", image.pixels.size(),
                                     image.width, image.height, image.channels));
  WriteReport changed;
  const Result<Bytes> bytes = encode(image, extension(path), path, changed);
  if (!bytes) return bytes.status();
  if (!write_file_atomically(path, bytes.value()))
    return failure(path, "cannot be written", "check that its folder can be written to and the disk has room");
  if (report) *report = changed;
  return {};
} catch (const std::bad_alloc&) {
  return Status(Code::out_of_memory, path + ": encoding does not fit into memory; use a smaller image");
}

}  // namespace luxel::io

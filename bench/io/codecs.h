// The file formats behind read_image and write_image, from and to memory. `file` names the source in errors.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "image.h"

namespace luxel::io {

using Bytes = std::vector<std::uint8_t>;

/// A whole regular file. Errors (io): missing, a folder, not readable.
Result<Bytes> read_bytes(const std::string& path);

/// Status io: "file: what; remedy".
Status failure(const std::string& file, const std::string& what, const std::string& remedy);

/// The remedy for content that cannot have been written that way.
constexpr const char* damaged = "copy or export the file again";

Result<Image> decode_exr(std::span<const std::uint8_t> bytes, const std::string& file);
Result<Image> decode_hdr(std::span<const std::uint8_t> bytes, const std::string& file);
Result<Image> decode_png(std::span<const std::uint8_t> bytes, const std::string& file);

Result<Bytes> encode_exr(const Image& image, const std::string& file);
Result<Bytes> encode_hdr(const Image& image, const std::string& file, WriteReport& report);
Result<Bytes> encode_png(const Image& image, const std::string& file, WriteReport& report);

}  // namespace luxel::io

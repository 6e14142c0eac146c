// Pictures that materials name, decoded into textures.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "bench/scene/scene.h"

namespace luxel::scene {

/// PNG, JPEG, TGA, BMP, PSD or GIF in memory as a texture; `name` stands in errors. At most 16384 texels each way.
/// Errors: io, one line.
Result<Texture> decode_texture(std::span<const std::uint8_t> bytes, const std::string& name);

/// The same from a file.
Result<Texture> read_texture(const std::string& path);

}  // namespace luxel::scene

#include "bench/scene/mesh_texture.h"

#include <memory>

#include <fmt/format.h>

#include "bench/io/codecs.h"

// An own copy of stb's decoder, as the one behind read_image is built for PNG alone.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_PNM
#define STBI_NO_PIC
#define STBI_NO_FAILURE_STRINGS
#include <stb/stb_image.h>

namespace luxel::scene {

Result<Texture> decode_texture(std::span<const std::uint8_t> bytes, const std::string& name) {
  constexpr int largest = 16384;
  const auto refuse = [&](const std::string& what) {
    return io::failure(name, what, "convert it to PNG, JPEG, TGA or BMP");
  };
  if (bytes.size() > (std::size_t{1} << 30)) return refuse("exceeds 1 GiB");
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) == 0)
    return refuse("is no picture that can be read");
  if (width < 1 || height < 1 || width > largest || height > largest)
    return refuse(fmt::format("is {}x{} texels; expected 1..{} each way", width, height, largest));
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
      stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4), &stbi_image_free);
  if (!texels) return refuse("is damaged");
  Texture t{name, width, height, true, {}};
  t.rgba.assign(texels.get(), texels.get() + std::size_t{4} * width * height);
  return t;
}

Result<Texture> read_texture(const std::string& path) {
  const Result<io::Bytes> bytes = io::read_bytes(path);
  if (!bytes) return bytes.status();
  return decode_texture(bytes.value(), path);
}

}  // namespace luxel::scene

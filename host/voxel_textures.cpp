// Base-colour textures as voxelize reads them: mip levels after each other, averaged in linear light.
#include <algorithm>
#include <cmath>

#include <luxel/voxelize.h>

#include "host/check.h"

namespace luxel {

namespace {

// IEC 61966-2-1.
double linear_of(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double encoded(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

using Texel = std::array<double, 4>;  // linear colour times alpha, alpha

struct Level {
  int width = 0, height = 0;
  std::vector<Texel> texels;
};

// The box filter; odd extents weigh as areas do (kernels/math/mip.h).
Level halved(const Level& fine) {
  Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  const auto weights = [](int i, int n, int m) -> std::array<double, 3> {
    if (n == 1) return {1, 0, 0};
    if (n % 2 == 0) return {0.5, 0.5, 0};
    return {static_cast<double>(m - i) / n, static_cast<double>(m) / n, static_cast<double>(i + 1) / n};
  };
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      const auto wx = weights(x, fine.width, coarse.width), wy = weights(y, fine.height, coarse.height);
      Texel sum{};
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          const double w = wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)];
          if (w == 0) continue;
          const Texel& t = fine.texels[static_cast<std::size_t>(2 * y + j) * fine.width + 2 * x + i];
          for (std::size_t c = 0; c < 4; ++c) sum[c] += w * t[c];
        }
      coarse.texels.push_back(sum);
    }
  return coarse;
}

std::uint32_t packed(const Texel& t) {
  std::uint32_t word = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    const double v = c == 3 ? t[3] : t[3] > 0 ? encoded(t[c] / t[3]) : 0;
    word |= static_cast<std::uint32_t>(std::lround(255 * std::clamp(v, 0.0, 1.0))) << (8 * c);
  }
  return word;
}

}  // namespace

std::vector<double> srgb_table() {
  std::vector<double> table;
  for (int i = 0; i < 256; ++i) table.push_back(linear_of(i / 255.0));
  return table;
}

Result<VoxelTextures> voxel_textures(const VoxelTexture* textures, std::size_t count) {
  VoxelTextures out;
  for (std::size_t i = 0; i < count; ++i) {
    const VoxelTexture& t = textures[i];
    std::array<std::uint32_t, 8> entry{};
    if (t.rgba == nullptr) {
      out.table.insert(out.table.end(), entry.begin(), entry.end());
      continue;
    }
    LUXEL_CHECK(check_range("VoxelTexture.width", t.width, 1, 16384));
    LUXEL_CHECK(check_range("VoxelTexture.height", t.height, 1, 16384));
    LUXEL_CHECK(check_range("VoxelTexture.alpha_cutoff", t.alpha_cutoff, 0.0, 1.0));
    Level level{t.width, t.height, {}};
    for (std::size_t p = 0; p < static_cast<std::size_t>(t.width) * t.height; ++p) {
      const std::uint8_t* const c = t.rgba + 4 * p;
      const double alpha = c[3] / 255.0;
      level.texels.push_back(
          {alpha * linear_of(c[0] / 255.0), alpha * linear_of(c[1] / 255.0), alpha * linear_of(c[2] / 255.0), alpha});
    }
    entry = {static_cast<std::uint32_t>(out.texels.size()), static_cast<std::uint32_t>(t.width),
             static_cast<std::uint32_t>(t.height), 1, static_cast<std::uint32_t>(t.wrap_u),
             static_cast<std::uint32_t>(t.wrap_v), static_cast<std::uint32_t>(std::lround(t.alpha_cutoff * 65536)), 0};
    for (;; ++entry[3]) {
      for (const Texel& texel : level.texels) out.texels.push_back(packed(texel));
      if (level.width == 1 && level.height == 1) break;
      level = halved(level);
    }
    out.table.insert(out.table.end(), entry.begin(), entry.end());
  }
  return out;
}

}  // namespace luxel

#include "bench/scene/voxels.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace luxel::scene {

namespace {

// Texels as sRGB; where the material is opaque, with alpha 1, which glTF then ignores.
std::vector<std::uint8_t> texels_of(const Texture& texture, bool opaque) {
  std::vector<std::uint8_t> rgba = texture.rgba;
  for (std::size_t i = 0; i < rgba.size(); ++i) {
    if (i % 4 == 3) {
      if (opaque) rgba[i] = 255;
    } else if (!texture.srgb) {
      const double v = rgba[i] / 255.0;
      rgba[i] = static_cast<std::uint8_t>(
          std::lround(255 * (v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
    }
  }
  return rgba;
}

bool absent(const Material& m) { return m.alpha_mode == AlphaMode::mask && m.texture < 0 && m.alpha < m.alpha_cutoff; }

}  // namespace

VoxelGrid grid_around(const Scene& scene, int n) { return grid_around(bounds(scene), n); }

VoxelGrid grid_around(const Bounds& box, int n) {
  const glm::dvec3 size = box.high - box.low;
  double side = 1.02 * std::max({size.x, size.y, size.z});
  if (!(side > 0)) side = 1;
  VoxelGrid grid;
  grid.width = grid.height = grid.depth = n;
  grid.voxel = side / n;
  for (int k = 0; k < 3; ++k) grid.origin[static_cast<std::size_t>(k)] = (box.low[k] + box.high[k] - side) / 2;
  return grid;
}

Result<SceneVoxels> scene_voxels(const Scene& scene, const VoxelGrid& grid, bool albedo, bool windows) {
  SceneVoxels out;
  out.grid = grid;

  std::map<std::pair<int, bool>, std::vector<std::uint8_t>> images;
  std::vector<VoxelTexture> textures;
  bool textured = false, opacity = false;
  double brightest = 0;
  for (const Material& m : scene.materials) {
    const bool blended = m.alpha_mode == AlphaMode::blend;
    const double keep = albedo ? 1 - m.metallic : 1;
    for (int c = 0; c < 3; ++c) out.materials.push_back(static_cast<float>(keep * m.base_color[c]));
    out.materials.push_back(static_cast<float>(blended ? m.alpha : 1));
    for (int c = 0; c < 3; ++c) {
      out.materials.push_back(static_cast<float>(m.emission[c]));
      brightest = std::max(brightest, m.emission[c]);
    }
    out.materials.push_back(0);
    VoxelTexture texture;
    if (m.texture >= 0 && !scene.uvs.empty()) {
      const Texture& t = scene.textures[static_cast<std::size_t>(m.texture)];
      const bool opaque = m.alpha_mode == AlphaMode::opaque;
      std::vector<std::uint8_t>& rgba = images[{m.texture, opaque}];
      if (rgba.empty()) rgba = texels_of(t, opaque);
      texture.rgba = rgba.data();
      texture.width = t.width;
      texture.height = t.height;
      if (m.alpha_mode == AlphaMode::mask) texture.alpha_cutoff = std::clamp(m.alpha_cutoff / std::max(m.alpha, 1e-6), 0.0, 1.0);
      textured = true;
    }
    textures.push_back(texture);
    opacity = opacity || (blended && (m.alpha < 1 || texture.rgba != nullptr));
  }

  // What a mask removes altogether gets indices that are skipped, so that the others keep their numbers.
  std::size_t removed = 0;
  std::vector<std::uint32_t> indices;
  indices.reserve(scene.indices.size() * 3);
  for (std::size_t t = 0; t < scene.indices.size(); ++t) {
    const bool gone = absent(scene.material_of(t));
    const glm::uvec3 i = gone ? glm::uvec3(0xffffffffu) : scene.indices[t];
    removed += gone;
    indices.insert(indices.end(), {i.x, i.y, i.z});
  }
  std::vector<double> positions, uvs;
  for (const glm::dvec3& p : scene.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  if (textured)
    for (const glm::dvec2& uv : scene.uvs) uvs.insert(uvs.end(), {uv.x, uv.y});
  VoxelMesh mesh;
  mesh.positions = positions.data();
  mesh.vertices = scene.positions.size();
  mesh.indices = indices.data();
  mesh.triangles = scene.indices.size();
  mesh.materials = scene.triangle_materials.data();
  if (textured) mesh.uvs = uvs.data();
  Result<VoxelTriangles> triangles = windows ? window_triangles(mesh, grid) : voxel_triangles(mesh, grid);
  if (!triangles) return triangles.status();
  out.triangles = std::move(triangles).value();
  out.triangles.bad_index -= removed;

  out.params = voxelize_params(grid, out.triangles);
  out.params.materials = static_cast<int>(scene.materials.size());
  out.params.opacity = opacity;
  out.params.emission = brightest > 0;
  if (brightest > 0) out.params.emission_max = brightest;
  if (textured) {
    Result<VoxelTextures> packed = voxel_textures(textures.data(), textures.size());
    if (!packed) return packed.status();
    out.textures = std::move(packed).value();
    out.params.texels = static_cast<int>(out.textures.texels.size());
  }
  return out;
}

}  // namespace luxel::scene

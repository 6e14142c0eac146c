// Scenes of triangles with materials, textures, a camera and lights: what meshes are read into and what is generated.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <luxel/status.h>

namespace luxel::scene {

/// 8-bit texels, row 0 at v = 0 (as glTF lays them out), repeated outside 0..1.
struct Texture {
  std::string name;
  int width = 0, height = 0;
  bool srgb = true;                // r, g, b hold sRGB; alpha is always linear
  std::vector<std::uint8_t> rgba;  // 4 * width * height

  /// One texel, linear r, g, b, a in 0..1; x and y wrap around.
  glm::dvec4 texel(int x, int y) const;
  /// Bilinear in linear light, texel centres at (i + 1/2) / size.
  glm::dvec4 sample(glm::dvec2 uv) const;
};

enum class AlphaMode { opaque, mask, blend };

/// Metallic and roughness as in glTF 2.0.
struct Material {
  std::string name{};
  glm::dvec3 base_color{0.5};   // linear, 0..1; times the texture
  double alpha = 1;             // 0..1; times the texture's
  glm::dvec3 emission{0};       // radiance, both sides
  double roughness = 1;         // perceptual, 0..1: alpha of GGX is roughness^2
  double metallic = 0;          // 0..1
  double specular = 0;          // reflectance at normal incidence of what is not metal: 0 diffuse only, 0.04 glTF
  AlphaMode alpha_mode = AlphaMode::opaque;
  double alpha_cutoff = 0.5;    // of mask: below it there is no surface
  int texture = -1;             // index of the base-colour texture; -1: none
};

/// What light meets at a point of a surface.
struct Surface {
  glm::dvec3 base_color{0};  // linear
  double alpha = 1;          // 1 or 0 for opaque and mask, 0..1 for blend
  glm::dvec3 albedo{0};      // diffuse reflectance: base colour times 1 - metallic
  glm::dvec3 specular{0};    // reflectance at normal incidence: mix(specular, base colour, metallic)
};

struct Camera {
  glm::dvec3 eye{0, 0, 1}, target{0};
  double fov = 60;  // vertical, degrees, above 0 and below 180
};

/// A light at infinity.
struct Sun {
  glm::dvec3 direction{0, 1, 0};  // unit, from the scene towards the sun
  glm::dvec3 irradiance{0};       // on a plane that faces it
};

/// Radiance from where no surface is: one value, or a latitude-longitude image. Row r of H lies at the angle
/// t = (r + 1/2) / H * pi from +y, column c of W at p = (c + 1/2) / W * 2 pi - pi; the direction is
/// (sin t cos p, cos t, sin t sin p).
struct Sky {
  glm::dvec3 radiance{0};  // times the image, where there is one
  int width = 0, height = 0;
  std::vector<float> image;  // 3 * width * height; empty: none

  bool dark() const { return radiance == glm::dvec3(0); }
  /// Radiance from a unit direction: the texel that it falls into.
  glm::dvec3 toward(glm::dvec3 direction) const;
};

/// World space right-handed, y up. A triangle's vertices are positions[indices[i]], counter-clockwise seen from its front;
/// surfaces have two sides alike. Positions may be NaN or infinite where a file says so: whoever reads them skips those.
struct Scene {
  std::string name;
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> uvs;                     // one a position, or empty
  std::vector<glm::uvec3> indices;                 // all below positions.size()
  std::vector<std::uint32_t> triangle_materials;   // one a triangle, all below materials.size()
  std::vector<Material> materials;                 // at least one
  std::vector<Texture> textures;
  Camera camera;
  Sun sun;
  Sky sky;
  std::vector<std::string> notes;  // what a file asked for and did not get, a line each

  bool textured() const { return !textures.empty(); }
  bool emissive() const;
  const Material& material_of(std::size_t triangle) const { return materials[triangle_materials[triangle]]; }
  /// Material of a triangle at barycentric weights of its second and third vertex.
  Surface surface(std::size_t triangle, double b1, double b2) const;
};

/// Corners of the box around all finite vertices of the triangles; both (0,0,0) where there are none.
struct Bounds {
  glm::dvec3 low{0}, high{0};
};
Bounds bounds(const Scene& scene);

/// Whether a triangle's three vertices are finite numbers.
bool finite(const Scene& scene, std::size_t triangle);

/// Names of the generated scenes, in the form that scene_from takes.
std::vector<std::string_view> built_in_names();

/// A generated scene:
///   cornell         the Cornell box in units of its half side: 2 x 2 x 2, open towards +z, two blocks, a square lamp
///   two_rooms       a lit and a dark room beside each other, both open towards +z, a wall of 1/200 of a room between
///   furnace         a closed room with a block in it, every surface emitting 1 with albedo 1/2: radiance 2 everywhere
///   atrium[:N]      a columned hall with galleries, arches and hanging cloth, lit by sun and sky, in metres; at most N
///                   and at least 0.9 N triangles, N from 5000 to 500000, default 50000
///   pillars         a room of 6 x 3 x 6, open towards +z, four pillars, two of them around places of 3 x 2 x 3 probes
///   curtain         the same room, half of it behind a cloth that light passes beneath and beside
/// Errors: invalid_argument, naming what there is.
Result<Scene> built_in(const std::string& name);

/// A scene from a file: OBJ, PLY, glTF, GLB and what else assimp reads. Camera: the file's first, else one that sees
/// the whole. Lights: a sun and a sky where no material emits. OBJ: Kd is linear, Ke emission, Ns and Ks gloss.
/// Errors: io, one line with the file, what is wrong, and the remedy.
Result<Scene> read_mesh(const std::string& path);

/// built_in where `name` is one of its names (with or without a number), else read_mesh.
Result<Scene> scene_from(const std::string& name);

}  // namespace luxel::scene

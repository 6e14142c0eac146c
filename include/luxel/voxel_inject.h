/// \file
/// voxel_inject: direct light into voxels: outgoing radiance Le + rho / pi E of every occupied voxel, premultiplied by its
/// coverage, as mip_build and cone_trace take it (Crassin et al., Interactive Indirect Illumination Using Voxel Cone
/// Tracing, 2011, light injection; Villegas and Ramirez, Deferred Voxel Shading for Real-Time Global Illumination, 2016).
#pragma once
#include <array>
#include <vector>

#include <luxel/plan.h>

namespace luxel {

/// A light that a list holds.
struct VoxelLight {
  /// What sends the light.
  enum class Kind {
    sun,    ///< at infinity
    point,  ///< the same intensity in every direction
    patch   ///< a small piece of a surface that emits from its front
  };
  Kind kind = Kind::sun;  ///< what sends the light
  std::array<double, 3> place{0, 1, 0};   ///< sun: direction to it, any length but 0; else position, scene units
  std::array<double, 3> power{1, 1, 1};   ///< r, g, b, >= 0. sun: irradiance on a plane that faces it; point: radiant
                                          ///< intensity; patch: radiance times area
  std::array<double, 3> normal{0, -1, 0}; ///< patch: of its front, any length but 0
  double area = 0;                        ///< patch: scene units squared. A patch of radiance L never sends more than pi L:
                                          ///< at distance d it counts as a disc seen along its axis, 1 / (d^2 + area / pi)
};

/// An orthographic shadow map in voxels: a place p (from the outer corner of voxel (0,0,0)) is seen at
/// (to_x . (p, 1), to_y . (p, 1)) in texels, and its depth is to_depth . (p, 1), which grows away from the light. The
/// three directions stand on each other.
struct VoxelShadow {
  int width = 0;   ///< texels, 1..32768; 0: there is none
  int height = 0;  ///< 1..32768
  std::array<double, 4> to_x{};      ///< texels along x; see above
  std::array<double, 4> to_y{};      ///< texels along y
  std::array<double, 4> to_depth{};  ///< depth
};

/// The map that sees a whole grid from a light in `direction` (any length but 0), `texels` (1..8) a voxel; depths in
/// voxels from a plane that touches the grid's circumscribed sphere.
VoxelShadow voxel_shadow(const std::array<int, 3>& extent, const std::array<double, 3>& direction, double texels);

/// Voxels are lit.
struct VoxelInjectParams {
  int width = 0;                  ///< voxels, 1..2048, as voxelize had them
  int height = 0;                 ///< 1..2048
  int depth = 0;                  ///< 1..2048
  bool toroidal = false;          ///< the grid is a window, as VoxelizeParams had it: volumes are addressed modulo their extents
  std::array<int, 3> window{0, 0, 0};  ///< its first voxel. Rays see the window alone; lights and maps count from its corner
  Format format = Format::f32x4;  ///< of all volumes: f32x4, f16x4, unorm8x4
  int bricks = 0;                 ///< capacity of the list of touched bricks, 1..: VoxelizeParams.bricks
  int lights = 0;                 ///< in the list, each with a shadow ray through the voxels, 0..65536
  int map_width = 0;              ///< of a reflective shadow map (or any list of lit points), 0..32768; 0: there is none
  int map_height = 0;             ///< 1..32768 with a map, else 0
  VoxelShadow shadow{};           ///< of the list's first light, which is a sun; texels no larger than a voxel, no less than 1/8
  double irradiance_max = 1;      ///< of the map: largest of a channel, > 0; summed in steps of 2^-14 of it
  bool emission = false;          ///< the volume `emission` is there
  bool clear = true;              ///< the whole volume is written; false: only touched bricks (a light moved, voxels did not)
  double voxel = 1;               ///< side of a voxel, scene units, > 0
  double normal_offset = 2.6;     ///< shadow rays start this many voxels above a voxel's centre (and end as many above a patch), 0..64. From 3 sqrt(3) / 2 on a
                                  ///< plane never shadows itself
  bool two_sided = true;          ///< both sides of a surface are lit alike; false: the front of its triangles, so that light
                                  ///< on the back of a wall (a roof in the sun) does not show inside
  double scale = 1;               ///< radiance is multiplied by this before it is stored, > 0 (unorm8 holds 0..1)
  bool count = false;             ///< fills `outcomes`
};

/// Words of the resource `outcomes`.
enum class VoxelInjectCount {
  lit,        ///< occupied voxels that some light reaches
  unlit,      ///< the others. With a map, cracks are among them: voxels that it missed
  dropped,    ///< texels of the map outside the grid, in empty voxels, or with NaN, infinite or negative irradiance
  saturated   ///< texels whose irradiance exceeded irradiance_max, and sums that wrapped
};

/// Resources of the plan: read `colour` (straight base colour and coverage), `normal` (with lights; mean of unit normals; unorm8:
/// n/2 + 1/2), `emission` (radiance; with `emission`), `bricks` and `voxel_counters` (voxelize's `bricks` and `counters`),
/// `lights` (with lights; three vec4 a light: voxel_lights), `shadow` (with a shadow map; a float a texel, the depth at its
/// centre, >= 1e10 where there is nothing), `map` (with a map; two vec4 a texel: position in voxels from
/// the outer corner of voxel (0,0,0), and 1 where light arrives, else 0; irradiance there, and an unused channel; a voxel
/// gets the mean of its texels); written `radiance` (premultiplied radiance and coverage; with `clear` every voxel, else
/// those of touched bricks) and `outcomes` (8 u32; with `count`).
/// A voxel has one radiance for all sides. Its irradiance from a light of direction l is E T (|N.l| + (1 - |N|) / 4): N is
/// the mean normal, and what its length lacks faces everywhere; T is the transmittance of the shadow ray, a product over voxels; with a shadow map the share
/// of the voxel's surface that it sees lit. With two_sided off |N.l| is max(0, N.l).
/// Errors: invalid_argument, naming field, value and range.
Status validate(const VoxelInjectParams& params);
/// The passes that do it on a device of this profile. Errors: as validate.
Result<Plan> plan(const VoxelInjectParams& params, const Profile& profile);

/// The list of all bricks of the grid, for `bricks` (as many words as p.bricks must then be); the third word of
/// `voxel_counters` is its length. A window that moved is lit by it: voxelize lists only what scrolled in.
std::vector<std::uint32_t> voxel_all_bricks(const VoxelInjectParams& params);

/// The resource `lights`: 12 floats a light, rebased in double. `origin`: outer corner of voxel (0,0,0); `voxel`: its side.
std::vector<float> voxel_lights(const std::vector<VoxelLight>& lights, const std::array<double, 3>& origin, double voxel);

}  // namespace luxel

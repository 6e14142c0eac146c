/// \file
/// voxelize: triangle meshes into voxels: which voxels the surface touches, exactly, and the area-weighted means of base
/// colour, opacity, normal and emission there (Crassin and Green, Octree-Based Sparse Voxelization Using the GPU Hardware
/// Rasterizer, 2012; Schwarz and Seidel 2010; Laine 2013).
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <luxel/plan.h>

namespace luxel {

/// A grid of cubic voxels; voxel (0,0,0) has its outer corner at `origin`.
struct VoxelGrid {
  std::array<double, 3> origin{0, 0, 0};  ///< scene units
  double voxel = 1;                       ///< side of a voxel in scene units, above 0
  int width = 0;                          ///< voxels, 1..2048
  int height = 0;                         ///< 1..2048
  int depth = 0;                          ///< 1..2048
};

/// A mesh of the caller's, which is only read.
struct VoxelMesh {
  const double* positions = nullptr;        ///< x, y, z of each vertex
  std::size_t vertices = 0;                 ///< in `positions`
  const std::uint32_t* indices = nullptr;   ///< three a triangle, counter-clockwise seen from the side the normal points to
  std::size_t triangles = 0;                ///< in `indices`
  const std::uint32_t* materials = nullptr; ///< of each triangle; null: all 0
  const double* uvs = nullptr;              ///< u, v of each vertex; null: none
};

/// Triangles as the kernel takes them, and what became of the mesh.
struct VoxelTriangles {
  std::vector<std::int32_t> records;  ///< 12 words a triangle: the resource `triangles`
  std::vector<float> uvs;             ///< 6 a record (u, v of its corners), where the mesh has any: the resource `uvs`
  std::size_t count = 0;              ///< records
  std::size_t blocks = 0;             ///< VoxelizeParams.blocks that suffice
  std::size_t pieces = 0;             ///< the same
  std::size_t bricks = 0;             ///< the same
  std::size_t not_finite = 0;         ///< triangles skipped for a NaN or an infinity (or too large a number) in a vertex
  std::size_t bad_index = 0;          ///< triangles skipped for an index beyond the vertices
  std::size_t outside = 0;            ///< triangles left out because they do not touch the grid
  std::size_t clipped = 0;            ///< triangles that reached past two grids, and were clipped there
};

/// Rebases a mesh into a grid in double, g = (position - origin) / voxel, and rounds it to 2^-16 voxel: the only rounding
/// before the decision which voxels are touched. Shared vertices round alike. Coordinates from -2 to 3 grids (of the
/// largest extent) pass as they are; triangles beyond are clipped there first, in double. Pure; needs no device.
/// Errors: invalid_argument, naming field, value and range.
Result<VoxelTriangles> voxel_triangles(const VoxelMesh& mesh, const VoxelGrid& grid);

/// Triangles for a window that moves (VoxelizeParams::toroidal): records in voxels from the grid's origin, the same wherever
/// the window stands, so that they are made once. Extents are the window's. Triangles longer than a window are cut there
/// into cubes as long as the window, in double; what lies beyond 8192 voxels from the origin is left out (`outside`,
/// `clipped`). `blocks` and `pieces` suffice for every window; `bricks` is 0: all of the grid. Pure; needs no device.
/// Errors: as voxel_triangles.
Result<VoxelTriangles> window_triangles(const VoxelMesh& mesh, const VoxelGrid& grid);

/// How texture coordinates outside 0..1 are taken.
enum class VoxelWrap { repeat, clamp, mirror };

/// A base-colour texture of a material, as glTF has them; it multiplies the material's base colour and opacity.
struct VoxelTexture {
  const std::uint8_t* rgba = nullptr;  ///< sRGB colour and alpha of each texel, v = 0 first; null: none
  int width = 0;                       ///< texels, 1..16384
  int height = 0;                      ///< 1..16384
  VoxelWrap wrap_u = VoxelWrap::repeat;  ///< u outside 0..1
  VoxelWrap wrap_v = VoxelWrap::repeat;  ///< v outside 0..1
  double alpha_cutoff = 0;             ///< above 0: where alpha is less, the surface is not there; elsewhere it is opaque. 0..1
};

/// Textures as the kernel takes them: mip levels, averaged in linear light.
struct VoxelTextures {
  std::vector<std::uint32_t> table;   ///< 8 words a texture: the resource `texture_table`
  std::vector<std::uint32_t> texels;  ///< the resource `texels`
};

/// Textures of materials 0, 1, ... Errors: invalid_argument, naming field, value and range.
Result<VoxelTextures> voxel_textures(const VoxelTexture* textures, std::size_t count);

/// Which voxels count as touched.
enum class VoxelizeMode {
  conservative,  ///< the closed voxel meets the triangle: 26-separating
  thin,          ///< a segment that joins the centres of opposite faces meets it: 6-separating
  dilated        ///< the bounding-triangle test of Crassin and Green: covers too much at acute corners; for comparison
};

/// How triangles share a voxel.
enum class VoxelizeMerging {
  exact,           ///< area-weighted mean in integers: the same bits in any order of the threads
  moving_average,  ///< mean in 8 bits a channel by compare-and-swap, its count wraps at 255; depends on timing
  last_write       ///< one of the triangles; depends on timing
};

/// Triangles become voxels with a base colour, normal and emission.
struct VoxelizeParams {
  int width = 0;                 ///< voxels, 1..2048
  int height = 0;                ///< 1..2048
  int depth = 0;                 ///< 1..2048
  std::array<int, 3> first{0, 0, 0};      ///< first voxel of the region that is made; what lies outside keeps what the volumes hold
  std::array<int, 3> last{-1, -1, -1};    ///< last voxel of the region; -1: to the end
  bool toroidal = false;        ///< the grid is a window in a world of voxels, its volumes are addressed modulo their extents:
                                ///< voxel v of the world lies at v mod extent. Extents: multiples of 8, 8..2040; triangles:
                                ///< window_triangles(). `first` and `last` count from the window's first voxel
  std::array<int, 3> window{0, 0, 0};  ///< that voxel, voxels from the origin of the triangles' grid, -8192..8192 - extent
  bool touched_only = false;    ///< volumes are written in touched bricks only; elsewhere they keep what they hold
  bool over = false;            ///< an object that moves over static volumes: its voxels replace theirs, and what it left last
                                ///< time is restored. Only bricks that it touches or left are written
  VoxelizeMode mode = VoxelizeMode::conservative;  ///< which voxels count as touched
  VoxelizeMerging merging = VoxelizeMerging::exact;  ///< how triangles share a voxel
  Format format = Format::f32x4; ///< of the volumes: f32x4, f16x4, unorm8x4
  bool opacity = false;          ///< materials' opacity goes into coverage; else every touched voxel has coverage 1
  bool normal = false;           ///< adds the volume `normal`; exact merging only
  bool emission = false;         ///< adds the volume `emission`; exact merging only
  double emission_max = 1;       ///< largest emission of a channel; steps of 2^-14 of it are summed. Above 0
  int triangles = 0;             ///< records in `triangles`, 0..2^27
  int materials = 1;             ///< in `materials`, 1..2^24
  int blocks = 0;                ///< capacity in pairs of triangle and block of 64^3 voxels; 0: as many as triangles
  int pieces = 0;                ///< capacity in pairs of triangle and brick of 8^3 voxels; 0: four times the triangles
  int bricks = 0;                ///< capacity in touched bricks; 0: all of the grid
  int fragments = 0;             ///< capacity of `fragments`; 0: no list
  int texels = 0;                ///< words in `texels` (2^28 at most); 0: no textures, nothing of them is bound

  /// Vertices in a device buffer, in float, which are rounded there: along each axis off by at most 2^-17 voxel, 5 2^-24 of
  /// the coordinate in the grid, and what the floats had lost before. Nothing is clipped: coordinates in the grid from -4096
  /// to 6144 voxels are taken, triangles that reach beyond are left out (VoxelizeCount::far).
  bool device_vertices = false;  ///< read `positions` and `indices` in place of `triangles`
  bool device_materials = false; ///< read `triangle_materials` too; else all are 0
  int vertices = 0;              ///< in `positions`, 0..2^28
  std::array<double, 3> origin{0, 0, 0};  ///< as in VoxelGrid; device vertices only
  double voxel = 1;                       ///< the same, 1e-30..1e30
};

/// Words of the resource `counters`. What is needed is counted in full also where the capacity does not hold it; what does
/// not fit is left out, and nothing is written past an end.
enum class VoxelizeCount {
  blocks,      ///< needed
  pieces,      ///< needed
  bricks,      ///< needed: bricks that triangles touch
  fragments,   ///< needed: pairs of voxel and triangle (0 where no list is asked for)
  occupied,    ///< voxels
  saturated,   ///< times that a count wrapped (moving_average); exact merging holds 2^27 triangles a voxel
  not_finite,  ///< device vertices: triangles skipped for a NaN or an infinity, also of 65536 times a coordinate in the grid
  bad_index,   ///< device vertices: triangles skipped for an index beyond the vertices
  far          ///< device vertices: triangles left out because they reach beyond -4096..6144 voxels, though their bounds meet
               ///< the grid: as many may be missing from it
};

/// Resources of the plan: read `triangles` (VoxelTriangles::records), `materials` (f32x4: linear base colour 0..1 and
/// opacity 0..1, emission and an unused channel, material after material); written `colour` (straight base colour and
/// coverage, [z][y][x]; occupied where coverage is above 0), `normal` (mean of unit normals, its length carries the
/// spread; unorm8: n/2 + 1/2) and `emission` where asked for, `bricks` (u32: touched bricks in ascending order, x + (y + z
/// bricks_y) bricks_x; as many as `counters` says; toroidal: of a grid that begins at the
/// multiples of 8 voxels below the window and is 8 voxels larger), `fragments` (u32 x 4: x, y, z, triangle of the mesh; in any
/// order) where asked for, `counters` (16 u32, see VoxelizeCount). With textures: `uvs` (f32x1, VoxelTriangles::uvs),
/// `texture_table` (u32, 8 words for each material) and `texels` (u32), sampled at the centroid of the triangle's part in the
/// voxel. With device vertices, in place of `triangles`: `positions` (f32x1, x, y, z of each vertex), `indices` (u32, three a
/// triangle) and `triangle_materials` (u32); `uvs` holds u, v of each vertex. Coverage is the opacity's mean, never below a
/// step of unorm8 or of 2^-14. With `over`: read `under_colour` (`under_normal`, `under_emission`: the static volumes),
/// `left_bricks` and `left_counters`: `bricks` and `counters` of the last time (a third word 0: none), which must be other memory than this
/// time's; the volumes hold the static ones, or what the last time made of them. Errors: invalid_argument, naming field, value and range.
Status validate(const VoxelizeParams& params);

/// The passes that voxelize with these parameters on a device of this profile.
Result<Plan> plan(const VoxelizeParams& params, const Profile& profile);

/// What a window that moved from `from` to params.window needs anew: at most three regions that do not overlap, none where
/// it did not move, the whole window where nothing of it is left. Each is a plan of its own; after them the volumes hold,
/// bit for bit, what voxelizing the window anew gives. `params`: valid, toroidal, its own region is left out of account.
std::vector<VoxelizeParams> voxelize_move(const VoxelizeParams& params, const std::array<int, 3>& from);

/// Parameters for triangles in a grid: extents and capacities filled in, `fragments` left 0.
VoxelizeParams voxelize_params(const VoxelGrid& grid, const VoxelTriangles& triangles);

}  // namespace luxel

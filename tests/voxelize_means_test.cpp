// voxelize: means against clipping in double, the same bits on every execution, textures.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cases/voxelize_support.h"
#include "tests/support/voxels.h"

namespace luxel {
namespace {

using cases::awkward_mesh;
using cases::Mesh;
using cases::unit_grid;
using cases::paints;


Mesh painted(std::uint32_t count, double n) {
  Mesh mesh = awkward_mesh(count, n, 3);
  for (std::uint32_t t = 0; t < count; ++t) mesh.materials[t] = t % 3;
  return mesh;
}

VoxelTriangles prepare(const Mesh& mesh, const VoxelGrid& grid) {
  const Result<VoxelTriangles> triangles = voxel_triangles(mesh.view(), grid);
  EXPECT_TRUE(triangles.ok()) << triangles.status().message();
  return triangles.ok() ? triangles.value() : VoxelTriangles{};
}

VoxelizeParams with_everything(VoxelizeParams params) {
  params.opacity = params.normal = params.emission = true;
  params.emission_max = cases::brightest;
  params.materials = 3;
  return params;
}

TEST(Voxelize, MeansFollowClippedAreas) {
  const VoxelGrid grid = unit_grid(13);
  const VoxelTriangles triangles = prepare(painted(400, 13), grid);
  const VoxelizeParams params = with_everything(voxelize_params(grid, triangles));
  const std::vector<truth::Voxel> expected = truth::voxels(triangles, grid, params.mode, paints());
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (const std::string& device : devices) {
    Context& context = test_context(device);
    const Voxelized result = voxelize(context, params, triangles, paints());
    cases::Voxels found;
    found.colour = decode(params.format, result.bytes.at("colour"), context.real64());
    found.normal = decode(params.format, result.bytes.at("normal"), context.real64());
    found.emission = decode(params.format, result.bytes.at("emission"), context.real64());
    const double share = cases::worst_mean(found, expected);
    EXPECT_LE(share, 1) << device;
    EXPECT_GT(share, 0) << device << ": rounding shows";
  }
}

TEST(Voxelize, BitsAreTheSameOnEveryDeviceAndRunAfterRun) {
  const VoxelGrid grid = unit_grid(37);
  const VoxelTriangles triangles = prepare(painted(1500, 37), grid);
  for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4}) {
    VoxelizeParams params = with_everything(voxelize_params(grid, triangles));
    params.format = format;
    Voxelized first;
    for (const std::string& device : test_devices())
      for (int run = 0; run < 2; ++run) {
        const Voxelized result = voxelize(test_context(device), params, triangles, paints());
        if (first.bytes.empty()) first = result;
        for (const char* const name : {"colour", "normal", "emission"})
          EXPECT_EQ(result.bytes.at(name), first.bytes.at(name)) << device << " " << name << " " << luxel::name(format);
        EXPECT_EQ(result.counters, first.counters) << device;
      }
  }
}

TEST(Voxelize, VertexOrderChangesNothingAndWindingTurnsNormals) {
  const VoxelGrid grid = unit_grid(16);
  const Mesh mesh = painted(300, 16);
  const auto turned = [&](std::array<std::size_t, 3> order) {
    Mesh other = mesh;
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
      for (std::size_t i = 0; i < 3; ++i) other.indices[3 * t + i] = mesh.indices[3 * t + order[i]];
    return prepare(other, grid);
  };
  const VoxelTriangles plain = prepare(mesh, grid), rotated = turned({1, 2, 0}), flipped = turned({0, 2, 1});
  const VoxelizeParams params = with_everything(voxelize_params(grid, plain));
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Voxelized a = voxelize(context, params, plain, paints()), b = voxelize(context, params, rotated, paints()),
                    c = voxelize(context, params, flipped, paints());
    EXPECT_EQ(a.bytes, b.bytes) << device;
    EXPECT_EQ(a.bytes.at("colour"), c.bytes.at("colour")) << device;
    const std::vector<double> n = decode(params.format, a.bytes.at("normal")), m = decode(params.format, c.bytes.at("normal"));
    for (std::size_t i = 0; i < n.size(); ++i) ASSERT_NEAR(n[i], -m[i], 0x1p-13) << device;  // a step of 2^-14, twice
  }
}

TEST(Voxelize, NormalsPointToWhereTheTriangleIsCounterClockwise) {
  Mesh mesh;
  mesh.add({1, 1, 2.5, 7, 1, 2.5, 1, 7, 2.5});  // seen from +z
  const VoxelGrid grid = unit_grid(8);
  const VoxelTriangles triangles = prepare(mesh, grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.normal = true;
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize(test_context(device), params, triangles);
    const std::vector<double> normal = decode(params.format, result.bytes.at("normal"));
    const std::size_t at = 4 * ((2 * 8 + 2) * 8 + 2);
    EXPECT_EQ(normal[at], 0) << device;
    EXPECT_EQ(normal[at + 1], 0) << device;
    EXPECT_EQ(normal[at + 2], 1) << device;
  }
}

TEST(Voxelize, OtherMergingsTouchTheSameVoxels) {
  const VoxelGrid grid = unit_grid(24);
  Mesh mesh = cases::icosphere({12, 12, 12}, 10, 2);
  const VoxelTriangles triangles = prepare(mesh, grid);
  const VoxelizeParams exact = voxelize_params(grid, triangles);
  const std::vector<truth::Material> grey{{{0.2, 0.4, 0.6, 1}, {}}};
  for (const std::string& device : test_devices()) {
    const std::vector<char> set = occupied(exact, voxelize(test_context(device), exact, triangles, grey));
    for (const VoxelizeMerging merging : {VoxelizeMerging::moving_average, VoxelizeMerging::last_write}) {
      VoxelizeParams params = exact;
      params.merging = merging;
      const Voxelized result = voxelize(test_context(device), params, triangles, grey);
      EXPECT_EQ(different(occupied(params, result), set), 0u) << device;
      const std::vector<double> colour = decode(params.format, result.bytes.at("colour"));
      for (std::size_t i = 0; i < set.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)  // 0.2, 0.4, 0.6 are steps of 8 bits
          ASSERT_NEAR(colour[4 * i + k], set[i] ? 0.2 * static_cast<double>(k + 1) : 0, 1e-6) << device;
    }
  }
}

TEST(VoxelizeFull, AMillionTrianglesInOneVoxelDoNotWrap) {
  Mesh mesh;
  for (int i = 0; i < 1000000; ++i) mesh.add({1, 1, 1.5, 2, 1, 1.5, 1, 2, 1.5}, i % 4 == 0 ? 1 : 0);
  VoxelGrid grid = unit_grid(3);
  VoxelTriangles triangles = prepare(mesh, grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.materials = 2;
  const std::vector<truth::Material> two{{{1, 0, 0.5, 1}, {}}, {{0, 1, 0.5, 1}, {}}};
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize(test_context(device), params, triangles, two);
    const std::vector<double> colour = decode(params.format, result.bytes.at("colour"));
    const std::size_t at = 4 * ((1 * 3 + 1) * 3 + 1);
    EXPECT_EQ(colour[at], 0.75) << device;
    EXPECT_EQ(colour[at + 1], 0.25) << device;
    EXPECT_EQ(colour[at + 2], 0.5) << device;
    EXPECT_EQ(result.count(VoxelizeCount::saturated), 0u) << device;
  }
}

// A square of 16 x 16 voxels at z = 0.5, u along x and v along y, from 0 to `repeats`.
Mesh square(double repeats, std::vector<double>& uvs) {
  Mesh mesh;
  mesh.positions = {0, 0, 0.5, 16, 0, 0.5, 16, 16, 0.5, 0, 16, 0.5};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  uvs = {0, 0, repeats, 0, repeats, repeats, 0, repeats};
  return mesh;
}

struct Textured {
  std::vector<double> colour;
  std::uint32_t occupied = 0;
};

// The square with a texture on it: what the voxels of its layer hold.
Textured with_texture(Context& context, const VoxelTexture& texture, double repeats, bool opacity) {
  std::vector<double> uvs;
  const Mesh mesh = square(repeats, uvs);
  VoxelMesh view = mesh.view();
  view.uvs = uvs.data();
  const VoxelGrid grid = unit_grid(16);
  const VoxelTriangles triangles = voxel_triangles(view, grid).value();
  const VoxelTextures textures = voxel_textures(&texture, 1).value();
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.opacity = opacity;
  params.texels = static_cast<int>(textures.texels.size());
  const std::vector<float> material{1, 0.5f, 1, 1, 0, 0, 0, 0};
  const std::vector<Bytes> out =
      run_bytes(context, plan(params, context.profile()).value(),
                {{"triangles", bytes_of(triangles.records)},
                 {"materials", encode(Format::f32x4, material, context.real64())},
                 {"uvs", encode(Format::f32x1, triangles.uvs, context.real64())},
                 {"texture_table", bytes_of(textures.table)},
                 {"texels", bytes_of(textures.texels)}},
                {"colour", "counters"});
  Textured result;
  result.colour = decode(params.format, out[0], context.real64());
  result.colour.resize(16 * 16 * 4);
  std::memcpy(&result.occupied, out[1].data() + 4 * static_cast<int>(VoxelizeCount::occupied), 4);
  return result;
}

// 16 x 16 texels: red counts x, green counts y, in steps of 17 of 255; alpha 255 left of x = 8, 51 from there on.
std::vector<std::uint8_t> ramp() {
  std::vector<std::uint8_t> rgba;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x)
      for (const int v : {17 * x, 17 * y, 0, x < 8 ? 255 : 51}) rgba.push_back(static_cast<std::uint8_t>(v));
  return rgba;
}

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

TEST(VoxelizeTextures, AreSampledWhereTheTriangleMeetsTheVoxel) {
  const std::vector<std::uint8_t> texels = ramp();
  VoxelTexture texture;
  texture.rgba = texels.data();
  texture.width = texture.height = 16;
  for (const std::string& device : test_devices()) {
    const Textured result = with_texture(test_context(device), texture, 1, true);
    EXPECT_EQ(result.occupied, 256u) << device;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        if (std::abs(x - y) <= 1 || x == 7 || x == 8) continue;  // where the triangles meet: other centroids, and corners
        const double* const v = result.colour.data() + 4 * (16 * y + x);
        // A texel a voxel, sampled at its centre: steps 2^-14 of the sums, and a centroid off by 2^-20.
        EXPECT_NEAR(v[0], linear(17 * x / 255.0), 1e-4) << device << " " << x << " " << y;
        EXPECT_NEAR(v[1], 0.5 * linear(17 * y / 255.0), 1e-4) << device << " " << x << " " << y;
        EXPECT_NEAR(v[3], x < 8 ? 1 : 0.2, 1e-4) << device << " " << x << " " << y;
      }
  }
}

TEST(VoxelizeTextures, MasksRemoveVoxels) {
  const std::vector<std::uint8_t> texels = ramp();
  VoxelTexture texture;
  texture.rgba = texels.data();
  texture.width = texture.height = 16;
  texture.alpha_cutoff = 0.5;
  for (const std::string& device : test_devices()) {
    const Textured result = with_texture(test_context(device), texture, 1, true);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x)
        EXPECT_TRUE(std::abs(x - y) <= 1 || result.colour[static_cast<std::size_t>(4 * (16 * y + x) + 3)] == (x < 8 ? 1 : 0)) << device;
  }
}

TEST(VoxelizeTextures, MinifiedOnesAreAveragedInLinearLight) {
  std::vector<std::uint8_t> texels;  // black and white squares of a texel
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) texels.insert(texels.end(), 3, (x + y) % 2 ? 255 : 0), texels.push_back(255);
  VoxelTexture texture;
  texture.rgba = texels.data();
  texture.width = texture.height = 64;
  for (const VoxelWrap wrap : {VoxelWrap::repeat, VoxelWrap::mirror})
    for (const std::string& device : test_devices()) {
      texture.wrap_u = texture.wrap_v = wrap;
      const Textured result = with_texture(test_context(device), texture, 4, false);
      // Half of the light is 187.5 of 255 in sRGB: stored as 188, 0.5029.
      for (std::size_t i = 0; i < 256; ++i) ASSERT_NEAR(result.colour[4 * i], linear(188 / 255.0), 1e-4) << device;
    }
}

TEST(VoxelizeTextures, AreTheSameBitsEverywhere) {
  const std::vector<std::uint8_t> texels = ramp();
  VoxelTexture texture;
  texture.rgba = texels.data();
  texture.width = texture.height = 16;
  std::vector<double> first;
  for (const VoxelWrap wrap : {VoxelWrap::repeat, VoxelWrap::clamp, VoxelWrap::mirror}) {
    texture.wrap_u = texture.wrap_v = wrap;
    for (const double repeats : {0.31, 1.9, 13.7}) {
      first.clear();
      for (const std::string& device : test_devices()) {
        const Textured result = with_texture(test_context(device), texture, repeats, true);
        if (first.empty()) first = result.colour;
        EXPECT_EQ(result.colour, first) << device << " " << repeats;
      }
    }
  }
}

}  // namespace
}  // namespace luxel

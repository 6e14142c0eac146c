// voxelize with vertices in a device buffer, rounded there in float, beside the host's rounding in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/cases/voxelize_support.h"
#include "tests/support/voxels.h"

namespace luxel {
namespace {

using cases::Mesh;
using cases::unit_grid;

VoxelizeParams there(const Mesh& mesh, const VoxelGrid& grid, VoxelizeParams params) {
  params.device_vertices = params.device_materials = true;
  params.triangles = static_cast<int>(mesh.triangles());
  params.vertices = static_cast<int>(mesh.positions.size() / 3);
  params.origin = grid.origin;
  params.voxel = grid.voxel;
  return params;
}

Voxelized run(Context& context, const Mesh& mesh, const VoxelizeParams& params, NamedBytes more = {}) {
  std::vector<std::uint32_t> materials = mesh.materials;
  materials.resize(mesh.triangles());
  const std::vector<float> positions(mesh.positions.begin(), mesh.positions.end()), white(8 * static_cast<std::size_t>(params.materials), 1.0f);
  more.insert(more.end(), {{"positions", encode(Format::f32x1, positions, context.real64())},
                           {"indices", bytes_of(mesh.indices)},
                           {"triangle_materials", bytes_of(materials)},
                           {"materials", encode(Format::f32x4, white, context.real64())}});
  const std::vector<std::string> names{"colour", "counters"};
  const Result<Plan> made = plan(params, context.profile());
  Voxelized result;
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made.ok()) return result;
  std::vector<Bytes> out = run_bytes(context, made.value(), more, names);
  for (std::size_t i = 0; i < names.size(); ++i) result.bytes[names[i]] = std::move(out[i]);
  std::memcpy(result.counters.data(), result.bytes["counters"].data(), sizeof result.counters);
  return result;
}

TEST(VoxelizeDevice, WhatCannotBeTakenIsCounted) {
  VoxelGrid grid = unit_grid(32);
  grid.origin = {-3.25, 100.5, 0.0};
  grid.voxel = 0.25;
  Mesh mesh = cases::icosphere({0.75, 104.5, 4.0}, 3.5, 3);
  for (double& c : mesh.positions) c = std::floor(c * 65536) / 65536;  // multiples of 2^-14 voxel: rounded alike
  const double far = 1600, x = 50;  // voxels 6413 and 213 of 32
  const VoxelTriangles triangles = voxel_triangles(mesh.view(), grid).value();
  const VoxelizeParams params = voxelize_params(grid, triangles);
  const std::vector<char> set = occupied(params, voxelize(test_context(test_devices()[0]), params, triangles));
  const double nan = std::nan("");
  mesh.add({1, 1, 1, 2, 2, nan, 1, 2, 2});
  mesh.add({1, 1, 1, 2, 2, 1e35, 1, 2, 2});          // overflows in steps of 2^-16 voxel
  mesh.add({x, 1, 1, x, 2, 1, x, 2, 2});             // outside
  mesh.add({far, 103, 1, far, 104, 1, far, 103, 2}); // far outside: nothing is missing for it
  mesh.add({-far, 103, 1, 1, 104, 1, 1, 103, 2});    // its bounds meet the grid, its first corner is too far
  mesh.add({-1, 103, 1, 1, 2e4, 1, 1, 103, 2});
  mesh.indices.insert(mesh.indices.end(), {0, 1, 0xfffffff0u});
  for (const std::string& device : test_devices()) {
    const Voxelized result = run(test_context(device), mesh, there(mesh, grid, params));
    EXPECT_EQ(different(occupied(params, result), set), 0u) << device;
    EXPECT_EQ(result.count(VoxelizeCount::not_finite), 2u) << device;
    EXPECT_EQ(result.count(VoxelizeCount::bad_index), 1u) << device;
    EXPECT_EQ(result.count(VoxelizeCount::far), 2u) << device;
  }
}

TEST(VoxelizeDevice, NaNInAnyCoordinateIsFound) {
  const VoxelGrid grid = unit_grid(16);
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    Mesh mesh;
    for (int k = 0; k < 9; ++k) {
      std::array<double, 9> v{1, 1, 1, 2, 2, 9, 1, 12, 2};
      v[static_cast<std::size_t>(k)] = bad;
      mesh.add({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]});
    }
    VoxelizeParams params = voxelize_params(grid, voxel_triangles(mesh.view(), grid).value());
    params.blocks = params.pieces = params.bricks = 64;
    for (const std::string& device : test_devices()) {
      const Voxelized result = run(test_context(device), mesh, there(mesh, grid, params));
      EXPECT_EQ(result.count(VoxelizeCount::not_finite), 9u) << device << " " << bad;
      EXPECT_EQ(result.count(VoxelizeCount::far), 0u) << device << " " << bad;
      EXPECT_EQ(result.count(VoxelizeCount::occupied), 0u) << device << " " << bad;
    }
  }
}

// A floor a quarter of a step below a face of voxels is rounded onto it, and touches both sides.
TEST(VoxelizeDevice, RoundsToTheNearestStep) {
  const VoxelGrid grid = unit_grid(16);
  const double z = 4 - 0x1p-18;
  Mesh mesh;
  mesh.add({1.5, 1.5, z, 12.5, 1.5, z, 1.5, 12.5, z});
  const VoxelTriangles triangles = voxel_triangles(mesh.view(), grid).value();
  const VoxelizeParams params = voxelize_params(grid, triangles);
  for (const std::string& device : test_devices()) {
    const std::vector<char> host = occupied(params, voxelize(test_context(device), params, triangles));
    const std::vector<char> set = occupied(params, run(test_context(device), mesh, there(mesh, grid, params)));
    EXPECT_EQ(different(set, host), 0u) << device;
    EXPECT_TRUE(set[(3 * 16 + 4) * 16 + 4] && set[(4 * 16 + 4) * 16 + 4]) << device;
  }
}

// Far beyond what the host clips at, -2..3 grids, and not clipped: a floor across the grid.
TEST(VoxelizeDevice, AFloorOfManyGridsIsWhole) {
  const VoxelGrid grid = unit_grid(16);
  Mesh mesh;
  mesh.add({-4096, 5.5, -4096, 6144, 5.5, -4096, 8, 5.5, 6144});
  VoxelizeParams params = voxelize_params(grid, voxel_triangles(mesh.view(), grid).value());
  params.blocks = params.pieces = params.bricks = 64;
  for (const std::string& device : test_devices()) {
    const Voxelized result = run(test_context(device), mesh, there(mesh, grid, params));
    EXPECT_EQ(result.count(VoxelizeCount::far), 0u) << device;
    const std::vector<char> set = occupied(params, result);
    for (std::size_t i = 0; i < set.size(); ++i) ASSERT_EQ(set[i] != 0, i / 16 % 16 == 5) << device << " " << i;
  }
}

// Steps finer than 2^-16 voxel, for the triangles as they were before any rounding.
constexpr double fine = 0x1p22;

struct Difference {
  std::size_t missing = 0, extra = 0;
  double most = 0;              // how much a voxel's box must grow or shrink for the triangles to (not) meet it, voxels
  std::size_t beyond = 0;       // voxels of which that is more than the bound
};

// Voxels of which a set differs from what the triangles as they are touch within `bound`: an extra one is met by a triangle
// where its box grows by that, a missing one by none where it shrinks. Triangles that are moved by so much along each axis
// cannot do otherwise.
Difference compare(const Mesh& mesh, const VoxelGrid& grid, const std::vector<char>& exact, const std::vector<char>& set,
                   double bound) {
  Difference d;
  std::vector<double> needed(set.size(), 0);  // growth of an extra voxel, and what a missing one may shrink by
  const int n = grid.width;
  for (std::size_t i = 0; i < set.size(); ++i) {
    d.missing += exact[i] && !set[i];
    d.extra += set[i] && !exact[i];
    if (set[i] && !exact[i]) needed[i] = 1;
  }
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    truth::Triangle triangle;
    std::array<int, 3> first, last;
    for (std::size_t k = 0; k < 3; ++k) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (std::size_t i = 0; i < 3; ++i) {
        const double g = (mesh.positions[3 * std::size_t{mesh.indices[3 * t + i]} + k] - grid.origin[k]) / grid.voxel;
        triangle[i][k] = static_cast<std::int64_t>(std::nearbyint(g * fine));
        low = std::min(low, g);
        high = std::max(high, g);
      }
      first[k] = std::clamp(static_cast<int>(std::floor(low - 0.25)), 0, n - 1);
      last[k] = std::clamp(static_cast<int>(std::floor(high + 0.25)), 0, n - 1);
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) {
          const std::size_t i = (static_cast<std::size_t>(z) * n + y) * n + x;
          if (exact[i] == set[i]) continue;
          const auto meets = [&](double growth) {
            const auto by = static_cast<std::int64_t>(growth * fine), unit = static_cast<std::int64_t>(fine);
            return truth::meets(triangle, {x * unit - by, y * unit - by, z * unit - by},
                                {(x + 1) * unit + by, (y + 1) * unit + by, (z + 1) * unit + by});
          };
          const double sign = set[i] ? 1 : -1;
          double low = 0, high = 0.25;  // bisected: meets() grows with the box
          if (set[i] ? !meets(high) : !meets(0)) continue;
          for (int step = 0; step < 20; ++step) {
            const double middle = (low + high) / 2;
            (meets(sign * middle) == (set[i] != 0) ? high : low) = middle;
          }
          needed[i] = set[i] ? std::min(needed[i], low) : std::max(needed[i], low);
        }
  }
  for (const double v : needed) {
    d.most = std::max(d.most, v);
    d.beyond += v > bound;
  }
  return d;
}

struct Far {
  int n;
  double voxels;  // from the origin to the mesh
};
// A coordinate in the grid, |g| <= n voxels, passes five operations in float (two differences, the scale's own rounding, the
// product, the half), each within 2^-24 of it, and is rounded to 2^-16 voxel; the position had been rounded to float, by at
// most 2^-24 of its distance from the origin.
void expect_within_bound(const Far& far) {
  const auto [n, distance] = far;
  const std::string file = data_file("stanford_bunny/stanford-bunny.obj");
  Mesh mesh = file.empty() ? cases::icosphere({0, 0.1, 0}, 0.075, 6) : cases::read_obj(file);
  VoxelGrid grid = unit_grid(n);
  grid.origin = {-0.09624699, 0.030747509999999992, -0.08094349};
  grid.voxel = 0.15881298 / n;
  const double shift = distance * grid.voxel;
  const double away[] = {shift, -shift, shift};
  for (std::size_t k = 0; k < 3; ++k) grid.origin[k] += away[k];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] += away[i % 3];
  const VoxelTriangles triangles = voxel_triangles(mesh.view(), grid).value();
  const VoxelizeParams params = voxelize_params(grid, triangles);
  VoxelizeParams here = there(mesh, grid, params);
  here.pieces = 2 * params.pieces;  // rounded otherwise, triangles touch other bricks
  here.blocks = 2 * params.blocks;
  here.bricks = 0;
  double lost = 0;
  for (const double p : mesh.positions) lost = std::max(lost, std::fabs(p - static_cast<float>(p)) / grid.voxel);
  EXPECT_LE(lost, 0x1p-24 * (distance + 200 + n));  // the mesh lies within 200 voxels
  const double bound = 0x1p-17 + 5 * 0x1p-24 * n + lost + 1 / fine;
  std::vector<char> first;
  for (const std::string& device : test_devices()) {
    const std::vector<char> exact = occupied(params, voxelize(test_context(device), params, triangles));
    const std::vector<char> set = occupied(here, run(test_context(device), mesh, here));
    if (!first.empty()) {
      EXPECT_EQ(different(set, first), 0u) << device;
      continue;
    }
    first = set;
    const Difference d = compare(mesh, grid, exact, set, bound);
    testing::Test::RecordProperty("missing", std::to_string(d.missing));
    testing::Test::RecordProperty("extra", std::to_string(d.extra));
    testing::Test::RecordProperty("most", std::to_string(d.most));
    EXPECT_EQ(d.beyond, 0u) << device << ": " << d.most << " of " << bound << " voxels";
    if (distance >= 1e6) {
      EXPECT_GT(d.most, bound / 4) << "the bound says something";
    }
  }
}

class VoxelizeDeviceRounding : public testing::TestWithParam<Far> {};
TEST_P(VoxelizeDeviceRounding, IsWithinItsBound) { expect_within_bound(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Bunny, VoxelizeDeviceRounding, testing::Values(Far{32, 0}, Far{64, 1e3}, Far{64, 1e6}));

class VoxelizeDeviceRoundingFull : public testing::TestWithParam<Far> {};
TEST_P(VoxelizeDeviceRoundingFull, IsWithinItsBound) { expect_within_bound(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Bunny, VoxelizeDeviceRoundingFull,
                         testing::Values(Far{32, 1e3}, Far{32, 1e6}, Far{64, 0}, Far{128, 0}, Far{128, 1e3}, Far{128, 1e6}));

// With textures: corners' coordinates go with their corners, as the host's records have them.
TEST(VoxelizeDevice, TexturesGiveTheHostsColours) {
  const VoxelGrid grid = unit_grid(16);
  Mesh mesh;  // multiples of 2^-16: no rounding
  mesh.add({0, 0, 0.5, 16, 0, 3.5, 16, 16, 4.5}, 0);
  mesh.add({16, 16, 9.25, 0, 1.5, 10.5, 2, 16, 12}, 1);
  const std::vector<double> uvs{0, 0, 1, 0.25, 1, 2.5, -0.5, 0.75, 0.125, 0, std::nan(""), 1.5};
  VoxelMesh view = mesh.view();
  view.uvs = uvs.data();
  const VoxelTriangles triangles = voxel_triangles(view, grid).value();
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 16 * 16; ++i)
    for (const int v : {17 * (i % 16), 17 * (i / 16), 90, i % 16 < 8 ? 255 : 51}) texels.push_back(static_cast<std::uint8_t>(v));
  VoxelTexture texture[2];
  for (VoxelTexture& t : texture) t.rgba = texels.data(), t.width = t.height = 16;
  texture[1].alpha_cutoff = 0.5;
  const VoxelTextures textures = voxel_textures(texture, 2).value();
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.opacity = true;
  params.materials = 2;
  params.texels = static_cast<int>(textures.texels.size());
  const std::vector<float> white(16, 1.0f), coordinates(uvs.begin(), uvs.end());
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    NamedBytes shared{{"materials", encode(Format::f32x4, white, context.real64())},
                      {"texture_table", bytes_of(textures.table)},
                      {"texels", bytes_of(textures.texels)}};
    NamedBytes records = shared;
    records.insert(records.end(), {{"triangles", bytes_of(triangles.records)},
                                   {"uvs", encode(Format::f32x1, triangles.uvs, context.real64())}});
    const Bytes expected = run_bytes(context, plan(params, context.profile()).value(), records, {"colour"})[0];
    NamedBytes own{{"texture_table", bytes_of(textures.table)},
                   {"texels", bytes_of(textures.texels)},
                   {"uvs", encode(Format::f32x1, coordinates, context.real64())}};
    EXPECT_EQ(run(context, mesh, there(mesh, grid, params), own).bytes.at("colour"), expected) << device;
    const std::vector<double> colour = decode(Format::f32x4, expected, context.real64());
    EXPECT_GT(*std::max_element(colour.begin(), colour.end()), 0.1);
  }
}

}  // namespace
}  // namespace luxel

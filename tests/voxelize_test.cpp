// voxelize: sets of voxels against exact answers, means against clipping in double, the same bits on every execution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/glm.hpp>

#include "bench/io/array.h"
#include "tests/cases/voxelize_support.h"
#include "tests/support/voxels.h"

namespace luxel {
namespace {

using cases::awkward_mesh;
using cases::Mesh;
using cases::unit_grid;

using Fragment = std::array<std::uint32_t, 4>;  // x, y, z, triangle

std::vector<Fragment> fragments(const Voxelized& result) {
  const std::vector<std::uint32_t> words = result.words("fragments");
  std::vector<Fragment> list(std::min<std::size_t>(result.count(VoxelizeCount::fragments), words.size() / 4));
  for (std::size_t i = 0; i < list.size(); ++i) std::copy_n(words.begin() + static_cast<std::ptrdiff_t>(4 * i), 4, list[i].begin());
  std::sort(list.begin(), list.end());
  return list;
}

VoxelTriangles prepare(const Mesh& mesh, const VoxelGrid& grid) {
  const Result<VoxelTriangles> triangles = voxel_triangles(mesh.view(), grid);
  EXPECT_TRUE(triangles.ok()) << triangles.status().message();
  return triangles.ok() ? triangles.value() : VoxelTriangles{};
}

void expect_fits(const VoxelTriangles& triangles, const Voxelized& result) {
  EXPECT_LE(result.count(VoxelizeCount::blocks), triangles.blocks);
  EXPECT_LE(result.count(VoxelizeCount::pieces), triangles.pieces);
  EXPECT_LE(result.count(VoxelizeCount::bricks), triangles.bricks);
}

// The given answers: packed bits, index (x N + y) N + z, made from the OBJ's numbers as doubles.
struct Bunny {
  int n, occupied;
};
class VoxelizeBunny : public testing::TestWithParam<Bunny> {};

TEST_P(VoxelizeBunny, EqualsTheGivenAnswer) {
  const auto [n, count] = GetParam();
  const std::string mesh_file = data_file("stanford_bunny/stanford-bunny.obj");
  const std::string answer_file = data_file("numeric/vox_bunny_stanford_" + std::to_string(n) + ".npy");
  if (mesh_file.empty() || answer_file.empty()) GTEST_SKIP() << "no LUXEL_DATA";
  const Mesh mesh = cases::read_obj(mesh_file);
  const Result<io::Array> answer = io::read_npy(answer_file);
  ASSERT_TRUE(answer.ok()) << answer.status().message();
  VoxelGrid grid = unit_grid(n);
  grid.origin = {-0.09624699, 0.030747509999999992, -0.08094349};
  grid.voxel = 0.15881298 / n;
  const VoxelTriangles triangles = prepare(mesh, grid);
  ASSERT_EQ(triangles.count, 69451u);
  const VoxelizeParams params = voxelize_params(grid, triangles);
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize(test_context(device), params, triangles);
    const std::vector<char> set = occupied(params, result);
    std::size_t missing = 0, extra = 0;
    for (int x = 0; x < n; ++x)
      for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z) {
          const std::size_t bit = (static_cast<std::size_t>(x) * n + y) * n + z;
          const bool expected = answer.value().data[bit / 8] >> (7 - bit % 8) & 1;
          const bool found = set[(static_cast<std::size_t>(z) * n + y) * n + x];
          missing += expected && !found;
          extra += found && !expected;
        }
    EXPECT_EQ(missing, 0u) << device;
    EXPECT_EQ(extra, 0u) << device;
    EXPECT_EQ(result.count(VoxelizeCount::occupied), static_cast<std::uint32_t>(count)) << device;
    expect_fits(triangles, result);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, VoxelizeBunny, testing::Values(Bunny{32, 3399}, Bunny{64, 13460}, Bunny{128, 53856}),
                         [](const auto& info) { return std::to_string(info.param.n); });

class VoxelizeSets : public testing::TestWithParam<VoxelizeMode> {};

TEST_P(VoxelizeSets, OfTenThousandTrianglesAreExact) {
  const VoxelGrid grid = unit_grid(12);
  const VoxelTriangles triangles = prepare(awkward_mesh(10000, 12, 1), grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.mode = GetParam();
  const std::vector<truth::Voxel> expected = truth::voxels(triangles, grid, params.mode, {{}});
  const std::vector<Fragment> list = cases::fragments(expected, grid);
  ASSERT_GT(list.size(), 40000u);
  params.fragments = static_cast<int>(list.size());
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize(test_context(device), params, triangles);
    EXPECT_EQ(result.count(VoxelizeCount::fragments), list.size()) << device;
    EXPECT_EQ(cases::unmatched(fragments(result), list), 0) << device;
    EXPECT_EQ(different(occupied(params, result), occupied(expected)), 0u) << device;
    expect_fits(triangles, result);
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, VoxelizeSets, testing::Values(VoxelizeMode::conservative, VoxelizeMode::thin),
                         [](const auto& info) { return info.param == VoxelizeMode::thin ? "thin" : "conservative"; });

TEST(Voxelize, LargeTrianglesInALargeGridAreExact) {
  VoxelGrid grid = unit_grid(150);  // three blocks along each axis, no power of two
  grid.height = 70;
  const VoxelTriangles triangles = prepare(awkward_mesh(64, 150, 2), grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  const std::vector<char> expected = occupied(truth::voxels(triangles, grid, params.mode, {{}}));
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize(test_context(device), params, triangles);
    EXPECT_EQ(different(occupied(params, result), expected), 0u) << device;
    expect_fits(triangles, result);
    std::set<std::uint32_t> bricks;
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (expected[i]) bricks.insert(static_cast<std::uint32_t>(i % 150 / 8 + (i / 150 % 70 / 8 + i / 150 / 70 / 8 * 9) * 19));
    std::vector<std::uint32_t> listed = result.words("bricks");
    listed.resize(result.count(VoxelizeCount::bricks));
    EXPECT_EQ(listed, std::vector<std::uint32_t>(bricks.begin(), bricks.end())) << device;
  }
}

using cases::paints;

Mesh painted(std::uint32_t count, double n) {
  Mesh mesh = awkward_mesh(count, n, 3);
  for (std::uint32_t t = 0; t < count; ++t) mesh.materials[t] = t % 3;
  return mesh;
}

TEST(Voxelize, ClosedMeshesStayClosed) {
  const int n = 40;
  const VoxelGrid grid = unit_grid(n);
  for (const double radius : {4.0, 11.3, 18.0}) {
    const Mesh ball = cases::icosphere({20, 20, 20}, radius, 3);
    const Mesh cube = cases::cube_mesh(20 - std::floor(radius), 20 + std::floor(radius));  // its sides lie in grid planes
    for (const Mesh* mesh : {&ball, &cube})
      for (const VoxelizeMode mode : {VoxelizeMode::conservative, VoxelizeMode::thin}) {
        const VoxelTriangles triangles = prepare(*mesh, grid);
        VoxelizeParams params = voxelize_params(grid, triangles);
        params.mode = mode;
        for (const std::string& device : test_devices()) {
          const std::vector<char> set = occupied(params, voxelize(test_context(device), params, triangles));
          const std::size_t inside = cases::enclosed(set, n, mode == VoxelizeMode::conservative);
          EXPECT_GT(static_cast<double>(inside), 2 * std::pow(radius - 2, 3)) << device << " radius " << radius;
        }
      }
  }
}

TEST(Voxelize, TrianglesFarLargerThanTheGrid) {
  // Ten thousand grids wide, through y = 5.5: one layer; and another in the grid plane y = 16 = N: the last layer.
  for (const double y : {5.5, 16.0, 0.0, -0.0, 16.5}) {
    Mesh mesh;
    mesh.add({-80000, y, -80000, 80000, y, -80000, 0, y, 160000});
    const VoxelGrid grid = unit_grid(16);
    const VoxelTriangles triangles = prepare(mesh, grid);
    EXPECT_EQ(triangles.clipped, y <= 16 ? 1u : 0u);
    EXPECT_EQ(triangles.outside, y <= 16 ? 0u : 1u);
    const VoxelizeParams params = voxelize_params(grid, triangles);
    for (const std::string& device : test_devices()) {
      const std::vector<char> set = occupied(params, voxelize(test_context(device), params, triangles));
      for (std::size_t i = 0; i < set.size(); ++i) {
        const int layer = static_cast<int>(i) / 16 % 16;
        const bool expected = y == 5.5 ? layer == 5 : y == 16 ? layer == 15 : y == 0 && layer == 0;
        ASSERT_EQ(set[i] != 0, expected) << device << " y " << y << " voxel " << i;
      }
    }
  }
}

TEST(Voxelize, NeighboursStayClosedWhereTheyAreClipped) {
  // Two triangles share an edge that leaves the clipping cube; whichever way they are written, the edge's points agree.
  Mesh mesh;
  mesh.add({-900.3, 3.7, -700.9, 800.1, 9.2, 654.3, -100.7, 60000.5, 3.3});
  mesh.add({800.1, 9.2, 654.3, -900.3, 3.7, -700.9, 33.1, -70000.2, 9.9});
  const VoxelTriangles triangles = prepare(mesh, unit_grid(32));
  std::set<std::array<std::int32_t, 3>> corners[2];
  for (std::size_t i = 0; i < triangles.count; ++i)
    for (std::size_t v = 0; v < 3; ++v) {
      const std::int32_t* const at = triangles.records.data() + 12 * i + 3 * v;
      corners[triangles.records[12 * i + 10]].insert({at[0], at[1], at[2]});
    }
  std::size_t shared = 0;
  for (const auto& c : corners[0]) shared += corners[1].count(c);
  EXPECT_EQ(shared, 2u) << "both ends of the clipped edge";
}

TEST(Voxelize, ShiftedByAMillionVoxelsIsTheSame) {
  const Mesh mesh = cases::icosphere({8, 8, 8}, 6, 2);
  Mesh far = mesh;
  for (std::size_t i = 0; i < far.positions.size(); ++i) far.positions[i] = far.positions[i] * 0.125 + 1e6;
  VoxelGrid grid = unit_grid(16), far_grid = grid;
  far_grid.origin = {1e6, 1e6, 1e6};
  far_grid.voxel = 0.125;
  const VoxelTriangles near = prepare(mesh, grid), there = prepare(far, far_grid);
  // 1e6 has an ulp of 2^-33: 2^-14 of a unit of 2^-16 voxel, so that hardly a vertex rounds otherwise.
  std::size_t moved = 0;
  for (std::size_t i = 0; i < near.records.size(); ++i) {
    ASSERT_LE(std::abs(near.records[i] - there.records[i]), 1);
    moved += near.records[i] != there.records[i];
  }
  EXPECT_LE(moved, 2u);
}

TEST(Voxelize, WhatCannotBeUsedIsCountedAndSkipped) {
  const double nan = std::nan(""), infinity = HUGE_VAL;
  Mesh mesh;
  mesh.add({1, 1, 1, 2, 1, 1, 1, 2, 1});
  mesh.add({1, 1, 1, nan, 1, 1, 1, 2, 1});
  mesh.add({1, 1, 1, 2, infinity, 1, 1, 2, 1});
  mesh.add({1, 1, 1, 2, 1, -infinity, 1, 2, 1});
  mesh.add({1, 1, 1, 1e200, 1, 1, 1, 2, 1});
  mesh.add({100, 1, 1, 102, 1, 1, 101, 2, 1});
  mesh.indices.insert(mesh.indices.end(), {0, 1, 0xffffffffu});
  mesh.indices.insert(mesh.indices.end(), {18, 1, 2});  // one beyond the vertices
  mesh.materials.resize(mesh.triangles());
  const VoxelTriangles triangles = prepare(mesh, unit_grid(8));
  EXPECT_EQ(triangles.count, 1u);
  EXPECT_EQ(triangles.not_finite, 4u);
  EXPECT_EQ(triangles.bad_index, 2u);
  EXPECT_EQ(triangles.outside, 1u);
}

// Small enough for Oclgrind, which watches each access: every part, option and merging.
TEST(VoxelizeSmall, EveryPartRuns) {
  const VoxelGrid grid = unit_grid(10);
  const VoxelTriangles triangles = prepare(painted(40, 10), grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.materials = 3;
  params.fragments = 4000;
  for (const VoxelizeMode mode : {VoxelizeMode::conservative, VoxelizeMode::thin}) {
    params.mode = mode;
    params.opacity = params.normal = params.emission = mode == VoxelizeMode::thin;
    const std::vector<Fragment> expected = cases::fragments(truth::voxels(triangles, grid, mode, paints()), grid);
    for (const std::string& device : test_devices())
      EXPECT_EQ(cases::unmatched(fragments(voxelize(test_context(device), params, triangles, paints())), expected), 0) << device;
  }
}

TEST(VoxelizeSmall, OtherMergings) {
  const VoxelGrid grid = unit_grid(72);  // two blocks along each axis
  const VoxelTriangles triangles = prepare(painted(30, 72), grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  params.materials = 3;
  params.last = {71, 40, 20};
  for (const VoxelizeMerging merging : {VoxelizeMerging::moving_average, VoxelizeMerging::last_write}) {
    params.merging = merging;
    for (const std::string& device : test_devices())
      EXPECT_GT(voxelize(test_context(device), params, triangles, paints()).count(VoxelizeCount::occupied), 0u) << device;
  }
}

TEST(Voxelize, ARegionIsTheSameAsThatPartOfTheWhole) {
  const VoxelGrid grid = unit_grid(70);
  const VoxelTriangles triangles = prepare(painted(300, 70), grid);
  VoxelizeParams whole = voxelize_params(grid, triangles), part = whole;
  whole.materials = part.materials = 3;
  part.first = {3, 17, 60};
  part.last = {66, 31, 69};
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Bytes all = voxelize(context, whole, triangles, paints()).bytes.at("colour");
    const Bytes some = voxelize(context, part, triangles, paints()).bytes.at("colour");
    std::size_t differing = 0, written = 0;
    for (std::size_t i = 0; i < all.size() / 16; ++i) {
      const int p[] = {static_cast<int>(i % 70), static_cast<int>(i / 70 % 70), static_cast<int>(i / 4900)};
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) inside = inside && part.first[k] <= p[k] && p[k] <= part.last[k];
      const auto at = static_cast<std::ptrdiff_t>(16 * i);
      if (inside)
        differing += !std::equal(all.begin() + at, all.begin() + at + 16, some.begin() + at);
      else
        written += std::any_of(some.begin() + at, some.begin() + at + 16, [](std::uint8_t b) { return b != guard_byte; });
    }
    EXPECT_EQ(differing, 0u) << device;
    EXPECT_EQ(written, 0u) << device;
  }
}

TEST(Voxelize, TouchedBricksAloneAreWritten) {
  const VoxelGrid grid = unit_grid(44);
  const VoxelTriangles triangles = prepare(painted(20, 44), grid);
  VoxelizeParams whole = voxelize_params(grid, triangles);
  whole.materials = 3;
  VoxelizeParams touched = whole;
  touched.touched_only = true;
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Voxelized all = voxelize(context, whole, triangles, paints()), some = voxelize(context, touched, triangles, paints());
    EXPECT_EQ(some.counters, all.counters) << device;
    std::vector<std::uint32_t> bricks = all.words("bricks");
    bricks.resize(all.count(VoxelizeCount::bricks));
    const Bytes &a = all.bytes.at("colour"), &b = some.bytes.at("colour");
    for (std::size_t i = 0; i < a.size() / 16; ++i) {
      const auto brick = static_cast<std::uint32_t>(i % 44 / 8 + (i / 44 % 44 / 8 + i / 44 / 44 / 8 * 6) * 6);
      const bool listed = std::binary_search(bricks.begin(), bricks.end(), brick);
      for (std::size_t k = 16 * i; k < 16 * i + 16; ++k) ASSERT_EQ(b[k], listed ? a[k] : guard_byte) << device;
    }
  }
}

TEST(Voxelize, AnEmptyMeshIsAnEmptyGrid) {
  const VoxelGrid grid = unit_grid(9);
  const VoxelTriangles triangles = prepare({}, grid);
  const VoxelizeParams params = voxelize_params(grid, triangles);
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize(test_context(device), params, triangles);
    EXPECT_EQ(result.bytes.at("colour"), Bytes(9 * 9 * 9 * 16, 0)) << device;
    EXPECT_EQ(result.counters, (std::array<std::uint32_t, 16>{})) << device;
  }
}

TEST(Voxelize, WhatDoesNotFitIsCountedAndNotWritten) {
  const VoxelGrid grid = unit_grid(80);
  const VoxelTriangles triangles = prepare(painted(500, 80), grid);
  VoxelizeParams enough = voxelize_params(grid, triangles);
  enough.materials = 3;
  enough.fragments = 1 << 21;
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Voxelized whole = voxelize(context, enough, triangles, paints());
    ASSERT_LE(whole.count(VoxelizeCount::fragments), 1u << 21);
    for (const auto which : {VoxelizeCount::blocks, VoxelizeCount::pieces, VoxelizeCount::bricks, VoxelizeCount::fragments}) {
      VoxelizeParams few = enough;
      const int room = static_cast<int>(whole.count(which)) / 3;
      (which == VoxelizeCount::blocks ? few.blocks : which == VoxelizeCount::pieces ? few.pieces
       : which == VoxelizeCount::bricks ? few.bricks : few.fragments) = room;
      const Voxelized part = voxelize(context, few, triangles, paints());  // looks behind the ends
      EXPECT_EQ(part.count(which), whole.count(which)) << device << " " << static_cast<int>(which);
      if (which != VoxelizeCount::fragments) continue;
      EXPECT_EQ(part.bytes.at("colour"), whole.bytes.at("colour")) << device;
    }
  }
}

// Voxels of a grid whose box meets the triangle's bounds and plane, and its three edges as seen along the axis in which its normal
// is largest, in double.
std::vector<char> dilated_by_definition(const std::array<glm::dvec3, 3>& v, int n) {
  const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]), size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2, a = (axis + 1) % 3, b = (axis + 2) % 3;
  const glm::dvec3 low = glm::min(v[0], glm::min(v[1], v[2])), high = glm::max(v[0], glm::max(v[1], v[2]));
  std::vector<char> meets;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const glm::dvec3 c(x + 0.5, y + 0.5, z + 0.5);
        bool all = std::fabs(glm::dot(normal, c - v[0])) <= 0.5 * (size.x + size.y + size.z);
        for (int k = 0; k < 3; ++k) {
          all = all && c[k] + 0.5 >= low[k] && c[k] - 0.5 <= high[k];
          const glm::dvec3 p = v[static_cast<std::size_t>(k)], e = v[static_cast<std::size_t>((k + 1) % 3)] - p;
          const double side = (e[a] * (c[b] - p[b]) - e[b] * (c[a] - p[a])) * (normal[axis] < 0 ? -1 : 1);
          all = all && side >= -0.5 * (std::fabs(e[a]) + std::fabs(e[b]));
        }
        meets.push_back(all);
      }
  return meets;
}

TEST(Voxelize, DilatedIsItsDefinition) {
  const VoxelGrid grid = unit_grid(32);
  for (const auto& v : {std::array<glm::dvec3, 3>{{{2.1, 2.2, 5.3}, {29.7, 3.4, 11.1}, {30.2, 2.6, 12.7}}},
                        std::array<glm::dvec3, 3>{{{20.3, 4.1, 3.2}, {5.6, 25.3, 4.7}, {11.2, 9.4, 28.9}}}}) {
    Mesh mesh;
    mesh.add({v[0].x, v[0].y, v[0].z, v[1].x, v[1].y, v[1].z, v[2].x, v[2].y, v[2].z});
    const VoxelTriangles triangles = prepare(mesh, grid);
    VoxelizeParams params = voxelize_params(grid, triangles);
    // Only bricks that the triangle meets are looked at.
    const std::vector<char> exact = occupied(params, voxelize(test_context("cpu"), params, triangles));
    const auto brick_of = [](int i) { return i % 32 / 8 + i / 32 % 32 / 8 * 4 + i / 1024 / 8 * 16; };
    std::set<int> bricks;
    for (int i = 0; i < 32768; ++i)
      if (exact[static_cast<std::size_t>(i)]) bricks.insert(brick_of(i));
    std::vector<char> expected = dilated_by_definition(v, 32);
    for (int i = 0; i < 32768; ++i)
      if (!bricks.contains(brick_of(i))) expected[static_cast<std::size_t>(i)] = 0;
    params.mode = VoxelizeMode::dilated;
    for (const std::string& device : test_devices()) {
      const std::vector<char> found = occupied(params, voxelize(test_context(device), params, triangles));
      std::size_t different = 0;
      for (std::size_t i = 0; i < found.size(); ++i) different += (found[i] != 0) != (expected[i] != 0);
      EXPECT_EQ(different, 0u) << device << ", of " << std::count(expected.begin(), expected.end(), 1);
    }
  }
}

TEST(Voxelize, DilatedCoversMoreThanConservative) {
  const VoxelGrid grid = unit_grid(32);
  Mesh mesh;
  mesh.add({2, 2, 5, 30, 3, 11, 30, 2, 12});  // an acute corner
  const VoxelTriangles triangles = prepare(mesh, grid);
  VoxelizeParams params = voxelize_params(grid, triangles);
  for (const std::string& device : test_devices()) {
    params.mode = VoxelizeMode::conservative;
    const std::vector<char> exact = occupied(params, voxelize(test_context(device), params, triangles));
    params.mode = VoxelizeMode::dilated;
    const std::vector<char> more = occupied(params, voxelize(test_context(device), params, triangles));
    std::size_t missing = 0, extra = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      missing += exact[i] && !more[i];
      extra += more[i] && !exact[i];
    }
    EXPECT_EQ(missing, 0u) << device;
    EXPECT_GT(extra, 0u) << device;
  }
}

TEST(Voxelize, RefusesWhatIsOutOfRange) {
  VoxelizeParams good;
  good.width = good.height = good.depth = 16;
  EXPECT_TRUE(validate(good).ok());
  const auto message = [&](auto change) {
    VoxelizeParams p = good;
    change(p);
    return validate(p).message();
  };
  using P = VoxelizeParams;
  EXPECT_EQ(message([](P& p) { p.width = 0; }), "VoxelizeParams.width is 0; expected 1..2048");
  EXPECT_EQ(message([](P& p) { p.height = 2049; }), "VoxelizeParams.height is 2049; expected 1..2048");
  EXPECT_EQ(message([](P& p) { p.depth = -1; }), "VoxelizeParams.depth is -1; expected 1..2048");
  EXPECT_EQ(message([](P& p) { p.format = Format::f32x1; }),
            "VoxelizeParams.format is f32x1; expected f32x4, f16x4 or unorm8x4");
  EXPECT_EQ(message([](P& p) { p.emission_max = std::nan(""); }),
            "VoxelizeParams.emission_max is nan; expected 1e-30..1e+30");
  EXPECT_EQ(message([](P& p) { p.materials = 0; }), "VoxelizeParams.materials is 0; expected 1..16777216");
  EXPECT_EQ(message([](P& p) { p.merging = VoxelizeMerging::last_write, p.normal = true; }),
            "VoxelizeParams.normal is true; expected false unless merging is exact");
  EXPECT_NE(message([](P& p) { p.width = p.height = p.depth = 2048; }), "");
  VoxelGrid grid = unit_grid(8);
  grid.voxel = 0;
  EXPECT_EQ(voxel_triangles({}, grid).status().message(), "VoxelGrid.voxel is 0; expected a finite number above 0");
  grid = unit_grid(0);
  EXPECT_EQ(voxel_triangles({}, grid).status().message(), "VoxelGrid.width is 0; expected 1..2048");
}

}  // namespace
}  // namespace luxel

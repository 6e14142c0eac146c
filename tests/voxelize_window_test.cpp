// voxelize's moving windows: after any moves the volumes hold what the window voxelized anew gives, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/scene/images.h"
#include "tests/cases/voxelize_support.h"
#include "tests/support/voxels.h"

namespace luxel {
namespace {

using cases::Mesh;
using Voxel = std::array<int, 3>;

// Triangles all over a world around 0, from small ones to far longer than a window.
Mesh world_mesh(std::uint32_t count) {
  Mesh mesh = cases::awkward_mesh(count, 100, 5);
  for (double& v : mesh.positions) v -= 50;
  for (std::uint32_t t = 0; t < count; ++t) mesh.materials[t] = t % 3;
  return mesh;
}

struct Window {
  VoxelizeParams params;
  VoxelTriangles triangles;
};

Window window_on(const Mesh& mesh, Voxel extent) {
  VoxelGrid grid;
  grid.width = extent[0];
  grid.height = extent[1];
  grid.depth = extent[2];
  Result<VoxelTriangles> triangles = window_triangles(mesh.view(), grid);
  EXPECT_TRUE(triangles.ok()) << triangles.status().message();
  Window w;
  w.triangles = std::move(triangles).value();
  w.params = voxelize_params(grid, w.triangles);
  w.params.toroidal = true;
  w.params.opacity = w.params.normal = w.params.emission = true;
  w.params.emission_max = cases::brightest;
  w.params.materials = 3;
  return w;
}

using Volumes = std::vector<Bytes>;  // colour, normal, emission, counters
const std::vector<std::string> volume_names{"colour", "normal", "emission", "counters"};

// Voxelizes a region into volumes (none: new ones, which begin as a pattern).
Volumes make(Context& context, const VoxelizeParams& params, const VoxelTriangles& triangles, const Volumes& before) {
  const Result<Plan> made = plan(params, context.profile());
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made) return {};
  std::vector<float> table;
  for (const truth::Material& m : cases::paints()) {
    for (const double v : m.colour) table.push_back(static_cast<float>(v));
    for (const double v : m.emission) table.push_back(static_cast<float>(v));
    table.push_back(0);
  }
  NamedBytes inputs{{"triangles", bytes_of(triangles.records)},
                    {"materials", encode(Format::f32x4, table, context.real64())}};
  for (std::size_t i = 0; i + 1 < volume_names.size() && i < before.size(); ++i)
    inputs.emplace_back(volume_names[i], before[i]);
  Volumes out = run_bytes(context, made.value(), inputs, volume_names);
  std::uint32_t counts[16];
  std::memcpy(counts, out[3].data(), sizeof counts);
  EXPECT_LE(counts[0], triangles.blocks);
  EXPECT_LE(counts[1], triangles.pieces);
  return out;
}

class VoxelizeWindow : public testing::TestWithParam<Format> {};

TEST_P(VoxelizeWindow, HoldsAfterAnyMovesWhatItHoldsAnew) {
  Window w = window_on(world_mesh(500), {24, 16, 32});
  w.params.format = GetParam();
  const bool quick = GetParam() != Format::f32x4;
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    std::uint32_t at = 0;
    const auto below = [&](int n) { return static_cast<int>(n * scene::random01(at++, 9)); };
    w.params.window = {-7, 3, -40};
    Volumes held = make(context, w.params, w.triangles, {});
    for (int move = 0; move < (quick ? 3 : 12); ++move) {
      const Voxel from = w.params.window;
      const int reach = move % 4 == 3 ? 60 : move % 4 == 2 ? 20 : 3;  // also past the window's own length
      for (std::size_t k = 0; k < 3; ++k)
        w.params.window[k] = std::clamp(from[k] + below(2 * reach + 1) - reach, -70, 50);
      for (const VoxelizeParams& region : voxelize_move(w.params, from)) held = make(context, region, w.triangles, held);
      const Volumes anew = make(context, w.params, w.triangles, {});
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(held[i], anew[i]) << device << " " << volume_names[i] << " after move " << move;
    }
  }
}

TEST(VoxelizeWindowSmall, HoldsAfterAMoveWhatItHoldsAnew) {
  Mesh mesh = cases::awkward_mesh(6, 12, 5);
  for (double& v : mesh.positions) v -= 6;
  Window w = window_on(mesh, {8, 8, 8});
  w.params.window = {-3, -5, -4};
  const Voxel from = w.params.window;
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    w.params.window = from;
    Volumes held = make(context, w.params, w.triangles, {});
    w.params.window = {-2, -5, -2};
    for (const VoxelizeParams& region : voxelize_move(w.params, from)) held = make(context, region, w.triangles, held);
    const Volumes anew = make(context, w.params, w.triangles, {});
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(held[i], anew[i]) << device << " " << volume_names[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, VoxelizeWindow, testing::Values(Format::f32x4, Format::f16x4, Format::unorm8x4),
                         [](const auto& info) { return std::string(name(info.param)); });

// Where a voxel of the world lies in a volume.
std::size_t place(const Window& w, Voxel v) {
  const int extent[] = {w.params.width, w.params.height, w.params.depth};
  for (std::size_t k = 0; k < 3; ++k) v[k] = (v[k] % extent[k] + extent[k]) % extent[k];
  return (static_cast<std::size_t>(v[2]) * extent[1] + v[1]) * extent[0] + v[0];
}

TEST(Voxelize, AWindowHoldsTheExactSetOfItsPartOfTheWorld) {
  const Mesh mesh = world_mesh(300);
  Window w = window_on(mesh, {24, 16, 32});
  EXPECT_GT(w.triangles.clipped, 50u) << "triangles longer than the window are cut";
  for (const Voxel first : {Voxel{-7, 3, -40}, Voxel{8, -16, 0}}) {
    w.params.window = first;
    VoxelGrid grid;
    for (std::size_t k = 0; k < 3; ++k) grid.origin[k] = first[k];
    grid.width = 24, grid.height = 16, grid.depth = 32;
    const Result<VoxelTriangles> plain = voxel_triangles(mesh.view(), grid);
    ASSERT_TRUE(plain.ok());
    const std::vector<char> expected = occupied(truth::voxels(plain.value(), grid, w.params.mode, cases::paints()));
    for (const std::string& device : test_devices()) {
      const Volumes made = make(test_context(device), w.params, w.triangles, {});
      const std::vector<double> colour = decode(Format::f32x4, made[0]);
      std::size_t different = 0, occupied = 0;
      for (int z = 0; z < 32; ++z)
        for (int y = 0; y < 16; ++y)
          for (int x = 0; x < 24; ++x) {
            const bool found = colour[4 * place(w, {first[0] + x, first[1] + y, first[2] + z}) + 3] > 0;
            different += found != static_cast<bool>(expected[(static_cast<std::size_t>(z) * 16 + y) * 24 + x]);
            occupied += found;
          }
      EXPECT_EQ(different, 0u) << device;
      EXPECT_GT(occupied, 500u);
    }
  }
}

// A floor longer than any window, in a grid plane and beside a small copy of itself: parts cover it once, so that the mean
// of the two colours is the middle.
TEST(Voxelize, PartsOfATriangleCoverItOnce) {
  for (const double height : {4.0, 4.25, 16.0}) {
    Mesh mesh;
    for (const double reach : {1000.0, 8.0})
      for (const double side : {-1.0, 1.0})
        mesh.add({-reach, height, -reach, reach, height, reach, reach * side, height, -reach * side},
                 reach > 10 ? 1 : 0);
    Window w = window_on(mesh, {16, 16, 16});
    w.params.window = {-8, static_cast<int>(height) - 8, -8};
    w.params.materials = 3;
    for (const std::string& device : test_devices()) {
      const std::vector<double> colour = decode(Format::f32x4, make(test_context(device), w.params, w.triangles, {})[0]);
      for (int x = -4; x < 4; ++x) {
        const double* const voxel = &colour[4 * place(w, {x, static_cast<int>(height), 1 - x})];
        const auto& a = cases::paints()[0].colour;
        const auto& b = cases::paints()[1].colour;
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(voxel[c], (a[c] + b[c]) / 2, 2e-3) << device << " " << height;
      }
    }
  }
}

TEST(Voxelize, MovesMakeWhatScrolledInAndNothingTwice) {
  VoxelizeParams params;
  params.width = 16, params.height = 8, params.depth = 24;
  params.toroidal = true;
  params.window = {3, -5, 7};
  EXPECT_TRUE(voxelize_move(params, params.window).empty());
  for (const Voxel from : {Voxel{2, -5, 7}, Voxel{5, -1, 0}, Voxel{-12, -5, 30}, Voxel{3, 3, 7}, Voxel{100, -5, 7}}) {
    std::vector<int> made(16 * 8 * 24);
    for (const VoxelizeParams& p : voxelize_move(params, from)) {
      EXPECT_TRUE(validate(p));
      for (int z = p.first[2]; z <= p.last[2]; ++z)
        for (int y = p.first[1]; y <= p.last[1]; ++y)
          for (int x = p.first[0]; x <= p.last[0]; ++x) ++made[(z * 8 + y) * 16 + x];
    }
    for (int z = 0; z < 24; ++z)
      for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
          const Voxel old{x + 3 - from[0], y - 5 - from[1], z + 7 - from[2]};
          const bool kept = old[0] >= 0 && old[0] < 16 && old[1] >= 0 && old[1] < 8 && old[2] >= 0 && old[2] < 24;
          ASSERT_EQ(made[(z * 8 + y) * 16 + x], kept ? 0 : 1);
        }
  }
}

TEST(Voxelize, WindowsAreCheckedByName) {
  VoxelizeParams params;
  params.width = params.height = params.depth = 16;
  params.toroidal = true;
  EXPECT_TRUE(validate(params));
  const auto refused = [&](auto change, const char* field) {
    VoxelizeParams p = params;
    change(p);
    const Status s = validate(p);
    EXPECT_FALSE(s);
    EXPECT_NE(s.message().find(field), std::string::npos) << s.message();
  };
  refused([](auto& p) { p.height = 12; }, "VoxelizeParams.height is 12");
  refused([](auto& p) { p.width = 2048; }, "VoxelizeParams.width is 2048");
  refused([](auto& p) { p.window[1] = 8180; }, "VoxelizeParams.window is 8180");
  refused([](auto& p) { p.fragments = 4; }, "VoxelizeParams.fragments is 4");
  refused([](auto& p) { p.device_vertices = true; }, "VoxelizeParams.toroidal");
}

}  // namespace
}  // namespace luxel

// voxelize: an object that moves over static volumes: after any moves they hold the static scene with the object where it is.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/cases/voxelize_support.h"
#include "tests/support/voxels.h"

namespace luxel {
namespace {

using cases::Mesh;

const std::vector<std::string> attributes{"colour", "normal", "emission"};

std::vector<float> material_table() {
  std::vector<float> table;
  for (const truth::Material& m : cases::paints()) {
    for (const double v : m.colour) table.push_back(static_cast<float>(v));
    for (const double v : m.emission) table.push_back(static_cast<float>(v));
    table.push_back(0);
  }
  return table;
}

VoxelizeParams params_of(const VoxelGrid& grid, const VoxelTriangles& triangles, Format format) {
  VoxelizeParams p = voxelize_params(grid, triangles);
  p.format = format;
  p.opacity = p.normal = p.emission = true;
  p.emission_max = cases::brightest;
  p.materials = 3;
  p.bricks = 0;
  return p;
}

// An object of `object_at(place)` moves over a building.
void check_moves(const VoxelGrid& grid, const Mesh& building, const std::function<Mesh(double)>& object_at,
                 const std::vector<double>& places, Format format) {
  const VoxelTriangles still = voxel_triangles(building.view(), grid).value();
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const NamedBytes table{{"materials", encode(Format::f32x4, material_table(), context.real64())}};
    const VoxelizeParams whole = params_of(grid, still, format);
    const Voxelized under = voxelize(context, whole, still, cases::paints());
    std::map<std::string, Bytes> held = under.bytes;
    Bytes left_bricks(
        static_cast<std::size_t>((grid.width + 7) / 8 * ((grid.height + 7) / 8) * ((grid.depth + 7) / 8)) * 4),
        left_counters(64);
    for (const double at : places) {
      const VoxelTriangles moved = voxel_triangles(object_at(at).view(), grid).value();
      const VoxelizeParams alone = params_of(grid, moved, format);
      const Voxelized object = voxelize(context, alone, moved, cases::paints());
      VoxelizeParams over = alone;
      over.over = true;
      const Result<Plan> made = plan(over, context.profile());
      ASSERT_TRUE(made.ok()) << made.status().message();
      NamedBytes inputs = table;
      inputs.insert(
          inputs.end(),
          {{"triangles", bytes_of(moved.records)}, {"left_bricks", left_bricks}, {"left_counters", left_counters}});
      std::vector<std::string> outputs = attributes;
      for (const std::string& name : attributes) {
        inputs.emplace_back(name, held[name]);
        inputs.emplace_back("under_" + name, under.bytes.at(name));
      }
      outputs.insert(outputs.end(), {"bricks", "counters"});
      const std::vector<Bytes> out = run_bytes(context, made.value(), inputs, outputs);
      ASSERT_EQ(out.size(), outputs.size());
      const std::vector<char> covered = occupied(alone, object);
      const std::size_t pixel = bytes_per_pixel(format);
      for (std::size_t k = 0; k < 3; ++k) {
        held[attributes[k]] = out[k];
        std::size_t wrong = 0;
        for (std::size_t v = 0; v < covered.size(); ++v) {
          const Bytes& expected = covered[v] ? object.bytes.at(attributes[k]) : under.bytes.at(attributes[k]);
          wrong += !std::equal(expected.begin() + static_cast<std::ptrdiff_t>(v * pixel),
                               expected.begin() + static_cast<std::ptrdiff_t>((v + 1) * pixel),
                               out[k].begin() + static_cast<std::ptrdiff_t>(v * pixel));
        }
        EXPECT_EQ(wrong, 0u) << device << " " << attributes[k] << " with the object at " << at;
      }
      left_bricks = out[3];
      left_counters = out[4];
    }
  }
}

Mesh painted(Mesh mesh) {
  mesh.materials.clear();
  for (std::size_t t = 0; t < mesh.triangles(); ++t) mesh.materials.push_back(t % 3);
  return mesh;
}

class VoxelizeOver : public testing::TestWithParam<Format> {};

TEST_P(VoxelizeOver, HoldsTheObjectWhereItIsAndTheRestAsItWas) {
  VoxelGrid grid = cases::unit_grid(37);  // no whole bricks
  grid.depth = 21;
  // In part and wholly outside, too.
  check_moves(
      grid, painted(cases::awkward_mesh(60, 37, 3)),
      [](double at) {
        return painted(cases::icosphere({at, 15 + at / 4, 11}, 4.5, 2));
      },
      {6.0, 9.5, 30.0, 34.0, 100.0, 12.0}, GetParam());
}

TEST(VoxelizeOverSmall, HoldsTheObjectWhereItIsAndTheRestAsItWas) {
  check_moves(
      cases::unit_grid(11), painted(cases::awkward_mesh(6, 11, 3)),
      [](double at) {
        return painted(cases::icosphere({at, 4, 5}, 1.5, 0));
      },
      {2.0, 7.5}, Format::f32x4);
}

INSTANTIATE_TEST_SUITE_P(Formats, VoxelizeOver, testing::Values(Format::f32x4, Format::f16x4, Format::unorm8x4),
                         [](const auto& info) { return std::string(name(info.param)); });

}  // namespace
}  // namespace luxel

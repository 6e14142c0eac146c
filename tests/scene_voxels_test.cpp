// Scenes in voxels: meshes of every awkward kind from files, generated scenes, materials.
#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "bench/scene/voxels.h"
#include "tests/support/voxels.h"

namespace luxel {
namespace {

Voxelized voxelize_scene(Context& context, const scene::SceneVoxels& voxels, VoxelizeParams params) {
  const Plan made = plan(params, context.profile()).value();
  NamedBytes inputs{{"triangles", bytes_of(voxels.triangles.records)},
                    {"materials", encode(Format::f32x4, voxels.materials, context.real64())}};
  if (params.texels > 0) {
    inputs.emplace_back("uvs", encode(Format::f32x1, voxels.triangles.uvs, context.real64()));
    inputs.emplace_back("texture_table", bytes_of(voxels.textures.table));
    inputs.emplace_back("texels", bytes_of(voxels.textures.texels));
  }
  std::vector<std::string> names;
  for (const Resource& r : made.resources)
    if (r.written) names.push_back(r.name);
  std::vector<Bytes> out = run_bytes(context, made, inputs, names);
  Voxelized result;
  for (std::size_t i = 0; i < names.size(); ++i) result.bytes[names[i]] = std::move(out[i]);
  std::memcpy(result.counters.data(), result.bytes["counters"].data(), sizeof result.counters);
  return result;
}

TEST(SceneVoxels, OfEveryAdversarialMeshThatLoadsAreExact) {
  const std::string folder = data_file("meshes_adversarial");
  if (folder.empty()) GTEST_SKIP() << "no LUXEL_DATA";
  int loaded = 0;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) {
    const Result<scene::Scene> read = scene::read_mesh(file.string());
    if (!read) continue;
    ++loaded;
    SCOPED_TRACE(file.filename().string());
    const VoxelGrid grid = scene::grid_around(read.value(), 24);
    const Result<scene::SceneVoxels> made = scene::scene_voxels(read.value(), grid);
    ASSERT_TRUE(made.ok()) << made.status().message();
    const scene::SceneVoxels& voxels = made.value();
    VoxelizeParams params = voxels.params;
    params.normal = true;
    params.texels = 0;  // masks would take voxels away
    const std::vector<truth::Material> materials(read.value().materials.size());
    for (const VoxelizeMode mode : {VoxelizeMode::conservative, VoxelizeMode::thin}) {
      params.mode = mode;
      const std::vector<char> expected = occupied(truth::voxels(voxels.triangles, grid, mode, materials));
      Voxelized first;
      for (const std::string& device : test_devices()) {
        const Voxelized result = voxelize_scene(test_context(device), voxels, params);
        EXPECT_EQ(different(occupied(params, result), expected), 0u) << device;
        if (first.bytes.empty()) first = result;
        EXPECT_EQ(result.bytes.at("colour"), first.bytes.at("colour")) << device;
        EXPECT_EQ(result.bytes.at("normal"), first.bytes.at("normal")) << device;
        EXPECT_EQ(result.counters, first.counters) << device;
      }
    }
  }
  EXPECT_GE(loaded, 17);
}

TEST(SceneVoxels, GeneratedScenesKeepTheirMaterials) {
  const scene::Scene scene = scene::built_in("cornell").value();
  const Result<scene::SceneVoxels> made = scene::scene_voxels(scene, scene::grid_around(scene, 32));
  ASSERT_TRUE(made.ok()) << made.status().message();
  const VoxelizeParams& params = made.value().params;
  EXPECT_TRUE(params.emission);
  EXPECT_FALSE(params.opacity);
  for (const std::string& device : test_devices()) {
    const Voxelized result = voxelize_scene(test_context(device), made.value(), params);
    const std::vector<double> colour = decode(params.format, result.bytes.at("colour"));
    const std::vector<double> emission = decode(params.format, result.bytes.at("emission"));
    double brightest = 0, brightest_wanted = 0;
    std::size_t strange = 0;
    for (std::size_t i = 0; i < colour.size() / 4; ++i) {
      if (colour[4 * i + 3] == 0) continue;
      EXPECT_EQ(colour[4 * i + 3], 1);
      for (std::size_t k = 0; k < 3; ++k) brightest = std::max(brightest, emission[4 * i + k]);
      bool within = false;  // a mean lies between the materials
      for (const scene::Material& m : scene.materials) within = within || colour[4 * i] <= m.base_color.x + 1e-4;
      strange += !within;
    }
    for (const scene::Material& m : scene.materials)
      brightest_wanted = std::max({brightest_wanted, m.emission.x, m.emission.y, m.emission.z});
    EXPECT_EQ(strange, 0u) << device;
    // A voxel that only the lamp touches, or nearly: within a hundredth of it.
    EXPECT_NEAR(brightest, brightest_wanted, 0.01 * brightest_wanted) << device;
  }
}

TEST(SceneVoxels, WithoutExtentHaveAGrid) {
  scene::Scene scene;
  scene.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  scene.indices = {{0, 1, 2}};
  scene.triangle_materials = {0};
  scene.materials.emplace_back();
  const VoxelGrid grid = scene::grid_around(scene, 4);
  EXPECT_EQ(grid.voxel, 0.25);
  EXPECT_EQ(scene::scene_voxels(scene, grid).value().triangles.count, 1u);
}

}  // namespace
}  // namespace luxel

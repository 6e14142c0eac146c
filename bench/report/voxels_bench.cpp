#include <fmt/format.h>
#include <luxel/voxelize.h>

#include "bench/report/bench.h"
#include "bench/report/voxels.h"

namespace luxel::report {
std::vector<BenchSetting> voxelize_settings(const Profile& profile) {
  std::string name;
  const cases::Mesh mesh = bunny_or_ball(name);
  std::vector<BenchSetting> settings;
  const auto material = std::make_shared<const std::vector<double>>(std::vector<double>(8, 0.5));
  const auto add = [&](const std::string& text, const cases::Mesh& of, const VoxelGrid& grid, auto change) {
    const Result<VoxelTriangles> triangles = voxel_triangles(of.view(), grid);
    if (!triangles) return;
    VoxelizeParams p = voxelize_params(grid, triangles.value());
    change(p);
    const Result<Plan> made = plan(p, profile);
    if (!made) return;
    std::vector<double> records;
    for (const std::int32_t word : triangles.value().records) records.push_back(static_cast<std::uint32_t>(word));
    settings.push_back({text, made.value(), {}, {}});
    settings.back().data = {{"triangles", std::make_shared<const std::vector<double>>(std::move(records))},
                            {"materials", material}};
  };
  const auto nothing = [](VoxelizeParams&) {};
  const auto half = [](VoxelizeParams& p) { p.format = Format::f16x4; };
  for (const int n : {64, 128}) add(fmt::format("{} {}^3 f32x4", name, n), mesh, grid_around(mesh, n), nothing);
  const VoxelGrid fine = grid_around(mesh, 256);
  add(fmt::format("{} 256^3 f32x4", name), mesh, fine, nothing);
  add(fmt::format("{} 256^3 f16x4", name), mesh, fine, half);
  add(fmt::format("{} 256^3 f16x4 thin", name), mesh, fine, [](VoxelizeParams& p) {
    p.format = Format::f16x4;
    p.mode = VoxelizeMode::thin;
  });
  add(fmt::format("{} 256^3 f16x4 all attributes", name), mesh, fine, [](VoxelizeParams& p) {
    p.format = Format::f16x4;
    p.opacity = p.normal = p.emission = true;
  });
  // The same floor in two triangles and in 131,072.
  for (const int parts : {1, 256}) {
    const cases::Mesh floor = floor_of(parts);
    add(fmt::format("a floor of {} triangles 256^3 f16x4", floor.triangles()), floor, cases::unit_grid(256), half);
  }
  return settings;
}

}  // namespace luxel::report

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>
#include <luxel/voxelize.h>

#include "bench/report/bench.h"
#include "tests/cases/voxelize_meshes.h"

namespace luxel::report {
namespace {

// The bounding cube, centred, padded by 1 % of its side at each end.
VoxelGrid grid_around(const cases::Mesh& mesh, int n) {
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], mesh.positions[i]);
    high[i % 3] = std::max(high[i % 3], mesh.positions[i]);
  }
  const double side = 1.02 * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  VoxelGrid grid = cases::unit_grid(n);
  for (std::size_t k = 0; k < 3; ++k) grid.origin[k] = (low[k] + high[k] - side) / 2;
  grid.voxel = side / n;
  return grid;
}

}  // namespace

std::vector<BenchSetting> voxelize_settings(const Profile& profile) {
  const char* const data = std::getenv("LUXEL_DATA");
  cases::Mesh mesh = data ? cases::read_obj(std::string(data) + "/stanford_bunny/stanford-bunny.obj") : cases::Mesh{};
  const char* const name = mesh.triangles() > 0 ? "bunny" : "ball";
  if (mesh.triangles() == 0) mesh = cases::icosphere({0, 0, 0}, 1, 6);
  std::vector<BenchSetting> settings;
  const auto material = std::make_shared<const std::vector<double>>(std::vector<double>{0.8, 0.5, 0.2, 1, 0, 0, 0, 0});
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
    cases::Mesh floor;
    const double w = 256.0 / parts;
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < parts; ++j) {
        const double x = i * w, z = j * w;
        const auto y = [](double at) { return 100 + 0.1 * at; };
        floor.add({x, y(x), z, x, y(x), z + w, x + w, y(x + w), z});
        floor.add({x + w, y(x + w), z, x, y(x), z + w, x + w, y(x + w), z + w});
      }
    add(fmt::format("a floor of {} triangles 256^3 f16x4", floor.triangles()), floor, cases::unit_grid(256), half);
  }
  return settings;
}

}  // namespace luxel::report

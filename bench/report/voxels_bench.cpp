#include <algorithm>

#include <fmt/format.h>
#include <luxel/voxel_inject.h>
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

std::vector<BenchSetting> voxel_inject_settings(const Profile& profile) {
  // A floor and a wall in 128^3, one voxel thick: 32640 occupied voxels in 496 bricks.
  constexpr int n = 128;
  std::vector<double> colour(4ull * n * n * n), normal(colour.size()), bricks;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      for (const bool wall : {false, true}) {
        const std::size_t at = 4 * (wall ? (static_cast<std::size_t>(60) * n + a) * n + b : (static_cast<std::size_t>(a) * n + 12) * n + b);
        for (std::size_t c = 0; c < 4; ++c) colour[at + c] = c < 3 ? 0.5 : 1;
        normal[at + (wall ? 2 : 1)] = 1;
      }
  for (int i = 0; i < 16 * 16 * 16; ++i)
    if (i / 16 % 16 == 1 || i / 256 == 7) bricks.push_back(i);
  std::vector<double> counters(16);
  counters[2] = static_cast<double>(bricks.size());
  std::vector<double> lights;
  for (const float v : voxel_lights({{VoxelLight::Kind::sun, {0.3, 1, 0.4}, {1, 1, 1}, {}, 0},
                                     {VoxelLight::Kind::point, {64, 90, 90}, {1000, 1000, 1000}, {}, 0}},
                                    {0, 0, 0}, 1))
    lights.push_back(v);
  std::vector<double> map;
  for (int j = 0; j < 2 * n; ++j)
    for (int i = 0; i < 2 * n; ++i) map.insert(map.end(), {(i + 0.5) / 2, 12.5, (j + 0.5) / 2, 1, 0.5, 0.5, 0.5, 0});
  const auto shared = [](std::vector<double> v) { return std::make_shared<const std::vector<double>>(std::move(v)); };
  const std::vector<std::pair<std::string, std::shared_ptr<const std::vector<double>>>> data{
      {"colour", shared(std::move(colour))}, {"normal", shared(std::move(normal))}, {"bricks", shared(bricks)},
      {"voxel_counters", shared(counters)},  {"lights", shared(lights)},            {"map", shared(std::move(map))}};
  std::vector<BenchSetting> settings;
  const auto add = [&](const std::string& text, auto change) {
    VoxelInjectParams p;
    p.width = p.height = p.depth = n;
    p.format = Format::f16x4;
    p.bricks = static_cast<int>(bricks.size());
    p.clear = false;
    change(p);
    const Result<Plan> made = plan(p, profile);
    if (!made) return;
    settings.push_back({text, made.value(), {}, {}});
    for (const auto& entry : data)
      for (const Resource& r : made.value().resources)
        if (r.name == entry.first) {
          const std::size_t count = std::min(entry.second->size(), r.bytes / bytes_per_pixel(r.format) * static_cast<std::size_t>(channels(r.format)));
          const auto end = entry.second->begin() + static_cast<std::ptrdiff_t>(count);
          settings.back().data.emplace_back(r.name, shared({entry.second->begin(), end}));
        }
  };
  add("voxel_inject 128^3 f16x4 a sun", [](VoxelInjectParams& p) { p.lights = 1; });
  add("voxel_inject 128^3 f16x4 a sun and a point", [](VoxelInjectParams& p) { p.lights = 2; });
  add("voxel_inject 128^3 f16x4 a sun, the whole volume cleared", [](VoxelInjectParams& p) {
    p.lights = 1;
    p.clear = true;
  });
  add("voxel_inject 128^3 f16x4 a map of 256^2", [](VoxelInjectParams& p) { p.map_width = p.map_height = 256; });
  return settings;
}

}  // namespace luxel::report

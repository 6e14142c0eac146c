#include "tests/cases/voxelize_cases.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/cases/compare.h"
#include "tests/cases/voxelize_support.h"

namespace luxel::cases {
namespace {

const char* name(VoxelizeMode mode) {
  constexpr const char* names[] = {"conservative", "thin", "dilated"};
  return names[static_cast<int>(mode)];
}

constexpr VoxelizeMode exact_modes[] = {VoxelizeMode::conservative, VoxelizeMode::thin};

// A mesh in a grid, its parameters, and what a case does with both.
Result<double> in_grid(Context& context, const Mesh& mesh, const VoxelGrid& grid,
                       const std::function<Result<double>(Context&, VoxelizeParams, const VoxelTriangles&)>& measure) {
  const Result<VoxelTriangles> triangles = voxel_triangles(mesh.view(), grid);
  if (!triangles) return triangles.status();
  return measure(context, voxelize_params(grid, triangles.value()), triangles.value());
}

void add_sets(std::vector<Case>& cases) {
  for (const VoxelizeMode mode : exact_modes)
    cases.push_back(
        {"", fmt::format("2000 random and degenerate triangles, {}", name(mode)),
         "each triangle touches exactly the voxels that integers of 128 bits find (pairs of voxel and triangle that differ)",
         0, [=](Context& context) -> Result<double> {
           const VoxelGrid grid = unit_grid(11);
           return in_grid(context, awkward_mesh(2000, 11, 5), grid,
                          [&](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                            const auto expected = fragments(truth::voxels(triangles, grid, mode, {{}}), grid);
                            p.mode = mode;
                            p.fragments = static_cast<int>(expected.size()) + 1000;
                            const Result<Voxels> found = voxelize(c, p, triangles);
                            if (!found) return found.status();
                            return unmatched(found.value().fragments, expected);
                          });
         }});
}

void add_means(std::vector<Case>& cases) {
  cases.push_back({"", "means of random and degenerate triangles",
                   "colour, coverage, normal and emission follow areas clipped in double (largest error as a share of: m "
                   "triangles 2^-19 / area, and half a step 2^-14)",
                   1, [](Context& context) -> Result<double> {
                     const VoxelGrid grid = unit_grid(11);
                     Mesh mesh = awkward_mesh(600, 11, 6);
                     for (std::uint32_t t = 0; t < 600; ++t) mesh.materials[t] = t % 3;
                     return in_grid(context, mesh, grid,
                                    [&](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                                      p.opacity = p.normal = p.emission = true;
                                      p.emission_max = brightest;
                                      p.materials = 3;
                                      const Result<Voxels> found = voxelize(c, p, triangles, paints());
                                      if (!found) return found.status();
                                      return worst_mean(found.value(), truth::voxels(triangles, grid, p.mode, paints()));
                                    });
                   }});
}

void add_order(std::vector<Case>& cases) {
  cases.push_back({"", "vertices permuted, winding flipped", "the same bits of colour and coverage (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     const VoxelGrid grid = unit_grid(16);
                     const Mesh mesh = awkward_mesh(500, 16, 7);
                     std::vector<double> first;
                     double differing = 0;
                     for (const auto& order : {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
                       Mesh other = mesh;
                       for (std::size_t i = 0; i < mesh.indices.size(); ++i)
                         other.indices[i] = mesh.indices[i / 3 * 3 + static_cast<std::size_t>(order[i % 3])];
                       const auto triangles = voxel_triangles(other.view(), grid);
                       if (!triangles) return triangles.status();
                       const auto found = voxelize(context, voxelize_params(grid, triangles.value()), triangles.value());
                       if (!found) return found.status();
                       if (first.empty()) first = found.value().colour;
                       differing += count_different(first, found.value().colour);
                     }
                     return differing;
                   }});
}

void add_planes(std::vector<Case>& cases) {
  for (const double y : {-0.0, 5.0, 5.5, 16.0})
    for (const double wide : {1.0, 1e4})
      cases.push_back({"", fmt::format("a triangle {} grids wide at y = {}", wide, y),
                       "fills the layers that it touches, both where it lies between two (voxels that differ)", 0,
                       [=](Context& context) -> Result<double> {
                         Mesh mesh;
                         const double w = 16 * 4 * wide;
                         mesh.add({-w, y, -w, w, y, -w, 0, y, 2 * w});
                         return in_grid(context, mesh, unit_grid(16),
                                        [&](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                                          const Result<Voxels> found = voxelize(c, p, triangles);
                                          if (!found) return found.status();
                                          const std::vector<char> set = occupied(found.value());
                                          double differing = 0;
                                          for (std::size_t i = 0; i < set.size(); ++i) {
                                            const double layer = static_cast<double>(i / 16 % 16);
                                            differing += (set[i] != 0) != (layer <= y && y <= layer + 1);
                                          }
                                          return differing;
                                        });
                       }});
}

void add_offset(std::vector<Case>& cases) {
  cases.push_back({"", "offset of 1e6", "a mesh and its grid moved by 1e6 voxels: the same set (voxels that differ)", 0,
                   [](Context& context) -> Result<double> {
                     std::vector<double> first;
                     double differing = 0;
                     for (const double offset : {0.0, 1e6}) {
                       VoxelGrid grid = unit_grid(32);
                       grid.origin = {offset, -offset, 3 * offset};
                       Mesh mesh = icosphere({16, 16, 16}, 13, 3);
                       for (std::size_t i = 0; i < mesh.positions.size(); ++i)
                         // Multiples of 2^-20, which a double holds there.
                         mesh.positions[i] = std::nearbyint(mesh.positions[i] * 0x1p20) * 0x1p-20 + grid.origin[i % 3];
                       const Result<double> done =
                           in_grid(context, mesh, grid,
                                   [&](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                                     const Result<Voxels> found = voxelize(c, p, triangles);
                                     if (!found) return found.status();
                                     if (first.empty()) first = found.value().colour;
                                     return count_different(first, found.value().colour);
                                   });
                       if (!done) return done.status();
                       differing += done.value();
                     }
                     return differing;
                   }});
}

void add_closed(std::vector<Case>& cases) {
  for (const VoxelizeMode mode : exact_modes)
    for (const bool ball : {true, false})
      cases.push_back(
          {"", fmt::format("a closed {}, {}", ball ? "ball" : "cube with sides in grid planes", name(mode)),
           fmt::format("no {}-connected way leads inside (voxels of the inner half that one reaches)",
                       mode == VoxelizeMode::thin ? 6 : 26),
           0, [=](Context& context) -> Result<double> {
             const int n = 40;
             const Mesh mesh = ball ? icosphere({20, 20, 20}, 15.3, 3) : cube_mesh(5, 35);
             return in_grid(context, mesh, unit_grid(n),
                            [&](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                              p.mode = mode;
                              const Result<Voxels> found = voxelize(c, p, triangles);
                              if (!found) return found.status();
                              const std::size_t inside =
                                  enclosed(occupied(found.value()), n, mode == VoxelizeMode::conservative);
                              return std::fmax(0, 20 * 20 * 20 - static_cast<double>(inside));  // a cube of half the side
                            });
           }});
}

void add_crowd(std::vector<Case>& cases, int count, bool slow) {
  cases.push_back({"", fmt::format("{} triangles in one voxel", count), "means do not wrap (largest error)", 0,
                   [=](Context& context) -> Result<double> {
                     Mesh mesh;
                     for (int i = 0; i < count; ++i) mesh.add({1, 1, 1.5, 2, 1, 1.5, 1, 2, 1.5}, i % 4 == 0 ? 1 : 0);
                     return in_grid(context, mesh, unit_grid(3),
                                    [](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                                      p.materials = 2;
                                      const auto found = voxelize(c, p, triangles, {{{1, 0, 0.5, 1}, {}}, {{0, 1, 0.5, 1}, {}}});
                                      if (!found) return found.status();
                                      const double* const v = found.value().colour.data() + 4 * ((1 * 3 + 1) * 3 + 1);
                                      return std::fabs(v[0] - 0.75) + std::fabs(v[1] - 0.25) + std::fabs(v[2] - 0.5) +
                                             found.value().count(VoxelizeCount::saturated);
                                    });
                   },
                   slow});
}

void add_unusable(std::vector<Case>& cases) {
  cases.push_back({"", "NaN, infinity, bad indices, empty mesh", "skipped and counted; the grid stays empty (defects)", 0,
                   [](Context& context) -> Result<double> {
                     Mesh mesh;
                     mesh.add({1, 1, 1, std::nan(""), 1, 1, 1, 2, 1});
                     mesh.add({1, 1, 1, 2, HUGE_VAL, 1, 1, 2, 1});
                     mesh.indices.insert(mesh.indices.end(), {0, 1, 6});
                     mesh.materials.push_back(0);
                     return in_grid(context, mesh, unit_grid(4),
                                    [](Context& c, VoxelizeParams p, const VoxelTriangles& triangles) -> Result<double> {
                                      const Result<Voxels> found = voxelize(c, p, triangles);
                                      if (!found) return found.status();
                                      double defects = (triangles.not_finite != 2) + (triangles.bad_index != 1) +
                                                       (triangles.count != 0);
                                      for (const double v : found.value().colour) defects += v != 0;
                                      for (const double v : found.value().counters) defects += v != 0;
                                      return defects;
                                    });
                   }});
}

}  // namespace

std::vector<Case> voxelize_cases() {
  std::vector<Case> cases;
  add_sets(cases);
  add_means(cases);
  add_order(cases);
  add_planes(cases);
  add_offset(cases);
  add_closed(cases);
  add_crowd(cases, 10000, false);
  add_crowd(cases, 1000000, true);
  add_unusable(cases);
  for (Case& c : cases) c.kernel = "voxelize";
  return cases;
}

}  // namespace luxel::cases

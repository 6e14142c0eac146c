// Light from a shadow map into voxels: which lit voxels the map misses, by its resolution (Villegas and Ramirez, Deferred
// Voxel Shading, 2016: twice that of the voxels, or cracks appear).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <luxel/voxel_inject.h>

#include "bench/report/claims.h"
#include "bench/report/shared_plans.h"
#include "bench/report/updates.h"
#include "bench/scene/rays.h"
#include "bench/scene/voxels.h"
#include "host/check.h"
#include "tests/cases/storage.h"

namespace luxel::report {
namespace {

using glm::dvec3;

// Points that a sun sees, `texels` to a voxel's side, in rows across the scene's bounding ball: two vec4 each.
std::vector<float> shadow_map(const scene::Rays& rays, const VoxelGrid& grid, dvec3 sun, double texels, int& side) {
  const scene::Bounds box = scene::bounds(rays.scene());
  const double radius = glm::length(box.high - box.low) / 2, step = grid.voxel / texels;
  const dvec3 centre = (box.low + box.high) / 2.0, across = glm::normalize(glm::cross(sun, dvec3(0.36, 0.48, 0.8))),
              up = glm::cross(sun, across), origin(grid.origin[0], grid.origin[1], grid.origin[2]);
  side = static_cast<int>(std::ceil(2 * radius / step));
  std::vector<float> map;
  map.reserve(static_cast<std::size_t>(side) * side * 8);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const dvec3 from = centre + (radius + grid.voxel) * sun + ((i + 0.5) * step - radius) * across + ((j + 0.5) * step - radius) * up;
      const auto hit = rays.first(from, -sun);
      const dvec3 at = hit ? (hit->position - origin) / grid.voxel : dvec3(0);
      const double e = hit ? std::max(0.0, glm::dot(hit->normal, sun)) : 0;
      for (const double v : {at.x, at.y, at.z, hit ? 1.0 : 0.0, e, e, e, 0.0}) map.push_back(static_cast<float>(v));
    }
  return map;
}

class Lit {
 public:
  explicit Lit(Session& session) : session_(session), plans_(session.context()) {}

  Status make(const scene::SceneVoxels& voxels) {
    params_ = voxels.params;
    params_.normal = true;
    params_.opacity = params_.emission = false;
    params_.texels = 0;
    LUXEL_CHECK(plans_.put("triangles", voxels.triangles.records, Format::u32));
    LUXEL_CHECK(plans_.put("materials", std::vector<float>(static_cast<std::size_t>(params_.materials) * 8, 1.0f), Format::f32x4));
    const auto step = plans_.step(plan(params_, session_.context().profile()));
    if (!step) return step.status();
    const auto ms = step.value()();
    return ms.status();
  }

  // Voxels that a map (or, without one, lights) gives light to.
  Result<std::vector<char>> by(const VoxelGrid& grid, const std::vector<float>& values, int side) {
    VoxelInjectParams p;
    p.width = params_.width;
    p.height = params_.height;
    p.depth = params_.depth;
    p.bricks = params_.bricks;
    p.voxel = grid.voxel;
    p.map_width = p.map_height = side;
    p.lights = side > 0 ? 0 : 1;
    if (Status s = plans_.put(side > 0 ? "map" : "lights", values, Format::f32x4); !s) return s;
    const auto step = plans_.step(plan(p, session_.context().profile()), {{"voxel_counters", "counters"}});
    if (!step) return step.status();
    if (const auto ms = step.value()(); !ms) return ms.status();
    const auto bytes = plans_.read("radiance");
    if (!bytes) return bytes.status();
    const std::vector<double> v = cases::fetch(std::as_bytes(std::span(bytes.value())), Format::f32x4, false);
    std::vector<char> lit(v.size() / 4);
    for (std::size_t i = 0; i < lit.size(); ++i) lit[i] = v[4 * i] > 0;
    return lit;
  }

 private:
  Session& session_;
  SharedPlans plans_;
  VoxelizeParams params_;
};

Status cracks(Session& session) {
  const int n = session.settings().quick || session.is_cpu() ? 48 : 96;
  const auto read = scene::scene_from("atrium:20000");
  if (!read) return read.status();
  const auto rays = scene::Rays::make(read.value());
  if (!rays) return rays.status();
  const dvec3 sun = read.value().sun.direction;
  for (const VoxelizeMode mode : {VoxelizeMode::conservative, VoxelizeMode::thin}) {
    const VoxelGrid grid = scene::grid_around(read.value(), n);
    auto voxels = scene::scene_voxels(read.value(), grid);
    if (!voxels) return voxels.status();
    voxels.value().params.mode = mode;
    Lit lit(session);
    LUXEL_CHECK(lit.make(voxels.value()));
    // Lit: what shadow rays through the voxels find lit, and some point of a far finer map lies in.
    int side = 0;
    const std::vector<float> finest = shadow_map(rays.value(), grid, sun, 8, side);
    const auto fine = lit.by(grid, finest, side);
    if (!fine) return fine.status();
    const auto by_rays = lit.by(grid, voxel_lights({{VoxelLight::Kind::sun, {sun.x, sun.y, sun.z}, {1, 1, 1}, {}, 0}}, grid.origin, grid.voxel), 0);
    if (!by_rays) return by_rays.status();
    for (const double texels : {0.5, 1.0, 2.0, 4.0}) {
      const std::vector<float> map = shadow_map(rays.value(), grid, sun, texels, side);
      const auto found = lit.by(grid, map, side);
      if (!found) return found.status();
      double all = 0, missed = 0;
      for (std::size_t i = 0; i < fine.value().size(); ++i) {
        const bool counts = fine.value()[i] && by_rays.value()[i];
        all += counts;
        missed += counts && !found.value()[i];
      }
      const double share = missed / std::max(all, 1.0);
      const bool enough = share <= 0.01;
      add(session, {fmt::format("a shadow map of {} texels a voxel leaves {} (share of lit voxels that it misses, {} voxels)", texels,
                                texels < 2 ? "cracks" : "no cracks", mode == VoxelizeMode::thin ? "thin" : "conservative"),
                    "Hong 2015, 2.5.3.3.9 and 4.1: twice the resolution of the voxels", nullptr, once(share),
                    {texels < 2 ? "above 0.01" : "0.01 or less", enough == (texels >= 2)},
                    "voxels that a surface only grazes hold a part of it that is smaller than any texel"});
    }
  }
  return {};
}

}  // namespace

std::vector<Job> shadow_map_jobs(Session& session) {
  return {{"voxel_inject reproduction: cracks of shadow maps", [&session] { return cracks(session); }}};
}

}  // namespace luxel::report

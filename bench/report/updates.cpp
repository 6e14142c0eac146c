#include "bench/report/updates.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <luxel/mip_build.h>
#include <luxel/voxel_inject.h>

#include "bench/report/scenes.h"
#include "bench/report/shared_plans.h"
#include "bench/scene/voxels.h"
#include "host/check.h"
#include "tests/cases/voxelize_meshes.h"

namespace luxel::report {
namespace {

using scene::SceneVoxels;
using Step = SharedPlans::Step;
constexpr Format format = Format::f16x4;

// Times of everything anew and of the update alone.
void row(Session& session, FrontierRow r, const Session::Pair& times) {
  r.options = {{"format", name(format)}};
  r.group = r.variant + r.knobs.text();
  r.build = cell_of(summarise(times.a));
  r.update = cell_of(summarise(times.b));
  session.frontier(r);
}

// The triangles of a scene as voxelize takes them, under names with a prefix.
Status put_triangles(SharedPlans& plans, const SceneVoxels& voxels, const std::string& prefix) {
  LUXEL_CHECK(plans.put(prefix + "triangles", voxels.triangles.records, Format::u32));
  LUXEL_CHECK(plans.put(prefix + "materials", voxels.materials, Format::f32x4));
  if (voxels.params.texels == 0) return {};
  LUXEL_CHECK(plans.put(prefix + "uvs", voxels.triangles.uvs, Format::f32x1));
  LUXEL_CHECK(plans.put(prefix + "texture_table", voxels.textures.table, Format::u32));
  return plans.put(prefix + "texels", voxels.textures.texels, Format::u32);
}

VoxelizeParams shape(const SceneVoxels& voxels) {
  VoxelizeParams p = voxels.params;
  p.format = format;
  p.normal = true;
  p.opacity = p.emission = false;
  return p;
}

std::vector<std::pair<std::string, std::string>> scenes(Session& session) {
  const bool small = session.settings().quick || session.is_cpu();
  std::vector<std::pair<std::string, std::string>> all{{"atrium (generated)", small ? "atrium:20000" : "atrium:100000"}};
  const std::string sponza = data_folder() + "/crytek_sponza/sponza.glb";
  if (!small && std::filesystem::exists(sponza)) all.emplace_back("Sponza", sponza);
  return all;
}

// --- A window that scrolls through a scene, as the finest level of a clipmap.

Result<SceneVoxels> windows_of(const scene::Scene& from, int extent, int whole) {
  VoxelGrid grid = scene::grid_around(from, whole);
  for (std::size_t k = 0; k < 3; ++k) grid.origin[k] += grid.voxel * whole / 2;  // windows count from the middle
  grid.width = grid.height = grid.depth = extent;
  return scene::scene_voxels(from, grid, true, true);
}

Status scroll(Session& session, const std::string& shown, const std::string& what) {
  const auto read = scene::scene_from(what);
  if (!read) return read.status();
  const bool quick = session.settings().quick;
  const int extent = quick && session.is_cpu() ? 32 : quick || session.is_cpu() ? 64 : 128;
  const auto voxels = windows_of(read.value(), extent, 4 * extent);
  if (!voxels) return voxels.status();
  SharedPlans plans(session.context());
  LUXEL_CHECK(put_triangles(plans, voxels.value(), ""));
  VoxelizeParams window = shape(voxels.value());
  window.toroidal = true;
  const std::map<std::string, std::string> other{{"colour", "anew"}, {"normal", "anew normal"}};
  for (const int by : quick ? std::vector{4, extent / 2} : std::vector{1, 4, extent / 2}) {
    VoxelizeParams before = window;
    for (std::size_t k = 0; k < 3; ++k) before.window[k] = -extent / 2;
    VoxelizeParams after = before;
    after.window[0] += by;
    std::vector<Step> slabs;
    for (const VoxelizeParams& p : voxelize_move(after, before.window)) {
      auto step = plans.step(plan(p, session.context().profile()));
      if (!step) return step.status();
      slabs.push_back(step.value());
    }
    const auto first = plans.step(plan(before, session.context().profile())),
               anew = plans.step(plan(after, session.context().profile()), other);
    if (!first) return first.status();
    if (!anew) return anew.status();
    if (const auto ms = first.value()(); !ms) return ms.status();
    const auto times = session.interleave(anew.value(), in_turn(slabs), fmt::format("a window that scrolls by {}", by));
    if (!times) return times.status();
    const auto a = plans.read("anew"), b = plans.read("colour");
    if (!a) return a.status();
    if (!b) return b.status();
    double different = 0;
    for (std::size_t i = 0; i < a.value().size(); i += 8)
      different += !std::equal(&a.value()[i], &a.value()[i] + 8, &b.value()[i]);
    session.promise_bits("voxelize", different == 0, fmt::format("a window that scrolls by {} in {}", by, shown));
    FrontierRow r{"voxelize", "window that scrolls", shown, fmt::format("{0}x{0}x{0}", extent), {}, {{"moved", by}}, "",
                  {"voxels that differ from the window anew"}};
    r.error.method = different;
    row(session, r, times.value());
  }
  return {};
}

// --- Light and objects that move in a scene.

MipBuildParams mips(const VoxelGrid& grid) {
  MipBuildParams p;
  p.variant = MipVariant::isotropic;
  p.width = grid.width;
  p.height = grid.height;
  p.depth = grid.depth;
  p.format = format;
  return p;
}

VoxelInjectParams light_for(const VoxelizeParams& p, const VoxelGrid& grid, int bricks) {
  VoxelInjectParams l;
  l.width = p.width;
  l.height = p.height;
  l.depth = p.depth;
  l.format = format;
  l.bricks = bricks;
  l.lights = 1;
  l.voxel = grid.voxel;
  l.clear = false;
  return l;
}

// Steps of a scene in voxels: everything anew, and light alone.
class Built {
 public:
  Built(Session& session, SharedPlans& plans, const std::string& prefix) : session_(session), plans_(plans), prefix_(prefix) {}

  Status make(const SceneVoxels& voxels, const VoxelLight& sun) {
    LUXEL_CHECK(put_triangles(plans_, voxels, prefix_));
    const VoxelizeParams p = shape(voxels);
    const auto step = plans_.step(plan(p, session_.context().profile()), names(p, ""));
    if (!step) return step.status();
    voxelize = step.value();
    LUXEL_CHECK(plans_.put("lights", voxel_lights({sun}, voxels.grid.origin, voxels.grid.voxel), Format::f32x4));
    VoxelInjectParams l = light_for(p, voxels.grid, p.bricks);
    l.clear = true;
    const auto clear = lit(l, "");
    if (!clear) return clear.status();
    inject = clear.value();
    l.clear = false;
    const auto again = lit(l, "");
    if (!again) return again.status();
    relight = again.value();
    const auto pyramid = plans_.step(plan(mips(voxels.grid), session_.context().profile()), {{"level_0", prefix_ + "radiance"}});
    if (!pyramid) return pyramid.status();
    mip = pyramid.value();
    return {};
  }

  // Light on the bricks of a list.
  Result<Step> lit(const VoxelInjectParams& p, const std::string& list) {
    return plans_.step(plan(p, session_.context().profile()),
                       {{"colour", prefix_ + "colour"},
                        {"normal", prefix_ + "normal"},
                        {"radiance", prefix_ + "radiance"},
                        {"bricks", prefix_ + list + "bricks"},
                        {"voxel_counters", prefix_ + list + "counters"}});
  }

  // Every resource of voxelize with the prefix, what belongs to an object with another.
  std::map<std::string, std::string> names(const VoxelizeParams& p, const std::string& object) {
    std::map<std::string, std::string> all;
    const auto made = plan(p, session_.context().profile());
    if (!made) return all;
    for (const Resource& r : made.value().resources) {
      const bool volume = r.name == "colour" || r.name == "normal";
      all[r.name] = prefix_ + (volume ? "" : object) + r.name;
    }
    return all;
  }

  Step voxelize, inject, relight, mip;

 private:
  Session& session_;
  SharedPlans& plans_;
  std::string prefix_;
};

VoxelLight sun_of(const scene::Scene& s, double turn) {
  VoxelLight sun;
  const glm::dvec3 d = s.sun.irradiance == glm::dvec3(0) ? glm::dvec3(0.3, 1, 0.2) : s.sun.direction;
  sun.place = {d.x + turn, d.y, d.z - turn};
  sun.power = {3, 3, 3};
  return sun;
}

Status moving_light(Session& session, const std::string& shown, const std::string& what, int n) {
  const auto read = scene::scene_from(what);
  if (!read) return read.status();
  const auto voxels = scene::scene_voxels(read.value(), scene::grid_around(read.value(), n), true);
  if (!voxels) return voxels.status();
  SharedPlans plans(session.context());
  Built built(session, plans, "");
  LUXEL_CHECK(built.make(voxels.value(), sun_of(read.value(), 0)));
  const auto times = session.interleave(in_turn({built.voxelize, built.inject, built.mip}), in_turn({built.relight, built.mip}),
                                        fmt::format("a light that moves, {}^3", n));
  if (!times) return times.status();
  if (const auto ms = in_turn({built.voxelize, built.inject})(); !ms) return ms.status();
  const auto a = plans.read("radiance");
  if (const auto ms = built.relight(); !ms) return ms.status();
  const auto b = plans.read("radiance");
  if (!a) return a.status();
  if (!b) return b.status();
  double different = 0;
  for (std::size_t i = 0; i < a.value().size(); i += 8)
    different += !std::equal(&a.value()[i], &a.value()[i] + 8, &b.value()[i]);
  FrontierRow r{"voxel_inject", "light that moves: light and mips", shown, fmt::format("{0}x{0}x{0}", n), {},
                {{"triangles", read.value().indices.size()}}, "", {"voxels whose light differs from everything anew"}};
  r.error.method = different;
  row(session, r, times.value());
  return {};
}

// A ball of 5120 triangles, `share` of the scene's size, at a place in its bounds.
scene::Scene ball_in(const scene::Scene& whole, double share, glm::dvec3 at) {
  const scene::Bounds box = scene::bounds(whole);
  const glm::dvec3 size = box.high - box.low, centre = box.low + at * size;
  const cases::Mesh mesh = cases::icosphere({centre.x, centre.y, centre.z}, share * std::max({size.x, size.y, size.z}) / 2, 4);
  scene::Scene ball;
  ball.materials = {scene::Material{}};
  ball.materials[0].base_color = {0.8, 0.3, 0.1};
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3)
    ball.positions.emplace_back(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    ball.indices.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
  ball.triangle_materials.assign(ball.indices.size(), 0);
  return ball;
}

scene::Scene joined(scene::Scene a, const scene::Scene& b) {
  const auto first = static_cast<glm::uint>(a.positions.size());
  const auto material = static_cast<std::uint32_t>(a.materials.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  if (!a.uvs.empty()) a.uvs.resize(a.positions.size());
  for (const glm::uvec3& t : b.indices) a.indices.push_back(t + first);
  for (const std::uint32_t m : b.triangle_materials) a.triangle_materials.push_back(m + material);
  a.materials.insert(a.materials.end(), b.materials.begin(), b.materials.end());
  return a;
}

Status moving_object(Session& session, const std::string& shown, const std::string& what, int n) {
  const auto read = scene::scene_from(what);
  if (!read) return read.status();
  const scene::Scene& building = read.value();
  const VoxelGrid grid = scene::grid_around(building, n);
  const scene::Scene here = ball_in(building, 0.08, {0.4, 0.3, 0.5}), there = ball_in(building, 0.08, {0.42, 0.31, 0.5});
  const auto still = scene::scene_voxels(building, grid, true), first = scene::scene_voxels(here, grid, true),
             second = scene::scene_voxels(there, grid, true), whole = scene::scene_voxels(joined(building, there), grid, true);
  for (const auto* made : {&still, &first, &second, &whole})
    if (!*made) return made->status();
  const VoxelLight sun = sun_of(building, 0);
  SharedPlans plans(session.context());
  Built anew(session, plans, "anew "), kept(session, plans, "");
  LUXEL_CHECK(anew.make(whole.value(), sun));
  LUXEL_CHECK(kept.make(still.value(), sun));

  // The static volumes, apart; the object where it was, and where it is.
  const VoxelizeParams static_params = shape(still.value());
  auto names = kept.names(static_params, "");
  names["colour"] = "under_colour";
  names["normal"] = "under_normal";
  const auto under = plans.step(plan(static_params, session.context().profile()), names);
  if (!under) return under.status();
  const int bricks = std::max(first.value().params.bricks, second.value().params.bricks);
  const auto object = [&](const SceneVoxels& voxels, const std::string& own, const std::string& left) -> Result<Step> {
    if (Status s = put_triangles(plans, voxels, own); !s) return s;
    VoxelizeParams p = shape(voxels);
    p.over = true;
    p.bricks = bricks;
    auto bound = kept.names(p, own);
    bound["under_colour"] = "under_colour";
    bound["under_normal"] = "under_normal";
    bound["left_bricks"] = left + "bricks";
    bound["left_counters"] = left + "counters";
    return plans.step(plan(p, session.context().profile()), bound);
  };
  LUXEL_CHECK(plans.put("none bricks", std::vector<std::uint32_t>(static_cast<std::size_t>(bricks)), Format::u32));
  LUXEL_CHECK(plans.put("none counters", std::vector<std::uint32_t>(16), Format::u32));
  const auto was = object(first.value(), "was ", "none "), is = object(second.value(), "is ", "was ");
  if (!was) return was.status();
  if (!is) return is.status();
  const VoxelInjectParams lists = light_for(static_params, grid, bricks);
  const auto light_left = kept.lit(lists, "was "), light_own = kept.lit(lists, "is ");
  if (!light_left) return light_left.status();
  if (!light_own) return light_own.status();
  for (const Step& step : {kept.voxelize, kept.inject, under.value(), was.value()})
    if (const auto ms = step(); !ms) return ms.status();
  const auto times = session.interleave(in_turn({anew.voxelize, anew.inject, anew.mip}),
                                        in_turn({is.value(), kept.relight, light_left.value(), light_own.value(), kept.mip}),
                                        fmt::format("an object that moves, {}^3", n));
  if (!times) return times.status();
  const auto a = plans.read("anew radiance"), b = plans.read("radiance");
  if (!a) return a.status();
  if (!b) return b.status();
  // Occupied voxels whose light differs: where both are, the object replaces what a mean would have.
  double different = 0, occupied = 0;
  for (std::size_t i = 0; i + 8 <= std::min(a.value().size(), b.value().size()); i += 8) {
    occupied += (a.value()[i + 6] | a.value()[i + 7]) != 0;
    different += !std::equal(&a.value()[i], &a.value()[i] + 8, &b.value()[i]);
  }
  FrontierRow r{"voxelize", "object that moves: voxels, light and mips", shown, fmt::format("{0}x{0}x{0}", n), {},
                {{"triangles", building.indices.size()}, {"moving", here.indices.size()}}, "",
                {"share of occupied voxels that differ from everything anew"}};
  r.error.method = different / std::max(occupied, 1.0);
  row(session, r, times.value());
  return {};
}

}  // namespace

std::vector<Job> update_jobs(Session& session) {
  std::vector<Job> jobs;
  const int n = session.settings().quick || session.is_cpu() ? 64 : 128;
  for (const auto& [shown, what] : scenes(session)) {
    jobs.push_back({"update: a window that scrolls in " + shown, [&session, shown = shown, what = what] { return scroll(session, shown, what); }});
    jobs.push_back({"update: a light that moves in " + shown,
                    [&session, shown = shown, what = what, n] { return moving_light(session, shown, what, n); }});
    jobs.push_back({"update: an object that moves in " + shown,
                    [&session, shown = shown, what = what, n] { return moving_object(session, shown, what, n); }});
  }
  return jobs;
}

}  // namespace luxel::report

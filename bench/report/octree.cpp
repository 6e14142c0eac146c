#include "bench/report/octree.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <luxel/mip_build.h>

#include "bench/report/claims.h"
#include "bench/report/mips.h"
#include "bench/report/stage.h"
#include "bench/scene/voxel_scene.h"
#include "host/module.h"
#include "tests/cases/compare.h"
#include "tests/cases/run.h"

namespace luxel::built_in {
extern const std::span<const Module* const> sparse_octree, voxel_look;
}

namespace luxel::report {
namespace {

using cases::Run;

// A plan of modules that are no kernels of the library.
class Steps {
 public:
  explicit Steps(const char* name) { plan_.kernel = name; }

  int buffer(const char* name, Format format, std::size_t count, bool written) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    plan_.resources.push_back(r);
    return static_cast<int>(plan_.resources.size()) - 1;
  }
  void pass(std::span<const Module* const> part, std::string_view module, const std::vector<int>& bound,
            std::vector<double> parameters, std::array<std::uint32_t, 3> workgroup, std::array<std::uint32_t, 3> groups) {
    Pass pass;
    for (const Module* m : part)
      if (m->name == module) pass.module = m;
    pass.label = module;
    for (const int b : bound) pass.slots.push_back({Slot::Source::resource, b});
    pass.parameters = std::move(parameters);
    pass.workgroup = workgroup;
    pass.groups = groups;
    plan_.passes.push_back(std::move(pass));
  }
  Plan take() { return std::move(plan_); }

 private:
  Plan plan_;
};

struct Voxels {
  std::string name;
  int depth = 0;                    // levels: 2^depth voxels along each side
  std::vector<float> values;        // [z][y][x][4]
  std::vector<std::uint32_t> list;  // of those that are occupied: x, y, z in 10 bits each
  std::size_t nodes = 1;            // of the octree
};

Result<Voxels> lit_voxels(Session& session, const Place& place, int depth) {
  const auto stage = stage_of(place, true);
  if (!stage) return stage.status();
  scene::VoxelSceneSettings settings;
  settings.resolution = 1 << depth;
  settings.rays = &*stage.value()->rays;
  const std::shared_ptr<Context> context(std::shared_ptr<Context>(), &session.context());  // the session's
  auto built = scene::VoxelScene::build(context, stage.value()->scene, settings);
  if (!built) return built.status();
  if (Status lit = built.value().light(); !lit) return lit;
  auto values = built.value().reflected();
  if (!values) return values.status();
  Voxels v{fmt::format("{} {}^3", place.name, 1 << depth), depth, std::move(values).value(), {}, 1};
  const std::size_t n = std::size_t{1} << depth;
  for (std::size_t i = 0; i < n * n * n; ++i)
    if (v.values[4 * i + 3] > 0)
      v.list.push_back(static_cast<std::uint32_t>(i % n | i / n % n << 10 | i / n / n << 20));
  for (int level = 0; level < depth; ++level) {
    std::vector<std::uint32_t> parents;
    const std::uint32_t kept = (1023u << (depth - level)) & 1023u;
    for (const std::uint32_t voxel : v.list) parents.push_back(voxel & (kept | kept << 10 | kept << 20));
    std::sort(parents.begin(), parents.end());
    v.nodes += 8 * static_cast<std::size_t>(std::unique(parents.begin(), parents.end()) - parents.begin());
  }
  return v;
}

Plan octree_plan(const Voxels& v, const Profile& profile) {
  Steps steps("sparse_octree");
  const std::size_t n = std::size_t{1} << v.depth;
  const int list = steps.buffer("list", Format::u32, v.list.size(), false),
            volume = steps.buffer("volume", Format::f32x4, n * n * n, false),
            children = steps.buffer("children", Format::u32, v.nodes, true),
            values = steps.buffer("values", Format::f32x4, v.nodes, true),
            ends = steps.buffer("ends", Format::u32, 16, true);
  const auto& w = profile.pixels.workgroup;
  const std::uint32_t wide = w[0] * w[1] * w[2], groups = std::max(1u, 8192u / wide);
  const auto add = [&](const char* module, const std::vector<int>& bound, int level) {
    const bool one = !std::strcmp(module, "begin");
    steps.pass(built_in::sparse_octree, module, bound,
               {static_cast<double>(v.list.size()), static_cast<double>(level), static_cast<double>(v.depth),
                static_cast<double>(wide * (one ? 1 : groups))},
               {wide, 1, 1}, {one ? 1 : groups, 1, 1});
  };
  add("begin", {children, ends}, 0);
  for (int level = 0; level < v.depth; ++level) {
    add("mark", {list, children, ends}, level);
    add("allocate", {children, values, ends}, level);
  }
  add("fill", {list, volume, children, values}, v.depth);
  for (int level = v.depth - 1; level >= 0; --level) add("average", {children, values, ends}, level);
  return steps.take();
}

constexpr int look_width = 256, look_height = 64, looks = 64;

Plan look_plan(const Voxels& v, bool octree, const Profile& profile) {
  Steps steps("voxel_look");
  const std::size_t n = std::size_t{1} << v.depth;
  std::vector<int> bound;
  if (octree) {
    bound.push_back(steps.buffer("children", Format::u32, v.nodes, false));
    bound.push_back(steps.buffer("values", Format::f32x4, v.nodes, false));
  } else {
    bound.push_back(steps.buffer("volume", Format::f32x4, n * n * n, false));
  }
  bound.push_back(steps.buffer("dst", Format::f32x4, look_width * look_height, true));
  const auto& w = profile.pixels.workgroup;
  steps.pass(built_in::voxel_look, octree ? "octree" : "dense", bound,
             {look_width, look_height, static_cast<double>(v.depth), 0, looks, 0.31, 0.17, 0.73}, w,
             {(look_width + w[0] - 1) / w[0], (look_height + w[1] - 1) / w[1], 1});
  return steps.take();
}

Result<std::shared_ptr<Run>> ready(Session& session, const Result<Plan>& plan) {
  auto run = Run::make(session.context(), plan);
  if (!run) return run.status();
  return std::make_shared<Run>(std::move(run).value());
}

void reproduced(Session& session, const char* claim, const Sample& ratio, const std::string& reason) {
  add(session, {claim, "Hong 2015, 4.4 (figures 53 to 55: 8.08 ms of 256^3 Sponza's steps removed, GTX 660)", nullptr, ratio, above_one(ratio),
                reason});
}

Status beside_octree(Session& session, const Place& place, int depth) {
  const auto made = lit_voxels(session, place, depth);
  if (!made) return made.status();
  const Voxels& v = made.value();
  const Profile& profile = session.context().profile();
  MipBuildParams mips;
  mips.width = mips.height = mips.depth = 1 << depth;
  mips.format = Format::f32x4;
  const auto dense = ready(session, plan(mips, profile)), octree = ready(session, octree_plan(v, profile));
  if (!dense) return dense.status();
  if (!octree) return octree.status();
  const std::vector<double> values(v.values.begin(), v.values.end());
  if (Status s = dense.value()->write("level_0", values); !s) return s;
  if (Status s = octree.value()->write("volume", values); !s) return s;
  if (Status s = octree.value()->write("list", std::vector<double>(v.list.begin(), v.list.end())); !s) return s;
  const auto built = session.interleave(timed(octree.value()), timed(dense.value()), v.name + ", octree, mips");
  if (!built) return built.status();

  const auto walk = ready(session, look_plan(v, true, profile)), read = ready(session, look_plan(v, false, profile));
  if (!walk) return walk.status();
  if (!read) return read.status();
  for (const char* name : {"children", "values"}) {
    const auto nodes = octree.value()->read(name);
    if (!nodes) return nodes.status();
    if (Status s = walk.value()->write(name, nodes.value()); !s) return s;
  }
  if (Status s = read.value()->write("volume", values); !s) return s;
  const auto looked = session.interleave(timed(walk.value()), timed(read.value()), v.name + ", look-ups: octree, dense");
  if (!looked) return looked.status();
  const auto a = walk.value()->bytes("dst"), b = read.value()->bytes("dst");
  if (!a) return a.status();
  if (!b) return b.status();
  if (a.value() != b.value()) return {Code::internal, "the octree and the dense volume hold different voxels"};
  const auto top = dense.value()->read(mip_level_name(mip_levels(mips))), nodes = octree.value()->read("values");
  if (!top) return top.status();
  if (!nodes) return nodes.status();
  const double apart =
      cases::max_difference(top.value(), {nodes.value().begin(), nodes.value().begin() + 4});
  if (!(apart <= 1e-5)) return {Code::internal, fmt::format("the octree's root and the coarsest mip differ by {}", apart)};

  const double voxels = static_cast<double>(v.values.size() / 4);
  reproduced(session, "dense mips are built faster than a sparse octree of the same voxels (time ratio)",
             summarise(ratios(built.value().a, built.value().b)),
             fmt::format("{}: {} of {:.0f} voxels occupied, {} nodes; octree {:.2f} ms, mips {:.2f} ms; {:.1f} and {:.1f} MiB "
                         "with all levels; without the bricks of 3^3 that hardware filtering would want",
                         v.name, v.list.size(), voxels, v.nodes, summarise(built.value().a).median,
                         summarise(built.value().b).median, static_cast<double>(v.nodes) * 20 / 1048576,
                         voxels * 16 * 8 / 7 / 1048576));
  reproduced(session, "a dense volume is looked up faster than a sparse octree (time ratio, nearest voxel)",
             summarise(ratios(looked.value().a, looked.value().b)),
             fmt::format("{}: {} look-ups along lines, finest level; walks from the root end in empty space where its "
                         "nodes do",
                         v.name, look_width * look_height * looks));
  return {};
}

}  // namespace

std::vector<Job> octree_reproduction(Session& session, std::vector<std::string>& missing) {
  if (session.is_cpu() || session.settings().quick) return {};  // a peer of many programs: PoCL compiles them for 10 s
  std::vector<Job> jobs;
  const auto add = [&](const Place& place, int depth) {
    jobs.push_back({fmt::format("mip_build reproduction: sparse octree, {} {}^3", place.name, 1 << depth),
                    [&session, place, depth] { return beside_octree(session, place, depth); }});
  };
  const std::vector<Place> all = places(missing);
  add(all[1], 7);
  if (all.size() > 2)
    for (const int depth : {7, 8})
      if (depth < 8 || session.context().info().api == Api::opencl) add(all[2], depth);  // Vulkan: 256 MiB a buffer
  return jobs;
}

}  // namespace luxel::report

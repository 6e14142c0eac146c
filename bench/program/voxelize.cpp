#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <luxel/voxelize.h>

#include "bench/io/array.h"
#include "bench/io/pixels.h"
#include "bench/scene/voxels.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string mesh, out, list, device, mode, merging, format;
  std::vector<double> origin;
  double voxel = 0;
  int resolution = 0;
};

using Counters = std::array<std::uint32_t, 16>;
using Fragment = std::array<std::uint32_t, 4>;

std::uint32_t count(const Counters& counters, VoxelizeCount which) { return counters[static_cast<std::size_t>(which)]; }

template <class T>
std::vector<std::uint8_t> bytes_of(const std::vector<T>& values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

Result<VoxelGrid> grid_of(const Arguments& a, const scene::Scene& scene) {
  VoxelGrid grid = scene::grid_around(scene, a.resolution);
  if (a.origin.empty() != (a.voxel == 0))
    return Status(Code::invalid_argument, fmt::format("{} is not given; expected --origin and --voxel together",
                                                      a.origin.empty() ? "--origin" : "--voxel"));
  if (a.origin.empty()) return grid;
  std::copy(a.origin.begin(), a.origin.end(), grid.origin.begin());
  grid.voxel = a.voxel;
  return grid;
}

// Volumes without what no file here takes: normals and emission.
VoxelizeParams parameters(const Arguments& a, const scene::SceneVoxels& voxels) {
  VoxelizeParams p = voxels.params;
  p.mode = a.mode == "thin"      ? VoxelizeMode::thin
           : a.mode == "dilated" ? VoxelizeMode::dilated
                                 : VoxelizeMode::conservative;
  p.merging = a.merging == "moving_average" ? VoxelizeMerging::moving_average
              : a.merging == "last_write"   ? VoxelizeMerging::last_write
                                            : VoxelizeMerging::exact;
  p.format = storage_format(a.format, 4);
  p.emission = false;
  if (p.merging == VoxelizeMerging::moving_average) p.opacity = false;
  return p;
}

Status voxelize(Context& context, const VoxelizeParams& p, const scene::SceneVoxels& voxels, ResourceData& data,
                Times& times) {
  const Result<Plan> plan = luxel::plan(p, context.profile());
  if (!plan) return plan.status();
  data = {{"triangles", bytes_of(voxels.triangles.records)},
          {"materials", io::pack(voxels.materials, 4, Format::f32x4, context.real64())}};
  if (p.texels > 0) {
    data["uvs"] = io::pack(voxels.triangles.uvs, 1, Format::f32x1, context.real64());
    data["texture_table"] = bytes_of(voxels.textures.table);
    data["texels"] = bytes_of(voxels.textures.texels);
  }
  return run_plan(context, plan.value(), data, times);
}

Counters counters_of(const ResourceData& data) {
  Counters counters{};
  std::memcpy(counters.data(), data.find("counters")->second.data(), sizeof counters);
  return counters;
}

// Pairs of voxel and triangle: sorted, and each once also where a triangle was clipped into parts.
io::Array fragments_of(const ResourceData& data, std::size_t found) {
  std::vector<Fragment> list(found);
  if (found > 0) std::memcpy(list.data(), data.find("fragments")->second.data(), found * sizeof(Fragment));
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  io::Array array;
  array.shape = {list.size(), 4};
  array.dtype = io::Dtype::u4;
  array.data = bytes_of(list);
  return array;
}

int run(const Arguments& a) {
  const Result<scene::Scene> read = scene::scene_from(a.mesh);
  if (!read) return complain(read.status(), true);
  const scene::Scene& scene = read.value();
  const Result<VoxelGrid> grid = grid_of(a, scene);
  if (!grid) return complain(grid.status());
  const Result<scene::SceneVoxels> made = scene::scene_voxels(scene, grid.value());
  if (!made) return complain(made.status());
  const scene::SceneVoxels& voxels = made.value();
  VoxelizeParams p = parameters(a, voxels);
  if (Status s = validate(p); !s) return complain(s);

  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  Context& context = *opened.value();
  ResourceData data;
  Times times;
  if (!a.list.empty()) {
    p.fragments = 1;  // counts them
    if (Status s = voxelize(context, p, voxels, data, times); !s) return complain(s.message(), failed);
    const std::uint32_t found = count(counters_of(data), VoxelizeCount::fragments);
    p.fragments = static_cast<int>(std::clamp<std::uint32_t>(found, 1, 0x7fffffff));
    if (Status s = validate(p); !s) return complain(s);
  }
  if (Status s = voxelize(context, p, voxels, data, times); !s) return complain(s.message(), failed);
  const Counters counters = counters_of(data);

  const auto n = static_cast<std::size_t>(a.resolution);
  const std::vector<float> colour = io::unpack(data["colour"], p.format, context.real64(), 4);
  if (Status s = io::write_npy(a.out, io::make_array({n, n, n, 4}, colour)); !s) return complain(s);
  std::string listed;
  if (!a.list.empty()) {
    const io::Array list = fragments_of(data, count(counters, VoxelizeCount::fragments));
    if (Status s = io::write_npy(a.list, list); !s) return complain(s);
    listed = fmt::format(" and {} ({} pairs of voxel and triangle)", a.list, list.shape[0]);
  }
  const VoxelTriangles& t = voxels.triangles;
  fmt::print("voxelize {} {} {}^3 of {} on {}: {} triangles, {} skipped ({} not finite, {} with bad indices), {} outside, "
             "{} occupied voxels, {}; wrote {}{}\n",
             a.mode, name(p.format), n, a.mesh, context.info().id, scene.indices.size(), t.not_finite + t.bad_index,
             t.not_finite, t.bad_index, t.outside, count(counters, VoxelizeCount::occupied), time_text(times), a.out,
             listed);
  for (const std::string& note : scene.notes) fmt::print("  note: {}\n", one_line(note));
  return done;
}

}  // namespace

void add_voxelize(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("voxelize");
  CLI::App* command = app.add_subcommand("voxelize", "turn a mesh into voxels of base colour and coverage");
  auto a = std::make_shared<Arguments>();
  command
      ->add_option("--mesh", a->mesh,
                   fmt::format("a file: OBJ, PLY, glTF, GLB ..., or one of {}", fmt::join(scene::built_in_names(), ", ")))
      ->required()
      ->type_name("FILE|NAME");
  add_number(*command, k, "--resolution", a->resolution)->required();
  command
      ->add_option("--origin", a->origin,
                   "x,y,z: outer corner of voxel (0,0,0) in scene units, with --voxel; default: the bounding cube, centred, "
                   "padded by 1 % of its side at each end")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  add_number(*command, k, "--voxel", a->voxel);
  add_choice(*command, k, "--mode", a->mode);
  add_choice(*command, k, "--merging", a->merging);
  add_choice(*command, k, "--format", a->format);
  command
      ->add_option("-o,--out", a->out,
                   ".npy of shape [z][y][x][4], float32: straight linear base colour and coverage, above 0 where occupied")
      ->required()
      ->type_name("FILE");
  command->add_option("--list", a->list, ".npy of shape [n][4], uint32: x, y, z, triangle; sorted")->type_name("FILE");
  add_device_option(*command, a->device);
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

#include "bench/report/voxels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "bench/scene/voxels.h"
#include "bench/truth/voxel_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"
#include "tests/cases/voxelize_support.h"

namespace luxel::report {

VoxelGrid grid_around(const cases::Mesh& mesh, int n) {
  scene::Bounds box{glm::dvec3(std::numeric_limits<double>::infinity()), glm::dvec3(-std::numeric_limits<double>::infinity())};
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    const glm::dvec3 p(mesh.positions[i], mesh.positions[i + 1], mesh.positions[i + 2]);
    box = {glm::min(box.low, p), glm::max(box.high, p)};
  }
  return scene::grid_around(box, n);
}

cases::Mesh bunny_or_ball(std::string& name) {
  const char* const data = std::getenv("LUXEL_DATA");
  cases::Mesh mesh = data ? cases::read_obj(std::string(data) + "/stanford_bunny/stanford-bunny.obj") : cases::Mesh{};
  name = mesh.triangles() > 0 ? "bunny" : "ball";
  if (mesh.triangles() == 0) mesh = cases::icosphere({0, 0, 0}, 1, 6);
  return mesh;
}

cases::Mesh floor_of(int parts) {
  cases::Mesh mesh;
  const double w = 256.0 / parts;
  const auto y = [](double x) { return 100 + 0.1 * x; };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      const double x = i * w, z = j * w;
      mesh.add({x, y(x), z, x, y(x), z + w, x + w, y(x + w), z});
      mesh.add({x + w, y(x + w), z, x, y(x), z + w, x + w, y(x + w), z + w});
    }
  return mesh;
}

namespace {

using cases::Run;
using Values = std::vector<double>;

struct Setting {
  std::shared_ptr<const VoxelScene> scene;
  VoxelizeMode mode = VoxelizeMode::conservative;
  VoxelizeMerging merging = VoxelizeMerging::exact;
  Format format = Format::f32x4;
  bool attributes = false;      // normals too
  bool touched_only = false;
  bool errors = true;           // compare with the truth
};

const char* name(VoxelizeMode mode) {
  constexpr const char* names[] = {"conservative", "thin", "dilated"};
  return names[static_cast<int>(mode)];
}
const char* name(VoxelizeMerging merging) {
  constexpr const char* names[] = {"exact", "moving_average", "last_write"};
  return names[static_cast<int>(merging)];
}
std::string size_text(const VoxelScene& s) { return fmt::format("{0}x{0}x{0}", s.grid.width); }
std::string label(const Setting& s) {
  return fmt::format("voxelize {} {} {}{}{} on {} {}", name(s.mode), name(s.merging), luxel::name(s.format),
                     s.attributes ? " normals" : "", s.touched_only ? " touched only" : "", s.scene->name,
                     size_text(*s.scene));
}

// Three opaque colours.
const std::vector<truth::Material>& colours() {
  static const std::vector<truth::Material> all{{{0.8, 0.1, 0.25, 1}, {}}, {{0, 1, 0.5, 1}, {}}, {{0.3, 0.7, 0.9, 1}, {}}};
  return all;
}

Result<VoxelizeParams> params_of(const Setting& s, const VoxelTriangles& triangles) {
  VoxelizeParams p = voxelize_params(s.scene->grid, triangles);
  p.mode = s.mode;
  p.merging = s.merging;
  p.format = s.format;
  p.normal = s.attributes;
  p.touched_only = s.touched_only;
  p.materials = static_cast<int>(colours().size());
  return p;
}

Result<std::shared_ptr<Run>> ready(Context& context, const Setting& s) {
  const Result<VoxelTriangles> triangles = voxel_triangles(s.scene->mesh.view(), s.scene->grid);
  if (!triangles) return triangles.status();
  const Result<VoxelizeParams> p = params_of(s, triangles.value());
  if (!p) return p.status();
  Result<Run> made = Run::make(context, plan(p.value(), context.profile()));
  if (!made) return made.status();
  const auto run = std::make_shared<Run>(std::move(made).value());
  Values records, table;
  for (const std::int32_t word : triangles.value().records) records.push_back(static_cast<std::uint32_t>(word));
  for (const truth::Material& m : colours()) {
    table.insert(table.end(), m.colour.begin(), m.colour.end());
    table.insert(table.end(), 4, 0.0);
  }
  if (Status status = run->write("triangles", records); !status) return status;
  if (Status status = run->write("materials", table); !status) return status;
  return run;
}

Result<Values> colour_of(Context& context, const Setting& s) {
  const auto run = ready(context, s);
  if (!run) return run.status();
  if (Status status = run.value()->go(); !status) return status;
  return run.value()->read("colour");
}

// Where both are occupied, the largest difference; and voxels that one has and the other has not.
struct Difference {
  double colour = 0, voxels = 0;
};
Difference compare(const Values& a, const Values& b) {
  if (a.size() != b.size()) return {NAN, NAN};
  Difference d;
  for (std::size_t i = 0; i < a.size(); i += 4) {
    if ((a[i + 3] > 0) != (b[i + 3] > 0)) {
      ++d.voxels;
      continue;
    }
    for (std::size_t k = 0; k < 4; ++k)
      if (const double v = std::fabs(a[i + k] - b[i + k]); !(v <= d.colour)) d.colour = v;
  }
  return d;
}

Values truth_of(const Setting& s) {
  const Result<VoxelTriangles> triangles = voxel_triangles(s.scene->mesh.view(), s.scene->grid);
  // What dilated is to approximate is the conservative set.
  const VoxelizeMode mode = s.mode == VoxelizeMode::dilated ? VoxelizeMode::conservative : s.mode;
  Values values;
  for (const truth::Voxel& v : truth::voxels(triangles.value(), s.scene->grid, mode, colours()))
    values.insert(values.end(), {v.colour[0], v.colour[1], v.colour[2], v.touched ? 1.0 : 0.0});
  return values;
}

// One for colours and one for sets.
Result<std::vector<Oracle>> compute_oracles(Session& session, const Setting& s) {
  Setting wide = s;
  wide.format = Format::f32x4;
  const auto exact = colour_of(session.cpu_double(), s), f32 = colour_of(session.cpu_float(), wide),
             stored = s.format == wide.format ? f32 : colour_of(session.cpu_float(), s);
  if (!exact) return exact.status();
  if (!f32) return f32.status();
  if (!stored) return stored.status();
  const Difference rounding = compare(f32.value(), exact.value()), storage = compare(stored.value(), f32.value()),
                   method = compare(exact.value(), truth_of(s));
  const std::uint64_t bits = hash_values(stored.value());
  return std::vector<Oracle>{{bits, rounding.colour, storage.colour, method.colour},
                             {bits, rounding.voxels, storage.voxels, method.voxels}};
}

Status measure(Session& session, const Setting& s) {
  const auto made = ready(session.context(), s);
  if (!made) return made.status();
  Run& run = *made.value();
  const Result<Sample> ms = session.time(run, label(s));
  if (!ms) return ms.status();

  const std::vector<std::string> metrics{"max |x - t| of colour 0..1", "voxels missing or extra"};
  std::vector<ErrorSplit> errors{{metrics[0]}, {metrics[1]}};
  if (s.errors) {
    const Result<Values> own = run.read("colour");
    if (!own) return own.status();
    auto split = session.errors(
        label(s), metrics, hash_values(own.value()), s.merging == VoxelizeMerging::exact,
        [&] { return compute_oracles(session, s); },
        [&]() -> Result<std::vector<double>> {
          const Result<Values> other = colour_of(session.cpu_float(), s);
          if (!other) return other.status();
          const Difference d = compare(own.value(), other.value());
          return std::vector{d.colour, d.voxels};
        });
    if (!split) return split.status();
    errors = std::move(split).value();
  }
  for (const ErrorSplit& error : errors) {
    FrontierRow row{"voxelize", name(s.mode), s.scene->name, size_text(*s.scene),
                    {{"format", luxel::name(s.format)},
                     {"merging", name(s.merging)},
                     {"normals", s.attributes},
                     {"touched_only", s.touched_only}},
                    {{"triangles", s.scene->mesh.triangles()}},
                    fmt::format("{} {}", name(s.mode), s.attributes), error};
    row.build = cell_of(ms.value());
    row.costs_of(run);
    session.frontier(row);
  }
  return {};
}

// Published by the peer for its CPU path on twelve threads of an i7-8750H; not run here.
Status beside_published(Session& session, const Setting& s, double published_ms) {
  const auto made = ready(session.context(), s);
  if (!made) return made.status();
  const Result<Sample> ms = session.time(*made.value(), "beside cuda_voxelizer, " + label(s));
  if (!ms) return ms.status();
  session.row("peers", {{"peer", "cuda_voxelizer, CPU path, as published (12 threads, i7-8750H)"},
                        {"version", "published"},
                        {"kernel", "voxelize"},
                        {"size", size_text(*s.scene)},
                        {"time_ms", cell_of(summarise({published_ms}))},
                        {"error", nullptr},
                        {"ratio", published_ms / ms.value().median},
                        {"q1", published_ms / ms.value().q3},
                        {"q3", published_ms / ms.value().q1},
                        {"device", session.device()},
                        {"options", {{"format", luxel::name(s.format)}, {"variant", name(s.mode)}}},
                        {"own_ms", cell_of(ms.value())},
                        {"own_error", nullptr},
                        {"goal", s.scene->grid.width == 256 && session.context().info().api == Api::opencl ? Cell(1.0) : Cell()}});
  return {};
}

Status left_out(Session& session, const Setting& more, const Setting& fewer, const char* what, int level) {
  const auto a = ready(session.context(), more), b = ready(session.context(), fewer);
  if (!a) return a.status();
  if (!b) return b.status();
  const auto timed = [](const std::shared_ptr<Run>& run) -> Session::Timed {
    return [run]() -> Result<double> {
      Times times;
      if (Status status = run->go(1, &times); !status) return status;
      return times.total;
    };
  };
  const auto pair = session.interleave(timed(a.value()), timed(b.value()), fmt::format("left out: {}", what));
  if (!pair) return pair.status();
  // Where there is something: elsewhere the volume may keep what it held.
  const Result<Values> x = a.value()->read("colour"), y = b.value()->read("colour");
  if (!x) return x.status();
  if (!y) return y.status();
  double error = 0;
  for (std::size_t i = 0; i < x.value().size(); i += 4)
    for (std::size_t k = 0; k < 4 && x.value()[i + 3] > 0; ++k)
      if (const double v = std::fabs(x.value()[i + k] - y.value()[i + k]); !(v <= error)) error = v;
  const Sample saved = summarise(differences(pair.value().a, pair.value().b));
  session.row("left_out", {{"kernel", "voxelize"},
                           {"scene", fewer.scene->name + " " + size_text(*fewer.scene)},
                           {"what", what},
                           {"level", level},
                           {"saved_ms", saved.median},
                           {"saved_bytes", a.value()->plan().bytes - b.value()->plan().bytes},
                           {"error", error},
                           {"device", session.device()}});
  return {};
}

}  // namespace

std::vector<Job> voxel_jobs(Session& session) {
  const bool quick = session.settings().quick;
  std::string what;
  const auto coloured = [](cases::Mesh of) {
    of.materials.clear();
    for (std::size_t t = 0; t < of.triangles(); ++t) of.materials.push_back(static_cast<std::uint32_t>(t / 1000 % 3));
    return of;
  };
  const cases::Mesh mesh = coloured(bunny_or_ball(what));
  const auto scene_of = [&](int n) {
    return std::make_shared<const VoxelScene>(VoxelScene{what, mesh, grid_around(mesh, n)});
  };
  std::vector<Job> jobs;
  const auto add = [&](const Setting& s) { jobs.push_back({label(s), [&session, s] { return measure(session, s); }}); };
  // Time grows with the triangles, whatever the setting: quick reports take fewer.
  const cases::Mesh ball = coloured(cases::icosphere({0, 0, 0}, 1, 4));
  const auto small = quick ? std::make_shared<const VoxelScene>(VoxelScene{"small ball", ball, grid_around(ball, 32)})
                           : scene_of(64);
  for (const VoxelizeMode mode : {VoxelizeMode::conservative, VoxelizeMode::thin, VoxelizeMode::dilated}) {
    Setting s{small};
    s.mode = mode;
    for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4}) {
      s.format = format;
      if (!quick || mode == VoxelizeMode::conservative || format == Format::f32x4) add(s);
    }
    s.format = Format::f32x4;
    if (mode != VoxelizeMode::conservative) continue;
    for (const VoxelizeMerging merging : {VoxelizeMerging::moving_average, VoxelizeMerging::last_write}) {
      s.merging = merging;
      add(s);
    }
  }
  Setting normals{small};
  normals.attributes = true;
  add(normals);
  // Times alone, where the truth takes long; published times of the peer.
  for (const auto& [n, published] : {std::pair{64, 39.8}, {128, 63.6}, {256, 118.0}, {512, 309.0}}) {
    if ((quick && n > 64) || (session.is_cpu() && n > 128)) continue;
    Setting s{scene_of(n)};
    s.errors = false;
    s.format = n > 128 ? Format::unorm8x4 : Format::f32x4;
    add(s);
    s.touched_only = true;
    add(s);
    s.touched_only = false;
    const double ms = published;
    if (what == "bunny")
      jobs.push_back({"peer of " + label(s), [&session, s, ms] { return beside_published(session, s, ms); }});
  }
  if (!session.is_cpu())
    for (const int parts : quick ? std::vector<int>{1, 64} : std::vector<int>{1, 16, 256}) {
      const cases::Mesh floor = floor_of(parts);
      Setting s{std::make_shared<const VoxelScene>(
          VoxelScene{fmt::format("floor of {} triangles", floor.triangles()), floor, cases::unit_grid(quick ? 128 : 256)})};
      s.errors = false;
      s.format = Format::unorm8x4;
      s.touched_only = true;
      add(s);
    }
  Setting touched{small};
  touched.touched_only = true;
  const Setting whole{small};
  jobs.push_back({"voxelize left out: empty bricks", [&session, whole, touched] {
                    return left_out(session, whole, touched, "writing bricks that nothing touches", 2);
                  }});
  jobs.push_back({"voxelize left out: normals", [&session, whole, normals] {
                    return left_out(session, normals, whole, "normals that nothing reads", 1);
                  }});
  return jobs;
}

}  // namespace luxel::report

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <luxel/probe_build.h>
#include <luxel/probe_trace.h>

#include "bench/io/array.h"
#include "bench/scene/probes.h"
#include "commands.h"
#include "common.h"
#include "tests/cases/octahedral_march_support.h"

namespace luxel::program {
namespace {

using cases::Values;

// A folder of probes:
//   grid.npy       float32 [3][3]: probes along x, y, z; place of probe 0; spacing
//   positions.npy  float32 [p][4]: place, and 1, or 0 for a probe inside geometry
//   distance.npy   float32 [p][y][x]: radial; infinite where there is no surface
//   normal.npy     float32 [p][y][x][3]: facing the probe      (where there is one)
//   radiance.npy   float32 [p][y][x][3]                         (where there is one)
struct Folder {
  ProbeGrid grid;
  int size = 0;
  Values positions, distance, normal, radiance;  // 4, 1, 4 and 4 each; the last two may be empty
  std::size_t probes() const { return positions.size() / 4; }
};

struct Arguments {
  std::string scene, out, device, probes, map, rays, order, variant, light, positions;
  std::vector<int> count;
  std::vector<std::string> radiance, distance, normal;
  double jitter = 0, thickness = 0.5, slope = 8, bias = 0;
  int resolution = 256, samples = 1, seed = 1, probe = 0, only = -1, tries = 8, max_steps = 0, lamp_pieces = 64;
  bool cube = false, planar = false, no_normals = false, keep_dead = false;
};

Status save(const Folder& f, const std::string& folder) {
  const std::size_t p = f.probes(), n = static_cast<std::size_t>(f.size);
  const auto write = [&](const char* name, std::vector<std::size_t> shape, const Values& values, std::size_t stride, std::size_t kept) {
    std::vector<float> v;
    v.reserve(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      if (i % stride < kept) v.push_back(values[i] >= 1e30 ? HUGE_VALF : static_cast<float>(values[i]));
    return io::write_npy(folder + "/" + name, io::make_array(std::move(shape), v));
  };
  Values grid;
  for (const int c : f.grid.count) grid.push_back(c);
  grid.insert(grid.end(), f.grid.origin.begin(), f.grid.origin.end());
  grid.insert(grid.end(), f.grid.spacing.begin(), f.grid.spacing.end());
  if (Status s = write("grid.npy", {3, 3}, grid, 1, 1); !s) return s;
  if (Status s = write("positions.npy", {p, 4}, f.positions, 1, 1); !s) return s;
  if (!f.distance.empty())
    if (Status s = write("distance.npy", {p, n, n}, f.distance, 1, 1); !s) return s;
  if (!f.normal.empty())
    if (Status s = write("normal.npy", {p, n, n, 3}, f.normal, 4, 3); !s) return s;
  if (!f.radiance.empty())
    if (Status s = write("radiance.npy", {p, n, n, 3}, f.radiance, 4, 3); !s) return s;
  return {};
}

Status wrong_shape(const std::string& path, const std::string& expected) {
  return {Code::io, fmt::format("{}: expected shape {}", path, expected)};
}

Result<Folder> load(const std::string& folder) {
  Folder f;
  const auto grid = io::read_npy(folder + "/grid.npy");
  if (!grid) return grid.status();
  if (grid.value().shape != std::vector<std::size_t>{3, 3}) return wrong_shape(folder + "/grid.npy", "[3][3]");
  const std::vector<float> g = io::to_float(grid.value());
  for (std::size_t k = 0; k < 3; ++k) {
    f.grid.count[k] = static_cast<int>(g[k]);
    f.grid.origin[k] = g[3 + k];
    f.grid.spacing[k] = g[6 + k];
  }
  if (Status s = validate(f.grid); !s) return s;
  const std::size_t p = probe_count(f.grid);
  const auto positions = io::read_npy(folder + "/positions.npy");
  if (!positions) return positions.status();
  if (positions.value().shape != std::vector<std::size_t>{p, 4}) return wrong_shape(folder + "/positions.npy", fmt::format("[{}][4]", p));
  const std::vector<float> at = io::to_float(positions.value());
  f.positions.assign(at.begin(), at.end());
  f.grid.placed = true;
  for (const auto& [name, channels, to] : {std::tuple{"distance.npy", 1, &f.distance}, {"normal.npy", 3, &f.normal}, {"radiance.npy", 3, &f.radiance}}) {
    const std::string path = folder + "/" + name;
    if (!std::filesystem::exists(path)) continue;
    const auto read = io::read_npy(path);
    if (!read) return read.status();
    const auto& shape = read.value().shape;
    const bool fits = shape.size() == (channels == 1 ? 3u : 4u) && shape[0] == p && shape[1] == shape[2] && shape[1] <= 2048 &&
                      (channels == 1 || shape[3] == 3) && (f.size == 0 || shape[1] == static_cast<std::size_t>(f.size));
    if (!fits) return wrong_shape(path, fmt::format("[{}][n][n]{}, n alike in all maps", p, channels == 3 ? "[3]" : ""));
    f.size = static_cast<int>(shape[1]);
    const std::vector<float> v = io::to_float(read.value());
    for (std::size_t i = 0; i < v.size(); ++i) {
      to->push_back(channels == 1 ? std::min<double>(v[i], 1e30) : v[i]);
      if (channels == 3 && i % 3 == 2) to->push_back(0);
    }
  }
  return f;
}

// The largest power of two up to 16 that divides the size.
int ratio_of(int size) {
  int ratio = 16;
  while (size % ratio != 0) ratio /= 2;
  return ratio;
}

Result<Folder> from_scene(const Arguments& a, std::string& told) {
  auto read = scene::scene_from(a.scene);
  if (!read) return read.status();
  auto rays = scene::Rays::make(read.value());
  if (!rays) return rays.status();
  std::array<int, 3> count{a.count[0], a.count[1], a.count[2]};
  ProbeGrid asked;
  asked.count = count;
  if (Status s = validate(asked); !s) return s;
  ProbeMaps maps;
  maps.size = a.resolution;
  maps.ratio = 1;
  if (Status s = validate(maps, probe_count(asked)); !s) return s;
  scene::Probes probes = scene::place_probes(read.value(), count, a.jitter, static_cast<std::uint32_t>(a.seed));
  if (!a.keep_dead) scene::find_dead_probes(probes, rays.value());
  scene::ProbeLight light;
  light.emitted = light.sky = a.light == "all";
  light.sky_samples = a.light == "all" && !read.value().sky.dark() ? 16 : 0;
  light.lamp_pieces = a.lamp_pieces;
  scene::ProbeHits hits = scene::cast_probes(probes, rays.value(), a.resolution, a.light == "none" ? nullptr : &light, a.samples);
  Folder f;
  f.grid = probes.grid;
  f.size = a.resolution;
  f.positions = probes.positions();
  f.distance = std::move(hits.distance);
  f.normal = std::move(hits.normal);
  f.radiance = std::move(hits.radiance);
  const auto dead = std::count(probes.alive.begin(), probes.alive.end(), 0);
  told = fmt::format("{} probes in {}, {} inside geometry", f.probes(), a.scene, dead);
  return f;
}

// Images of all probes, one behind the other, `channels` a pixel.
Result<Values> images_of(const std::vector<std::string>& paths, int channels, ProbeBuildParams& p) {
  Values all;
  for (const std::string& path : paths) {
    const auto read = io::read_image(path);
    if (!read) return read.status();
    const io::Image& image = read.value();
    if (p.width == 0) p.width = image.width, p.height = image.height;
    if (image.width != p.width || image.height != p.height)
      return Status(Code::io, fmt::format("{}: is {}x{}; expected {}x{} like the first", path, image.width, image.height, p.width, p.height));
    for (std::size_t i = 0; i < static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height); ++i)
      for (int c = 0; c < channels; ++c)
        all.push_back(c == 3 ? 0 : image.pixels[i * static_cast<std::size_t>(image.channels) + static_cast<std::size_t>(image.channels < 3 ? 0 : c)]);
  }
  return all;
}

Result<Folder> from_images(const Arguments& a, std::string& told) {
  const std::size_t each = a.cube ? 6 : 1, files = std::max({a.radiance.size(), a.distance.size(), a.normal.size()});
  for (const auto& [name, list] : {std::pair{"--radiance", &a.radiance}, {"--distance", &a.distance}, {"--normal", &a.normal}})
    if (!list->empty() && (list->size() != files || files % each != 0))
      return Status(Code::invalid_argument, fmt::format("{} names {} files; expected {} a probe, the same number for every map", name, list->size(), each));
  ProbeBuildParams p;
  p.probes = static_cast<int>(files / each);
  p.source = a.cube ? ProbeSource::cube : ProbeSource::equirect;
  p.samples = a.samples;
  p.planar = a.planar;
  p.maps.size = a.resolution;
  p.maps.ratio = 1;
  p.maps.radiance = ProbeRadiance::f32x4;
  p.maps.distance = ProbeDistance::f32;
  p.maps.normal = a.normal.empty() ? ProbeNormal::none : ProbeNormal::snorm16;
  p.radiance = !a.radiance.empty();
  p.distance = !a.distance.empty();
  const auto radiance = images_of(a.radiance, 4, p), distance = images_of(a.distance, 1, p), normal = images_of(a.normal, 4, p);
  if (!radiance) return radiance.status();
  if (!distance) return distance.status();
  if (!normal) return normal.status();
  Folder f;
  f.size = a.resolution;
  f.grid.count = {p.probes, 1, 1};
  const auto places = io::read_npy(a.positions);
  if (!places) return places.status();
  if (places.value().shape != std::vector<std::size_t>{static_cast<std::size_t>(p.probes), 3})
    return wrong_shape(a.positions, fmt::format("[{}][3]", p.probes));
  const std::vector<float> at = io::to_float(places.value());
  for (std::size_t i = 0; i < at.size(); ++i) {
    f.positions.push_back(at[i]);
    if (i % 3 == 2) f.positions.push_back(1);
  }
  const auto opened = open_device(a.device);
  if (!opened) return opened.status();
  auto run = cases::HeldPlan::make(*opened.value(), plan(p, opened.value()->profile()));
  if (!run) return run.status();
  for (const auto& [name, values] : {std::pair{"radiance_source", &radiance.value()}, {"distance_source", &distance.value()}, {"normal_source", &normal.value()}})
    if (!values->empty())
      if (Status s = run.value().write(name, *values); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  for (const auto& [name, to] : {std::pair{"radiance", &f.radiance}, {"distances", &f.distance}}) {
    if (!run.value().memory(name)) continue;
    auto read = run.value().read(name);
    if (!read) return read.status();
    *to = std::move(read.value());
  }
  if (run.value().memory("normals")) {
    const auto words = run.value().read("normals");
    if (!words) return words.status();
    for (const double w : words.value()) {
      const auto d = truth::direction_of_code(static_cast<std::uint32_t>(w), 16);
      f.normal.insert(f.normal.end(), {d[0], d[1], d[2], 0});
    }
  }
  told = fmt::format("{} probes of {} {}x{} on {}", p.probes, a.cube ? "cubes" : "images", p.width, p.height, opened.value()->info().id);
  return f;
}

int build(const Arguments& a) {
  if (a.scene.empty() == (a.radiance.empty() && a.distance.empty() && a.normal.empty()))
    return complain("probes build: expected either --scene, or --radiance, --distance or --normal files", misused);
  if (a.scene.empty() && a.positions.empty()) return complain("probes build: --positions is needed with images", misused);
  std::string told;
  const auto made = a.scene.empty() ? from_images(a, told) : from_scene(a, told);
  if (!made) return complain(made.status(), true);
  if (Status s = save(made.value(), a.out); !s) return complain(s);
  fmt::print("probes build: {}, {}^2 texels each; wrote {}\n", told, made.value().size, a.out);
  return done;
}

int show(const Arguments& a) {
  if (Status s = io::check_image_path(a.out); !s) return complain(s);
  const auto loaded = load(a.probes);
  if (!loaded) return complain(loaded.status(), true);
  const Folder& f = loaded.value();
  const Values& map = a.map == "radiance" ? f.radiance : a.map == "distance" ? f.distance : f.normal;
  if (map.empty()) return complain(fmt::format("{} has no {}.npy", a.probes, a.map), misused);
  if (a.probe >= static_cast<int>(f.probes()))
    return complain(fmt::format("--probe is {}; expected 0..{}", a.probe, f.probes() - 1), misused);
  const int channels = a.map == "distance" ? 1 : 3, stride = channels == 1 ? 1 : 4;
  const std::size_t texels = static_cast<std::size_t>(f.size) * static_cast<std::size_t>(f.size);
  const double* from = &map[static_cast<std::size_t>(a.probe) * texels * static_cast<std::size_t>(stride)];
  io::Image image{f.size, f.size, channels, {}};
  for (std::size_t i = 0; i < texels; ++i)
    for (int c = 0; c < channels; ++c) image.pixels.push_back(static_cast<float>(from[i * static_cast<std::size_t>(stride) + static_cast<std::size_t>(c)]));
  if (std::filesystem::path(a.out).extension() == ".png") {
    // Radiance: white at the 99th percentile, sRGB's curve about; distance: white at the farthest surface; normals: n / 2 + 1/2.
    std::vector<float> sorted;
    for (const float v : image.pixels)
      if (v < 1e30f) sorted.push_back(v);
    std::sort(sorted.begin(), sorted.end());
    const double white = sorted.empty() ? 1 : a.map == "radiance" ? sorted[sorted.size() * 99 / 100] : sorted.back();
    for (float& v : image.pixels)
      v = a.map == "normal" ? v / 2 + 0.5f : static_cast<float>(std::pow(std::clamp(v / std::max(white, 1e-30), 0.0, 1.0), a.map == "radiance" ? 1 / 2.2 : 1.0));
  }
  if (Status s = io::write_image(a.out, image); !s) return complain(s);
  const bool dead = f.positions[4 * static_cast<std::size_t>(a.probe) + 3] == 0;
  fmt::print("probes show: {} of probe {} of {}{}, {}x{}; wrote {}\n", a.map, a.probe, a.probes,
             dead ? " (inside geometry)" : "", f.size, f.size, a.out);
  return done;
}

int trace(const Arguments& a) {
  const auto loaded = load(a.probes);
  if (!loaded) return complain(loaded.status(), true);
  const Folder& f = loaded.value();
  if (f.distance.empty()) return complain(fmt::format("{} has no distance.npy", a.probes), misused);
  const auto read = io::read_npy(a.rays);
  if (!read) return complain(read.status(), true);
  if (read.value().shape.size() != 2 || read.value().shape[1] != 8 || read.value().shape[0] == 0)
    return complain(wrong_shape(a.rays, "[n][8]: origin, 0, direction, length (infinite allowed)"), true);
  const std::vector<float> given = io::to_float(read.value());
  const Values rays(given.begin(), given.end());
  const std::size_t n = rays.size() / 8;

  ProbeTraceParams p;
  p.probe = a.only;
  p.tries = a.tries;
  p.order = a.order == "farthest" ? ProbeOrder::farthest : ProbeOrder::plus3;
  p.max_steps = a.max_steps;
  p.thickness = a.thickness;
  p.slope = a.slope;
  p.bias = a.bias;
  p.count = true;
  ProbeMaps maps;
  maps.size = f.size;
  maps.ratio = ratio_of(f.size);
  maps.distance = ProbeDistance::f32;
  maps.normal = f.normal.empty() || a.no_normals ? ProbeNormal::none : ProbeNormal::snorm16;
  p.maps = maps;
  if (a.variant == "flat") p.maps.ratio = 1;
  p.grid = f.grid;
  p.rays = static_cast<int>(n);
  if (Status s = validate(p); !s) return complain(s);
  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  auto scene = cases::ProbeScene::make(*opened.value(), maps, f.grid, {f.distance, f.normal, {}}, f.positions);
  if (!scene) return complain(scene.status().message(), failed);
  Times times;
  const auto traced = scene.value().trace(p, rays, 1, &times);
  if (!traced) return complain(traced.status().message(), failed);
  std::vector<float> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double* h = &traced.value().hits[4 * i];
    const double l = std::sqrt(rays[8 * i + 4] * rays[8 * i + 4] + rays[8 * i + 5] * rays[8 * i + 5] + rays[8 * i + 6] * rays[8 * i + 6]);
    out.push_back(static_cast<float>(h[1]));
    out.push_back(h[0] >= 1e30 ? HUGE_VALF : static_cast<float>(h[0]));
    for (std::size_t k = 0; k < 3; ++k) out.push_back(static_cast<float>(rays[8 * i + k] + h[0] * rays[8 * i + 4 + k] / l));
    const double texel = traced.value().texels[i];
    out.push_back(texel == 4294967295.0 ? -1.0f : static_cast<float>(std::floor(texel / (static_cast<double>(f.size) * f.size))));
    out.push_back(static_cast<float>(h[2]));
    out.push_back(static_cast<float>(h[3]));
  }
  if (Status s = io::write_npy(a.out, io::make_array({n, 8}, out)); !s) return complain(s);
  const Values& c = traced.value().counters;
  fmt::print("probes trace {} through {} probes {}^2 on {}: {} rays, {} hit, {} missed, {} assumed, {} unknown, {} capped, {} degenerate, "
             "{:.2f} probes and {:.1f} looks a ray, {}; wrote {}\n",
             a.variant, f.probes(), f.size, opened.value()->info().id, n, c[1], c[2], c[6], c[3], c[4], c[5],
             c[8] / static_cast<double>(n), c[9] / static_cast<double>(n), time_text(times), a.out);
  return done;
}

}  // namespace

void add_probes(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("octahedral_march");
  CLI::App* command = app.add_subcommand("probes", "build probes of a scene or from images, show their maps, trace rays through them");
  command->require_subcommand(1);
  auto a = std::make_shared<Arguments>();

  CLI::App* b = command->add_subcommand("build", "octahedral maps of radiance, distance and normal, into a folder of .npy files");
  b->add_option("--scene", a->scene, fmt::format("a file: OBJ, PLY, glTF, GLB ..., or one of {}; probes are cast into it", fmt::join(scene::built_in_names(), ", ")))
      ->type_name("FILE|NAME");
  a->count = {2, 2, 2};
  b->add_option("--grid", a->count, "x,y,z: probes along each axis of the scene's box; default 2,2,2")->delimiter(',')->expected(3)->type_name("X,Y,Z");
  add_number(*b, k, "--jitter", a->jitter);
  add_number(*b, k, "--seed", a->seed);
  add_number(*b, k, "--resolution", a->resolution);
  add_number(*b, k, "--samples", a->samples);
  add_choice(*b, k, "--light", a->light);
  add_switch(*b, k, "--keep-dead", a->keep_dead);
  b->add_option("--radiance", a->radiance, "images instead of a scene: latitude-longitude, one a probe; cubes: six, +x -x +y -y +z -z")->type_name("FILE...");
  b->add_option("--distance", a->distance, "their radial distances")->type_name("FILE...");
  b->add_option("--normal", a->normal, "their normals")->type_name("FILE...");
  b->add_option("--positions", a->positions, "images: .npy of shape [probes][3]")->type_name("FILE");
  add_switch(*b, k, "--cube", a->cube);
  add_switch(*b, k, "--planar", a->planar);
  b->add_option("-o,--out", a->out, "folder that is written: grid, positions, distance, normal, radiance .npy")->required()->type_name("FOLDER");
  add_device_option(*b, a->device);
  b->callback([a, &exit_status] { exit_status = build(*a); });

  CLI::App* s = command->add_subcommand("show", "a map of a probe as a picture");
  s->add_option("--probes", a->probes, "folder that build wrote")->required()->type_name("FOLDER");
  add_choice(*s, k, "--map", a->map);
  add_number(*s, k, "--probe", a->probe);
  add_image_out(*s, a->out, "the map: values as they are, in a PNG scaled to be seen");
  s->callback([a, &exit_status] { exit_status = show(*a); });

  CLI::App* t = command->add_subcommand("trace", "rays through the probes of a folder");
  t->add_option("--probes", a->probes, "folder that build wrote")->required()->type_name("FOLDER");
  t->add_option("--rays", a->rays, ".npy of shape [n][8]: origin, where the ray begins along it (0), direction, length (infinite allowed)")->required()->type_name("FILE");
  add_variant(*t, k, a->variant);
  add_choice(*t, k, "--order", a->order);
  add_number(*t, k, "--only", a->only);
  add_number(*t, k, "--tries", a->tries);
  add_number(*t, k, "--thickness", a->thickness);
  add_number(*t, k, "--slope", a->slope);
  add_number(*t, k, "--bias", a->bias);
  add_number(*t, k, "--max-steps", a->max_steps);
  add_switch(*t, k, "--no-normals", a->no_normals);
  t->add_option("-o,--out", a->out,
                ".npy of shape [n][8], float32: outcome (1 hit, 2 miss, 3 unknown, 4 capped, 5 degenerate, 6 assumed), length (infinite: no end), "
                "x, y, z there, probe (-1: none), probes asked, looks")
      ->required()
      ->type_name("FILE");
  add_device_option(*t, a->device);
  t->callback([a, &exit_status] { exit_status = trace(*a); });
}

}  // namespace luxel::program

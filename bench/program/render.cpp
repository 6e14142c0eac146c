#include "render.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "commands.h"
#include "common.h"
#include "scene_options.h"

namespace luxel::program {
namespace {

using glm::dvec3;

// A method that is added here is an option of the command.
constexpr RenderMethod methods[] = {
    {"cone", "voxel cone tracing on a device", render_cone},
    {"ssr", "the same, with reflections found on the screen before the cones'", render_ssr},
    {"probe", "octahedral probes on a grid, filtered visibility", render_probe},
    {"lpv", "light propagation volumes on a device", render_lpv},
    {"truth", "path tracing on the CPU, two independent halves", render_truth},
};

// Pictures that can be shown alone.
constexpr const char* shown[] = {"all", "direct", "diffuse_indirect", "specular_indirect", "ambient_occlusion"};

struct Arguments {
  SceneOptions view;
  std::string method = methods[0].name, device, out, buffers, show = shown[0];
  double exposure = 0, ao_falloff = -1, ao_distance = 0;
  double thickness = 0;
  int ssr_rays = 4, reuse = 1;
  bool half = false;
  int samples = 64, bounces = 0, resolution = 128, cone_count = 6;
  double aperture = 0, step = 0.5, offset = 1;
  bool anisotropic = false, thin = false, both_sides = false;
  std::string probes = "8";
  int probe_size = 32, irradiance_size = 8, distance_size = 16, probe_bounces = 3;
  bool unfiltered = false;
  std::string lobes = "linear", blockers = "surfaces";
  int cells = 32, lpv_steps = 0, cascades = 1, bands = 2;
  double damping = 0, lpv_filter = 0;
};

constexpr const char* lobe_names[] = {"linear", "clamp", "shrink", "rescale"};
constexpr const char* blocker_names[] = {"none", "surfaces", "empty", "maps"};

// "8": along the longest side, cells about cubes; "8,4,6": along each axis.
Status set_probes(const std::string& text, const scene::Scene& scene, std::array<int, 3>& count) {
  auto v = numbers(text, 3);
  if (v.empty()) v = numbers(text, 1);
  for (const double n : v)
    if (!(n >= 1 && n <= 64 && n == std::floor(n))) v.clear();
  if (v.empty()) return wrong("probes", text, "N or nx,ny,nz, each a whole number 1..64, 65535 probes at most");
  if (v.size() == 1) {
    count = scene::probe_cubes(scene, static_cast<int>(v[0]));
  } else {
    for (std::size_t k = 0; k < 3; ++k) count[k] = static_cast<int>(v[k]);
  }
  if (count[0] * count[1] * count[2] > 65535) return wrong("probes", text, "65535 probes at most");
  return {};
}

template <class Value>
io::Image image_of(const std::vector<Value>& values, const scene::GBuffer& g) {
  constexpr int channels = sizeof(Value) / sizeof(double);
  io::Image image{g.width, g.height, channels, {}};
  image.pixels.reserve(values.size() * channels);
  for (const Value& v : values)
    for (int c = 0; c < channels; ++c)
      image.pixels.push_back(static_cast<float>(reinterpret_cast<const double*>(&v)[c]));
  return image;
}

// PNG gets exposure, clamp and the sRGB curve; visibility gets none, as it is no light. Other formats get the numbers.
io::Image picture_file(const std::string& path, const scene::Parts& parts, const Arguments& a,
                       const scene::GBuffer& g) {
  if (a.show == "ambient_occlusion") return image_of(parts.ambient_occlusion, g);
  std::vector<dvec3> light = a.show == "direct"              ? parts.direct
                             : a.show == "diffuse_indirect"  ? parts.diffuse_indirect
                             : a.show == "specular_indirect" ? parts.specular_indirect
                                                             : picture(parts);
  std::string end = path.substr(path.size() - std::min<std::size_t>(path.size(), 4));
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (end == ".png")
    for (dvec3& v : light) v = scene::display(v, a.exposure);
  return image_of(light, g);
}

Status write_buffers(const std::string& folder, const scene::GBuffer& g, const scene::Parts& parts,
                     RenderOutput& output) {
  auto& all = output.buffers;
  const auto put = [&](const char* name, const std::vector<float>& values, int channels) {
    all[name] = {g.width, g.height, channels, values};
  };
  put("position", g.position, 3);
  put("normal", g.normal, 3);
  put("depth", g.depth, 1);
  put("albedo", g.albedo, 3);
  put("specular", g.specular, 3);
  put("roughness", g.roughness, 1);
  all["emission"] = image_of(parts.emission, g);
  all["direct"] = image_of(parts.direct, g);
  all["diffuse_indirect"] = image_of(parts.diffuse_indirect, g);
  all["specular_indirect"] = image_of(parts.specular_indirect, g);
  all["ambient_occlusion"] = image_of(parts.ambient_occlusion, g);
  for (const auto& [name, image] : all)
    if (Status s = io::write_image(fmt::format("{}/{}.exr", folder, name), image); !s) return s;
  return {};
}

int run(const Arguments& a) {
  if (Status s = io::check_image_path(a.out); !s) return complain(s);
  const auto method =
      std::find_if(std::begin(methods), std::end(methods), [&](const RenderMethod& m) { return m.name == a.method; });
  const auto chosen = parse(a.view);
  if (!chosen) return complain(chosen.status());
  const SceneChoice& choice = chosen.value();

  Clock clock;
  const auto found = read(a.view, choice);
  if (!found) return complain(found.status(), true);
  const scene::Scene& scene = found.value();
  std::vector<StepTime> times{{"build", "read", clock.ms()}};
  const auto rays = scene::Rays::make(scene);
  if (!rays) return complain(rays.status());
  times.push_back({"build", "tree", clock.ms()});
  const scene::GBuffer g = scene::gbuffer(rays.value(), scene.camera, choice.width, choice.height);
  times.push_back({"shade", "gbuffer", clock.ms()});

  const scene::Bounds box = bounds(scene);
  truth::PathSettings settings;
  settings.samples = a.samples;
  settings.bounces = a.bounces;
  settings.ao_falloff = a.ao_falloff >= 0 ? a.ao_falloff : 10 / std::max(glm::length(box.high - box.low), 1e-9);
  if (a.ao_distance > 0) settings.ao_distance = a.ao_distance;
  scene::VoxelSceneSettings voxels;
  voxels.resolution = a.resolution;
  voxels.variant = a.anisotropic ? ConeVariant::anisotropic : ConeVariant::isotropic;
  voxels.two_sided = a.both_sides;
  voxels.mode = a.thin ? VoxelizeMode::thin : VoxelizeMode::conservative;
  ConeTraceParams cones;
  const auto set = cone_set(a.cone_count, a.aperture * std::numbers::pi / 180);
  if (!set) return complain(set.status());
  cones.cones = set.value();
  cones.step_scale = a.step;
  cones.normal_offset = a.offset;
  HizSsrParams screen;
  screen.variant = a.ssr_rays > 0 ? SsrVariant::stochastic : SsrVariant::hiz;
  screen.rays_per_pixel = std::max(a.ssr_rays, 1);
  screen.half_resolution = a.half && a.ssr_rays > 0;
  screen.reuse = a.reuse;
  // Most surfaces stand in front of others: what is thicker hides too much, what is thinner lets rays through.
  screen.thickness = a.thickness > 0 ? a.thickness : glm::length(box.high - box.low) / 64;
  scene::ProbeSceneSettings probes;
  if (Status s = set_probes(a.probes, scene, probes.count); !s) return complain(s);
  probes.size = a.probe_size;
  probes.bounces = a.probe_bounces;
  probes.filter.irradiance_size = a.irradiance_size;
  probes.filter.moments_size = a.unfiltered ? 0 : a.distance_size;
  scene::LpvSceneSettings lpv;
  lpv.resolution = a.cells;
  lpv.cascades = a.cascades;
  lpv.bands = a.bands;
  lpv.iterations = a.lpv_steps;
  lpv.lobes = static_cast<LpvLobes>(std::find(std::begin(lobe_names), std::end(lobe_names), a.lobes) - std::begin(lobe_names));
  lpv.blockers = static_cast<scene::LpvBlockers>(std::find(std::begin(blocker_names), std::end(blocker_names), a.blockers) -
                                                 std::begin(blocker_names));
  lpv.filter = a.lpv_filter;
  LpvSampleParams by_lpv;
  by_lpv.damping = a.damping;
  auto rendered = method->run({scene, rays.value(), g, a.device, settings, voxels, cones, screen, probes, probes.bounce, lpv, by_lpv});
  if (!rendered) return complain(rendered.status());
  RenderOutput& output = rendered.value();
  clock.ms();
  const scene::Parts parts = compose(g, output.lighting, scene.camera.eye, scene.sun);
  output.times.push_back({"shade", "compose", clock.ms()});
  times.insert(times.end(), output.times.begin(), output.times.end());

  io::WriteReport changes;
  if (Status s = io::write_image(a.out, picture_file(a.out, parts, a, g), &changes); !s) return complain(s);
  if (!a.buffers.empty())
    if (Status s = write_buffers(a.buffers, g, parts, output); !s) return complain(s);

  fmt::print("render {} {} ({} triangles) {}x{}, {}; wrote {}{}\n", a.method, scene.name, scene.indices.size(), choice.width,
             choice.height, a.show, a.out, changes_text(changes));
  for (const char* phase : {"build", "update", "shade"}) {
    std::string line;
    for (const StepTime& t : times)
      if (t.phase == phase) line += fmt::format("{}{} {:.1f} ms", line.empty() ? "" : ", ", t.step, t.ms);
    if (!line.empty()) fmt::print("  {}: {}\n", phase, line);
  }
  for (const std::string& note : output.notes) fmt::print("  {}\n", note);
  for (const std::string& note : scene.notes) fmt::print("  note: {}\n", one_line(note));
  return done;
}

}  // namespace

void add_render(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "render", "picture of a scene: direct light, diffuse and specular indirect, ambient occlusion");
  auto a = std::make_shared<Arguments>();
  std::vector<std::string> names, parts(std::begin(shown), std::end(shown));
  std::string meanings;
  for (const RenderMethod& m : methods) {
    names.emplace_back(m.name);
    meanings += fmt::format("{}{}: {}", meanings.empty() ? "" : "; ", m.name, m.meaning);
  }
  add_scene_options(*command, a->view, "640x360");
  command
      ->add_option("-o,--out", a->out,
                   "picture: .png (with exposure and the sRGB curve), .exr, .hdr or .npy (linear radiance)")
      ->required()
      ->type_name("FILE");
  command->add_option("--method", a->method, fmt::format("{}; default {}", meanings, a->method))
      ->type_name("NAME")
      ->check(one_of(names));
  command->add_option("--show", a->show, fmt::format("{}: what the picture holds; default all", fmt::join(parts, "|")))
      ->type_name("NAME")
      ->check(one_of(parts));
  command->add_option("--buffers", a->buffers, "folder for the G-buffer, each part, and what the method knows, as EXR")
      ->type_name("DIR");
  command->add_option("--exposure", a->exposure, "stops, -60..60; of PNG alone; default 0")
      ->type_name("EV")
      ->check(within(-60, 60, false));
  command
      ->add_option("--ao-falloff", a->ao_falloff,
                   "gamma of 1 / (1 + gamma r), 0..1e9 per scene unit; default 10 / the scene's diagonal")
      ->type_name("NUMBER")
      ->check(within(0, 1e9, false));
  command
      ->add_option("--ao-distance", a->ao_distance,
                   "surfaces beyond it do not occlude, 1e-9..1e9 scene units; default: all occlude")
      ->type_name("NUMBER")
      ->check(within(1e-9, 1e9, false));
  command->add_option("--samples", a->samples, "of truth: paths of each of its two halves, 1..1048576; default 64")
      ->type_name("INT")
      ->check(within(1, 1048576, true));
  command->add_option("--bounces", a->bounces, "of truth: diffuse bounces, 0..1000; default 0: without end")
      ->type_name("INT")
      ->check(within(0, 1000, true));
  command->add_option("--resolution", a->resolution, "of cone: voxels along each side, 8..1024; default 128")
      ->type_name("N")
      ->check(within(8, 1024, true));
  command->add_flag("--thin", a->thin, "of cone: 6-separating voxels; default: 26-separating");
  command->add_flag("--both-sides", a->both_sides,
                    "of cone: both sides of triangles reflect light; default: their fronts");
  command->add_flag("--anisotropic", a->anisotropic, "of cone: six directional volumes a level");
  command->add_option("--cones", a->cone_count, "of cone: 1, 4, 5, 6, 8, 9, 16 or 25; default 6")
      ->type_name("N")
      ->check(within(1, 25, true));
  command->add_option("--aperture", a->aperture, "of cone: full angle, degrees, 0..149; default 0: the set's own")
      ->type_name("DEG")
      ->check(within(0, 149, false));
  command->add_option("--step", a->step, "of cone: in diameters of the cone, 0.0625..4; default 0.5")
      ->type_name("NUMBER")
      ->check(within(0.0625, 4, false));
  command->add_option("--offset", a->offset, "of cone: voxels above the surface where cones start, 0..64; default 1")
      ->type_name("NUMBER")
      ->check(within(0, 64, false));
  command->add_option("--ssr-rays", a->ssr_rays, "of ssr: directions of the lobe a pixel, 1..4; 0: its mirror direction; default 4")
      ->type_name("N")
      ->check(within(0, 4, true));
  command->add_option("--reuse", a->reuse, "of ssr: pixels around one whose rays it takes, 0..4; default 1")
      ->type_name("N")
      ->check(within(0, 4, true));
  command->add_flag("--half-resolution", a->half, "of ssr: rays of one pixel of 2x2");
  command->add_option("--thickness", a->thickness, "of ssr: of surfaces, scene units, 0..1e9; default 0: 1/64 of the scene's diagonal")
      ->type_name("NUMBER")
      ->check(within(0, 1e9, false));
  command->add_option("--probes", a->probes, "of probe: along the longest side, or along each axis, 1..64 each; default 8")
      ->type_name("N|nx,ny,nz");
  command->add_option("--probe-size", a->probe_size, "of probe: texels along each side of what a probe sees, even, 16..1024; default 32")
      ->type_name("N")
      ->check(within(16, 1024, true));
  command->add_option("--irradiance-size", a->irradiance_size, "of probe: texels along each side of a map of irradiance, 4..128; default 8")
      ->type_name("N")
      ->check(within(4, 128, true));
  command->add_option("--distance-size", a->distance_size, "of probe: texels along each side of a map of distances, 4..128; default 16")
      ->type_name("N")
      ->check(within(4, 128, true));
  command->add_option("--probe-bounces", a->probe_bounces, "of probe: diffuse bounces, 1..16; default 3")
      ->type_name("N")
      ->check(within(1, 16, true));
  command->add_flag("--unfiltered", a->unfiltered, "of probe: trilinear alone, without visibility");
  command->add_option("--cells", a->cells, "of lpv: along the scene's longest side, 4..256; cascades: along every side; default 32")
      ->type_name("N")
      ->check(within(4, 256, true));
  command->add_option("--steps", a->lpv_steps, "of lpv: steps of light, 1..1000; default 0: as many as cells along the longest side")
      ->type_name("N")
      ->check(within(0, 1000, true));
  command->add_option("--cascades", a->cascades, "of lpv: nested grids about the middle of what is seen, 1..3; default 1: the whole scene")
      ->type_name("N")
      ->check(within(1, 3, true));
  command->add_option("--bands", a->bands, "of lpv: of spherical harmonics, 2 or 3; default 2")->type_name("N")->check(within(2, 3, true));
  command->add_option("--lobes", a->lobes, fmt::format("of lpv: {}: what is done where a lobe is negative; default {}", fmt::join(lobe_names, "|"), a->lobes))
      ->type_name("NAME")
      ->check(one_of(std::vector<std::string>(std::begin(lobe_names), std::end(lobe_names))));
  command->add_option("--blockers", a->blockers, fmt::format("of lpv: {}: what blocks light; default {}", fmt::join(blocker_names, "|"), a->blockers))
      ->type_name("NAME")
      ->check(one_of(std::vector<std::string>(std::begin(blocker_names), std::end(blocker_names))));
  command->add_option("--damping", a->damping, "of lpv: 0..1: light that grows from behind a surface is dropped; default 0")
      ->type_name("NUMBER")
      ->check(within(0, 1, false));
  command->add_option("--lpv-filter", a->lpv_filter, "of lpv: weight of a cell's neighbours in a blur of the volume, 0..0.333; default 0: none")
      ->type_name("NUMBER")
      ->check(within(0, 1.0 / 3, false));
  add_device_option(*command, a->device);
  command->footer("Truth runs on the CPU whatever --device says, and is kept on disk, in LUXEL_CACHE.");
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

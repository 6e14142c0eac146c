#include <luxel/hiz_ssr.h>

#include <algorithm>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "bench/scene/screen.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string depth, color, normal, roughness, specular, fallback, out, hits, paths, device, variant, convention;
  std::vector<double> camera, environment;
  double near_plane = 0.01, far_plane = 0, fov = 60, even_roughness = 0, thickness = 0, max_distance = 0, bias = 0.5, cutoff = 1;
  double fade_edge = 0.05, fade_distance = 0, fade_thickness = 0, fade_back = 1, prefilter = 1;
  int levels = 0, start_level = 0, max_steps = 0, steps = 64, refinements = 6, rays = 1, reuse = 1, seed = 0;
  bool half = false;
};

// Channels of an image: `count` of them, from files that have more the first ones.
Result<std::vector<float>> read_channels(const char* option, const std::string& path, int width, int height, int count) {
  const Result<io::Image> read = io::read_image(path);
  if (!read) return read.status();
  const io::Image& image = read.value();
  if (image.width != width || image.height != height)
    return Status(Code::io, fmt::format("{}: has {}x{} pixels; {} expects those of --depth, {}x{}", path, image.width, image.height,
                                        option, width, height));
  if (image.channels < count)
    return Status(Code::io, fmt::format("{}: has {} channels; {} expects {} or more", path, image.channels, option, count));
  std::vector<float> values;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % static_cast<std::size_t>(image.channels) < static_cast<std::size_t>(count)) values.push_back(image.pixels[i]);
  return values;
}

bool stored_unsigned(const std::string& path) {
  return path.size() > 4 && (path.ends_with(".png") || path.ends_with(".PNG"));
}

HizSsrParams parameters(const Arguments& a, int width, int height) {
  HizSsrParams p;
  p.width = width;
  p.height = height;
  p.variant = a.variant == "hiz" ? SsrVariant::hiz : a.variant == "dda" ? SsrVariant::dda
              : a.variant == "linear" ? SsrVariant::linear : SsrVariant::stochastic;
  p.depth = a.convention == "standard" ? SsrDepth::standard : a.convention == "reversed" ? SsrDepth::reversed : SsrDepth::linear;
  p.near_plane = a.near_plane;
  p.far_plane = a.far_plane;
  set_field(p, (a.camera.empty() ? a.fov : a.camera[6]) * std::numbers::pi / 180);
  p.levels = a.levels;
  p.start_level = a.start_level;
  p.max_steps = a.max_steps;
  p.steps = a.steps;
  p.refinements = a.refinements;
  if (a.thickness > 0) p.thickness = a.thickness;
  p.max_distance = a.max_distance;
  p.bias = a.bias;
  p.cutoff = a.cutoff;
  p.fade_edge = a.fade_edge;
  p.fade_distance = a.fade_distance;
  p.fade_thickness = a.fade_thickness;
  p.fade_back = a.fade_back;
  p.count = p.shade = true;
  if (p.variant == SsrVariant::stochastic) p.rays_per_pixel = a.rays;
  p.half_resolution = a.half;
  p.reuse = a.reuse;
  p.seed = a.seed;
  p.prefilter = a.prefilter;
  if (!a.environment.empty()) std::copy_n(a.environment.begin(), 3, p.environment.begin());
  p.fallback = !a.fallback.empty();
  p.factor = !a.specular.empty();
  return p;
}

// Four values a pixel: normal in view space, and roughness.
std::vector<float> in_view(const Arguments& a, const std::vector<float>& normals, const std::vector<float>& roughness) {
  scene::Camera camera;
  if (!a.camera.empty()) camera = {{a.camera[0], a.camera[1], a.camera[2]}, {a.camera[3], a.camera[4], a.camera[5]}, a.camera[6]};
  const scene::View view = scene::view_of(camera);
  std::vector<float> out;
  for (std::size_t i = 0; 3 * i < normals.size(); ++i) {
    glm::dvec3 n(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    if (stored_unsigned(a.normal)) n = 2.0 * n - 1.0;
    if (!a.camera.empty()) n = {glm::dot(n, view.right), glm::dot(n, view.up), glm::dot(n, view.back)};
    const double r = roughness.empty() ? a.even_roughness : static_cast<double>(roughness[i]);
    for (const double v : {n.x, n.y, n.z, r}) out.push_back(static_cast<float>(v));
  }
  return out;
}

Status write(const std::string& path, int width, int height, int channels, const std::vector<float>& four, io::WriteReport* changes) {
  io::Image image{width, height, channels, {}};
  for (std::size_t i = 0; i < four.size(); ++i)
    if (i % 4 < static_cast<std::size_t>(channels)) image.pixels.push_back(four[i]);
  return io::write_image(path, image, changes);
}

int run(const Arguments& a) {
  for (const std::string& path : {a.out, a.hits, a.paths})
    if (!path.empty())
      if (Status s = io::check_image_path(path); !s) return complain(s);
  const Result<io::Image> read = io::read_image(a.depth);
  if (!read) return complain(read.status(), true);
  const int width = read.value().width, height = read.value().height;
  const HizSsrParams p = parameters(a, width, height);
  if (Status s = validate(p); !s) return complain(s);
  std::vector<float> depth, color, normals, roughness, specular, fallback;
  struct File {
    const char* option;
    const std::string& path;
    int channels;
    std::vector<float>& to;
  };
  for (const File& f : {File{"--depth", a.depth, 1, depth}, {"--color", a.color, 3, color}, {"--normal", a.normal, 3, normals},
                        {"--roughness", a.roughness, 1, roughness}, {"--specular", a.specular, 3, specular},
                        {"--fallback", a.fallback, 3, fallback}}) {
    if (f.path.empty()) continue;
    auto values = read_channels(f.option, f.path, width, height, f.channels);
    if (!values) return complain(values.status(), true);
    f.to = std::move(values).value();
  }
  const std::vector<float> source = in_view(a, normals, roughness), colors = scene::padded(color, 1),
                           f0 = scene::padded(specular), other = scene::padded(fallback);
  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  Context& context = *opened.value();
  const auto reflected = scene::reflect(context, p, {depth, source, {}, colors, other, f0});
  if (!reflected) return complain(reflected.status());
  const scene::ScreenOutput& r = reflected.value();

  io::WriteReport changes;
  if (Status s = write(a.out, width, height, 3, r.radiance, &changes); !s) return complain(s);
  const int scale = p.half_resolution ? 2 : 1, traced_x = (width + scale - 1) / scale, traced_y = (height + scale - 1) / scale;
  for (const auto& [path, values] : {std::pair{a.hits, &r.hits}, {a.paths, &r.paths}})
    if (!path.empty())
      if (Status s = write(path, traced_x, traced_y * p.rays_per_pixel, 4, *values, nullptr); !s) return complain(s);
  const auto count = [&](SsrOutcome o) { return r.counters[static_cast<std::size_t>(o)]; };
  std::string times;
  for (const scene::ScreenStep& s : r.steps) times += fmt::format("{}{} {:.2f} ms", times.empty() ? "" : ", ", s.name, s.ms);
  const double rays = std::max(count(SsrOutcome::rays), 1u);
  fmt::print("hiz_ssr {} {}x{} on {}: {}; wrote {}{}\n", a.variant, width, height, context.info().id, times, a.out, changes_text(changes));
  fmt::print("  {} rays, {:.1f} looks each: {} hit, {} missed, {} left the image, {} came behind the camera, {} capped; {} passed behind a "
             "surface; {} pixels or directions had no ray\n",
             count(SsrOutcome::rays), count(SsrOutcome::steps) / rays, count(SsrOutcome::hit), count(SsrOutcome::miss),
             count(SsrOutcome::left), count(SsrOutcome::behind), count(SsrOutcome::capped), count(SsrOutcome::hidden),
             count(SsrOutcome::degenerate));
  return done;
}

}  // namespace

void add_hiz_ssr(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("hiz_ssr");
  CLI::App* command = app.add_subcommand("hiz_ssr", "reflections of an image in itself, by rays over its depth");
  auto a = std::make_shared<Arguments>();
  command->add_option("--depth", a->depth, "depth image, first channel: .exr, .hdr, .png or .npy; 1e10 and more is sky")
      ->required()->type_name("FILE");
  command->add_option("--color", a->color, "radiance that the image shows")->required()->type_name("FILE");
  command->add_option("--normal", a->normal, "normals: world space with --camera, else view space (x right, y up, z to the viewer); "
                      "-1..1, in .png n/2 + 1/2")->required()->type_name("FILE");
  command->add_option("-o,--out", a->out, "radiance in the specular lobe of each pixel; zeros where none reflects")
      ->required()->type_name("FILE");
  command->add_option("--roughness", a->roughness, "perceptual roughness, first channel; default: --even-roughness")->type_name("FILE");
  command->add_option("--specular", a->specular, "reflectance at normal incidence: the result is multiplied by what a lobe reflects")
      ->type_name("FILE");
  command->add_option("--fallback", a->fallback, "radiance in the lobe by other means, where nothing was found; default: --environment")
      ->type_name("FILE");
  command->add_option("--hits", a->hits, "u, v, depth and confidence of every ray, ray after ray downwards")->type_name("FILE");
  command->add_option("--paths", a->paths, "length, outcome (1 hit, 2 miss, 3 left, 4 behind, 5 capped), hidden and looks of every ray")
      ->type_name("FILE");
  command->add_option("--camera", a->camera, "eye, target and vertical field in degrees; default: --fov")
      ->type_name("ex,ey,ez,tx,ty,tz,fov")->delimiter(',')->expected(7);
  command->add_option("--environment", a->environment, "radiance where nothing was found; default 0,0,0")
      ->type_name("r,g,b")->delimiter(',')->expected(3);
  add_variant(*command, k, a->variant);
  add_choice(*command, k, "--depth-convention", a->convention);
  add_switch(*command, k, "--half-resolution", a->half);
  for (const auto& [name, value] : {std::pair{"--near", &a->near_plane}, {"--far", &a->far_plane}, {"--fov", &a->fov},
                                    {"--even-roughness", &a->even_roughness}, {"--thickness", &a->thickness},
                                    {"--max-distance", &a->max_distance}, {"--bias", &a->bias}, {"--cutoff", &a->cutoff},
                                    {"--fade-edge", &a->fade_edge}, {"--fade-distance", &a->fade_distance},
                                    {"--fade-thickness", &a->fade_thickness}, {"--fade-back", &a->fade_back},
                                    {"--prefilter", &a->prefilter}})
    add_number(*command, k, name, *value);
  for (const auto& [name, value] : {std::pair{"--levels", &a->levels}, {"--start-level", &a->start_level}, {"--max-steps", &a->max_steps},
                                    {"--steps", &a->steps}, {"--refinements", &a->refinements}, {"--rays", &a->rays},
                                    {"--reuse", &a->reuse}, {"--seed", &a->seed}})
    add_number(*command, k, name, *value);
  add_device_option(*command, a->device);
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

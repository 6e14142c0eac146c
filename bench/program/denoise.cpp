#include "bench/report/denoise.h"

#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string color, albedo, normal, depth, out, device;
  double fov = 45, sigma_depth = 1, sigma_normal = 64, sigma_luminance = 6, sigma_albedo = 0.02, target = 0, k = 4;
  int levels = 5;
  bool no_clamp = false;
};

// An image as `width` channels a pixel, of a file with `least` or more; those that it has not are 0.
Result<std::vector<double>> channels_of(const std::string& option, const std::string& path, const io::Image* like,
                                        int least, int count, io::Image* whole = nullptr) {
  Result<io::Image> read = io::read_image(path);
  if (!read) return read.status();
  const io::Image& image = read.value();
  if (like != nullptr && (image.width != like->width || image.height != like->height))
    return Status(Code::io, fmt::format("{}: has {}x{} pixels; {} expects those of --color, {}x{}", path, image.width,
                                        image.height, option, like->width, like->height));
  if (image.channels < least)
    return Status(Code::io,
                  fmt::format("{}: has {} channels; {} expects {} or more", path, image.channels, option, least));
  std::vector<double> values;
  for (std::size_t p = 0; p < image.pixels.size(); p += static_cast<std::size_t>(image.channels))
    for (int c = 0; c < count; ++c)
      values.push_back(c < image.channels ? image.pixels[p + static_cast<std::size_t>(c)] : 0.0f);
  if (whole != nullptr) *whole = std::move(read).value();
  return values;
}

int run(const Arguments& a) {
  if (Status s = io::check_image_path(a.out); !s) return complain(s);
  report::NoisyRender render;
  io::Image image;
  const struct {
    const char* option;
    const std::string& path;
    std::vector<double>& values;
    int least, count;
  } files[] = {{"--color", a.color, render.color, 3, 4},
               {"--albedo", a.albedo, render.albedo, 3, 4},
               {"--normal", a.normal, render.normals, 3, 4},
               {"--depth", a.depth, render.depth, 1, 1}};
  for (const auto& file : files) {
    if (file.path.empty()) continue;
    const bool first = &file == files;
    auto values =
        channels_of(file.option, file.path, first ? nullptr : &image, file.least, file.count, first ? &image : nullptr);
    if (!values) return complain(values.status(), true);
    file.values = std::move(values).value();
  }
  render.width = image.width;
  render.height = image.height;
  report::DenoiseParams p;
  p.footprint = 2 * std::tan(a.fov * std::numbers::pi / 360) / image.height;
  p.sigma_depth = a.sigma_depth;
  p.sigma_normal = a.sigma_normal;
  p.sigma_luminance = a.sigma_luminance;
  p.sigma_albedo = a.sigma_albedo;
  p.levels = a.levels;
  p.variance_target = a.target;
  p.clamp = !a.no_clamp;
  p.k = a.k;
  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  const auto result = report::denoise(*opened.value(), render, p);
  if (!result) return complain(result.status());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(result.value().color[i / static_cast<std::size_t>(image.channels) * 4 +
                                                              i % static_cast<std::size_t>(image.channels)]);
  io::WriteReport changes;
  if (Status s = io::write_image(a.out, image, &changes); !s) return complain(s);
  fmt::print(
      "denoise {}x{}, {} levels on {}: {:.1f} ms; {} pixels clamped{}; wrote {}{}\n", image.width, image.height,
      a.levels, opened.value()->info().id, result.value().ms, result.value().clamped,
      result.value().not_finite > 0 ? fmt::format(", {} that were not finite replaced", result.value().not_finite) : "",
      a.out, changes_text(changes));
  return done;
}

}  // namespace

void add_denoise(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand(
      "denoise", "make a noisy render smooth: a preset of outlier_clamp, variance and bilateral atrous");
  auto a = std::make_shared<Arguments>();
  command->add_option("--color", a->color, "noisy linear radiance: .exr, .hdr, .png or .npy, 3 or 4 channels")
      ->required()
      ->type_name("FILE");
  command->add_option("--albedo", a->albedo, "divided out before (at least 0.001) and multiplied after")
      ->type_name("FILE");
  command->add_option("--normal", a->normal, "unit normals, first three channels, -1..1")->type_name("FILE");
  command
      ->add_option("--depth", a->depth, "view-space depth, first channel; 1e10 and more is sky, which stays as it is")
      ->type_name("FILE");
  add_image_out(*command, a->out, "smooth image");
  const auto number = [&](const char* name, double& value, double least, double most, const char* meaning) {
    command->add_option(name, value, fmt::format("{}: {}..{}; default {}", meaning, least, most, value))
        ->check(CLI::Range(least, most))
        ->type_name("NUMBER");
  };
  number("--fov", a->fov, 1, 175, "with --depth: vertical field of view, degrees");
  number("--sigma-depth", a->sigma_depth, 1e-6, 1e6, "footprints off the plane for each pixel of distance");
  number("--sigma-normal", a->sigma_normal, 0.01, 4096, "power of the cosine between normals");
  number("--sigma-luminance", a->sigma_luminance, 1e-6, 1e6, "standard deviations");
  number("--sigma-albedo", a->sigma_albedo, 0, 1e6, "differences of albedo that weigh; 0: none do");
  number("--variance-target", a->target, 0, 1e30,
         "squared luminance without albedo: pixels whose variance falls below are not filtered further");
  number("--k", a->k, 0, 1e6, "standard deviations of the neighbours beyond which a pixel is clamped");
  command->add_option("--levels", a->levels, "of the filter: 1..6; default 5")
      ->check(CLI::Range(1, 6))
      ->type_name("INT");
  command->add_flag("--no-clamp", a->no_clamp, "leave outliers as they are; default off");
  add_device_option(*command, a->device);
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

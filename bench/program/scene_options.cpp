#include "scene_options.h"

#include <charconv>
#include <cmath>

#include "bench/io/image.h"

namespace luxel::program {

using glm::dvec3;

std::vector<double> numbers(std::string_view text, std::size_t count) {
  std::vector<double> values;
  while (true) {
    double v = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), v);
    if (error != std::errc() || !std::isfinite(v)) return {};
    values.push_back(v);
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    if (text.empty()) break;
    if (text.front() != ',') return {};
    text.remove_prefix(1);
  }
  return values.size() == count ? values : std::vector<double>{};
}

Status wrong(const char* option, const std::string& text, const char* expected) {
  return Status(Code::invalid_argument, fmt::format("--{}: {} is not understood; expected {}", option, text, expected));
}

CLI::Validator within(double least, double most, bool whole) {
  return CLI::Validator(
      [=](std::string& text) {
        const auto v = numbers(text, 1);
        if (!v.empty() && v[0] >= least && v[0] <= most && (!whole || v[0] == std::floor(v[0]))) return std::string();
        return fmt::format("{} is {}; expected {}{}..{}", text, v.empty() ? "not a number" : "out of range",
                           whole ? "a whole number " : "", least, most);
      },
      "");
}

namespace {

Status set_camera(const std::string& text, scene::Camera& camera) {
  const auto v = numbers(text, 7);
  if (v.empty()) return wrong("camera", text, "ex,ey,ez,tx,ty,tz,fov: eye, target and vertical field in degrees");
  camera = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6]};
  if (camera.eye == camera.target) return wrong("camera", text, "an eye away from its target");
  if (!(camera.fov > 0 && camera.fov < 180)) return wrong("camera", text, "a field above 0 and below 180 degrees");
  return {};
}

Status set_sun(const std::string& text, scene::Sun& sun) {
  const auto v = numbers(text, 4);
  if (v.empty()) return wrong("sun", text, "dx,dy,dz,E: direction towards the sun, and irradiance");
  const dvec3 direction(v[0], v[1], v[2]);
  const double length = glm::length(direction);
  if (!(length > 0) || !std::isfinite(length)) return wrong("sun", text, "a direction that is not zero");
  if (v[3] < 0) return wrong("sun", text, "an irradiance of 0 or more");
  sun = {direction / length, dvec3(v[3])};
  return {};
}

Status set_sky(const std::string& text, scene::Sky& sky) {
  if (const auto v = numbers(text, 3); !v.empty()) {
    if (std::min({v[0], v[1], v[2]}) < 0) return wrong("sky", text, "radiances of 0 or more");
    sky = {{v[0], v[1], v[2]}, 0, 0, {}};
    return {};
  }
  const Result<io::Image> read = io::read_image(text);
  if (!read) return Status(Code::invalid_argument, fmt::format("--sky: {}", read.status().message()));
  const io::Image& image = read.value();
  sky = {dvec3(1), image.width, image.height, {}};
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels)
    for (std::size_t c = 0; c < 3; ++c) {
      const float v = image.pixels[i + (channels < 3 ? 0 : c)];
      sky.image.push_back(v > 0 && std::isfinite(v) ? v : 0.0f);
    }
  return {};
}

Status set_size(const std::string& text, int& width, int& height) {
  constexpr const char* expected = "WxH, each 1..8192, 2^23 pixels at most";  // truth takes a kilobyte for each
  const char* end = text.data() + text.size();
  const auto w = std::from_chars(text.data(), end, width);
  if (w.ec != std::errc() || w.ptr == end || *w.ptr != 'x') return wrong("size", text, expected);
  const auto h = std::from_chars(w.ptr + 1, end, height);
  if (h.ec != std::errc() || h.ptr != end) return wrong("size", text, expected);
  if (width < 1 || height < 1 || width > 8192 || height > 8192 || width * height > 1 << 23)
    return wrong("size", text, expected);
  return {};
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options, const char* size) {
  options.size = size;
  command
      .add_option("--scene", options.scene,
                   fmt::format("{}, atrium:N (N triangles), or a file: OBJ, PLY, glTF, GLB ...",
                               fmt::join(scene::built_in_names(), ", ")))
      ->required()
      ->type_name("NAME|FILE");
  command.add_option("--camera", options.camera, "eye, target and vertical field in degrees; default: the scene's")
      ->type_name("ex,ey,ez,tx,ty,tz,fov");
  command.add_option("--size", options.size, fmt::format("pixels, each side 1..8192, 2^23 at most; default {}", size))->type_name("WxH");
  command
      .add_option("--sun", options.sun,
                   "direction towards the sun, and irradiance on a plane that faces it; default: the scene's")
      ->type_name("dx,dy,dz,E");
  command.add_option("--sky", options.sky, "radiance, or a latitude-longitude image, +y up; default: the scene's")
      ->type_name("r,g,b|FILE");
}

Result<SceneChoice> parse(const SceneOptions& options) {
  SceneChoice choice;
  if (Status s = set_size(options.size, choice.width, choice.height); !s) return s;
  if (!options.camera.empty())
    if (Status s = set_camera(options.camera, choice.camera.emplace()); !s) return s;
  if (!options.sun.empty())
    if (Status s = set_sun(options.sun, choice.sun.emplace()); !s) return s;
  if (!options.sky.empty())
    if (Status s = set_sky(options.sky, choice.sky.emplace()); !s) return s;
  return choice;
}

Result<scene::Scene> read(const SceneOptions& options, const SceneChoice& choice) {
  auto scene = scene::scene_from(options.scene);
  if (!scene) return scene.status();
  if (choice.camera) scene.value().camera = *choice.camera;
  if (choice.sun) scene.value().sun = *choice.sun;
  if (choice.sky) scene.value().sky = *choice.sky;
  return scene;
}

}  // namespace luxel::program

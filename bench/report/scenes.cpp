#include "bench/report/scenes.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "bench/scene/images.h"
#include "tests/cases/storage.h"

namespace luxel::report {

Scene middle_of(const Scene& scene, int side) {
  if (scene.width <= side && scene.height <= side) return scene;
  Scene part{scene.name, std::min(side, scene.width), std::min(side, scene.height), scene.channels, {}, scene.encoded};
  const int left = (scene.width - part.width) / 2, top = (scene.height - part.height) / 2;
  for (int y = 0; y < part.height; ++y) {
    const auto row =
        scene.values.begin() + (static_cast<std::ptrdiff_t>(top + y) * scene.width + left) * scene.channels;
    part.values.insert(part.values.end(), row, row + static_cast<std::ptrdiff_t>(part.width) * scene.channels);
  }
  return part;
}

std::string size_text(int width, int height) { return fmt::format("{}x{}", width, height); }

std::string data_folder() {
  const char* set = std::getenv("LUXEL_DATA");
  return set != nullptr && *set != '\0' ? set : LUXEL_SOURCE_DIR "/../shared/data";
}

Scene landscape(int width, int height) {
  return {"landscape (generated)", width, height, 4, scene::hdr_landscape(width, height, 4)};
}

std::vector<Scene> image_files(const Settings& settings, std::vector<std::string>& problems) {
  std::vector<std::string> files = settings.images;
  if (files.empty()) {
    for (const char* file : {"photos/CandleGlass.exr", "photos/camera.png", "photos/chelsea.png",
                             "hdri/vestibule_1k.hdr", "hdri/spruit_sunrise_1k.hdr"})
      files.push_back(data_folder() + "/" + file);
  }
  std::vector<Scene> scenes;
  for (const std::string& file : files) {
    const Result<io::Image> image = io::read_image(file);
    if (!image) {
      problems.push_back(image.status().message());
      continue;
    }
    const io::Image& i = image.value();
    Scene scene{std::filesystem::path(file).filename().string(),
                i.width,
                i.height,
                i.channels,
                std::vector<double>(i.pixels.begin(), i.pixels.end()),
                file.ends_with(".png") || file.ends_with(".PNG")};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

std::vector<double> in_format(const Scene& scene, Format format) {
  const int have = scene.channels, want = channels(format);
  const std::size_t pixels = static_cast<std::size_t>(scene.width) * scene.height;
  std::vector<double> values;
  values.reserve(pixels * want);
  for (std::size_t p = 0; p < pixels; ++p) {
    const double* v = scene.values.data() + p * have;
    const bool grey = have < 3;
    const double rgba[4] = {v[0], grey ? v[0] : v[1], grey ? v[0] : v[2], have == 2 ? v[1] : have == 4 ? v[3] : 1.0};
    if (want == 1)
      values.push_back(grey ? v[0] : 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]);
    else
      values.insert(values.end(), rgba, rgba + want);
  }
  return cases::quantise(values, format);
}

}  // namespace luxel::report

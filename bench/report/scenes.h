// Images that the report blurs: generated ones always, photographs and skies where the data folder or the user has
// them.
#pragma once
#include <string>
#include <vector>

#include <luxel/plan.h>

#include "bench/report/settings.h"

namespace luxel::report {

struct Scene {
  std::string name;
  int width = 0, height = 0, channels = 0;
  std::vector<double> values;  // interleaved, as the file has them
  bool encoded = false;        // PNG: carries the sRGB curve already, as pictures show it
};

/// Generated: "landscape" of a size.
Scene landscape(int width, int height);

/// Files: those of the settings, else photographs and skies under LUXEL_DATA. Whole, however large.
/// `problems` receives a line for each file that is missing or unreadable.
std::vector<Scene> image_files(const Settings& settings, std::vector<std::string>& problems);

/// The scene's pixels in a format's channels, as the format holds them: one channel is luminance (Rec. 709), a missing
/// alpha is 1.
std::vector<double> in_format(const Scene& scene, Format format);

/// The middle of a scene, at most `side` wide and high.
Scene middle_of(const Scene& scene, int side);

/// "1920x1080"
std::string size_text(int width, int height);

/// Folder of the data that tests and reports use: LUXEL_DATA, else ../shared/data beside the source.
std::string data_folder();

}  // namespace luxel::report

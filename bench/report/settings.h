// What a report is asked for.
#pragma once
#include <string>
#include <vector>

namespace luxel::report {

struct Settings {
  bool quick = false;
  bool oracle = false;     // the C++ execution, beside devices
  bool slow_cases = true;  // of stability
  int most_cases = 0;      // of each list of them, those that go furthest; 0: all
  bool once = false;       // errors are what is wanted: times are those of a single run
  // What `luxel tune` wants of a kernel's grid, where that lets it be chosen; 0: the grid's own.
  int width = 0, height = 0;  // of images
  double sigma = 0;           // gaussian_blur
  int radius = 0;             // bilateral
  bool stability = false;  // promises alone: `luxel stability`
  bool fresh = false;  // what an earlier run left in `out` does not count
  bool page = true;    // index.html and plots too
  std::vector<std::string> devices;  // as Context::open takes them; empty: all but the execution in double
  std::vector<std::string> kernels;  // empty: all
  std::vector<std::string> images;   // files beside the built-in scenes; empty: those of the data folder
  std::vector<std::string> only;     // measure only what has one of these in its label; empty: everything
  std::string out = "luxel-report";

  bool wants(const std::string& kernel) const {
    for (const std::string& k : kernels)
      if (k == kernel) return true;
    return kernels.empty();
  }
};

/// Kernels that the report measures.
inline const std::vector<std::string>& measured_kernels() {
  static const std::vector<std::string> names{"gaussian_blur", "bilateral",  "mip_build",
                                              "voxelize",      "cone_trace", "hiz_ssr",
                                              "octahedral_march", "light_propagation"};
  return names;
}

}  // namespace luxel::report

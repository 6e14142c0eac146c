// What a report is asked for.
#pragma once
#include <string>
#include <vector>

namespace luxel::report {

struct Settings {
  bool quick = false;
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
                                              "light_propagation"};
  return names;
}

}  // namespace luxel::report

#include "bench/report/defaults.h"

#include <algorithm>
#include <map>
#include <string>

#include <luxel/cone_trace.h>
#include <luxel/gaussian_blur.h>
#include <luxel/light_propagation.h>
#include <luxel/octahedral_march.h>
#include <luxel/probe_irradiance.h>
#include <luxel/probe_shade.h>

#include "bench/report/denoise.h"
#include "bench/report/frontier.h"

namespace luxel::report {
namespace {

// A default: what its rows' options and knobs say; an empty variant is any, as the caller asks for what it holds.
struct Default {
  const char* kernel;
  const char* variant;
  Json settings;
  const char* why;  // it is the default where something beats it
};

// Taken from the parameters, so that both stay the same.
const std::vector<Default>& defaults() {
  static const std::vector<Default> all = [] {
    const ConeTraceParams cones;
    const DenoiseParams denoise;
    const ProbeMaps maps;
    const ProbeIrradianceParams filter;
    const ProbeShadeParams shade;
    const LpvPropagateParams light;
    return std::vector<Default>{
        {"gaussian_blur", "separable", {{"input", "buffer"}, {"k", 3}, {"difference", false}, {"keep_alpha", false}, {"drop_taps", false}},
         "it holds for every sigma, border and format with one bound; which variant is cheapest at which sigma is a table of its own"},
        {"bilateral", "direct", {{"step", 1}}, "it is the formula, which the other variants approximate"},
        {"bilateral", "luxel denoise",
         {{"clamp", denoise.clamp}, {"levels", denoise.levels}, {"sigma_luminance", denoise.sigma_luminance}, {"variance_target", denoise.variance_target}},
         "it was chosen over more scenes and metrics than this one"},
        {"mip_build", "", {{"input", "buffer"}, {"single_pass", false}},
         "images and several levels a dispatch ask more of a device than every device has"},
        {"voxelize", "", {{"merging", "exact"}, {"normals", false}, {"touched_only", false}},
         "its result is the same in every run, and volumes hold zeros where nothing is; that takes writing all of them"},
        {"cone_trace", "isotropic", {{"input", "buffer"}, {"cones", "6"}, {"footprint", cones.footprint}, {"step_scale", cones.step_scale}, {"error", cones.error}},
         "sets of cones trade error for time; six hold the furnace to rounding in every direction, and buffers every device has"},
        {"hiz_ssr", "hiz", Json::object(), "its cost grows least with the length of rays; short rays need no pyramid"},
        {"octahedral_march", "two levels", {{"distance", "f16"}, {"normal", "snorm8"}, {"resolution", maps.size}},
         "with normals thin surfaces are not stepped through; coarser maps are faster and miss more"},
        {"probe_irradiance", "", {{"irradiance", filter.irradiance_size}, {"distances", filter.moments_size}, {"averaged_to", 64}},
         "averaging what probes see first is faster, and finer maps are for sharper changes of light with direction"},
        {"probe_shade", "filtered", {{"irradiance", shade.irradiance_size}, {"distances", shade.moments_size}},
         "without visibility light passes walls"},
        {"light_propagation", "linear", {{"bands", light.bands}, {"iterations", light.iterations}},
         "it keeps energy; lobes that are clamped or scaled add or lose some"},
    };
  }();
  return all;
}

const Default* default_of(const Json& row) {
  const auto matches = [&](const Default& d) {
    if (row.at("kernel") != d.kernel || (*d.variant && row.at("variant") != d.variant)) return false;
    return std::all_of(d.settings.items().begin(), d.settings.items().end(), [&](const auto& item) {
      for (const char* part : {"options", "knobs"})
        if (const auto found = row.at(part).find(item.key()); found != row.at(part).end()) return *found == item.value();
      return false;
    });
  };
  const auto found = std::find_if(defaults().begin(), defaults().end(), matches);
  return found == defaults().end() ? nullptr : &*found;
}

Json setting(const Json& row) { return {{"variant", row.at("variant")}, {"options", row.at("options")}, {"knobs", row.at("knobs")}}; }

}  // namespace

Json default_rows(const std::vector<Json>& rows) {
  std::map<std::string, std::vector<const Json*>> groups;
  for (const Json& row : rows) groups[row.value("group", std::string())].push_back(&row);
  Json all = Json::array();
  for (const Json& row : rows) {
    const Default* const found = row.at("knobs").contains("level") ? nullptr : default_of(row);
    if (!found) continue;
    const Json* better = nullptr;
    for (const Json* other : groups[row.value("group", std::string())])
      if (beats(*other, row) && (!better || total_time(*other).median < total_time(*better).median)) better = other;
    Json line{{"kernel", row.at("kernel")},
              {"device", row.at("device")},
              {"scene", row.at("scene")},
              {"size", row.at("size")},
              {"metric", row.at("error").at("metric")},
              {"setting", setting(row)},
              {"error", total_error(row)},
              {"ms", total_time(row).median},
              {"better", nullptr},
              {"why", nullptr}};
    if (better) {
      line["better"] = {{"setting", setting(*better)}, {"error", total_error(*better)}, {"ms", total_time(*better).median}};
      line["why"] = found->why;
    }
    all.push_back(std::move(line));
  }
  return all;
}

}  // namespace luxel::report

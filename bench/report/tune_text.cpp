// A setting as a command line and as C++.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/tune.h"

namespace luxel::report {
namespace {

std::string text(const Json& v) { return v.is_string() ? v.get<std::string>() : v.is_number_float() ? fmt::format("{}", v.get<double>()) : v.dump(); }

// Reads options and knobs by name, and collects arguments and members.
class Writer {
 public:
  explicit Writer(const Json& row) : row_(row) {}

  const Json* find(const char* name) const {
    for (const char* where : {"knobs", "options"})
      if (row_.at(where).contains(name)) return &row_.at(where).at(name);
    return nullptr;
  }
  std::string word(const char* name, const std::string& otherwise = "") const {
    const Json* v = find(name);
    return v ? text(*v) : otherwise;
  }
  bool on(const char* name) const {
    const Json* v = find(name);
    return v && v->is_boolean() && v->get<bool>();
  }
  /// `--flag value` where the setting has it and it is not `standard`.
  void argument(const char* flag, const std::string& value, const std::string& standard = "") {
    if (!value.empty() && value != standard) command_ += fmt::format(" {} {}", flag, value);
  }
  void flag(const char* name, bool on) {
    if (on) command_ += fmt::format(" {}", name);
  }
  void command(const std::string& begin) { command_ = begin; }
  void member(const std::string& name, const std::string& value) {
    if (!value.empty()) members_ += fmt::format("  p.{} = {};\n", name, value);
  }
  void line(const std::string& code) { members_ += "  " + code + "\n"; }

  /// Of "f16x4": the command line's f16.
  std::string format() const {
    const std::string f = word("format");
    return f.substr(0, f.find('x'));
  }
  void format_member() { member("format", fmt::format("luxel::Format::{}", word("format", "f32x4"))); }

  Spelled done(const std::string& header, const std::string& type, const std::string& arguments, const std::string& begin) const {
    const std::string stem = header.substr(0, header.find('.'));
    return {command_, fmt::format("#include <luxel/{}>\n\nluxel::{} tuned_{}({}) {{\n  luxel::{} p;\n{}{}  return p;\n}}\n", header, type, stem, arguments,
                                  type, begin, members_)};
  }

 private:
  const Json& row_;
  std::string command_, members_;
};

const std::string image_size = "  p.width = width;\n  p.height = height;\n";

Spelled gaussian_blur(const Json& row) {
  Writer w(row);
  const std::string variant = row.at("variant");
  w.command("luxel gaussian_blur --in image.exr -o blurred.exr");
  w.argument("--sigma", w.word("sigma"));
  w.argument("--variant", variant, "separable");
  for (const auto& [flag, knob] : {std::pair{"--radius", "radius"}, {"--order", "order"}, {"--passes", "passes"}, {"--levels", "levels"}})
    w.argument(flag, w.word(knob));
  w.argument("--filter", w.word("filter"), "linear");
  w.argument("--border", w.word("border"), "clamp");
  w.argument("--format", w.format(), "f32");
  if (variant != "sampler") w.argument("--input", w.word("input") == "buffer" ? "" : "image");
  w.flag("--difference", w.on("difference"));
  w.flag("--keep-alpha", w.on("keep_alpha"));
  w.flag("--drop-taps", w.on("drop_taps"));
  for (const char* knob : {"sigma", "radius", "order", "passes", "levels"}) w.member(knob, w.word(knob));
  if (w.find("filter")) w.member("filter", "luxel::PyramidFilter::" + w.word("filter"));
  w.member("border", "luxel::Border::" + w.word("border", "clamp"));
  w.member("variant", "luxel::GaussianVariant::" + variant);
  w.format_member();
  if (w.word("input", "buffer") != "buffer") w.member("input", w.word("input") == "image" ? "luxel::Input::image" : "luxel::Input::storage_image");
  for (const char* option : {"difference", "keep_alpha", "drop_taps"})
    if (w.on(option)) w.member(option, "true");
  return w.done("gaussian_blur.h", "GaussianBlurParams", "int width, int height", image_size);
}

Spelled bilateral(const Json& row) {
  Writer w(row);
  std::string variant = row.at("variant");
  if (variant == "luxel denoise") {
    w.command("luxel denoise --color color.exr --albedo albedo.exr --normal normal.exr --depth depth.exr -o denoised.exr");
    for (const auto& [flag, knob] : {std::pair{"--levels", "levels"}, {"--sigma-luminance", "sigma_luminance"}, {"--variance-target", "variance_target"}})
      w.argument(flag, w.word(knob), "0");
    w.flag("--no-clamp", !w.on("clamp"));
    Spelled s = w.done("bilateral.h", "BilateralParams", "int width, int height", image_size);
    s.cpp = "";  // several kernels one after another: bench/report/denoise.cpp
    return s;
  }
  variant = variant.substr(0, variant.find(','));
  w.command("luxel bilateral --in image.exr -o filtered.exr");
  w.argument("--variant", variant, "direct");
  const std::string colour = w.word("colour", "self");
  if (colour == "guide") w.argument("--guide", "guide.exr");
  if (variant != "discontinuity") w.argument("--range", colour == "self" ? "" : colour);
  for (const auto& [flag, knob] : {std::pair{"--radius", "radius"}, {"--sigma-space", "sigma_space"}, {"--levels", "levels"}, {"--taps", "taps"}})
    w.argument(flag, w.word(knob), std::string(knob) == "radius" ? "-1" : "");
  w.argument("--step", w.word("step"), "1");
  if (colour != "off") w.argument("--sigma-range", w.word("sigma_range"));
  if (variant == "grid") w.argument("--high", w.word("high"), "1");
  if (w.word("depth", "off") != "off" || variant == "discontinuity") {
    w.argument("--depth", "depth.exr");
    w.argument("--footprint", w.word("footprint"));
    w.argument("--sigma-depth", w.word("sigma_depth"), "1");
    if (w.word("depth") == "svgf") w.argument("--depth-term", "svgf");
  }
  if (w.on("normal") || variant == "discontinuity") w.argument("--normal", "normal.exr");
  if (w.on("normal")) w.argument("--sigma-normal", w.word("sigma_normal"));
  if (w.on("luminance")) {
    w.argument("--variance", "variance.exr");
    w.argument("--sigma-luminance", w.word("sigma_luminance"));
  }
  w.argument("--window", w.word("window"), "square");
  w.flag("--adaptive", w.on("adaptive"));
  w.argument("--format", w.format(), "f32");
  w.member("variant", "luxel::BilateralVariant::" + variant);
  for (const char* knob : {"sigma_space", "radius", "step", "levels", "taps", "high"}) w.member(knob, w.word(knob));
  w.member("range", "luxel::RangeTerm::" + colour);
  w.member("sigma_range", w.word("sigma_range"));
  if (w.word("window") == "circle") w.member("window", "luxel::FilterWindow::circle");
  if (w.on("adaptive")) w.member("adaptive", "true");
  if (w.word("depth", "off") != "off") {
    w.member("depth", "luxel::DepthTerm::" + w.word("depth"));
    w.member("footprint", w.word("footprint"));
    w.member("sigma_depth", w.word("sigma_depth"));
  }
  if (w.on("normal")) w.member("normal", "true"), w.member("sigma_normal", w.word("sigma_normal"));
  if (w.on("luminance")) w.member("luminance", "true"), w.member("sigma_luminance", w.word("sigma_luminance"));
  w.format_member();
  return w.done("bilateral.h", "BilateralParams", "int width, int height", image_size);
}

Spelled mip_build(const Json& row) {
  Writer w(row);
  const std::string variant = row.at("variant"), size = row.at("size");
  const bool volume = std::count(size.begin(), size.end(), 'x') == 2;
  w.command(fmt::format("luxel mip_build --in {} -o levels/", volume ? "volume.npy" : "image.exr"));
  w.argument("--variant", variant, "isotropic");
  w.argument("--format", w.format(), "f32");
  w.argument("--sizes", w.word("sizes"), "floor");
  w.argument("--ratio", w.word("ratio"), "2");
  w.argument("--samples", w.word("samples"), "cells");
  w.argument("--input", w.word("input"), "buffer");
  w.member("variant", "luxel::MipVariant::" + variant);
  w.format_member();
  if (w.find("sizes")) w.member("sizes", "luxel::MipSizes::" + w.word("sizes"));
  w.member("ratio", w.word("ratio"));
  if (w.find("samples")) w.member("samples", "luxel::MipSamples::" + w.word("samples"));
  if (w.word("input") == "image") w.member("input", "luxel::Input::image");
  w.line(w.on("single_pass") ? "// Profile::workgroup_memory is to be true: several levels a dispatch."
                             : "// Profile::workgroup_memory is to be false: a dispatch a level.");
  return w.done("mip_build.h", "MipBuildParams", "int width, int height, int depth", image_size + "  p.depth = depth;\n");
}

Spelled voxelize(const Json& row) {
  Writer w(row);
  const std::string mode = row.at("variant"), size = row.at("size");
  w.command(fmt::format("luxel voxelize --mesh mesh.obj --resolution {} -o grid.npy", size.substr(0, size.find('x'))));
  w.argument("--mode", mode, "conservative");
  w.argument("--merging", w.word("merging"), "exact");
  w.argument("--format", w.format(), "f32");
  w.member("mode", "luxel::VoxelizeMode::" + mode);
  w.member("merging", "luxel::VoxelizeMerging::" + w.word("merging", "exact"));
  w.format_member();
  if (w.on("normals")) w.member("normal", "true");
  if (w.on("touched_only")) w.member("touched_only", "true");
  Spelled s = w.done("voxelize.h", "VoxelizeParams", "const luxel::VoxelGrid& grid, const luxel::VoxelTriangles& triangles", "");
  const std::string plain = "  luxel::VoxelizeParams p;\n";
  s.cpp.replace(s.cpp.find(plain), plain.size(), "  luxel::VoxelizeParams p = luxel::voxelize_params(grid, triangles);\n");
  return s;
}

// Scenes of the report by the names that `--scene` takes.
std::string scene_of(const Json& row) {
  const std::string scene = row.at("scene");
  for (const char* name : {"atrium", "cornell", "two_rooms", "furnace"})
    if (scene.find(name) != std::string::npos) return name;
  return scene.find("ornell") != std::string::npos ? "cornell" : "scene.glb";
}

Spelled cone_trace(const Json& row) {
  Writer w(row);
  const std::string variant = row.at("variant"), cones = w.word("cones");
  const bool classic = cones.starts_with("classic"), rendered = w.find("resolution") != nullptr;
  if (rendered) {
    w.command(fmt::format("luxel render --scene {} --method cone -o picture.png", scene_of(row)));
    w.argument("--resolution", w.word("resolution"));
    w.argument("--cones", cones);
    w.argument("--step", w.word("step"));
    w.flag("--anisotropic", variant == "anisotropic");
  } else {
    w.command("luxel cone_trace --volume volume.npy --receivers receivers.npy -o irradiance.npy");
    w.argument("--variant", variant, "isotropic");
    w.argument("--format", w.format(), "f32");
    w.argument("--cones", classic ? "classic" : cones);
    w.argument("--footprint", w.word("footprint"));
    w.argument("--step-scale", w.word("step_scale"));
    w.argument("--error", w.word("error"), "0");
  }
  w.member("variant", "luxel::ConeVariant::" + variant);
  w.format_member();
  if (w.word("input") == "image") w.member("input", "luxel::Input::image");
  w.member("cones", classic ? "luxel::classic_cones()" : fmt::format("luxel::cone_set({}).value()", cones));
  w.member("footprint", w.word("footprint"));
  w.member("step_scale", w.word(rendered ? "step" : "step_scale"));
  w.member("error", w.word("error"));
  return w.done("cone_trace.h", "ConeTraceParams", "std::array<int, 3> extent, double voxel, int receivers",
                "  p.extent = extent;\n  p.voxel = voxel;\n  p.width = receivers;\n");
}

Spelled hiz_ssr(const Json& row) {
  Writer w(row);
  const std::string variant = row.at("variant");
  w.command("luxel hiz_ssr --depth depth.exr --color color.exr --normal normal.exr -o reflections.exr");
  w.argument("--variant", variant, "hiz");
  w.argument("--max-distance", w.word("max_distance"));
  w.argument("--steps", w.word("steps"));
  if (variant == "stochastic") w.argument("--rays", w.word("rays"));
  w.member("variant", "luxel::SsrVariant::" + variant);
  w.member("max_distance", w.word("max_distance"));
  w.member("steps", w.word("steps"));
  if (variant == "stochastic") w.member("rays_per_pixel", w.word("rays"));
  return w.done("hiz_ssr.h", "HizSsrParams", "int width, int height, double focal",
                image_size + "  p.focal_x = p.focal_y = focal;\n  p.centre_x = width / 2.0;\n  p.centre_y = height / 2.0;\n");
}

Spelled octahedral_march(const Json& row) {
  Writer w(row);
  w.command(fmt::format("luxel probes build --scene {} -o probes/", scene_of(row)));
  w.argument("--grid", w.word("grid"));
  w.argument("--resolution", w.word("resolution"));
  w.member("maps.size", w.word("resolution"));
  w.member("thickness", w.word("thickness"));
  w.member("bias", "1");
  if (w.word("normal") == "none") w.member("maps.normal", "luxel::ProbeNormal::none");
  return w.done("probe_trace.h", "ProbeTraceParams", "const luxel::ProbeGrid& grid, int rays", "  p.grid = grid;\n  p.rays = rays;\n");
}

Spelled probe_shade(const Json& row) {
  Writer w(row);
  const bool filtered = row.at("variant") != "plain";
  w.command(fmt::format("luxel render --scene {} --method probe -o picture.png", scene_of(row)));
  w.argument("--probes", w.word("probes"));
  w.argument("--probe-size", w.word("seen"));
  w.argument("--irradiance-size", w.word("irradiance"));
  w.argument("--distance-size", w.word("distances"), "0");
  w.flag("--unfiltered", !filtered);
  w.member("irradiance_size", w.word("irradiance"));
  if (filtered) w.member("moments_size", w.word("distances"));
  return w.done("probe_irradiance.h", "ProbeIrradianceParams", "const luxel::ProbeGrid& grid, const luxel::ProbeMaps& maps",
                "  p.grid = grid;\n  p.maps = maps;\n");
}

Spelled probe_irradiance(const Json& row) {
  Writer w(row);
  w.command(fmt::format("luxel render --scene {} --method probe -o picture.png", scene_of(row)));
  w.argument("--irradiance-size", w.word("irradiance"));
  w.argument("--distance-size", w.word("distances"));
  w.member("irradiance_size", w.word("irradiance"));
  w.member("moments_size", w.word("distances"));
  w.member("samples", w.word("averaged_to"));
  const bool half = w.word("format") == "f16";
  w.member("irradiance_format", half ? "luxel::Format::f16x4" : "luxel::Format::f32x4");
  w.member("moments_format", half ? "luxel::Format::f16x2" : "luxel::Format::f32x2");
  return w.done("probe_irradiance.h", "ProbeIrradianceParams", "const luxel::ProbeGrid& grid, const luxel::ProbeMaps& maps",
                "  p.grid = grid;\n  p.maps = maps;\n");
}

Spelled light_propagation(const Json& row) {
  Writer w(row);
  const std::string size = row.at("size");
  const bool scene = w.find("resolution") != nullptr;
  w.command(fmt::format("luxel render --scene {} --method lpv -o picture.png", scene ? scene_of(row) : "scene.glb"));
  w.argument("--cells", scene ? w.word("resolution") : size.substr(0, size.find('x')));
  w.argument("--steps", w.word(scene ? "steps" : "iterations"));
  w.argument("--lobes", row.at("variant"));
  w.argument("--bands", w.word("bands"));
  w.argument("--blockers", w.word("blockers"));
  w.argument("--cascades", w.word("cascades"));
  w.argument("--damping", w.word("damping"));
  w.argument("--lpv-filter", w.word("filter"));
  w.member("lobes", fmt::format("luxel::LpvLobes::{}", row.at("variant").get<std::string>()));
  w.member("bands", w.word("bands"));
  w.member("iterations", w.word(scene ? "steps" : "iterations"));
  w.member("channels", w.word("channels"));
  if (w.find("blockers")) w.member("geometry", w.word("blockers") == "none" ? "false" : "true");
  if (w.on("without injected")) w.member("keep_injected", "false");
  w.format_member();
  return w.done("light_propagation.h", "LpvPropagateParams", "const luxel::LpvGrid& grid", "  p.grid = grid;\n");
}

}  // namespace

Spelled spelled(const Json& row) {
  const std::string kernel = row.at("kernel");
  if (kernel == "gaussian_blur") return gaussian_blur(row);
  if (kernel == "bilateral") return bilateral(row);
  if (kernel == "mip_build") return mip_build(row);
  if (kernel == "voxelize") return voxelize(row);
  if (kernel == "cone_trace") return cone_trace(row);
  if (kernel == "hiz_ssr") return hiz_ssr(row);
  if (kernel == "octahedral_march") return octahedral_march(row);
  if (kernel == "probe_shade") return probe_shade(row);
  if (kernel == "probe_irradiance") return probe_irradiance(row);
  if (kernel == "light_propagation") return light_propagation(row);
  return {};
}

}  // namespace luxel::report

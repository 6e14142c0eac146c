#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <luxel/cone_trace.h>
#include <luxel/mip_build.h>

#include "bench/io/array.h"
#include "bench/io/pixels.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

struct Arguments {
  std::string volume, receivers, out, views, specular, device, variant, format, cones;
  std::vector<double> origin, environment;
  double voxel = 1, aperture = 0, footprint = 0.25, step_scale = 1, normal_offset = 1, start = 0, max_distance = 0, gamma = 0, error = 0;
  int levels = 0, pattern_x = 1, pattern_y = 1;
};

constexpr std::size_t longest_row = 1 << 20;

Status wrong_shape(const std::string& path, const std::vector<std::size_t>& shape, const char* expected) {
  return Status(Code::io, fmt::format("{}: has shape [{}]; expected {}", path, fmt::join(shape, "]["), expected));
}

// A list of `channels` values each, [n][channels].
Result<std::vector<float>> read_list(const std::string& path, std::size_t channels, const char* expected) {
  const Result<io::Array> array = io::read_npy(path);
  if (!array) return array.status();
  const std::vector<std::size_t>& shape = array.value().shape;
  if (shape.size() != 2 || shape[1] != channels || shape[0] == 0) return wrong_shape(path, shape, expected);
  return io::to_float(array.value());
}

// Receivers relative to the volume's corner, subtracted in double.
std::vector<float> rebased(std::vector<float> receivers, const std::vector<double>& origin) {
  for (std::size_t i = 0; i < receivers.size(); i += 8)
    for (std::size_t axis = 0; axis < 3; ++axis)
      receivers[i + axis] = static_cast<float>(static_cast<double>(receivers[i + axis]) - origin[axis]);
  return receivers;
}

Result<std::vector<Cone>> set_of(const Arguments& a) {
  const double aperture = a.aperture * std::numbers::pi / 180;
  if (a.cones != "classic") return cone_set(std::stoi(a.cones), aperture);
  std::vector<Cone> cones = classic_cones();
  if (aperture > 0)
    for (Cone& c : cones) c.aperture = aperture;
  return cones;
}

Result<ConeTraceParams> parameters(const Arguments& a, const std::vector<std::size_t>& shape, std::size_t receivers) {
  ConeTraceParams p;
  p.width = static_cast<int>(std::min(receivers, longest_row));
  p.height = static_cast<int>((receivers + longest_row - 1) / longest_row);
  for (std::size_t axis = 0; axis < 3; ++axis) p.extent[axis] = static_cast<int>(std::min<std::size_t>(shape[2 - axis], 1 << 20));
  p.levels = a.levels;
  p.variant = a.variant == "anisotropic" ? ConeVariant::anisotropic : ConeVariant::isotropic;
  p.format = storage_format(a.format, 4);
  p.voxel = a.voxel;
  Result<std::vector<Cone>> cones = set_of(a);
  if (!cones) return cones.status();
  p.cones = std::move(cones).value();
  p.pattern_x = a.pattern_x;
  p.pattern_y = a.pattern_y;
  p.footprint = a.footprint;
  p.step_scale = a.step_scale;
  p.normal_offset = a.normal_offset;
  p.start = a.start;
  p.max_distance = a.max_distance;
  p.gamma = a.gamma;
  std::copy(a.environment.begin(), a.environment.end(), p.environment.begin());
  p.error = a.error;
  p.specular = !a.specular.empty();
  p.count = true;
  if (Status s = validate(p); !s) return s;
  return p;
}

// All coarse levels in one piece, as cone_trace wants them.
Status add_coarse(Context& context, const ConeTraceParams& p, ResourceData& data, Times& times) {
  if (cone_trace_levels(p) == 1) return {};
  const bool directional = p.variant == ConeVariant::anisotropic;
  MipBuildParams m;
  m.width = p.extent[0];
  m.height = p.extent[1];
  m.depth = p.extent[2];
  m.levels = cone_trace_levels(p) - 1;
  m.variant = directional ? MipVariant::anisotropic : MipVariant::isotropic;
  m.format = p.format;
  const Result<Plan> plan = luxel::plan(m, context.profile());
  if (!plan) return plan.status();
  ResourceData levels{{mip_level_name(0), data["fine"]}};
  if (Status s = run_plan(context, plan.value(), levels, times); !s) return s;
  const std::size_t texel = context.real64() ? 32 : bytes_per_pixel(p.format);
  std::vector<std::uint8_t>& coarse = data["coarse"];
  coarse.resize(cone_trace_coarse_texels(p) * texel);
  for (int level = 1; level < cone_trace_levels(p); ++level)
    for (int d = 0; d < (directional ? 6 : 1); ++d) {
      const std::vector<std::uint8_t>& from = levels[mip_level_name(level, directional ? d : -1)];
      std::copy(from.begin(), from.end(),
                coarse.begin() + static_cast<std::ptrdiff_t>(cone_trace_level_offset(p, level, d) * texel));
    }
  return {};
}

Status write_result(const std::string& path, const std::vector<std::uint8_t>& bytes, std::size_t count, bool real64) {
  std::vector<float> values = io::unpack(bytes, Format::f32x4, real64, 4);
  values.resize(count * 4);
  return io::write_npy(path, io::make_array({count, 4}, values));
}

std::string outcomes_text(const std::vector<std::uint8_t>& bytes) {
  std::array<std::uint32_t, cone_outcomes> n{};
  std::memcpy(n.data(), bytes.data(), sizeof n);
  std::string text = fmt::format("; {} cones: {} blocked, {} left the volume, {} at the distance, {} missed it", n[0],
                                 n[1], n[2], n[3], n[5]);
  if (n[4] > 0) text += fmt::format(", {} at the step cap", n[4]);
  if (n[6] > 0) text += fmt::format("; {} were not finite", n[6]);
  if (n[7] > 0) text += fmt::format("; {} receivers without a normal or place", n[7]);
  return text;
}

int run(const Arguments& a) {
  const Result<io::Array> volume = io::read_npy(a.volume);
  if (!volume) return complain(volume.status(), true);
  const std::vector<std::size_t>& shape = volume.value().shape;
  if (shape.size() != 4 || shape[3] != 4)
    return complain(wrong_shape(a.volume, shape, "[z][y][x][4], premultiplied radiance and opacity"), true);
  Result<std::vector<float>> list = read_list(a.receivers, 8, "[n][8], position, roughness, normal, 0");
  if (!list) return complain(list.status(), true);
  const std::size_t count = list.value().size() / 8;
  const Result<ConeTraceParams> made = parameters(a, shape, count);
  if (!made) return complain(made.status());
  const ConeTraceParams& p = made.value();

  const auto opened = open_device(a.device);
  if (!opened) return complain(opened.status());
  Context& context = *opened.value();
  const Result<Plan> plan = luxel::plan(p, context.profile());
  if (!plan) return complain(plan.status());
  std::vector<float> receivers = rebased(std::move(list).value(), a.origin);
  const std::size_t rows = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  receivers.resize(rows * 8);  // those that fill the last row have no normal
  ResourceData data{{"fine", io::pack(io::to_float(volume.value()), 4, p.format, context.real64())},
                    {"receivers", io::pack(receivers, 4, Format::f32x4, context.real64())},
                    {"counters", std::vector<std::uint8_t>(cone_outcomes * 4)}};
  if (p.specular) {
    Result<std::vector<float>> views = read_list(a.views, 4, "[n][4], direction to the eye, 0");
    if (!views) return complain(views.status(), true);
    if (views.value().size() != count * 4)
      return complain(fmt::format("{}: has {} rows; expected the {} of {}", a.views, views.value().size() / 4, count, a.receivers), misused);
    views.value().resize(rows * 4);
    data["views"] = io::pack(views.value(), 4, Format::f32x4, context.real64());
  }
  Times build, gather;
  if (Status s = add_coarse(context, p, data, build); !s) return complain(s.message(), failed);
  if (Status s = run_plan(context, plan.value(), data, gather); !s) return complain(s.message(), failed);
  std::uint32_t padded = 0;  // counted as receivers without a normal: not the file's
  std::memcpy(&padded, data["counters"].data() + 28, 4);
  padded -= static_cast<std::uint32_t>((rows - count) * (p.specular ? 2 : 1));
  std::memcpy(data["counters"].data() + 28, &padded, 4);

  if (Status s = write_result(a.out, data["irradiance"], count, context.real64()); !s) return complain(s);
  if (p.specular)
    if (Status s = write_result(a.specular, data["specular"], count, context.real64()); !s) return complain(s);
  fmt::print("cone_trace {} {} {}x{}x{}, {} levels, {} cones, {} receivers on {}: build {}, gather {}; wrote {}{}{}\n",
             a.variant, name(p.format), p.extent[0], p.extent[1], p.extent[2], cone_trace_levels(p), p.cones.size(),
             count, context.info().id, time_text(build), time_text(gather), a.out,
             p.specular ? " and " + a.specular : "", outcomes_text(data["counters"]));
  return done;
}

}  // namespace

void add_cone_trace(CLI::App& app, int& exit_status) {
  const Kernel& k = kernel("cone_trace");
  CLI::App* command = app.add_subcommand("cone_trace", "gather irradiance and ambient occlusion from voxels by cones");
  auto a = std::make_shared<Arguments>();
  command
      ->add_option("--volume", a->volume,
                   "finest level, .npy of shape [z][y][x][4]: premultiplied radiance and opacity; the coarser levels are "
                   "built")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--receivers", a->receivers, ".npy of shape [n][8]: position, roughness, normal, 0")
      ->required()
      ->type_name("FILE");
  command->add_option("-o,--out", a->out, ".npy of shape [n][4]: irradiance and visibility, float32")
      ->required()
      ->type_name("FILE");
  const auto vector_of = [&](const char* name, std::vector<double>& value, const char* help, const char* names) {
    value = {0, 0, 0};
    command->add_option(name, value, help)->type_name(names)->delimiter(',')->expected(3);
  };
  vector_of("--origin", a->origin, "outer corner of voxel (0,0,0), scene units; default 0,0,0", "X,Y,Z");
  vector_of("--environment", a->environment, "radiance that unblocked cones end in, 0..1e30; default 0,0,0", "R,G,B");
  CLI::Option* views =
      command->add_option("--views", a->views, ".npy of shape [n][4]: direction to the eye, 0")->type_name("FILE");
  CLI::Option* specular =
      command
          ->add_option("--specular", a->specular,
                       ".npy of shape [n][4] to write: mean radiance and visibility of a cone that follows the roughness")
          ->type_name("FILE");
  specular->needs(views);
  views->needs(specular);
  add_variant(*command, k, a->variant);
  add_choice(*command, k, "--format", a->format);
  add_choice(*command, k, "--cones", a->cones);
  for (const auto& [name, value] :
       {std::pair{"--voxel", &a->voxel}, {"--aperture", &a->aperture},
        {"--footprint", &a->footprint}, {"--step-scale", &a->step_scale},
        {"--normal-offset", &a->normal_offset}, {"--start", &a->start}, {"--max-distance", &a->max_distance},
        {"--gamma", &a->gamma}, {"--error", &a->error}})
    add_number(*command, k, name, *value);
  for (const auto& [name, value] :
       {std::pair{"--levels", &a->levels}, {"--pattern-x", &a->pattern_x}, {"--pattern-y", &a->pattern_y}})
    add_number(*command, k, name, *value);
  add_device_option(*command, a->device);
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

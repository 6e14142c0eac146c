#include "tests/cases/mip_build_cases.h"

#include <cmath>

#include "bench/scene/images.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::cases {

const char* name(MipVariant v) {
  static const char* const names[] = {"isotropic", "anisotropic", "gaussian3", "min", "max", "minmax", "moments"};
  return names[static_cast<int>(v)];
}

MipBuildParams mip_params(MipVariant variant, Format format, std::array<int, 3> extent) {
  MipBuildParams p;
  p.variant = variant;
  p.format = format;
  p.width = extent[0];
  p.height = extent[1];
  p.depth = extent[2];
  return p;
}

Format finest_format(const MipBuildParams& p) {
  const bool two = p.variant == MipVariant::minmax || p.variant == MipVariant::moments;
  return two && !p.pairs ? Format::f32x1 : p.format;
}

std::vector<std::string> mip_names(const MipBuildParams& p) {
  std::vector<std::string> names;
  for (int level = 1; level <= mip_levels(p); ++level) {
    if (p.variant != MipVariant::anisotropic) names.push_back(mip_level_name(level));
    for (int direction = 0; direction < 6 && p.variant == MipVariant::anisotropic; ++direction)
      if (p.directions >> direction & 1) names.push_back(mip_level_name(level, direction));
  }
  return names;
}

int level_of(const std::string& name) { return std::stoi(name.substr(6)); }

int direction_of(const std::string& name) {
  for (int d = 0; d < 6; ++d)
    if (name.ends_with(mip_level_name(0, d).substr(7))) return d;
  return -1;
}

Result<Pyramid> build(Context& context, const MipBuildParams& params, std::span<const double> level_0,
                      bool single_pass) {
  Profile profile = context.profile();
  profile.workgroup_memory = single_pass;
  Result<Run> made = Run::make(context, plan(params, profile));
  if (!made) return made.status();
  Run& run = made.value();
  if (Status status = run.write("level_0", level_0); !status) return status;
  if (Status status = run.go(); !status) return status;
  Pyramid pyramid;
  for (const std::string& name : mip_names(params)) {
    Result<Values> level = run.read(name);
    if (!level) return level.status();
    pyramid[name] = std::move(level).value();
  }
  return pyramid;
}

Values mip_colours(std::size_t texels, int channels, std::uint32_t seed) {
  Values values(texels * channels);
  for (std::size_t i = 0; i < texels; ++i) {
    const auto n = static_cast<std::uint32_t>(i) * 8;
    const double kind = scene::random01(n + 7, seed);
    const double a = kind < 0.3 ? 0.0 : kind < 0.5 ? 1.0 : scene::random01(n, seed);
    for (int c = 0; c < channels; ++c) {
      const double v = scene::random01(n + 1 + c, seed);
      // Emission is dim, so that no sum in front of an opaque voxel saturates unorm8.
      values[i * channels + c] = static_cast<float>(channels < 4  ? v
                                                    : c == 3      ? a
                                                    : kind < 0.05 ? 0.1 * v
                                                                  : 0.8 * a * v);
    }
  }
  return values;
}

Values mip_distances(std::size_t texels, std::uint32_t seed) {
  Values values(texels);
  for (std::size_t i = 0; i < texels; ++i)
    values[i] = static_cast<float>(0.1 * std::exp2(13.3 * scene::random01(static_cast<std::uint32_t>(i), seed)));
  return values;
}

Values mip_input(const MipBuildParams& p, std::uint32_t seed) {
  const auto e = mip_extent(p, 0);
  const std::size_t texels = static_cast<std::size_t>(e[0]) * e[1] * e[2];
  const Format format = finest_format(p);
  return quantise(
      p.variant >= MipVariant::min ? mip_distances(texels, seed) : mip_colours(texels, channels(format), seed), format);
}

std::vector<Case> mip_build_cases() {
  std::vector<Case> cases;
  add_mip_value_cases(cases);
  add_mip_size_cases(cases);
  add_mip_bound_cases(cases);
  add_mip_wall_cases(cases);
  for (Case& c : cases) c.kernel = "mip_build";
  return cases;
}

}  // namespace luxel::cases

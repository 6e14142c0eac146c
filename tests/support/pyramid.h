// Pyramids on a device, for tests: level 0 in, every level out.
#pragma once
#include <map>
#include <optional>

#include <luxel/mip_build.h>

#include "tests/support/run.h"

namespace luxel {

/// Levels as stored, by the names of the plan's resources.
using Levels = std::map<std::string, Bytes>;

/// The names of what a plan with these parameters writes.
inline std::vector<std::string> level_names(const MipBuildParams& p) {
  std::vector<std::string> names;
  for (int level = 1; level <= mip_levels(p); ++level) {
    if (p.variant != MipVariant::anisotropic) {
      names.push_back(mip_level_name(level));
      continue;
    }
    for (int direction = 0; direction < 6; ++direction)
      if (p.directions >> direction & 1) names.push_back(mip_level_name(level, direction));
  }
  return names;
}

/// The format of level 0.
inline Format finest_format(const MipBuildParams& p) {
  const bool two = p.variant == MipVariant::minmax || p.variant == MipVariant::moments;
  return two && !p.pairs ? Format::f32x1 : p.format;
}

inline std::size_t texels(const std::array<int, 3>& e) { return static_cast<std::size_t>(e[0]) * e[1] * e[2]; }

/// Builds the levels. `tiled`: with workgroup memory or without, whatever the device's profile says.
inline Levels build_levels(Context& context, const MipBuildParams& p, const Bytes& level_0, std::optional<bool> tiled = {}) {
  Profile profile = context.profile();
  if (tiled) profile.workgroup_memory = *tiled;
  const Result<Plan> made = plan(p, profile);
  if (!made) throw std::runtime_error(made.status().message());
  const std::vector<std::string> names = level_names(p);
  std::vector<std::string> wanted = names;
  NamedBytes inputs{{"level_0", level_0}};
  if (p.count) {
    wanted.push_back("counters");
    inputs.emplace_back("counters", Bytes(16, 0));
  }
  const std::vector<Bytes> outputs = run_bytes(context, made.value(), inputs, wanted);
  Levels levels;
  for (std::size_t i = 0; i < wanted.size(); ++i) levels[wanted[i]] = outputs[i];
  return levels;
}

}  // namespace luxel

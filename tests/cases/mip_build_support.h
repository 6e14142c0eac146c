// What the cases of mip_build share.
#pragma once
#include <map>
#include <span>
#include <string>
#include <vector>

#include <luxel/mip_build.h>

#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

const char* name(MipVariant variant);

/// Parameters by what the cases vary.
MipBuildParams mip_params(MipVariant variant, Format format, std::array<int, 3> extent);

/// The format of level 0.
Format finest_format(const MipBuildParams& params);

/// What a plan with these parameters writes, by name.
std::vector<std::string> mip_names(const MipBuildParams& params);
int level_of(const std::string& name);
int direction_of(const std::string& name);  // -1: none

/// Channel values of every level that is made, by the names of the plan's resources.
using Pyramid = std::map<std::string, Values>;

/// Builds the levels on a device. `single_pass`: several levels a dispatch, where the form exists.
Result<Pyramid> build(Context& context, const MipBuildParams& params, std::span<const double> level_0,
                      bool single_pass = false);

/// Premultiplied colour of all kinds (empty, opaque, in between, emission without opacity); one or two channels: plain
/// noise.
Values mip_colours(std::size_t texels, int channels, std::uint32_t seed);

/// Distances from 0.1 to 1000, their logarithms uniform.
Values mip_distances(std::size_t texels, std::uint32_t seed);

/// Level 0 for a variant, as its format holds it.
Values mip_input(const MipBuildParams& params, std::uint32_t seed);

/// Cases in these files, in the order of mip_build_cases().
void add_mip_value_cases(std::vector<Case>& cases);
void add_mip_size_cases(std::vector<Case>& cases);
void add_mip_bound_cases(std::vector<Case>& cases);
void add_mip_wall_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

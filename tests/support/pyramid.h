// Pyramids on a device, for tests: parameters, inputs, level 0 in, every level out.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <ostream>

#include <luxel/mip_build.h>

#include "tests/support/run.h"

namespace luxel {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr MipVariant colour_variants[] = {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3};
constexpr Format colour_formats[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};

MipBuildParams params(MipVariant variant, Format format, std::array<int, 3> extent);
std::string text(const MipBuildParams& p);
void PrintTo(const MipBuildParams& p, std::ostream* out);

/// The format of level 0, and texels of an extent.
Format finest_format(const MipBuildParams& p);
std::size_t texels(const std::array<int, 3>& extent);

/// 0 up to 1 from a hash, so that numbers are the same with every standard library.
float uniform(std::uint32_t i);

/// Premultiplied colour of all kinds: empty, opaque, in between, and emission without opacity; so dim that no sum in front of
/// an opaque voxel saturates unorm8.
std::vector<float> colours(std::size_t texels, int channels, std::uint32_t seed = 1);

/// Level 0 for a variant: colours, or distances from 0.1 to 1000 and pairs of them.
std::vector<float> level_0_values(const MipBuildParams& p, std::uint32_t seed = 1);

/// Levels as stored, by the names of the plan's resources.
using Levels = std::map<std::string, Bytes>;

/// The names of what a plan with these parameters writes, and what a name says (direction -1: none).
std::vector<std::string> level_names(const MipBuildParams& p);
int level_of(const std::string& name);
int direction_of(const std::string& name);

/// Builds the levels (and `counters`, from 0). `tiled`: with workgroup memory or without, whatever the device's profile says.
Levels build_levels(Context& context, const MipBuildParams& p, const Bytes& level_0, std::optional<bool> tiled = {});

/// False where a device has no images of level 0's format.
bool supported(Context& context, const MipBuildParams& p);

void expect_same(const Levels& a, const Levels& b, const std::string& what);

/// Distance from |v| to the next larger value of a format.
double step(Format format, double v);

/// Calls f(context, params, tiled) on all devices, with level 0 as buffer and as image, in the plain and the tiled form.
template <class F>
void on_every_way(MipBuildParams p, F f) {
  for (const std::string& device : test_devices())
    for (const Input input : {Input::buffer, Input::image})
      for (const bool tiled : {false, true}) {
        if (tiled && (p.variant == MipVariant::anisotropic || p.variant == MipVariant::gaussian3)) continue;
        p.input = input;
        SCOPED_TRACE(device + " " + text(p) + (tiled ? " tiled" : ""));
        if (supported(test_context(device), p)) f(test_context(device), p, tiled);
      }
}

}  // namespace luxel

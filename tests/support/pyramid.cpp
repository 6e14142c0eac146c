#include "tests/support/pyramid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace luxel {
namespace {

std::uint32_t mixed(std::uint32_t v) {
  v ^= v >> 16;
  v *= 0x7feb352du;
  v ^= v >> 15;
  v *= 0x846ca68bu;
  return v ^ (v >> 16);
}

const char* text(MipVariant v) {
  constexpr const char* names[] = {"isotropic", "anisotropic", "gaussian3", "min", "max", "minmax", "moments"};
  return names[static_cast<int>(v)];
}

// Distances from 0.1 to 1000, and pairs of them: ordered bounds, or mean and standard deviation.
std::vector<float> distances(std::size_t texels, const MipBuildParams& p, std::uint32_t seed) {
  std::vector<float> values;
  for (std::size_t i = 0; i < texels; ++i) {
    const auto n = static_cast<std::uint32_t>(i) * 4 + seed * 0x9e3779b9u;
    const float v = 0.1f * std::exp2(uniform(n) * 13.3f);
    values.push_back(v);
    if (channels(finest_format(p)) == 2)
      values.push_back(p.variant == MipVariant::minmax ? v * (1 + uniform(n + 1)) : v * uniform(n + 1));
  }
  return values;
}

}  // namespace

MipBuildParams params(MipVariant variant, Format format, std::array<int, 3> extent) {
  MipBuildParams p;
  p.variant = variant;
  p.format = format;
  p.width = extent[0];
  p.height = extent[1];
  p.depth = extent[2];
  return p;
}

std::string text(const MipBuildParams& p) {
  std::string s =
      std::string(text(p.variant)).append("_").append(name(p.format)).append("_").append(std::to_string(p.width));
  s.append("x").append(std::to_string(p.height));
  if (p.depth > 1) s.append("x").append(std::to_string(p.depth));
  if (p.sizes == MipSizes::ceil) s += "_ceil";
  if (p.ratio == 16) s += "_ratio16";
  if (p.pairs) s += "_pairs";
  if (p.samples == MipSamples::vertices) s += "_vertices";
  if (p.input == Input::image) s += "_image";
  return s;
}

void PrintTo(const MipBuildParams& p, std::ostream* out) { *out << text(p); }

Format finest_format(const MipBuildParams& p) {
  const bool two = p.variant == MipVariant::minmax || p.variant == MipVariant::moments;
  return two && !p.pairs ? Format::f32x1 : p.format;
}

std::size_t texels(const std::array<int, 3>& e) { return static_cast<std::size_t>(e[0]) * e[1] * e[2]; }

float uniform(std::uint32_t i) { return static_cast<float>(mixed(i) >> 8) * 0x1p-24f; }

std::vector<float> colours(std::size_t texels, int channels, std::uint32_t seed) {
  std::vector<float> values(texels * channels);
  for (std::size_t i = 0; i < texels; ++i) {
    const auto n = static_cast<std::uint32_t>(i) * 8 + seed * 0x9e3779b9u;
    const float kind = uniform(n + 7);
    const float a = kind < 0.3f ? 0.0f : kind < 0.5f ? 1.0f : uniform(n);
    for (int c = 0; c < channels; ++c) {
      const float v = uniform(n + 1 + c);
      values[i * channels + c] = channels < 4 ? v : c == 3 ? a : kind < 0.05f ? 0.1f * v : 0.8f * a * v;
    }
  }
  return values;
}

std::vector<float> level_0_values(const MipBuildParams& p, std::uint32_t seed) {
  const std::size_t count = texels(mip_extent(p, 0));
  const bool depth = p.variant >= MipVariant::min;
  return depth ? distances(count, p, seed) : colours(count, channels(p.format), seed);
}

std::vector<std::string> level_names(const MipBuildParams& p) {
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

int level_of(const std::string& name) { return std::stoi(name.substr(6)); }

int direction_of(const std::string& name) {
  for (int d = 0; d < 6; ++d)
    if (name.ends_with(mip_level_name(0, d).substr(7))) return d;
  return -1;
}

Levels build_levels(Context& context, const MipBuildParams& p, const Bytes& level_0, std::optional<bool> tiled) {
  Profile profile = context.profile();
  if (tiled) profile.workgroup_memory = *tiled;
  const Result<Plan> made = plan(p, profile);
  if (!made) throw std::runtime_error(made.status().message());
  std::vector<std::string> wanted = level_names(p);
  NamedBytes inputs{{"level_0", level_0}};
  if (p.count) {
    wanted.push_back("counters");
    inputs.emplace_back("counters", Bytes(16, 0));
  }
  std::vector<Bytes> outputs = run_bytes(context, made.value(), inputs, wanted);
  Levels levels;
  for (std::size_t i = 0; i < wanted.size(); ++i) levels[wanted[i]] = std::move(outputs[i]);
  return levels;
}

bool supported(Context& context, const MipBuildParams& p) {
  const Result<Plan> made = plan(p, context.profile());
  return made && context.compile(made.value()).status().code() != Code::unsupported;
}

void expect_same(const Levels& a, const Levels& b, const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (const auto& [name, bytes] : a) {
    const Bytes& other = b.at(name);
    ASSERT_EQ(bytes.size(), other.size()) << what << " " << name;
    const auto differ = std::mismatch(bytes.begin(), bytes.end(), other.begin()).first;
    EXPECT_EQ(differ, bytes.end()) << what << ": " << name << " differs first in byte " << differ - bytes.begin();
  }
}

double step(Format format, double v) {
  if (format == Format::unorm8x4) return 1.0 / 255;
  const bool half = format == Format::f16x2 || format == Format::f16x4;
  const int least = half ? -14 : -126, digits = half ? 10 : 23;
  return std::ldexp(1.0, std::max(v == 0 ? least : std::ilogb(v), least) - digits);
}

}  // namespace luxel

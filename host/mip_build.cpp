#include <luxel/mip_build.h>

#include <algorithm>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

using Extent = std::array<int, 3>;

constexpr const char* axis_fields[3] = {"MipBuildParams.width", "MipBuildParams.height", "MipBuildParams.depth"};
constexpr const char* direction_names[6] = {"px", "nx", "py", "ny", "pz", "nz"};

// kernels/math/mip.h
enum Mode { copy, pair, triple, vertex, smooth, smooth_odd };

bool bounds(MipVariant v) { return v == MipVariant::min || v == MipVariant::max || v == MipVariant::minmax; }
bool two_dimensional(MipVariant v) { return bounds(v) || v == MipVariant::moments; }

const char* name(MipVariant v) {
  constexpr const char* names[] = {"isotropic", "anisotropic", "gaussian3", "min", "max", "minmax", "moments"};
  return names[static_cast<int>(v)];
}

const char* formats_of(MipVariant v) {
  switch (v) {
    case MipVariant::isotropic:
    case MipVariant::gaussian3: return "f32x1, f32x4, f16x4 or unorm8x4";
    case MipVariant::anisotropic: return "f32x4, f16x4 or unorm8x4";
    case MipVariant::min:
    case MipVariant::max: return "f32x1";
    default: return "f32x2 or f16x2";
  }
}

bool takes(MipVariant v, Format f) {
  switch (v) {
    case MipVariant::isotropic:
    case MipVariant::gaussian3:
      return f == Format::f32x1 || f == Format::f32x4 || f == Format::f16x4 || f == Format::unorm8x4;
    case MipVariant::anisotropic: return f == Format::f32x4 || f == Format::f16x4 || f == Format::unorm8x4;
    case MipVariant::min:
    case MipVariant::max: return f == Format::f32x1;
    default: return f == Format::f32x2 || f == Format::f16x2;
  }
}

Format format_of_level_0(const MipBuildParams& p) {
  const bool two = p.variant == MipVariant::minmax || p.variant == MipVariant::moments;
  return two && !p.pairs ? Format::f32x1 : p.format;
}

int coarser(const MipBuildParams& p, int n) {
  if (n == 1) return 1;
  if (bounds(p.variant)) return p.sizes == MipSizes::ceil ? (n + p.ratio - 1) / p.ratio : std::max(1, n / p.ratio);
  return p.variant == MipVariant::gaussian3 && p.samples == MipSamples::vertices && n > 2 ? (n + 1) / 2 : n / 2;
}

Mode mode_of(const MipBuildParams& p, int n) {
  if (n == 1) return copy;
  if (p.variant != MipVariant::gaussian3) return n % 2 == 0 ? pair : triple;
  if (p.samples == MipSamples::vertices) return n == 2 ? pair : vertex;
  return n % 2 == 0 ? smooth : smooth_odd;
}

bool finished(const Extent& e) { return e[0] == 1 && e[1] == 1 && e[2] == 1; }

int highest_level(const MipBuildParams& p) {
  if (p.ratio == 16) return 1;
  Extent e{p.width, p.height, p.depth};
  int level = 0;
  while (!finished(e)) {
    for (int& n : e) n = coarser(p, n);
    ++level;
  }
  return level;
}

Status only_for(bool chosen, const char* field, const char* value, const std::string& expected) {
  return chosen ? out_of_range(field, value, expected) : Status();
}

// Everything that decides how often work is repeated; fields that a variant does not have must be left alone.
Status check_choices(const MipBuildParams& p) {
  const std::string of = std::string(" for variant ") + name(p.variant);
  const bool two = p.variant == MipVariant::minmax || p.variant == MipVariant::moments;
  LUXEL_CHECK(only_for(p.pairs && !two, "MipBuildParams.pairs", "true", "false" + of));
  LUXEL_CHECK(only_for(p.sizes == MipSizes::ceil && !bounds(p.variant), "MipBuildParams.sizes", "ceil", "floor" + of));
  if (p.ratio != 2 && !(p.ratio == 16 && bounds(p.variant)))
    return out_of_range("MipBuildParams.ratio", p.ratio, (bounds(p.variant) ? "2 or 16" : "2") + of);
  LUXEL_CHECK(only_for(p.samples == MipSamples::vertices && p.variant != MipVariant::gaussian3,
                       "MipBuildParams.samples", "vertices", "cells" + of));
  if (p.variant == MipVariant::anisotropic)
    LUXEL_CHECK(check_range("MipBuildParams.directions", p.directions, 1u, static_cast<unsigned>(mip_all)));
  else if (p.directions != mip_all)
    return out_of_range("MipBuildParams.directions", p.directions, "63" + of);
  return only_for(p.count && p.format == Format::unorm8x4, "MipBuildParams.count", "true",
                  "false for unorm8x4, which holds neither NaN nor infinities");
}

// Vertices leave no gap only where an extent is odd, 1 or 2.
Status check_vertices(const MipBuildParams& p, int levels) {
  if (p.samples != MipSamples::vertices) return {};
  Extent e{p.width, p.height, p.depth};
  for (int level = 0; level < levels; ++level)
    for (int axis = 0; axis < 3; ++axis) {
      if (e[axis] > 2 && e[axis] % 2 == 0)
        return out_of_range(
            axis_fields[axis],
            axis == 0   ? p.width
            : axis == 1 ? p.height
                        : p.depth,
            "an extent that is odd, 1 or 2 at every level that is halved (samples on vertices); level " +
                std::to_string(level) + " has " + std::to_string(e[axis]) +
                (level > 0 ? "; or MipBuildParams.levels of 1.." + std::to_string(level) : ""));
      e[axis] = coarser(p, e[axis]);
    }
  return {};
}

}  // namespace

std::string mip_level_name(int level, int direction) {
  const std::string text = "level_" + std::to_string(level);
  return direction < 0 ? text : text + "_" + direction_names[direction];
}

std::array<int, 3> mip_extent(const MipBuildParams& p, int level) {
  Extent e{p.width, p.height, p.depth};
  for (; level > 0; --level)
    for (int& n : e) n = coarser(p, n);
  return e;
}

int mip_levels(const MipBuildParams& p) { return p.levels > 0 ? p.levels : highest_level(p); }

Status validate(const MipBuildParams& p) {
  LUXEL_CHECK(check_range(axis_fields[0], p.width, 1, 65535));
  LUXEL_CHECK(check_range(axis_fields[1], p.height, 1, 65535));
  LUXEL_CHECK(check_range(axis_fields[2], p.depth, 1, 65535));
  LUXEL_CHECK(check_range("MipBuildParams.variant", static_cast<int>(p.variant), 0, 6));
  LUXEL_CHECK(check_range("MipBuildParams.input", static_cast<int>(p.input), 0, 1));
  LUXEL_CHECK(check_range("MipBuildParams.sizes", static_cast<int>(p.sizes), 0, 1));
  LUXEL_CHECK(check_range("MipBuildParams.samples", static_cast<int>(p.samples), 0, 1));
  if (two_dimensional(p.variant) && p.depth != 1)
    return out_of_range(axis_fields[2], p.depth, std::string("1 for variant ") + name(p.variant));
  if (!takes(p.variant, p.format))
    return out_of_range("MipBuildParams.format", luxel::name(p.format),
                        formats_of(p.variant) + std::string(" for variant ") + name(p.variant));
  LUXEL_CHECK(check_choices(p));
  const double values = static_cast<double>(p.width) * p.height * p.depth * channels(p.format);
  if (values > 0x7fffffff)
    return out_of_range(axis_fields[1], p.height, "width x height x depth x channels of at most 2147483647");
  if (finished({p.width, p.height, p.depth}))
    return out_of_range(axis_fields[0], p.width, "a level 0 of more than one texel");
  LUXEL_CHECK(check_range("MipBuildParams.levels", p.levels, 0, highest_level(p)));
  return check_vertices(p, mip_levels(p));
}

namespace {

// Makes the plan's passes, level by level.
class Pyramid {
 public:
  Pyramid(const MipBuildParams& params, const Profile& profile)
      : p_(params), profile_(profile), levels_(mip_levels(params)), planner_("mip_build") {
    Resource finest{mip_level_name(0)};
    finest.format = format_of_level_0(p_);
    finest.extent = mip_extent(p_, 0);
    if (p_.input == Input::image)
      finest.kind = ResourceKind::image;
    else
      finest.bytes = bytes_of(0, finest.format);
    slots_.push_back(planner_.resource(finest));
    for (int level = 1; level <= levels_; ++level) {
      if (p_.variant != MipVariant::anisotropic) {
        slots_.push_back(written(level, -1));
        continue;
      }
      for (int direction = 0; direction < 6; ++direction)
        slots_.push_back(p_.directions >> direction & 1 ? written(level, direction) : Slot{});
    }
  }

  Result<Plan> plan() && {
    if (p_.count) count();
    for (int level = 1; level <= levels_;) {
      const int made = p_.variant == MipVariant::anisotropic ? directional(level)
                       : p_.variant == MipVariant::moments   ? moments(level)
                       : bounds(p_.variant)                  ? bounds_of(level)
                                                             : average(level);
      level += made;
    }
    return std::move(planner_).finish();
  }

 private:
  double texels(int level) const {
    const Extent e = mip_extent(p_, level);
    return static_cast<double>(e[0]) * e[1] * e[2];
  }
  std::size_t bytes_of(int level, Format format) const {
    return static_cast<std::size_t>(texels(level)) * bytes_per_pixel(format);
  }
  Slot written(int level, int direction) {
    Resource resource{mip_level_name(level, direction)};
    resource.format = p_.format;
    resource.bytes = bytes_of(level, p_.format);
    resource.written = true;
    return planner_.resource(resource);
  }
  Slot slot(int level, int direction = -1) const {
    if (level == 0) return slots_[0];
    return p_.variant == MipVariant::anisotropic ? slots_[(level - 1) * 6 + 1 + direction] : slots_[level];
  }

  // The module that reads a level of `from` and writes `to`. `texels`: whether it can read texel buffers.
  std::string module(int level, Format from, Format to, bool texels) const {
    const bool image = level == 0 && p_.input == Input::image;
    std::string text = image ? (p_.depth > 1 ? "volume_" : "image_") : texels && profile_.texels ? "texels_" : "";
    text += luxel::name(from);
    return from == to ? text : text + "_" + luxel::name(to);
  }
  std::string label(const std::string& what, int level) const {
    return "mip_build " + what + " " + std::to_string(level);
  }

  void cost(int level, int made, Format from, double flops_per_texel) {
    double bytes = texels(level - 1) * static_cast<double>(bytes_per_pixel(from));
    double flops = 0;
    for (int l = level; l < level + made; ++l) {
      bytes += texels(l) * static_cast<double>(bytes_per_pixel(p_.format));
      flops += texels(l) * flops_per_texel;
    }
    planner_.cost(flops, bytes);
  }

  static std::array<std::uint32_t, 3> invocations(const Extent& e) {
    return {static_cast<std::uint32_t>(e[0]), static_cast<std::uint32_t>(e[1]), static_cast<std::uint32_t>(e[2])};
  }

  // Whether levels level .. level+2 can come from one dispatch of workgroups: any sizes that are rounded up, else those
  // that halve without a rest.
  bool tiles(int level) const {
    if (!profile_.workgroup_memory || level + 2 > levels_) return false;
    if (bounds(p_.variant) && p_.ratio != 2) return false;
    if (p_.variant == MipVariant::gaussian3) return false;
    if (bounds(p_.variant) && p_.sizes == MipSizes::ceil) return true;
    for (int l = level - 1; l < level + 2; ++l)
      for (const int n : mip_extent(p_, l))
        if (n > 1 && n % 2 == 1) return false;
    return true;
  }

  void count() {
    Resource counters{"counters"};
    counters.format = Format::u32;
    counters.bytes = 16;
    counters.written = true;
    const Slot to = planner_.resource(counters);
    const Format from = format_of_level_0(p_);
    const Extent e = mip_extent(p_, 0);
    planner_.pass("mip_count", module(0, from, from, false), "mip_build count", invocations(e),
                  profile_.voxels.workgroup, {{"src_x", e[0]}, {"src_y", e[1]}, {"src_z", e[2]}},
                  {{"HIDDEN", channels(from) == 4}}, {{"src", slot(0)}, {"counters", to}});
    planner_.cost(0, texels(0) * static_cast<double>(bytes_per_pixel(from)));
  }

  int average(int level) {
    const Extent s = mip_extent(p_, level - 1), d = mip_extent(p_, level);
    const double taps = 8.0 * channels(p_.format);
    const int clean = level == 1 && channels(p_.format) == 4;
    if (tiles(level)) {
      const Extent tile = p_.depth > 1 ? Extent{8, 8, 8} : Extent{16, 16, 1};
      planner_.pass(
          "mip_average_tile", module(level - 1, p_.format, p_.format, false),
          label("average, three levels from", level), invocations(d), invocations(tile),
          {{"src_x", s[0]}, {"src_y", s[1]}, {"src_z", s[2]}, {"clean", clean}},
          {{"TILE_X", tile[0]}, {"TILE_Y", tile[1]}, {"TILE_Z", tile[2]}},
          {{"src", slot(level - 1)}, {"dst_a", slot(level)}, {"dst_b", slot(level + 1)}, {"dst_c", slot(level + 2)}});
      cost(level, 3, p_.format, taps);
      return 3;
    }
    const int block = profile_.voxels.block;
    const bool few = std::all_of(s.begin(), s.end(), [&](int n) { return mode_of(p_, n) <= pair; });
    const int each = few ? block : 1;  // as the kernel has it
    planner_.pass("mip_average", module(level - 1, p_.format, p_.format, true), label("average", level),
                  invocations({(d[0] + each - 1) / each, d[1], d[2]}), profile_.voxels.workgroup,
                  {{"src_x", s[0]},
                   {"src_y", s[1]},
                   {"src_z", s[2]},
                   {"dst_x", d[0]},
                   {"dst_y", d[1]},
                   {"dst_z", d[2]},
                   {"clean", clean}},
                  {{"MODE_X", mode_of(p_, s[0])},
                   {"MODE_Y", mode_of(p_, s[1])},
                   {"MODE_Z", mode_of(p_, s[2])},
                   {"BLOCK", block},
                   {"SPLIT", profile_.voxels.split}},
                  {{"src", slot(level - 1)}, {"dst", slot(level)}});
    cost(level, 1, p_.format, taps);
    return 1;
  }

  int directional(int level) {
    const Extent s = mip_extent(p_, level - 1), d = mip_extent(p_, level);
    const std::string from = module(level - 1, p_.format, p_.format, true);
    const bool halves = std::none_of(s.begin(), s.end(), [](int n) { return n > 1 && n % 2 == 1; });
    if (level == 1 && p_.directions == mip_all && halves) {
      planner_.pass(
          "mip_directional_six", from, label("six directions", level), invocations(d), profile_.voxels.workgroup,
          {{"src_x", s[0]}, {"src_y", s[1]}, {"src_z", s[2]}},
          {{"PAIR_X", s[0] > 1}, {"PAIR_Y", s[1] > 1}, {"PAIR_Z", s[2] > 1}, {"SPLIT", profile_.voxels.split}},
          {{"src", slot(0)},
           {"dst_px", slot(1, 0)},
           {"dst_nx", slot(1, 1)},
           {"dst_py", slot(1, 2)},
           {"dst_ny", slot(1, 3)},
           {"dst_pz", slot(1, 4)},
           {"dst_nz", slot(1, 5)}});
      planner_.cost(texels(1) * 6 * 44, (texels(0) + 6 * texels(1)) * static_cast<double>(bytes_per_pixel(p_.format)));
      return 1;
    }
    for (int direction = 0; direction < 6; ++direction) {
      if (!(p_.directions >> direction & 1)) continue;
      const int axis = direction / 2, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
      planner_.pass("mip_directional", from, label(direction_names[direction], level), invocations(d),
                    profile_.voxels.workgroup,
                    {{"src_x", s[0]},
                     {"src_y", s[1]},
                     {"src_z", s[2]},
                     {"dst_x", d[0]},
                     {"dst_y", d[1]},
                     {"dst_z", d[2]},
                     {"axis", axis},
                     {"backward", direction % 2},
                     {"clean", level == 1}},
                    {{"MODE_ALONG", mode_of(p_, s[axis])},
                     {"MODE_U", mode_of(p_, s[u])},
                     {"MODE_V", mode_of(p_, s[v])},
                     {"SPLIT", profile_.voxels.split}},
                    {{"src", slot(level - 1, direction)}, {"dst", slot(level, direction)}});
      cost(level, 1, p_.format, 44);
    }
    return 1;
  }

  int bounds_of(int level) {
    const Extent s = mip_extent(p_, level - 1), d = mip_extent(p_, level);
    const Format from = level == 1 ? format_of_level_0(p_) : p_.format;
    const int upper = p_.variant == MipVariant::max;
    if (tiles(level)) {
      planner_.pass(
          "mip_bounds_tile", module(level - 1, from, p_.format, false), label("bounds, three levels from", level),
          invocations(d), {16, 16, 1}, {{"src_x", s[0]}, {"src_y", s[1]}}, {{"UPPER", upper}},
          {{"src", slot(level - 1)}, {"dst_a", slot(level)}, {"dst_b", slot(level + 1)}, {"dst_c", slot(level + 2)}});
      cost(level, 3, from, 3.0 * channels(p_.format));
      return 3;
    }
    const bool floor = p_.sizes == MipSizes::floor;
    const auto taps = [&](int n) { return floor && n % 2 == 1 && n > 1 ? 3 : 2; };
    planner_.pass("mip_bounds", module(level - 1, from, p_.format, true), label("bounds", level), invocations(d),
                  profile_.voxels.workgroup,
                  {{"src_x", s[0]}, {"src_y", s[1]}, {"dst_x", d[0]}, {"dst_y", d[1]}, {"cover_rest", floor}},
                  {{"UPPER", upper}, {"RATIO", p_.ratio}, {"TAPS_X", taps(s[0])}, {"TAPS_Y", taps(s[1])}},
                  {{"src", slot(level - 1)}, {"dst", slot(level)}});
    cost(level, 1, from, (p_.ratio * p_.ratio - 1.0) * channels(p_.format));
    return 1;
  }

  int moments(int level) {
    const Extent s = mip_extent(p_, level - 1), d = mip_extent(p_, level);
    const Format from = level == 1 ? format_of_level_0(p_) : p_.format;
    planner_.pass("mip_moments", module(level - 1, from, p_.format, true), label("moments", level), invocations(d),
                  profile_.voxels.workgroup, {{"src_x", s[0]}, {"src_y", s[1]}, {"dst_x", d[0]}, {"dst_y", d[1]}},
                  {{"MODE_X", mode_of(p_, s[0])}, {"MODE_Y", mode_of(p_, s[1])}},
                  {{"src", slot(level - 1)}, {"dst", slot(level)}});
    cost(level, 1, from, 25);
    return 1;
  }

  const MipBuildParams& p_;
  const Profile& profile_;
  const int levels_;
  Planner planner_;
  std::vector<Slot> slots_;
};

}  // namespace

Result<Plan> plan(const MipBuildParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  return Pyramid(p, profile).plan();
}

}  // namespace luxel

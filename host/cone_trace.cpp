#include <luxel/cone_trace.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <numbers>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

using Extent = std::array<int, 3>;

constexpr std::size_t most_cones = 64;
constexpr int cone_stride = 8;      // floats a cone in the kernel's table
constexpr int spread_count = 65;    // spreads over roughness 0..1
constexpr int spread_table = 136;   // as the kernel declares it: spreads, and levels of the sky from 68 on
constexpr int turns = 64;           // about the normal, in what the table of cones has to spare

std::size_t texels(const Extent& e) { return static_cast<std::size_t>(e[0]) * e[1] * e[2]; }
std::size_t aligned(std::size_t n) { return (n + 63) / 64 * 64; }
int directions(const ConeTraceParams& p) { return p.variant == ConeVariant::anisotropic ? 6 : 1; }

int all_levels(Extent e) {
  int levels = 1;
  for (; e[0] > 1 || e[1] > 1 || e[2] > 1; ++levels)
    for (int& n : e) n = std::max(1, n / 2);
  return levels;
}

Status check_cone(const Cone& c, std::size_t i) {
  const std::string field = "ConeTraceParams.cones[" + std::to_string(i) + "]";
  const double length = std::hypot(c.direction[0], c.direction[1], c.direction[2]);
  LUXEL_CHECK(check_range((field + ".direction's length").c_str(), length, 1e-30, 1e30));
  LUXEL_CHECK(check_range((field + ".weight").c_str(), c.weight, 1e-30, 1e30));
  return check_range((field + ".aperture").c_str(), c.aperture, 0.0, 2.6);
}

double border(const ConeTraceParams& p) {
  return p.clipmap_border > 0 ? p.clipmap_border : *std::min_element(p.extent.begin(), p.extent.end()) / 8.0;
}

// Each window lies in the next, so far from its sides that the next need not yet give way.
Status check_clipmap(const ConeTraceParams& p) {
  LUXEL_CHECK(check_range("ConeTraceParams.clipmap's size", static_cast<int>(p.clipmap.size()), 2, 16));
  for (const int n : p.extent)
    if (n % 8 != 0 || n < 16) return out_of_range("ConeTraceParams.extent", n, "multiples of 8 from 16 on with a clipmap");
  if (p.clipmap_border != 0)
    LUXEL_CHECK(check_range("ConeTraceParams.clipmap_border", p.clipmap_border, 0.5,
                            *std::min_element(p.extent.begin(), p.extent.end()) / 4.0));
  if (p.variant != ConeVariant::isotropic) return out_of_range("ConeTraceParams.variant", "anisotropic", "isotropic with a clipmap");
  if (p.input != Input::buffer) return out_of_range("ConeTraceParams.input", "image", "buffer with a clipmap");
  if (p.levels != 0) return out_of_range("ConeTraceParams.levels", p.levels, "0 with a clipmap, which has its own");
  for (std::size_t l = 0; l < p.clipmap.size(); ++l) {
    const std::string field = "ConeTraceParams.clipmap[" + std::to_string(l) + "]";
    for (std::size_t k = 0; k < 3; ++k) {
      LUXEL_CHECK(check_range(field.c_str(), p.clipmap[l][k], -(1 << 20), 1 << 20));
      if (l == 0) continue;
      const double low = p.clipmap[l - 1][k] / 2.0 - p.clipmap[l][k];
      const double high = p.extent[k] / 2.0 - low;
      if (std::min(low, high) < border(p) + 0.5)
        return Status(Code::invalid_argument, field + " leaves the level before it " + std::to_string(std::min(low, high)) +
                                                  " voxels from a side; expected at least " +
                                                  std::to_string(border(p) + 0.5));
    }
  }
  return {};
}

Status check_volume(const ConeTraceParams& p) {
  constexpr const char* fields[3] = {"ConeTraceParams.extent[0]", "ConeTraceParams.extent[1]",
                                     "ConeTraceParams.extent[2]"};
  for (int axis = 0; axis < 3; ++axis)
    LUXEL_CHECK(check_range(fields[axis], p.extent[axis], p.input == Input::image ? 4 : 1, 2048));
  LUXEL_CHECK(check_range("ConeTraceParams.variant", static_cast<int>(p.variant), 0, 1));
  LUXEL_CHECK(check_range("ConeTraceParams.input", static_cast<int>(p.input), 0, 1));
  LUXEL_CHECK(check_range("ConeTraceParams.levels", p.levels, 0, all_levels(p.extent)));
  if (p.format != Format::f32x4 && p.format != Format::f16x4 && p.format != Format::unorm8x4)
    return out_of_range("ConeTraceParams.format", name(p.format), "f32x4, f16x4 or unorm8x4");
  if (!p.clipmap.empty()) LUXEL_CHECK(check_clipmap(p));
  if (std::max(texels(p.extent) * std::max<std::size_t>(p.clipmap.size(), 1), cone_trace_coarse_texels(p)) > 0x20000000)
    return out_of_range("ConeTraceParams.extent", texels(p.extent),
                        "at most 536870912 texels in the finest level, and in all others together");
  for (const double o : p.origin) LUXEL_CHECK(check_range("ConeTraceParams.origin", o, -1e30, 1e30));
  return check_range("ConeTraceParams.voxel", p.voxel, 1e-30, 1e30);
}

}  // namespace

std::vector<Extent> cone_trace_windows(const ConeTraceParams& p, const std::array<double, 3>& centre, int levels) {
  std::vector<Extent> windows;
  for (int l = 0; l < levels; ++l) {
    Extent first;
    for (std::size_t k = 0; k < 3; ++k)
      first[k] = static_cast<int>(std::floor((centre[k] - p.origin[k]) / std::ldexp(p.voxel, l) - p.extent[k] / 2.0 + 0.5));
    windows.push_back(first);
  }
  return windows;
}

int cone_trace_levels(const ConeTraceParams& p) {
  if (!p.clipmap.empty()) return static_cast<int>(p.clipmap.size());
  return p.levels > 0 ? p.levels : all_levels(p.extent);
}

Extent cone_trace_extent(const ConeTraceParams& p, int level) {
  Extent e = p.extent;
  for (int& n : e) n = std::max(1, n >> level);
  return e;
}

std::size_t cone_trace_level_offset(const ConeTraceParams& p, int level, int direction) {
  std::size_t offset = 0;
  for (int l = 1; l < level; ++l) offset += directions(p) * aligned(texels(cone_trace_extent(p, l)));
  return offset + static_cast<std::size_t>(direction) * aligned(texels(cone_trace_extent(p, level)));
}

std::size_t cone_trace_coarse_texels(const ConeTraceParams& p) {
  if (!p.clipmap.empty()) return (p.clipmap.size() - 1) * texels(p.extent);
  return cone_trace_level_offset(p, cone_trace_levels(p));
}

Extent cone_trace_atlas_offset(const ConeTraceParams& p, int level, int direction) {
  Extent at{0, 0, direction * cone_trace_extent(p, 1)[2]};
  for (int l = 1; l < level; ++l) at[0] += cone_trace_extent(p, l)[0];
  return at;
}

Extent cone_trace_atlas_extent(const ConeTraceParams& p) {
  const Extent first = cone_trace_extent(p, 1);
  return {cone_trace_atlas_offset(p, cone_trace_levels(p))[0], first[1], directions(p) * first[2]};
}

Status validate(const ConeTraceParams& p) {
  LUXEL_CHECK(check_range("ConeTraceParams.width", p.width, 1, 1 << 20));
  LUXEL_CHECK(check_range("ConeTraceParams.height", p.height, 1, 65535));
  if (static_cast<double>(p.width) * p.height > (1 << 27))
    return out_of_range("ConeTraceParams.height", p.height, "width x height of at most 134217728");
  LUXEL_CHECK(check_volume(p));
  if (p.cones.size() > most_cones) return out_of_range("ConeTraceParams.cones' size", p.cones.size(), "0..64");
  for (std::size_t i = 0; i < p.cones.size(); ++i) LUXEL_CHECK(check_cone(p.cones[i], i));
  LUXEL_CHECK(check_range("ConeTraceParams.pattern_x", p.pattern_x, 1, 64));
  LUXEL_CHECK(check_range("ConeTraceParams.pattern_y", p.pattern_y, 1, 64));
  LUXEL_CHECK(check_range("ConeTraceParams.footprint", p.footprint, 0.0625, 1.0));
  LUXEL_CHECK(check_range("ConeTraceParams.specular_footprint", p.specular_footprint, 0.0625, 1.0));
  LUXEL_CHECK(check_range("ConeTraceParams.step_scale", p.step_scale, 0.0625, 4.0));
  LUXEL_CHECK(check_range("ConeTraceParams.normal_offset", p.normal_offset, 0.0, 64.0));
  LUXEL_CHECK(check_range("ConeTraceParams.start", p.start, 0.0, 64.0));
  LUXEL_CHECK(check_range("ConeTraceParams.max_distance", p.max_distance, 0.0, 1e30));
  LUXEL_CHECK(check_range("ConeTraceParams.seed", p.seed, 0, 0x7fffffff));
  LUXEL_CHECK(check_range("ConeTraceParams.gamma", p.gamma, 0.0, 1e30));
  for (const double e : p.environment) LUXEL_CHECK(check_range("ConeTraceParams.environment", e, 0.0, 1e30));
  LUXEL_CHECK(check_range("ConeTraceParams.sky_size", p.sky_size, 0, 1024));
  if (p.sky_size == 1) return out_of_range("ConeTraceParams.sky_size", p.sky_size, "0, or 2..1024");
  LUXEL_CHECK(check_range("ConeTraceParams.sky_levels", p.sky_levels, 1, 16));
  LUXEL_CHECK(check_range("ConeTraceParams.sky_aperture", p.sky_aperture, 0.01, 2.6));
  LUXEL_CHECK(check_range("ConeTraceParams.error", p.error, 0.0, 1e30));
  LUXEL_CHECK(check_range("ConeTraceParams.radiance_max", p.radiance_max, 1e-30, 1e30));
  LUXEL_CHECK(check_range("ConeTraceParams.max_steps", p.max_steps, 0, 1 << 20));
  if (!p.radiance && !p.occlusion && !p.specular)
    return out_of_range("ConeTraceParams.radiance", "false", "true, or occlusion or specular true");
  return {};
}

namespace {

// Weights that sum to 1 in float, added in this order.
std::vector<float> float_weights(const std::vector<Cone>& cones) {
  double sum = 0;
  for (const Cone& c : cones) sum += c.weight;
  std::vector<float> weights;
  for (const Cone& c : cones) weights.push_back(static_cast<float>(c.weight / sum));
  const auto total = [&] {
    float t = 0;
    for (const float w : weights) t += w;
    return t;
  };
  // What is missing goes to one weight; where its own rounding is too coarse, to the next smaller one.
  std::vector<std::size_t> order(weights.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  for (const std::size_t i : order)
    for (int n = 0; n < 8 && total() != 1.0f; ++n) weights[i] += 1.0f - total();
  return weights;
}

struct Tables {
  std::vector<double> rounded, exact;
};

// Between the levels of the sky.
double sky_level(const ConeTraceParams& p, double aperture) {
  if (p.sky_size == 0 || p.sky_levels == 1) return 0;
  const double level = std::log2(p.sky_aperture / std::max(aperture, 1e-9));
  const double whole = std::round(level);
  return std::clamp(std::fabs(level - whole) < 1e-9 ? whole : level, 0.0, p.sky_levels - 1.0);
}

Tables cone_table(const ConeTraceParams& p, const std::vector<Cone>& cones) {
  const std::vector<float> weights = float_weights(cones);
  Tables t;
  t.exact.assign(most_cones * cone_stride, 0);
  double sum = 0;
  for (const Cone& c : cones) sum += c.weight;
  for (std::size_t i = 0; i < cones.size(); ++i) {
    const Cone& c = cones[i];
    const double length = std::hypot(c.direction[0], c.direction[1], c.direction[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) t.exact[i * cone_stride + axis] = c.direction[axis] / length;
    t.exact[i * cone_stride + 3] = c.weight / sum;
    t.exact[i * cone_stride + 4] = p.footprint * 2 * std::tan(c.aperture / 2);
    t.exact[i * cone_stride + 5] = sky_level(p, c.aperture);
  }
  for (int i = 0; p.rotate && i < turns; ++i) {
    t.exact[i * cone_stride + 6] = std::cos(2 * std::numbers::pi * i / turns);
    t.exact[i * cone_stride + 7] = std::sin(2 * std::numbers::pi * i / turns);
  }
  t.rounded.assign(t.exact.begin(), t.exact.end());
  for (double& v : t.rounded) v = static_cast<float>(v);
  for (std::size_t i = 0; i < cones.size(); ++i) t.rounded[i * cone_stride + 3] = weights[i];
  return t;
}

Tables spreads(const ConeTraceParams& p) {
  Tables t;
  t.exact.assign(spread_table, 0);
  for (int i = 0; i < spread_count; ++i) {
    const double aperture = specular_aperture(i / (spread_count - 1.0));
    t.exact[i] = p.specular_footprint * 2 * std::tan(aperture / 2);
    t.exact[spread_table / 2 + i] = sky_level(p, aperture);
  }
  t.rounded.assign(t.exact.begin(), t.exact.end());
  for (double& v : t.rounded) v = static_cast<float>(v);
  return t;
}

class ConeTracing {
 public:
  ConeTracing(const ConeTraceParams& params, const Profile& profile)
      : p_(params), profile_(profile), planner_("cone_trace"), cones_(params.cones) {
    if (cones_.empty()) cones_ = cone_set(6).value();
    const bool image = p_.input == Input::image;
    const bool clipmap = !p_.clipmap.empty();
    fine_ = clipmap ? volume("clipmap", p_.extent, texels(p_.extent) * p_.clipmap.size())
                    : volume("fine", p_.extent, texels(p_.extent));
    coarse_ = fine_;  // never read where there is one level, or a clipmap
    if (cone_trace_levels(p_) > 1 && !clipmap)
      coarse_ = volume("coarse", image ? cone_trace_atlas_extent(p_) : Extent{1, 1, 1}, cone_trace_coarse_texels(p_));
    receivers_ = list("receivers", 2, false);
    sky_ = receivers_;  // never read without a sky
    if (p_.sky_size > 0 && (p_.radiance || p_.specular)) {
      Resource sky{"sky"};
      sky.format = Format::f32x4;
      sky.bytes = static_cast<std::size_t>(p_.sky_levels * p_.sky_size) * static_cast<std::size_t>(p_.sky_size) * 16;
      sky_ = planner_.resource(sky);
    }
    if (p_.specular) views_ = list("views", 1, false);
    if (p_.radiance || p_.occlusion) irradiance_ = list("irradiance", 1, true);
    if (p_.specular) specular_ = list("specular", 1, true);
    if (p_.count) {
      Resource counters{"counters"};
      counters.format = Format::u32;
      counters.bytes = cone_outcomes * 4;
      counters.written = true;
      counters_ = planner_.resource(counters);
    }
  }

  Result<Plan> plan() && {
    if (p_.radiance || p_.occlusion) {
      const Tables t = cone_table(p_, cones_);
      pass("diffuse", p_.radiance, p_.occlusion, static_cast<int>(cones_.size()),
           {{"cones", planner_.table(t.rounded, t.exact)}, {"irradiance", irradiance_}});
    }
    if (p_.specular) {
      const Tables t = spreads(p_);
      pass("specular", true, true, 1,
           {{"spreads", planner_.table(t.rounded, t.exact)}, {"views", views_}, {"specular", specular_}});
    }
    return std::move(planner_).finish();
  }

 private:
  using Slots = std::vector<std::pair<std::string_view, Slot>>;

  Slot volume(const char* name, const Extent& extent, std::size_t count) {
    Resource r{name};
    r.format = p_.format;
    if (p_.input == Input::image) {
      r.kind = ResourceKind::sampled_image;
      r.extent = extent;
    } else {
      r.bytes = count * bytes_per_pixel(p_.format);
    }
    return planner_.resource(r);
  }

  Slot list(const char* name, std::size_t each, bool written) {
    Resource r{name};
    r.format = Format::f32x4;
    r.bytes = each * static_cast<std::size_t>(p_.width) * static_cast<std::size_t>(p_.height) * 16;
    r.written = written;
    return planner_.resource(r);
  }

  // Steps of the longest way through the volume at the least step: none takes more.
  int steps_needed() const {
    const double diagonal = std::hypot(p_.extent[0], p_.extent[1], p_.extent[2]);
    const int volumes = std::max<int>(static_cast<int>(p_.clipmap.size()), 1);
    return volumes * static_cast<int>(std::ceil(diagonal / p_.step_scale)) + 8;
  }

  std::string module(const std::string& what) const {
    std::string text = what == "specular" ? "specular_" : "";
    if (p_.count) text += "count_";
    if (p_.input == Input::image) return text + "sampled";
    if (!p_.clipmap.empty()) return text + "clipmap_" + name(p_.format);
    if (profile_.texels && !p_.count) text += "texels_";
    return text + name(p_.format);
  }

  // As the signature has it. All whole numbers and powers of two, but for the border.
  std::vector<double> window_table() const {
    std::vector<double> table(128, 0);
    for (std::size_t l = 0; l < p_.clipmap.size(); ++l) {
      const int level = static_cast<int>(l);
      for (std::size_t k = 0; k < 3; ++k) {
        const int n = p_.extent[k];
        table[8 * l + k] = std::ldexp(p_.clipmap[l][k], level) - p_.clipmap[0][k];
        table[8 * l + 3 + k] = (p_.clipmap[l][k] % n + n) % n;
      }
      table[8 * l + 6] = std::ldexp(1, -level);
      table[8 * l + 7] = static_cast<float>(1 / border(p_));
    }
    return table;
  }

  void pass(const std::string& what, bool radiance, bool occlusion, int cones, const Slots& own) {
    const double reach = p_.max_distance > 0 ? p_.max_distance / p_.voxel : FLT_MAX;
    const Extent atlas = p_.input == Input::image && cone_trace_levels(p_) > 1 ? cone_trace_atlas_extent(p_) : Extent{};
    Slots slots{{"fine", fine_}, {"coarse", coarse_}, {"receivers", receivers_}, {"sky", sky_}};
    slots.insert(slots.end(), own.begin(), own.end());
    if (p_.count) slots.emplace_back("counters", counters_);
    std::array<double, 3> origin = p_.origin;  // a clipmap's: the corner of the finest window
    if (!p_.clipmap.empty()) {
      for (std::size_t k = 0; k < 3; ++k) origin[k] += p_.clipmap[0][k] * p_.voxel;
      const std::vector<double> windows = window_table();
      slots.emplace_back("windows", planner_.table(windows, windows));
    }
    std::array<std::uint32_t, 3> workgroup = profile_.pixels.workgroup;
    if (p_.height == 1) workgroup = {workgroup[0] * workgroup[1] * workgroup[2], 1, 1};
    planner_.pass("cone_trace", module(what), "cone_trace " + what,
                  {static_cast<std::uint32_t>(p_.width), static_cast<std::uint32_t>(p_.height), 1}, workgroup,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"extent_x", p_.extent[0]},
                   {"extent_y", p_.extent[1]},
                   {"extent_z", p_.extent[2]},
                   {"levels", cone_trace_levels(p_)},
                   {"atlas_x", atlas[0]},
                   {"atlas_y", atlas[1]},
                   {"atlas_z", atlas[2]},
                   {"origin_x", origin[0]},
                   {"origin_y", origin[1]},
                   {"origin_z", origin[2]},
                   {"per_voxel", 1 / p_.voxel},
                   {"normal_offset", p_.normal_offset},
                   {"start", p_.start},
                   {"reach", std::min(reach, static_cast<double>(FLT_MAX))},
                   {"step_scale", p_.step_scale},
                   {"step_cap", p_.max_steps > 0 ? p_.max_steps : steps_needed()},
                   {"stop", p_.error / p_.radiance_max},
                   {"gamma", p_.gamma * p_.voxel},
                   {"environment_r", radiance ? p_.environment[0] : 0},
                   {"environment_g", radiance ? p_.environment[1] : 0},
                   {"environment_b", radiance ? p_.environment[2] : 0},
                   {"cones", cones},
                   {"pattern_x", p_.pattern_x},
                   {"pattern_y", p_.pattern_y},
                   {"seed", p_.seed},
                   {"sky_size", p_.sky_size}},
                  {{"ANISOTROPIC", p_.variant == ConeVariant::anisotropic},
                   {"RADIANCE", radiance},
                   {"OCCLUSION", !occlusion ? 0 : p_.gamma > 0 ? 2 : 1},
                   {"SKIP_EMPTY", p_.skip_empty},
                   {"OWN_LENGTH", p_.clipmap_own_length},
                   {"ROTATE", p_.rotate && what == "diffuse"},
                   {"SKY", p_.sky_size > 0 && radiance}},
                  slots);
    const double steps = p_.max_steps > 0 ? std::min(p_.max_steps, steps_needed()) : steps_needed();
    planner_.rounds(std::ceil(static_cast<double>(cones) / (p_.pattern_x * p_.pattern_y)) * (steps + 2.0 * cone_trace_levels(p_) + 8));
    const double receivers = static_cast<double>(p_.width) * p_.height;
    const double volumes = static_cast<double>(texels(p_.extent) + cone_trace_coarse_texels(p_));
    planner_.cost(0, volumes * static_cast<double>(bytes_per_pixel(p_.format)) + receivers * 48);
  }

  const ConeTraceParams& p_;
  const Profile& profile_;
  Planner planner_;
  std::vector<Cone> cones_;
  Slot fine_, coarse_, receivers_, sky_, views_, irradiance_, specular_, counters_;
};

}  // namespace

Result<Plan> plan(const ConeTraceParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  return ConeTracing(p, profile).plan();
}

}  // namespace luxel

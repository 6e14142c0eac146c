#include <luxel/bilateral.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "host/bilateral_plans.h"
#include "host/check.h"
#include "host/planner.h"

namespace luxel {

namespace {

constexpr double log2_e = 1.4426950408889634;
constexpr double least_exponent = -64;  // kernels/math/range_weight.h: below, a weight is 0
constexpr int max_taps = 4095;          // the table of exponents has 4096 entries

bool is_pixels(Format f) {
  return f == Format::f32x1 || f == Format::f32x2 || f == Format::f32x4 || f == Format::f16x4 || f == Format::unorm8x4;
}

int radius_of(const BilateralParams& p) {
  if (p.radius >= 0) return p.radius;
  return static_cast<int>(std::ceil(std::min(3 * p.sigma_space, 65536.0)));
}

int largest_radius(const BilateralParams& p) {
  return p.variant == BilateralVariant::separable || p.variant == BilateralVariant::discontinuity ? 1024 : 96;
}

// log2 of the spatial weight at `distance` pixels.
double space_exponent(const BilateralParams& p, double distance) {
  return distance == 0 ? 0 : -0.5 * log2_e * (distance / p.sigma_space) * (distance / p.sigma_space);
}

RangeTerm range_of(const BilateralParams& p) { return std::isinf(p.sigma_range) ? RangeTerm::off : p.range; }

bool nothing_to_do(const BilateralParams& p) { return p.range != RangeTerm::off && p.sigma_range == 0; }

}  // namespace

Status validate(const BilateralParams& p) {
  LUXEL_CHECK(check_range("BilateralParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("BilateralParams.height", p.height, 1, 65535));
  const auto stride = [&](const char* field, int value) {
    return value == 0 ? Status() : check_range(field, value, p.width, 1 << 20);
  };
  LUXEL_CHECK(stride("BilateralParams.src_stride", p.src_stride));
  LUXEL_CHECK(stride("BilateralParams.dst_stride", p.dst_stride));
  LUXEL_CHECK(check_range("BilateralParams.variant", static_cast<int>(p.variant), 0, 4));
  const bool atrous = p.variant == BilateralVariant::atrous;
  if (p.variant == BilateralVariant::grid) {
    LUXEL_CHECK(validate_grid(p));
  } else if (!atrous) {
    LUXEL_CHECK(check_range("BilateralParams.sigma_space", p.sigma_space, 0.0, static_cast<double>(HUGE_VAL)));
    LUXEL_CHECK(check_range("BilateralParams.radius", p.radius, -1, largest_radius(p)));
    if (radius_of(p) > largest_radius(p))
      return out_of_range("BilateralParams.sigma_space", p.sigma_space,
                          "0.." + std::to_string(largest_radius(p) / 3) + ", or a radius given (0.." +
                              std::to_string(largest_radius(p)) + ")");
    LUXEL_CHECK(check_range("BilateralParams.step", p.step, 1, 16));
    LUXEL_CHECK(check_range("BilateralParams.window", static_cast<int>(p.window), 0, 1));
  } else {
    LUXEL_CHECK(check_range("BilateralParams.levels", p.levels, 1, 6));
    if (p.taps != 3 && p.taps != 5) return out_of_range("BilateralParams.taps", p.taps, "3 or 5");
  }
  if (p.adaptive && p.variant != BilateralVariant::separable)
    return out_of_range("BilateralParams.adaptive", "true", "false but for variant separable");
  if (p.adaptive && p.step != 1) return out_of_range("BilateralParams.step", p.step, "1 with adaptive");
  if (p.adaptive && p.border == Border::zero)
    return out_of_range("BilateralParams.border", "zero", "clamp, mirror or wrap with adaptive");
  if (p.window == FilterWindow::circle && p.variant != BilateralVariant::direct)
    return out_of_range("BilateralParams.window", "circle", "square but for variant direct");
  LUXEL_CHECK(check_range("BilateralParams.range", static_cast<int>(p.range), 0, 2));
  if (p.range != RangeTerm::off)
    LUXEL_CHECK(check_range("BilateralParams.sigma_range", p.sigma_range, 0.0, static_cast<double>(HUGE_VAL)));
  LUXEL_CHECK(check_range("BilateralParams.range_norm", static_cast<int>(p.range_norm), 0, 1));
  const char* const formats = "f32x1, f32x2, f32x4, f16x4 or unorm8x4";
  if (!is_pixels(p.format)) return out_of_range("BilateralParams.format", name(p.format), formats);
  if (p.range == RangeTerm::guide && !is_pixels(p.guide_format))
    return out_of_range("BilateralParams.guide_format", name(p.guide_format), formats);
  LUXEL_CHECK(check_range("BilateralParams.depth", static_cast<int>(p.depth), 0, 2));
  if (p.depth != DepthTerm::off) {
    LUXEL_CHECK(check_range("BilateralParams.sigma_depth", p.sigma_depth, 1e-6, 1e6));
    LUXEL_CHECK(check_range("BilateralParams.footprint", p.footprint, 1e-9, 1e3));
  }
  if (p.normal) {
    LUXEL_CHECK(check_range("BilateralParams.sigma_normal", p.sigma_normal, 0.01, 4096.0));
    if (p.normal_format != Format::f32x4 && p.normal_format != Format::f16x4 && p.normal_format != Format::unorm8x4)
      return out_of_range("BilateralParams.normal_format", name(p.normal_format), "f32x4, f16x4 or unorm8x4");
  }
  if (p.luminance) {
    LUXEL_CHECK(check_range("BilateralParams.sigma_luminance", p.sigma_luminance, 1e-6, 1e6));
    LUXEL_CHECK(check_range("BilateralParams.epsilon", p.epsilon, 1e-30, 1e30));
  }
  LUXEL_CHECK(check_range("BilateralParams.variance_target", p.variance_target, 0.0, 1e30));
  if (p.variance_target > 0 && !p.luminance)
    return out_of_range("BilateralParams.variance_target", p.variance_target, "0 without luminance");
  LUXEL_CHECK(check_range("BilateralParams.flat", p.flat, 0.0, 0.5));
  if (p.flat > 0 && (p.variant != BilateralVariant::direct || p.window != FilterWindow::square || p.step != 1 ||
                     p.depth == DepthTerm::svgf))
    return out_of_range("BilateralParams.flat", p.flat, "0 but for variant direct, a square window, step 1, depth off or plane");
  if (p.carry_variance && !(atrous && p.luminance))
    return out_of_range("BilateralParams.carry_variance", "true", "false but for variant atrous with luminance");
  LUXEL_CHECK(check_range("BilateralParams.border", static_cast<int>(p.border), 0, 3));
  if (p.alpha && channels(p.format) != 4)
    return out_of_range("BilateralParams.alpha", "true", "false for a format of fewer than four channels");
  if (p.variant == BilateralVariant::grid || p.variant == BilateralVariant::discontinuity)
    LUXEL_CHECK(validate_terms(p));
  const long long pixels = static_cast<long long>(std::max({p.src_stride, p.dst_stride, p.width})) * p.height;
  if (pixels * 16 > 0x7fffffffLL)
    return out_of_range("BilateralParams.height", p.height, "stride x height of at most 134217727");
  return {};
}

int effective_taps(const BilateralParams& p) {
  if (nothing_to_do(p)) return 0;
  if (p.variant == BilateralVariant::atrous) return p.taps / 2;
  if (p.sigma_space == 0) return 0;
  int taps = radius_of(p) / p.step;
  while (taps > 0 && space_exponent(p, taps * p.step) < least_exponent) --taps;
  return std::min(taps, max_taps);
}

namespace {

// Where the planes of a filter lie, and the passes that fill and read them.
class Builder {
 public:
  Builder(const BilateralParams& p, const Profile& profile) : p_(p), profile_(profile), planner_("bilateral") {}

  Result<Plan> build() {
    layout();
    images();
    count_all();
    if (!packs() || flat()) prepare();
    if (flat()) flatten();
    if (packs()) {
      packed();
    } else if (p_.variant == BilateralVariant::atrous) {
      atrous();
    } else if (p_.variant == BilateralVariant::separable) {
      separable();
    } else {
      filter({.columns = taps_,
              .rows = taps_,
              .step = p_.step,
              .reach = reach(),
              .from = colours_,
              .table = window(),
              .flat = flat() ? 1 : 0});
    }
    return std::move(planner_).finish();
  }

 private:
  struct Filter {
    int columns, rows, step, reach;
    Slot from;
    Slot table;
    bool last = true;  // writes dst; else the planes `to`
    Slot to = {};
    int adaptive = 0;
    int variance = 0;  // the plane of guides_, where luminance is on
    bool carry = false;
    Slot carried = {};  // where the variance of the result goes: rows `carried_stride` apart, from element `carried_at`
    int carried_stride = 0, carried_at = 0;
    int flat = 0;        // FLAT of the kernel
    bool space = false;  // no other term
  };

  bool flat() const { return p_.flat > 0 && taps_ > 0; }

  // Taps with i^2 + j^2 of at most this count.
  int reach() const {
    if (p_.window == FilterWindow::square) return 2 * taps_ * taps_;
    return radius_of(p_) * radius_of(p_) / (p_.step * p_.step);
  }

  double range_factor() const {
    return range_ == RangeTerm::off ? 0 : std::min(0.5 * log2_e / (p_.sigma_range * p_.sigma_range), 1e30);
  }

  // Taps of one pass along an axis: all of them, or with pairs in the outer half.
  int inner() const { return p_.adaptive ? (taps_ + 1) / 2 : 0; }

  void layout() {
    taps_ = effective_taps(p_);
    range_ = taps_ > 0 ? range_of(p_) : RangeTerm::off;
    colour_count_ = channels(p_.format) == 4 && !p_.alpha ? 3 : channels(p_.format);
    const int guide_channels = channels(p_.guide_format);
    guide_count_ = range_ == RangeTerm::guide ? (guide_channels == 4 ? 3 : guide_channels) : 0;
    depth_ = taps_ > 0 ? p_.depth : DepthTerm::off;
    normal_ = taps_ > 0 && p_.normal;
    luminance_ = taps_ > 0 && p_.luminance;
    // Pixels that are not finite are told by whichever plane weighs anyway.
    bias_ = taps_ > 0 && range_ == RangeTerm::off && depth_ == DepthTerm::off && !normal_;
    const int widest = p_.variant == BilateralVariant::atrous ? taps_ << (p_.levels - 1) : taps_ * p_.step + 1;
    pad_ = taps_ == 0 ? 0 : widest;
    pitch_ = (p_.width + 15) / 16 * 16 + 2 * pad_;
    int at = 0;
    const auto take = [&](bool wanted, int count) {
      const int first = at;
      if (wanted) at += count;
      return wanted ? first : 0;
    };
    bias_plane_ = take(bias_, 1);
    guide_plane_ = take(guide_count_ > 0, guide_count_);
    depth_plane_ = take(depth_ != DepthTerm::off, 3);
    normal_plane_ = take(normal_, 3);
    luminance_plane_ = take(luminance_, 2);
    variance_plane_ = take(luminance_, 2);
    guide_planes_ = at;
  }

  // Whole texels, and a window unrolled by constants, on drivers that are fast so.
  bool packs() const {
    return profile_.texels && p_.variant == BilateralVariant::direct && p_.step == 1 && taps_ > 0 &&
           taps_ <= std::min(profile_.pixels.unroll, 5) && channels(p_.format) == 4 && p_.border != Border::zero &&
           range_ != RangeTerm::off && (range_ == RangeTerm::self || channels(p_.guide_format) == 4) &&
           depth_ == DepthTerm::off && !normal_ && !luminance_;
  }

  void packed() {
    const auto texels = [&] {
      return planner_.scratch(Format::f32x4, static_cast<std::size_t>(p_.height) * pitch_);
    };
    const Slot colours = texels(), guides = range_ == RangeTerm::guide ? texels() : colours;
    const auto pack = [&](const char* label, Slot image, Format format, int stride, bool guide, Slot to) {
      planner_.pass("bilateral_pack", name(format), label, over(pitch_, p_.height), profile_.pixels.workgroup,
                    {{"width", p_.width},
                     {"height", p_.height},
                     {"src_stride", stride},
                     {"pitch", pitch_},
                     {"pad", pad_}},
                    {{"BORDER", static_cast<int>(p_.border)}, {"GUIDE", guide}},
                    {{"src", image}, {"colours", guide ? colours : image}, {"packed", to}});
      planner_.cost(0, static_cast<double>(p_.width) * p_.height * (bytes_per_pixel(format) + (guide ? 32 : 16)));
    };
    pack("bilateral pack", src_, p_.format, src_stride_, false, colours);
    if (range_ == RangeTerm::guide) pack("bilateral guide", guide_, p_.guide_format, p_.width, true, guides);
    constexpr int across = 2, down = 4;  // more take longer to compile than they save
    planner_.pass("bilateral_packed", name(p_.format), "bilateral",
                  over((p_.width + across - 1) / across, (p_.height + down - 1) / down), profile_.pixels.workgroup,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"src_stride", src_stride_},
                   {"dst_stride", dst_stride_},
                   {"pitch", pitch_},
                   {"pad", pad_},
                   {"range_factor", range_factor()}},
                  {{"RADIUS", taps_},
                   {"REACH", reach()},
                   {"BORDER", static_cast<int>(p_.border)},
                   {"COLOURS", colour_count_},
                   {"RANGE", static_cast<int>(range_)},
                   {"L1", p_.range_norm == RangeNorm::l1},
                   {"FLAT", flat()},
                   {"ACROSS", across},
                   {"DOWN", down}},
                  {{"colours", colours},
                   {"guides", guides},
                   {"src", src_},
                   {"dst", dst_},
                   {"spatial", window()},
                   {"flats", flat() ? flats_ : colours}});
    planner_.cost((2.0 * taps_ + 1) * (2.0 * taps_ + 1) * (27 + 3 * colour_count_) * p_.width * p_.height,
                  static_cast<double>(p_.width) * p_.height *
                      (2 * bytes_per_pixel(p_.format) + (range_ == RangeTerm::guide ? 32.0 : 16.0)));
  }

  Slot planes(int count) {
    return planner_.scratch(Format::f32x1, static_cast<std::size_t>(count) * p_.height * pitch_);
  }

  Slot input(const char* name, Format format, int stride) {
    Resource r{name};
    r.format = format;
    r.bytes = (static_cast<std::size_t>(p_.height - 1) * stride + p_.width) * bytes_per_pixel(format);
    return planner_.resource(r);
  }

  Slot output(const char* name, Format format, int stride) {
    Resource r{name};
    r.format = format;
    r.bytes = (static_cast<std::size_t>(p_.height - 1) * stride + p_.width) * bytes_per_pixel(format);
    r.written = true;
    return planner_.resource(r);
  }

  void images() {
    src_stride_ = p_.src_stride ? p_.src_stride : p_.width;
    dst_stride_ = p_.dst_stride ? p_.dst_stride : p_.width;
    src_ = input("src", p_.format, src_stride_);
    dst_ = output("dst", p_.format, dst_stride_);
    if (range_ == RangeTerm::guide) guide_ = input("guide", p_.guide_format, p_.width);
    if (depth_ != DepthTerm::off) z_ = input("depth", Format::f32x1, p_.width);
    if (normal_) normals_ = input("normals", p_.normal_format, p_.width);
    if (luminance_) variance_ = input("variance", Format::f32x1, p_.width);
    if (p_.carry_variance && luminance_) variance_out_ = output("variance_out", Format::f32x1, p_.width);
    if (p_.count) {
      Resource counters{"counters"};
      counters.format = Format::u32;
      counters.bytes = 16;
      counters.written = true;
      counters_ = planner_.resource(counters);
    }
  }

  std::array<std::uint32_t, 3> over(int width, int height) const {
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), 1};
  }

  void split(const char* label, Slot image, Format format, int stride, int count, Slot to, int first, int mark,
             double scale = 1, double offset = 0) {
    planner_.pass("bilateral_split", name(format), label, over(pitch_, p_.height), workgroup_,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"src_stride", stride},
                   {"pitch", pitch_},
                   {"pad", pad_},
                   {"first", first},
                   {"scale", scale},
                   {"offset", offset}},
                  {{"COUNT", count}, {"BORDER", static_cast<int>(p_.border)}, {"MARK", mark}},
                  {{"src", image}, {"planes", to}});
    planner_.cost(0, static_cast<double>(p_.width) * p_.height * (bytes_per_pixel(format) + 4 * count));
  }

  void counted(Slot image, Format format, int stride, int counter, int rule, double scale = 1, double offset = 0) {
    planner_.pass("bilateral_count", name(format), "bilateral count", over(p_.width, p_.height), workgroup_,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"src_stride", stride},
                   {"counter", counter},
                   {"scale", scale},
                   {"offset", offset}},
                  {{"RULE", rule}}, {{"src", image}, {"counters", counters_}});
  }

  double normal_scale() const { return p_.normal_format == Format::unorm8x4 ? 2 : 1; }
  double normal_offset() const { return p_.normal_format == Format::unorm8x4 ? -1 : 0; }

  void count_all() {
    if (p_.count) {
      counted(src_, p_.format, src_stride_, 0, 0);
      if (range_ == RangeTerm::guide) counted(guide_, p_.guide_format, p_.width, 1, 0);
      if (depth_ != DepthTerm::off) counted(z_, Format::f32x1, p_.width, 2, 1);
      if (normal_) counted(normals_, p_.normal_format, p_.width, 3, 2, normal_scale(), normal_offset());
    }
  }

  void prepare() {
    colours_ = planes(colour_count_);
    guides_ = guide_planes_ > 0 ? planes(guide_planes_) : colours_;
    split("bilateral split", src_, p_.format, src_stride_, colour_count_, colours_, 0, taps_ > 0);
    if (range_ == RangeTerm::guide)
      split("bilateral guide", guide_, p_.guide_format, p_.width, guide_count_, guides_, guide_plane_, 0);
    if (normal_)
      split("bilateral normals", normals_, p_.normal_format, p_.width, 3, guides_, normal_plane_, 0, normal_scale(),
            normal_offset());
    if (depth_ != DepthTerm::off) {
      planner_.pass(
          "bilateral_depth", "f32x1", "bilateral depth", over(pitch_, p_.height), workgroup_,
          {{"width", p_.width}, {"height", p_.height}, {"pitch", pitch_}, {"pad", pad_}, {"first", depth_plane_}},
          {{"BORDER", static_cast<int>(p_.border)}, {"INVERSE", depth_ == DepthTerm::plane}},
          {{"z", z_}, {"planes", guides_}});
      planner_.cost(12.0 * p_.width * p_.height, 16.0 * p_.width * p_.height);
    }
    if (taps_ > 0 && range_ != RangeTerm::self)
      mark(range_ == RangeTerm::guide ? guide_plane_
           : depth_ != DepthTerm::off ? depth_plane_
           : normal_                  ? normal_plane_
                                      : bias_plane_);
    if (luminance_) split("bilateral variance", variance_, Format::f32x1, p_.width, 1, guides_, variance_plane_, 0);
    if (luminance_ && p_.variant != BilateralVariant::atrous) weigh_luminance(colours_, variance_plane_);
  }

  void mark(int plane) {
    planner_.pass("bilateral_mark", "f32x1", "bilateral mark", over(pitch_, p_.height), workgroup_,
                  {{"pitch", pitch_}, {"height", p_.height}, {"first", plane}}, {{"BIAS", bias_}},
                  {{"colours", colours_}, {"planes", guides_}});
    planner_.cost(0, (bias_ ? 8.0 : 4.0) * p_.width * p_.height);
  }

  void weigh_luminance(Slot colours, int variance) {
    planner_.pass("bilateral_luminance", "f32x1", "bilateral luminance", over(pitch_, p_.height), workgroup_,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"pitch", pitch_},
                   {"pad", pad_},
                   {"first", luminance_plane_},
                   {"variance", variance},
                   {"sigma", p_.sigma_luminance},
                   {"target", p_.variance_target},
                   {"epsilon", p_.epsilon}},
                  {{"COLOURS", colour_count_}, {"BORDER", static_cast<int>(p_.border)}},
                  {{"colours", colours}, {"variances", guides_}, {"planes", guides_}});
    planner_.cost(30.0 * p_.width * p_.height, (4.0 * colour_count_ + 12) * p_.width * p_.height);
  }

  void pad(Slot planes, int first, int count) {
    planner_.pass("bilateral_pad", "f32x1", "bilateral pad", over(pitch_ - p_.width, count * p_.height), workgroup_,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"pitch", pitch_},
                   {"pad", pad_},
                   {"first", first},
                   {"count", count}},
                  {{"BORDER", static_cast<int>(p_.border)}}, {{"planes", planes}});
  }

  // log2 of the weight of tap i; with pairs, at their middle.
  Slot window() {
    std::vector<double> exponents{0.0};
    for (int i = 1; i <= (p_.adaptive ? inner() + (taps_ - inner() + 1) / 2 : taps_); ++i) {
      const double distance = p_.adaptive && i > inner() ? 2 * i - inner() - 0.5 : static_cast<double>(i) * p_.step;
      exponents.push_back(space_exponent(p_, distance));
    }
    return planner_.table(exponents, exponents);
  }

  // Finds the tiles without edges, and filters them.
  void flatten() {
    const int rows = (p_.height + 15) / 16, columns = (p_.width + 15) / 16;
    const int colours = range_ == RangeTerm::guide ? guide_count_ : range_ == RangeTerm::self ? colour_count_ : 0;
    const bool plane = depth_ != DepthTerm::off;
    const int bias = colours, depth = bias + (bias_ ? 1 : 0), normal = depth + (plane ? 3 : 0),
              luminance = normal + (normal_ ? 4 : 0), all = luminance + (luminance_ ? 2 : 0);
    const Slot ranges = planner_.scratch(Format::f32x1, static_cast<std::size_t>(all) * rows * 2 * p_.width);
    flats_ = planner_.scratch(Format::u32, static_cast<std::size_t>(columns) * rows);
    const auto range = [&](int count, Slot planes, int plane, int kind, int first) {
      if (count == 0) return;
      planner_.pass(
          "bilateral_range", "f32x1", "bilateral range",
          {static_cast<std::uint32_t>(p_.width), static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(count)},
          workgroup_,
          {{"width", p_.width},
           {"height", p_.height},
           {"pitch", pitch_},
           {"pad", pad_},
           {"plane", plane},
           {"first", first}},
          {{"KIND", kind}}, {{"planes", planes}, {"ranges", ranges}});
      planner_.cost(3.0 * count * p_.width * p_.height, 4.5 * count * p_.width * p_.height);
    };
    range(colours, range_ == RangeTerm::guide ? guides_ : colours_, range_ == RangeTerm::guide ? guide_plane_ : 0, 0,
          0);
    range(bias_ ? 1 : 0, guides_, bias_plane_, 0, bias);
    range(plane ? 3 : 0, guides_, depth_plane_, 1, depth);
    range(normal_ ? 4 : 0, guides_, normal_plane_, 2, normal);
    range(luminance_ ? 2 : 0, guides_, luminance_plane_, 0, luminance);
    planner_.pass("bilateral_flat", "f32x1", "bilateral flat", over(columns, rows), {16, 1, 1},
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"reach", taps_},
                   {"colour", 0},
                   {"bias", bias},
                   {"depth", depth},
                   {"normal", normal},
                   {"luminance", luminance},
                   {"limit", -std::log2(1 - p_.flat)},
                   {"range_factor", range_factor()},
                   {"normal_power", p_.sigma_normal},
                   {"depth_scale", depth_scale()}},
                  {{"COLOURS", colours},
                   {"L1", p_.range_norm == RangeNorm::l1},
                   {"BIAS", bias_},
                   {"DEPTH", plane},
                   {"NORMAL", normal_},
                   {"LUMINANCE", luminance_},
                   {"INSIDE", plane || p_.border == Border::wrap || p_.border == Border::zero}},
                  {{"ranges", ranges}, {"flats", flats_}});
    const Slot between = planes(colour_count_), table = window();
    filter({.columns = taps_,
            .rows = 0,
            .step = 1,
            .reach = taps_ * taps_,
            .from = colours_,
            .table = table,
            .last = false,
            .to = between,
            .flat = 2,
            .space = true});
    filter({.columns = 0,
            .rows = taps_,
            .step = 1,
            .reach = taps_ * taps_,
            .from = between,
            .table = table,
            .flat = 3,
            .space = true});
  }

  double depth_scale() const { return p_.depth == DepthTerm::plane ? p_.sigma_depth * p_.footprint : p_.sigma_depth; }

  void filter(const Filter& f) {
    const bool terms = !f.space;
    const Shape& shape = profile_.pixels;
    const int lanes = std::max(shape.lanes, 1);
    // Rows of results share their loads, where loads are what takes the time.
    const int block = f.rows > 0 && f.adaptive == 0 && lanes == 1 ? std::min(profile_.columns.block, 4) : 1;
    const int along = (p_.height + f.step * block - 1) / (f.step * block) * f.step;
    const std::string module = std::string(profile_.texels ? "texels_" : "") + (f.last ? name(p_.format) : "planes");
    planner_.pass("bilateral", module, "bilateral", over((p_.width + lanes - 1) / lanes, along), shape.workgroup,
                  {{"width", p_.width},
                   {"height", p_.height},
                   {"src_stride", src_stride_},
                   {"dst_stride", dst_stride_},
                   {"pitch", pitch_},
                   {"pad", pad_},
                   {"bias", bias_plane_},
                   {"guide", guide_plane_},
                   {"depth", depth_plane_},
                   {"normal", normal_plane_},
                   {"luminance", luminance_plane_},
                   {"variance", f.variance},
                   {"carried_stride", f.carried_stride},
                   {"carried_at", f.carried_at},
                   {"range_factor", range_factor()},
                   {"normal_power", p_.sigma_normal},
                   {"depth_scale", depth_scale()},
                   {"reach", taps_}},
                  {{"COLUMNS", f.columns},
                   {"ROWS", f.rows},
                   {"REACH", f.reach},
                   {"STEP", f.step},
                   {"BORDER", static_cast<int>(p_.border)},
                   {"COLOURS", colour_count_},
                   {"RANGE", terms ? static_cast<int>(range_) : 0},
                   {"GUIDES", terms ? guide_count_ : 0},
                   {"L1", p_.range_norm == RangeNorm::l1},
                   {"BIAS", terms && bias_},
                   {"DEPTH", terms ? static_cast<int>(depth_) : 0},
                   {"NORMAL", terms && normal_},
                   {"LUMINANCE", terms && luminance_},
                   {"CARRY", f.carry},
                   {"ADAPTIVE", f.adaptive},
                   {"FLAT", f.flat},
                   {"LANES", lanes},
                   {"BLOCK", block}},
                  {{"planes", f.from},
                   {"guides", guides_},
                   {"src", f.last ? src_ : f.from},
                   {"dst", f.last ? dst_ : f.to},
                   {"variances", f.carry ? f.carried : guides_},
                   {"spatial", f.table},
                   {"flats", f.flat ? flats_ : f.from}});
    const double taps = (2.0 * f.columns + 1) * (2.0 * f.rows + 1);
    const double weighing = (range_ == RangeTerm::off ? 0 : 3 * std::max(guide_count_, colour_count_)) +
                            (depth_ == DepthTerm::off ? 0 : 12) + (normal_ ? 25 : 0) + (luminance_ ? 4 : 0);
    planner_.cost(
        taps * (18 + 3 * colour_count_ + (terms ? weighing : 0)) * p_.width * p_.height,
        (4.0 * (colour_count_ + guide_planes_) + (f.last ? 2.0 * bytes_per_pixel(p_.format) : 4.0 * colour_count_)) *
            p_.width * p_.height);
  }

  void separable() {
    const int count = p_.adaptive ? inner() + (taps_ - inner() + 1) / 2 : taps_;
    const Slot table = window(), between = planes(colour_count_);
    const int reach = count * count;
    filter({.columns = count,
            .rows = 0,
            .step = p_.step,
            .reach = reach,
            .from = colours_,
            .table = table,
            .last = false,
            .to = between,
            .adaptive = inner()});
    filter({.columns = 0,
            .rows = count,
            .step = p_.step,
            .reach = reach,
            .from = between,
            .table = table,
            .adaptive = inner()});
  }

  void atrous() {
    // B3 spline 1 4 6 4 1, or 1 2 1, relative to the centre.
    const std::vector<double> exponents =
        p_.taps == 5 ? std::vector<double>{0, std::log2(4.0 / 6), std::log2(1.0 / 6)} : std::vector<double>{0, -1};
    const Slot table = planner_.table(exponents, exponents);
    Slot from = colours_, other = colours_;
    if (p_.levels > 1) other = planes(colour_count_);
    int variance = variance_plane_;
    for (int level = 0; level < p_.levels; ++level) {
      const bool last = level + 1 == p_.levels;
      const bool carry = luminance_ && (!last || p_.carry_variance);
      const int carried = 2 * variance_plane_ + 1 - variance;
      if (luminance_) weigh_luminance(from, variance);
      Filter f{.columns = taps_,
               .rows = taps_,
               .step = 1 << level,
               .reach = 2 * taps_ * taps_,
               .from = from,
               .table = table,
               .last = last,
               .to = other,
               .variance = variance,
               .carry = carry};
      f.carried = last ? variance_out_ : guides_;
      f.carried_stride = last ? p_.width : pitch_;
      f.carried_at = last ? 0 : carried * p_.height * pitch_ + pad_;
      filter(f);
      if (last) break;
      pad(other, 0, colour_count_);
      if (carry) pad(guides_, carried, 1);
      std::swap(from, other);
      if (carry) variance = carried;
    }
  }

  const BilateralParams& p_;
  const Profile& profile_;
  Planner planner_;
  int taps_ = 0, colour_count_ = 0, guide_count_ = 0, pad_ = 0, pitch_ = 0, src_stride_ = 0, dst_stride_ = 0;
  RangeTerm range_ = RangeTerm::off;
  DepthTerm depth_ = DepthTerm::off;
  bool normal_ = false, luminance_ = false, bias_ = false;
  int bias_plane_ = 0, guide_plane_ = 0, depth_plane_ = 0, normal_plane_ = 0, luminance_plane_ = 0, variance_plane_ = 0,
      guide_planes_ = 0;
  std::array<std::uint32_t, 3> workgroup_{64, 1, 1};
  Slot src_, dst_, guide_, z_, normals_, variance_, variance_out_, counters_, colours_, guides_, flats_;
};

}  // namespace

Result<Plan> plan(const BilateralParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  if (p.variant == BilateralVariant::grid) return plan_grid(p, profile);
  if (p.variant == BilateralVariant::discontinuity) return plan_discontinuity(p, profile);
  return Builder(p, profile).build();
}

}  // namespace luxel

#include <luxel/gaussian_blur.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "host/check.h"
#include "host/gaussian_blur.h"

namespace luxel {

namespace {

constexpr int max_radius = 4095;        // the table of weights has 4096 entries
constexpr double least_sigma = 0.0757;  // below, exp(-1/(2 sigma^2)) is no normal float
constexpr int max_direct_radius = 96;   // (2R+1)^2 taps a pixel: beyond, software drivers take minutes

bool has_taps(GaussianVariant variant) { return variant < GaussianVariant::recursive; }

const char* name(GaussianVariant variant) {
  static const char* const names[] = {"separable", "direct", "sampler", "recursive", "box", "pyramid"};
  return names[static_cast<int>(variant)];
}

double half_step(Format format) {
  switch (format) {
    case Format::unorm8x4: return 1.0 / 510.0;
    case Format::f16x2: case Format::f16x4: return std::ldexp(1.0, -12);  // for values in [0.5, 1)
    default: return 0.0;
  }
}

// Weights before normalisation; the centre is 1.
std::vector<double> raw_weights(double sigma, int radius) {
  std::vector<double> w(radius + 1, 0.0);
  w[0] = 1.0;
  if (sigma > 0)
    for (int t = 1; t <= radius; ++t) w[t] = std::exp(-0.5 * (t / sigma) * (t / sigma));
  return w;
}

double sum_of(const std::vector<double>& w) {
  double sum = 0;
  for (std::size_t t = w.size() - 1; t > 0; --t) sum += 2 * w[t];
  return sum + w[0];
}

}  // namespace

Status validate(const GaussianBlurParams& p) {
  LUXEL_CHECK(check_range("GaussianBlurParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("GaussianBlurParams.height", p.height, 1, 65535));
  const auto stride = [&](const char* field, int value) {
    return value == 0 ? Status() : check_range(field, value, p.width, 1 << 20);
  };
  LUXEL_CHECK(stride("GaussianBlurParams.src_stride", p.src_stride));
  LUXEL_CHECK(stride("GaussianBlurParams.dst_stride", p.dst_stride));
  LUXEL_CHECK(check_range("GaussianBlurParams.sigma", p.sigma, 0.0, 10000.0));
  LUXEL_CHECK(check_range("GaussianBlurParams.radius", p.radius, -1, max_radius));
  const bool taps = has_taps(p.variant);
  if (taps && p.radius < 0 && std::ceil(3 * p.sigma) > max_radius)
    return out_of_range("GaussianBlurParams.sigma", p.sigma, "0..1365, or a radius given (0..4095)");
  LUXEL_CHECK(check_range("GaussianBlurParams.border", static_cast<int>(p.border), 0, 3));
  LUXEL_CHECK(check_range("GaussianBlurParams.variant", static_cast<int>(p.variant), 0, 5));
  LUXEL_CHECK(check_range("GaussianBlurParams.input", static_cast<int>(p.input), 0, 2));
  if (p.format == Format::u32 || p.format == Format::f16x2 || name(p.format) == name(static_cast<Format>(-1)))
    return out_of_range("GaussianBlurParams.format", name(p.format), "f32x1, f32x2, f32x4, f16x4 or unorm8x4");
  if (p.keep_alpha && channels(p.format) != 4)
    return out_of_range("GaussianBlurParams.keep_alpha", "true", "false for a format of fewer than four channels");
  if (p.variant == GaussianVariant::direct && p.input == Input::storage_image)
    return out_of_range("GaussianBlurParams.input", "storage_image", "buffer or image for variant direct");
  if (p.variant == GaussianVariant::direct)
    LUXEL_CHECK(check_range("GaussianBlurParams.radius of variant direct", effective_radius(p), 0, max_direct_radius));
  if (p.variant == GaussianVariant::sampler) {
    if (p.input != Input::image) return out_of_range("GaussianBlurParams.input", p.input == Input::buffer ? "buffer" : "storage_image", "image for variant sampler");
    if (p.border == Border::mirror || p.border == Border::zero)
      return out_of_range("GaussianBlurParams.border", p.border == Border::mirror ? "mirror" : "zero",
                          "clamp or wrap for variant sampler");
    if (p.difference) return out_of_range("GaussianBlurParams.difference", "true", "false for variant sampler");
    if (p.keep_alpha) return out_of_range("GaussianBlurParams.keep_alpha", "true", "false for variant sampler");
  }
  if (!taps) {
    const std::string variant = std::string("variant ") + name(p.variant);
    if (p.radius >= 0) return out_of_range("GaussianBlurParams.radius", p.radius, "-1 for " + variant);
    if (p.input == Input::storage_image)
      return out_of_range("GaussianBlurParams.input", "storage_image", "buffer or image for " + variant);
    if (p.difference) return out_of_range("GaussianBlurParams.difference", "true", "false for " + variant);
  }
  constexpr double most_values = 0x7fffffff;
  if (p.variant == GaussianVariant::recursive) {
    LUXEL_CHECK(check_range("GaussianBlurParams.order", p.order, 3, 5));
    if (recursive_scratch(p) > most_values)
      return out_of_range("GaussianBlurParams.height", p.height,
                          "2 x width x height x channels of at most 2147483647 for variant recursive");
  }
  if (p.variant == GaussianVariant::box) {
    LUXEL_CHECK(check_range("GaussianBlurParams.passes", p.passes, 1, 5));
    if (box_scratch(p) > most_values)
      return out_of_range("GaussianBlurParams.sigma", p.sigma,
                          "lines that reach passes x sigma beyond the image, of at most 2147483647 values, for variant box");
  }
  if (p.variant == GaussianVariant::pyramid) {
    LUXEL_CHECK(check_range("GaussianBlurParams.filter", static_cast<int>(p.filter), 0, 1));
    if (p.levels >= 0 && p.levels < least_levels(p))
      return out_of_range("GaussianBlurParams.levels", p.levels, "-1, or " + std::to_string(least_levels(p)) + " at least");
    LUXEL_CHECK(check_range("GaussianBlurParams.levels", p.levels, -1, most_levels(p)));
    if (p.keep_alpha) return out_of_range("GaussianBlurParams.keep_alpha", "true", "false for variant pyramid");
    if (pyramid_scratch(p) > most_values)
      return out_of_range("GaussianBlurParams.sigma", p.sigma,
                          "a level that reaches 4 sigma beyond the image, of at most 2147483647 values, for variant pyramid");
  }
  const long long pixels = static_cast<long long>(std::max(p.src_stride, p.dst_stride) > 0
                                                      ? std::max({p.src_stride, p.dst_stride, p.width}) : p.width) * p.height;
  if (pixels * channels(p.format) > 0x7fffffffLL)
    return out_of_range("GaussianBlurParams.height", p.height, "stride x height x channels of at most 2147483647");
  return {};
}

int effective_radius(const GaussianBlurParams& p) {
  int radius = p.radius >= 0 ? p.radius : static_cast<int>(std::ceil(3 * p.sigma));
  radius = std::clamp(radius, 0, max_radius);
  const std::vector<double> w = raw_weights(p.sigma, radius);
  const double sum = sum_of(w);
  // Taps that are zero or denormal in f32 change nothing, and denormals are slow.
  while (radius > 0 && w[radius] / sum < FLT_MIN) --radius;
  if (p.drop_taps) {
    double dropped = 0;
    while (radius > 0 && (dropped += 2 * w[radius] / sum) <= half_step(p.format)) --radius;
  }
  return radius;
}

namespace {

// Rounds weights to floats whose sum, added as the kernels add a constant 1 (the centre, then each other one twice), is
// exactly 1.0f: the centre moves by what is missing; where rounding steps over 1.0f, a neighbour takes up the rest.
// `step`: distance between weights in the table.
void round_to_one(std::vector<double>& w, std::size_t step) {
  for (double& v : w) v = static_cast<float>(v);
  const auto kernel_sum = [&] {
    float s = static_cast<float>(w[0]);
    for (std::size_t t = 1; t < w.size(); t += step) s += static_cast<float>(w[t]) * 2.0f;
    return s;
  };
  std::size_t at = 0;
  for (std::size_t tries = 1; tries < 64 * w.size(); ++tries) {
    const float missing = 1.0f - kernel_sum();
    if (missing == 0.0f) return;
    const float before = static_cast<float>(w[at]);
    const float after = before + (at == 0 ? missing : missing * 0.5f);
    w[at] = after == before ? std::nextafter(before, missing > 0 ? 2.0f : 0.0f) : after;
    if (tries % 8 == 0) at = at == 0 ? 1 : at + step < w.size() ? at + step : 0;
  }
}

// Two taps at t and t + 1 become one between them: [centre, weight, distance, weight, distance ...].
std::vector<double> sampler_table(double sigma, int radius) {
  const std::vector<double> w = gaussian_weights(sigma, radius, false);
  std::vector<double> table{w[0]};
  for (int t = 1; t <= radius; t += 2) {
    const double next = t < radius ? w[t + 1] : 0.0;
    table.push_back(w[t] + next);
    table.push_back(t + next / (w[t] + next));
  }
  return table;
}

}  // namespace

std::vector<double> gaussian_weights(double sigma, int radius, bool rounded) {
  std::vector<double> w = raw_weights(sigma, radius);
  const double sum = sum_of(w);
  for (double& v : w) v /= sum;
  if (rounded) round_to_one(w, 1);
  return w;
}

Format f32_of(Format format) {
  return channels(format) == 1 ? Format::f32x1 : channels(format) == 2 ? Format::f32x2 : Format::f32x4;
}

std::string module_of(const Pixels& from, const Pixels& to, const Profile& profile) {
  const std::string source = name(from.format);
  const char* const read = from.input == Input::image           ? "image_"
                           : from.input == Input::storage_image ? "storage_"
                           : profile.texels                     ? "texels_"
                                                                : "";
  return read + (from.format == to.format ? source : source + "_" + name(to.format));
}

void plan_separable(const GaussianBlurParams& p, const Profile& profile, Planner& planner, const Pixels& from,
                    const Pixels& to) {
  const int n = channels(p.format), radius = effective_radius(p);
  const int radius_x = p.width > 1 ? radius : 0;  // along an axis of one pixel every border gives that pixel
  const int radius_y = p.height > 1 ? radius : 0;
  const int most = std::max(radius_x, radius_y);  // 0 for a single pixel
  const Slot weights = planner.table(gaussian_weights(p.sigma, most, true), gaussian_weights(p.sigma, most, false));
  const auto axis_pass = [&](int axis, int r, const Pixels& in, const Pixels& out) {
    const Shape& shape = axis == 0 ? profile.rows : profile.columns;
    const int lanes = std::max(shape.lanes, n);
    const int wide_pixels = lanes / n;
    const int across = axis == 0 ? wide_pixels * shape.block : wide_pixels;
    const int down = axis == 0 ? 1 : shape.block;
    planner.pass("gaussian_blur", module_of(in, out, profile), axis == 0 ? "gaussian_blur rows" : "gaussian_blur columns",
                 {static_cast<std::uint32_t>((p.width + across - 1) / across),
                  static_cast<std::uint32_t>((p.height + down - 1) / down), 1},
                 shape.workgroup,
                 {{"width", p.width}, {"height", p.height}, {"src_stride", in.stride}, {"dst_stride", out.stride},
                  {"radius", r}},
                 {{"RADIUS", r <= shape.unroll ? r : 0}, {"AXIS", axis}, {"BORDER", static_cast<int>(p.border)}, {"DIFFERENCE", p.difference},
                  {"KEEP_ALPHA", p.keep_alpha}, {"UNROLLED", r <= shape.unroll}, {"SPLIT", shape.split}, {"LANES", lanes},
                  {"BLOCK", shape.block}},
                 {{"src", in.slot}, {"dst", out.slot}, {"weights", weights}});
    const double pixels = static_cast<double>(p.width) * p.height;
    planner.cost(pixels * n * (1 + 3.0 * r), pixels * (bytes_per_pixel(in.format) + bytes_per_pixel(out.format)));
  };
  if (radius_x > 0 && radius_y > 0) {
    const Format format = f32_of(p.format);
    const Pixels middle{planner.scratch(format, static_cast<std::size_t>(p.width) * p.height), format, p.width};
    axis_pass(0, radius_x, from, middle);
    axis_pass(1, radius_y, middle, to);
  } else {
    axis_pass(radius_y > 0 ? 1 : 0, most, from, to);
  }
}

Result<Plan> plan(const GaussianBlurParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const int n = channels(p.format);
  const int src_stride = p.src_stride ? p.src_stride : p.width;
  const int dst_stride = p.dst_stride ? p.dst_stride : p.width;
  const int radius = effective_radius(p);
  const int radius_x = p.width > 1 ? radius : 0;   // along an axis of one pixel every border gives that pixel
  const int radius_y = p.height > 1 ? radius : 0;
  // Where no neighbour has a weight, every variant is a copy.
  const bool copies = p.sigma < least_sigma || (p.width == 1 && p.height == 1);
  const bool separable = p.variant != GaussianVariant::direct;
  const bool sampler = p.variant == GaussianVariant::sampler;
  const bool two = p.width > 1 && p.height > 1 && (has_taps(p.variant) ? separable && radius > 0 : !copies);

  Planner planner("gaussian_blur");
  Resource src{"src"}, dst{"dst"};
  src.format = dst.format = p.format;
  src.extent = {p.width, p.height, 1};
  src.bytes = (static_cast<std::size_t>(p.height - 1) * src_stride + p.width) * bytes_per_pixel(p.format);
  dst.bytes = (static_cast<std::size_t>(p.height - 1) * dst_stride + p.width) * bytes_per_pixel(p.format);
  dst.written = true;
  src.may_alias = dst.may_alias = two && p.input == Input::buffer;
  if (p.input != Input::buffer) {
    src.kind = sampler ? ResourceKind::sampled_image
                       : p.input == Input::image ? ResourceKind::image : ResourceKind::storage_image;
    src.address = p.border == Border::wrap ? Address::wrap : Address::clamp;
    src.bytes = 0;
  }
  const Slot from = planner.resource(src);
  const Slot to = planner.resource(dst);
  const Pixels in{from, p.format, src_stride, p.input}, out{to, p.format, dst_stride};
  if (!copies && !has_taps(p.variant)) {
    if (p.variant == GaussianVariant::recursive) plan_recursive(p, profile, planner, in, out);
    if (p.variant == GaussianVariant::box) plan_box(p, profile, planner, in, out);
    if (p.variant == GaussianVariant::pyramid) plan_pyramid(p, profile, planner, in, out);
    return std::move(planner).finish();
  }
  const std::string name_of = name(p.format);
  const Format middle_format = f32_of(p.format);
  const std::string middle_name = name(middle_format);

  const auto weights = [&](int r) {
    return planner.table(gaussian_weights(p.sigma, r, true), gaussian_weights(p.sigma, r, false));
  };
  const auto pixels = static_cast<double>(p.width) * p.height;

  if (!separable) {
    const Shape& shape = profile.pixels;
    const int lanes = std::max(shape.lanes, n);
    planner.pass("gaussian_blur_direct", (p.input == Input::image ? "image_" : "") + name_of, "gaussian_blur direct",
                 {static_cast<std::uint32_t>((p.width + lanes / n - 1) / (lanes / n)), static_cast<std::uint32_t>(p.height), 1},
                 shape.workgroup,
                 {{"width", p.width}, {"height", p.height}, {"src_stride", src_stride}, {"dst_stride", dst_stride}},
                 {{"RADIUS_X", radius_x}, {"RADIUS_Y", radius_y}, {"BORDER", static_cast<int>(p.border)},
                  {"DIFFERENCE", p.difference}, {"KEEP_ALPHA", p.keep_alpha},
                  {"UNROLLED", radius_x <= shape.unroll}, {"SPLIT", shape.split}, {"LANES", lanes}},
                 {{"src", from}, {"dst", to}, {"row_weights", weights(radius_x)}, {"column_weights", weights(radius_y)}});
    planner.cost(pixels * n * 2 * (2 * radius_x + 1) * (2 * radius_y + 1), pixels * 2 * bytes_per_pixel(p.format));
    return std::move(planner).finish();
  }

  if (sampler) {
    std::vector<double> exact = sampler_table(p.sigma, radius), rounded = exact;
    round_to_one(rounded, 2);
    const Slot table = planner.table(rounded, exact);
    const Slot one = planner.table({1.0}, {1.0});
    const auto sampler_pass = [&](int axis, int r, const std::string& module, int stride, Slot in, Slot out, double pass_bytes) {
      const Shape& shape = profile.pixels;
      planner.pass("gaussian_blur_sampler", module, axis == 0 ? "gaussian_blur sampler rows" : "gaussian_blur sampler columns",
                   {static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1}, shape.workgroup,
                   {{"width", p.width}, {"height", p.height}, {"dst_stride", stride},
                    {"pixel_x", 1.0 / p.width}, {"pixel_y", 1.0 / p.height}},
                   {{"PAIRS", (r + 1) / 2}, {"AXIS", axis}, {"UNROLLED", r <= shape.unroll}},
                   {{"src", in}, {"dst", out}, {"weights", r > 0 ? table : one}});
      planner.cost(pixels * n * (1 + 3.0 * ((r + 1) / 2)), pass_bytes);
    };
    const double edge = pixels * bytes_per_pixel(p.format);
    if (two) {
      Resource middle{"middle"};
      middle.kind = ResourceKind::storage_image;
      middle.format = middle_format;
      middle.extent = src.extent;
      middle.address = src.address;
      middle.written = true;
      const Slot between = planner.resource(middle);
      const double inner = pixels * bytes_per_pixel(middle_format);
      sampler_pass(0, radius_x, "to_image_" + middle_name, p.width, from, between, edge + inner);
      sampler_pass(1, radius_y, name_of, dst_stride, between, to, edge + inner);
    } else {
      sampler_pass(radius_y > 0 ? 1 : 0, std::max(radius_x, radius_y), name_of, dst_stride, from, to, 2 * edge);
    }
    return std::move(planner).finish();
  }

  plan_separable(p, profile, planner, in, out);
  return std::move(planner).finish();
}

}  // namespace luxel

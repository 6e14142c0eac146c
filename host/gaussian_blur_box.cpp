// The box variant: width and weights for a sigma, and its passes.
#include "host/gaussian_blur.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace luxel {

namespace {

// The mean of 2 radius + 1 whole pixels and of a part of the next one on each side.
struct Box {
  int radius;
  double part;  // 0..1
};

// The box whose variance is sigma^2 / passes.
Box box_for(double sigma, int passes) {
  const double variance = sigma * sigma / passes;
  // 2r + 1 whole pixels have the variance r (r + 1) / 3.
  const double r = std::floor((std::sqrt(1 + 12 * variance) - 1) / 2);
  const double part = (2 * r + 1) * std::max(0.0, variance - r * (r + 1) / 3) / (2 * ((r + 1) * (r + 1) - variance));
  return {static_cast<int>(r), part};
}

struct Weights {
  double whole, part;  // of a whole pixel, and of the pixels at the ends
};

Weights exact_weights(const Box& box) {
  const double width = 2 * box.radius + 1 + 2 * box.part;
  return {1 / width, box.part / width};
}

// Floats that give 1 where the kernel adds them up over ones: window * whole + part * 2. The ends are moved by what is
// missing, at most a few units.
Weights rounded_weights(const Box& box) {
  const Weights exact = exact_weights(box);
  const auto window = static_cast<float>(2 * box.radius + 1);
  const auto whole = static_cast<float>(exact.whole);
  auto part = static_cast<float>(exact.part < FLT_MIN ? 0 : exact.part);
  for (int tries = 0; tries < 64 && part > 0 && whole * window + part * 2.0f != 1.0f; ++tries) {
    const float missing = 1.0f - (whole * window + part * 2.0f), moved = part + missing * 0.5f;
    part = moved == part ? std::nextafter(part, missing > 0 ? 1.0f : 0.0f) : moved;
  }
  return {whole, std::max(part, 0.0f)};
}

// How far beyond the image a line is still needed behind pass 1..n: where the border is no symmetry of the result, every
// pass but the last goes on outside.
int margin(const GaussianBlurParams& p, const Box& box, int pass) {
  return p.border == Border::clamp || p.border == Border::zero ? (p.passes - pass) * (box.radius + 1) : 0;
}

}  // namespace

double box_scratch(const GaussianBlurParams& p) {
  const double beyond = 2.0 * margin(p, box_for(p.sigma, p.passes), 1);
  const double rows = p.width > 1 ? (p.width + beyond) * p.height : 0;
  const double columns = p.height > 1 ? (p.height + beyond) * p.width : 0;
  return std::max(rows, columns) * channels(p.format);
}

void plan_box(const GaussianBlurParams& p, const Profile& profile, Planner& planner, const Pixels& from,
              const Pixels& to) {
  const Box box = box_for(p.sigma, p.passes);
  const Weights exact = exact_weights(box), rounded = rounded_weights(box);
  const Slot weights = planner.table({rounded.whole, rounded.part}, {exact.whole, exact.part});
  const int window = 2 * box.radius + 1;
  // Few sizes, so that one compilation serves many a sigma. The longest window, of sigma 10000 in one pass, has 34641 pixels.
  const int chunk = window == 1 ? 1 : window <= 16 ? 16 : window <= 64 * 64 ? 64 : 256;
  const int chunks = (window + chunk - 1) / chunk, most_chunks = chunks == 1 ? 1 : chunk;
  const Slot nothing = planner.scratch(Format::f32x1, 1);

  // All passes along one axis. What lies between them alternates between two regions; `ones`: of one line of ones.
  const auto blur_axis = [&](int axis, const Pixels& in, const Pixels& out, bool ones, Slot coverage,
                             const Slot(&between)[2]) {
    const int count = axis == 0 ? p.width : p.height, lines = ones ? 1 : axis == 0 ? p.height : p.width;
    Pixels last = in;
    int last_margin = 0;
    for (int pass = 1; pass <= p.passes; ++pass) {
      const int here = margin(p, box, pass), length = count + 2 * here;
      const Pixels next =
          pass == p.passes ? out : Pixels{between[pass % 2], f32_of(out.format), axis == 0 ? length : lines};
      const int n = channels(next.format), lanes = std::max(profile.rows.lanes, n), pixels = lanes / n;
      planner.pass("gaussian_blur_box", module_of(last, next, profile),
                   std::string("gaussian_blur box ") + (axis == 0 ? "rows" : "columns") + (ones ? " coverage" : ""),
                   {static_cast<std::uint32_t>((lines + pixels - 1) / pixels),
                    static_cast<std::uint32_t>((length + window - 1) / window), 1},
                   axis == 0 ? std::array<std::uint32_t, 3>{1, 4, 1} : profile.columns.workgroup,
                   {{"lines", lines},
                    {"src_count", count + 2 * last_margin},
                    {"dst_count", length},
                    {"shift", last_margin - here},
                    {"src_stride", last.stride},
                    {"dst_stride", next.stride},
                    {"radius", box.radius},
                    {"chunks", chunks}},
                   {{"CHUNK", chunk},
                    {"CHUNKS", most_chunks},
                    {"AXIS", axis},
                    {"BORDER", static_cast<int>(p.border)},
                    {"ONES", ones && pass == 1},
                    {"COVERED", pass == p.passes && !ones && p.border == Border::zero},
                    {"KEEP_ALPHA", p.keep_alpha && !ones},
                    {"LANES", lanes}},
                   {{"src", last.slot}, {"dst", next.slot}, {"weights", weights}, {"coverage", coverage}});
      planner.rounds(2.0 * window + std::min(window, length) + 5.0 * chunks);
      planner.cost(7.0 * lines * length * n,
                   1.0 * lines * length * (bytes_per_pixel(last.format) + bytes_per_pixel(next.format)));
      last = next;
      last_margin = here;
    }
  };
  const auto region = [&](Format format, std::size_t values) {
    return values > 0 ? planner.scratch(format, values) : nothing;
  };
  // Where outside is nothing, results are divided by what becomes of ones.
  const auto cover = [&](int axis) {
    if (p.border != Border::zero) return nothing;
    const std::size_t count = axis == 0 ? p.width : p.height;
    const Pixels covered{planner.scratch(Format::f32x1, count), Format::f32x1, axis == 0 ? static_cast<int>(count) : 1};
    const std::size_t longest = count + 2 * margin(p, box, 1);
    const Slot between[2] = {region(Format::f32x1, p.passes > 2 ? longest : 0),
                             region(Format::f32x1, p.passes > 1 ? longest : 0)};
    blur_axis(axis, {nothing, Format::f32x1, 1}, covered, true, nothing, between);
    return covered.slot;
  };
  const Format middle_format = f32_of(p.format);
  const auto most = static_cast<std::size_t>(box_scratch(p)) / channels(p.format);
  const bool two = p.width > 1 && p.height > 1;
  const Slot between[2] = {region(middle_format, p.passes > 2 ? most : 0),
                           region(middle_format, p.passes > 1 ? most : 0)};
  if (two) {
    const Pixels middle{planner.scratch(middle_format, static_cast<std::size_t>(p.width) * p.height), middle_format,
                        p.width};
    blur_axis(0, from, middle, false, cover(0), between);
    blur_axis(1, middle, to, false, cover(1), between);
  } else {
    const int axis = p.height > 1 ? 1 : 0;
    blur_axis(axis, from, to, false, cover(axis), between);
  }
}

}  // namespace luxel

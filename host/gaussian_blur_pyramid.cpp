// The pyramid variant: halve the image a few times, blur what is left, double it again.
#include "host/gaussian_blur.h"

#include <algorithm>
#include <cmath>

namespace luxel {

namespace {

// Coarse sigma below which a level too many is felt: the two-texel interpolation errs by 1e-3 there.
constexpr double least_coarse_sigma = 1.8;
constexpr int max_levels = 12;
constexpr double coarse_reach = 4;  // radius of the blur of the coarsest level, in its sigma: cuts off 5e-5

struct Filter {
  std::vector<double> down, up;  // up: of the first half of a coarse pixel, around its centre
  double variance;               // of both, in pixels^2 of the finer level
};

Filter filter_of(PyramidFilter filter) {
  if (filter == PyramidFilter::linear)
    return {{1 / 8.0, 3 / 8.0, 3 / 8.0, 1 / 8.0}, {1 / 4.0, 3 / 4.0, 0}, 3 / 4.0 + 3 / 4.0};
  // Six binomial weights, and a cubic B-spline at -1/4 from the centre: (1-t)^3 / 6 ... t^3 / 6 at t = 3/4.
  return {{1 / 32.0, 5 / 32.0, 10 / 32.0, 10 / 32.0, 5 / 32.0, 1 / 32.0},
          {1 / 384.0, 121 / 384.0, 235 / 384.0, 27 / 384.0, 0},
          5 / 4.0 + 4 / 3.0};
}

// Variance that a level passes on to the next coarser one, in its own pixels^2.
double coarse_variance(double variance, const Filter& f, int levels) {
  for (int l = 0; l < levels; ++l) variance = (variance - f.variance) / 4;
  return variance;
}

// Positions of an axis that a level holds, in its own pixels; 0 is the image's first pixel, or that which covers it.
struct Range {
  int low, high;
  int size() const { return high - low + 1; }
};

int half(int i) { return i >= 0 ? i / 2 : -((1 - i) / 2); }

// What an axis needs at each level, so that the border is where the image ends and nowhere else.
struct Axis {
  std::vector<Range> coarse;   // level 1..: on the way down
  std::vector<Range> blurred;  // level 0..: on the way up
};

Axis axis_of(int count, int levels, int radius, const Filter& f) {
  Axis a;
  a.blurred.assign(levels + 1, {0, count - 1});
  a.coarse = a.blurred;
  if (count == 1) return a;
  const int reach = static_cast<int>(f.up.size()) / 2, taps = static_cast<int>(f.down.size());
  for (int l = 0; l < levels; ++l) a.blurred[l + 1] = {half(a.blurred[l].low) - reach, half(a.blurred[l].high) + reach};
  a.coarse[levels] = {a.blurred[levels].low - radius, a.blurred[levels].high + radius};
  for (int l = levels - 1; l > 0; --l)
    a.coarse[l] = {2 * a.coarse[l + 1].low - (taps / 2 - 1), 2 * a.coarse[l + 1].high + taps / 2};
  return a;
}

// Moves the largest weight until they sum to 1.0f in the order in which the kernel adds them.
std::vector<double> rounded(std::vector<double> w) {
  for (double& v : w) v = static_cast<float>(v);
  const auto most = std::max_element(w.begin(), w.end());
  for (int tries = 0; tries < 8; ++tries) {
    float sum = 0;
    for (const double v : w) sum += static_cast<float>(v);
    *most = static_cast<float>(*most) + (1.0f - sum);
  }
  return w;
}

// What the coarsest level is blurred by.
GaussianBlurParams coarse_blur(const GaussianBlurParams& p, int levels) {
  GaussianBlurParams blur;
  blur.sigma = std::sqrt(std::max(0.0, coarse_variance(p.sigma * p.sigma, filter_of(p.filter), levels)));
  blur.radius = static_cast<int>(std::ceil(coarse_reach * blur.sigma));
  return blur;
}

}  // namespace

int least_levels(const GaussianBlurParams& p) {
  int levels = 0;
  while (levels < max_levels && coarse_blur(p, levels).radius > 4095) ++levels;
  return levels;
}

int most_levels(const GaussianBlurParams& p) {
  const Filter f = filter_of(p.filter);
  int levels = 0;
  while (levels < max_levels && coarse_variance(p.sigma * p.sigma, f, levels + 1) >= 0) ++levels;
  return levels;
}

int effective_levels(const GaussianBlurParams& p) {
  if (p.levels >= 0) return p.levels;
  const Filter f = filter_of(p.filter);
  int levels = 0;
  while (levels < max_levels &&
         coarse_variance(p.sigma * p.sigma, f, levels + 1) >= least_coarse_sigma * least_coarse_sigma)
    ++levels;
  return levels;
}

double pyramid_scratch(const GaussianBlurParams& p) {
  const int levels = effective_levels(p);
  if (levels == 0) return 0;
  const Filter f = filter_of(p.filter);
  const int radius = coarse_blur(p, levels).radius;
  return static_cast<double>(axis_of(p.width, levels, radius, f).coarse[1].size()) *
         axis_of(p.height, levels, radius, f).coarse[1].size() * channels(p.format);
}

void plan_pyramid(const GaussianBlurParams& p, const Profile& profile, Planner& planner, const Pixels& from,
                  const Pixels& to) {
  const int levels = effective_levels(p);
  GaussianBlurParams blur = coarse_blur(p, levels);
  if (levels == 0) {
    blur.width = p.width;
    blur.height = p.height;
    blur.border = p.border;
    blur.format = p.format;
    return plan_separable(blur, profile, planner, from, to);
  }
  const Filter f = filter_of(p.filter);
  const Slot down = planner.table(rounded(f.down), f.down), up = planner.table(rounded(f.up), f.up);
  const Slot nothing = planner.scratch(Format::f32x1, 1);

  // Down, blur, up; `ones`: of an image of ones.
  const auto build = [&](int width, int height, const Pixels& in, const Pixels& out, bool ones, bool covered,
                         Slot coverage_x, Slot coverage_y) {
    const Axis x = axis_of(width, levels, blur.radius, f), y = axis_of(height, levels, blur.radius, f);
    const bool scale_x = width > 1, scale_y = height > 1;
    const Format format = f32_of(out.format);
    const auto level = [&](const Range& across, const Range& down_) {
      return Pixels{planner.scratch(format, static_cast<std::size_t>(across.size()) * down_.size()), format,
                    across.size()};
    };
    // Position in the range `of` of the first tap that makes the first pixel of the next coarser range.
    const int before = static_cast<int>(f.down.size()) / 2 - 1, reach = static_cast<int>(f.up.size()) / 2;
    const auto first_down = [&](bool scale, const Range& coarse, const Range& of) {
      return scale ? 2 * coarse.low - before - of.low : 0;
    };
    Pixels last = in;
    Range last_x{0, width - 1}, last_y{0, height - 1};
    for (int l = 1; l <= levels; ++l) {
      const Range &to_x = x.coarse[l], &to_y = y.coarse[l];
      const Pixels next = level(to_x, to_y);
      const int block = profile.voxels.block;
      planner.pass(
          "gaussian_blur_down", module_of(last, next, profile), "gaussian_blur pyramid down",
          {static_cast<std::uint32_t>((to_x.size() + block - 1) / block), static_cast<std::uint32_t>(to_y.size()), 1},
          profile.pixels.workgroup,
          {{"src_width", last_x.size()},
           {"src_height", last_y.size()},
           {"dst_width", to_x.size()},
           {"dst_height", to_y.size()},
           {"src_stride", last.stride},
           {"first_x", first_down(scale_x, to_x, last_x)},
           {"first_y", first_down(scale_y, to_y, last_y)}},
          {{"TAPS", static_cast<double>(f.down.size())},
           {"HALVE_X", scale_x},
           {"HALVE_Y", scale_y},
           {"BORDER", static_cast<int>(p.border)},
           {"ONES", ones && l == 1},
           {"BLOCK", block}},
          {{"src", last.slot}, {"dst", next.slot}, {"weights", down}});
      planner.cost(2.0 * to_x.size() * to_y.size() * channels(format) * f.down.size() * 3,
                   1.0 * last_x.size() * last_y.size() * bytes_per_pixel(last.format) +
                       1.0 * to_x.size() * to_y.size() * bytes_per_pixel(format));
      last = next;
      last_x = to_x;
      last_y = to_y;
    }
    GaussianBlurParams coarse = blur;
    coarse.width = last_x.size();
    coarse.height = last_y.size();
    coarse.format = format;
    const Pixels blurred = level(last_x, last_y);
    plan_separable(coarse, profile, planner, last, blurred);
    last = blurred;
    for (int l = levels - 1; l >= 0; --l) {
      const Range &to_x = x.blurred[l], &to_y = y.blurred[l];
      const Pixels next = l == 0 ? out : level(to_x, to_y);
      const int block = profile.voxels.block;
      // The first coarse pixel that gives one of dst's, and how many do.
      const auto coarse_first = [&](bool scale, const Range& fine) { return scale ? half(fine.low) : 0; };
      const auto odd = [&](bool scale, const Range& fine) { return scale ? fine.low - 2 * half(fine.low) : 0; };
      const auto coarse_count = [&](bool scale, const Range& fine) {
        return scale ? half(fine.high) - half(fine.low) + 1 : 1;
      };
      const auto first_up = [&](bool scale, const Range& fine, const Range& of) {
        return scale ? coarse_first(scale, fine) - reach - of.low : 0;
      };
      planner.pass("gaussian_blur_up", module_of(last, next, profile), "gaussian_blur pyramid up",
                   {static_cast<std::uint32_t>((coarse_count(scale_x, to_x) + block - 1) / block),
                    static_cast<std::uint32_t>(coarse_count(scale_y, to_y)), 1},
                   profile.pixels.workgroup,
                   {{"src_width", last_x.size()},
                    {"src_height", last_y.size()},
                    {"dst_width", to_x.size()},
                    {"dst_height", to_y.size()},
                    {"src_stride", last.stride},
                    {"dst_stride", next.stride},
                    {"first_x", first_up(scale_x, to_x, last_x)},
                    {"first_y", first_up(scale_y, to_y, last_y)},
                    {"odd_x", odd(scale_x, to_x)},
                    {"odd_y", odd(scale_y, to_y)}},
                   {{"TAPS", static_cast<double>(f.up.size())},
                    {"DOUBLE_X", scale_x},
                    {"DOUBLE_Y", scale_y},
                    {"COVERED", covered && l == 0},
                    {"BLOCK", block}},
                   {{"src", last.slot},
                    {"dst", next.slot},
                    {"weights", up},
                    {"coverage_x", coverage_x},
                    {"coverage_y", coverage_y}});
      planner.cost(4.0 * to_x.size() * to_y.size() * channels(format) * f.up.size(),
                   1.0 * last_x.size() * last_y.size() * bytes_per_pixel(format) +
                       1.0 * to_x.size() * to_y.size() * bytes_per_pixel(next.format));
      last = next;
      last_x = to_x;
      last_y = to_y;
    }
  };
  // Where outside is nothing, results are divided by what becomes of ones, which is a product of both axes'.
  const auto cover = [&](int count) {
    if (p.border != Border::zero) return nothing;
    const Pixels covered{planner.scratch(Format::f32x1, count), Format::f32x1, count};
    build(count, 1, {nothing, Format::f32x1, count}, covered, true, false, nothing, nothing);
    return covered.slot;
  };
  const Slot coverage_x = cover(p.width), coverage_y = cover(p.height);
  build(p.width, p.height, from, to, false, p.border == Border::zero, coverage_x, coverage_y);
}

}  // namespace luxel

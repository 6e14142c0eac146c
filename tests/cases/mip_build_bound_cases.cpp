// Bounds of depth and distance: every size, NaN and infinity, and the addressing that they are promised for.
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "bench/truth/mip_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr int largest = 257;

std::string text(const MipBuildParams& p) {
  return fmt::format("{} {} {} ratio {}", name(p.variant), name(p.format), p.sizes == MipSizes::ceil ? "ceil" : "floor",
                     p.ratio);
}

// Texels outside the bounds of the texel that they are addressed to on the next level; level 0 bounds itself. An
// address on a level is the address of the level below it, addressed once more, so that a chain without a violation
// holds every texel of level 0 on every level, at an eighth of the comparisons.
double violations(const MipBuildParams& p, const Values& src, const Pyramid& pyramid) {
  double count = 0;
  const double* inner = src.data();
  int channels = 1;
  std::array<int, 3> from = {p.width, p.height, 1};
  for (int level = 1; pyramid.count(fmt::format("level_{}", level)) != 0; ++level) {
    const Values& bounds = pyramid.at(fmt::format("level_{}", level));
    const auto e = mip_extent(p, level);
    const int shift = p.ratio == 16 ? 4 : 1;
    const auto address = [&](int at, int n) {
      return p.sizes == MipSizes::ceil ? at >> shift : std::min(at >> shift, n - 1);
    };
    for (int y = 0; y < from[1]; ++y) {
      const double* row = &bounds[static_cast<std::size_t>(address(y, e[1])) * e[0] * 2];
      for (int x = 0; x < from[0]; ++x, inner += channels) {
        const double* b = row + address(x, e[0]) * 2;
        count += b[0] <= inner[0] && inner[channels - 1] <= b[1] ? 0 : 1;
      }
    }
    inner = bounds.data();
    channels = 2;
    from = e;
  }
  return count;
}

Result<double> violations_of_size(Context& context, MipBuildParams p, int width, int height) {
  p.width = width;
  p.height = height;
  static const Values square = mip_distances(static_cast<std::size_t>(largest) * largest, 41);  // all sizes are cut from it
  Values src;
  src.reserve(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) src.insert(src.end(), &square[y * largest], &square[y * largest] + width);
  const auto levels = build(context, p, src);
  if (!levels) return levels.status();
  return violations(p, src, levels.value());
}

// Over sizes: every width of `widths` with every height of `heights`.
Case over_sizes(const MipBuildParams& p, std::string sizes, std::vector<int> widths, std::vector<int> heights,
                bool slow) {
  return {"",
          fmt::format("bounds, {}, {}", text(p), sizes),
          "every texel of level 0 lies within the bounds of its texel on every level (violations)",
          0,
          [=](Context& context) -> Result<double> {
            double sum = 0;
            for (const int width : widths)
              for (const int height : heights) {
                if (width * height == 1) continue;
                const auto count = violations_of_size(context, p, width, height);
                if (!count) return count.status();
                sum += count.value();
              }
            return sum;
          },
          slow};
}

std::vector<int> all_sizes() {
  std::vector<int> sizes;
  for (int n = 1; n <= largest; ++n) sizes.push_back(n);
  return sizes;
}

void add_not_numbers(std::vector<Case>& cases, const MipBuildParams& p) {
  cases.push_back(
      {"", "NaN and infinity, " + text(p),
       "NaN counts as nothing unless there is nothing else; infinities count (values that differ from that)", 0,
       [=](Context& context) -> Result<double> {
         Values src = mip_distances(static_cast<std::size_t>(p.width) * p.height, 42);
         for (std::size_t i = 0; i < src.size(); ++i) {
           const double kind = scene::random01(static_cast<std::uint32_t>(i), 43);
           if (kind < 0.4 || (i % p.width < 4 && i / p.width < 8))
             src[i] = std::numeric_limits<double>::quiet_NaN();
           else if (kind < 0.45)
             src[i] = HUGE_VAL;
         }
         const auto levels = build(context, p, src);
         if (!levels) return levels.status();
         const auto truth = truth::pyramid(p, src);
         double different = 0;
         for (const auto& [name, v] : levels.value()) different += count_different(v, truth[level_of(name)].values);
         return different;
       }});
}

}  // namespace

void add_mip_bound_cases(std::vector<Case>& cases) {
  for (const MipSizes sizes : {MipSizes::floor, MipSizes::ceil})
    for (const int ratio : {2, 16}) {
      MipBuildParams p = mip_params(MipVariant::minmax, Format::f32x2, {16, 16, 1});
      p.sizes = sizes;
      p.ratio = ratio;
      add_not_numbers(cases, p);
      for (const Format format : {Format::f32x2, Format::f16x2}) {
        p.format = format;
        cases.push_back(over_sizes(p, "25 sizes", {1, 2, 33, 127, 257}, {1, 3, 16, 129, 255}, false));
      }
      p.format = Format::f32x2;
      cases.push_back(
          over_sizes(p, "every width from 1 to 257 with heights 1, 32, 257", all_sizes(), {1, 32, 257}, true));
      if (ratio == 16) {  // texels along an axis are found from that axis alone; all pairs are walked for ratio 2
        cases.push_back(
            over_sizes(p, "every height from 1 to 257 with widths 1, 32, 257", {1, 32, 257}, all_sizes(), true));
        continue;
      }
      cases.push_back(over_sizes(p, "every width and height from 1 to 257", all_sizes(), all_sizes(), true));
      // The devices give the bits of this one (other cases), and a launch and a wait for each of 66,048 sizes take
      // minutes.
      cases.back().applies = [](const DeviceInfo& device) { return device.id == "cpu:float"; };
    }
}

}  // namespace luxel::cases

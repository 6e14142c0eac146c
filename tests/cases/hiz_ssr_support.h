// What the cases of hiz_ssr share.
#pragma once
#include <span>
#include <vector>

#include <luxel/hiz_ssr.h>

#include "bench/truth/ssr_truth.h"
#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

/// A view of 60 degrees over this many pixels.
HizSsrParams ssr_params(int width, int height, SsrVariant variant = SsrVariant::hiz);

/// Depth as a convention stores it, rounded to f32. Infinite: no surface.
double stored_depth(const HizSsrParams& params, double depth);
Values stored_depths(const HizSsrParams& params, std::span<const double> depths);

/// Hills, cliffs, thin poles and patches of sky, depths from 1 to 10, rounded to f32.
Values height_field(int width, int height, std::uint32_t seed);

/// Rays of all kinds, from anywhere in the view, as the kernel's list has them (8 values each), rounded to f32.
Values screen_rays(const HizSsrParams& params, int count, std::uint32_t seed);
void add_ray(Values& rays, std::array<double, 3> origin, std::array<double, 3> direction, double reach = 0);

/// A depth image with the levels that the parameters ask for, by mip_build on the device.
Result<Values> with_pyramid(Context& context, const HizSsrParams& params, std::span<const double> stored);

struct SsrResult {
  Values hits, paths, counters, directions, radiance;  // empty where not asked for
  SsrOutcome outcome(std::size_t ray) const { return static_cast<SsrOutcome>(static_cast<int>(paths[4 * ray + 1])); }
};

/// What shading reads: level 0 of the colours, and the table as it is read back from the device.
struct SsrColours {
  Values colour, fallback, specular, split_sum;
};

/// Follows the rays (params.rays) or those of the pixels: `source` is the list or the normals.
Result<SsrResult> follow(Context& context, const HizSsrParams& params, std::span<const double> stored,
                         std::span<const double> source, const SsrColours& colours = {});

/// The split-sum table, made on the device.
Result<Values> split_sum_table(Context& context, int size, int samples);

/// The rays that were followed, as the truth takes them; false where there is none.
bool ray_of(const HizSsrParams& params, std::span<const double> stored, std::span<const double> source, std::size_t ray,
            truth::ScreenRay& to);

/// How the answers compare with the exhaustive walk. `broken`: answers that are not finite, out of range, or hits whose
/// place and length do not agree.
struct Agreement {
  int rays = 0, hits = 0, equal = 0, ties = 0, wrong = 0, broken = 0, missed = 0;
};
Agreement compare(const HizSsrParams& params, std::span<const double> stored, std::span<const double> source,
                  const SsrResult& result);

/// Cases in these files, in the order of hiz_ssr_cases().
void add_ssr_walk_cases(std::vector<Case>& cases);
void add_ssr_value_cases(std::vector<Case>& cases);
void add_ssr_shade_cases(std::vector<Case>& cases);

}  // namespace luxel::cases

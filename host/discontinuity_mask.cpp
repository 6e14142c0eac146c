#include <luxel/discontinuity_mask.h>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

Status validate(const DiscontinuityMaskParams& p) {
  LUXEL_CHECK(check_range("DiscontinuityMaskParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("DiscontinuityMaskParams.height", p.height, 1, 65535));
  LUXEL_CHECK(check_range("DiscontinuityMaskParams.depth_threshold", p.depth_threshold, 0.0, 1.0));
  if (p.normal) {
    LUXEL_CHECK(check_range("DiscontinuityMaskParams.normal_threshold", p.normal_threshold, -1.0, 1.0));
    if (p.normal_format != Format::f32x4 && p.normal_format != Format::f16x4 && p.normal_format != Format::unorm8x4)
      return out_of_range("DiscontinuityMaskParams.normal_format", name(p.normal_format), "f32x4, f16x4 or unorm8x4");
  }
  if (static_cast<long long>(p.width) * p.height > 0x1fffffffLL)
    return out_of_range("DiscontinuityMaskParams.height", p.height, "width x height of at most 536870911");
  return {};
}

Result<Plan> plan(const DiscontinuityMaskParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const std::size_t pixels = static_cast<std::size_t>(p.width) * p.height;
  Planner planner("discontinuity_mask");
  Resource depth{"depth"}, normals{"normals"}, mask{"mask"};
  depth.format = Format::f32x1;
  depth.bytes = 4 * pixels;
  normals.format = p.normal_format;
  normals.bytes = pixels * bytes_per_pixel(p.normal_format);
  mask.format = Format::u32;
  mask.bytes = 4 * pixels;
  mask.written = true;
  const Slot z = planner.resource(depth), n = p.normal ? planner.resource(normals) : z, to = planner.resource(mask);
  const bool unorm = p.normal_format == Format::unorm8x4;
  planner.pass("discontinuity_mask", p.normal ? name(p.normal_format) : "depth", "discontinuity_mask",
               {static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1}, profile.pixels.workgroup,
               {{"width", p.width},
                {"height", p.height},
                {"depth_threshold", p.depth_threshold},
                {"normal_threshold", p.normal_threshold},
                {"scale", unorm ? 2 : 1},
                {"offset", unorm ? -1 : 0}},
               {}, {{"depth", z}, {"normals", n}, {"mask", to}});
  planner.cost(
      60.0 * static_cast<double>(pixels),
      static_cast<double>(pixels) * (8.0 + (p.normal ? static_cast<double>(bytes_per_pixel(p.normal_format)) : 0.0)));
  return std::move(planner).finish();
}

}  // namespace luxel

#include <luxel/outlier_clamp.h>

#include <algorithm>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

Status validate(const OutlierClampParams& p) {
  LUXEL_CHECK(check_range("OutlierClampParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("OutlierClampParams.height", p.height, 1, 65535));
  if (p.src_stride != 0) LUXEL_CHECK(check_range("OutlierClampParams.src_stride", p.src_stride, p.width, 1 << 20));
  if (p.dst_stride != 0) LUXEL_CHECK(check_range("OutlierClampParams.dst_stride", p.dst_stride, p.width, 1 << 20));
  LUXEL_CHECK(check_range("OutlierClampParams.variant", static_cast<int>(p.variant), 0, 1));
  LUXEL_CHECK(check_range("OutlierClampParams.radius", p.radius, 1, 3));
  LUXEL_CHECK(check_range("OutlierClampParams.k", p.k, 0.0, 1e6));
  if (p.format != Format::f32x1 && p.format != Format::f32x4 && p.format != Format::f16x4)
    return out_of_range("OutlierClampParams.format", name(p.format), "f32x1, f32x4 or f16x4");
  const long long pixels = static_cast<long long>(std::max({p.src_stride, p.dst_stride, p.width})) * p.height;
  if (pixels * 4 > 0x7fffffffLL)
    return out_of_range("OutlierClampParams.height", p.height, "stride x height of at most 536870911");
  return {};
}

Result<Plan> plan(const OutlierClampParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const int src_stride = p.src_stride ? p.src_stride : p.width, dst_stride = p.dst_stride ? p.dst_stride : p.width;
  Planner planner("outlier_clamp");
  Resource src{"src"}, dst{"dst"};
  src.format = dst.format = p.format;
  src.bytes = (static_cast<std::size_t>(p.height - 1) * src_stride + p.width) * bytes_per_pixel(p.format);
  dst.bytes = (static_cast<std::size_t>(p.height - 1) * dst_stride + p.width) * bytes_per_pixel(p.format);
  dst.written = true;
  const Slot from = planner.resource(src), to = planner.resource(dst);
  Slot counters;
  if (p.count) {
    Resource r{"counters"};
    r.format = Format::u32;
    r.bytes = 8;
    r.written = true;
    counters = planner.resource(r);
  } else {
    counters = planner.scratch(Format::u32, 2);
  }
  planner.pass(
      "outlier_clamp", name(p.format), "outlier_clamp",
      {static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1}, profile.pixels.workgroup,
      {{"width", p.width}, {"height", p.height}, {"src_stride", src_stride}, {"dst_stride", dst_stride}, {"k", p.k}},
      {{"RADIUS", p.radius}, {"MEDIAN", p.variant == OutlierVariant::median}, {"COUNTED", p.count}},
      {{"src", from}, {"dst", to}, {"counters", counters}});
  const double n = (2.0 * p.radius + 1) * (2.0 * p.radius + 1) - 1, pixels = static_cast<double>(p.width) * p.height;
  planner.cost(pixels * (p.variant == OutlierVariant::mean ? 8 * n : 6 * n * n),
               pixels * 2 * bytes_per_pixel(p.format));
  return std::move(planner).finish();
}

}  // namespace luxel

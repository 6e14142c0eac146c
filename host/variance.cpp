#include <luxel/variance.h>

#include <algorithm>

#include "host/check.h"
#include "host/planner.h"

namespace luxel {

Status validate(const VarianceParams& p) {
  LUXEL_CHECK(check_range("VarianceParams.width", p.width, 1, 65535));
  LUXEL_CHECK(check_range("VarianceParams.height", p.height, 1, 65535));
  if (p.src_stride != 0) LUXEL_CHECK(check_range("VarianceParams.src_stride", p.src_stride, p.width, 1 << 20));
  LUXEL_CHECK(check_range("VarianceParams.variant", static_cast<int>(p.variant), 0, 1));
  LUXEL_CHECK(check_range("VarianceParams.radius", p.radius, 1, 16));
  if (p.variant == VarianceVariant::temporal) {
    LUXEL_CHECK(check_range("VarianceParams.alpha", p.alpha, 0.0, 0.9));
    LUXEL_CHECK(check_range("VarianceParams.shortest", p.shortest, 2, 1024));
  }
  if (p.format == Format::u32 || p.format == Format::f16x2 || name(p.format) == name(static_cast<Format>(-1)))
    return out_of_range("VarianceParams.format", name(p.format), "f32x1, f32x2, f32x4, f16x4 or unorm8x4");
  const long long pixels = static_cast<long long>(std::max(p.src_stride, p.width)) * p.height;
  if (pixels * 4 > 0x7fffffffLL)
    return out_of_range("VarianceParams.height", p.height, "stride x height of at most 536870911");
  return {};
}

Result<Plan> plan(const VarianceParams& p, const Profile& profile) {
  LUXEL_CHECK(validate(p));
  const int stride = p.src_stride ? p.src_stride : p.width;
  const std::size_t pixels = static_cast<std::size_t>(p.width) * p.height;
  Planner planner("variance");
  const auto resource = [&](const char* name, Format format, std::size_t count, bool written) {
    Resource r{name};
    r.format = format;
    r.bytes = count * bytes_per_pixel(format);
    r.written = written;
    return planner.resource(r);
  };
  const Slot src = resource("src", p.format, static_cast<std::size_t>(p.height - 1) * stride + p.width, false);
  const Slot to = resource("variances", Format::f32x1, pixels, true);
  const std::array<std::uint32_t, 3> over{static_cast<std::uint32_t>(p.width), static_cast<std::uint32_t>(p.height), 1};
  planner.pass("variance", name(p.format), "variance spatial", over, profile.pixels.workgroup,
               {{"width", p.width}, {"height", p.height}, {"src_stride", stride}}, {{"RADIUS", p.radius}},
               {{"src", src}, {"variances", to}});
  const double side = 2.0 * p.radius + 1;
  planner.cost(11.0 * side * side * static_cast<double>(pixels),
               static_cast<double>(pixels * (bytes_per_pixel(p.format) + 4)));
  if (p.variant == VarianceVariant::temporal) {
    const Slot history = resource("history", Format::f32x1, 3 * pixels, false);
    const Slot history_out = resource("history_out", Format::f32x1, 3 * pixels, true);
    planner.pass("variance_temporal", name(p.format), "variance temporal", over, profile.pixels.workgroup,
                 {{"width", p.width},
                  {"height", p.height},
                  {"src_stride", stride},
                  {"alpha", p.alpha},
                  {"shortest", p.shortest}},
                 {}, {{"src", src}, {"history", history}, {"history_out", history_out}, {"variances", to}});
    planner.cost(20.0 * static_cast<double>(pixels), static_cast<double>(pixels * (bytes_per_pixel(p.format) + 28)));
  }
  return std::move(planner).finish();
}

}  // namespace luxel

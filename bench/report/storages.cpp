// What storage in f16 and unorm8 costs beside f32: the same input, held by the narrow format, through both.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "bench/report/instruments.h"
#include "bench/scene/images.h"
#include "bench/scene/volumes.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/storage.h"
#include "tests/cases/voxelize_support.h"

namespace luxel::report {
namespace {

using cases::Values;

// The largest difference in steps of the format at the wide value. A step of f16 doubles at powers of two: the larger of the two
// sides counts.
Found in_steps(const Values& narrow, const Values& wide, Format format) {
  Found f;
  if (narrow.size() != wide.size()) return {std::nan(""), "results of different size"};
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    const double step = std::max(cases::step(format, wide[i]), cases::step(format, narrow[i]));
    const double off = std::fabs(narrow[i] - wide[i]) / step;
    if (!(off <= f.measured)) f = {off, fmt::format("where f32 has {:.3g}", wide[i])};
  }
  return f;
}

// Half a step, and what f32 rounds before it.
constexpr double half_a_step = 0.5 + 2e-3;

using Through = std::function<Result<Found>(Context& device, Format format, bool quick)>;

void add(std::vector<Instrument>& all, const char* kernel, const char* promise, double f16, double unorm8, const Through& through) {
  for (const Format format : {Format::f16x4, Format::unorm8x4}) {
    const double bound = format == Format::f16x4 ? f16 : unorm8;
    if (bound <= 0) continue;  // not a format of the kernel
    all.push_back({kernel, kernel, fmt::format("storage: {}", name(format)), promise, bound,
                   [through, format](Context& device, Context&, bool quick) { return through(device, format, quick); }});
  }
}

Values picture(Format format, int width, int height) { return cases::quantise(scene::noise(width, height, 4, 17), format); }

Result<Found> blurred(Context& device, Format format, bool) {
  const GaussianBlurParams narrow = cases::blur_params(64, 48, 2, 6, format), wide = cases::blur_params(64, 48, 2, 6);
  const Values src = picture(format, 64, 48);
  const auto a = cases::blur(device, narrow, src), b = cases::blur(device, wide, src);
  if (!a) return a.status();
  if (!b) return b.status();
  return in_steps(a.value(), b.value(), format);
}

Result<Found> filtered(Context& device, Format format, bool) {
  BilateralParams p;
  p.width = 64, p.height = 48;
  p.radius = 3, p.sigma_space = 1.5, p.sigma_range = 0.3;
  cases::BilateralImages images;
  images.src = picture(format, p.width, p.height);
  const auto b = cases::filter(device, p, images);
  p.format = format;
  const auto a = cases::filter(device, p, images);
  if (!a) return a.status();
  if (!b) return b.status();
  return in_steps(a.value().dst, b.value().dst, format);
}

Result<Found> pyramids(Context& device, Format format, bool quick) {
  const int n = quick ? 16 : 64;
  const MipBuildParams narrow = cases::mip_params(MipVariant::isotropic, format, {n, n, n}),
                       wide = cases::mip_params(MipVariant::isotropic, Format::f32x4, {n, n, n});
  const Values src = cases::quantise(cases::mip_input(wide, 4), format);
  const auto a = cases::build(device, narrow, src), b = cases::build(device, wide, src);
  if (!a) return a.status();
  if (!b) return b.status();
  Found f;
  for (const auto& [name, values] : b.value()) {
    // A level is made from the one before as it is stored: steps add up. Those of f16 at the level's largest value, from
    // which the means come.
    const double level = cases::level_of(name);
    double most = 0;
    for (const double v : values) most = std::max(most, std::fabs(v));
    const double off = cases::max_difference(a.value().at(name), values) / cases::step(format, 2 * most) / level;
    if (!(off <= f.measured)) f = {off, "on " + name};
  }
  return f;
}

// Relative to the largest irradiance, in units of half a step of the format at 1.
Result<Found> cones(Context& device, Format format, bool quick) {
  const int n = quick ? 16 : 32;
  ConeTraceParams p = cases::cone_params(n);
  p.voxel = 1.0 / n;
  p.width = 64, p.height = 1;
  Values volume = cases::quantise(scene::voxel_room(n), format);
  const Values receivers = cases::cone_receivers(p, 64, 7);
  const auto b = cases::trace(device, p, volume, receivers);
  p.format = format;
  const auto a = cases::trace(device, p, volume, receivers);
  if (!a) return a.status();
  if (!b) return b.status();
  double most = 0;
  for (const double v : b.value().irradiance) most = std::max(most, std::fabs(v));
  const double half = (format == Format::f16x4 ? 0x1p-11 : 0.5 / 255);
  return Found{cases::max_difference(a.value().irradiance, b.value().irradiance) / std::numbers::pi / half,
               fmt::format("{} levels; largest irradiance {:.3g}", std::log2(n) + 1, most)};
}

Result<Found> propagated(Context& device, Format format, bool) {
  LpvPropagateParams p = cases::lpv_params({16, 8, 8});
  p.iterations = 8;
  const Values light = cases::quantise(truth::lpv_to_pixels(p.grid, 2, cases::lpv_lights(p.grid, 2, 20, 7)), format);
  const auto b = cases::propagate(device, p, light);
  p.format = format;
  const auto a = cases::propagate(device, p, light);
  if (!a) return a.status();
  if (!b) return b.status();
  return in_steps(a.value(), b.value(), format);
}

Result<Found> voxels(Context& device, Format format, bool quick) {
  const VoxelGrid grid = cases::unit_grid(quick ? 16 : 32);
  cases::Mesh mesh = cases::awkward_mesh(quick ? 200 : 1000, quick ? 16 : 32, 3);
  mesh.materials.clear();
  for (std::size_t t = 0; t < mesh.triangles(); ++t) mesh.materials.push_back(static_cast<std::uint32_t>(t % 3));
  const Result<VoxelTriangles> triangles = voxel_triangles(mesh.view(), grid);
  if (!triangles) return triangles.status();
  VoxelizeParams p = voxelize_params(grid, triangles.value());
  p.opacity = true;
  p.materials = static_cast<int>(cases::paints().size());
  const auto b = cases::voxelize(device, p, triangles.value(), cases::paints());
  p.format = format;
  const auto a = cases::voxelize(device, p, triangles.value(), cases::paints());
  if (!a) return a.status();
  if (!b) return b.status();
  // Coverage is raised to a step of unorm8: what f32 has below is not compared.
  Values narrow, wide;
  for (std::size_t i = 0; i < b.value().colour.size(); i += 4)
    for (std::size_t c = 0; c < 4; ++c)
      if (c < 3 || b.value().colour[i + 3] >= 1.0 / 255) narrow.push_back(a.value().colour[i + c]), wide.push_back(b.value().colour[i + c]);
  return in_steps(narrow, wide, format);
}

}  // namespace

void add_storages(std::vector<Instrument>& all) {
  add(all, "gaussian_blur", "largest difference to f32 in steps of the format: the result is rounded once", half_a_step, half_a_step, blurred);
  add(all, "bilateral", "largest difference to f32 in steps of the format: the result is rounded once", half_a_step, half_a_step, filtered);
  add(all, "mip_build", "largest difference to f32 a level, in steps of the format at the largest value: each level is rounded once",
      half_a_step, half_a_step, pyramids);
  // Half a step a level, of radiance and of opacity, each of which an over-composite passes on at most whole.
  add(all, "cone_trace", "largest difference of irradiance / pi to f32 in half steps of the format at 1: levels, of radiance and of opacity", 10,
      10, cones);
  add(all, "light_propagation", "largest difference to f32 in steps of the format: light between steps is f32, the sum is rounded once", half_a_step,
      0, propagated);
  add(all, "voxelize", "largest difference to f32 in steps of the format: the mean is rounded once", half_a_step, half_a_step, voxels);
}

}  // namespace luxel::report

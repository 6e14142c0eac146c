// How rounding grows with size, steps and distance: the device's result in float against the C++ execution in double.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/report/instruments.h"
#include "bench/scene/images.h"
#include "bench/scene/volumes.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"
#include "tests/cases/voxelize_support.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;
using Points = std::vector<std::pair<double, double>>;

double largest(const Values& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::fabs(x));
  return most;
}

// Largest |a - b| over the largest |b|, where both were made.
Result<double> apart(const Result<Values>& a, const Result<Values>& b) {
  if (!a) return a.status();
  if (!b) return b.status();
  return cases::max_difference(a.value(), b.value()) / largest(b.value());
}

using OnBoth = std::function<Result<double>(Context& device, Context& exact, double size)>;

Instrument growth(const char* family, const char* kernel, const char* what, const char* promise, double bound, std::vector<double> sizes,
                  std::vector<double> quick_sizes, OnBoth error) {
  return {family, kernel, fmt::format("growth: rounding with {}", what), promise, bound,
          [=](Context& device, Context& exact, bool quick) -> Result<Found> {
            Points points;
            for (const double size : quick ? quick_sizes : sizes) {
              const Result<double> e = error(device, exact, size);
              if (!e) return e.status();
              points.emplace_back(size, e.value());
            }
            return fitted_power(fmt::format("relative error by {}", what), points);
          }};
}

Result<double> recursive(Context& device, Context& exact, double sigma) {
  const int width = std::clamp(static_cast<int>(8 * sigma), 256, 4096);
  const GaussianBlurParams p = cases::blur_params(width, 4, sigma, -1, Format::f32x1, Border::clamp, GaussianVariant::recursive);
  const Values src = cases::quantise(scene::noise(width, 4, 1, 21), Format::f32x1);
  return apart(cases::blur(device, p, src), cases::blur(exact, p, src));
}

Result<double> mips(Context& device, Context& exact, double side) {
  const int n = static_cast<int>(side);
  const MipBuildParams p = cases::mip_params(MipVariant::isotropic, Format::f32x4, {n, n, n});
  const Values src = cases::mip_input(p, 3);
  const auto a = cases::build(device, p, src), b = cases::build(exact, p, src);
  if (!a) return a.status();
  if (!b) return b.status();
  double most = 0;
  for (const auto& [name, values] : b.value())
    if (const double d = cases::max_difference(a.value().at(name), values) / largest(values); !(d <= most)) most = d;
  return most;
}

Result<double> cones(Context& device, Context& exact, double side) {
  ConeTraceParams p = cases::cone_params(static_cast<int>(side));
  p.voxel = 1 / side;
  p.width = 64, p.height = 1;
  p.environment = {1, 0.5, 0.25};
  Values volume = scene::voxel_room(static_cast<int>(side));
  const Values receivers = cases::cone_receivers(p, 64, 7);
  const auto a = cases::trace(device, p, volume, receivers), b = cases::trace(exact, p, volume, receivers);
  if (!a) return a.status();
  if (!b) return b.status();
  return cases::max_difference(a.value().irradiance, b.value().irradiance) / largest(b.value().irradiance);
}

Result<double> propagation(Context& device, Context& exact, double steps) {
  LpvPropagateParams p = cases::lpv_params({16, 8, 8});
  p.border = LpvBorder::periodic;
  p.iterations = static_cast<int>(steps);
  const Values light = cases::quantise(truth::lpv_to_pixels(p.grid, 2, cases::lpv_lights(p.grid, 2, 20, 7)), Format::f32x4);
  return apart(cases::propagate(device, p, light), cases::propagate(exact, p, light));
}

Result<double> bilateral(Context& device, Context& exact, double radius) {
  BilateralParams p;
  p.width = p.height = 64;
  p.radius = static_cast<int>(radius), p.sigma_space = radius / 2, p.sigma_range = 0.3;
  cases::BilateralImages images;
  images.src = cases::quantise(scene::noise(p.width, p.height, 4, 31), Format::f32x4);
  const auto a = cases::filter(device, p, images), b = cases::filter(exact, p, images);
  if (!a) return a.status();
  if (!b) return b.status();
  return cases::max_difference(a.value().dst, b.value().dst) / largest(b.value().dst);
}

// The mean difference of the lengths of rays that end on the same pixel, over their length: rays that part are ties, not rounding.
Result<double> screen(Context& device, Context& exact, double width) {
  const int w = static_cast<int>(width), h = w / 2;
  HizSsrParams p = cases::ssr_params(w, h);
  p.rays = 400;
  const Values depth = cases::height_field(w, h, 5), stored = cases::stored_depths(p, depth), rays = cases::screen_rays(p, 400, 9);
  const auto a = cases::follow(device, p, stored, rays), b = cases::follow(exact, p, stored, rays);
  if (!a) return a.status();
  if (!b) return b.status();
  double sum = 0, both = 0;
  for (std::size_t i = 0; i < 400; ++i) {
    if (a.value().outcome(i) != SsrOutcome::hit || b.value().outcome(i) != SsrOutcome::hit) continue;
    const double u = a.value().hits[4 * i], v = a.value().hits[4 * i + 1], x = b.value().hits[4 * i], y = b.value().hits[4 * i + 1];
    const double off = std::hypot((u - x) * w, (v - y) * h);  // pixels
    if (off < 1) sum += off, both += 1;
  }
  return both > 0 ? sum / both : std::nan("");
}

// A ball seen by eight probes, in a scene of any scale.
Result<double> probes(Context& device, Context& exact, double scale) {
  ProbeGrid g;
  g.count = {2, 2, 2};
  for (std::size_t k = 0; k < 3; ++k) g.origin[k] = static_cast<float>(-0.5 * scale), g.spacing[k] = static_cast<float>(scale);
  ProbeMaps m;
  m.size = 64;
  m.distance = ProbeDistance::f32;
  const auto values = cases::texel_values(64, 8, [&](int probe, const std::array<double, 3>& d, std::array<double, 3>& n) {
    const std::array<double, 3> c{(probe & 1) - 0.5, (probe >> 1 & 1) - 0.5, (probe >> 2) - 0.5};
    double b = 0, cc = -0.09;
    for (std::size_t k = 0; k < 3; ++k) b += c[k] * d[k], cc += c[k] * c[k];
    if (b * b <= cc || -b - std::sqrt(b * b - cc) <= 0) return 1e30;
    const double t = -b - std::sqrt(b * b - cc);
    for (std::size_t k = 0; k < 3; ++k) n[k] = (c[k] + t * d[k]) / 0.3;
    return t * scale;
  });
  std::vector<cases::Ray> rays;
  for (int i = 0; i < 500; ++i) {
    cases::Ray r;
    double length = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      r.origin[k] = (0.9 * (scene::hash(3 * static_cast<std::uint32_t>(i) + k) * 0x1p-32) - 0.45) * scale;
      r.direction[k] = scene::hash(7000 + 3 * static_cast<std::uint32_t>(i) + k) * 0x1p-31 - 1;
      length += r.direction[k] * r.direction[k];
    }
    for (double& c : r.direction) c = static_cast<float>(c / std::sqrt(length));
    rays.push_back(r);
  }
  Values hits[2], texels[2];
  Context* const contexts[] = {&device, &exact};
  for (int k = 0; k < 2; ++k) {
    auto scene = cases::ProbeScene::make(*contexts[k], m, g, values);
    if (!scene) return scene.status();
    auto traced = scene.value().trace({}, cases::ray_values(rays));
    if (!traced) return traced.status();
    hits[k] = traced.value().hits, texels[k] = traced.value().texels;
  }
  double sum = 0, both = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[0][4 * i + 1] == 1 && hits[1][4 * i + 1] == 1 && texels[0][i] == texels[1][i]) {
      sum += std::fabs(hits[0][4 * i] / hits[1][4 * i] - 1);
      both += 1;
    }
  return both > 0 ? sum / both : std::nan("");
}

// Small walls across x far from the origin, their vertices in floats on the device: voxels that they have and those in double
// have not, or the other way round, over all. A wall changes its layer with a chance of a quarter of a float's step.
Result<double> far_walls(Context& device, Context&, double away) {
  constexpr int n = 48;
  VoxelGrid grid = cases::unit_grid(n);
  cases::Mesh there;
  for (std::uint32_t i = 0; i < 4 * n * n; ++i) {
    const double x = away + 12 * (i % 4) + 1 + 10 * (scene::hash(i) * 0x1p-32), y = away + i / 4 % n, z = away + i / 4 / n;
    there.add({x, y + 0.3, z + 0.3, x, y + 0.7, z + 0.3, x, y + 0.5, z + 0.7});
  }
  grid.origin = {away, away, away};
  const Result<VoxelTriangles> triangles = voxel_triangles(there.view(), grid);
  if (!triangles) return triangles.status();
  VoxelizeParams p = voxelize_params(grid, triangles.value());
  const auto expected = cases::voxelize(device, p, triangles.value());
  if (!expected) return expected.status();
  p.device_vertices = p.device_materials = true;
  p.triangles = static_cast<int>(there.triangles());
  p.vertices = static_cast<int>(there.positions.size() / 3);
  p.origin = grid.origin, p.voxel = grid.voxel;
  Result<Run> made = Run::make(device, plan(p, device.profile()));
  if (!made) return made.status();
  const Values indices(there.indices.begin(), there.indices.end()), materials(there.triangles(), 0.0);
  if (Status s = made.value().write("positions", there.positions); !s) return s;
  if (Status s = made.value().write("indices", indices); !s) return s;
  if (Status s = made.value().write("triangle_materials", materials); !s) return s;
  if (Status s = made.value().write("materials", Values{1, 1, 1, 1, 0, 0, 0, 0}); !s) return s;
  if (Status s = made.value().go(); !s) return s;
  const auto colour = made.value().read("colour");
  if (!colour) return colour.status();
  double wrong = 0, all = 0;
  for (std::size_t i = 3; i < colour.value().size(); i += 4) {
    const bool a = colour.value()[i] > 0, b = expected.value().colour[i] > 0;
    wrong += a != b, all += b;
  }
  return wrong / all;
}

}  // namespace

void add_growths(std::vector<Instrument>& all) {
  all.push_back(growth("gaussian_blur", "gaussian_blur", "sigma of the recursive filter", "the power of sigma: poles lie 1 / sigma from 1, at most linear", 1.0,
                       {1, 4, 16, 64, 256, 1000}, {1, 4, 16, 64}, recursive));
  all.push_back(growth("bilateral", "bilateral", "the radius", "the power of the radius: a sum of (2R + 1)^2 terms, at most quadratic", 2.0,
                       {1, 2, 4, 8, 16}, {1, 2, 4, 8}, bilateral));
  // Errors of l levels on a side of 2^l: from 8 to 64 they double, log(2) / log(8), and further on they grow less.
  all.push_back(growth("mip_build", "mip_build", "the side of a volume", "the power of the side: a few roundings a level, levels grow as its logarithm", 0.34,
                       {8, 16, 32, 64, 128}, {8, 16, 32, 64}, mips));
  all.push_back(growth("cone_trace", "cone_trace", "the resolution, and steps with it", "the power of the resolution: a sum along the cone, at most linear", 1.0,
                       {8, 16, 32, 64, 128}, {8, 16, 32, 64}, cones));
  all.push_back(growth("light_propagation", "light_propagation", "steps", "the power of the number of steps, at most linear", 1.0,
                       {4, 16, 64, 256, 1000}, {4, 16, 64, 256}, propagation));
  all.push_back(growth("hiz_ssr", "hiz_ssr", "the width of the screen", "the power of the width, of the distance in pixels: a pixel is the smaller part of the screen, at most linear", 1.0,
                       {64, 128, 256, 512, 1024}, {32, 64, 128, 256}, screen));
  all.push_back(growth("octahedral_march", "octahedral_march", "the scale of the scene", "the power of the scale: none, to a twentieth", 0.05,
                       {1e-3, 1e-1, 10, 1e3, 1e4}, {1e-3, 1, 1e2, 1e4}, probes));
  all.push_back(growth("voxelize", "voxelize", "the distance from the origin, vertices in floats", "the power of the distance, of voxels missing or extra: linear, and a tenth for counts of some tens of voxels", 1.1,
                       {0x1.8p16, 0x1.8p17, 0x1.8p18, 0x1.8p19, 0x1.8p20, 0x1.8p21}, {0x1.8p16, 0x1.8p18, 0x1.8p20, 0x1.8p21}, far_walls));
}

}  // namespace luxel::report

// How far behind a documented limit things go wrong, by bisection. A row's number is limit / edge (edge / limit for what
// must not be smaller): 1 where it goes wrong right at the limit, less where there is room. More breaks the promise.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <luxel/lpv_inject.h>
#include <luxel/voxel_inject.h>

#include "bench/report/instruments.h"
#include "bench/scene/images.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/gaussian_blur_support.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/lpv_support.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/cases/run.h"
#include "tests/cases/voxelize_support.h"

namespace luxel::report {
namespace {

using cases::Run;
using cases::Values;
using Works = std::function<Result<bool>(double)>;

// A mesh of one triangle, its vertices rounded on the device.
Result<Run> voxelized_there(Context& device, VoxelizeParams p, const cases::Mesh& mesh) {
  p.device_vertices = p.device_materials = true;
  p.triangles = 1;
  p.vertices = 3;
  Result<Run> made = Run::make(device, plan(p, device.profile()));
  if (!made) return made.status();
  const std::pair<const char*, Values> inputs[] = {
      {"positions", mesh.positions}, {"indices", {0, 1, 2}}, {"triangle_materials", {0}}, {"materials", {1, 1, 1, 1, 0, 0, 0, 0}}};
  for (const auto& [name, values] : inputs)
    if (Status s = made.value().write(name, values); !s) return s;
  if (Status s = made.value().go(); !s) return s;
  return made;
}

struct Limit {
  const char* kernel;
  const char* family;
  const char* what;      // "largest value"
  const char* goes_wrong;
  double limit, search;  // bisected between them; search < limit: what must not be smaller
};

Instrument edge(const Limit& l, std::function<Works(Context& device, Context& exact)> make) {
  return {l.family, l.kernel, fmt::format("edge: {}", l.what), fmt::format("{} {:g} is promised; beyond, {}", l.what, l.limit, l.goes_wrong), 1,
          [l, make](Context& device, Context& exact, bool quick) -> Result<Found> {
            const Result<double> found = edge_between(l.limit, l.search, make(device, exact), quick ? 0.05 : 1e-3);
            if (!found) return found.status();
            const double e = found.value(), distance = l.search > l.limit ? e / l.limit : l.limit / e;
            if (std::isnan(e)) return Found{std::nan(""), "it goes wrong at the limit itself"};
            return Found{1 / distance, e == l.search ? fmt::format("nothing goes wrong up to {:g}, where parameters end", e)
                                                     : fmt::format("goes wrong at {:.4g}, distance {:.3g}", e, distance)};
          }};
}

double worst_relative(const Values& a, double expected) {
  double most = 0;
  for (const double v : a)
    if (const double e = std::fabs(v / expected - 1); !(e <= most)) most = e;
  return most;
}

// An image of one value stays one.
constexpr double constant_bound = 1e-5;

}  // namespace

void add_edges(std::vector<Instrument>& all) {
  all.push_back(edge({"gaussian_blur", "gaussian_blur", "largest sigma of the recursive filter", "f32 is off double by more than the filter's own error, 1e-3", 1e3, 1e4},
                     [](Context& device, Context& exact) -> Works {
                       return [&](double sigma) -> Result<bool> {
                         const GaussianBlurParams p = cases::blur_params(4096, 1, sigma, -1, Format::f32x1, Border::clamp, GaussianVariant::recursive);
                         Values src(4096, 0.0);
                         std::fill(src.begin() + 2048, src.end(), 1.0);
                         const auto a = cases::blur(device, p, src), b = cases::blur(exact, p, src);
                         if (!a) return a.status();
                         if (!b) return b.status();
                         return cases::max_difference(a.value(), b.value()) <= 1e-3;
                       };
                     }));
  for (const GaussianVariant variant : {GaussianVariant::separable, GaussianVariant::recursive, GaussianVariant::pyramid})
    all.push_back(edge({"gaussian_blur", "gaussian_blur",
                        variant == GaussianVariant::separable   ? "largest value, separable"
                        : variant == GaussianVariant::recursive ? "largest value, recursive"
                                                                : "largest value, pyramid",
                        "an image of one value is no longer that value", 1e30, 3.4e38},
                       [variant](Context& device, Context&) -> Works {
                         return [&device, variant](double value) -> Result<bool> {
                           const double v = static_cast<float>(value);
                           const auto r = cases::blur(device, cases::blur_params(64, 32, 4, 12, Format::f32x1, Border::clamp, variant), Values(64 * 32, v));
                           if (!r) return r.status();
                           return worst_relative(r.value(), v) <= constant_bound;
                         };
                       }));
  all.push_back(edge({"bilateral", "bilateral", "largest value", "squares of differences overflow and weigh nothing (from 1e36 on values count as no number)", 1e15, 1e36},
                     [](Context& device, Context&) -> Works {
                       return [&device](double value) -> Result<bool> {
                         BilateralParams p;
                         p.width = 32, p.height = 16, p.radius = 2, p.sigma_space = 1, p.sigma_range = 0.1;
                         cases::BilateralImages images;
                         // Pixels of one value and of half of it: whoever counts is drawn towards the others.
                         const double v = static_cast<float>(value);
                         p.sigma_range = 0.5 * v;
                         for (int i = 0; i < 32 * 16; ++i)
                           for (int c = 0; c < 4; ++c) images.src.push_back(c == 3 ? 1 : (i + i / 32) % 2 == 0 ? v : static_cast<float>(v / 2));
                         const auto r = cases::filter(device, p, images);
                         if (!r) return r.status();
                         for (std::size_t i = 0; i < r.value().dst.size(); ++i)
                           if (i % 4 != 3 && !(r.value().dst[i] > 0.5001 * v && r.value().dst[i] < 0.9999 * v)) return false;
                         return true;
                       };
                     }));
  all.push_back(edge({"mip_build", "mip_build", "largest value, isotropic", "the mean of eight equal values is no longer that value", 1e30, 3.4e38},
                     [](Context& device, Context&) -> Works {
                       return [&device](double value) -> Result<bool> {
                         const MipBuildParams p = cases::mip_params(MipVariant::isotropic, Format::f32x1, {16, 16, 16});
                         const double v = static_cast<float>(value);
                         const auto r = cases::build(device, p, Values(16 * 16 * 16, v));
                         if (!r) return r.status();
                         for (const auto& [name, values] : r.value())
                           if (!(worst_relative(values, v) <= constant_bound)) return false;
                         return true;
                       };
                     }));
  // A square in the middle of a layer of voxels, its distance from the origin in the vertices: the float that is nearest must
  // still lie in that layer.
  all.push_back(edge({"voxelize", "voxelize", "largest distance from the origin in voxels, vertices in floats", "a wall lies in another layer of voxels", 1e6, 1e9},
                     [](Context& device, Context&) -> Works {
                       return [&device](double distance) -> Result<bool> {
                         const double away = std::floor(distance / 16) * 16, at = away + 8.5;
                         VoxelGrid grid = cases::unit_grid(16);
                         grid.origin = {away, 0, 0};
                         cases::Mesh mesh;
                         mesh.add({at, 2, 2, at, 14, 2, at, 14, 14});
                         const Result<VoxelTriangles> triangles = voxel_triangles(mesh.view(), grid);
                         if (!triangles) return triangles.status();
                         VoxelizeParams p = voxelize_params(grid, triangles.value());
                         p.origin = grid.origin, p.voxel = grid.voxel;
                         Result<Run> made = voxelized_there(device, p, mesh);
                         if (!made) return made.status();
                         const auto colour = made.value().read("colour");
                         if (!colour) return colour.status();
                         std::size_t inside = 0, others = 0;
                         for (std::size_t i = 0; i < colour.value().size() / 4; ++i)
                           if (colour.value()[4 * i + 3] > 0) (i % 16 == 8 ? inside : others) += 1;
                         return inside > 0 && others == 0;
                       };
                     }));
  all.push_back(edge({"voxelize", "voxelize", "largest coordinate in the grid in voxels, vertices in floats", "triangles are left out, and counted", 6144, 65536},
                     [](Context& device, Context&) -> Works {
                       return [&device](double coordinate) -> Result<bool> {
                         const VoxelGrid grid = cases::unit_grid(16);
                         cases::Mesh mesh;
                         mesh.add({2.5, 2.5, 2.5, coordinate, 4.5, 2.5, 2.5, 9.5, 2.5});
                         const Result<VoxelTriangles> triangles = voxel_triangles(mesh.view(), grid);
                         if (!triangles) return triangles.status();
                         VoxelizeParams p = voxelize_params(grid, triangles.value());
                         Result<Run> made = voxelized_there(device, p, mesh);
                         if (!made) return made.status();
                         const auto counters = made.value().read("counters");
                         if (!counters) return counters.status();
                         return counters.value()[static_cast<std::size_t>(VoxelizeCount::occupied)] > 0 &&
                                counters.value()[static_cast<std::size_t>(VoxelizeCount::far)] == 0;
                       };
                     }));
  // One voxel that a map's points all lie in. The map is as wide as the points need.
  all.push_back(edge({"voxel_inject", "voxelize", "most points of a map in one voxel", "sums wrap, and are counted as saturated", 0x1p18 - 1, 0x1p21},
                     [](Context& device, Context&) -> Works {
                       return [&device](double points) -> Result<bool> {
                         VoxelInjectParams p;
                         p.width = p.height = p.depth = 8;
                         p.bricks = 1, p.count = true;
                         p.map_width = 1024, p.map_height = static_cast<int>(std::ceil(points / 1024));
                         const auto n = static_cast<std::size_t>(points);
                         Values colour(8 * 8 * 8 * 4, 0.0), map(static_cast<std::size_t>(p.map_width) * static_cast<std::size_t>(p.map_height) * 8, 0.0), counters(16, 0.0);
                         for (std::size_t c = 0; c < 4; ++c) colour[c] = 1;
                         for (std::size_t i = 0; i < n; ++i) {
                           for (std::size_t c = 0; c < 3; ++c) map[8 * i + c] = 0.5, map[8 * i + 4 + c] = 1;
                           map[8 * i + 3] = 1;
                         }
                         counters[2] = 1;
                         Result<Run> made = Run::make(device, plan(p, device.profile()));
                         if (!made) return made.status();
                         if (Status s = made.value().write("colour", colour); !s) return s;
                         if (Status s = made.value().write("bricks", Values{0}); !s) return s;
                         if (Status s = made.value().write("voxel_counters", counters); !s) return s;
                         if (Status s = made.value().write("map", map); !s) return s;
                         if (Status s = made.value().go(); !s) return s;
                         const auto radiance = made.value().read("radiance"), outcomes = made.value().read("outcomes");
                         if (!radiance) return radiance.status();
                         if (!outcomes) return outcomes.status();
                         return std::fabs(radiance.value()[0] * std::numbers::pi - 1) <= 1e-3 &&
                                outcomes.value()[static_cast<std::size_t>(VoxelInjectCount::saturated)] == 0;
                       };
                     }));
  const auto injected = [](Context& device, double flux, Values& outcomes) -> Result<Values> {
    LpvInjectParams p;
    p.grid = cases::lpv::grid_of(4, 4, 4);
    cases::lpv::Light light;
    light.place = {1.5, 1.25, 1.5};
    light.flux = {flux, flux, flux};
    return cases::lpv::injected(device, p, cases::lpv::list_of(std::vector{light}), &outcomes);
  };
  all.push_back(edge({"lpv_inject", "light_propagation", "largest flux of a light in flux_max", "it counts as flux_max, and is counted as saturated", 1, 1e6},
                     [injected](Context& device, Context&) -> Works {
                       return [&device, injected](double flux) -> Result<bool> {
                         Values outcomes;
                         const auto r = injected(device, flux, outcomes);
                         if (!r) return r.status();
                         return outcomes[static_cast<std::size_t>(LpvInjectCount::saturated)] == 0;
                       };
                     }));
  all.push_back(edge({"lpv_inject", "light_propagation", "smallest flux of a light in flux_max", "nothing of it arrives", 0x1p-48, 0x1p-99},
                     [injected](Context& device, Context&) -> Works {
                       return [&device, injected](double flux) -> Result<bool> {
                         Values outcomes;
                         const auto r = injected(device, flux, outcomes);
                         if (!r) return r.status();
                         return std::any_of(r.value().begin(), r.value().end(), [](double v) { return v != 0; });
                       };
                     }));
  const auto propagates = [](Context& device, double flux) -> Result<bool> {
    LpvPropagateParams p = cases::lpv_params({8, 6, 6});
    p.iterations = 3;
    Values one = truth::lpv_to_pixels(p.grid, 2, cases::lpv_lights(p.grid, 2, 10, 3)), light = one;
    double most = 0;
    for (double& v : one) most = std::max(most, std::fabs(v));
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = static_cast<float>(one[i] / most * flux), one[i] = light[i] / flux;
    const auto a = cases::propagate(device, p, light);
    if (!a) return a.status();
    const Values expected = truth::lpv_propagated(p, one, {});
    double largest = 0, off = 0;
    for (const double v : expected) largest = std::max(largest, std::fabs(v));
    for (std::size_t i = 0; i < expected.size(); ++i)
      if (const double e = std::fabs(a.value()[i] / flux - expected[i]) / largest; !(e <= off)) off = e;
    return off <= 1e-5;
  };
  all.push_back(edge({"light_propagation", "light_propagation", "largest light", "a step is off by more than 1e-5", 1e37, 3.4e38},
                     [propagates](Context& device, Context&) -> Works { return [&device, propagates](double f) { return propagates(device, f); }; }));
  all.push_back(edge({"light_propagation", "light_propagation", "smallest light", "a step is off by more than 1e-5", 1e-30, 1e-45},
                     [propagates](Context& device, Context&) -> Works { return [&device, propagates](double f) { return propagates(device, f); }; }));
  // A closed room of one radiance, of any scale.
  const auto room = [](Context& device, double voxel, double radiance) -> Result<bool> {
    ConeTraceParams p = cases::cone_params(8);
    p.voxel = voxel;
    p.width = 1;
    p.radiance_max = std::max(1.0, radiance);
    Values receivers;
    cases::add_receiver(receivers, {static_cast<float>(4 * voxel), static_cast<float>(4 * voxel), static_cast<float>(4 * voxel)}, {0, 1, 0});
    const double r = static_cast<float>(radiance);
    const auto traced = cases::trace(device, p, cases::uniform_volume(8, {r, r, r, 1}), receivers);
    if (!traced) return traced.status();
    Values colours = traced.value().irradiance;
    colours.resize(3);
    return worst_relative(colours, std::numbers::pi * r) <= 1e-4;
  };
  all.push_back(edge({"cone_trace", "cone_trace", "smallest voxel in scene units", "a closed room of one radiance is no longer that bright", 1e-20, 1e-30},
                     [room](Context& device, Context&) -> Works { return [&device, room](double v) { return room(device, v, 1); }; }));
  all.push_back(edge({"cone_trace", "cone_trace", "largest voxel in scene units", "a closed room of one radiance is no longer that bright", 1e20, 1e30},
                     [room](Context& device, Context&) -> Works { return [&device, room](double v) { return room(device, v, 1); }; }));
  all.push_back(edge({"cone_trace", "cone_trace", "largest radiance", "a closed room of one radiance is no longer that bright", 1e20, 1e30},
                     [room](Context& device, Context&) -> Works { return [&device, room](double r) { return room(device, 1, r); }; }));
  // A wall across the view.
  all.push_back(edge({"hiz_ssr", "hiz_ssr", "largest depth of a surface", "it counts as sky (documented)", 9.9e9, 1e12},
                     [](Context& device, Context&) -> Works {
                       return [&device](double depth) -> Result<bool> {
                         HizSsrParams p = cases::ssr_params(32, 32);
                         p.rays = 1;
                         const Values stored = cases::stored_depths(p, Values(32 * 32, depth));
                         Values rays;
                         cases::add_ray(rays, {0, 0, -static_cast<float>(depth / 2)}, {0.1, 0.05, -1});
                         const auto r = cases::follow(device, p, stored, rays);
                         if (!r) return r.status();
                         return r.value().outcome(0) == SsrOutcome::hit;
                       };
                     }));
  // Probes in the corners of a room; rays from its middle end on its walls at any scale.
  const auto probed = [](Context& device, double scale) -> Result<bool> {
    ProbeGrid g;
    g.count = {2, 2, 2};
    for (std::size_t k = 0; k < 3; ++k) g.origin[k] = static_cast<float>(-0.5 * scale), g.spacing[k] = static_cast<float>(scale);
    ProbeMaps m;
    m.size = 32;
    const auto values = cases::texel_values(32, 8, [&](int probe, const std::array<double, 3>& d, std::array<double, 3>& n) {
      const std::array<double, 3> c{(probe & 1) - 0.5, (probe >> 1 & 1) - 0.5, (probe >> 2) - 0.5};
      double t = HUGE_VAL;
      for (std::size_t k = 0; k < 3; ++k)
        if (const double to = ((d[k] > 0 ? 1 : -1) - c[k]) / d[k]; d[k] != 0 && to < t) {
          t = to;
          n = {0, 0, 0};
          n[k] = d[k] > 0 ? -1 : 1;
        }
      return t * scale;
    });
    auto scene = cases::ProbeScene::make(device, m, g, values);
    if (!scene) return scene.status();
    std::vector<cases::Ray> rays;
    for (int i = 0; i < 60; ++i) {
      cases::Ray r;
      for (std::uint32_t k = 0; k < 3; ++k)
        r.direction[k] = static_cast<float>(scene::hash(3 * static_cast<std::uint32_t>(i) + k) * 0x1p-31 - 1);
      rays.push_back(r);
    }
    const auto traced = scene.value().trace({}, cases::ray_values(rays));
    if (!traced) return traced.status();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& d = rays[i].direction;
      const double length = std::hypot(d[0], d[1], d[2]);
      const double t = scale * length / std::max({std::fabs(d[0]), std::fabs(d[1]), std::fabs(d[2])});
      if (traced.value().outcome(i) != ProbeOutcome::hit || !(std::fabs(traced.value().t(i) / t - 1) <= 0.15)) return false;
    }
    return true;
  };
  all.push_back(edge({"octahedral_march", "octahedral_march", "smallest scale of the scene", "rays in a room miss its walls", 1e-3, 1e-15},
                     [probed](Context& device, Context&) -> Works { return [&device, probed](double s) { return probed(device, s); }; }));
  all.push_back(edge({"octahedral_march", "octahedral_march", "largest scale of the scene", "rays in a room miss its walls", 1e4, 5e14},
                     [probed](Context& device, Context&) -> Works { return [&device, probed](double s) { return probed(device, s); }; }));
}

}  // namespace luxel::report

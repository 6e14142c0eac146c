// Maps and grids that are not ordinary.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <luxel/octahedral_map.h>

#include "bench/scene/images.h"
#include "tests/cases/octahedral_march_cases.h"
#include "tests/cases/octahedral_march_support.h"

namespace luxel::cases {
namespace {

using Vec = std::array<double, 3>;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int size = 32;

double u(int i) { return scene::random01(static_cast<std::uint32_t>(i), 41); }

Vec anywhere(int i) {
  const double z = 2 * u(2 * i) - 1, a = 2 * M_PI * u(2 * i + 1), s = std::sqrt(1 - z * z);
  return {s * std::cos(a), s * std::sin(a), z};
}

ProbeMaps maps(ProbeDistance distance = ProbeDistance::f32) {
  ProbeMaps m;
  m.size = size;
  m.ratio = 8;
  m.distance = distance;
  m.normal = ProbeNormal::snorm16;
  return m;
}

std::vector<Ray> random_rays(int count, double spread, double reach = 1e30) {
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    Ray r{{}, anywhere(i + 60)};
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] = spread * (2 * u(3 * i + static_cast<int>(k) + 900) - 1);
    r.reach = reach;
    rays.push_back(r);
  }
  return rays;
}

// The sphere of radius `radius` about the origin from inside, seen from c.
double see_sphere(double radius, const Vec& c, const Vec& d, Vec& n) {
  double b = 0, cc = -radius * radius;
  for (std::size_t k = 0; k < 3; ++k) b += c[k] * d[k], cc += c[k] * c[k];
  const double t = -b + std::sqrt(b * b - cc);
  for (std::size_t k = 0; k < 3; ++k) n[k] = -(c[k] + t * d[k]) / radius;
  return t;
}

ProbeGrid cage(double side) {
  ProbeGrid g;
  g.count = {2, 2, 2};
  for (std::size_t k = 0; k < 3; ++k) g.origin[k] = -side / 2, g.spacing[k] = side;
  return g;
}

Vec corner(const ProbeGrid& g, int p) {
  const int at[3] = {p % g.count[0], p / g.count[0] % g.count[1], p / g.count[0] / g.count[1]};
  Vec c;
  for (std::size_t k = 0; k < 3; ++k) c[k] = g.origin[k] + at[k] * g.spacing[k];
  return c;
}

TexelValues sphere_values(const ProbeGrid& g, double radius) {
  return texel_values(size, static_cast<int>(probe_count(g)),
                      [&](int p, const Vec& d, Vec& n) { return see_sphere(radius, corner(g, p), d, n); });
}

// Rays inside a sphere: the largest error in footprints of a hit; infinite where there is none.
double sphere_error(const Traced& traced, const std::vector<Ray>& rays, double radius) {
  const Values stored = ray_values(rays);
  double most = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (traced.outcome(i) != ProbeOutcome::hit) return inf;
    Vec o, d, n;
    double l = 0;
    for (std::size_t k = 0; k < 3; ++k) o[k] = stored[8 * i + k], d[k] = stored[8 * i + 4 + k], l += d[k] * d[k];
    for (double& v : d) v /= std::sqrt(l);
    const double e = std::fabs(traced.t(i) - see_sphere(radius, o, d, n)) / (radius * 2 / size);
    if (!(e <= most)) most = e;
  }
  return most;
}

// All eight probes of a cage are shut in a shell: whichever is asked first, all are, and the last occluder counts as hit.
Case all_hidden(ProbeOrder order) {
  return {"", fmt::format("all eight hidden, {}", order == ProbeOrder::plus3 ? "plus3" : "farthest"),
          "every ray asks eight, and is counted as assumed (rays for which not)", 0,
          [=](Context& context) -> Result<double> {
            const ProbeGrid g = cage(2);
            auto scene = ProbeScene::make(context, maps(), g, texel_values(size, 8, [](int, const Vec&, Vec&) { return 0.125; }));
            if (!scene) return scene.status();
            ProbeTraceParams p;
            p.order = order;
            p.count = true;
            const auto rays = random_rays(400, 0.5, 0.4);
            const auto t = scene.value().trace(p, ray_values(rays));
            if (!t) return t.status();
            double wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i)
              wrong += t.value().outcome(i) != ProbeOutcome::assumed || t.value().hits[4 * i + 2] != 8 || t.value().t(i) != 0;
            if (t.value().counters[6] != 400 || t.value().counters[8] != 3200 || t.value().counters[1] != 0) return nan;
            return wrong;
          }};
}

// Knowledge ends a rounding this side or that of the plane between two cages: a ray must not go back into the one that it left.
Case between_cages() {
  return {"", "all hidden between two cages", "no ray asks more than two cages' probes (rays that do)", 0, [](Context& context) -> Result<double> {
            ProbeGrid g;
            g.count = {3, 3, 3};
            g.spacing = {0.7, 0.9, 1.1};
            g.origin = {-0.73, 3.19, -1.37};
            auto scene = ProbeScene::make(context, maps(), g, texel_values(size, 27, [](int, const Vec&, Vec&) { return 0.03125; }));
            if (!scene) return scene.status();
            std::vector<Ray> rays = random_rays(4000, 0.5);
            for (std::size_t i = 0; i < rays.size(); ++i) {
              Ray& r = rays[i];
              double length = 0;
              for (const double v : r.direction) length += v * v;
              r.begin = 0.25 + 4 * u(static_cast<int>(i) + 17);
              for (std::size_t k = 0; k < 3; ++k) {
                const double at = k == i % 3 ? 1 : 0.4 + 0.3 * u(static_cast<int>(3 * i + k) + 5);
                r.origin[k] = g.origin[k] + at * g.spacing[k] - r.begin * r.direction[k] / std::sqrt(length);
              }
            }
            const auto t = scene.value().trace({}, ray_values(rays));
            if (!t) return t.status();
            double more = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
              if (t.value().outcome(i) != ProbeOutcome::assumed && t.value().outcome(i) != ProbeOutcome::degenerate) return nan;
              more += t.value().hits[4 * i + 2] > 16;
            }
            return more;
          }};
}

// Who is asked k-th, known by whose texel ends knowledge after k tries: (i + 3) mod 8, or i xor 7, 6, 7, 5, 7, 6, 7.
Case order_of_probes(ProbeOrder order) {
  return {"", fmt::format("order of a cage's probes, {}", order == ProbeOrder::plus3 ? "plus3" : "farthest"),
          "from the probe nearest to the ray's line on, as documented (probes asked out of order)", 0,
          [=](Context& context) -> Result<double> {
            const ProbeGrid g = cage(2);
            auto scene = ProbeScene::make(context, maps(), g, texel_values(size, 8, [](int, const Vec&, Vec&) { return 0.125; }));
            if (!scene) return scene.status();
            const auto rays = random_rays(200, 0.5, 0.4);
            const Values stored = ray_values(rays);
            std::vector<int> expected(rays.size());
            for (std::size_t i = 0; i < rays.size(); ++i) {
              double nearest = inf;
              for (int p = 0; p < 8; ++p) {
                const Vec c = corner(g, p);
                double along = 0, squared = 0, l = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                  const double to = c[k] - stored[8 * i + k], d = stored[8 * i + 4 + k];
                  along += to * d, squared += to * to, l += d * d;
                }
                const double off = squared - along * along / l;
                if (off < nearest) nearest = off, expected[i] = p;
              }
            }
            constexpr int turns[] = {7, 6, 7, 5, 7, 6, 7};
            double wrong = 0;
            for (int k = 0; k < 8; ++k) {
              ProbeTraceParams p;
              p.order = order;
              p.tries = k + 1;
              const auto t = scene.value().trace(p, stored);
              if (!t) return t.status();
              for (std::size_t i = 0; i < rays.size(); ++i) {
                if (k > 0) expected[i] = order == ProbeOrder::plus3 ? (expected[i] + 3) % 8 : expected[i] ^ turns[k - 1];
                wrong += static_cast<int>(t.value().texels[i]) / (size * size) != expected[i];
              }
            }
            return wrong;
          }};
}

// Seven of eight are shut in; the one that is open, wherever it is, is found in either order.
Case one_open(ProbeOrder order) {
  return {"", fmt::format("seven of eight hidden, {}", order == ProbeOrder::plus3 ? "plus3" : "farthest"),
          "the one that sees is found from every corner (largest error, footprints)", 1, [=](Context& context) -> Result<double> {
            double most = 0;
            for (int open = 0; open < 8; ++open) {
              const ProbeGrid g = cage(1);
              TexelValues v = sphere_values(g, 4);
              for (std::size_t i = 0; i < v.distance.size(); ++i)
                if (static_cast<int>(i) / (size * size) != open) v.distance[i] = 0.01;
              auto scene = ProbeScene::make(context, maps(), g, v);
              if (!scene) return scene.status();
              ProbeTraceParams p;
              p.order = order;
              const auto rays = random_rays(60, 0.4);
              const auto t = scene.value().trace(p, ray_values(rays));
              if (!t) return t.status();
              const double e = sphere_error(t.value(), rays, 4);
              if (!(e <= most)) most = e;
            }
            return most;
          }};
}

Case in_geometry() {
  return {"", "probes inside geometry", "probes marked dead are never asked, and the rest answer (largest error, footprints)", 1,
          [](Context& context) -> Result<double> {
            ProbeGrid g = cage(1);
            g.placed = true;
            TexelValues v = sphere_values(g, 4);
            Values positions;
            for (int p = 0; p < 8; ++p) {
              const Vec c = corner(g, p);
              for (const double x : {c[0], c[1], c[2], p % 3 == 1 ? 1.0 : 0.0}) positions.push_back(x);
              if (p % 3 != 1) std::fill_n(v.distance.begin() + p * size * size, size * size, 0.0);
            }
            auto scene = ProbeScene::make(context, maps(), g, v, positions);
            if (!scene) return scene.status();
            const auto rays = random_rays(300, 0.6);
            const auto t = scene.value().trace({}, ray_values(rays));
            if (!t) return t.status();
            // Where nobody sees anything all that live are asked, and no others: probes 1, 4 and 7.
            std::fill(v.distance.begin(), v.distance.end(), 0.01);
            auto shut = ProbeScene::make(context, maps(), g, v, positions);
            if (!shut) return shut.status();
            const auto all = shut.value().trace({}, ray_values(random_rays(300, 0.3, 0.2)));
            if (!all) return all.status();
            for (std::size_t i = 2; i < all.value().hits.size(); i += 4)
              if (all.value().hits[i] != 3) return inf;
            return sphere_error(t.value(), rays, 4);
          }};
}

Case all_dead() {
  return {"", "no probe alive", "unknown where the ray begins, no probe asked (rays for which not)", 0,
          [](Context& context) -> Result<double> {
            ProbeGrid g = cage(1);
            g.placed = true;
            auto scene = ProbeScene::make(context, maps(), g, sphere_values(g, 4), Values(32, 0.0));
            if (!scene) return scene.status();
            const auto rays = random_rays(100, 0.6);
            const auto t = scene.value().trace({}, ray_values(rays));
            if (!t) return t.status();
            double wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i)
              wrong += t.value().outcome(i) != ProbeOutcome::unknown || t.value().hits[4 * i + 2] != 0 || t.value().t(i) != 0;
            return wrong;
          }};
}

// Distance 0 below, a sphere above: nothing is known below, and what is above is met.
Case on_surface() {
  return {"", "probe on a surface", "rays above it meet the dome (largest error, footprints)", 1,
          [](Context& context) -> Result<double> {
            ProbeGrid g;
            auto scene = ProbeScene::make(context, maps(), g, texel_values(size, 1, [](int, const Vec& d, Vec& n) {
                                            if (d[2] > 0) return see_sphere(4, {0, 0, 0}, d, n);
                                            n = {0, 0, 1};
                                            return 0.0;
                                          }));
            if (!scene) return scene.status();
            std::vector<Ray> rays = random_rays(300, 1);
            for (Ray& r : rays) {
              r.origin[2] = std::fabs(r.origin[2]) + 0.25;
              r.direction[2] = std::fabs(r.direction[2]) + 0.05;
            }
            const auto t = scene.value().trace({}, ray_values(rays));
            return t ? Result<double>(sphere_error(t.value(), rays, 4)) : t.status();
          }};
}

// Two probes in one place, and grids of one row: the duplicates are asked once or agree; answers are those of the sphere.
Case row(std::array<int, 3> count, bool coincide) {
  return {"", coincide ? "two probes in one place" : fmt::format("grid {}x{}x{}", count[0], count[1], count[2]),
          "rays inside and outside the grid meet the sphere (largest error, footprints)", 1, [=](Context& context) -> Result<double> {
            ProbeGrid g;
            g.count = count;
            g.spacing = {0.5, 0.5, 0.5};
            Values positions;
            TexelValues v = sphere_values(g, 6);
            if (coincide) {
              g.placed = true;
              v = texel_values(size, static_cast<int>(probe_count(g)),
                               [&](int, const Vec& d, Vec& n) { return see_sphere(6, {0, 0, 0}, d, n); });
              positions.assign(4 * probe_count(g), 0.0);
              for (std::size_t i = 3; i < positions.size(); i += 4) positions[i] = 1;
            }
            auto scene = ProbeScene::make(context, maps(), g, v, positions);
            if (!scene) return scene.status();
            const auto rays = random_rays(300, 2.5);
            const auto t = scene.value().trace({}, ray_values(rays));
            return t ? Result<double>(sphere_error(t.value(), rays, 6)) : t.status();
          }};
}

// f16 over the cage's diagonal.
Case f16_lengths(double radius) {
  return {"", fmt::format("f16 distances, {:g}", radius), "a sphere of that radius about a cage of 1/4 of it is met (largest error, footprints)", 1,
          [=](Context& context) -> Result<double> {
            const ProbeGrid g = cage(static_cast<float>(radius / 4));
            auto scene = ProbeScene::make(context, maps(ProbeDistance::f16), g, sphere_values(g, radius));
            if (!scene) return scene.status();
            const auto rays = random_rays(300, radius / 4);
            const auto t = scene.value().trace({}, ray_values(rays));
            return t ? Result<double>(sphere_error(t.value(), rays, radius)) : t.status();
          }};
}

// Squared f16 distances would be infinite from 256 on; distances are stored themselves, and the far limit is no surface.
Case far_limit(ProbeDistance format) {
  return {"", fmt::format("all texels at the far limit, {}", format == ProbeDistance::f16 ? "f16" : "f32"),
          "every ray misses (rays for which not)", 0, [=](Context& context) -> Result<double> {
            const ProbeGrid g = cage(1);
            auto scene = ProbeScene::make(context, maps(format), g, texel_values(size, 8, [](int, const Vec&, Vec&) { return 1e30; }));
            if (!scene) return scene.status();
            const auto rays = random_rays(300, 2);
            const auto t = scene.value().trace({}, ray_values(rays));
            if (!t) return t.status();
            double wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) wrong += t.value().outcome(i) != ProbeOutcome::miss;
            return wrong;
          }};
}

// A sheet without thickness at z = 0.3 with a hole's view around it: from either side, the side that the probe sees is hit, and a
// ray that leaves the sheet's far side is not held by it.
Case thin_sheet() {
  return {"", "thin two-sided sheet", "rays off the hidden side are not stopped by the side that is seen (rays that are)", 0,
          [](Context& context) -> Result<double> {
            const auto sheet = [](const Vec& c) {
              return [c](int, const Vec& d, Vec& n) {
                const double t = (0.3 - c[2]) / d[2];
                if (t > 0 && std::fabs(c[0] + t * d[0]) < 1 && std::fabs(c[1] + t * d[1]) < 1) {
                  n = {0, 0, c[2] < 0.3 ? -1.0 : 1.0};
                  return t;
                }
                return see_sphere(6, c, d, n);
              };
            };
            ProbeGrid g;
            g.count = {1, 1, 2};
            g.spacing = {1, 1, 1};
            TexelValues v = texel_values(size, 2, [&](int p, const Vec& d, Vec& n) { return sheet({0, 0, static_cast<double>(p)})(p, d, n); });
            auto scene = ProbeScene::make(context, maps(), g, v);
            if (!scene) return scene.status();
            std::vector<Ray> rays = random_rays(300, 0.5);
            for (std::size_t i = 0; i < rays.size(); ++i) {
              const double side = i % 2 == 0 ? 1 : -1;
              rays[i].origin[2] = 0.3 + side * 1e-5;
              rays[i].direction[2] = side * (std::fabs(rays[i].direction[2]) + 0.1);
            }
            const auto t = scene.value().trace({}, ray_values(rays));
            if (!t) return t.status();
            double held = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) held += t.value().t(i) < 1;
            return held;
          }};
}

Case no_number(double bad) {
  return {"", fmt::format("distances of {}", bad), "with and without the minimum map no ray passes such a texel (rays for which not)", 0,
          [=](Context& context) -> Result<double> {
            ProbeGrid g;
            TexelValues v = texel_values(size, 1, [](int, const Vec& d, Vec& n) { return see_sphere(4, {0, 0, 0}, d, n); });
            for (std::size_t i = 0; i < v.distance.size(); i += 7) v.distance[i] = bad;
            auto scene = ProbeScene::make(context, maps(), g, v);
            if (!scene) return scene.status();
            const auto rays = random_rays(300, 1);
            ProbeTraceParams p;
            p.probe = 0;
            const auto two = scene.value().trace(p, ray_values(rays));
            p.maps.ratio = 1;
            const auto flat = scene.value().trace(p, ray_values(rays));
            if (!two) return two.status();
            if (!flat) return flat.status();
            double wrong = 0, unknown = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
              wrong += two.value().hits[4 * i + 1] != flat.value().hits[4 * i + 1] || two.value().texels[i] != flat.value().texels[i];
              unknown += two.value().outcome(i) == ProbeOutcome::unknown;
            }
            return unknown > 100 ? wrong : nan;
          }};
}

// What cannot be radiance is none; R11G11B10 has no sign and fewer bits of blue, so that grey comes back tinted.
Case radiance(ProbeRadiance format) {
  const char* names[] = {"f32x4", "f16x4", "r11g11b10"};
  return {"", fmt::format("radiance NaN, infinite, below 0, {}", names[static_cast<int>(format)]), "stored as 0; others stay (values for which not)", 0,
          [=](Context& context) -> Result<double> {
            ProbeBuildParams p;
            p.maps = maps();
            p.maps.radiance = format;
            p.maps.normal = ProbeNormal::none;
            p.distance = false;
            auto run = HeldPlan::make(context, plan(p, context.profile()));
            if (!run) return run.status();
            Values in;
            for (int i = 0; i < size * size; ++i)
              for (const double v : {i % 5 == 0 ? nan : 1.0, i % 5 == 1 ? inf : 2.0, i % 5 == 2 ? -1.0 : 0.5, nan}) in.push_back(v);
            if (Status s = run.value().write("radiance_source", in); !s) return s;
            if (Status s = run.value().go(); !s) return s;
            const auto out = run.value().read("radiance");
            if (!out) return out.status();
            double wrong = 0;
            for (int i = 0; i < size * size; ++i) {
              const double expected[4] = {i % 5 == 0 ? 0.0 : 1.0, i % 5 == 1 ? 0.0 : 2.0, i % 5 == 2 ? 0.0 : 0.5, 0};
              if (format == ProbeRadiance::r11g11b10) {
                // 1, 2 and 1/2 are powers of two: exponents 15, 16, 14 and no fraction.
                const double code = (expected[0] > 0 ? 15 * 64.0 : 0) + (expected[1] > 0 ? 16 * 64.0 * 2048 : 0) + (expected[2] > 0 ? 14 * 32.0 * 4194304 : 0);
                wrong += out.value()[static_cast<std::size_t>(i)] != code;
              } else {
                for (std::size_t k = 0; k < 4; ++k) wrong += out.value()[4 * static_cast<std::size_t>(i) + k] != expected[k];
              }
            }
            return wrong;
          },
          false, {}};
}

Case tint() {
  return {"", "R11G11B10, grey", "grey comes back tinted by half a step of blue at most (largest of max / min - 1)", 0x1.1p-6,
          [](Context& context) -> Result<double> {
            OctahedralMapParams p;
            p.code = OctahedralCode::r11g11b10;
            p.count = 4096;
            Values grey;
            for (int i = 0; i < p.count; ++i) {
              const double v = static_cast<float>(std::exp2(20 * u(i) - 10));
              for (const double c : {v, v, v, 0.0}) grey.push_back(c);
            }
            auto to = HeldPlan::make(context, plan(p, context.profile()));
            if (!to) return to.status();
            if (Status s = to.value().write("values", grey); !s) return s;
            if (Status s = to.value().go(); !s) return s;
            p.decode = true;
            auto from = HeldPlan::make(context, plan(p, context.profile()), {{"codes", to.value().memory("codes")}});
            if (!from) return from.status();
            if (Status s = from.value().go(); !s) return s;
            const auto back = from.value().read("values");
            if (!back) return back.status();
            double most = 0;
            for (int i = 0; i < p.count; ++i) {
              const double* c = &back.value()[4 * static_cast<std::size_t>(i)];
              const double e = std::max({c[0], c[1], c[2]}) / std::min({c[0], c[1], c[2]}) - 1;
              if (!(e <= most)) most = e;
            }
            return most;
          }};
}

}  // namespace

void add_probe_value_cases(std::vector<Case>& cases) {
  for (const ProbeOrder order : {ProbeOrder::plus3, ProbeOrder::farthest}) cases.push_back(all_hidden(order));
  for (const ProbeOrder order : {ProbeOrder::plus3, ProbeOrder::farthest}) cases.push_back(one_open(order));
  for (const ProbeOrder order : {ProbeOrder::plus3, ProbeOrder::farthest}) cases.push_back(order_of_probes(order));
  cases.push_back(between_cages());
  cases.push_back(in_geometry());
  cases.push_back(all_dead());
  cases.push_back(on_surface());
  cases.push_back(row({2, 2, 2}, true));
  for (const std::array<int, 3> count : {std::array{1, 5, 1}, {7, 1, 1}, {1, 1, 1}}) cases.push_back(row(count, false));
  for (const double radius : {1e-3, 1.0, 1e5}) cases.push_back(f16_lengths(radius));
  for (const ProbeDistance format : {ProbeDistance::f32, ProbeDistance::f16}) cases.push_back(far_limit(format));
  cases.push_back(thin_sheet());
  for (const double bad : {nan, -1.0, 0.0}) cases.push_back(no_number(bad));
  for (const ProbeRadiance format : {ProbeRadiance::f32x4, ProbeRadiance::f16x4, ProbeRadiance::r11g11b10}) cases.push_back(radiance(format));
  cases.push_back(tint());
}

std::vector<Case> octahedral_march_cases() {
  std::vector<Case> cases;
  add_probe_ray_cases(cases);
  add_probe_value_cases(cases);
  for (Case& c : cases) c.kernel = "octahedral_march";
  return cases;
}

}  // namespace luxel::cases

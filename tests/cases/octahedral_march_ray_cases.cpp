// Rays that are stiff for an octahedral map: through the probe, inside axis planes, along seams, without length, without end.
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/octahedral_march_cases.h"
#include "tests/cases/octahedral_march_support.h"

namespace luxel::cases {
namespace {

using Vec = std::array<double, 3>;
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int size = 64;

// Of a texel that sees a surface at `to` from the probe.
double footprint(const Vec& to) {
  const double l = std::sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
  return l * 2 / (size * std::pow(l / (std::fabs(to[0]) + std::fabs(to[1]) + std::fabs(to[2])), 1.5));
}

// The walls of a cube of -side..side, seen from c.
double see_cube(double side, const Vec& c, const Vec& d, Vec& n) {
  double t = 1e30;
  for (std::size_t k = 0; k < 3; ++k)
    if (d[k] != 0) {
      const double to = d[k] > 0 ? side : -side, at = (to - c[k]) / d[k];
      if (at < t) t = at, n = {0, 0, 0}, n[k] = d[k] > 0 ? -1 : 1;
    }
  return t;
}

ProbeMaps exact_maps() {
  ProbeMaps m;
  m.size = size;
  m.distance = ProbeDistance::f32;
  m.normal = ProbeNormal::snorm16;
  return m;
}

ProbeGrid one_probe(const Vec& at) {
  ProbeGrid g;
  g.origin = at;
  return g;
}

// A cube around a probe at c; the rays are about the probe.
Result<Traced> in_cube(Context& context, double side, const Vec& c, std::vector<Ray> rays, ProbeTraceParams p = {},
                       const ProbeMaps& maps = exact_maps()) {
  auto scene = ProbeScene::make(context, maps, one_probe(c),
                                texel_values(maps.size, 1, [&](int, const Vec& d, Vec& n) { return see_cube(side, c, d, n); }));
  if (!scene) return scene.status();
  for (Ray& r : rays)
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] += c[k];
  p.probe = 0;
  return scene.value().trace(p, ray_values(rays));
}

// The largest error of a hit with a cube's wall, in footprints; infinite where a ray is not hit. At the cube's edges a texel
// sees one of two walls, whose plane goes on over half the texel's diagonal.
Case walls(std::string name, std::vector<Ray> rays, double bound = 1.5) {
  return {"", std::move(name), "each ray meets its wall (largest error, texel footprints)", bound,
          [=](Context& context) -> Result<double> {
            const Vec c{0.125, -0.25, 0.0625};
            const auto traced = in_cube(context, 1, c, rays);
            if (!traced) return traced.status();
            double most = 0;
            const Values stored = ray_values(rays);
            for (std::size_t i = 0; i < rays.size(); ++i) {
              if (traced.value().outcome(i) != ProbeOutcome::hit) return inf;
              Vec from, d, n;
              double l = 0;
              for (std::size_t k = 0; k < 3; ++k) from[k] = stored[8 * i + k] + c[k], d[k] = stored[8 * i + 4 + k], l += d[k] * d[k];
              for (double& v : d) v /= std::sqrt(l);
              const double t = see_cube(1, from, d, n);
              Vec to;
              for (std::size_t k = 0; k < 3; ++k) to[k] = from[k] + t * d[k] - c[k];
              const double e = std::fabs(traced.value().t(i) - t) / footprint(to);
              if (!(e <= most)) most = e;
            }
            return most;
          }};
}

double u(int i) { return scene::random01(static_cast<std::uint32_t>(i), 77); }

Vec anywhere(int i) {
  const double z = 2 * u(2 * i) - 1, a = 2 * M_PI * u(2 * i + 1), s = std::sqrt(1 - z * z);
  return {s * std::cos(a), s * std::sin(a), z};
}

std::vector<Ray> through_centre() {
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) {
    const Vec d = anywhere(i);
    Ray r{{}, d};
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] = -0.5 * d[k];
    rays.push_back(r);
  }
  for (const Vec& d : {Vec{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 0}, {1, 0, -1}, {1, 1, 1}, {-1, 1, -1}})
    rays.push_back({{-0.5 * d[0], -0.5 * d[1], -0.5 * d[2]}, d});
  return rays;
}

// Past the centre by a hair: the path crosses the whole map within a hair of length.
std::vector<Ray> past_centre() {
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) {
    const Vec d = anywhere(i), off = anywhere(i + 1000);
    Ray r{{}, d};
    const double h = std::exp2(-4 - 26 * u(i + 5000));
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] = -0.5 * d[k] + h * off[k];
    rays.push_back(r);
  }
  return rays;
}

std::vector<Ray> in_planes() {
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i) {
    Ray r{anywhere(i), anywhere(i + 2000)};
    for (double& v : r.origin) v *= 0.5;
    const auto k = static_cast<std::size_t>(i % 3);
    r.origin[k] = i % 2 == 0 ? 0 : -0.0;
    r.direction[k] = i % 4 < 2 ? 0 : -0.0;
    rays.push_back(r);
  }
  return rays;
}

// The octahedron's edges are the axis planes; along an axis, off it, a ray runs along two of them at once.
std::vector<Ray> along_edges() {
  std::vector<Ray> rays;
  for (std::size_t k = 0; k < 3; ++k)
    for (const double side : {1.0, -1.0})
      for (const double off : {0.0, 1e-30, 1e-9, 0.25}) {
        Ray r{{0, 0, 0}, {0, 0, 0}};
        r.direction[k] = side;
        r.origin[k] = -0.25 * side;
        r.origin[(k + 1) % 3] = off;
        rays.push_back(r);
        r.origin[(k + 1) % 3] = -off;
        r.origin[(k + 2) % 3] = off;
        rays.push_back(r);
      }
  // Along the diagonal seam z = 0, and from border to border below it.
  for (const double z : {0.0, 1e-7, -1e-7}) rays.push_back({{-0.4, 0.3, z}, {1, -0.1, 0}});
  for (const double y : {0.0, 1e-7, -1e-7}) rays.push_back({{0.3, y, -0.5}, {-1, 0, 0.01}});
  for (const double x : {0.0, 1e-7, -1e-7}) rays.push_back({{x, 0.3, -0.5}, {0, -1, -0.01}});
  return rays;
}

std::vector<Ray> from_planes() {
  std::vector<Ray> rays;
  for (int i = 0; i < 300; ++i) {
    Ray r{anywhere(i + 300), anywhere(i + 4000)};
    for (double& v : r.origin) v *= 0.5;
    r.origin[static_cast<std::size_t>(i % 3)] = 0;
    if (i % 2 == 0) r.origin[static_cast<std::size_t>((i + 1) % 3)] = -0.0;
    rays.push_back(r);
  }
  return rays;
}

std::vector<Ray> from_probe() {
  std::vector<Ray> rays;
  for (int i = 0; i < 200; ++i) rays.push_back({{0, 0, 0}, anywhere(i + 700)});
  for (const Vec& d : {Vec{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) rays.push_back({{0, 0, 0}, d});
  for (int i = 0; i < 50; ++i) rays.push_back({{1e-30, -1e-25, 1e-38}, anywhere(i + 900)});
  return rays;
}

// An outcome that all rays must have: how many have not.
Case ends(std::string name, std::string promise, std::vector<Ray> rays, ProbeOutcome outcome, ProbeTraceParams p = {}) {
  return {"", std::move(name), promise + " (rays for which not)", 0, [=](Context& context) -> Result<double> {
            const auto traced = in_cube(context, 1, {0, 0, 0}, rays, p);
            if (!traced) return traced.status();
            double wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i)
              wrong += traced.value().outcome(i) != outcome || !std::isfinite(traced.value().t(i));
            return wrong;
          }};
}

Case endless() {
  return {"", "rays without end", "miss where no texel sees a surface, over any path (rays for which not)", 0,
          [](Context& context) -> Result<double> {
            auto scene = ProbeScene::make(context, exact_maps(), one_probe({0, 0, 0}),
                                          texel_values(size, 1, [](int, const Vec&, Vec&) { return 1e30; }));
            if (!scene) return scene.status();
            std::vector<Ray> rays = in_planes();
            for (const auto& more : {through_centre(), past_centre(), along_edges(), from_probe()})
              rays.insert(rays.end(), more.begin(), more.end());
            for (std::size_t i = 0; i < rays.size(); i += 3) rays[i].reach = inf;
            for (std::size_t i = 1; i < rays.size(); i += 3) rays[i].reach = 1e12;
            ProbeTraceParams p;
            p.probe = 0;
            const auto traced = scene.value().trace(p, ray_values(rays));
            if (!traced) return traced.status();
            double wrong = 0;
            for (std::size_t i = 0; i < rays.size(); ++i)
              wrong += traced.value().outcome(i) != ProbeOutcome::miss || traced.value().texels[i] != 0xffffffffu;
            return wrong;
          }};
}

// Far outside the room that the probe sees, all is behind the walls.
std::vector<Ray> hidden_rays() {
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i) {
    Ray r{anywhere(i), anywhere(i + 50)};
    for (double& v : r.origin) v *= 4;
    rays.push_back(r);
  }
  return rays;
}

std::vector<Ray> without_length() {
  std::vector<Ray> rays;
  for (int i = 0; i < 100; ++i) {
    Ray r{anywhere(i), anywhere(i + 50), i % 2 == 0 ? 0 : 1e-38};
    for (double& v : r.origin) v *= 0.6 * u(i);
    rays.push_back(r);
  }
  return rays;
}

std::vector<Ray> degenerate_rays() {
  std::vector<Ray> rays;
  for (const double bad : {nan, inf, -inf}) {
    for (std::size_t k = 0; k < 3; ++k) {
      Ray r;
      r.origin[k] = bad;
      rays.push_back(r);
      r = {};
      r.direction[k] = bad;
      rays.push_back(r);
    }
  }
  Ray r;
  r.direction = {0, 0, 0};
  rays.push_back(r);
  r = {};
  r.reach = nan;
  rays.push_back(r);
  r.reach = -1;
  rays.push_back(r);
  r.reach = 1;
  r.begin = 2;
  rays.push_back(r);
  r.begin = nan;
  rays.push_back(r);
  return rays;
}

// Boxes in a room, seen from eight probes: what scales with the scene must not change.
Result<Traced> scaled_room(Context& context, double scale) {
  ProbeGrid g;
  g.count = {2, 2, 2};
  for (std::size_t k = 0; k < 3; ++k) g.origin[k] = static_cast<float>(-0.5 * scale), g.spacing[k] = static_cast<float>(scale);
  ProbeMaps m;
  m.size = size;
  const auto values = texel_values(size, 8, [&](int p, const Vec& d, Vec& n) {
    const Vec c{(p & 1) - 0.5, (p >> 1 & 1) - 0.5, (p >> 2) - 0.5};
    double t = see_cube(1, c, d, n);
    const Vec middle{0.1, 0.05, -0.1};
    Vec o;
    double b = 0, cc = -0.09;
    for (std::size_t k = 0; k < 3; ++k) o[k] = c[k] - middle[k], b += o[k] * d[k], cc += o[k] * o[k];
    if (b * b > cc && -b - std::sqrt(b * b - cc) > 0 && -b - std::sqrt(b * b - cc) < t) {
      t = -b - std::sqrt(b * b - cc);
      for (std::size_t k = 0; k < 3; ++k) n[k] = (o[k] + t * d[k]) / 0.3;
    }
    return t * scale;
  });
  auto scene = ProbeScene::make(context, m, g, values);
  if (!scene) return scene.status();
  std::vector<Ray> rays;
  for (int i = 0; i < 2000; ++i) {
    Ray r{{}, anywhere(i + 100)};
    for (std::size_t k = 0; k < 3; ++k) r.origin[k] = (1.8 * u(3 * i + static_cast<int>(k)) - 0.9) * scale;
    if (i % 3 == 0) r.reach = 2 * u(i) * scale;
    rays.push_back(r);
  }
  return scene.value().trace({}, ray_values(rays));
}

// Powers of two scale exactly, so every bit stays but in hits[4 i]; others leave rounding, which decides a ray in a thousand.
Case scaled(double scale, bool exact) {
  return {"", fmt::format("scene scaled, {:g}", scale),
          exact ? "the same outcomes, texels and looks to the bit, lengths scaled (values that differ)"
                : "outcome and texel stay, ties by rounding apart (part of the rays that change)",
          exact ? 0 : 0.004, [=](Context& context) -> Result<double> {
            const auto a = scaled_room(context, 1), b = scaled_room(context, scale);
            if (!a) return a.status();
            if (!b) return b.status();
            double different = 0;
            for (std::size_t i = 0; i < a.value().texels.size(); ++i) {
              const double* x = &a.value().hits[4 * i];
              const double* y = &b.value().hits[4 * i];
              const bool length = exact ? x[0] == 1e30f || x[0] * scale == y[0] : x[0] > 1e29 || std::fabs(x[0] * scale - y[0]) <= 1e-3 * y[0];
              different += x[1] != y[1] || a.value().texels[i] != b.value().texels[i] || (exact && (x[2] != y[2] || x[3] != y[3])) || !length;
            }
            return exact ? different : different / static_cast<double>(a.value().texels.size());
          }};
}

Case step_cap() {
  return {"", "step cap", "a ray that reaches it is capped, counted, and never a hit (of the rays: part that is wrong)", 0,
          [](Context& context) -> Result<double> {
            std::vector<Ray> rays;
            for (int i = 0; i < 400; ++i) {
              Ray r{anywhere(i), anywhere(i + 333)};
              for (double& v : r.origin) v *= 0.5;
              rays.push_back(r);
            }
            const auto all = in_cube(context, 1, {0, 0, 0}, rays);
            ProbeTraceParams p;
            p.max_steps = 4;
            p.count = true;
            const auto few = in_cube(context, 1, {0, 0, 0}, rays, p);
            if (!all) return all.status();
            if (!few) return few.status();
            double wrong = 0, capped = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
              const bool is_capped = few.value().outcome(i) == ProbeOutcome::capped;
              capped += is_capped;
              wrong += is_capped != (all.value().hits[4 * i + 3] > 4);
            }
            if (few.value().counters[4] != capped || few.value().counters[7] != 400 || capped == 0) return nan;
            return wrong / 400;
          }};
}

}  // namespace

void add_probe_ray_cases(std::vector<Case>& cases) {
  cases.push_back(walls("rays through the probe", through_centre()));
  cases.push_back(walls("rays a hair past the probe", past_centre()));
  cases.push_back(walls("rays inside an axis plane", in_planes()));
  cases.push_back(walls("rays along edges and seams of the octahedron", along_edges()));
  cases.push_back(walls("rays that begin on axis planes", from_planes()));
  cases.push_back(walls("rays that begin at the probe", from_probe()));
  cases.push_back(ends("rays of no length", "in front of everything they miss", without_length(), ProbeOutcome::miss));
  cases.push_back(endless());
  cases.push_back(ends("rays that begin hidden", "unknown where they begin", hidden_rays(), ProbeOutcome::unknown));
  cases.push_back(ends("rays that are none", "degenerate, and finite answers", degenerate_rays(), ProbeOutcome::degenerate));
  cases.push_back(step_cap());
  for (const double scale : {0x1p-10, 0x1p13}) cases.push_back(scaled(scale, true));
  for (const double scale : {1e-3, 1e4}) cases.push_back(scaled(scale, false));
}

}  // namespace luxel::cases

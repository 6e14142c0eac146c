// The pixel that is hit, against the exhaustive walk: random scenes and every stiff one.
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/hiz_ssr_cases.h"
#include "tests/cases/hiz_ssr_support.h"

namespace luxel::cases {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// What rays are followed over: depths as stored, and a list of rays or normals.
struct Scene {
  std::string name, promise;
  HizSsrParams params;
  Values stored, source;
};

const char* name(SsrVariant v) { return v == SsrVariant::hiz ? "hiz" : v == SsrVariant::dda ? "dda" : "linear"; }

Scene random_scene(std::string name, HizSsrParams p, int rays, std::uint32_t seed) {
  p.rays = rays;
  return {std::move(name), "hits the pixel that the exhaustive walk hits, ties by rounding apart", p,
          stored_depths(p, height_field(p.width, p.height, seed)), screen_rays(p, rays, seed + 1)};
}

Scene listed(std::string name, HizSsrParams p, Values stored, Values rays) {
  p.rays = static_cast<int>(rays.size() / 8);
  return {std::move(name), "agrees with the exhaustive walk, and all answers are finite", p, std::move(stored), std::move(rays)};
}

Scene mirrored(std::string name, const HizSsrParams& p, Values stored, Values normals) {
  return {std::move(name), "agrees with the exhaustive walk, and all answers are finite", p, std::move(stored), std::move(normals)};
}

std::array<double, 3> place(const HizSsrParams& p, double x, double y, double d) {
  return {(x - p.centre_x) / p.focal_x * d, (p.centre_y - y) / p.focal_y * d, -d};
}

// From place a towards place b.
void add_between(Values& rays, std::array<double, 3> a, std::array<double, 3> b, double reach = 0) {
  add_ray(rays, a, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, reach);
}

Values normals(std::size_t pixels, std::array<double, 3> n, double roughness = 0) {
  Values v;
  for (std::size_t i = 0; i < pixels; ++i)
    for (const double c : {n[0], n[1], n[2], roughness}) v.push_back(static_cast<float>(c));
  return v;
}

void add_conventions(std::vector<Scene>& scenes) {
  HizSsrParams p = ssr_params(97, 61);
  p.near_plane = 0.1;
  scenes.push_back(random_scene("linear depth", p, 600, 1));
  p.thickness = 0.25;
  scenes.push_back(random_scene("linear depth, thickness 0.25", p, 600, 2));
  p.depth = SsrDepth::standard;
  scenes.push_back(random_scene("standard depth, infinite far plane", p, 600, 3));
  p.far_plane = 50;
  scenes.push_back(random_scene("standard depth", p, 600, 4));
  p.depth = SsrDepth::reversed;
  scenes.push_back(random_scene("reversed depth", p, 600, 5));
  p.far_plane = 0;
  scenes.push_back(random_scene("reversed depth, infinite far plane", p, 600, 6));
  p.focal_y *= 1.7;
  p.centre_x += 11.3;
  p.centre_y -= 20.6;
  scenes.push_back(random_scene("off-centre view, pixels not square", p, 600, 7));
}

void add_sizes(std::vector<Scene>& scenes) {
  for (const auto& [w, h] : {std::pair{1, 1}, {1, 64}, {97, 1}, {2, 3}, {33, 32}, {31, 65}, {127, 5}, {129, 17}}) {
    HizSsrParams p = ssr_params(w, h);
    p.thickness = 1;
    scenes.push_back(random_scene(fmt::format("{} x {} pixels", w, h), p, 200, static_cast<std::uint32_t>(w * 300 + h)));
  }
}

void add_directions(std::vector<Scene>& scenes) {
  const HizSsrParams p = ssr_params(64, 48);
  const Values hills = height_field(64, 48, 21);
  const auto random = [](int i, std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 8 + k, 22); };
  Values towards, parallel, axis, corners, border, edge;
  for (int i = 0; i < 200; ++i) {
    const double x = 64 * random(i, 0), y = 48 * random(i, 1), d = 0.5 + 8 * random(i, 2);
    add_between(towards, place(p, x, y, d), {0.2 * random(i, 3) - 0.1, 0.2 * random(i, 4) - 0.1, 0});
    add_ray(parallel, place(p, x, y, d), {random(i, 3) - 0.5, random(i, 4) - 0.5, 0});
    add_ray(axis, place(p, x, y, d), i % 2 == 0 ? std::array{0.0, 0.0, 1.0} : std::array{0.0, 0.0, -1.0});
    // Along the diagonal of the pixels: from a corner to a corner, at one depth or not.
    const double cx = std::floor(x), cy = std::floor(y), far = i % 2 == 0 ? d : d + 3 * random(i, 3);
    add_between(corners, place(p, cx, cy, d), place(p, cx + 16, cy + (i % 4 < 2 ? 16 : -16), far));
    // On the rim, or exactly on a corner of it, into the image and out of it.
    add_between(border, place(p, i % 2 == 0 ? 0 : 64, cy, d), place(p, x, y, far));
    add_between(border, place(p, cx, i % 2 == 0 ? 0 : 48, d), place(p, cx + (i % 3 - 1) * 10, 24, d));
    // Down a column of pixels, along a cliff that stands exactly there.
    add_between(edge, place(p, 32, cy, d), place(p, 32, cy < 24 ? 48 : 0, d));
    add_between(edge, place(p, 31.5, cy + 0.5, d), place(p, 32.5, 47, d));
  }
  scenes.push_back(listed("rays towards the camera", p, hills, towards));
  scenes.push_back(listed("rays parallel to the screen", p, hills, parallel));
  scenes.push_back(listed("rays along the view axis", p, hills, axis));
  scenes.push_back(listed("rays through pixel corners", p, hills, corners));
  scenes.push_back(listed("rays from the border", p, hills, border));
  Values cliff;
  for (int i = 0; i < 64 * 48; ++i) cliff.push_back(i % 64 < 32 ? 2 : 6);
  HizSsrParams thin = p;
  thin.thickness = 0.5;
  scenes.push_back(listed("rays along a depth edge", thin, cliff, edge));

  // A ray through its own viewing ray stays in one pixel.
  Values still;
  for (int i = 0; i < 100; ++i) {
    const auto at = place(p, std::floor(64 * random(i, 0)) + 0.5, std::floor(48 * random(i, 1)) + 0.5, 0.5 + 8 * random(i, 2));
    add_ray(still, at, i % 2 == 0 ? at : std::array{-at[0], -at[1], -at[2]});
  }
  scenes.push_back(listed("rays that stay in a pixel", thin, hills, still));
}

void add_lengths(std::vector<Scene>& scenes) {
  HizSsrParams p = ssr_params(64, 48);
  const Values hills = height_field(64, 48, 31);
  Values rays = screen_rays(p, 300, 32), none, across;
  for (const double reach : {1e-30, 1e-12, 1e-3}) {
    Values some = rays;
    for (std::size_t i = 3; i < some.size(); i += 8) some[i] = static_cast<float>(reach);
    scenes.push_back(listed(fmt::format("rays of length {}", reach), p, hills, some));
  }
  for (std::size_t i = 0; i < rays.size(); i += 8)
    add_ray(none, {rays[i], rays[i + 1], rays[i + 2]}, i % 16 == 0 ? std::array{0.0, 0.0, 0.0} : std::array{nan, 0.0, 1.0});
  scenes.push_back(listed("rays without a direction", p, hills, none));
  for (const double thickness : {0.0, 1e-6, 1e12, inf}) {
    p.thickness = thickness;
    scenes.push_back(listed(fmt::format("thickness {}", thickness), p, hills, rays));
  }
  p.thickness = 1;
  p.near_plane = 0.75;
  const auto random = [](int i, std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 8 + k, 33); };
  for (int i = 0; i < 300; ++i)
    add_between(across, place(p, 64 * random(i, 0), 48 * random(i, 1), 0.3 + 3 * random(i, 2)),
                {2 * random(i, 3) - 1, 2 * random(i, 4) - 1, 1.5});
  scenes.push_back(listed("rays across the near plane", p, hills, across));
}

void add_depths(std::vector<Scene>& scenes) {
  HizSsrParams p = ssr_params(64, 48);
  const std::size_t pixels = 64 * 48;
  const Values rays = screen_rays(p, 300, 41);
  Values checker, holes, infinities;
  for (std::size_t i = 0; i < pixels; ++i) {
    const bool odd = (i % 64 + i / 64) % 2 == 1;
    checker.push_back(odd ? 1.5 : 6);
    const double kind = scene::random01(static_cast<std::uint32_t>(i), 42);
    const double d = static_cast<float>(2 + 3 * scene::random01(static_cast<std::uint32_t>(i), 43));
    holes.push_back(kind < 0.3 ? nan : d);
    infinities.push_back(kind < 0.2 ? inf : kind < 0.4 ? 1e10 : kind < 0.5 ? 0 : kind < 0.55 ? -1 : kind < 0.6 ? -inf : d);
  }
  p.thickness = 0.5;
  scenes.push_back(listed("checkerboard of depths", p, checker, rays));
  scenes.push_back(listed("NaN in a third of the pixels", p, holes, rays));
  scenes.push_back(listed("infinite, zero and negative depth", p, infinities, rays));
  scenes.push_back(listed("NaN everywhere", p, Values(pixels, nan), rays));
  for (const SsrDepth depth : {SsrDepth::linear, SsrDepth::standard, SsrDepth::reversed})
    for (const double cleared : {0.0, 1.0}) {
      p.depth = depth;
      p.near_plane = 0.1;
      p.far_plane = depth == SsrDepth::linear ? 0 : 20;
      const char* how = depth == SsrDepth::linear ? "linear" : depth == SsrDepth::standard ? "standard" : "reversed";
      scenes.push_back(listed(fmt::format("{} depth cleared to {}", how, cleared), p, Values(pixels, cleared), rays));
    }
  // Depths from 1e-2 to 1e3, a ratio of 1e5, as reversed and linear depth hold them.
  Values ratio, far_rays = rays;
  for (std::size_t i = 0; i < pixels; ++i)
    ratio.push_back(0.01 * std::pow(1e5, scene::random01(static_cast<std::uint32_t>(i / 64 / 6 * 8 + i % 64 / 8), 44)));
  for (std::size_t i = 0; i < far_rays.size(); i += 8)
    for (std::size_t a = 0; a < 3; ++a) far_rays[i + a] = static_cast<float>(far_rays[i + a] * std::pow(10, 4.0 * (i % 80) / 80 - 2));
  for (const SsrDepth depth : {SsrDepth::linear, SsrDepth::reversed}) {
    HizSsrParams q = ssr_params(64, 48);
    q.depth = depth;
    q.near_plane = 1e-3;
    q.thickness = 30;
    scenes.push_back(listed(fmt::format("depth ratio 1e5, {} depth", depth == SsrDepth::linear ? "linear" : "reversed"), q,
                            stored_depths(q, ratio), far_rays));
  }
}

void add_mirrors(std::vector<Scene>& scenes) {
  HizSsrParams p = ssr_params(48, 36);
  const std::size_t pixels = 48 * 36;
  scenes.push_back(mirrored("wall that faces the camera", p, Values(pixels, 3), normals(pixels, {0, 0, 1})));
  scenes.push_back(mirrored("camera on a mirror", p, Values(pixels, 0.02), normals(pixels, {0, 0, 1})));
  scenes.push_back(mirrored("zero normals", p, Values(pixels, 3), normals(pixels, {0, 0, 0})));
  scenes.push_back(mirrored("NaN normals", p, Values(pixels, 3), normals(pixels, {nan, 0, 1})));
  scenes.push_back(mirrored("normals that look away", p, Values(pixels, 3), normals(pixels, {0, 0, -1})));
  Values mixed;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto random = [&](std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 4 + k, 51); };
    for (const double v : {random(0) - 0.5, random(1) - 0.5, 0.2 + random(2), random(3) < 0.5 ? 0.2 : 1.0})
      mixed.push_back(static_cast<float>(v));
  }
  p.thickness = 0.5;
  scenes.push_back(mirrored("mirrors of all directions on hills", p, height_field(48, 36, 52), mixed));
}

std::vector<Scene> scenes() {
  std::vector<Scene> all;
  add_conventions(all);
  add_sizes(all);
  add_directions(all);
  add_lengths(all);
  add_depths(all);
  add_mirrors(all);
  return all;
}

// Cases are copied for every device, scenes are not.
Case agreement_case(std::shared_ptr<const Scene> s, SsrVariant variant) {
  return {"", fmt::format("{}, {}", s->name, name(variant)), s->promise + " (answers that do not)", 0,
          [s, variant](Context& context) -> Result<double> {
            HizSsrParams p = s->params;
            p.variant = variant;
            const auto r = follow(context, p, s->stored, s->source);
            if (!r) return r.status();
            const Agreement a = compare(p, s->stored, s->source, r.value());
            return a.wrong + a.broken;
          }};
}

// hiz and dda on every size of a list: values of hits and paths (looks apart) that differ.
Case same_case(std::string sizes, std::vector<int> widths, std::vector<int> heights, bool slow) {
  return {"", "hiz is dda, " + sizes, "the pyramid skips no pixel that dda hits: the same bits (values that differ)", 0,
          [=](Context& context) -> Result<double> {
            // Every size is another part of one field: to make as many fields took longer than to follow rays over them.
            constexpr int side = 257 + 32;
            static const Values field = height_field(side, side, 263);
            double different = 0;
            for (const int w : widths)
              for (const int h : heights) {
                HizSsrParams p = ssr_params(w, h);
                p.thickness = (w + h) % 3 == 0 ? 0.3 : 1e30;
                p.rays = 64;
                Values stored;
                for (int y = 0; y < h; ++y) {
                  const auto row = field.begin() + (y + (5 * w + h) % 32) * side + (w + 7 * h) % 32;
                  stored.insert(stored.end(), row, row + w);
                }
                const Values rays = screen_rays(p, p.rays, static_cast<std::uint32_t>(w + 1000 * h));
                const auto a = follow(context, p, stored, rays);
                if (!a) return a.status();
                p.variant = SsrVariant::dda;
                const auto b = follow(context, p, stored, rays);
                if (!b) return b.status();
                different += count_different(a.value().hits, b.value().hits);
                for (std::size_t i = 0; i < a.value().paths.size(); ++i)
                  different += i % 4 < 2 && !same(a.value().paths[i], b.value().paths[i]);
              }
            return different;
          },
          slow};
}

std::vector<int> all_sizes() {
  std::vector<int> sizes;
  for (int n = 1; n <= 257; ++n) sizes.push_back(n);
  return sizes;
}

}  // namespace

void add_ssr_walk_cases(std::vector<Case>& cases) {
  std::vector<Scene> all = scenes();
  for (Scene& scene : all) {
    const auto s = std::make_shared<const Scene>(std::move(scene));
    for (const SsrVariant v : {SsrVariant::hiz, SsrVariant::dda}) cases.push_back(agreement_case(s, v));
  }
  cases.push_back(same_case("12 sizes", {1, 31, 64, 257}, {1, 48, 129}, false));
  cases.push_back(same_case("every width from 1 to 257 with heights 1, 32, 257", all_sizes(), {1, 32, 257}, true));
  cases.push_back(same_case("every width and height from 1 to 257", all_sizes(), all_sizes(), true));
  // The devices give the bits of this one (other cases), and a launch and a wait for each of 66,049 sizes take minutes.
  cases.back().applies = [](const DeviceInfo& device) { return device.id == "cpu:float"; };
}

}  // namespace luxel::cases

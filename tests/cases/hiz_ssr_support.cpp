#include "tests/cases/hiz_ssr_support.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bench/scene/images.h"
#include "tests/cases/run.h"

namespace luxel::cases {

HizSsrParams ssr_params(int width, int height, SsrVariant variant) {
  HizSsrParams p;
  p.width = width;
  p.height = height;
  p.variant = variant;
  set_field(p, std::numbers::pi / 3);
  return p;
}

double stored_depth(const HizSsrParams& p, double depth) {
  if (p.depth == SsrDepth::linear) return static_cast<float>(depth);
  const double near_w = 1 / p.near_plane, far_w = p.far_plane > 0 ? 1 / p.far_plane : 0;
  const double reversed = (1 / depth - far_w) / (near_w - far_w);
  return static_cast<float>(p.depth == SsrDepth::reversed ? reversed : 1 - reversed);
}

Values stored_depths(const HizSsrParams& p, std::span<const double> depths) {
  Values stored;
  for (const double d : depths) stored.push_back(stored_depth(p, d));
  return stored;
}

Values height_field(int width, int height, std::uint32_t seed) {
  Values z;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto random = [&](int u, int v, std::uint32_t k) {
        return scene::random01(static_cast<std::uint32_t>(v * 4096 + u) + (k << 26), seed);
      };
      double d = 4 + 2 * std::sin(0.13 * x + 3 * random(0, 0, 1)) * std::cos(0.09 * y) + 0.3 * random(x, y, 2);
      if (random(x / 12, y / 9, 3) < 0.2) d = 1 + 2 * random(x / 12, y / 9, 4);       // blocks
      if (random(x, 0, 5) < 0.03) d = std::min(d, 1.5 + random(x, 0, 6));              // poles one pixel wide
      if (random(x / 16, y / 16, 7) < 0.12) d = std::numeric_limits<double>::infinity();
      z.push_back(static_cast<float>(d));
    }
  return z;
}

void add_ray(Values& rays, std::array<double, 3> o, std::array<double, 3> d, double reach) {
  for (const double v : {o[0], o[1], o[2], reach, d[0], d[1], d[2], 0.0}) rays.push_back(static_cast<float>(v));
}

Values screen_rays(const HizSsrParams& p, int count, std::uint32_t seed) {
  Values rays;
  for (int i = 0; i < count; ++i) {
    const auto random = [&](std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 8 + k, seed); };
    const double d = 0.5 + 8 * random(0) * random(0), z = 2 * random(3) - 1, phi = 2 * std::numbers::pi * random(4);
    const double r = std::sqrt(1 - z * z);
    add_ray(rays, {(random(1) * p.width - p.centre_x) / p.focal_x * d, (p.centre_y - random(2) * p.height) / p.focal_y * d, -d},
            {r * std::cos(phi), r * std::sin(phi), z}, i % 3 == 0 ? 6 * random(5) : 0);
  }
  return rays;
}

namespace {

// Level 0 with all others behind it, each at its place.
template <class Offset>
Result<Values> with_levels(Context& context, const MipBuildParams& m, std::span<const double> level_0, std::size_t size,
                           const Offset& offset) {
  Values all(level_0.begin(), level_0.end());
  all.resize(size);
  auto run = Run::make(context, plan(m, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write(mip_level_name(0), level_0); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  for (int level = 1; level <= mip_levels(m); ++level) {
    const auto values = run.value().read(mip_level_name(level));
    if (!values) return values.status();
    std::copy(values.value().begin(), values.value().end(), all.begin() + static_cast<std::ptrdiff_t>(offset(level)));
  }
  return all;
}

}  // namespace

Result<Values> with_pyramid(Context& context, const HizSsrParams& p, std::span<const double> stored) {
  if (hiz_ssr_levels(p) == 1) return Values(stored.begin(), stored.end());
  return with_levels(context, hiz_ssr_pyramid(p), stored, hiz_ssr_depth_texels(p),
                     [&](int level) { return hiz_ssr_level_offset(p, level); });
}

Result<Values> with_colours(Context& context, const HizSsrParams& p, std::span<const double> colours) {
  Values all(colours.begin(), colours.end());
  if (hiz_ssr_colour_levels(p) == 1) return all;
  return with_levels(context, hiz_ssr_colours(p), colours, 4 * hiz_ssr_colour_texels(p), [&](int level) { return 4 * hiz_ssr_colour_offset(p, level); });
}

Result<SsrResult> follow(Context& context, const HizSsrParams& p, std::span<const double> stored,
                         std::span<const double> source, const SsrColours& colours) {
  const auto depth = with_pyramid(context, p, stored);
  if (!depth) return depth.status();
  auto run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write("depth", depth.value()); !s) return s;
  if (Status s = run.value().write(p.rays > 0 ? "rays" : "normals", source); !s) return s;
  if (p.count)
    if (Status s = run.value().write("counters", Values(ssr_outcomes, 0.0)); !s) return s;
  if (p.shade) {
    const auto colour = with_colours(context, p, colours.colour);
    if (!colour) return colour.status();
    if (Status s = run.value().write("colour", colour.value()); !s) return s;
  }
  if (p.fallback)
    if (Status s = run.value().write("fallback", colours.fallback); !s) return s;
  if (p.factor) {
    if (Status s = run.value().write("specular", colours.specular); !s) return s;
    if (Status s = run.value().write("split_sum", colours.split_sum); !s) return s;
  }
  if (Status s = run.value().go(); !s) return s;
  SsrResult r;
  for (const auto& [name, to] : {std::pair{"hits", &r.hits}, {"paths", &r.paths}, {"counters", &r.counters},
                                 {"directions", &r.directions}, {"radiance", &r.radiance}}) {
    const auto& all = run.value().plan().resources;
    if (std::none_of(all.begin(), all.end(), [n = std::string(name)](const Resource& x) { return x.name == n; })) continue;
    auto values = run.value().read(name);
    if (!values) return values.status();
    *to = std::move(values).value();
  }
  return r;
}

Result<Values> split_sum_table(Context& context, int size, int samples) {
  auto run = Run::make(context, plan(SplitSumParams{size, samples}, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().go(); !s) return s;
  return run.value().read("split_sum");
}

bool ray_of(const HizSsrParams& p, std::span<const double> stored, std::span<const double> source, std::size_t i,
            truth::ScreenRay& to) {
  if (p.rays == 0) {
    if (!(source[4 * i + 3] < p.cutoff)) return false;
    return truth::mirror_ray(p, static_cast<int>(i) % p.width, static_cast<int>(i) / p.width, stored[i],
                             {source[4 * i], source[4 * i + 1], source[4 * i + 2]}, to);
  }
  const double* r = &source[8 * i];
  const double most = p.max_distance > 0 ? p.max_distance : HUGE_VAL;
  to.origin = {r[0], r[1], r[2]};
  const double size = std::hypot(r[4], r[5], r[6]);
  to.direction = {r[4] / size, r[5] / size, r[6] / size};
  to.reach = r[3] > 0 ? std::min(r[3], most) : most;
  return size > 0 && std::isfinite(size + r[0] + r[1] + r[2]);
}

Agreement compare(const HizSsrParams& p, std::span<const double> stored, std::span<const double> source,
                  const SsrResult& result) {
  Agreement a;
  const std::size_t count = p.rays > 0 ? static_cast<std::size_t>(p.rays) : static_cast<std::size_t>(p.width) * p.height;
  for (std::size_t i = 0; i < count; ++i) {
    const SsrOutcome outcome = result.outcome(i);
    const double *hit = &result.hits[4 * i], *path = &result.paths[4 * i];
    for (int c = 0; c < 4; ++c) a.broken += !std::isfinite(hit[c]) || !std::isfinite(path[c]);
    truth::ScreenRay ray;
    if (!ray_of(p, stored, source, i, ray)) {
      a.broken += outcome != SsrOutcome::none && outcome != SsrOutcome::degenerate;
      continue;
    }
    ++a.rays;
    const int x = static_cast<int>(std::floor(hit[0] * p.width)), y = static_cast<int>(std::floor(hit[1] * p.height));
    if (outcome == SsrOutcome::hit) {
      ++a.hits;
      a.broken += !(hit[3] >= 0 && hit[3] <= 1 && hit[2] > 0);
      // Length and depth are those of one point of the ray, to the rounding of f32 in reciprocal depth.
      const double d = -(ray.origin[2] + path[0] * ray.direction[2]);
      const double far = std::max({hit[2], -ray.origin[2], path[0]});
      a.broken += !(std::fabs(d - hit[2]) <= 0x1p-19 * far * std::max(1.0, far / -ray.origin[2]));
    } else {
      for (int c = 0; c < 4; ++c) a.broken += hit[c] != 0;
    }
    const truth::Verdict v = truth::judge(p, stored, ray, outcome, x, y);
    a.equal += v == truth::Verdict::equal;
    a.ties += v == truth::Verdict::tie;
    a.wrong += v == truth::Verdict::wrong;
    a.missed += v == truth::Verdict::wrong && outcome != SsrOutcome::hit;
  }
  return a;
}

}  // namespace luxel::cases

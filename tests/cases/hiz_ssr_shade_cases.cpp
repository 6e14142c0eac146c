// Radiance from hits: lobes, tiles, colours.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "bench/scene/images.h"
#include "bench/truth/ssr_lobe.h"
#include "tests/cases/compare.h"
#include "tests/cases/hiz_ssr_support.h"

namespace luxel::cases {
namespace {

constexpr int width = 75, height = 52;
constexpr std::size_t pixels = static_cast<std::size_t>(width) * height;

HizSsrParams shaded(SsrVariant variant, bool half = false) {
  HizSsrParams p = ssr_params(width, height, variant);
  p.shade = true;
  p.thickness = 0.5;
  p.fade_back = 0.25;  // these normals are not those of the hills
  if (variant == SsrVariant::stochastic) {
    p.rays_per_pixel = 2;
    p.half_resolution = half;
  }
  return p;
}

// Normals of all directions that face the camera, and a roughness a block of 10 x 10 pixels; beyond the cutoff where
// `reflects` says no.
Values lobes(double reflects, std::uint32_t seed) {
  Values v;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto random = [&](std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 4 + k, seed); };
    const std::size_t block = i / width / 10 * 8 + i % width / 10;
    const auto of_block = [&](std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(block) * 4 + k, seed + 1); };
    for (const double c : {0.6 * random(0) - 0.3, 0.6 * random(1), 0.6 + random(2), of_block(0) < reflects ? 0.9 * of_block(1) : 1.5})
      v.push_back(static_cast<float>(c));
  }
  return v;
}

Values constant(std::array<double, 3> c) {
  Values v;
  for (std::size_t i = 0; i < pixels; ++i) v.insert(v.end(), {c[0], c[1], c[2], 1});
  return v;
}

Values noise(std::uint32_t seed) {
  Values v;
  for (std::size_t i = 0; i < 4 * pixels; ++i) v.push_back(static_cast<float>(i % 4 == 3 ? 1 : 3 * scene::random01(static_cast<std::uint32_t>(i), seed)));
  return v;
}

Case furnace_case(const HizSsrParams& params, const std::string& which) {
  return {"", "white furnace, " + which,
          "the same radiance from screen and environment is what every lobe has, and nothing is where none reflects (largest difference)",
          4e-6, [params](Context& context) -> Result<double> {
            HizSsrParams p = params;
            p.environment = {0.5, 1, 2};
            const Values source = lobes(0.6, 91);
            const auto r = follow(context, p, height_field(width, height, 92), source, {constant({0.5, 1, 2}), {}, {}, {}});
            if (!r) return r.status();
            double most = 0, seen = 0;
            const Values depth = height_field(width, height, 92);
            for (std::size_t i = 0; i < pixels; ++i) {
              const bool reflects = source[4 * i + 3] < 1 && std::isfinite(depth[i]);
              for (std::size_t c = 0; c < 3; ++c)
                most = std::max(most, std::fabs(r.value().radiance[4 * i + c] / (0.5 * static_cast<double>(1 << c)) - (reflects ? 1 : 0)));
              seen += r.value().radiance[4 * i + 3];
              if (!reflects) most = std::max(most, r.value().radiance[4 * i + 3]);
            }
            return seen > 20 ? most : std::numeric_limits<double>::quiet_NaN();
          }};
}

Case tiles_case() {
  return {"", "tiles that reflect nothing", "leaving tiles out changes no other pixel, and theirs are zeros (values that differ)", 0,
          [](Context& context) -> Result<double> {
            const HizSsrParams p = shaded(SsrVariant::hiz);
            const Values depth = height_field(width, height, 93), some = lobes(0.3, 94), all = lobes(1, 94);
            const SsrColours colours{noise(95), {}, {}, {}};
            const auto a = follow(context, p, depth, some, colours), b = follow(context, p, depth, all, colours);
            if (!a) return a.status();
            if (!b) return b.status();
            double different = 0, kept = 0;
            for (std::size_t i = 0; i < 4 * pixels; ++i) {
              const bool reflects = some[i / 4 * 4 + 3] < 1 && std::isfinite(depth[i / 4]);
              kept += reflects;
              for (const auto& [x, y] : {std::pair{a.value().radiance[i], b.value().radiance[i]},
                                         {a.value().hits[i], b.value().hits[i]},
                                         {a.value().paths[i], b.value().paths[i]}})
                different += !same(x, reflects ? y : 0.0);
            }
            return kept > 400 ? different : std::numeric_limits<double>::quiet_NaN();
          }};
}

Case colour_case() {
  return {"", "colour of what was hit", "without prefiltering a mirror shows the pixel that was hit, by confidence, before the environment (difference)",
          2e-6, [](Context& context) -> Result<double> {
            HizSsrParams p = shaded(SsrVariant::hiz);
            p.prefilter = 0;
            p.environment = {3, 2, 1};
            p.fade_edge = 0.3;
            const Values source = lobes(1, 96), colour = noise(97);
            const auto r = follow(context, p, height_field(width, height, 98), source, {colour, {}, {}, {}});
            if (!r) return r.status();
            double most = 0, hits = 0;
            for (std::size_t i = 0; i < pixels; ++i) {
              if (r.value().outcome(i) == SsrOutcome::none) continue;
              const double* hit = &r.value().hits[4 * i];
              const std::size_t at = static_cast<std::size_t>(hit[1] * height) * width + static_cast<std::size_t>(hit[0] * width);
              hits += r.value().outcome(i) == SsrOutcome::hit;
              for (std::size_t c = 0; c < 3; ++c)
                most = std::max(most, std::fabs(r.value().radiance[4 * i + c] - hit[3] * colour[4 * at + c] - (1 - hit[3]) * p.environment[c]));
            }
            return hits > 300 ? most : std::numeric_limits<double>::quiet_NaN();
          }};
}

Case hostile_case(SsrVariant variant, const char* name) {
  return {"", fmt::format("NaN and infinite colours, {}", name), "what is not finite on the screen does not count as seen (results that are not finite)", 0,
          [=](Context& context) -> Result<double> {
            const HizSsrParams p = shaded(variant);
            Values colour = noise(99);
            for (std::size_t i = 0; i < colour.size(); i += 28) colour[i] = i % 3 == 0 ? std::numeric_limits<double>::quiet_NaN() : HUGE_VAL;
            const auto r = follow(context, p, height_field(width, height, 98), lobes(1, 96), {colour, {}, {}, {}});
            if (!r) return r.status();
            return static_cast<double>(std::count_if(r.value().radiance.begin(), r.value().radiance.end(), [](double v) { return !std::isfinite(v); }));
          }};
}

Case table_case() {
  return {"", "split-sum table", "32 x 32 entries of 1024 samples agree with quadrature in double (largest difference)", 2e-3,
          [](Context& context) -> Result<double> {
            constexpr int size = 32;
            const auto table = split_sum_table(context, size, 1024);
            if (!table) return table.status();
            double most = 0;
            for (int y = 0; y < size; y += 3)
              for (int x = 0; x < size; x += 3) {
                const double roughness = (y + 0.5) / size;
                const auto truth = truth::split_sum((x + 0.5) / size, std::max(roughness * roughness, 1e-3), 300);
                for (std::size_t c = 0; c < 2; ++c)
                  most = std::max(most, std::fabs(table.value()[static_cast<std::size_t>(y * size + x) * 2 + c] - truth[c]));
              }
            return most;
          }};
}

// The share of an even environment that the lobe mirrors, by the rays' own directions and densities, is that of the table: only
// then are directions distributed as the densities say.
Case density_case(double roughness) {
  return {"", fmt::format("densities of directions, roughness {}", roughness),
          "the mean of lobe over density is the lobe's integral (differences in standard errors)", 4.5,
          [=](Context& context) -> Result<double> {
            HizSsrParams p = ssr_params(width, height, SsrVariant::stochastic);
            p.rays_per_pixel = 4;
            p.focal_x = p.focal_y = 1e5;  // all pixels look along the axis
            Values source;
            const double tilt = 0.6;
            for (std::size_t i = 0; i < pixels; ++i)
              for (const double v : {std::sin(tilt), 0.0, std::cos(tilt), roughness}) source.push_back(static_cast<float>(v));
            const auto r = follow(context, p, Values(pixels, 5.0), source);
            if (!r) return r.status();
            const double alpha = static_cast<float>(roughness) * static_cast<double>(static_cast<float>(roughness));
            const double n_v = std::cos(tilt);
            const auto lambda = [&](double c) { return (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2; };
            double sum = 0, squares = 0, count = 0;
            for (std::size_t i = 0; i < hiz_ssr_rays(p); ++i) {
              const double* d = &r.value().directions[4 * i];
              const double n_l = std::sin(tilt) * d[0] + std::cos(tilt) * d[2];
              const double size = std::sqrt(2 + 2 * d[2]), h_z = (std::sin(tilt) * d[0] + std::cos(tilt) * (d[2] + 1)) / size;
              const double k = h_z * h_z * (alpha * alpha - 1) + 1;
              const double density = alpha * alpha / (3.14159265358979 * k * k);
              const double weight = n_l > 0 ? density / (1 + lambda(n_v) + lambda(n_l)) / (4 * n_v * d[3]) : 0;
              sum += weight, squares += weight * weight, ++count;
            }
            const auto truth = truth::split_sum(n_v, alpha, 600);
            const double mean = sum / count, error = std::sqrt((squares / count - mean * mean) / count);
            return std::fabs(mean - truth[0] - truth[1]) / error;
          }};
}

// Radiance of pixels from the rays around them, worked out anew from what the rays found: each weighted by D G2 / (4 (n v) pdf).
Case resolve_case() {
  return {"", "radiance of rays drawn from lobes, by its definition",
          "what the rays around a pixel saw, weighted by its lobe over the density that each was drawn with (largest difference)", 1e-4,
          [](Context& context) -> Result<double> {
            HizSsrParams p = shaded(SsrVariant::stochastic);
            p.prefilter = 0;
            p.reuse = 1;
            p.environment = {3, 2, 1};
            const Values source = lobes(1, 96), colour = noise(97), depth = height_field(width, height, 98);
            const auto r = follow(context, p, depth, source, {colour, {}, {}, {}});
            if (!r) return r.status();
            const SsrResult& got = r.value();
            using glm::dvec3;
            const auto sight = [&](double x, double y) { return dvec3((x - p.centre_x) / p.focal_x, (p.centre_y - y) / p.focal_y, -1); };
            double most = 0, compared = 0;
            for (int y = 0; y < height; ++y)
              for (int x = 0; x < width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                const double roughness = source[4 * i + 3], alpha = roughness * roughness;
                if (roughness < 0.35 || !std::isfinite(depth[i])) continue;  // narrower lobes lose digits of f32
                const dvec3 n = glm::normalize(dvec3(source[4 * i], source[4 * i + 1], source[4 * i + 2])), eye = sight(x + 0.5, y + 0.5);
                const dvec3 v = -glm::normalize(eye), place = depth[i] * eye;
                const double n_v = glm::dot(n, v);
                if (n_v < 0.05) continue;
                const auto lambda = [&](double c) { return (std::sqrt(1 + alpha * alpha * (1 / (c * c) - 1)) - 1) / 2; };
                dvec3 sum(0);
                double weights = 0, known = 0;
                for (int b = std::max(y - 1, 0); b <= std::min(y + 1, height - 1); ++b)
                  for (int a = std::max(x - 1, 0); a <= std::min(x + 1, width - 1); ++a)
                    for (int k = 0; k < p.rays_per_pixel; ++k) {
                      const std::size_t ray = static_cast<std::size_t>((k * height + b) * width + a);
                      const SsrOutcome outcome = got.outcome(ray);
                      if (outcome < SsrOutcome::hit || outcome > SsrOutcome::capped) continue;
                      const double *hit = &got.hits[4 * ray], *drawn = &got.directions[4 * ray];
                      dvec3 l(drawn[0], drawn[1], drawn[2]);
                      if (outcome == SsrOutcome::hit) l = glm::normalize(hit[2] * sight(hit[0] * width, hit[1] * height) - place);
                      const double n_l = glm::dot(n, l);
                      if (!(n_l > 0)) continue;
                      const double cosine = glm::dot(n, glm::normalize(v + l)), q = cosine * cosine * (alpha * alpha - 1) + 1;
                      const double density = alpha * alpha / (3.14159265358979 * q * q);
                      const double weight = density / (1 + lambda(n_v) + lambda(n_l)) / (4 * n_v * drawn[3]);
                      weights += weight;
                      if (outcome != SsrOutcome::hit) continue;
                      const std::size_t at = static_cast<std::size_t>(hit[1] * height) * width + static_cast<std::size_t>(hit[0] * width);
                      sum += weight * hit[3] * dvec3(colour[4 * at], colour[4 * at + 1], colour[4 * at + 2]);
                      known += weight * hit[3];
                    }
                if (!(known > 0)) continue;
                ++compared;
                for (int c = 0; c < 3; ++c) {
                  const double expected = sum[c] / weights + (1 - known / weights) * p.environment[static_cast<std::size_t>(c)];
                  const double off = std::fabs(got.radiance[4 * i + static_cast<std::size_t>(c)] - expected);
                  if (!(off <= most)) most = off;
                }
              }
            return compared > 500 ? most : std::numeric_limits<double>::quiet_NaN();
          }};
}

}  // namespace

void add_ssr_shade_cases(std::vector<Case>& cases) {
  cases.push_back(furnace_case(shaded(SsrVariant::hiz), "mirror rays"));
  cases.push_back(furnace_case(shaded(SsrVariant::stochastic), "stochastic"));
  cases.push_back(furnace_case(shaded(SsrVariant::stochastic, true), "stochastic at half resolution"));
  cases.push_back(tiles_case());
  cases.push_back(colour_case());
  cases.push_back(resolve_case());
  cases.push_back(hostile_case(SsrVariant::dda, "mirror rays"));
  cases.push_back(hostile_case(SsrVariant::stochastic, "stochastic"));
  cases.push_back(table_case());
  for (const double roughness : {0.2, 0.5, 0.9}) cases.push_back(density_case(roughness));
}

}  // namespace luxel::cases

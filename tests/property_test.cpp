// Contracts that hold for any input, tried on random ones: constants kept, shifts, powers of two, parts against the whole, order.
// On the C++ execution: the others have its bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include <luxel/bilateral.h>
#include <luxel/gaussian_blur.h>
#include <luxel/mip_build.h>

#include "bench/scene/images.h"
#include "tests/cases/compare.h"
#include "tests/cases/cone_trace_support.h"
#include "tests/cases/hiz_ssr_support.h"
#include "tests/cases/light_propagation_support.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"
#include "tests/cases/voxelize_support.h"
#include "tests/support/property.h"
#include "tests/support/run.h"

namespace luxel::cases {
namespace {

constexpr double f32_rounding = 4e-6;  // of sums of a few hundred terms

Context& cpu() { return test_context("cpu"); }

double random(std::uint32_t index, int seed) { return scene::random01(index, static_cast<std::uint32_t>(seed)); }

// Noise in 0..1, four channels a pixel, floats.
Values noise(std::size_t pixels, int seed) {
  Values v(pixels * 4);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = static_cast<float>(random(static_cast<std::uint32_t>(i), seed));
  return v;
}

Values times(Values v, double factor) {
  for (double& x : v) x *= factor;
  return v;
}

Values result(const Result<Plan>& plan, const std::vector<std::pair<std::string, Values>>& inputs, const std::string& output) {
  auto made = Run::make(cpu(), plan);
  EXPECT_TRUE(made.ok()) << made.status().message();
  if (!made) return {};
  for (const auto& [name, values] : inputs) EXPECT_TRUE(made.value().write(name, values).ok());
  EXPECT_TRUE(made.value().go().ok());
  return made.value().read(output).value();
}

std::string unequal(const Values& a, const Values& b) {
  const double n = count_different(a, b);
  return n == 0 ? "" : std::to_string(n) + " values differ";
}

GaussianBlurParams blur_of(const std::vector<int>& c) {
  GaussianBlurParams p;
  p.width = c[0];
  p.height = c[1];
  p.sigma = c[2] / 10.0;
  p.border = static_cast<Border>(c[3]);
  constexpr GaussianVariant variants[] = {GaussianVariant::separable, GaussianVariant::direct, GaussianVariant::recursive,
                                          GaussianVariant::box, GaussianVariant::pyramid};
  p.variant = variants[c[4]];
  return p;
}
const std::vector<Chosen> blurs{{"width", 1, 40}, {"height", 1, 40}, {"tenths of sigma", 1, 60}, {"border", 0, 3}, {"variant", 0, 4}};

Values blurred(const GaussianBlurParams& p, const Values& src) { return result(plan(p, cpu().profile()), {{"src", src}}, "dst"); }

TEST(Property, ShrinkingFindsTheSmallestCase) {
  const std::vector<Chosen> numbers{{"a", 0, 1000}, {"b", 3, 1000}};
  const Property small_sum = [](const std::vector<int>& c) { return c[0] + c[1] < 100 ? "" : "too large"; };
  const std::vector<int> found = shrink(numbers, {900, 800}, small_sum);
  EXPECT_EQ(found[0] + found[1], 100);
}

TEST(Property, AGaussianKeepsConstantsInEveryFormat) {
  std::vector<Chosen> numbers = blurs;
  numbers.insert(numbers.end(), {{"format", 0, 2}, {"value", 0, 255}});
  for_all(numbers, 400, [](const std::vector<int>& c) -> std::string {
    GaussianBlurParams p = blur_of(c);
    constexpr Format formats[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};
    p.format = formats[c[5]];
    const Values src = quantise(Values(static_cast<std::size_t>(c[0]) * c[1] * 4, c[6] / 255.0), p.format);
    const double bound = (p.format == Format::f32x4 ? 0 : step(p.format, src[0]) / 2) + f32_rounding;
    const double off = max_difference(blurred(p, src), src);
    return off <= bound ? "" : "a constant moves by " + std::to_string(off);
  });
}

TEST(Property, AGaussianScalesByPowersOfTwo) {
  std::vector<Chosen> numbers = blurs;
  numbers.insert(numbers.end(), {{"power", 0, 40}, {"seed", 0, 1000}});
  for_all(numbers, 400, [](const std::vector<int>& c) {
    const double factor = std::ldexp(1, c[5] - 20);
    const Values src = noise(static_cast<std::size_t>(c[0]) * c[1], c[6]);
    return unequal(blurred(blur_of(c), times(src, factor)), times(blurred(blur_of(c), src), factor));
  });
}

TEST(Property, AGaussianOfAPartIsThatPartOfTheWhole) {
  const std::vector<Chosen> numbers{{"width", 1, 12}, {"height", 1, 12}, {"tenths of sigma", 1, 30}, {"more", 0, 20}, {"seed", 0, 1000}};
  for_all(numbers, 400, [](const std::vector<int>& c) -> std::string {
    GaussianBlurParams p;
    p.sigma = c[2] / 10.0;
    const int margin = effective_radius([&] {
      GaussianBlurParams q = p;
      q.width = q.height = 64;
      return q;
    }());
    GaussianBlurParams whole = p, part = p;
    whole.width = c[0] + 2 * margin + c[3];
    whole.height = c[1] + 2 * margin + c[3];
    part.width = c[0] + 2 * margin;
    part.height = c[1] + 2 * margin;
    const Values src = noise(static_cast<std::size_t>(whole.width) * whole.height, c[4]);
    Values cut;
    for (int y = 0; y < part.height; ++y)
      cut.insert(cut.end(), &src[static_cast<std::size_t>(y + c[3]) * whole.width * 4 + static_cast<std::size_t>(c[3]) * 4],
                 &src[static_cast<std::size_t>(y + c[3]) * whole.width * 4 + static_cast<std::size_t>(c[3]) * 4] + part.width * 4);
    const Values a = blurred(whole, src), b = blurred(part, cut);
    for (int y = margin; y < margin + c[1]; ++y)
      for (int x = 4 * margin; x < 4 * (margin + c[0]); ++x)
        if (!same(a[static_cast<std::size_t>(y + c[3]) * whole.width * 4 + static_cast<std::size_t>(c[3]) * 4 + x],
                  b[static_cast<std::size_t>(y) * part.width * 4 + x]))
          return "pixel " + std::to_string(x / 4) + "," + std::to_string(y) + " differs";
    return "";
  });
}

TEST(Property, AGaussianOfATurnedImageIsTheTurnedGaussian) {
  for_all({{"width", 1, 30}, {"height", 1, 30}, {"tenths of sigma", 1, 40}, {"right", 0, 29}, {"down", 0, 29}, {"seed", 0, 1000}}, 400,
          [](const std::vector<int>& c) {
            GaussianBlurParams p;
            p.width = c[0];
            p.height = c[1];
            p.sigma = c[2] / 10.0;
            p.border = Border::wrap;
            const auto turned = [&](const Values& v) {
              Values t(v.size());
              for (int y = 0; y < c[1]; ++y)
                for (int x = 0; x < c[0]; ++x)
                  for (int k = 0; k < 4; ++k)
                    t[static_cast<std::size_t>(((y + c[4]) % c[1] * c[0] + (x + c[3]) % c[0]) * 4 + k)] =
                        v[static_cast<std::size_t>((y * c[0] + x) * 4 + k)];
              return t;
            };
            const Values src = noise(static_cast<std::size_t>(c[0]) * c[1], c[5]);
            return unequal(blurred(p, turned(src)), turned(blurred(p, src)));
          });
}

TEST(Property, ABilateralFilterScalesWithItsImage) {
  for_all({{"width", 1, 24}, {"height", 1, 24}, {"radius", 0, 4}, {"hundredths of sigma", 1, 100}, {"variant", 0, 1}, {"power", 0, 40},
           {"seed", 0, 1000}},
          400, [](const std::vector<int>& c) {
            BilateralParams p;
            p.width = c[0];
            p.height = c[1];
            p.radius = c[2];
            p.sigma_range = c[3] / 100.0;
            p.variant = c[4] == 0 ? BilateralVariant::direct : BilateralVariant::separable;
            const double factor = std::ldexp(1, c[5] - 20);
            BilateralParams q = p;
            q.sigma_range = p.sigma_range * factor;
            const Values src = noise(static_cast<std::size_t>(c[0]) * c[1], c[6]);
            const auto of = [](const BilateralParams& params, const Values& v) {
              return result(plan(params, cpu().profile()), {{"src", v}}, "dst");
            };
            return unequal(of(q, times(src, factor)), times(of(p, src), factor));
          });
}

TEST(Property, LevelsKeepConstantsAndBounds) {
  for_all({{"width", 1, 21}, {"height", 1, 21}, {"depth", 1, 21}, {"sixteenths", 0, 16}}, 400, [](const std::vector<int>& c) -> std::string {
    MipBuildParams p;
    p.width = c[0];
    p.height = c[1];
    p.depth = c[2];
    if (c[0] * c[1] * c[2] == 1) return "";
    const Values src(static_cast<std::size_t>(c[0]) * c[1] * c[2] * 4, c[3] / 16.0);
    auto made = Run::make(cpu(), plan(p, cpu().profile()));
    if (!made) return made.status().message();
    if (Status s = made.value().write("level_0", src); !s) return s.message();
    if (Status s = made.value().go(); !s) return s.message();
    for (int level = 1; level <= mip_levels(p); ++level) {
      const Values values = made.value().read(mip_level_name(level)).value();
      for (const double v : values)
        if (v != c[3] / 16.0) return "level " + std::to_string(level) + " holds " + std::to_string(v);
    }
    return "";
  });
}

TEST(Property, ConesScaleWithLightAndWithTheScene) {
  for_all({{"side", 2, 12}, {"anisotropic", 0, 1}, {"power of light", 0, 40}, {"power of scene", 0, 24}, {"seed", 0, 1000}}, 400,
          [](const std::vector<int>& c) -> std::string {
            const double light = std::ldexp(1, c[2] - 20), size = std::ldexp(1, c[3] - 12);
            ConeTraceParams p = cone_params(c[0], c[1] == 0 ? ConeVariant::isotropic : ConeVariant::anisotropic), q = p;
            p.width = q.width = 5;
            p.environment = {0.5, 0.25, 1};
            q.environment = {0.5 * light, 0.25 * light, light};
            q.voxel = p.voxel * size;
            for (std::size_t k = 0; k < 3; ++k) q.origin[k] = p.origin[k] * size;
            if (p.max_distance > 0) q.max_distance = p.max_distance * size;
            q.gamma = p.gamma / size;
            Values volume = noise(static_cast<std::size_t>(c[0]) * c[0] * c[0], c[4]), brighter = volume;
            for (std::size_t i = 0; i < volume.size(); i += 4) {  // mostly empty, premultiplied
              const double a = random(static_cast<std::uint32_t>(i), c[4] + 1) < 0.7 ? 0 : volume[i + 3];
              for (std::size_t k = 0; k < 3; ++k) volume[i + k] = static_cast<float>(volume[i + k] * a);
              volume[i + 3] = a;
              for (std::size_t k = 0; k < 3; ++k) brighter[i + k] = volume[i + k] * light;
              brighter[i + 3] = a;
            }
            const Values receivers = cone_receivers(p, 5, static_cast<std::uint32_t>(c[4]));
            Values scaled = receivers;
            for (std::size_t i = 0; i < scaled.size(); i += 8)
              for (std::size_t k = 0; k < 3; ++k) scaled[i + k] *= size;
            const auto a = trace(cpu(), p, volume, receivers), b = trace(cpu(), q, brighter, scaled);
            if (!a) return a.status().message();
            if (!b) return b.status().message();
            Values expected = a.value().irradiance;
            for (std::size_t i = 0; i < expected.size(); ++i) expected[i] *= i % 4 < 3 ? light : 1;
            return unequal(b.value().irradiance, expected);
          });
}

TEST(Property, PropagationTurnsWithAPeriodicGridAndScalesWithLight) {
  for_all({{"width", 1, 9}, {"height", 1, 9}, {"depth", 1, 9}, {"steps", 1, 5}, {"right", 0, 8}, {"down", 0, 8}, {"power", 0, 40}, {"seed", 0, 1000}},
          400, [](const std::vector<int>& c) -> std::string {
            LpvPropagateParams p = lpv_params({c[0], c[1], c[2]});
            p.border = LpvBorder::periodic;
            p.iterations = c[3];
            const double factor = std::ldexp(1, c[6] - 20);
            const Values lights = lpv_lights(p.grid, 2, 3, static_cast<std::uint32_t>(c[7]));
            const auto turned = [&](const Values& v) {
              Values t(v.size());
              for (int z = 0; z < c[2]; ++z)
                for (int y = 0; y < c[1]; ++y)
                  for (int x = 0; x < c[0]; ++x)
                    for (int k = 0; k < 4; ++k)
                      t[static_cast<std::size_t>(((z * c[1] + (y + c[5]) % c[1]) * c[0] + (x + c[4]) % c[0]) * 4 + k)] =
                          v[static_cast<std::size_t>(((z * c[1] + y) * c[0] + x) * 4 + k)] * factor;
              return t;
            };
            const auto a = propagate(cpu(), p, lights), b = propagate(cpu(), p, turned(lights));
            if (!a) return a.status().message();
            if (!b) return b.status().message();
            return unequal(b.value(), turned(a.value()));
          });
}

TEST(Property, TrianglesMayComeInAnyOrder) {
  for_all({{"side", 1, 24}, {"triangles", 1, 30}, {"format", 0, 2}, {"seed", 0, 1000}}, 400, [](const std::vector<int>& c) -> std::string {
    VoxelGrid grid;
    grid.width = grid.height = grid.depth = c[0];
    grid.voxel = 1.0 / c[0];
    std::vector<double> points;
    for (int i = 0; i < c[1] * 9; ++i) points.push_back(random(static_cast<std::uint32_t>(i), c[3]) * 1.4 - 0.2);
    const auto volume = [&](bool backwards) -> Result<Values> {
      std::vector<std::uint32_t> indices(static_cast<std::size_t>(c[1]) * 3);
      std::iota(indices.begin(), indices.end(), 0u);
      if (backwards) std::reverse(indices.begin(), indices.end());
      VoxelMesh mesh;
      mesh.positions = points.data();
      mesh.vertices = indices.size();
      mesh.indices = indices.data();
      mesh.triangles = static_cast<std::size_t>(c[1]);
      auto made = voxel_triangles(mesh, grid);
      if (!made) return made.status();
      VoxelizeParams p = voxelize_params(grid, made.value());
      constexpr Format formats[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};
      p.format = formats[c[2]];
      auto voxels = voxelize(cpu(), p, made.value());
      if (!voxels) return voxels.status();
      return voxels.value().colour;
    };
    const auto a = volume(false), b = volume(true);
    if (!a) return a.status().message();
    if (!b) return b.status().message();
    return unequal(a.value(), b.value());
  });
}

TEST(Property, ReflectionsScaleWithTheScene) {
  for_all({{"width", 2, 48}, {"height", 2, 48}, {"variant", 0, 2}, {"power", 0, 24}, {"seed", 0, 1000}}, 400,
          [](const std::vector<int>& c) -> std::string {
            constexpr SsrVariant variants[] = {SsrVariant::hiz, SsrVariant::dda, SsrVariant::linear};
            const double size = std::ldexp(1, c[3] - 12);
            HizSsrParams p = ssr_params(c[0], c[1], variants[c[2]]), q = p;
            p.rays = q.rays = 32;
            p.thickness = 0.25;
            q.thickness = p.thickness * size;
            p.max_distance = 40;
            q.max_distance = p.max_distance * size;
            q.near_plane = p.near_plane * size;
            Values depths = height_field(c[0], c[1], static_cast<std::uint32_t>(c[4])), rays = screen_rays(p, 32, static_cast<std::uint32_t>(c[4]));
            const auto a = follow(cpu(), p, depths, rays);
            for (double& d : depths) d *= d < 1e9 ? size : 1;
            for (std::size_t i = 0; i < rays.size(); ++i) rays[i] *= i % 8 < 4 ? size : 1;
            const auto b = follow(cpu(), q, depths, rays);
            if (!a) return a.status().message();
            if (!b) return b.status().message();
            Values expected = a.value().hits;
            for (std::size_t i = 2; i < expected.size(); i += 4) expected[i] *= size;
            return unequal(b.value().hits, expected);
          });
}

}  // namespace
}  // namespace luxel::cases

// The picture from its parts: the surface's reflection against brute force, and that nothing is counted twice.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "bench/scene/compose.h"
#include "bench/scene/mesh_builder.h"
#include "bench/truth/path_truth.h"

namespace luxel::scene {
namespace {

using glm::dvec3;

constexpr double pi = std::numbers::pi;
// The table of 32 x 32 between its points, and its 1152 samples for each: largest difference seen 0.001.
constexpr double table_bound = 0.002;

// int f cos dw over the hemisphere, by midpoints in polar angles about the mirrored view, dense near it.
double mirrored(double specular, double roughness, double cosine) {
  const dvec3 view(std::sqrt(1 - cosine * cosine), 0, cosine), mirror(-view.x, 0, view.z), t(0, 1, 0),
      s = glm::cross(mirror, t);
  constexpr int steps = 600;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double w = (i + 0.5) / steps, angle = pi * w * w * w, p = 2 * pi * (j + 0.5) / steps;
      const dvec3 light = std::cos(angle) * mirror + std::sin(angle) * (std::cos(p) * t + std::sin(p) * s);
      if (light.z > 0)
        sum += ggx_reflection(dvec3(specular), roughness, {0, 0, 1}, view, light).x * light.z * std::sin(angle) * w * w;
    }
  return sum * 6 * pi * pi / (steps * steps);
}

TEST(Compose, TheMirroredShareIsTheIntegralOfTheReflection) {
  for (const double roughness : {0.2, 0.35, 0.6, 1.0})
    for (const double cosine : {0.15, 0.5, 0.9})
      for (const double specular : {0.04, 1.0})
        EXPECT_NEAR(directional_albedo(dvec3(specular), roughness, cosine).x, mirrored(specular, roughness, cosine),
                    table_bound)
            << roughness << ' ' << cosine << ' ' << specular;
}

TEST(Compose, TheReflectionIsReciprocalAndTheMirroredShareAtMostOne) {
  const dvec3 n(0, 0, 1), a = glm::normalize(dvec3(1, 0.3, 0.4)), b = glm::normalize(dvec3(-0.2, 0.5, 1));
  for (const double roughness : {0.0, 0.1, 0.5, 1.0}) {
    const double f = ggx_reflection(dvec3(0.04), roughness, n, a, b).x;
    EXPECT_NEAR(f, ggx_reflection(dvec3(0.04), roughness, n, b, a).x, 1e-12 * f);
    for (int i = 0; i <= 50; ++i) {
      const double share = directional_albedo(dvec3(1), roughness, i / 50.0).x;
      EXPECT_GE(share, 0);
      EXPECT_LE(share, 1 + 1e-12);
    }
  }
  EXPECT_EQ(ggx_reflection(dvec3(0.04), 0.5, n, a, -b), dvec3(0));
  EXPECT_EQ(directional_albedo(dvec3(0), 0.5, 0.1), dvec3(0));
}

// A white surface in a uniform environment cannot be seen, glossy or not: each light is counted once, and none is lost.
TEST(Compose, AWhiteGlossySurfaceVanishesInAUniformSky) {
  for (const double specular : {0.0, 0.04, 0.9}) {
    MeshBuilder b;
    const auto m = b.material({.base_color = dvec3(1), .roughness = 0.4, .specular = specular});
    b.block({-1, -1, -1}, {1, 1, 1}, m, 0.5);  // convex, so that one bounce is all there is
    b.scene.sky.radiance = {1, 2, 3};
    b.scene.camera = {{0, 2, 4}, {0, 0, 0}, 40};
    const auto rays = Rays::make(b.scene).value();
    const auto g = gbuffer(rays, b.scene.camera, 16, 12);
    const auto t =
        truth::path_truth(rays, truth::receivers(g, b.scene.camera.eye), {.samples = 4, .cached = false}).value();
    Lighting light;
    for (std::size_t i = 0; i < g.pixels(); ++i) {
      light.sun.push_back(t.sun.rgb(i));
      light.direct.push_back(t.emitted.rgb(i) + t.sky.rgb(i));
      light.indirect.push_back(t.indirect_all.rgb(i));
      light.glossy.push_back(t.glossy_emitted.rgb(i) + t.glossy_sky.rgb(i) + t.glossy_all.rgb(i));
      light.visibility.push_back(t.visibility.mean(i));
    }
    for (const dvec3 v : picture(compose(g, light, b.scene.camera.eye, b.scene.sun)))
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(v[c], 1 + c, 1e-6);
  }
}

TEST(Compose, EveryPartIsTheFormulaOfTheHeader) {
  GBuffer g;
  g.width = g.height = 1;
  g.position = {0, 0, 0}, g.normal = {0, 1, 0}, g.albedo = {0.5f, 0.25f, 0}, g.specular = {0, 0, 0};
  g.emission = {7, 0, 0}, g.depth = {1}, g.roughness = {1}, g.triangle = {0};
  const Lighting light{{dvec3(2)}, {dvec3(3)}, {dvec3(5)}, {dvec3(11)}, {0.25}};
  const Sun sun{glm::normalize(dvec3(1, 1, 0)), dvec3(1)};
  const Parts diffuse = compose(g, light, {0, 1, 0}, sun);
  EXPECT_EQ(diffuse.emission[0], dvec3(7, 0, 0));
  EXPECT_NEAR(diffuse.direct[0].r, 0.5 / pi * 5, 1e-12);
  EXPECT_NEAR(diffuse.diffuse_indirect[0].g, 0.25 / pi * 5, 1e-12);
  EXPECT_EQ(diffuse.specular_indirect[0], dvec3(0));
  EXPECT_EQ(diffuse.ambient_occlusion[0], 0.25);
  EXPECT_NEAR(picture(diffuse)[0].r, 7 + 0.5 / pi * 10, 1e-12);  // visibility is in no sum
  g.specular = {0.5f, 0.5f, 0.5f}, g.roughness = {0.5f};
  const Parts glossy = compose(g, light, {0, 1, 0}, sun);
  const dvec3 share = directional_albedo(dvec3(0.5), 0.5, 1),
              f = ggx_reflection(dvec3(0.5), 0.5, {0, 1, 0}, {0, 1, 0}, sun.direction);
  EXPECT_NEAR(glossy.specular_indirect[0].r, share.r * 11, 1e-12);
  EXPECT_NEAR(glossy.direct[0].r, (1 - share.r) * 0.5 / pi * 5 + f.r * 2, 1e-12);
  g.triangle = {GBuffer::no_triangle};
  EXPECT_EQ(picture(compose(g, light, {0, 1, 0}, sun))[0], dvec3(7, 0, 0));
}

TEST(Compose, DisplayIsExposureClampAndTheSrgbCurve) {
  EXPECT_EQ(display({0, 1, 5}, 0).x, 0);
  EXPECT_NEAR(display({0, 1, 5}, 0).y, 1, 1e-12);
  EXPECT_NEAR(display({0, 1, 5}, 0).z, 1, 1e-12);
  EXPECT_NEAR(display(dvec3(0.5), 0).x, 0.735357, 1e-6);
  EXPECT_NEAR(display(dvec3(0.5), -1).x, 0.537099, 1e-6);
  EXPECT_NEAR(display(dvec3(0.002), 0).x, 0.02584, 1e-9);
}

}  // namespace
}  // namespace luxel::scene

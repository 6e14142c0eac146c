// Rays through probes against rays through the scene.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "bench/truth/probe_scene.h"
#include "tests/cases/octahedral_march_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

TEST(ProbeSceneExplore, Agreement) {
  const char* text = std::getenv("EXPLORE");
  if (!text) GTEST_SKIP();
  std::istringstream in(text);
  std::string name;
  int size, n, rays_count;
  double thickness, slope, bias; int normals, tries, order;
  Context& context = test_context("opencl");
  while (in >> name >> size >> n >> rays_count >> thickness >> slope >> bias >> normals >> tries >> order) {
    auto scene = scene::scene_from(name);
    ASSERT_TRUE(scene.ok());
    auto rays = scene::Rays::make(scene.value());
    std::array<int, 3> count{n, n, n};
    if (n == 3) count = {4, 2, 4};
    auto probes = scene::place_probes(scene.value(), count);
    scene::find_dead_probes(probes, rays.value());
    int dead = 0;
    for (auto a : probes.alive) dead += a == 0;
    const auto hits = scene::cast_probes(probes, rays.value(), size);
    ProbeMaps m;
    m.size = size;
    m.distance = normals == 2 ? ProbeDistance::f32 : ProbeDistance::f16;
    m.normal = normals == 2 ? ProbeNormal::snorm16 : normals ? ProbeNormal::snorm8 : ProbeNormal::none;
    cases::TexelValues v;
    v.distance = hits.distance;
    for (double& d : v.distance) d = std::min(d, 1e30);
    v.normal = hits.normal;
    auto made = cases::ProbeScene::make(context, m, probes.grid, v, probes.positions());
    ASSERT_TRUE(made.ok()) << made.status().message();
    for (const bool surface : {true, false}) {
      const auto set = surface ? truth::surface_rays(rays.value(), rays_count, 5) : truth::open_rays(rays.value(), rays_count, 5);
      ProbeTraceParams p;
      p.maps.normal = m.normal;
      p.thickness = thickness;
      p.slope = slope;
      p.bias = bias;
      p.tries = tries;
      p.order = order ? ProbeOrder::farthest : ProbeOrder::plus3;
      auto t = made.value().trace(p, set.rays);
      ASSERT_TRUE(t.ok()) << t.status().message();
      if (std::getenv("SHOW")) {
        int shown = 0;
        for (std::size_t i = 0; i < set.size() && shown < 25; ++i) {
          if (t.value().outcome(i) != ProbeOutcome::hit) continue;
          const auto tex = (std::size_t)t.value().texels[i];
          const double D = hits.distance[tex], foot = D * 3 / size;
          if (std::fabs(t.value().t(i) - set.met[i]) < std::max(2 * foot, 0.01 * set.met[i])) continue;
          ++shown;
          const double* r = &set.rays[8 * i];
          const auto c = probes.centres[tex / size / size];
          std::printf("o %.3f %.3f %.3f d %.3f %.3f %.3f | t %.4f true %.4f D %.3f foot %.4f probe %.2f %.2f %.2f n %.2f %.2f %.2f asked %g p %.3f %.3f %.3f\n", r[0], r[1], r[2], r[4], r[5], r[6], t.value().t(i), set.met[i], D, foot, c.x, c.y, c.z,
           hits.normal[4*tex], hits.normal[4*tex+1], hits.normal[4*tex+2], t.value().hits[4*i+2], r[0]+t.value().t(i)*r[4], r[1]+t.value().t(i)*r[5], r[2]+t.value().t(i)*r[6]);
        }
      }
      const auto a = truth::agreement(set, t.value().hits, t.value().texels, hits.distance, size);
      std::printf("%s %d^2 %d probes (%d dead) th %.2g sl %.2g bias %.2g n %d tries %d o %d %s: agree %.4f right %.4f known_right %.4f median %.3f p95 %.2f rel %.5f assumed %.4f capped %.4f probes %.2f steps %.1f\n",
                  name.c_str(), size, (int)probes.size(), dead, thickness, slope, bias, normals, tries, order, surface ? "surface" : "open   ", a.agree, a.right, a.known_right, a.median, a.p95,
                  a.relative, a.unknown, a.capped, a.probes, a.steps);
    }
  }
}

}  // namespace
}  // namespace luxel

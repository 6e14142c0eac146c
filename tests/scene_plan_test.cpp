// What a scene is found to need, and what is left out of it.
#include "bench/scene/scene_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace luxel::scene {
namespace {

struct Seen {
  Scene scene;
  SceneFacts facts;
};

Seen seen(Scene scene, double cutoff = 1) {
  const auto rays = Rays::make(scene);
  EXPECT_TRUE(rays.ok());
  const GBuffer g = gbuffer(rays.value(), scene.camera, 64, 36);
  const SceneFacts facts = facts_of(scene, g, cutoff);
  return {std::move(scene), facts};
}

// Whether something of a kernel runs whose text holds `part`; it must stand in the plan.
bool runs(const std::vector<Decision>& decisions, const std::string& kernel, const std::string& part) {
  const auto found = std::find_if(decisions.begin(), decisions.end(), [&](const Decision& d) {
    return d.kernel == kernel && d.what.find(part) != std::string::npos;
  });
  EXPECT_NE(found, decisions.end()) << kernel << ": " << part;
  return found != decisions.end() && found->runs();
}

TEST(ScenePlan, EveryKernelStandsInItWithAReason) {
  const std::set<std::string> kernels{"voxelize", "mip_build", "cone_trace", "octahedral_march", "light_propagation",
                                      "bilateral", "hiz_ssr", "gaussian_blur"};
  for (const std::string_view name : built_in_names()) {
    const Seen s = seen(built_in(std::string(name)).value());
    for (const char* method : {"cone", "probe", "lpv"}) {
      std::set<std::string> found;
      for (const Decision& d : decide(s.facts, {method})) {
        found.insert(d.kernel);
        EXPECT_FALSE(d.what.empty() || d.why.empty()) << name << " " << d.kernel;
        EXPECT_GE(d.level, 0);
        EXPECT_LE(d.level, 3);
      }
      found.erase("voxel_inject");
      EXPECT_EQ(found, kernels) << name << " " << method;
    }
  }
}

TEST(ScenePlan, LightDecides) {
  Scene scene = built_in("cornell").value();
  const auto of = [](const Seen& s) { return decide(s.facts, {}); };
  EXPECT_TRUE(runs(of(seen(scene)), "voxelize", "emission"));
  EXPECT_TRUE(runs(of(seen(scene)), "voxel_inject", "shadow rays"));
  EXPECT_FALSE(runs(of(seen(scene)), "voxel_inject", "gathered"));
  scene.sky.radiance = {1, 1, 1};
  EXPECT_TRUE(runs(of(seen(scene)), "voxel_inject", "gathered")) << "a sky shines";
  EXPECT_FALSE(runs(of(seen(scene)), "voxel_inject", "shadow rays")) << "under a sky the lamp is gathered too";
  for (Material& m : scene.materials) m.emission = {0, 0, 0};
  EXPECT_FALSE(runs(of(seen(scene)), "voxelize", "emission"));
  scene.sky.radiance = {0, 0, 0};
  for (const Decision& d : of(seen(scene))) EXPECT_FALSE(d.runs()) << d.kernel << ": there is no light at all";
  scene.sun.irradiance = {1, 1, 1};
  EXPECT_TRUE(runs(of(seen(scene)), "voxel_inject", "shadow rays"));
}

TEST(ScenePlan, SurfacesDecide) {
  Scene scene = built_in("cornell").value();
  for (Material& m : scene.materials) m.specular = m.metallic = 0;
  EXPECT_FALSE(runs(decide(seen(scene).facts, {}), "hiz_ssr", ""));
  EXPECT_FALSE(runs(decide(seen(scene).facts, {}), "cone_trace", "specular"));
  for (Material& m : scene.materials) m.specular = 0.04, m.roughness = 0.5;
  const Seen glossy = seen(scene, 0.6), rough = seen(scene, 0.4);
  EXPECT_NEAR(glossy.facts.mirrors, glossy.facts.seen, 1e-12);
  EXPECT_EQ(rough.facts.mirrors, 0);
  EXPECT_TRUE(runs(decide(glossy.facts, {}), "hiz_ssr", "rays"));
  EXPECT_FALSE(runs(decide(rough.facts, {}), "hiz_ssr", "rays")) << "too rough for the screen";
  EXPECT_TRUE(runs(decide(rough.facts, {}), "cone_trace", "specular"));
  EXPECT_FALSE(runs(decide(glossy.facts, {"cone", true, false}), "cone_trace", "specular")) << "not asked for";
  EXPECT_FALSE(runs(decide(glossy.facts, {"cone", false, true}), "cone_trace", "occlusion")) << "not asked for";
}

TEST(ScenePlan, GreyIsFound) {
  EXPECT_TRUE(seen(built_in("furnace").value()).facts.grey);
  EXPECT_FALSE(seen(built_in("cornell").value()).facts.grey);
  Scene scene = built_in("furnace").value();
  scene.sun = {{0, 1, 0}, {1, 1, 0.5}};
  EXPECT_FALSE(seen(scene).facts.grey) << "a coloured sun";
}

}  // namespace
}  // namespace luxel::scene

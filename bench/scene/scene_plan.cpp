#include "bench/scene/scene_plan.h"

#include <set>

#include <fmt/format.h>

#include "bench/scene/voxel_scene.h"

namespace luxel::scene {
namespace {

using glm::dvec3;

// Emitting triangles that shadow rays still reach.
const std::size_t lamp_limit = static_cast<std::size_t>(VoxelSceneSettings().lamp_pieces);
constexpr int tile = 8;                 // pixels along each side of hiz_ssr's tiles

bool is_grey(dvec3 c) { return c.x == c.y && c.y == c.z; }

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

struct List {
  std::vector<Decision> all;
  void run(const char* kernel, std::string what, std::string why) {
    all.push_back({kernel, std::move(what), std::move(why), 0});
  }
  void leave(int level, const char* kernel, std::string what, std::string why) {
    all.push_back({kernel, std::move(what), std::move(why), level});
  }
  // One or the other.
  void add(bool runs, int level, const char* kernel, const std::string& what, const std::string& why, const std::string& why_not) {
    all.push_back({kernel, what, runs ? why : why_not, runs ? 0 : level});
  }
};

void voxels(List& list, const SceneFacts& f) {
  list.run("voxelize", "colour and normal, exact means", fmt::format("{} triangles", f.triangles));
  list.add(f.textured, 1, "voxelize", "textures: uvs, texels, table", "materials have textures", "no material has a texture");
  list.add(f.emitters > 0, 1, "voxelize", "emission: a volume, three sums a voxel", fmt::format("{} triangles emit", f.emitters),
           "nothing emits");
  list.add(f.cut_out, 1, "voxelize", "cut-out and opacity", "materials have holes", "every surface is whole");
  list.leave(2, "voxelize", "accumulators of bricks that nothing touches", "only touched bricks are listed, summed and resolved");
  list.add(f.sun || f.lamps, 3, "voxel_inject", "lights with shadow rays through voxels",
           f.sun ? "there is a sun" : "the emitters are few enough to be lamps", "no sun, and no emitters few enough to be lamps");
  const bool gathered = f.sky || (f.emitters > 0 && !f.lamps);
  list.add(gathered, 3, "voxel_inject", "light gathered by cones of voxels, and the volumes they read",
           f.sky ? "there is a sky" : "emitters are too many to be lamps", "no sky, and no emitters that are not lamps");
}

void cones(List& list, const SceneFacts& f, const PlanWish& wish) {
  voxels(list, f);
  list.run("mip_build", "isotropic levels of reflected light", "cones read them");
  list.run("cone_trace", "diffuse cones", "reflected light at every pixel with a surface");
  list.add(wish.occlusion, 1, "cone_trace", "occlusion", "asked for", "not asked for");
  list.add(f.sky_image, 1, "cone_trace", "a sky with directions", "the sky is an image", f.sky ? "the sky is even" : "there is no sky");
  const bool gloss = wish.reflections && f.glossy > 0;
  list.add(gloss, 3, "cone_trace", "specular cones, and their view directions", percent(f.glossy) + " of the pixels reflect",
           wish.reflections ? "no pixel reflects" : "reflections are not asked for");
  list.leave(2, "cone_trace", "the finer of two levels where the coarser is empty", "it could add nothing");
}

void screen(List& list, const SceneFacts& f, const PlanWish& wish) {
  const bool runs = wish.reflections && f.mirrors > 0;
  const std::string why_not = !wish.reflections ? "reflections are not asked for"
                              : f.glossy > 0    ? "every reflecting pixel is too rough"
                                                : "no pixel reflects";
  list.add(runs, 3, "mip_build", "pyramid of nearest depths, pyramid of colour", "rays on the screen walk over them", why_not);
  list.add(runs, 3, "hiz_ssr", "rays and resolve", percent(f.mirrors) + " of the pixels are smooth enough", why_not);
  if (runs)
    list.leave(2, "hiz_ssr", percent(1 - f.glossy_tiles) + " of the tiles", "no pixel of theirs reflects");
  list.add(runs, 3, "bilateral", "denoising of rays drawn from lobes", "stochastic rays are noisy", "nothing is noisy: " + why_not);
}

}  // namespace

SceneFacts facts_of(const Scene& scene, const GBuffer& g, double cutoff) {
  SceneFacts f;
  f.triangles = scene.indices.size();
  f.sun = scene.sun.irradiance != dvec3(0);
  f.sky = !scene.sky.dark();
  f.sky_image = f.sky && !scene.sky.image.empty();
  std::set<std::uint32_t> used;
  for (std::size_t i = 0; i < scene.indices.size(); ++i) {
    if (!finite(scene, i)) continue;
    used.insert(scene.triangle_materials[i]);
    f.emitters += scene.material_of(i).emission != dvec3(0);
  }
  f.lamps = f.emitters > 0 && !f.sky && f.emitters <= lamp_limit;
  f.grey = is_grey(scene.sun.irradiance) && is_grey(scene.sky.radiance) && !f.sky_image;
  for (const std::uint32_t k : used) {
    const Material& m = scene.materials[k];
    f.textured = f.textured || m.texture >= 0;
    f.cut_out = f.cut_out || m.alpha_mode != AlphaMode::opaque;
    f.grey = f.grey && m.texture < 0 && is_grey(m.base_color) && is_grey(m.emission);
  }
  const Bounds box = bounds(scene);
  f.diagonal = glm::length(box.high - box.low);

  const int tiles_x = (g.width + tile - 1) / tile, tiles_y = (g.height + tile - 1) / tile;
  std::vector<char> tiles(static_cast<std::size_t>(tiles_x) * static_cast<std::size_t>(tiles_y), 0);
  const double share = 1 / static_cast<double>(g.pixels());
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    if (!g.surface_at(i)) continue;
    f.seen += share;
    if (g.at(g.specular, i) == dvec3(0)) continue;
    f.glossy += share;
    if (!(g.roughness[i] < cutoff)) continue;
    f.mirrors += share;
    const std::size_t x = i % static_cast<std::size_t>(g.width), y = i / static_cast<std::size_t>(g.width);
    tiles[y / tile * static_cast<std::size_t>(tiles_x) + x / tile] = 1;
  }
  for (const char t : tiles) f.glossy_tiles += t / static_cast<double>(tiles.size());
  return f;
}

std::vector<std::string> lines_of(const SceneFacts& f) {
  return {fmt::format("{} triangles, {} of them emit{}", f.triangles, f.emitters, f.lamps ? " (lamps)" : ""),
          fmt::format("sun: {}; sky: {}", f.sun ? "yes" : "none", f.sky_image ? "an image" : f.sky ? "even" : "none"),
          fmt::format("textures: {}; holes: {}; colour: {}", f.textured ? "yes" : "none", f.cut_out ? "yes" : "none",
                      f.grey ? "grey alone" : "yes"),
          fmt::format("pixels with a surface {}, that reflect {}, smooth enough for the screen {} (in {} of the tiles)",
                      percent(f.seen), percent(f.glossy), percent(f.mirrors), percent(f.glossy_tiles))};
}

std::vector<Decision> decide(const SceneFacts& f, const PlanWish& wish) {
  List list;
  const bool dark = !f.sun && !f.sky && f.emitters == 0;
  const bool lit = !dark && f.triangles > 0;
  const char* none = dark ? "no sun, no sky, nothing emits: there is no light to carry" : "there is no triangle";
  if (!lit) {
    for (const char* kernel : {"voxelize", "voxel_inject", "mip_build", "cone_trace", "octahedral_march", "light_propagation",
                               "hiz_ssr", "bilateral"})
      list.leave(3, kernel, "all of it", none);
  } else {
    const bool cone = wish.method == "cone", probe = wish.method == "probe", lpv = wish.method == "lpv";
    const std::string other = fmt::format("light is carried by {}", cone ? "cones" : probe ? "probes" : "propagation");
    if (cone) {
      cones(list, f, wish);
    } else {
      for (const char* kernel : {"voxelize", "voxel_inject", "cone_trace"}) list.leave(3, kernel, "all of it", other);
    }
    if (probe) {
      list.run("octahedral_march", "probe_build, probe_irradiance, probe_moments, probe_shade", "asked for");
      list.leave(1, "octahedral_march", "distances and normals of radiance probes", "filtered visibility reads moments alone");
      list.leave(2, "octahedral_march", "probes inside geometry", "they are found while building and weigh nothing");
    } else {
      list.leave(3, "octahedral_march", "all of it", other);
    }
    if (lpv) {
      list.run("light_propagation", "inject, propagate, sample", "asked for");
      list.add(!f.grey, 1, "light_propagation", "two of three channels", "light or surfaces have colour", "all light is grey");
      list.leave(2, "light_propagation", "cells that no light has reached", "runs of cells without lit neighbours are skipped");
    } else {
      list.leave(3, "light_propagation", "all of it", other);
    }
    screen(list, f, wish);
  }
  list.leave(3, "gaussian_blur", "all of it", "no bloom and no blur is asked for");
  return list.all;
}

}  // namespace luxel::scene

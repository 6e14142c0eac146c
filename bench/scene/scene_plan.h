// What a scene needs of the kernels, as one camera sees it: which run, in which form, and why each other does not.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "bench/scene/gbuffer.h"

namespace luxel::scene {

/// What decides.
struct SceneFacts {
  std::size_t triangles = 0, emitters = 0;  // emitters: triangles that emit
  bool sun = false, sky = false, sky_image = false;
  bool lamps = false;                   // emitters are few and no sky shines: shadow rays reach them
  bool textured = false, cut_out = false;
  bool grey = false;                    // every light and every surface is grey: one channel stands for three
  double seen = 0;                      // part of the pixels that show a surface
  double glossy = 0;                    // part of the pixels that reflect a lobe
  double mirrors = 0;                   // part of the pixels smooth enough for reflections found on the screen
  double glossy_tiles = 0;              // part of the 8x8 tiles that hold such a pixel
  double diagonal = 0;                  // scene units
};

/// `cutoff`: roughness from which on a pixel's reflection is not looked for on the screen.
SceneFacts facts_of(const Scene& scene, const GBuffer& gbuffer, double cutoff);

/// Facts as a line each, for people.
std::vector<std::string> lines_of(const SceneFacts& facts);

/// How light is to be carried, and what is asked for.
struct PlanWish {
  std::string method = "cone";  // cone, probe or lpv
  bool occlusion = true;        // ambient occlusion is used
  bool reflections = true;      // reflections are used
};

/// Level: 1 code and bindings, 2 work, 3 kernels; 0: it runs.
struct Decision {
  std::string kernel, what, why;
  int level = 0;
  bool runs() const { return level == 0; }
};

/// Every kernel stands in it at least once, in the order in which they run.
std::vector<Decision> decide(const SceneFacts& facts, const PlanWish& wish);

}  // namespace luxel::scene

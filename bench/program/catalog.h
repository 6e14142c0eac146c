// What `luxel` can be told about each kernel: variants, options (a choice of names or a switch) and knobs (numbers).
// The command line, `luxel list` and the report read their ranges and defaults from here.
#pragma once
#include <string_view>
#include <vector>

namespace luxel::program {

struct Variant {
  std::string_view name;
  std::string_view meaning;
};

struct Option {
  std::string_view name;                   // as on the command line: "--border"
  std::vector<std::string_view> choices;   // empty: a switch, off by default
  std::string_view fallback;               // the default
  std::string_view meaning;
};

struct Knob {
  std::string_view name;      // as on the command line: "--sigma"
  double least = 0;           // the range, both ends included
  double most = 0;
  bool integer = false;
  std::string_view fallback;  // the default; empty: must be given
  std::string_view unit;      // empty: a plain number
  std::string_view meaning;
};

struct Kernel {
  std::string_view name;
  std::string_view meaning;
  std::vector<Variant> variants;  // the first is the default
  std::vector<Option> options;
  std::vector<Knob> knobs;
};

/// Kernels of the program, in the order in which they are listed.
inline const std::vector<Kernel>& catalog() {
  static const std::vector<Kernel> kernels{
      {"gaussian_blur",
       "Gaussian blur of an image",
       {{"separable", "a pass along rows, a pass along columns: 2(2R+1) taps a pixel"},
        {"direct", "one pass of (2R+1)^2 taps a pixel, R up to 96: the baseline"},
        {"sampler", "separable, two texels a tap through the linear sampler; borders clamp and wrap"},
        {"recursive", "poles, forward and backward along each axis: the same cost for every sigma"},
        {"box", "repeated boxes of fractional width: the same cost for every sigma"},
        {"pyramid", "blurred at a coarser level of the image: the larger sigma, the fewer pixels"}},
       {{"--border",
         {"clamp", "mirror", "wrap", "zero"},
         "clamp",
         "pixels outside: the nearest edge pixel, reflected (edge not repeated), repeated, or none (weights "
         "renormalised)"},
        {"--format",
         {"f32", "f16", "unorm8"},
         "f32",
         "how the device stores pixels; f16 and unorm8 take four channels"},
        {"--input", {"buffer", "image"}, "buffer", "how the source is bound; variant sampler always takes an image"},
        {"--filter",
         {"linear", "cubic"},
         "linear",
         "pyramid: 4 taps down and linear interpolation up, or 6 taps and a cubic B-spline"},
        {"--difference", {}, "off", "x + sum of w (x_t - x): a constant image stays constant to the bit"},
        {"--keep-alpha", {}, "off", "copy the fourth channel instead of filtering it"},
        {"--drop-taps", {}, "off", "leave out outer taps that sum to less than half a step of f16 or unorm8"}},
       {{"--sigma", 0, 10000, false, "", "pixels", "standard deviation"},
        {"--radius", 0, 4095, true, "ceil(3 sigma)", "pixels", "taps on each side"},
        {"--order", 3, 5, true, "5", "", "recursive: poles of a direction"},
        {"--passes", 1, 5, true, "3", "", "box: boxes one after another"},
        {"--levels", -1, 12, true, "-1", "", "pyramid: levels that halve the image, as far as sigma allows; -1: chosen by sigma"}}},
      {"bilateral",
       "edge-preserving filters of an image, guided by colour, depth, normals, luminance",
       {{"direct", "every tap of the window: (2R/step + 1)^2 taps a pixel"},
        {"separable", "rows, then columns: an approximation of direct"},
        {"atrous", "levels of 25 (or 9) taps whose distance doubles"},
        {"grid", "bilateral grid by luminance: the same cost for every sigma; cells of sigma-space pixels"},
        {"discontinuity", "a Gaussian that stops at edges of depth and normals; needs --depth"}},
       {{"--range", {"self", "guide", "off"}, "self", "differences of colour that weigh: of the image, of --guide, none"},
        {"--range-norm", {"l2", "l1"}, "l2", "distance of colours: square root of the sum of squares, or sum of absolute differences"},
        {"--window", {"square", "circle"}, "square", "direct: which taps of the square of radius R count"},
        {"--adaptive", {}, "off", "separable: the outer half of the window in pairs of averaged pixels"},
        {"--taps", {"5", "3"}, "5", "atrous: taps of a level along an axis"},
        {"--depth-term", {"plane", "svgf"}, "plane", "with --depth: distance from the plane through the pixel, or depth over its gradient"},
        {"--border",
         {"clamp", "mirror", "wrap", "zero"},
         "clamp",
         "pixels outside: the nearest edge pixel, reflected (edge not repeated), repeated, or none"},
        {"--format", {"f32", "f16", "unorm8"}, "f32", "how the device stores pixels; f16 and unorm8 take four channels"},
        {"--alpha", {}, "off", "filter the fourth channel too, as a part of colour; else it is copied"}},
       {{"--sigma-space", 0, 1e30, false, "3", "pixels", "standard deviation of the spatial weight"},
        {"--radius", 0, 1024, true, "ceil(3 sigma)", "pixels", "taps on each side; 96 at most but for separable"},
        {"--step", 1, 16, true, "1", "pixels", "from tap to tap"},
        {"--levels", 1, 6, true, "5", "", "of atrous"},
        {"--sigma-range", 0, 1e30, false, "0.1", "of the image's unit", "standard deviation of the colour weight"},
        {"--sigma-depth", 1e-6, 1e6, false, "1", "footprints (svgf: gradients)", "tolerance of depth for each pixel of distance"},
        {"--footprint", 1e-9, 1e3, false, "0.001", "scene units", "width of a pixel at depth 1: 2 tan(fov/2) / height"},
        {"--sigma-normal", 0.01, 4096, false, "128", "", "power of the cosine between normals"},
        {"--sigma-luminance", 1e-6, 1e6, false, "4", "standard deviations", "with --variance"},
        {"--variance-target", 0, 1e30, false, "0", "luminance squared", "with --variance: pixels below it stay as they are"},
        {"--flat", 0, 0.5, false, "0", "part of a weight", "direct: tiles whose weights are surely 1 less this are blurred by space alone"},
        {"--low", -1e30, 1e30, false, "0", "luminance", "grid: of the first cell; what is below counts as there"},
        {"--high", -1e30, 1e30, false, "1", "luminance", "grid: of the last cell"},
        {"--depth-threshold", 0, 1, false, "0.02", "parts of depth", "discontinuity: off both sides' planes, an edge"},
        {"--normal-threshold", -1, 1, false, "0.9", "cosine", "discontinuity: below, an edge"}}},
      {"mip_build",
       "coarser levels of an image or a volume",
       {{"isotropic", "mean of 2x2 or 2x2x2 texels of premultiplied colour and opacity"},
        {"anisotropic",
         "six directional volumes: pairs composited front to back, then the mean of four; four channels"},
        {"gaussian3", "1-3-3-1 along each axis (samples on vertices: 1-2-1)"},
        {"min", "lower bound of an image of one channel"},
        {"max", "upper bound of an image of one channel"},
        {"minmax", "both bounds, in two channels, of one channel or of such pairs"},
        {"moments", "mean and standard deviation, in two channels, of one channel or of such pairs"}},
       {{"--format",
         {"f32", "f16", "unorm8"},
         "f32",
         "how the device stores levels: min and max f32; minmax and moments f32 or f16; f16 and unorm8 of the others "
         "take four channels"},
        {"--sizes",
         {"floor", "ceil"},
         "floor",
         "min, max, minmax: odd sizes round down (the last texel covers three) or up"},
        {"--ratio", {"2", "16"}, "2", "min, max, minmax: texels of an axis in a coarser one; 16 makes one level"},
        {"--samples",
         {"cells", "vertices"},
         "cells",
         "gaussian3: samples in the centres of cells, or on vertices (odd extents)"},
        {"--directions",
         {"px", "nx", "py", "ny", "pz", "nz"},
         "all",
         "anisotropic: which volumes are made, as px,ny; px is seen looking along +x"},
        {"--input", {"buffer", "image"}, "buffer", "how the finest level is bound"}},
       {{"--levels", 0, 16, true, "0", "", "coarser levels that are made; 0: until every extent is 1"}}},
      {"hiz_ssr",
       "reflections found on the screen, by rays over a depth image",
       {{"hiz", "a pyramid of nearest depths: up a level where nothing is near, down where something may be"},
        {"dda", "every pixel along the ray"},
        {"linear", "uniform steps in view space and a binary search: misses what lies between"},
        {"stochastic", "directions of the GGX lobe, hits shared with the pixels around"}},
       {{"--depth-convention",
         {"linear", "standard", "reversed"},
         "linear",
         "distance along the view axis; 0 near to 1 far; 1 near to 0 far"},
        {"--half-resolution", {}, "off", "stochastic: one pixel of 2x2 is traced"}},
       {{"--thickness", 0, 1e30, false, "0", "scene units", "of surfaces along the view axis; 0: infinite"},
        {"--max-distance", 0, 1e18, false, "0", "scene units", "length of rays; 0: without end (linear: must be given)"},
        {"--near", 1e-6, 1e9, false, "0.01", "scene units", "near plane, where rays towards the camera end"},
        {"--far", 0, 1e30, false, "0", "scene units", "far plane of standard and reversed depth; 0: infinite"},
        {"--fov", 0.01, 179.9, false, "60", "degrees", "vertical field"},
        {"--even-roughness", 0, 2, false, "0", "", "of every pixel, where there is no file"},
        {"--cutoff", 0, 2, false, "1", "", "roughness from which on pixels do not reflect"},
        {"--bias", 0, 64, false, "0.5", "pixels", "of the surface's slope that rays start in front of it"},
        {"--levels", 0, 17, true, "0", "", "of the pyramid, level 0 counts; 0: all"},
        {"--start-level", 0, 16, true, "0", "", "that rays start on"},
        {"--max-steps", 0, 16777216, true, "0", "", "looks at the depth image a ray; 0: as many as needed"},
        {"--steps", 1, 65536, true, "64", "", "linear: along a ray"},
        {"--refinements", 0, 24, true, "6", "", "linear: halvings of a step"},
        {"--rays", 1, 4, true, "1", "", "stochastic: a pixel"},
        {"--reuse", 0, 4, true, "1", "pixels", "stochastic: around one whose rays it takes"},
        {"--seed", 0, 16777215, true, "0", "", "stochastic: another for every frame"},
        {"--prefilter", 0, 16, false, "1", "", "width of the colour that is looked up, in that of the lobe's part of a ray"},
        {"--fade-edge", 0, 0.5, false, "0.05", "of the image's side", "confidence falls towards the edge"},
        {"--fade-distance", 0, 1, false, "0", "of --max-distance", "and towards the end of a ray"},
        {"--fade-thickness", 0, 1, false, "0", "", "and towards the back of a surface"},
        {"--fade-back", 0, 1, false, "1", "", "and on surfaces that look away"}}},
      {"cone_trace",
       "irradiance, ambient occlusion and glossy radiance from voxels by cones",
       {{"isotropic", "coarse voxels are means; their opacity keeps the finest voxel as its length"},
        {"anisotropic", "six directional volumes a coarse level, with opacities of their own voxel's length"}},
       {{"--format", {"f32", "f16", "unorm8"}, "f32", "how the device stores the volumes"},
        {"--cones",
         {"1", "4", "5", "6", "8", "9", "16", "25", "classic"},
         "6",
         "how many cones, with the moments of the cosine; classic: the usual six of 60 degrees"}},
       {{"--voxel", 1e-30, 1e30, false, "1", "scene units", "side of a finest voxel"},
        {"--aperture", 0, 148, false, "0", "degrees", "full angle of the cones; 0: the set's own"},
        {"--levels", 0, 12, true, "0", "", "levels that are read, the finest counts; 0: all"},
        {"--footprint", 0.0625, 1, false, "0.25", "diameters of the cone", "width of the voxels that are looked up"},
        {"--step-scale", 0.0625, 4, false, "1", "", "step along the axis, in such voxels"},
        {"--normal-offset", 0, 64, false, "1", "voxels", "cones start this far above the surface"},
        {"--start", 0, 64, false, "0", "voxels", "and gather from here on along the axis"},
        {"--max-distance", 0, 1e30, false, "0", "scene units", "and up to here; 0: until they leave the volume"},
        {"--gamma", 0, 1e30, false, "0", "per scene unit", "occlusion at distance r counts 1 / (1 + gamma r)"},
        {"--error", 0, 1e30, false, "0", "", "a cone ends once at most this part of light passes"},
        {"--pattern-x", 1, 64, true, "1", "", "neighbouring receivers of a row that the cones are dealt to"},
        {"--pattern-y", 1, 64, true, "1", "", "rows of them"}}},
      {"voxelize",
       "triangle meshes into voxels: base colour and coverage",
       {{"conservative", "a voxel is touched where its closed box meets the triangle: 26-separating"},
        {"thin", "where a segment that joins the centres of opposite faces meets it: 6-separating"},
        {"dilated", "the triangle moved outwards by half a pixel: covers too much at acute corners; for comparison"}},
       {{"--mode", {"conservative", "thin", "dilated"}, "conservative", "which variant"},
        {"--merging",
         {"exact", "moving_average", "last_write"},
         "exact",
         "how triangles share a voxel: area-weighted means in integers, a mean in 8 bits, or whichever comes last; the "
         "last two depend on timing"},
        {"--format", {"f32", "f16", "unorm8"}, "f32", "how the device stores the volume"}},
       {{"--resolution", 1, 2048, true, "", "voxels", "along each side of the cube"},
        {"--voxel", 1e-300, 1e300, false, "the bounding cube by the resolution", "scene units", "side of a voxel, with --origin"}}},
      {"octahedral_march",
       "probes that hold radiance, normal and distance of all directions, and rays through them",
       {{"two_level", "a map of least distances first, texels where something may be near"},
        {"flat", "every texel along the ray: the same answers to the bit"}},
       {{"--order", {"plus3", "farthest"}, "plus3", "in which a cage's probes are asked: corner (i + 3) mod 8, or the farthest that is left"},
        {"--map", {"radiance", "distance", "normal"}, "radiance", "which map is shown"},
        {"--light",
         {"reflected", "all", "none"},
         "reflected",
         "radiance from scenes: of surfaces in the light of sun and lamps; and what emits, and the sky; no map of it"},
        {"--keep-dead", {}, "off", "scenes: probes that see mostly backs count as well"},
        {"--cube", {}, "off", "images: six faces a probe, laid out as OpenGL and Vulkan do"},
        {"--planar", {}, "off", "cubes: distances are depths along the face's axis"},
        {"--no-normals", {}, "off", "normals are not read; take --thickness 2 --bias 2 then"}},
       {{"--resolution", 16, 2048, true, "256", "texels", "along each side of a probe's map, an even number"},
        {"--jitter", 0, 1, false, "0", "of half a cell", "by which probes are moved at random"},
        {"--seed", 0, 16777215, true, "1", "", "of the jitter"},
        {"--samples", 1, 16, true, "1", "", "radiance: directions along each axis of a texel"},
        {"--probe", 0, 65535, true, "0", "", "whose map is shown"},
        {"--only", -1, 65535, true, "-1", "", "the only probe that is asked; -1: those of the cages that a ray comes through"},
        {"--tries", 1, 24, true, "8", "", "probes asked in a cage"},
        {"--thickness", 0.125, 64, false, "0.5", "texel footprints", "of what is seen"},
        {"--slope", 0, 64, false, "8", "", "the largest slope of a surface that counts"},
        {"--bias", 0, 64, false, "0", "texel footprints", "nothing is hit nearer to a ray's beginning; rays off surfaces: 1"},
        {"--max-steps", 0, 16777216, true, "0", "", "looks at maps a ray; 0: as many as needed"}}},
  };
  return kernels;
}

/// The kernel of that name, which must be in the catalog.
inline const Kernel& kernel(std::string_view name) {
  for (const Kernel& k : catalog())
    if (k.name == name) return k;
  return catalog().front();
}

}  // namespace luxel::program

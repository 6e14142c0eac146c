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
        {"sampler", "separable, two texels a tap through the linear sampler; borders clamp and wrap"}},
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
        {"--difference", {}, "off", "x + sum of w (x_t - x): a constant image stays constant to the bit"},
        {"--keep-alpha", {}, "off", "copy the fourth channel instead of filtering it"},
        {"--drop-taps", {}, "off", "leave out outer taps that sum to less than half a step of f16 or unorm8"}},
       {{"--sigma", 0, 10000, false, "", "pixels", "standard deviation"},
        {"--radius", 0, 4095, true, "ceil(3 sigma)", "pixels", "taps on each side"}}},
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

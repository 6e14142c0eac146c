// The parts of gaussian_blur's host code: variants without taps add their passes to the plan.
#pragma once
#include <luxel/gaussian_blur.h>

#include "host/planner.h"

namespace luxel {

/// Pixels that a pass reads or writes.
struct Pixels {
  Slot slot;
  Format format;
  int stride;          // pixels from row to row
  bool image = false;  // bound as a sampled image
};

/// The module that reads one and writes the other.
std::string module_of(const Pixels& from, const Pixels& to, const Profile& profile);

/// f32 of as many channels.
Format f32_of(Format format);

/// Adds the passes from `from` to `to`. Sigma is above 0, and so large that a neighbour has a normal float weight.
void plan_recursive(const GaussianBlurParams& params, const Profile& profile, Planner& planner, const Pixels& from,
                    const Pixels& to);
void plan_box(const GaussianBlurParams& params, const Profile& profile, Planner& planner, const Pixels& from,
              const Pixels& to);

/// Values of the largest scratch region that these ask for.
double recursive_scratch(const GaussianBlurParams& params);
double box_scratch(const GaussianBlurParams& params);

}  // namespace luxel

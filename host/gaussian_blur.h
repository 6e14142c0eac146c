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
  Input input = Input::buffer;
};

/// The module that reads one and writes the other.
std::string module_of(const Pixels& from, const Pixels& to, const Profile& profile);

/// f32 of as many channels.
Format f32_of(Format format);

/// Adds the separable passes: a copy where the radius is 0.
void plan_separable(const GaussianBlurParams& params, const Profile& profile, Planner& planner, const Pixels& from,
                    const Pixels& to);

/// Adds the passes from `from` to `to`. Sigma is above 0, and so large that a neighbour has a normal float weight.
void plan_recursive(const GaussianBlurParams& params, const Profile& profile, Planner& planner, const Pixels& from,
                    const Pixels& to);
void plan_pyramid(const GaussianBlurParams& params, const Profile& profile, Planner& planner, const Pixels& from,
                  const Pixels& to);
void plan_box(const GaussianBlurParams& params, const Profile& profile, Planner& planner, const Pixels& from,
              const Pixels& to);

/// Values of the largest scratch region that these ask for.
double recursive_scratch(const GaussianBlurParams& params);
double box_scratch(const GaussianBlurParams& params);
double pyramid_scratch(const GaussianBlurParams& params);

/// Levels of `pyramid`: so many that the coarsest level's blur fits a table of weights, and as many as leave it a variance.
int least_levels(const GaussianBlurParams& params);
int most_levels(const GaussianBlurParams& params);

}  // namespace luxel

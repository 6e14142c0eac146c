// What is run while an API fails call after call, and what must hold then.
#pragma once
#include <luxel/gaussian_blur.h>
#include <luxel/light_propagation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "tests/support/faults.h"
#include "tests/support/run.h"

namespace luxel::faults {

struct Scenario {
  Plan plan;
  NamedBytes inputs;
  std::string output;
};

/// Images, a sampler, tables and timestamps.
inline Scenario sampled_blur(const Profile& profile) {
  GaussianBlurParams p;
  p.width = 9, p.height = 7, p.sigma = 1.5, p.variant = GaussianVariant::sampler, p.input = Input::image;
  std::vector<float> image(4 * 63);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = static_cast<float>(i % 13) / 8;
  return {plan(p, profile).value(), {{"src", bytes_of(image)}}, "dst"};
}

/// Passes whose workgroups are counted on the device.
inline Scenario counted_steps(const Profile& profile) {
  LpvPropagateParams p;
  p.grid.extent = {6, 5, 4}, p.channels = 1, p.iterations = 3, p.active = true;
  std::vector<float> light(lpv_pixels(p.grid, 2, 1) * 4, 0.0f);
  light[4 * 50] = 1;
  return {plan(p, profile).value(), {{"injected", bytes_of(light)}}, "result"};
}

/// Memory, a program, a run with times, and its result: what a user does with a device.
inline Result<Bytes> through(Context& context, const Scenario& s) {
  std::vector<Named> bound;
  std::shared_ptr<Memory> output;
  std::size_t bytes = 0;
  for (const Resource& resource : s.plan.resources) {
    Result<std::shared_ptr<Memory>> made = context.make(resource, resource.bytes);
    if (!made) return made.status();
    bound.push_back({resource.name, made.value()});
    for (const auto& [name, input] : s.inputs)
      if (name == resource.name)
        if (const Status status = context.upload(*made.value(), input.data(), input.size()); !status) return status;
    if (resource.name != s.output) continue;
    output = made.value();
    bytes = bytes_per_pixel(resource.format);
    for (const int n : resource.extent) bytes *= static_cast<std::size_t>(n);
    if (resource.kind == ResourceKind::buffer) bytes = resource.bytes;
  }
  Result<std::shared_ptr<Program>> program = context.compile(s.plan);
  if (!program) return program.status();
  Times times;
  if (const Status status = context.run(*program.value(), bound, &times); !status) return status;
  Bytes result(bytes);
  if (const Status status = context.download(*output, result.data(), result.size()); !status) return status;
  return result;
}

struct Outcome {
  std::set<std::string> refused, survived;  // functions whose failure was reported, and those whose failure changed nothing
};

/// Opens a device and goes through the scenario, with the first, then the second, ... call failing, until none does. Expects
/// `code` (missing_driver too where one of `opening` fails), nothing left over, and a device that still works unless it is lost.
inline Outcome every_call(const std::function<Result<std::shared_ptr<Context>>()>& open,
                          const std::function<Scenario(const Profile&)>& scenario, int fault, Code code,
                          const std::set<std::string>& opening) {
  Outcome outcome;
  Bytes right;
  alive.clear();
  for (int call = -1;; ++call) {  // -1: none fails
    arm(call, fault);
    {
      const Result<std::shared_ptr<Context>> context = open();
      Status status = context.status();
      if (context) {
        const Scenario s = scenario(context.value()->profile());
        const Result<Bytes> result = through(*context.value(), s);
        status = result.status();
        disarm();
        if (result && right.empty()) right = result.value();
        if (result) {
          EXPECT_EQ(result.value(), right) << struck;
        }
        if (code != Code::device_lost) {
          const Result<Bytes> again = through(*context.value(), s);
          EXPECT_TRUE(again.ok() && again.value() == right) << "after " << struck << ": " << again.status().message();
        }
      }
      disarm();
      if (!struck.empty()) (status.ok() ? outcome.survived : outcome.refused).insert(struck);
      if (!status.ok()) {
        EXPECT_TRUE(status.code() == code || (opening.count(struck) && status.code() == Code::missing_driver))
            << struck << " gave " << name(status.code()) << ": " << status.message();
      }
      EXPECT_TRUE(!status.ok() || !right.empty());
    }
    EXPECT_EQ(leaked(), "") << "after " << struck;
    if (call >= 0 && struck.empty()) return outcome;
    if (right.empty() || call > 1000) {
      ADD_FAILURE() << "the scenario does not pass";
      return outcome;
    }
  }
}

}  // namespace luxel::faults

// Probes on a device, built by probe_build, and rays traced through them: what tests, cases, the report and the program share.
#pragma once
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <luxel/device.h>
#include <luxel/probe_build.h>
#include <luxel/probe_trace.h>

#include "bench/truth/probe_truth.h"
#include "tests/cases/case.h"

namespace luxel::cases {

using Values = std::vector<double>;

/// A compiled plan with its memory, some of it shared with others.
class HeldPlan {
 public:
  /// `shared`: names and memory that are bound as they are; all other resources get memory of their own.
  static Result<HeldPlan> make(Context& context, const Result<Plan>& plan, const std::vector<Named>& shared = {});
  Status write(std::string_view name, std::span<const double> values);
  Result<Values> read(std::string_view name) const;
  Result<std::vector<std::byte>> bytes(std::string_view name) const;
  Status go(int repeat = 1, Times* times = nullptr);
  std::shared_ptr<Memory> memory(std::string_view name) const;
  const Plan& plan() const { return plan_; }
  std::size_t memory_bytes() const;
  /// Releases all but what the plan writes.
  void keep_outputs();

 private:
  std::size_t index(std::string_view name) const;
  Context* context_ = nullptr;
  Plan plan_;
  std::shared_ptr<Program> program_;
  std::vector<std::shared_ptr<Memory>> memory_;
};

/// A ray: origin, begin, direction, reach.
struct Ray {
  std::array<double, 3> origin{0, 0, 0}, direction{0, 0, 1};
  double reach = 1e30, begin = 0;
};
/// As the buffer `rays` has them.
Values ray_values(const std::vector<Ray>& rays);

struct Traced {
  Values hits;      // 4 a ray
  Values texels;    // 1 a ray
  Values counters;  // probe_outcomes, where counted
  ProbeOutcome outcome(std::size_t i) const { return static_cast<ProbeOutcome>(static_cast<int>(hits[4 * i + 1])); }
  double t(std::size_t i) const { return hits[4 * i]; }
};

/// What the texels of probes hold before they are stored: distance 1, normal and radiance 4 a texel (either may be empty).
struct TexelValues {
  Values distance, normal, radiance;
};

/// From a function of probe and unit direction that gives distance and normal; of `probes` maps.
TexelValues texel_values(int size, int probes,
                         const std::function<double(int probe, const std::array<double, 3>& d, std::array<double, 3>& normal)>& see);

class ProbeScene {
 public:
  /// Builds the maps of `maps` from texel values. The context must outlive it.
  static Result<ProbeScene> make(Context& context, const ProbeMaps& maps, const ProbeGrid& grid, const TexelValues& values,
                                 std::span<const double> positions = {});
  /// Traces: grid and maps of `params` are set (the ratio is kept where it is 1: flat; `normal` none: no normals are read).
  Result<Traced> trace(ProbeTraceParams params, std::span<const double> rays, int repeat = 1, Times* times = nullptr);
  /// The plan and memory of the last trace, for timing.
  HeldPlan& last() { return *last_; }
  /// Compiles a trace and writes its rays.
  Status prepare(ProbeTraceParams params, std::span<const double> rays);
  Result<Traced> result() const;

  const HeldPlan& maps() const { return built_; }
  const ProbeMaps& shape() const { return maps_; }
  const ProbeGrid& grid() const { return grid_; }
  /// The maps as the tracer reads them, for bench/truth/probe_truth.h; of one probe.
  Result<truth::ProbeMap> decoded(int probe, bool normals) const;

 private:
  Context* context_ = nullptr;
  ProbeMaps maps_;
  ProbeGrid grid_;
  HeldPlan built_;
  std::shared_ptr<Memory> positions_;
  std::shared_ptr<HeldPlan> last_;
};

}  // namespace luxel::cases

// How host/<kernel>.cpp builds a Plan: resources, scratch and passes by name, checked against the module's tables.
#pragma once
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include <luxel/plan.h>

#include "host/module.h"

namespace luxel {

class Planner {
 public:
  Planner(std::string kernel) { plan_.kernel = std::move(kernel); }

  Slot resource(Resource resource);
  Slot scratch(Format format, std::size_t count);
  /// A table: what the float executions read (each value a float), and what the double execution reads.
  Slot table(std::vector<double> rounded, std::vector<double> exact);

  struct Values : std::vector<std::pair<std::string_view, double>> {
    using vector::vector;
    friend Values operator+(Values a, const Values& b) {
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }
  };
  /// Adds a pass over `invocations` (x, y, z), rounded up to whole workgroups. Every parameter, constant and slot of the
  /// module is named once; constants may be left at their fallback.
  void pass(std::string_view part, std::string_view module, std::string label, std::array<std::uint32_t, 3> invocations,
            std::array<std::uint32_t, 3> workgroup, const Values& parameters, const Values& constants,
            const std::vector<std::pair<std::string_view, Slot>>& slots);
  /// The pass added last finds its number of workgroups in three u32 of `slot`, from element `first`, which an earlier
  /// pass wrote (kernels/math/launch.h); its invocations are then the most there may be.
  void counts(Slot slot, std::size_t first = 0);
  /// The pass added last runs so many rounds of loops an invocation at most: Pass::rounds.
  void rounds(double most) {
    if (!plan_.passes.empty()) plan_.passes.back().rounds = most;
  }
  void cost(double flops, double bytes) { plan_.flops += flops; plan_.bytes += bytes; }

  /// The finished plan, or the first defect met on the way.
  Result<Plan> finish() &&;

 private:
  void fail(Code code, const std::string& what) { if (status_) status_ = Status(code, plan_.kernel + ": " + what); }
  Plan plan_;
  Status status_;
};

}  // namespace luxel

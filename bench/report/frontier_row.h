// A row of the frontier before it is sent: what a kernel's measurement fills in.
#pragma once
#include <string>

#include "bench/report/cell.h"
#include "tests/cases/run.h"

namespace luxel::report {

/// Parts of a result's error by one metric; null where a part does not apply.
struct ErrorSplit {
  std::string metric;
  Cell rounding = nullptr, storage = nullptr, device = nullptr, method = nullptr;
  Cell discretization = nullptr, model = nullptr;  // parts of method
  Cell standard_error = nullptr;                   // of method, where the truth is an estimate
};

/// One setting on the session's device.
struct FrontierRow {
  std::string kernel, variant, scene, size;
  Cell options, knobs;                                       // objects
  std::string group;                                         // rows compare where this, kernel, device, scene, size and metric are equal
  ErrorSplit error;
  Cell build = nullptr, update = nullptr, shade = nullptr;   // cell_of a Sample; null where there is no such phase
  Cell bytes = nullptr, flops = nullptr, memory = nullptr;   // null where not known

  /// Bytes and operations as the plan has them, and the memory of a run.
  void costs_of(const cases::Run& run) {
    bytes = run.plan().bytes;
    flops = run.plan().flops;
    memory = run.memory_bytes();
  }
};

}  // namespace luxel::report

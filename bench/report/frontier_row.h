// A row of the frontier before it is sent: what a kernel's measurement fills in.
#pragma once
#include <string>

#include "bench/report/json.h"
#include "tests/cases/run.h"

namespace luxel::report {

/// Parts of a result's error by one metric; null where a part does not apply.
struct ErrorSplit {
  std::string metric;
  Json rounding = nullptr, storage = nullptr, device = nullptr, method = nullptr;
  Json discretization = nullptr, model = nullptr;  // parts of method
  Json standard_error = nullptr;                   // of method, where the truth is an estimate
};

/// One setting on the session's device.
struct FrontierRow {
  std::string kernel, variant, scene, size;
  Json options, knobs;                                       // objects
  std::string group;                                         // rows compare where this, kernel, device, scene, size and metric are equal
  ErrorSplit error;
  Json build = nullptr, update = nullptr, shade = nullptr;   // to_json of a Sample; null where there is no such phase
  Json bytes = nullptr, flops = nullptr, memory = nullptr;   // null where not known

  /// Bytes and operations as the plan has them, and the memory of a run.
  void costs_of(const cases::Run& run) {
    bytes = run.plan().bytes;
    flops = run.plan().flops;
    memory = run.memory_bytes();
  }
};

}  // namespace luxel::report

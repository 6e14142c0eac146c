// Whether the setting that a kernel has by default is one that nothing beats.
#pragma once
#include <vector>

#include "bench/report/json.h"

namespace luxel::report {

/// A row for each view (kernel, device, scene, size, metric and what its settings have in common) in which a default was
/// measured: {kernel, device, scene, size, metric, setting, error, ms, better, why}. `better` is null where the default is on
/// the frontier; else {setting, error, ms} of the fastest that beats it, and `why` says why it is the default all the same. A
/// setting is {variant, options, knobs}. `rows`: of the frontier, with their groups.
Json default_rows(const std::vector<Json>& rows);

}  // namespace luxel::report

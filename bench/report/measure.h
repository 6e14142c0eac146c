// The child process of a report: everything that is measured on one device.
#pragma once
#include <string>

#include "bench/report/settings.h"

namespace luxel::report {

/// `device`: as Context::open takes it. `first`: this child also makes the pictures. Returns the process's exit status.
int measure_device(Settings settings, const std::string& device, double best_guard, bool first);

}  // namespace luxel::report

// What the report says about the machine and the program.
#pragma once
#include "bench/report/json.h"

namespace luxel::report {

/// Processor, cores, memory, system, compiler, version, time.
Json machine();

}  // namespace luxel::report

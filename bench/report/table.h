// The report at a terminal.
#pragma once
#include <string>

#include "bench/report/json.h"

namespace luxel::report {

/// Frontier, peers, limits and broken promises on stdout; `out`: where the files are.
void print_tables(const Json& report, const std::string& out);

}  // namespace luxel::report

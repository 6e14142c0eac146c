// The shape of report.json, checked before it is written and by the tests.
#pragma once
#include <string>
#include <vector>

#include "bench/report/json.h"

namespace luxel::report {

constexpr const char* schema_name = "luxel.report/1";

/// What is wrong with a report, a line for each defect: fields that are missing, unknown or of the wrong type.
std::vector<std::string> check_schema(const Json& report);

/// The same for one row of a section ("frontier", "stability" ...). `group` is allowed in rows that are not yet
/// compared.
std::vector<std::string> check_row(const std::string& section, const Json& row);

}  // namespace luxel::report

// JSON with its fields in the order in which they were set.
#pragma once
#include <nlohmann/json.hpp>

namespace luxel::report {

using Json = nlohmann::ordered_json;

}  // namespace luxel::report

// What two reports of the same build must agree on.
#pragma once
#include "bench/report/json.h"

namespace luxel::report {

/// Every number of a report that is no time.
inline Json errors_of(const Json& report) {
  Json all = Json::array();
  for (const Json& r : report["frontier"])
    all.push_back({r["kernel"], r["device"], r["scene"], r["options"], r["knobs"], r["error"]});
  for (const Json& r : report["stability"]) all.push_back({r["case"], r["device"], r["measured"]});
  return all;
}

}  // namespace luxel::report

// The report: devices measured one after the other, each in a child process; rows gathered, compared, written and
// shown.
#pragma once
#include <string>
#include <vector>

#include <luxel/device.h>

#include "bench/report/json.h"
#include "bench/report/kept.h"
#include "bench/report/settings.h"

namespace luxel::report {

/// Measures, writes DIR/report.json, pictures and page, prints tables. Jobs that an earlier run in the same folder finished
/// are taken from there. Returns the program's exit status: 0, 1 (a promise is broken or a device died), 2 (wrong use; one
/// line on stderr), 130 (interrupted: what was finished is kept).
int run_report(const Settings& settings);

/// Prints "luxel: message" on stderr and returns `status`.
int complain(const std::string& message, int status);

/// The devices that `names` mean (as Context::open takes them), each once; all but the execution in double where
/// `names` is empty. Names of APIs that died are left out. Errors: missing_driver for a name that no device has;
/// invalid_argument for the execution in double, which is what every row is compared with.
Result<std::vector<DeviceInfo>> choose_devices(const std::vector<DeviceInfo>& all,
                                               const std::vector<std::string>& names,
                                               const std::vector<std::string>& died = {});

/// Rows of all sections as they come from the children.
struct Gathered {
  Json devices = Json::array(), flagged = Json::array(), pictures = Json::array();
  std::vector<Json> frontier;
  std::vector<Json> spent;           // seconds of each job
  Json stability = Json::array(), left_out = Json::array(), peers = Json::array(), reproduction = Json::array();
  std::vector<std::string> skipped;  // files that were not there
  double best_guard = 0;
  int last_done = 0, last_of = 0;
  std::string last_label;
  KeptJobs kept;                    // of an earlier run
  int finished = 0, of = 0;         // jobs of all devices so far; `finished` counts those that are kept too
  int from_before = 0;              // jobs that an earlier run finished
};

/// Takes in one line of a child that measures devices.back(); "kept" brings all lines of that job. Returns the line where
/// rows.jsonl is to have it: rows, and what belongs to a job; else nothing. A line that is damaged (a child may die in the
/// middle of one) counts as none.
std::string take_line(Gathered& gathered, const std::string& line);

/// The whole report; marks the frontier.
Json assemble(Gathered gathered, Json machine);

/// 1 when a stability row failed or a device died, else 0.
int exit_status_of(const Json& report);

}  // namespace luxel::report

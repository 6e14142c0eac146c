// What an earlier run of a report finished, so that an interrupted one goes on. DIR/rows.jsonl holds a line for each
// thing that a job said, tagged with the job's key, between a line `begin` and a line `finished`.
#pragma once
#include <map>
#include <string>
#include <vector>

#include <luxel/device.h>

#include "bench/report/json.h"
#include "bench/report/settings.h"

namespace luxel::report {

/// A finished job: what it said, and its last line: {"job", "finished": {"label", "modules", "guard"}}.
struct KeptJob {
  std::vector<std::string> lines;  // in their order, begin and finished included
  Json finished;
};
using KeptJobs = std::map<std::string, KeptJob>;  // by key

/// The jobs of a file whose every line is there. Of a job that was begun again the last attempt counts; lines that are
/// damaged, as the last one of a killed program may be, and lines of no job are left out.
KeptJobs read_kept(const std::string& path);

/// Writes them anew, whole or not at all.
Status write_kept(const std::string& path, const KeptJobs& jobs);

/// What a job's rows depend on beside the text of kernels: device, driver, profile, what the report was asked for, and the
/// label, which names options, knobs and scene.
std::string job_key(const DeviceInfo& device, const Profile& profile, const Settings& settings, const std::string& label);

/// "part.name" and the hash of the module's sources in this build; empty where there is no such module.
std::string module_hash(const std::string& module);

/// Whether every module that a job's programs were made of ("modules": name to hash) is what it was.
bool unchanged(const Json& modules);

/// Writes a file under another name and renames it: whole or not at all.
Status write_file(const std::string& path, const std::string& text);

}  // namespace luxel::report

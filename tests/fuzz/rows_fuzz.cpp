// What the program reads of JSON that it wrote itself: rows of an earlier report, and profiles of devices.
#include "bench/report/kept.h"
#include "bench/report/profile_file.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxel;
  const fuzz::MemoryFile file(data, size);
  const report::KeptJobs jobs = report::read_kept(file.path());
  for (const auto& [key, job] : jobs) {
    fuzz::require(!job.lines.empty(), "a finished job has lines");
    // Asked of each by those who read them.
    const report::Json none = report::Json::object();
    if (job.finished.contains("finished") && job.finished["finished"].is_object())
      (void)report::unchanged(job.finished["finished"].value("modules", none));
  }
  const report::Json json = report::Json::parse(data, data + size, nullptr, false);
  if (json.is_discarded()) return 0;
  const Result<Profile> profile = report::profile_from(json);
  if (!profile) fuzz::require_one_line(profile.status());
  return 0;
}

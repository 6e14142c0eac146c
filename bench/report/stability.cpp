#include "bench/report/stability.h"

namespace luxel::report {

std::vector<Job> stability_jobs(Session& session, const std::vector<cases::Case>& all) {
  std::vector<Job> jobs;
  for (const cases::Case& c : all) {
    if (!cases::applies(c, session.context().info()) || (c.slow && session.settings().quick)) continue;
    jobs.push_back({c.kernel + " case " + c.name, [&session, c]() -> Status {
                      const Result<double> measured = c.measure(session.context());
                      if (!measured) return measured.status();
                      session.row("stability", {{"kernel", c.kernel},
                                                {"case", c.name},
                                                {"device", session.device()},
                                                {"promise", c.promise},
                                                {"bound", c.bound},
                                                {"measured", measured.value()},
                                                {"pass", cases::kept(c, measured.value())}});
                      return {};
                    }});
  }
  return jobs;
}

}  // namespace luxel::report

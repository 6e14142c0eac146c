#include "bench/report/stability.h"

#include <algorithm>
#include <map>

namespace luxel::report {
namespace {

// The last of each kind: the furthest of a list that goes outwards. Of more than `most` kinds, some from all over the list.
std::vector<cases::Case> last_of_kinds(const std::vector<cases::Case>& all, std::size_t most, bool growths) {
  const auto kind = [](const cases::Case& c) { return c.name.substr(0, c.name.find_first_of(",0123456789")); };
  std::map<std::string, const cases::Case*> last;
  for (const cases::Case& c : all) last[kind(c)] = &c;
  std::vector<cases::Case> kept;
  for (const cases::Case& c : all)
    if (last[kind(c)] == &c) kept.push_back(c);
  std::vector<cases::Case> some = kept;
  if (kept.size() > most) {
    some.clear();
    for (std::size_t i = 0; i < most; ++i) some.push_back(kept[i * kept.size() / most]);
  }
  // What is iterated, in every form.
  for (const cases::Case& c : all)
    if (growths && c.name.starts_with("growth") &&
        std::none_of(some.begin(), some.end(), [&](const cases::Case& s) { return s.name == c.name; }))
      some.push_back(c);
  return some;
}

}  // namespace

std::vector<Job> stability_jobs(Session& session, const std::vector<cases::Case>& cases) {
  const Settings& settings = session.settings();
  std::vector<cases::Case> all;
  for (const cases::Case& c : cases)
    if (cases::applies(c, session.context().info()) && (settings.slow_cases || !c.slow)) all.push_back(c);
  if (settings.most_cases > 0 && settings.only.empty()) all = last_of_kinds(all, static_cast<std::size_t>(settings.most_cases), settings.stability);
  std::vector<Job> jobs;
  for (const cases::Case& c : all) {
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

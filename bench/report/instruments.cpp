#include "bench/report/instruments.h"

#include <cmath>

#include <fmt/format.h>

namespace luxel::report {

std::vector<Instrument> instruments() {
  std::vector<Instrument> all;
  add_gains(all);
  add_growths(all);
  add_storages(all);
  add_edges(all);
  return all;
}

std::vector<Job> instrument_jobs(Session& session) {
  std::vector<Job> jobs;
  for (const Instrument& i : instruments()) {
    if (!session.settings().wants(i.family)) continue;
    jobs.push_back({i.kernel + " " + i.name, [&session, i]() -> Status {
                      const Result<Found> found = i.measure(session.context(), session.cpu_double(), session.settings().quick);
                      if (!found) return found.status();
                      const Found& f = found.value();
                      session.row("stability", {{"kernel", i.kernel},
                                                {"case", i.name},
                                                {"device", session.device()},
                                                {"promise", f.where.empty() ? i.promise : fmt::format("{} ({})", i.promise, f.where)},
                                                {"bound", i.bound},
                                                {"measured", f.measured},
                                                {"pass", f.measured <= i.bound}});
                      return {};
                    }});
  }
  return jobs;
}

Found fitted_power(const std::string& what, const std::vector<std::pair<double, double>>& points) {
  Found f{0, what + ":"};
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  bool finite = true;
  for (const auto& [size, error] : points) {
    f.where += fmt::format(" {:g}: {:.2g},", size, error);
    finite = finite && std::isfinite(error);
    if (!(error > 0)) continue;
    const double u = std::log(size), v = std::log(error);
    n += 1, x += u, y += v, xx += u * u, xy += u * v;
  }
  f.where.pop_back();
  if (!finite)
    f.measured = std::nan("");
  else if (n >= 2 && n * xx - x * x > 0)
    f.measured = (n * xy - x * y) / (n * xx - x * x);
  return f;
}

Result<double> edge_between(double good, double bad, const std::function<Result<bool>(double)>& works, double precision) {
  const Result<bool> first = works(good);
  if (!first) return first.status();
  if (!first.value()) return std::nan("");
  const Result<bool> last = works(bad);
  if (!last) return last.status();
  if (last.value()) return bad;
  while (std::fabs(bad / good - 1) > precision) {
    const double middle = std::sqrt(good) * std::sqrt(bad);
    if (middle == good || middle == bad) break;
    const Result<bool> ok = works(middle);
    if (!ok) return ok.status();
    (ok.value() ? good : bad) = middle;
  }
  return good;
}

}  // namespace luxel::report

#include "bench/report/dependent_reads.h"

#include <numeric>

#include <fmt/format.h>

#include "bench/report/limits.h"
#include "bench/scene/images.h"
#include "tests/cases/run.h"

namespace luxel::report {

Status beside_dependent_reads(Session& session, const std::shared_ptr<cases::Run>& run, const Searcher& s) {
  constexpr int invocations = 1 << 17, steps = 64;
  auto made = cases::Run::make(session.context(), march_plan(invocations, s.entries, steps, session.context().profile()));
  if (!made) return made.status();
  const auto loop = std::make_shared<cases::Run>(std::move(made).value());
  // One cycle through the whole table, in a random order.
  std::vector<double> links(static_cast<std::size_t>(s.entries));
  std::iota(links.begin(), links.end(), 0.0);
  for (std::size_t i = links.size() - 1; i > 0; --i)
    std::swap(links[i], links[scene::hash(static_cast<std::uint32_t>(i)) % static_cast<std::uint32_t>(i)]);
  if (Status written = loop->write("links", links); !written) return written;
  const auto pair = session.interleave(timed(run), timed(loop), "peer: a march of dependent reads");
  if (!pair) return pair.status();
  const auto paths = run->read(s.looks);
  if (!paths) return paths.status();
  double looks = 0;
  for (std::size_t i = 3; i < paths.value().size(); i += 4) looks += paths.value()[i];
  const double marched = march_steps(invocations, steps);
  std::vector<double> r = ratios(pair.value().b, pair.value().a);
  for (double& v : r) v *= looks / marched;
  const Sample ratio = summarise(r);
  session.row("peers", {{"peer", fmt::format("dependent reads of a table of {} size, {:.0f} M/s; ours {:.1f} looks a ray", s.table,
                                             marched / summarise(pair.value().b).median * 1e-3, looks / s.rays)},
                        {"version", "-"},
                        {"kernel", s.kernel},
                        {"size", s.size},
                        {"time_ms", cell_of(summarise(pair.value().b))},
                        {"error", nullptr},
                        {"ratio", ratio.median},
                        {"q1", ratio.q1},
                        {"q3", ratio.q3},
                        {"device", session.device()},
                        {"options", {{"variant", s.variant}}},
                        {"own_ms", cell_of(summarise(pair.value().a))},
                        {"own_error", nullptr},
                        {"goal", 0.5}});
  return {};
}

}  // namespace luxel::report

#include "bench/report/claims.h"

#include <fmt/format.h>

#include "bench/report/session.h"

namespace luxel::report {

void add(Session& session, const Claim& claim) {
  const Sample& m = claim.measured;
  session.row("reproduction", {{"claim", claim.text},
                               {"source", claim.source},
                               {"source_value", claim.source_value},
                               {"measured", m.median},
                               {"q1", m.n > 1 ? Cell(m.q1) : Cell()},
                               {"q3", m.n > 1 ? Cell(m.q3) : Cell()},
                               {"rule", claim.rule.text},
                               {"verdict", claim.rule.kept ? "confirmed" : "not confirmed"},
                               {"reason", claim.reason},
                               {"device", session.device()}});
}

Rule within(double measured, double claimed, double factor) {
  return {fmt::format("within a factor of {}", factor), measured >= claimed / factor && measured <= claimed * factor};
}

}  // namespace luxel::report

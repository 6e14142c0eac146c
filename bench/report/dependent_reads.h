// Kernels that search beside the rate at which their driver follows addresses.
#pragma once
#include <memory>
#include <string>

#include "bench/report/session.h"

namespace luxel::report {

struct Searcher {
  std::string kernel, variant, size;  // as the row shows them
  std::string table;                  // what is searched: "the pyramid's"
  std::string looks;                  // resource of `run` whose every fourth value from the fourth on is a ray's looks
  double rays = 0;
  int entries = 0;                    // of a table as large, below 2^24
};

/// Looks a second of `run` beside a loop in which every address is the last value read; a row of `peers`, goal 0.5.
Status beside_dependent_reads(Session& session, const std::shared_ptr<cases::Run>& run, const Searcher& searcher);

}  // namespace luxel::report

// The certificate of `luxel stability`: per kernel a table of input class, promise, bound, the worst that was measured, and where.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "bench/report/json.h"

namespace luxel::report {

/// A line of the table: all stability rows of a kernel with one kind of name and one promise.
struct CertificateLine {
  std::string kernel, input, promise, where;  // `where`: the case and device of the worst
  double bound = 0, measured = 0;
  int cases = 0, broken = 0;
};

/// Lines of the rows of a report, kernels and classes in the rows' order. The worst row of a line is one that is broken, else
/// the one nearest to its bound.
std::vector<CertificateLine> certificate(const Json& report);

/// A page in Markdown for each kernel: (kernel, text).
std::vector<std::pair<std::string, std::string>> certificate_pages(const Json& report);

/// Prints the tables on stdout, and what is broken.
void print_certificate(const Json& report);

}  // namespace luxel::report

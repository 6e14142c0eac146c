#include "bench/report/certificate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <fmt/format.h>

namespace luxel::report {
namespace {

// "NaN, linear" is of the class "NaN"; names of instruments are classes of their own.
std::string class_of(const std::string& name) {
  for (const char* whole : {"gain: ", "growth: ", "storage: ", "edge: "})
    if (name.starts_with(whole)) return name;
  std::string kind = name.substr(0, name.find_first_of(",0123456789"));
  while (!kind.empty() && kind.back() == ' ') kind.pop_back();
  return kind.empty() ? name : kind;
}

// Instruments put what they found behind their promise in brackets.
std::pair<std::string, std::string> split(const std::string& name, const std::string& promise) {
  const bool instrument = class_of(name) == name && name.find(": ") != std::string::npos;
  const std::size_t at = promise.rfind(" (");
  if (!instrument || at == std::string::npos || promise.back() != ')') return {promise, ""};
  return {promise.substr(0, at), promise.substr(at + 2, promise.size() - at - 3)};
}

double used(double measured, double bound) {
  if (std::isnan(measured)) return HUGE_VAL;
  return bound != 0 ? measured / bound : measured;
}

std::string verdict(const CertificateLine& l) {
  return l.broken > 0 ? "BROKEN" : "kept";
}

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

}  // namespace

std::vector<CertificateLine> certificate(const Json& report) {
  std::vector<CertificateLine> lines;
  std::map<std::string, std::size_t> index;
  for (const Json& row : report.at("stability")) {
    const std::string kernel = row.at("kernel"), name = row.at("case"), device = row.at("device");
    const auto [promise, found] = split(name, row.at("promise"));
    const double measured = row.at("measured").is_number() ? row.at("measured").get<double>() : std::nan(""), bound = row.at("bound");
    const bool broken = row.at("pass") != true;
    const std::string key = kernel + "|" + class_of(name) + "|" + promise;
    if (!index.contains(key)) {
      index[key] = lines.size();
      lines.push_back({kernel, class_of(name), promise, "", bound, measured, 0, 0});
    }
    CertificateLine& l = lines[index[key]];
    const bool worse = l.cases == 0 || (broken && l.broken == 0) || ((l.broken == 0 || broken) && used(measured, bound) > used(l.measured, l.bound));
    l.cases += 1, l.broken += broken;
    if (!worse) continue;
    l.bound = bound, l.measured = measured;
    l.where = fmt::format("{}{} on {}", name == l.input ? "" : name, found.empty() ? "" : (name == l.input ? "" : ", ") + found, device);
    if (l.where.starts_with(" on ")) l.where = l.where.substr(1);
  }
  std::map<std::string, std::size_t> first;  // line of each kernel
  for (std::size_t i = 0; i < lines.size(); ++i) first.emplace(lines[i].kernel, i);
  std::stable_sort(lines.begin(), lines.end(), [&](const CertificateLine& a, const CertificateLine& b) { return first.at(a.kernel) < first.at(b.kernel); });
  return lines;
}

std::vector<std::pair<std::string, std::string>> certificate_pages(const Json& report) {
  std::vector<std::pair<std::string, std::string>> pages;
  const auto lines = certificate(report);
  std::string devices;
  for (const Json& d : report.at("devices"))
    devices += fmt::format("- `{}`, {}{}\n", d.at("id").get<std::string>(), d.at("driver").get<std::string>(),
                           d.at("died") == true ? ": **died**; rows are missing" : "");
  for (const CertificateLine& l : lines) {
    if (pages.empty() || pages.back().first != l.kernel)
      pages.emplace_back(l.kernel, fmt::format("# Stability of {}\n\nEach promise with its bound, the worst number measured over all its cases and "
                                               "devices, and where that was. A promise is kept where the number is not larger than the bound.\n\n{}\n"
                                               "| input | promise | bound | worst | where | cases | |\n| --- | --- | --- | --- | --- | --- | --- |\n",
                                               l.kernel, devices));
    pages.back().second += fmt::format("| {} | {} | {:.5g} | {:.5g} | {} | {} | {} |\n", escaped(l.input), escaped(l.promise), l.bound, l.measured,
                                       escaped(l.where), l.cases, l.broken > 0 ? fmt::format("**{} broken**", l.broken) : "kept");
  }
  return pages;
}

void print_certificate(const Json& report) {
  std::string kernel;
  int promises = 0, cases = 0, broken = 0;
  for (const CertificateLine& l : certificate(report)) {
    if (l.kernel != kernel) {
      kernel = l.kernel;
      fmt::print("\n{}\n  {:<34} {:>10} {:>10} {:>6}  {}\n", kernel, "input", "bound", "worst", "", "promise; where it was worst");
    }
    fmt::print("  {:<34} {:>10.5g} {:>10.5g} {:>6}  {}; {}\n", l.input, l.bound, l.measured, verdict(l), l.promise, l.where);
    promises += 1, cases += l.cases, broken += l.broken;
  }
  fmt::print("\n{} promises, {} cases: {}\n", promises, cases, broken == 0 ? "all kept" : fmt::format("{} BROKEN", broken));
}

}  // namespace luxel::report

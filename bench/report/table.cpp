#include "bench/report/table.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include <fmt/format.h>

#include "bench/report/frontier.h"

namespace luxel::report {
namespace {

std::string number(const Json& v) { return v.is_number() ? fmt::format("{:.3g}", v.get<double>()) : "-"; }

std::string text(const Json& v) {
  return v.is_string() ? v.get<std::string>() : v.is_number() ? fmt::format("{:.4g}", v.get<double>()) : v.dump();
}

// "sigma 4 k 3 radius 12"
std::string knobs_text(const Json& knobs) {
  std::string all;
  for (const auto& [name, v] : knobs.items()) all += fmt::format("{}{} {}", all.empty() ? "" : " ", name, text(v));
  return all;
}

// What is not the default, and the format.
std::string options_text(const Json& options) {
  std::string all;
  for (const auto& [name, v] : options.items()) {
    if (v.is_boolean()) {
      if (v.get<bool>()) all += " " + name;
    } else if (v != "clamp" && v != "buffer" && v != "floor" && v != "cells" && v != 2) {
      all += " " + text(v);
    }
  }
  return all.empty() ? all : all.substr(1);
}

const Json* limit(const Json& report, const std::string& device, const std::string& what, const std::string& size,
                  double bytes_per_pixel) {
  for (const Json& d : report["devices"]) {
    if (d["id"] != device) continue;
    for (const Json& l : d["limits"])
      if (l["what"] == what && (size.empty() || (l["size"] == size && l["bytes_per_pixel"] == bytes_per_pixel)))
        return &l;
  }
  return nullptr;
}

double bytes_per_pixel(const Json& row) {
  const std::string format = row["options"].value("format", "f32x4");
  return format == "f32x4" ? 16 : format == "f32x2" || format == "f16x4" ? 8 : 4;
}

// The scene, size and metric that most of a kernel's rows are about.
std::string main_view(const std::vector<const Json*>& rows) {
  std::map<std::string, int> counts;
  std::string best;
  for (const Json* r : rows) {
    const std::string view = text((*r)["scene"]) + ", " + text((*r)["size"]) + ": " + text((*r)["error"]["metric"]);
    if (++counts[view] > counts[best]) best = view;
  }
  return best;
}

void print_frontier(const Json& report) {
  std::map<std::string, std::vector<const Json*>> kernels;
  for (const Json& row : report["frontier"])
    if (row["on_frontier"] == true && !row["knobs"].contains("level")) kernels[row["kernel"]].push_back(&row);
  for (const auto& [kernel, rows] : kernels) {
    const std::string view = main_view(rows);
    fmt::print(
        "\n{} on {}\nsettings that no other beats in both error and time (copy%: of the GB/s of a copy of this size on "
        "this device)\n",
        kernel, view);
    std::map<std::string, std::vector<const Json*>> devices;
    for (const Json* r : rows)
      if (view == text((*r)["scene"]) + ", " + text((*r)["size"]) + ": " + text((*r)["error"]["metric"]))
        devices[(*r)["device"]].push_back(r);
    for (const auto& [id, shown] : devices) {
      const std::string& device = id;
      fmt::print("{}\n  {:<12} {:<22} {:<30} {:>10} {:>9} {:>6} {:>6}\n", device, "variant", "options", "knobs",
                 "error", "ms", "copy%", "arith%");
      for (const Json* row : shown) {
        const Json& r = *row;
        const double ms = total_time(r).median;
        const auto share = [&](const char* what, const std::string& size, const Json& work) {
          const Json* l = limit(report, device, what, size, bytes_per_pixel(r));
          return l && work.is_number() && ms > 0
                     ? fmt::format("{:.0f}", 100 * work.get<double>() / ms * 1e-6 / (*l)["rate"].get<double>())
                     : "-";
        };
        fmt::print("  {:<12} {:<22.22} {:<30.30} {:>10.3g} {:>9.4g} {:>6} {:>6}\n", text(r["variant"]),
                   options_text(r["options"]), knobs_text(r["knobs"]), total_error(r), ms,
                   share("copy", r["size"], r["bytes"]), share("arithmetic", "", r["flops"]));
      }
    }
  }
}

void print_defaults(const Json& report) {
  struct Count {
    int all = 0, kept = 0;
    std::string why;
  };
  std::map<std::pair<std::string, std::string>, Count> counts;
  for (const Json& row : report["defaults"]) {
    Count& c = counts[{row["kernel"], row["setting"]["variant"] == "luxel denoise" ? "luxel denoise" : ""}];
    ++c.all;
    if (row["better"].is_null()) ++c.kept;
    else c.why = row["why"];
  }
  if (!counts.empty()) fmt::print("\ndefaults that nothing beats in both error and time\n");
  for (const auto& [name, c] : counts)
    fmt::print("{:<32} {} of {} places{}\n", name.second.empty() ? name.first : name.first + ", " + name.second, c.kept, c.all,
               c.why.empty() ? "" : "; elsewhere: " + c.why);
}

// Rows about one level of a pyramid: a line a format and device.
void print_levels(const Json& report) {
  std::map<std::string, std::map<int, double>> lines;
  for (const Json& row : report["frontier"])
    if (row["knobs"].contains("level"))
      lines[fmt::format("{:<40.40} {:<10} {}", text(row["device"]), options_text(row["options"]), text(row["size"]))]
           [row["knobs"]["level"]] = total_error(row);
  if (lines.empty()) return;
  fmt::print("\nmip_build isotropic: |mean drift| of each level, in steps of the format\n");
  for (const auto& [line, levels] : lines) {
    fmt::print("{}", line);
    for (const auto& [level, drift] : levels) fmt::print("  {:.2g}", drift);
    fmt::print("\n");
  }
}

void print_peers(const Json& report) {
  if (report["peers"].empty()) return;
  fmt::print(
      "\npeers, in turn with ours (ratio: their time over ours)\n{:<50} {:<24} {:<26} {:>8} {:>8} {:>7} {:>14} {:>6}\n",
      "peer", "device", "what", "ours ms", "peer ms", "ratio", "q1..q3", "goal");
  for (const Json& r : report["peers"])
    fmt::print(
        "{:<50.50} {:<24.24} {:<26.26} {:>8.3g} {:>8.3g} {:>7.3g} {:>14} {:>6}\n", text(r["peer"]), text(r["device"]),
        fmt::format("{} {}", options_text(r["options"]), text(r["size"])), r["own_ms"]["median"].get<double>(),
        r["time_ms"]["median"].get<double>(), r["ratio"].get<double>(),
        fmt::format("{}..{}", number(r["q1"]), number(r["q3"])),
        r["goal"].is_null() ? "-" : fmt::format("{}{}", number(r["goal"]), r["ratio"] >= r["goal"] ? "" : " no"));
}

void print_limits(const Json& report) {
  fmt::print("\nlimits measured in this run\n");
  const auto line = [](const std::string& where, const Json& l) {
    fmt::print("{:<40.40} {:<12} {:>10} {:>3} bytes/pixel {:>8.3g} {:<8} {}\n", where, text(l["what"]), text(l["size"]),
               number(l["bytes_per_pixel"]), l["rate"].get<double>(), text(l["unit"]), text(l["form"]));
  };
  for (const Json& l : report["machine"]["limits"]) line("machine", l);
  for (const Json& d : report["devices"])
    for (const Json& l : d["limits"]) line(d["id"], l);
}

void print_stability(const Json& report) {
  std::map<std::pair<std::string, std::string>, std::pair<int, int>> counts;
  for (const Json& r : report["stability"]) {
    auto& [kept, all] = counts[{r["kernel"], r["device"]}];
    ++all;
    if (r["pass"] == true) ++kept;
  }
  fmt::print("\npromises\n");
  for (const auto& [key, count] : counts)
    fmt::print("{:<16} {:<50.50} {} of {} kept\n", key.first, key.second, count.first, count.second);
  for (const Json& r : report["stability"])
    if (r["pass"] != true)
      fmt::print("BROKEN {} on {}: {}: {}; measured {}, bound {}\n", text(r["kernel"]), text(r["device"]),
                 text(r["case"]), text(r["promise"]), number(r["measured"]), number(r["bound"]));
  for (const Json& d : report["devices"])
    for (const Json& p : d["problems"]) fmt::print("{}: {}\n", text(d["id"]), text(p));
}

}  // namespace

void print_tables(const Json& report, const std::string& out) {
  print_frontier(report);
  print_defaults(report);
  print_levels(report);
  print_peers(report);
  print_limits(report);
  print_stability(report);
  const std::size_t flagged = report["machine"]["guard"]["flagged"].size();
  if (flagged > 0)
    fmt::print("\n{} rows were taken while the machine was busy, again and again; machine.guard.flagged names them\n",
               flagged);
  fmt::print("\n{} frontier rows, {} promises; {}/report.json, {}/index.html\n", report["frontier"].size(),
             report["stability"].size(), out, out);
}

}  // namespace luxel::report

#include <algorithm>
#include <cctype>
#include <charconv>

#include "bench/report/defaults.h"
#include "bench/report/frontier.h"
#include "bench/report/report.h"
#include "bench/report/schema.h"

namespace luxel::report {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// By the rules of Context::open.
const DeviceInfo* find(const std::vector<DeviceInfo>& all, const std::string& name) {
  const std::string wanted = lower(name);
  const auto first = [&](auto&& test) -> const DeviceInfo* {
    const auto found = std::find_if(all.begin(), all.end(), test);
    return found == all.end() ? nullptr : &*found;
  };
  if (wanted == "opencl") return first([](const DeviceInfo& d) { return d.api == Api::opencl; });
  if (wanted == "vulkan") return first([](const DeviceInfo& d) { return d.api == Api::vulkan; });
  if (wanted == "cpu") return first([](const DeviceInfo& d) { return d.id == "cpu:float"; });
  int index = -1;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc() && end == wanted.data() + wanted.size())
    if (const DeviceInfo* d = first([&](const DeviceInfo& device) { return device.index == index; })) return d;
  if (const DeviceInfo* d =
          first([&](const DeviceInfo& device) { return lower(device.id) == wanted || device.profile == wanted; }))
    return d;
  return wanted.empty() ? nullptr
                        : first([&](const DeviceInfo& d) { return lower(d.name).find(wanted) != std::string::npos; });
}

}  // namespace

Result<std::vector<DeviceInfo>> choose_devices(const std::vector<DeviceInfo>& all,
                                               const std::vector<std::string>& names,
                                               const std::vector<std::string>& died) {
  std::vector<DeviceInfo> chosen;
  const auto add = [&](const DeviceInfo& d) {
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](const DeviceInfo& c) { return c.index == d.index && c.id == d.id; }))
      chosen.push_back(d);
  };
  for (const std::string& name : names) {
    const DeviceInfo* found = find(all, name);
    if (!found && std::find(died.begin(), died.end(), lower(name)) != died.end()) continue;
    if (!found) {
      std::string message = "--device is " + name + "; expected opencl, vulkan, cpu, or an index or part of a name of:";
      for (const DeviceInfo& d : all) message += " " + std::to_string(d.index) + " " + d.id + ",";
      message.pop_back();
      return Status(Code::missing_driver, message);
    }
    if (found->id == "cpu:double")
      return Status(Code::invalid_argument,
                    "--device is " + name + "; expected another: every row is compared with cpu:double");
    add(*found);
  }
  if (names.empty())
    for (const DeviceInfo& d : all)
      if (d.id != "cpu:double") add(d);
  // The C++ execution first: what it finds about errors the other devices look up.
  std::stable_partition(chosen.begin(), chosen.end(), [](const DeviceInfo& d) { return d.api == Api::cpu; });
  return chosen;
}

std::string take_line(Gathered& g, const std::string& line) {
  Json message = Json::parse(line, nullptr, false);
  if (!message.is_object()) return {};
  const std::string of_job = message.contains("job") ? line : std::string();
  if (message.contains("kept") && message["kept"].is_string()) {
    const auto job = g.kept.find(message["kept"].get<std::string>());
    if (job == g.kept.end()) return {};
    ++g.from_before;
    for (const std::string& earlier : job->second.lines) take_line(g, earlier);
    return {};
  }
  if (message.contains("finished") && message["finished"].is_object()) {
    ++g.finished;
    g.best_guard = std::max(g.best_guard, message["finished"].value("guard", 0.0));
    return of_job;
  }
  if (message.contains("begin")) return of_job;
  if (message.contains("done")) {
    g.last_done = message.value("done", 0);
    g.last_of = message.value("of", 0);
    g.last_label = message.value("label", "");
    g.best_guard = std::max(g.best_guard, message.value("guard", 0.0));
    return {};
  }
  if (message.contains("note")) {
    const std::string list = message.value("note", "");
    Json entry = message["entry"];
    Json& device = g.devices.back();
    if (list == "busy") {
      entry["device"] = device["id"];
      g.flagged.push_back(entry);
    } else if (list == "spent") {
      entry["device"] = device["id"];
      g.spent.push_back(entry);
    } else if (list == "pictures") {
      g.pictures.push_back(entry);
    } else if (list == "skipped" && entry.is_string()) {
      const auto text = entry.get<std::string>();
      if (std::find(g.skipped.begin(), g.skipped.end(), text) == g.skipped.end()) g.skipped.push_back(text);
    } else if (device.contains(list)) {
      device[list].push_back(entry);
    }
    return of_job;
  }
  const std::string section = message.value("section", "");
  if (!message.contains("row") || !check_row(section, message["row"]).empty()) return {};
  const Json& row = message["row"];
  if (section == "frontier")
    g.frontier.push_back(row);
  else if (section == "stability")
    g.stability.push_back(row);
  else if (section == "left_out")
    g.left_out.push_back(row);
  else if (section == "peers")
    g.peers.push_back(row);
  else if (section == "reproduction")
    g.reproduction.push_back(row);
  else
    return {};
  return line;
}

Json assemble(Gathered g, Json machine) {
  Json defaults = default_rows(g.frontier);
  mark_frontier(g.frontier);
  machine["guard"] = {{"best_gflops", g.best_guard}, {"threshold", 0.9}, {"flagged", g.flagged}};
  machine["skipped"] = g.skipped;
  std::stable_sort(g.spent.begin(), g.spent.end(),
                   [](const Json& a, const Json& b) { return a.at("seconds") > b.at("seconds"); });
  machine["spent"] = std::move(g.spent);
  return {{"schema", schema_name},
          {"machine", std::move(machine)},
          {"devices", std::move(g.devices)},
          {"frontier", g.frontier},
          {"defaults", std::move(defaults)},
          {"stability", std::move(g.stability)},
          {"left_out", std::move(g.left_out)},
          {"peers", std::move(g.peers)},
          {"reproduction", std::move(g.reproduction)}};
}

int exit_status_of(const Json& report) {
  const auto broken = [](const Json& row) { return row.at("pass") != true; };
  const auto died = [](const Json& device) { return device.at("died") != false; };
  return std::any_of(report["stability"].begin(), report["stability"].end(), broken) ||
                 std::any_of(report["devices"].begin(), report["devices"].end(), died)
             ? 1
             : 0;
}

}  // namespace luxel::report

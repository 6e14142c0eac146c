#include "bench/report/listing.h"

#include <unistd.h>

#include <algorithm>

#include "bench/report/child.h"
#include "bench/report/json.h"

namespace luxel::report {
namespace {

const char* name_of(Api api) { return api == Api::opencl ? "opencl" : api == Api::vulkan ? "vulkan" : "cpu"; }

bool write_line(const Json& json) {
  const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  return ::write(child_fd, line.data(), line.size()) == static_cast<ssize_t>(line.size());
}

bool write_device(const DeviceInfo& d, int index) {
  return write_line({{"index", index},
                     {"api", name_of(d.api)},
                     {"name", d.name},
                     {"driver", d.driver},
                     {"profile", d.profile},
                     {"id", d.id}});
}

void take(Listing& listing, const std::string& line) {
  const Json j = Json::parse(line, nullptr, false);
  if (!j.is_object()) return;
  if (j.contains("problem")) return listing.problems.push_back(j.value("problem", ""));
  const std::string api = j.value("api", "cpu");
  listing.devices.push_back({j.value("index", -1),
                             api == "opencl"   ? Api::opencl
                             : api == "vulkan" ? Api::vulkan
                                               : Api::cpu,
                             j.value("name", ""), j.value("driver", ""), j.value("profile", ""), j.value("id", "")});
}

}  // namespace

Listing list_devices(const std::function<std::vector<std::string>(const std::string&)>& argv, const std::string& log) {
  constexpr int silence_s = 60;
  const auto ask = [&](const std::string& what, Listing& listing) {
    return !run_child(argv(what), {}, log, silence_s, [&](const std::string& line) { take(listing, line); }).died();
  };
  Listing all;
  if (ask("all", all)) return all;
  Listing each;
  for (const char* api : {"opencl", "vulkan", "cpu"})
    if (!ask(api, each)) each.died.push_back(api);
  return each;
}

int write_listing(const std::string& what) {
  if (what == "all") {
    std::vector<std::string> problems;
    for (const DeviceInfo& d : devices(&problems))
      if (!write_device(d, d.index)) return 1;
    for (const std::string& problem : problems)
      if (!write_line({{"problem", problem}})) return 1;
    return 0;
  }
  const auto context = Context::open(what);
  return (context ? write_device(context.value()->info(), -1) : write_line({{"problem", context.status().message()}}))
             ? 0
             : 1;
}

std::string name_to_open(const DeviceInfo& device, const std::vector<DeviceInfo>& all) {
  if (device.api == Api::cpu) return device.id;
  const auto first = std::find_if(all.begin(), all.end(), [&](const DeviceInfo& d) { return d.api == device.api; });
  return first != all.end() && first->id == device.id && first->index == device.index ? name_of(device.api)
                                                                                      : std::to_string(device.index);
}

}  // namespace luxel::report

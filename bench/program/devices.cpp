#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "bench/report/profile_file.h"
#include "commands.h"
#include "common.h"

namespace luxel::program {

void add_devices(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("devices", "list the devices: index, API, name, driver, profile");
  command->footer("What an API misses on this machine stands on stderr, a line for each.\n"
                  "Every other command's --device takes the API, the index, or part of the name.");
  command->callback([&exit_status] {
    std::vector<std::string> problems;
    const std::vector<DeviceInfo> found = devices(&problems);
    std::size_t name_width = 4, driver_width = 6;
    for (const DeviceInfo& d : found) {
      name_width = std::max(name_width, d.name.size());
      driver_width = std::max(driver_width, d.driver.size());
    }
    const auto row = [&](std::string_view index, std::string_view api, std::string_view name, std::string_view driver,
                         std::string_view profile) {
      fmt::print("{:<5}  {:<6}  {:<{}}  {:<{}}  {}\n", index, api, name, name_width, driver, driver_width, profile);
    };
    row("index", "api", "name", "driver", "profile");
    for (const DeviceInfo& d : found) {
      const char* api = d.api == Api::opencl ? "opencl" : d.api == Api::vulkan ? "vulkan" : "cpu";
      std::string profile = d.profile;
      if (d.api != Api::cpu && std::filesystem::exists(report::profile_path(d))) profile += ", tuned: " + report::profile_path(d);
      row(std::to_string(d.index), api, d.name, d.driver, profile);
    }
    exit_status = done;
    for (const std::string& problem : problems) complain(problem, done);
  });
}

}  // namespace luxel::program

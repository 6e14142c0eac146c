// The devices of this machine, asked for in a child process: a driver that dies while it is loaded ends that, not the
// report.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <luxel/device.h>

namespace luxel::report {

struct Listing {
  std::vector<DeviceInfo>
      devices;  // `index` as `luxel devices` counts; -1 where only the first of each API was asked for
  std::vector<std::string> problems;  // what an API misses
  std::vector<std::string> died;      // "opencl" or "vulkan": the API whose driver took its process along
};

/// Runs `argv` (this program's hidden listing) with "all", and where that dies with each API by itself.
Listing list_devices(const std::function<std::vector<std::string>(const std::string& what)>& argv,
                     const std::string& log);

/// The child's side: writes a line of JSON a device to child_fd. `what`: "all", or an API whose first device is opened.
int write_listing(const std::string& what);

/// How Context::open finds a device again without a look at other drivers, where that is possible.
std::string name_to_open(const DeviceInfo& device, const std::vector<DeviceInfo>& all);

}  // namespace luxel::report

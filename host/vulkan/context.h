// The small layer on Vulkan.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>

namespace luxel::vulkan {

/// The Vulkan devices of this machine, `index` in the loader's order. Where there is none, `problem` (optional) says
/// why and what to install.
std::vector<DeviceInfo> list(std::string* problem);

/// Opens one by its index above. Errors: missing_driver, unsupported, out_of_memory.
Result<std::shared_ptr<Context>> open(int physical_index);

}  // namespace luxel::vulkan

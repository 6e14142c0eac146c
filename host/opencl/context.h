// The OpenCL half of luxel::Context.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>

namespace luxel::opencl {

/// Every OpenCL device of this machine, platform after platform; DeviceInfo.index counts from 0. `problem` (optional)
/// receives what is missing and what to install where there is none, else becomes empty.
std::vector<DeviceInfo> list(std::string* problem);

/// The device that `list` gives this index. Errors: missing_driver where there is none, unsupported, out_of_memory.
Result<std::shared_ptr<Context>> open(int index);

}  // namespace luxel::opencl

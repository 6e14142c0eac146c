// The C++ half of luxel::Context.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>

namespace luxel::reference {

/// Index 0: "C++ float", cpu:float. Index 1: "C++ double", cpu:double. They are always there: `problem` becomes empty.
std::vector<DeviceInfo> list(std::string* problem);

/// The execution that `list` gives this index. Errors: missing_driver for an index it does not give.
Result<std::shared_ptr<Context>> open(int index);

}  // namespace luxel::reference

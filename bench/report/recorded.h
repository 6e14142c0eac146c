// A context that notes which kernel modules it compiles.
#pragma once
#include <functional>
#include <memory>

#include <luxel/device.h>

namespace luxel::report {

/// `context`, with `compiled` told of each plan that is compiled.
std::shared_ptr<Context> recorded(std::shared_ptr<Context> context, std::function<void(const Plan&)> compiled);

}  // namespace luxel::report

// What a device cannot do that a plan asks for.
#pragma once
#include <luxel/vulkan.h>

namespace luxel::vulkan {

/// Errors: unsupported, naming the limit, its value on this device, and what the plan needs. The plan is consistent.
Status check_limits(const Device::State& device, const Plan& plan);

}  // namespace luxel::vulkan

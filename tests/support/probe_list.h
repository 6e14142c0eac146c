// The plan of tests/probe/probe_list: a list made by one pass, and a second pass whose workgroups it decides.
#pragma once
#include <luxel/plan.h>

#include "host/module.h"

namespace luxel {

constexpr std::size_t probe_items = 1000;

/// Resources `marked` (u32 an item) and `done` (u32 an item, then the workgroups that walked). At most `most` workgroups of
/// 32 invocations walk.
Plan probe_list_plan(std::uint32_t most);

}  // namespace luxel

#include "tests/support/probe_list.h"

#include <algorithm>

namespace luxel {
namespace built_in {
extern const std::span<const Module* const> probe_list;
}

Plan probe_list_plan(std::uint32_t most) {
  const auto module = [](std::string_view name) {
    return *std::find_if(built_in::probe_list.begin(), built_in::probe_list.end(),
                         [&](const Module* m) { return m->name == name; });
  };
  Plan plan;
  plan.kernel = "probe";
  plan.resources = {{"marked"}, {"done"}};
  for (Resource& resource : plan.resources) resource.format = Format::u32;
  plan.resources[0].bytes = 4 * probe_items;
  plan.resources[1].bytes = 4 * (probe_items + 1);
  plan.resources[1].written = true;
  plan.scratch = {{Format::u32, probe_items + 1, 0}, {Format::u32, 4, 5120}};
  plan.scratch_bytes = 6144;
  const auto resource = [](int i) { return Slot{Slot::Source::resource, i}; };
  const auto scratch = [](int i) { return Slot{Slot::Source::scratch, i}; };
  Pass make;
  make.module = module("make");
  make.label = "make";
  make.slots = {resource(0), scratch(0), scratch(1)};
  make.parameters = {probe_items, 32, static_cast<double>(most)};
  Pass walk;
  walk.module = module("walk");
  walk.label = "walk";
  walk.slots = {scratch(0), resource(1)};
  walk.parameters = {32.0 * most, probe_items};
  walk.workgroup = {32, 1, 1};
  walk.groups = {most, 1, 1};
  walk.counts = Counts{scratch(1), 1};
  plan.passes = {make, walk};
  return plan;
}

}  // namespace luxel

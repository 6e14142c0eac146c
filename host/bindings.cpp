#include "host/bindings.h"

namespace luxel {
namespace {

std::string expected_names(const Plan& plan) {
  std::string text;
  for (const Resource& resource : plan.resources) text += (text.empty() ? "" : ", ") + resource.name;
  if (plan.scratch_bytes > 0) text += text.empty() ? "scratch" : ", scratch";
  return text;
}

bool kind_fits(ResourceKind resource, BindingKind binding) {
  switch (resource) {
    case ResourceKind::buffer: return !is_image(binding) && binding != BindingKind::uniform;
    case ResourceKind::image: return binding == BindingKind::image2d || binding == BindingKind::image3d;
    case ResourceKind::sampled_image: return is_sampled(binding);
    case ResourceKind::storage_image: 
      return binding == BindingKind::image_write2d || binding == BindingKind::image_read2d || is_sampled(binding);
  }
  return false;
}

bool slot_fits(const Plan& plan, const Slot& slot, const BindingInfo& binding) {
  const auto within = [&](std::size_t count) {
    return slot.index >= 0 && static_cast<std::size_t>(slot.index) < count;
  };
  switch (slot.source) {
    case Slot::Source::resource:
      if (!within(plan.resources.size())) return false;
      return kind_fits(plan.resources[static_cast<std::size_t>(slot.index)].kind, binding.kind);
    case Slot::Source::scratch:
      return within(plan.scratch.size()) && !is_image(binding.kind) && binding.kind != BindingKind::uniform;
    case Slot::Source::table: return within(plan.tables.size()) && binding.kind == BindingKind::uniform;
  }
  return false;
}

bool same(const Slot& a, const Slot& b) { return a.source == b.source && a.index == b.index; }

/// What is wrong with where pass `index` finds its number of workgroups; empty: nothing.
std::string defect_of_counts(const Plan& plan, std::size_t index) {
  const Counts& counts = *plan.passes[index].counts;
  const auto at = static_cast<std::size_t>(counts.slot.index);
  std::size_t bytes = 0;
  Format format = Format::f32x1;
  if (counts.slot.source == Slot::Source::scratch && at < plan.scratch.size()) {
    format = plan.scratch[at].format;
    bytes = plan.scratch[at].count * bytes_per_pixel(format);
  } else if (counts.slot.source == Slot::Source::resource && at < plan.resources.size() &&
             plan.resources[at].kind == ResourceKind::buffer) {
    format = plan.resources[at].format;
    bytes = plan.resources[at].bytes;
  }
  if (format != Format::u32 || bytes < 12 || counts.first > (bytes - 12) / 4) return "finds no three u32 where its counts are";
  bool written = false;
  for (std::size_t p = 0; p <= index; ++p) {
    const Pass& pass = plan.passes[p];
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      if (!same(pass.slots[i], counts.slot) || !is_written(pass.module->bindings[i].kind)) continue;
      if (p == index) return "writes its own counts";
      written = true;
    }
  }
  return written ? "" : "has counts that no earlier pass wrote";
}

}  // namespace

Status check(const Plan& plan) {
  const auto defect = [&](const std::string& what) { return Status(Code::internal, plan.kernel + ": " + what); };
  if (plan.exact_tables.size() != plan.tables.size()) return defect("tables and exact_tables differ in number");
  for (const auto& table : plan.tables) {
    if (table.size() * sizeof(float) > table_bytes)
      return defect("a table of " + std::to_string(table.size()) + " floats; at most " +
                    std::to_string(table_bytes / sizeof(float)) + " fit");
  }
  if (plan.tables.size() * table_bytes > plan.scratch_bytes) return defect("tables end behind scratch_bytes");
  for (const ScratchRegion& region : plan.scratch) {
    if (region.count == 0 || region.offset < plan.tables.size() * table_bytes ||
        region.offset + region.count * bytes_per_pixel(region.format) > plan.scratch_bytes)
      return defect("a scratch region is empty or leaves the scratch buffer");
  }
  for (const Pass& pass : plan.passes) {
    const auto pass_defect = [&](const std::string& what) { return defect("pass " + pass.label + " " + what); };
    if (!pass.module) return pass_defect("has no module");
    const Module& module = *pass.module;
    if (pass.slots.size() != module.bindings.size() || pass.parameters.size() != module.parameters.size() ||
        pass.constants.size() != module.constants.size())
      return pass_defect("does not have the bindings, parameters and constants of its module");
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      if (!slot_fits(plan, pass.slots[i], module.bindings[i]))
        return pass_defect("binds the wrong thing to " + std::string(module.bindings[i].name));
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (pass.workgroup[static_cast<std::size_t>(axis)] == 0 || pass.groups[static_cast<std::size_t>(axis)] == 0)
        return pass_defect("has an empty workgroup or no workgroups");
    }
    if (!pass.counts) continue;
    const std::string wrong = defect_of_counts(plan, static_cast<std::size_t>(&pass - plan.passes.data()));
    if (!wrong.empty()) return pass_defect(wrong);
  }
  const std::vector<Use> use = uses(plan);
  for (std::size_t a = 0; a < use.size(); ++a) {
    if (use[a].first_write >= 0 && !plan.resources[a].written)
      return defect(plan.resources[a].name + " is written, but not marked so");
    for (std::size_t b = 0; b < use.size(); ++b) {
      if (a != b && plan.resources[a].may_alias && plan.resources[b].may_alias && use[a].first_write >= 0 &&
          use[b].last_use >= use[a].first_write)
        return defect(plan.resources[b].name + " may not share memory with " + plan.resources[a].name);
    }
  }
  return {};
}

Result<std::vector<int>> match(const Plan& plan, std::span<const std::string_view> names) {
  std::vector<int> found(plan.resources.size() + 1, -1);
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::size_t place = 0;
    while (place < plan.resources.size() && plan.resources[place].name != names[i]) ++place;
    if (place == plan.resources.size() && names[i] != "scratch")
      return bad_binding(plan, names[i], "is unknown; expected " + expected_names(plan));
    if (found[place] >= 0) return bad_binding(plan, names[i], "is given twice");
    found[place] = static_cast<int>(i);
  }
  for (std::size_t place = 0; place < plan.resources.size(); ++place) {
    if (found[place] < 0)
      return bad_binding(plan, plan.resources[place].name, "is missing; expected " + expected_names(plan));
  }
  if (found.back() < 0 && plan.scratch_bytes > 0)
    return bad_binding(plan, "scratch", "is missing; needs at least " + std::to_string(plan.scratch_bytes) + " bytes");
  return found;
}

std::vector<Use> uses(const Plan& plan) {
  std::vector<Use> result(plan.resources.size());
  for (std::size_t p = 0; p < plan.passes.size(); ++p) {
    const Pass& pass = plan.passes[p];
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      if (pass.slots[i].source != Slot::Source::resource) continue;
      Use& use = result[static_cast<std::size_t>(pass.slots[i].index)];
      const BindingKind kind = pass.module->bindings[i].kind;
      if (is_written(kind) && use.first_write < 0) use.first_write = static_cast<int>(p);
      if (is_read(kind)) use.read = true;
      use.last_use = static_cast<int>(p);
    }
    if (!pass.counts || pass.counts->slot.source != Slot::Source::resource) continue;
    Use& counted = result[static_cast<std::size_t>(pass.counts->slot.index)];
    counted.read = true;
    counted.last_use = static_cast<int>(p);
  }
  return result;
}

std::vector<std::pair<int, int>> exclusive(const Plan& plan) {
  const std::vector<Resource>& resources = plan.resources;
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t a = 0; a < resources.size(); ++a) {
    for (std::size_t b = a + 1; b < resources.size(); ++b) {
      if ((resources[a].written || resources[b].written) && !(resources[a].may_alias && resources[b].may_alias))
        pairs.emplace_back(static_cast<int>(a), static_cast<int>(b));
    }
    pairs.emplace_back(static_cast<int>(a), static_cast<int>(resources.size()));
  }
  return pairs;
}

Status overlapping(const Plan& plan, std::pair<int, int> pair) {
  const auto name = [&](int index) {
    const std::size_t place = static_cast<std::size_t>(index);
    return place < plan.resources.size() ? plan.resources[place].name : std::string("scratch");
  };
  return Status(Code::invalid_argument, plan.kernel + ": bindings " + name(pair.first) + " and " + name(pair.second) +
                                            " overlap; this plan needs them apart");
}

Status bad_binding(const Plan& plan, std::string_view name, const std::string& what) {
  return Status(Code::invalid_argument, plan.kernel + ": binding " + std::string(name) + " " + what);
}

}  // namespace luxel

#include "host/planner.h"

#include <algorithm>

namespace luxel {

Slot Planner::resource(Resource resource) {
  plan_.resources.push_back(std::move(resource));
  return {Slot::Source::resource, static_cast<int>(plan_.resources.size()) - 1};
}

Slot Planner::scratch(Format format, std::size_t count) {
  plan_.scratch.push_back({format, count, 0});
  return {Slot::Source::scratch, static_cast<int>(plan_.scratch.size()) - 1};
}

Slot Planner::table(std::vector<double> rounded, std::vector<double> exact) {
  if (rounded.size() * sizeof(float) > table_bytes) fail(Code::internal, "a table is longer than 4096 values");
  plan_.tables.push_back(std::move(rounded));
  plan_.exact_tables.push_back(std::move(exact));
  return {Slot::Source::table, static_cast<int>(plan_.tables.size()) - 1};
}

namespace {

template <class Infos>
bool assign(const Infos& infos, const Planner::Values& values, std::vector<double>& to, std::vector<bool>& set) {
  for (const auto& given : values) {
    const auto found =
        std::find_if(infos.begin(), infos.end(), [&](const auto& info) { return info.name == given.first; });
    if (found == infos.end()) return false;
    to[found - infos.begin()] = given.second;
    set[found - infos.begin()] = true;
  }
  return true;
}

}  // namespace

void Planner::pass(std::string_view part, std::string_view module_name, std::string label,
                   std::array<std::uint32_t, 3> invocations, std::array<std::uint32_t, 3> workgroup, const Values& parameters,
                   const Values& constants, const std::vector<std::pair<std::string_view, Slot>>& slots) {
  const Module* module = find_module(part, module_name);
  const std::string what = std::string(part) + "." + std::string(module_name);
  if (!module) return fail(Code::internal, "there is no module " + what);
  Pass pass;
  pass.module = module;
  pass.label = std::move(label);
  pass.workgroup = workgroup;
  for (int i = 0; i < 3; ++i) pass.groups[i] = (invocations[i] + workgroup[i] - 1) / workgroup[i];

  pass.parameters.resize(module->parameters.size());
  std::vector<bool> set(module->parameters.size());
  if (!assign(module->parameters, parameters, pass.parameters, set) || std::count(set.begin(), set.end(), false))
    return fail(Code::internal, "parameters do not match those of " + what);

  for (const ConstantInfo& info : module->constants) pass.constants.push_back(info.fallback);
  set.assign(module->constants.size(), false);
  if (!assign(module->constants, constants, pass.constants, set))
    return fail(Code::internal, "constants do not match those of " + what);

  pass.slots.resize(module->bindings.size());
  set.assign(module->bindings.size(), false);
  for (const auto& [name, slot] : slots)
    for (std::size_t i = 0; i < module->bindings.size(); ++i)
      if (module->bindings[i].name == name) {
        pass.slots[i] = slot;
        set[i] = true;
      }
  if (std::count(set.begin(), set.end(), false)) return fail(Code::internal, "bindings do not match those of " + what);
  plan_.passes.push_back(std::move(pass));
}

void Planner::counts(Slot slot, std::size_t first) {
  if (plan_.passes.empty()) return fail(Code::internal, "counts of no pass");
  plan_.passes.back().counts = Counts{slot, first};
}

Result<Plan> Planner::finish() && {
  if (!status_) return status_;
  std::size_t at = plan_.tables.size() * table_bytes;
  for (ScratchRegion& region : plan_.scratch) {
    region.offset = at;
    at = (at + region.count * bytes_per_pixel(region.format) + 1023) / 1024 * 1024;
  }
  plan_.scratch_bytes = at;
  return std::move(plan_);
}

Profile profile(const std::string& name) {
  Profile p;
  p.name = name;
  if (name == "pocl") {
    p.rows = {16, 1, 32, 1, {4, 4, 1}};
    p.columns = {16, 4, 32, 1, {64, 1, 1}};
    p.pixels = {16, 1, 8, 1, {8, 8, 1}};
    p.voxels = {0, 8, 0, 1, {8, 4, 1}};
  } else if (name == "lavapipe") {
    p.rows = {0, 10, 32, 0, {32, 1, 1}};
    p.columns = {0, 10, 32, 0, {128, 1, 1}};
    p.pixels = {0, 1, 8, 0, {256, 1, 1}};
    p.voxels = {0, 2, 0, 0, {32, 4, 1}};
    p.texels = true;
  } else if (name == "gpu" || name == "opencl_gpu") {
    p.rows = {0, 4, 32, 0, {32, 4, 1}};
    p.columns = {0, 4, 32, 0, {32, 4, 1}};
    p.pixels = {0, 1, 8, 0, {16, 16, 1}};
    p.voxels = {0, 1, 0, 0, {32, 4, 1}};
    p.workgroup_memory = true;
  } else {
    p.name = "reference";
    p.rows = p.columns = p.pixels = {16, 1, 0, 1, {16, 4, 1}};
    p.voxels = {0, 4, 0, 1, {16, 4, 1}};
  }
  return p;
}

}  // namespace luxel

#include <luxel/reference.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <thread>

#include "host/bindings.h"
#include "host/reference/dispatch.h"

namespace luxel::reference {

namespace {

std::size_t texel_bytes(Format format, Precision precision) {
  return precision == Precision::real32 || format == Format::u32 ? bytes_per_pixel(format) : channels(format) * sizeof(double);
}

std::string quantity(const std::string& kernel, const std::string& name, std::size_t has, std::size_t needs) {
  return kernel + ": binding " + name + " has " + std::to_string(has) + " bytes; needs at least " + std::to_string(needs);
}

// The module's shape is fixed when it is compiled; a plan for another profile would count its invocations wrongly.
Status check_shape(const Plan& plan) {
  for (const Pass& pass : plan.passes)
    for (std::size_t i = 0; i < pass.constants.size(); ++i) {
      const ConstantInfo& info = pass.module->constants[i];
      if (info.shape && pass.constants[i] != info.fallback)
        return {Code::invalid_argument, plan.kernel + ": the plan is not for the profile `reference` (" + std::string(info.name) +
                                            " is " + std::to_string(static_cast<long long>(pass.constants[i])) + "; expected " +
                                            std::to_string(static_cast<long long>(info.fallback)) + ")"};
    }
  return {};
}

// Runs workgroups on all threads, a chunk at a time.
void run_pass(const Pass& pass, Dispatch dispatch, Precision precision, int threads) {
  const auto run = precision == Precision::real32 ? pass.module->run_float : pass.module->run_double;
  const std::size_t total = static_cast<std::size_t>(dispatch.groups[0]) * dispatch.groups[1] * dispatch.groups[2];
  const std::size_t chunk = std::max<std::size_t>(1, total / (static_cast<std::size_t>(threads) * 16));
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (;;) {
      Dispatch part = dispatch;
      part.first = next.fetch_add(chunk);
      if (part.first >= total) return;
      part.last = std::min(total, part.first + chunk);
      run(part);
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < threads && static_cast<std::size_t>(i) < total; ++i) others.emplace_back(work);
  work();
}

}  // namespace

std::size_t resource_bytes(const Resource& resource, Precision precision) {
  if (resource.kind == ResourceKind::buffer)
    return resource.bytes / bytes_per_pixel(resource.format) * texel_bytes(resource.format, precision);
  return static_cast<std::size_t>(resource.extent[0]) * resource.extent[1] * resource.extent[2] *
         texel_bytes(resource.format, precision);
}

Status run(const Plan& plan, const std::vector<Binding>& bindings, Precision precision, int threads) {
  if (threads <= 0) threads = std::max(1u, std::thread::hardware_concurrency());
  if (Status status = check_shape(plan); !status) return status;

  std::vector<std::string_view> names;
  for (const Binding& binding : bindings) names.push_back(binding.name);
  const bool brought = std::find(names.begin(), names.end(), "scratch") != names.end();
  if (!brought && plan.scratch_bytes > 0) names.push_back("scratch");  // made below
  Result<std::vector<int>> matched = match(plan, names);
  if (!matched) return matched.status();
  const std::vector<int>& at = matched.value();
  Binding scratch;
  if (brought && at.back() >= 0) scratch = bindings[static_cast<std::size_t>(at.back())];
  std::vector<Memory> resources;
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const Resource& resource = plan.resources[i];
    const Binding& binding = bindings[static_cast<std::size_t>(at[i])];
    resources.push_back({binding.data, binding.bytes, resource.extent, resource.format, resource.address});
    if (!binding.data) return bad_binding(plan, resource.name, "has no data");
    const std::size_t needs = resource_bytes(resource, precision);
    if (binding.bytes < needs)
      return {Code::invalid_argument, quantity(plan.kernel, resource.name, binding.bytes, needs)};
  }
  const auto span_of = [&](int index) {
    const std::size_t i = static_cast<std::size_t>(index);
    if (i == resources.size()) return std::pair{static_cast<const char*>(scratch.data), plan.scratch_bytes};
    return std::pair{static_cast<const char*>(resources[i].data), resource_bytes(plan.resources[i], precision)};
  };
  for (const std::pair<int, int>& pair : exclusive(plan)) {
    const auto [a, a_bytes] = span_of(pair.first);
    const auto [b, b_bytes] = span_of(pair.second);
    if (a && b && a < b + b_bytes && b < a + a_bytes) return overlapping(plan, pair);
  }

  std::unique_ptr<std::byte[]> own;
  std::size_t own_bytes = 0;
  std::vector<std::size_t> offsets;
  for (const ScratchRegion& region : plan.scratch) {
    offsets.push_back(own_bytes);
    own_bytes += (region.count * texel_bytes(region.format, precision) + 255) / 256 * 256;
  }
  std::byte* base = nullptr;
  if (scratch.data && precision == Precision::real32) {
    if (scratch.bytes < plan.scratch_bytes)
      return {Code::invalid_argument, quantity(plan.kernel, "scratch", scratch.bytes, plan.scratch_bytes)};
    base = static_cast<std::byte*>(scratch.data);
    for (std::size_t i = 0; i < plan.scratch.size(); ++i) offsets[i] = plan.scratch[i].offset;
  } else if (own_bytes > 0) {
    own.reset(new (std::nothrow) std::byte[own_bytes]);
    if (!own) return {Code::out_of_memory, plan.kernel + ": no memory for " + std::to_string(own_bytes) + " bytes of scratch"};
    base = own.get();
  }

  std::vector<std::vector<float>> tables;
  for (const auto& table : plan.tables) tables.emplace_back(table.begin(), table.end());
  std::atomic<std::size_t> outside{0};
  for (const Pass& pass : plan.passes) {
    const auto memory_of = [&](const Slot& slot) {
      Memory part;
      if (slot.source == Slot::Source::resource) {
        part = resources[slot.index];
      } else if (slot.source == Slot::Source::scratch) {
        const ScratchRegion& region = plan.scratch[slot.index];
        part.data = base + offsets[slot.index];
        part.bytes = region.count * texel_bytes(region.format, precision);
        part.format = region.format;
      } else {
        const bool exact = precision == Precision::real64;
        part.data = exact ? static_cast<void*>(const_cast<double*>(plan.exact_tables[slot.index].data()))
                          : static_cast<void*>(tables[slot.index].data());
        part.bytes = plan.tables[slot.index].size() * (exact ? sizeof(double) : sizeof(float));
      }
      return part;
    };
    std::vector<Memory> memory;
    for (const Slot& slot : pass.slots) memory.push_back(memory_of(slot));
    Dispatch dispatch;
    dispatch.bindings = memory;
    dispatch.parameters = pass.parameters;
    dispatch.constants = pass.constants;
    for (int i = 0; i < 3; ++i) {
      dispatch.workgroup[i] = static_cast<int>(pass.workgroup[i]);
      dispatch.groups[i] = static_cast<int>(pass.groups[i]);
    }
    if (pass.counts) {
      std::array<std::uint32_t, 3> found{};
      const auto* from = static_cast<const std::byte*>(memory_of(pass.counts->slot).data) + 4 * pass.counts->first;
      std::memcpy(found.data(), from, sizeof found);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (found[axis] > pass.groups[axis])
          return {Code::internal, plan.kernel + ": pass " + pass.label + " finds " + std::to_string(found[axis]) +
                                      " workgroups; at most " + std::to_string(pass.groups[axis]) + " were planned"};
        dispatch.groups[axis] = static_cast<int>(found[axis]);
      }
    }
    dispatch.outside = &outside;
    run_pass(pass, dispatch, precision, threads);
    if (outside > 0)
      return {Code::internal, plan.kernel + ": pass " + pass.label + " made " + std::to_string(outside.load()) +
                                  " accesses outside its bindings; they were not carried out"};
  }
  return {};
}

}  // namespace luxel::reference

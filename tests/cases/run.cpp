#include "tests/cases/run.h"

#include <algorithm>
#include <chrono>

#include <luxel/reference.h>

#include "tests/cases/storage.h"

namespace luxel::cases {

Result<Run> Run::make(Context& context, const Result<Plan>& plan) {
  if (!plan) return plan.status();
  Run run;
  run.context_ = &context;
  run.plan_ = plan.value();
  const auto begin = std::chrono::steady_clock::now();
  Result<std::shared_ptr<Program>> program = context.compile(run.plan_);
  if (!program) return program.status();
  run.program_ = program.value();
  run.compile_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  for (const Resource& resource : run.plan_.resources) {
    Result<std::shared_ptr<Memory>> memory = context.make(resource);
    if (!memory) return memory.status();
    run.memory_.push_back(memory.value());
  }
  return run;
}

std::size_t Run::index(std::string_view name) const {
  const auto found = std::find_if(plan_.resources.begin(), plan_.resources.end(),
                                  [&](const Resource& resource) { return resource.name == name; });
  return static_cast<std::size_t>(found - plan_.resources.begin());
}

std::size_t Run::size(std::size_t i) const {
  return reference::resource_bytes(plan_.resources[i],
                                   context_->real64() ? reference::Precision::real64 : reference::Precision::real32);
}

Status Run::write(std::string_view name, std::span<const double> values) {
  const std::size_t i = index(name);
  if (i == memory_.size()) return {Code::invalid_argument, plan_.kernel + " has no resource " + std::string(name)};
  const std::vector<std::byte> data = store(values, plan_.resources[i].format, context_->real64());
  return context_->upload(*memory_[i], data.data(), data.size());
}

Result<std::vector<std::byte>> Run::bytes(std::string_view name) {
  const std::size_t i = index(name);
  if (i == memory_.size())
    return Status(Code::invalid_argument, plan_.kernel + " has no resource " + std::string(name));
  std::vector<std::byte> data(size(i));
  if (Status status = context_->download(*memory_[i], data.data(), data.size()); !status) return status;
  return data;
}

Result<std::vector<double>> Run::read(std::string_view name) {
  Result<std::vector<std::byte>> data = bytes(name);
  if (!data) return data.status();
  return fetch(data.value(), plan_.resources[index(name)].format, context_->real64());
}

void Run::alias(std::string_view name, std::string_view other) { memory_[index(name)] = memory_[index(other)]; }

Status Run::go(int repeat, Times* times) {
  std::vector<Named> named;
  for (std::size_t i = 0; i < memory_.size(); ++i) named.push_back({plan_.resources[i].name, memory_[i]});
  return context_->run_many(*program_, named, repeat, times);
}

std::size_t Run::memory_bytes() const {
  std::size_t total = plan_.scratch_bytes;
  for (const Resource& resource : plan_.resources)
    total += reference::resource_bytes(resource, reference::Precision::real32);
  return total;
}

}  // namespace luxel::cases

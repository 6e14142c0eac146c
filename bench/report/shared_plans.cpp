#include "bench/report/shared_plans.h"

#include <algorithm>

namespace luxel::report {

Status SharedPlans::put(const std::string& name, const void* data, std::size_t bytes, Format format) {
  Resource r{name};
  r.format = format;
  r.bytes = std::max<std::size_t>(bytes, 16);
  auto memory = context_.make(r);
  if (!memory) return memory.status();
  if (bytes > 0)
    if (Status s = context_.upload(*memory.value(), data, bytes); !s) return s;
  held_[name] = {memory.value(), r.bytes};
  return {};
}

Result<SharedPlans::Step> SharedPlans::step(const Result<Plan>& plan, const std::map<std::string, std::string>& names) {
  if (!plan) return plan.status();
  std::vector<std::pair<std::string, std::shared_ptr<Memory>>> bound;
  for (const Resource& r : plan.value().resources) {
    const auto other = names.find(r.name);
    const std::string& name = other == names.end() ? r.name : other->second;
    Held& held = held_[name];
    if (!held.memory) {
      auto memory = context_.make(r);
      if (!memory) return memory.status();
      held = {memory.value(), r.bytes};
    }
    if (held.bytes < r.bytes)
      return Status(Code::internal, "memory " + name + " has " + std::to_string(held.bytes) + " bytes; " +
                                        plan.value().kernel + " needs " + std::to_string(r.bytes));
    bound.emplace_back(r.name, held.memory);
  }
  auto program = context_.compile(plan.value());
  if (!program) return program.status();
  return Step([this, program = program.value(), bound]() -> Result<double> {
    std::vector<Named> resources;
    for (const auto& [name, memory] : bound) resources.push_back({name, memory});
    Times times;
    if (Status s = context_.run(*program, resources, &times); !s) return s;
    return times.total;
  });
}

Result<std::vector<std::uint8_t>> SharedPlans::read(const std::string& name) {
  const auto held = held_.find(name);
  if (held == held_.end()) return Status(Code::internal, "no memory is called " + name);
  std::vector<std::uint8_t> bytes(held->second.bytes);
  if (Status s = context_.download(*held->second.memory, bytes.data(), bytes.size()); !s) return s;
  return bytes;
}

SharedPlans::Step in_turn(std::vector<SharedPlans::Step> steps) {
  return [steps = std::move(steps)]() -> Result<double> {
    double ms = 0;
    for (const SharedPlans::Step& step : steps) {
      const Result<double> one = step();
      if (!one) return one;
      ms += one.value();
    }
    return ms;
  };
}

}  // namespace luxel::report

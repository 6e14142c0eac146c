#include "host/reference/context.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <mutex>
#include <new>

#include <luxel/reference.h>

#include "host/bindings.h"
#include "host/context.h"

namespace luxel::reference {
namespace {

DeviceInfo describe(int index) {
  const bool real64 = index == 1;
  return {index, Api::cpu, real64 ? "C++ double" : "C++ float", "luxel, compiled from the kernels' source", "reference",
          real64 ? "cpu:double" : "cpu:float"};
}

struct HeapMemory final : luxel::Memory {
  HeapMemory(const Context* owner, Resource resource, std::size_t bytes, std::unique_ptr<std::byte[]> data)
      : Memory(owner, std::move(resource), bytes), data(std::move(data)) {}
  const std::unique_ptr<std::byte[]> data;
};

struct CheckedPlan final : Program {
  CheckedPlan(const Context* owner, Plan plan, std::unique_ptr<std::byte[]> scratch)
      : Program(owner), plan(std::move(plan)), scratch(std::move(scratch)) {}
  const Plan plan;
  const std::unique_ptr<std::byte[]> scratch;  // null where the plan needs none, and in double
  std::mutex mutex;                            // held while it runs
};

class CppContext final : public Context {
 public:
  explicit CppContext(int index)
      : info_(describe(index)),
        profile_(luxel::profile(info_.profile)),
        precision_(index == 1 ? Precision::real64 : Precision::real32) {}

  const DeviceInfo& info() const override { return info_; }
  const Profile& profile() const override { return profile_; }
  bool real64() const override { return precision_ == Precision::real64; }

  Result<std::shared_ptr<luxel::Memory>> make(const Resource& resource, std::size_t bytes) override {
    for (const int side : resource.extent) {
      if (resource.kind != ResourceKind::buffer && side < 1)
        return Status(Code::invalid_argument, "Resource.extent of " + resource.name + " has a side of " +
                                                  std::to_string(side) + "; expected at least 1");
    }
    const std::size_t least = resource_bytes(resource, precision_);
    bytes = resource.kind == ResourceKind::buffer ? std::max({bytes, least, std::size_t{1}}) : least;
    std::unique_ptr<std::byte[]> data(new (std::nothrow) std::byte[bytes]);
    if (!data)
      return Status(Code::out_of_memory,
                    resource.name + " of " + std::to_string(bytes) + " bytes could not be made on " + info_.name);
    return std::shared_ptr<luxel::Memory>(
        std::make_shared<HeapMemory>(this, resource, bytes, std::move(data)));
  }

  Status upload(luxel::Memory& memory, const void* data, std::size_t bytes) override {
    if (Status status = check_copy(memory, bytes, "upload"); !status) return status;
    if (bytes > 0) std::memcpy(static_cast<HeapMemory&>(memory).data.get(), data, bytes);
    return {};
  }

  Status download(luxel::Memory& memory, void* data, std::size_t bytes) override {
    if (Status status = check_copy(memory, bytes, "download"); !status) return status;
    if (bytes > 0) std::memcpy(data, static_cast<HeapMemory&>(memory).data.get(), bytes);
    return {};
  }

  Result<std::shared_ptr<Program>> compile(const Plan& plan) override {
    if (Status status = check(plan); !status) return status;
    std::unique_ptr<std::byte[]> scratch;
    if (!real64() && plan.scratch_bytes > 0) {
      scratch.reset(new (std::nothrow) std::byte[plan.scratch_bytes]);
      if (!scratch)
        return Status(Code::out_of_memory, plan.kernel + ": scratch of " + std::to_string(plan.scratch_bytes) +
                                               " bytes could not be made on " + info_.name);
    }
    return std::shared_ptr<Program>(std::make_shared<CheckedPlan>(this, plan, std::move(scratch)));
  }

  Status run(Program& program, const std::vector<Named>& resources, Times* times) override {
    return run_many(program, resources, 1, times);
  }

  Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) override;

 private:
  Status check_copy(const luxel::Memory& memory, std::size_t bytes, const char* verb) const {
    const auto bad = [&](const std::string& what) {
      return Status(Code::invalid_argument, std::string(verb) + " of " + memory.resource.name + ": " + what);
    };
    if (memory.owner != this) return bad("its memory belongs to another device");
    if (memory.resource.kind != ResourceKind::buffer && bytes != memory.bytes)
      return bad(std::to_string(bytes) + " bytes; expected the image's " + std::to_string(memory.bytes));
    if (bytes > memory.bytes)
      return bad(std::to_string(bytes) + " bytes; expected at most " + std::to_string(memory.bytes));
    return {};
  }

  DeviceInfo info_;
  Profile profile_;
  Precision precision_;
};

Status CppContext::run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) {
  if (program.owner != this)
    return Status(Code::invalid_argument, "the program was compiled for another device than " + info_.name);
  auto& checked = static_cast<CheckedPlan&>(program);
  const std::lock_guard lock(checked.mutex);
  const Plan& plan = checked.plan;
  if (repeat < 1)
    return Status(Code::invalid_argument,
                  plan.kernel + ": repeat is " + std::to_string(repeat) + "; expected at least 1");
  if (Status status = check_memories(this, plan, resources); !status) return status;
  std::vector<Binding> bindings;
  bool own_scratch = checked.scratch != nullptr;
  for (const Named& named : resources) {
    own_scratch = own_scratch && named.name != "scratch";
    const std::size_t offset = offset_bytes(plan, named, real64());
    bindings.push_back(
        {named.name, static_cast<HeapMemory&>(*named.memory).data.get() + offset, named.memory->bytes - offset});
  }
  if (own_scratch) bindings.push_back({"scratch", checked.scratch.get(), plan.scratch_bytes});
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < repeat; ++i) {
    if (Status status = reference::run(plan, bindings, precision_); !status) return status;
  }
  if (times) {
    times->total = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    times->passes.clear();
  }
  return {};
}

}  // namespace

std::vector<DeviceInfo> list(std::string* problem) {
  if (problem) problem->clear();
  return {describe(0), describe(1)};
}

Result<std::shared_ptr<Context>> open(int index) {
  if (index != 0 && index != 1)
    return Status(Code::missing_driver, "C++ execution " + std::to_string(index) + " does not exist; expected 0 or 1");
  return std::shared_ptr<Context>(std::make_shared<CppContext>(index));
}

}  // namespace luxel::reference

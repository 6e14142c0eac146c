#include "host/vulkan/context.h"

#include "host/files.h"
#include "host/vulkan/program.h"

namespace luxel::vulkan {
namespace {

DeviceInfo info_of(const Physical& physical, int index) {
  return {index, Api::vulkan, physical.name, physical.driver, physical.profile, "vulkan:" + physical.name};
}

class DeviceContext final : public Context {
 public:
  DeviceContext(std::shared_ptr<Machine> machine, Device device, int index)
      : machine_(std::move(machine)), device_(std::move(device)), info_(info_of(machine_->about(), index)) {}

  const DeviceInfo& info() const override { return info_; }
  const Profile& profile() const override { return device_.profile(); }

  Result<std::shared_ptr<Memory>> make(const Resource& resource, std::size_t bytes) override {
    return DeviceMemory::make(this, machine_, resource, bytes);
  }
  Status upload(Memory& memory, const void* data, std::size_t bytes) override {
    if (Status status = check_owner(memory); !status) return status;
    return static_cast<DeviceMemory&>(memory).upload(data, bytes);
  }
  Status download(Memory& memory, void* data, std::size_t bytes) override {
    if (Status status = check_owner(memory); !status) return status;
    return static_cast<DeviceMemory&>(memory).download(data, bytes);
  }

  Result<std::shared_ptr<Program>> compile(const Plan& plan) override {
    return DeviceProgram::compile(this, machine_, device_, plan);
  }
  Status run(Program& program, const std::vector<Named>& resources, Times* times) override {
    return run_many(program, resources, 1, times);
  }
  Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) override {
    if (program.owner != this) {
      return {Code::invalid_argument, "program belongs to another device; expected one that this device compiled"};
    }
    return static_cast<DeviceProgram&>(program).run(resources, repeat, times);
  }

  std::vector<std::string> validation_messages() override { return take_validation_messages(); }

 private:
  Status check_owner(const Memory& memory) const {
    if (memory.owner == this) return {};
    return {Code::invalid_argument,
            "memory for " + memory.resource.name + " belongs to another device; expected memory of this one"};
  }

  std::shared_ptr<Machine> machine_;  // outlives device_
  Device device_;
  DeviceInfo info_;
};

}  // namespace

std::vector<DeviceInfo> list(std::string* problem) {
  const Result<std::unique_ptr<Instance>> instance = Instance::create();
  if (!instance) {
    if (problem) *problem = instance.status().message();
    return {};
  }
  std::vector<DeviceInfo> infos;
  for (VkPhysicalDevice device : instance.value()->devices()) {
    infos.push_back(info_of(describe(device), static_cast<int>(infos.size())));
  }
  return infos;
}

Result<std::shared_ptr<Context>> open(int physical_index) {
  Result<std::shared_ptr<Machine>> machine = Machine::open(physical_index);
  if (!machine) return machine.status();
  Adopt handles = machine.value()->handles();
  handles.cache_directory = cache_directory();
  Result<Device> device = Device::adopt(handles);
  if (!device) return device.status();
  return std::shared_ptr<Context>(
      std::make_shared<DeviceContext>(machine.value(), std::move(device).value(), physical_index));
}

}  // namespace luxel::vulkan

// A plan compiled for the small layer: its pipeline, scratch, and a command buffer recorded when bindings change.
#pragma once
#include <mutex>
#include <string>
#include <tuple>
#include <vector>

#include "host/context.h"
#include "host/vulkan/memory.h"

namespace luxel::vulkan {

class DeviceProgram final : public luxel::Program {
 public:
  static Result<std::shared_ptr<luxel::Program>> compile(const Context* owner,
                                                         const std::shared_ptr<Machine>& machine,
                                                         const Device& device, const Plan& plan);
  ~DeviceProgram() override;

  /// Runs `repeat` times in one submission and waits.
  Status run(const std::vector<Named>& resources, int repeat, Times* times);

 private:
  /// What the command buffer holds.
  struct Recorded {
    std::vector<std::tuple<std::string, std::uint64_t, std::size_t>> memories;  // name, DeviceMemory::id, Named::first
    int repeat = 0;                                               // 0: nothing is recorded
    bool timed = false;
    bool tables_current = false;

    bool operator==(const Recorded&) const = default;
  };

  DeviceProgram(const Context* owner, const std::shared_ptr<Machine>& machine, Pipeline pipeline);
  std::vector<Binding> bind(const std::vector<Named>& resources) const;
  Status record(const std::vector<Binding>& bindings, const Recorded& wanted);
  Status make_pools(int repeat, bool timed);
  Status read_times(int repeat, Times& times) const;
  void destroy_recorded();
  std::uint32_t queries_a_run() const { return static_cast<std::uint32_t>(pipeline_.plan().passes.size()) + 1; }

  std::mutex mutex_;
  std::shared_ptr<Machine> machine_;
  Pipeline pipeline_;
  Buffer scratch_;
  bool tables_current_ = false;  // scratch_ holds the plan's tables, from an earlier run
  Commands commands_;
  Recorded recorded_;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;  // this and the two below belong to what is recorded
  VkQueryPool queries_ = VK_NULL_HANDLE;
  std::vector<VkBufferView> views_;
};

}  // namespace luxel::vulkan

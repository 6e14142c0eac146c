// An engine of the tests' own on Vulkan: borrowed handles, memory at offsets between guard bands.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <luxel/gaussian_blur.h>

#include "host/vulkan/machine.h"
#include "host/vulkan/memory.h"
#include "tests/support/run.h"

namespace luxel::vulkan {

/// A variable of the environment, set as long as this lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// A device of the test's own, as an engine has one.
struct Engine {
  std::shared_ptr<Machine> machine;
  Device device;

  static Engine open(const std::string& cache_directory = {}) {
    Result<std::shared_ptr<Machine>> machine = Machine::open(0);
    if (!machine) throw std::runtime_error(machine.status().message());
    Adopt handles = machine.value()->handles();
    handles.cache_directory = cache_directory;
    Result<Device> device = Device::adopt(handles);
    if (!device) throw std::runtime_error(device.status().message());
    return {machine.value(), device.value()};
  }

  Plan plan(Input input = Input::buffer, int width = 67, int height = 45, double sigma = 2) const {
    GaussianBlurParams params;
    params.width = width;
    params.height = height;
    params.sigma = sigma;
    params.input = input;
    Result<Plan> result = luxel::plan(params, device.profile());
    if (!result) throw std::runtime_error(result.status().message());
    return result.value();
  }

  Pipeline pipeline(const Plan& plan) const {
    Result<Pipeline> result = Pipeline::create(device, plan);
    if (!result) throw std::runtime_error(result.status().message());
    return result.value();
  }

  std::shared_ptr<DeviceMemory> memory(const Resource& resource, std::size_t bytes = 0) const {
    auto result = DeviceMemory::make(nullptr, machine, resource, bytes);
    if (!result) throw std::runtime_error(result.status().message());
    return std::static_pointer_cast<DeviceMemory>(result.value());
  }

  std::shared_ptr<DeviceMemory> buffer(const std::string& name, std::size_t bytes) const {
    Resource resource;
    resource.name = name;
    return memory(resource, bytes);
  }
};

constexpr std::size_t margin = 512;  // guarded bytes before and behind every binding; a multiple of every alignment

/// What one record needs besides bindings: a pool of sets where they are not pushed, and a place for views.
struct Options {
  Options(const Engine& engine, const Pipeline& pipeline) : device(engine.machine->device()) {
    record.texel_views = &views;
    if (pipeline.pool_sizes().empty()) return;
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.maxSets = static_cast<std::uint32_t>(pipeline.plan().passes.size());
    info.poolSizeCount = static_cast<std::uint32_t>(pipeline.pool_sizes().size());
    info.pPoolSizes = pipeline.pool_sizes().data();
    EXPECT_EQ(vkCreateDescriptorPool(device, &info, nullptr, &record.pool), VK_SUCCESS);
  }
  ~Options() {
    vkDestroyDescriptorPool(device, record.pool, nullptr);
    for (VkBufferView view : views) vkDestroyBufferView(device, view, nullptr);
  }
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;

  VkDevice device;
  std::vector<VkBufferView> views;
  Record record;
};

/// A plan with all that one record of it binds, every buffer between two margins.
class Bound {
 public:
  Bound(const Engine& engine, const Plan& plan) : engine_(engine), plan_(plan) {
    for (const Resource& resource : plan.resources) {
      if (resource.kind == ResourceKind::buffer) {
        add_buffer(resource.name, resource.bytes);
      } else {
        memories_.push_back(engine.memory(resource));
        bindings.push_back(memories_.back()->binding(resource.name));
      }
      if (resource.name == "src") fill(memories_.back(), resource);
    }
    if (plan.scratch_bytes > 0) add_buffer("scratch", plan.scratch_bytes);
  }

  Binding& operator[](const std::string& name) {
    return *std::find_if(bindings.begin(), bindings.end(), [&](const Binding& b) { return b.name == name; });
  }

  /// Values into a buffer, between its margins.
  template <class T>
  void upload(const std::string& name, const std::vector<T>& values) {
    for (const auto& memory : memories_) {
      if (memory->resource.name != name) continue;
      std::vector<std::uint8_t> bytes(memory->bytes, guard_byte);
      std::memcpy(bytes.data() + margin, values.data(), sizeof(T) * values.size());
      EXPECT_TRUE(memory->upload(bytes.data(), bytes.size()).ok());
    }
  }

  /// Records with options of its own, submits and waits.
  Status run(const Pipeline& pipeline, bool indirect = false) const {
    Options options(engine_, pipeline);
    options.record.indirect = indirect;
    Status status;
    const Status ran = engine_.machine->once(
        [&](VkCommandBuffer commands) { status = pipeline.record(commands, bindings, options.record); });
    return status ? ran : status;
  }

  /// The bytes of a buffer. Fails the test where a margin of any buffer changed.
  std::vector<std::uint8_t> output(const std::string& name = "dst") {
    std::vector<std::uint8_t> result;
    for (const auto& memory : memories_) {
      if (memory->resource.kind != ResourceKind::buffer) continue;
      std::vector<std::uint8_t> all(memory->bytes);
      EXPECT_TRUE(memory->download(all.data(), all.size()).ok());
      for (std::size_t i = 0; i < margin; ++i) {
        if (all[i] == guard_byte && all[all.size() - margin + i] == guard_byte) continue;
        ADD_FAILURE() << memory->resource.name << " was written outside, near byte " << i << " of a margin";
        break;
      }
      if (memory->resource.name == name) result.assign(all.begin() + margin, all.end() - margin);
    }
    return result;
  }

  std::vector<Binding> bindings;

 private:
  void add_buffer(const std::string& name, std::size_t bytes) {
    memories_.push_back(engine_.buffer(name, bytes + 2 * margin));
    const std::vector<std::uint8_t> pattern(bytes + 2 * margin, guard_byte);
    EXPECT_TRUE(memories_.back()->upload(pattern.data(), pattern.size()).ok());
    Binding binding = memories_.back()->binding(memories_.back()->resource.name);
    binding.offset = margin;
    binding.bytes = bytes;
    bindings.push_back(binding);
  }

  void fill(const std::shared_ptr<DeviceMemory>& memory, const Resource& resource) {
    const std::size_t border = resource.kind == ResourceKind::buffer ? margin : 0;
    std::vector<std::uint8_t> bytes(memory->bytes, guard_byte);
    std::vector<float> values((memory->bytes - 2 * border) / 4);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5f + 0.5f * std::sin(static_cast<float>(i) * 0.37f);
    std::memcpy(bytes.data() + border, values.data(), 4 * values.size());
    EXPECT_TRUE(memory->upload(bytes.data(), bytes.size()).ok());
  }

  const Engine& engine_;
  const Plan plan_;
  std::vector<std::shared_ptr<DeviceMemory>> memories_;
};

/// One engine for all tests; after each, the validation layers must have been silent.
class VulkanTest : public testing::Test {
 protected:
  static void SetUpTestSuite() { engine_ = new Engine(Engine::open()); }
  static void TearDownTestSuite() {
    delete engine_;
    EXPECT_EQ(take_validation_messages(), std::vector<std::string>{});
  }
  void TearDown() override { EXPECT_EQ(take_validation_messages(), std::vector<std::string>{}); }

  static const Engine& engine() { return *engine_; }

  /// What `plan` gives with nothing special about it.
  static std::vector<std::uint8_t> expected(const Plan& plan) {
    Bound bound(engine(), plan);
    const Status status = bound.run(engine().pipeline(plan));
    EXPECT_TRUE(status.ok()) << status.message();
    return bound.output();
  }

 private:
  static inline Engine* engine_ = nullptr;
};

inline void expect_refusal(const Status& status, Code code, const std::string& part) {
  EXPECT_EQ(status.code(), code) << name(status.code()) << ": " << status.message();
  EXPECT_NE(status.message().find(part), std::string::npos) << status.message() << "\nexpected: " << part;
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
}

}  // namespace luxel::vulkan

// What the validation layers hold against how luxel uses Vulkan, beside what is forbidden.
#include <gtest/gtest.h>

#include "host/vulkan/context.h"
#include "tests/support/faulty_run.h"

namespace luxel {
namespace {

constexpr const char* harmless[] = {"specialuse-extension-debugging", "vkAllocateMemory-small-allocation",
                                    "vkBindMemory-small-dedicated-allocation", "TransitionUndefinedToReadOnly"};

TEST(VulkanBestPractices, AreKept) {
  setenv("LUXEL_VALIDATION", "best_practices", 1);
  for (const char* without_push : {"0", "1"}) {
    setenv("LUXEL_NO_PUSH_DESCRIPTOR", without_push, 1);
    for (const auto scenario : {&faults::sampled_blur, &faults::counted_steps}) {
      const Result<std::shared_ptr<Context>> context = vulkan::open(0);
      ASSERT_TRUE(context.ok()) << context.status().message();
      ASSERT_TRUE(faults::through(*context.value(), scenario(context.value()->profile())).ok());
      for (const std::string& message : context.value()->validation_messages()) {
        // Said of the layers' own extensions; of a layer that gives every resource an allocation of its own, which is for
        // tools; and of an image that the caller may bind without having filled it.
        const bool known = std::any_of(std::begin(harmless), std::end(harmless),
                                       [&](const char* id) { return message.find(id) != std::string::npos; });
        if (!known) ADD_FAILURE() << message;
      }
    }
  }
}

}  // namespace
}  // namespace luxel

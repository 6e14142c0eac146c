// Every Vulkan call of luxel's that can fail is made to: the promised code comes back, nothing is left over, and unless the
// device is lost the next run gives the right result.
#include <vulkan/vulkan.h>

#include <gtest/gtest.h>

#include "host/vulkan/context.h"
#include "tests/support/faulty_run.h"

namespace faults = luxel::faults;

#define FAULTY(name, parameters, arguments, made)                                              \
  extern "C" VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                  \
    if (faults::strikes(#name)) return static_cast<VkResult>(faults::answer);                  \
    const VkResult result = faults::next<std::remove_pointer_t<PFN_##name>>(#name) arguments;  \
    if (result == VK_SUCCESS) { made; }                                                        \
    return result;                                                                             \
  }
#define DESTROYS(name, kind, parameters, arguments, handle)                     \
  extern "C" VKAPI_ATTR void VKAPI_CALL name parameters {                       \
    if (handle) --faults::alive[kind];                                          \
    faults::next<std::remove_pointer_t<PFN_##name>>(#name) arguments;           \
  }
#define CREATES(name, Info, Handle)                                                                            \
  FAULTY(vkCreate##name, (VkDevice d, const Info* i, const VkAllocationCallbacks* a, Handle* h), (d, i, a, h), \
         ++faults::alive[#name])                                                                               \
  DESTROYS(vkDestroy##name, #name, (VkDevice d, Handle h, const VkAllocationCallbacks* a), (d, h, a), h)

CREATES(Buffer, VkBufferCreateInfo, VkBuffer)
CREATES(BufferView, VkBufferViewCreateInfo, VkBufferView)
CREATES(Image, VkImageCreateInfo, VkImage)
CREATES(ImageView, VkImageViewCreateInfo, VkImageView)
CREATES(Sampler, VkSamplerCreateInfo, VkSampler)
CREATES(ShaderModule, VkShaderModuleCreateInfo, VkShaderModule)
CREATES(PipelineCache, VkPipelineCacheCreateInfo, VkPipelineCache)
CREATES(PipelineLayout, VkPipelineLayoutCreateInfo, VkPipelineLayout)
CREATES(DescriptorSetLayout, VkDescriptorSetLayoutCreateInfo, VkDescriptorSetLayout)
CREATES(DescriptorPool, VkDescriptorPoolCreateInfo, VkDescriptorPool)
CREATES(QueryPool, VkQueryPoolCreateInfo, VkQueryPool)
CREATES(CommandPool, VkCommandPoolCreateInfo, VkCommandPool)
CREATES(Fence, VkFenceCreateInfo, VkFence)

FAULTY(vkCreateInstance, (const VkInstanceCreateInfo* i, const VkAllocationCallbacks* a, VkInstance* h), (i, a, h),
       ++faults::alive["Instance"])
FAULTY(vkCreateDevice, (VkPhysicalDevice p, const VkDeviceCreateInfo* i, const VkAllocationCallbacks* a, VkDevice* h), (p, i, a, h),
       ++faults::alive["Device"])
FAULTY(vkAllocateMemory, (VkDevice d, const VkMemoryAllocateInfo* i, const VkAllocationCallbacks* a, VkDeviceMemory* h), (d, i, a, h),
       ++faults::alive["Memory"])
FAULTY(vkEnumeratePhysicalDevices, (VkInstance i, uint32_t* n, VkPhysicalDevice* d), (i, n, d), )
FAULTY(vkBindBufferMemory, (VkDevice d, VkBuffer b, VkDeviceMemory m, VkDeviceSize o), (d, b, m, o), )
FAULTY(vkBindImageMemory, (VkDevice d, VkImage b, VkDeviceMemory m, VkDeviceSize o), (d, b, m, o), )
FAULTY(vkMapMemory, (VkDevice d, VkDeviceMemory m, VkDeviceSize o, VkDeviceSize n, VkMemoryMapFlags f, void** p), (d, m, o, n, f, p), )
FAULTY(vkAllocateCommandBuffers, (VkDevice d, const VkCommandBufferAllocateInfo* i, VkCommandBuffer* b), (d, i, b), )
FAULTY(vkAllocateDescriptorSets, (VkDevice d, const VkDescriptorSetAllocateInfo* i, VkDescriptorSet* s), (d, i, s), )
FAULTY(vkBeginCommandBuffer, (VkCommandBuffer b, const VkCommandBufferBeginInfo* i), (b, i), )
FAULTY(vkEndCommandBuffer, (VkCommandBuffer b), (b), )
FAULTY(vkResetCommandPool, (VkDevice d, VkCommandPool p, VkCommandPoolResetFlags f), (d, p, f), )
FAULTY(vkQueueSubmit, (VkQueue q, uint32_t n, const VkSubmitInfo* s, VkFence f), (q, n, s, f), )
FAULTY(vkWaitForFences, (VkDevice d, uint32_t n, const VkFence* f, VkBool32 all, uint64_t t), (d, n, f, all, t), )
FAULTY(vkResetFences, (VkDevice d, uint32_t n, const VkFence* f), (d, n, f), )
FAULTY(vkGetQueryPoolResults,
       (VkDevice d, VkQueryPool p, uint32_t first, uint32_t n, size_t bytes, void* to, VkDeviceSize stride, VkQueryResultFlags f),
       (d, p, first, n, bytes, to, stride, f), )
FAULTY(vkGetPipelineCacheData, (VkDevice d, VkPipelineCache c, size_t* n, void* to), (d, c, n, to), )

extern "C" VKAPI_ATTR VkResult VKAPI_CALL vkCreateComputePipelines(VkDevice d, VkPipelineCache c, uint32_t n,
                                                                   const VkComputePipelineCreateInfo* i,
                                                                   const VkAllocationCallbacks* a, VkPipeline* h) {
  if (faults::strikes("vkCreateComputePipelines")) {
    std::fill(h, h + n, VkPipeline{VK_NULL_HANDLE});  // as the specification has it
    return static_cast<VkResult>(faults::answer);
  }
  const VkResult result = faults::next<std::remove_pointer_t<PFN_vkCreateComputePipelines>>("vkCreateComputePipelines")(d, c, n, i, a, h);
  if (result == VK_SUCCESS) faults::alive["Pipeline"] += static_cast<int>(n);
  return result;
}
DESTROYS(vkDestroyPipeline, "Pipeline", (VkDevice d, VkPipeline h, const VkAllocationCallbacks* a), (d, h, a), h)
DESTROYS(vkFreeMemory, "Memory", (VkDevice d, VkDeviceMemory h, const VkAllocationCallbacks* a), (d, h, a), h)
DESTROYS(vkDestroyDevice, "Device", (VkDevice h, const VkAllocationCallbacks* a), (h, a), h)
DESTROYS(vkDestroyInstance, "Instance", (VkInstance h, const VkAllocationCallbacks* a), (h, a), h)

namespace luxel {
namespace {

class VulkanFaultsFull : public testing::TestWithParam<std::tuple<faults::Scenario (*)(const Profile&), bool>> {};

TEST_P(VulkanFaultsFull, GiveTheirCodeLeaveNothingAndPass) {
  const auto [scenario, push] = GetParam();
  setenv("LUXEL_NO_PUSH_DESCRIPTOR", push ? "0" : "1", 1);
  for (const auto& [fault, code] : {std::pair{VK_ERROR_OUT_OF_DEVICE_MEMORY, Code::out_of_memory},
                                    std::pair{VK_ERROR_DEVICE_LOST, Code::device_lost}}) {
    const faults::Outcome outcome = faults::every_call([] { return vulkan::open(0); }, scenario, fault, code,
                                                       {"vkCreateInstance", "vkEnumeratePhysicalDevices"});
    EXPECT_GE(outcome.refused.size(), 15u);
    // A cache that fails costs time only, a fence that cannot be used again is replaced.
    const std::set<std::string> harmless{"vkGetPipelineCacheData", "vkCreatePipelineCache", "vkResetFences"};
    for (const std::string& function : outcome.survived) EXPECT_EQ(harmless.count(function), 1u) << function;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryCall, VulkanFaultsFull,
                         testing::Combine(testing::Values(&faults::sampled_blur, &faults::counted_steps), testing::Bool()));

}  // namespace
}  // namespace luxel

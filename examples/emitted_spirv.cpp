// A kernel without luxel: what `luxel emit` wrote, bound and dispatched by its manifest on raw Vulkan. Nothing of luxel is
// included or linked; a JSON reader and the Vulkan loader are all there is. Kernels that bind images are left to engines.
//
//   luxel emit gaussian_blur --size 320x200 --options sigma=6 --format spirv -o blur
//   emitted_spirv blur/gaussian_blur.json src=in.raw dst=out.raw [--picture out.ppm WIDTH]
//
// RESOURCE=FILE: raw bytes, read into what the kernel reads, written from what it writes.
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

using nlohmann::json;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "emitted_spirv: %s\n", what.c_str());
  std::exit(1);
}
void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) fail(std::string(what) + " gave " + std::to_string(result));
}
std::vector<char> read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

VkDevice device;
VkPhysicalDevice physical;
std::uint32_t family;

struct Buffer {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize bytes = 0;
  char* data = nullptr;
};

// Memory that the host sees: an engine would have its own allocator, and upload.
Buffer make_buffer(VkDeviceSize bytes) {
  Buffer made;
  made.bytes = std::max<VkDeviceSize>(bytes, 4);
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = made.bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
  check(vkCreateBuffer(device, &info, nullptr, &made.buffer), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, made.buffer, &needs);
  VkPhysicalDeviceMemoryProperties types;
  vkGetPhysicalDeviceMemoryProperties(physical, &types);
  constexpr VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  VkMemoryAllocateInfo allocate{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  allocate.allocationSize = needs.size;
  while ((needs.memoryTypeBits >> allocate.memoryTypeIndex & 1) == 0 ||
         (types.memoryTypes[allocate.memoryTypeIndex].propertyFlags & wanted) != wanted)
    if (++allocate.memoryTypeIndex == types.memoryTypeCount) fail("no memory that the host sees");
  check(vkAllocateMemory(device, &allocate, nullptr, &made.memory), "vkAllocateMemory");
  check(vkBindBufferMemory(device, made.buffer, made.memory, 0), "vkBindBufferMemory");
  check(vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, reinterpret_cast<void**>(&made.data)), "vkMapMemory");
  std::memset(made.data, 0, made.bytes);
  return made;
}

// One shader of the manifest: its pipeline, made once for all passes that use it.
struct Shader {
  json about;
  VkShaderModule module = VK_NULL_HANDLE;
  VkDescriptorSetLayout sets = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

VkDescriptorType descriptor_of(const json& binding) {
  if (binding["kind"] == "storage_buffer") return VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
  if (binding["kind"] == "uniform_buffer") return VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  fail("binds a " + binding["kind"].get<std::string>() + ", which this example does not");
}

Shader make_shader(const json& about, const std::string& folder) {
  Shader made{about};
  const std::vector<char> code = read(folder + about["files"]["spirv"].get<std::string>());
  VkShaderModuleCreateInfo module{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  module.codeSize = code.size();
  module.pCode = reinterpret_cast<const std::uint32_t*>(code.data());
  check(vkCreateShaderModule(device, &module, nullptr, &made.module), "vkCreateShaderModule");
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const json& b : about["bindings"])
    bindings.push_back({b["binding"], descriptor_of(b), 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  VkDescriptorSetLayoutCreateInfo sets{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  sets.bindingCount = static_cast<std::uint32_t>(bindings.size());
  sets.pBindings = bindings.data();
  check(vkCreateDescriptorSetLayout(device, &sets, nullptr, &made.sets), "vkCreateDescriptorSetLayout");
  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, about["parameters"]["bytes"]};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &made.sets;
  layout.pushConstantRangeCount = push.size > 0;
  layout.pPushConstantRanges = &push;
  check(vkCreatePipelineLayout(device, &layout, nullptr, &made.layout), "vkCreatePipelineLayout");
  VkComputePipelineCreateInfo pipeline{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  pipeline.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, VK_SHADER_STAGE_COMPUTE_BIT, made.module,
                    "main", nullptr};  // constants that were left open (`constants`) would be specialised here
  pipeline.layout = made.layout;
  check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline, nullptr, &made.pipeline), "vkCreateComputePipelines");
  return made;
}

int main(int argc, char** argv) {
  if (argc < 2) fail("usage: emitted_spirv MANIFEST.json RESOURCE=FILE... [--picture FILE.ppm WIDTH]");
  const std::string path = argv[1], folder = path.substr(0, path.rfind('/') + 1);
  const std::vector<char> text = read(path);
  const json manifest = json::parse(text.begin(), text.end());

  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_1;
  VkInstanceCreateInfo create{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  create.pApplicationInfo = &application;
  VkInstance instance;
  check(vkCreateInstance(&create, nullptr, &instance), "vkCreateInstance");
  std::uint32_t count = 1;
  if (vkEnumeratePhysicalDevices(instance, &count, &physical) < 0 || count == 0) fail("no Vulkan device");
  count = 16;
  VkQueueFamilyProperties families[16];
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
  while (!(families[family].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++family;
  const float priority = 1;
  VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
  VkDeviceCreateInfo make_device{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  make_device.queueCreateInfoCount = 1;
  make_device.pQueueCreateInfos = &queues;
  check(vkCreateDevice(physical, &make_device, nullptr, &device), "vkCreateDevice");
  VkQueue queue;
  vkGetDeviceQueue(device, family, 0, &queue);

  // Everything that passes name: the caller's resources, scratch, tables.
  std::map<std::string, Buffer> buffers;
  for (const json& r : manifest["resources"])
    if (r["kind"] == "buffer") buffers[r["name"]] = make_buffer(r["bytes"]);
  for (const json& s : manifest["scratch"]) buffers[s["name"]] = make_buffer(s["bytes"]);
  for (const json& t : manifest["tables"]) {
    Buffer& table = buffers[t["name"]] = make_buffer(t["bytes"]);
    float* to = reinterpret_cast<float*>(table.data);
    for (const double value : t["values"]) *to++ = static_cast<float>(value);
  }
  std::map<std::string, std::string> files;
  std::string picture;
  int width = 0;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--picture" && i + 2 < argc) {
      picture = argv[i + 1], width = std::atoi(argv[i + 2]), i += 2;
      continue;
    }
    const std::size_t at = word.find('=');
    if (at == std::string::npos || !buffers.count(word.substr(0, at))) fail("no resource in " + word);
    files[word.substr(0, at)] = word.substr(at + 1);
  }
  for (const json& r : manifest["resources"]) {
    const std::string name = r["name"];
    if (r["written"] || !files.count(name)) continue;
    const std::vector<char> bytes = read(files[name]);
    if (bytes.size() != buffers[name].bytes) fail(files[name] + " does not have the bytes of " + name);
    std::memcpy(buffers[name].data, bytes.data(), bytes.size());
  }

  std::map<std::string, Shader> shaders;
  for (const json& s : manifest["shaders"]) shaders[s["name"]] = make_shader(s, folder);
  const auto passes = static_cast<std::uint32_t>(manifest["passes"].size());
  const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 16 * passes},
                                        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 4 * passes}};
  VkDescriptorPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, passes, 2, sizes};
  VkDescriptorPool pool;
  check(vkCreateDescriptorPool(device, &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
  VkCommandPoolCreateInfo commands_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, family};
  VkCommandPool command_pool;
  check(vkCreateCommandPool(device, &commands_info, nullptr, &command_pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, command_pool,
                                       VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  VkCommandBuffer commands;
  check(vkAllocateCommandBuffers(device, &allocate, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  for (const json& pass : manifest["passes"]) {
    const Shader& shader = shaders.at(pass["shader"]);
    VkDescriptorSetAllocateInfo set_info{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO, nullptr, pool, 1, &shader.sets};
    VkDescriptorSet set;
    check(vkAllocateDescriptorSets(device, &set_info, &set), "vkAllocateDescriptorSets");
    for (const json& b : shader.about["bindings"]) {
      const std::string what = pass["bind"][b["name"].get<std::string>()];
      const VkDescriptorBufferInfo whole{buffers.at(what).buffer, 0, VK_WHOLE_SIZE};
      VkWriteDescriptorSet write{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
      write.dstSet = set;
      write.dstBinding = b["binding"];
      write.descriptorCount = 1;
      write.descriptorType = descriptor_of(b);
      write.pBufferInfo = &whole;
      vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    }
    std::vector<char> push(shader.about["parameters"]["bytes"].get<std::size_t>());
    for (const json& m : shader.about["parameters"]["members"]) {
      const double value = pass["parameters"][m["name"].get<std::string>()]["value"];
      const float as_float = static_cast<float>(value);
      const auto as_int = static_cast<std::int64_t>(value);  // its low four bytes are the i32 or u32
      std::memcpy(&push[m["offset"]], m["type"] == "f32" ? static_cast<const void*>(&as_float) : &as_int, 4);
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, shader.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, shader.layout, 0, 1, &set, 0, nullptr);
    if (!push.empty())
      vkCmdPushConstants(commands, shader.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, static_cast<std::uint32_t>(push.size()),
                         push.data());
    vkCmdDispatch(commands, pass["groups"][0], pass["groups"][1], pass["groups"][2]);
    // Each pass sees what the one before wrote, and the host what the last one did.
    const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_SHADER_WRITE_BIT,
                                  VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                         VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
  }
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  check(vkQueueWaitIdle(queue), "vkQueueWaitIdle");

  for (const json& r : manifest["resources"]) {
    const std::string name = r["name"];
    if (!r["written"]) continue;
    const Buffer& from = buffers.at(name);
    if (files.count(name)) std::ofstream(files[name], std::ios::binary).write(from.data, static_cast<std::streamsize>(from.bytes));
    if (picture.empty() || r["format"] != "f32x4" || width < 1) continue;
    const auto* v = reinterpret_cast<const float*>(from.data);
    const int height = static_cast<int>(from.bytes / 16) / width;
    std::ofstream out(picture, std::ios::binary);
    out << "P6 " << width << ' ' << height << " 255\n";
    for (int i = 0; i < width * height; ++i)
      for (int c = 0; c < 3; ++c) {
        const float light = std::clamp(v[4 * i + c], 0.0f, 1.0f);  // as a screen shows it: the sRGB curve
        const float shown = light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f;
        out.put(static_cast<char>(static_cast<int>(255 * shown + 0.5f)));
      }
    picture.clear();
  }

  vkDestroyCommandPool(device, command_pool, nullptr);
  vkDestroyDescriptorPool(device, pool, nullptr);
  for (const auto& [name, s] : shaders) {
    vkDestroyPipeline(device, s.pipeline, nullptr);
    vkDestroyPipelineLayout(device, s.layout, nullptr);
    vkDestroyDescriptorSetLayout(device, s.sets, nullptr);
    vkDestroyShaderModule(device, s.module, nullptr);
  }
  for (const auto& [name, b] : buffers) {
    vkDestroyBuffer(device, b.buffer, nullptr);
    vkFreeMemory(device, b.memory, nullptr);
  }
  vkDestroyDevice(device, nullptr);
  vkDestroyInstance(instance, nullptr);
}

// luxel in an engine of one's own on Vulkan: the engine's device, its memory, its command buffers, its descriptor pools, its
// timeline. Each frame draws a G-buffer into images and records three kernels behind it, with two frames in flight:
//   bilateral      what was traced with few samples is denoised, guided by depth
//   gaussian_blur  the colour image, blurred for bloom
//   mip_build      the pyramid of nearest depths that hiz_ssr and culling read, from the depth image
// Then the last frames are compared with the C++ execution, bit for bit, and shown.
//
//   vulkan_engine [PICTURE.ppm]
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <string>
#include <vector>

#include <luxel/bilateral.h>
#include <luxel/gaussian_blur.h>
#include <luxel/mip_build.h>
#include <luxel/reference.h>
#include <luxel/vulkan.h>

namespace {

constexpr int width = 320, height = 200;
constexpr std::size_t pixels = static_cast<std::size_t>(width) * height;
constexpr int frames = 5, in_flight = 2;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "vulkan_engine: %s\n", what.c_str());
  std::exit(1);
}
void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) fail(std::string(what) + " gave " + std::to_string(result));
}
void check(const luxel::Status& status) {
  if (!status) fail(status.message());
}
template <class T> T take(luxel::Result<T> result) {
  if (!result) fail(result.status().message());
  return std::move(result).value();
}

// ---- The engine: what it has with or without luxel.

VkInstance instance;
VkPhysicalDevice physical;
VkDevice device;
VkQueue queue;
std::uint32_t family;

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize bytes = 0;
  char* data = nullptr;
};
struct Image {
  VkImage handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
};

void open_device() {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_2;  // timeline semaphores
  VkInstanceCreateInfo create{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  create.pApplicationInfo = &application;
  check(vkCreateInstance(&create, nullptr, &instance), "vkCreateInstance");
  std::uint32_t count = 1;
  if (vkEnumeratePhysicalDevices(instance, &count, &physical) < 0 || count == 0) fail("there is no Vulkan device");
  VkQueueFamilyProperties families[16];
  count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
  while (family + 1 < count && !(families[family].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++family;
  const float priority = 1;
  VkDeviceQueueCreateInfo queues{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, family, 1, &priority};
  VkPhysicalDeviceVulkan12Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
  features.timelineSemaphore = VK_TRUE;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queues;
  check(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
  vkGetDeviceQueue(device, family, 0, &queue);
}

VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
  VkPhysicalDeviceMemoryProperties types;
  vkGetPhysicalDeviceMemoryProperties(physical, &types);
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, 0};
  while ((needs.memoryTypeBits >> info.memoryTypeIndex & 1) == 0 ||
         (types.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted)
    if (++info.memoryTypeIndex == types.memoryTypeCount) fail("no memory of the kind that is wanted");
  VkDeviceMemory memory;
  check(vkAllocateMemory(device, &info, nullptr, &memory), "vkAllocateMemory");
  return memory;
}

// Seen by the host, so that this example needs no uploads; what kernels alone touch would lie in device memory.
Buffer make_buffer(VkDeviceSize bytes) {
  Buffer made;
  made.bytes = bytes;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = bytes;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |  // tables in scratch
               VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT |                                 // where reads_texels()
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  check(vkCreateBuffer(device, &info, nullptr, &made.handle), "vkCreateBuffer");
  VkMemoryRequirements needs;
  vkGetBufferMemoryRequirements(device, made.handle, &needs);
  made.memory = allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device, made.handle, made.memory, 0), "vkBindBufferMemory");
  check(vkMapMemory(device, made.memory, 0, VK_WHOLE_SIZE, 0, reinterpret_cast<void**>(&made.data)), "vkMapMemory");
  return made;
}

Image make_image(VkFormat format) {
  Image made;
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {width, height, 1};
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  check(vkCreateImage(device, &info, nullptr, &made.handle), "vkCreateImage");
  VkMemoryRequirements needs;
  vkGetImageMemoryRequirements(device, made.handle, &needs);
  made.memory = allocate(needs, 0);
  check(vkBindImageMemory(device, made.handle, made.memory, 0), "vkBindImageMemory");
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = made.handle;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  check(vkCreateImageView(device, &view, nullptr, &made.view), "vkCreateImageView");
  return made;
}

void destroy(const Buffer& b) {
  vkDestroyBuffer(device, b.handle, nullptr);
  vkFreeMemory(device, b.memory, nullptr);
}
void destroy(const Image& i) {
  vkDestroyImageView(device, i.view, nullptr);
  vkDestroyImage(device, i.handle, nullptr);
  vkFreeMemory(device, i.memory, nullptr);
}

void move(VkCommandBuffer commands, const Image& image, VkImageLayout from, VkImageLayout to, VkAccessFlags written,
          VkAccessFlags used, VkPipelineStageFlags before, VkPipelineStageFlags after) {
  VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, written, used, from, to,
                               VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED, image.handle,
                               {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
  vkCmdPipelineBarrier(commands, before, after, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

// ---- The scene: a floor and lamps that turn, with the noise of one sample a pixel.

void draw(int frame, std::vector<float>& colour, std::vector<float>& depth) {
  colour.assign(4 * pixels, 1.0f);
  depth.assign(pixels, 0.0f);
  std::uint32_t random = 17u + static_cast<std::uint32_t>(frame);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      float z = 12.0f - 8.0f * static_cast<float>(y) / height;  // the floor comes nearer
      float light[3] = {0.18f, 0.20f, 0.24f};
      for (int ball = 0; ball < 5; ++ball) {
        const float turn = 1.2566f * static_cast<float>(ball) + 0.2f * static_cast<float>(frame);
        const float cx = width * (0.5f + 0.36f * std::cos(turn)), cy = height * (0.5f + 0.3f * std::sin(turn));
        const float d = ((x - cx) * (x - cx) + (y - cy) * (y - cy)) / (24.0f * 24.0f);
        if (d >= 1.0f) continue;
        z = 3.0f - std::sqrt(1.0f - d);
        const float power = ball == 0 ? 6.0f : 0.8f;  // one of them shines
        for (int c = 0; c < 3; ++c) light[c] = power * (0.3f + 0.7f * static_cast<float>((ball + c) % 3) / 2);
      }
      random = random * 1664525u + 1013904223u;
      const float sample = 0.4f + 1.2f * static_cast<float>(random >> 8) / 16777216.0f;
      for (int c = 0; c < 3; ++c) colour[4 * i + static_cast<std::size_t>(c)] = light[c] * sample;
      depth[i] = z;
    }
}

// ---- The kernels: what luxel needs of the engine.

luxel::BilateralParams denoise() {
  luxel::BilateralParams p;
  p.width = width, p.height = height;
  p.sigma_space = 2, p.sigma_range = 2;
  p.depth = luxel::DepthTerm::plane;
  p.footprint = 0.005;
  return p;
}
luxel::GaussianBlurParams bloom() {
  luxel::GaussianBlurParams p;
  p.width = width, p.height = height;
  p.sigma = 8;
  p.input = luxel::Input::image;  // the G-buffer's colour as it is
  return p;
}
luxel::MipBuildParams nearest() {
  luxel::MipBuildParams p;
  p.width = width, p.height = height;
  p.variant = luxel::MipVariant::min;
  p.format = luxel::Format::f32x1;
  p.input = luxel::Input::image;
  return p;
}
constexpr int kernels = 3;

luxel::Result<luxel::Plan> plan_of(int kernel, const luxel::Profile& profile) {
  return kernel == 0 ? luxel::plan(denoise(), profile) : kernel == 1 ? luxel::plan(bloom(), profile) : luxel::plan(nearest(), profile);
}

// What one frame in flight has to itself.
struct Slot {
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkDescriptorPool descriptors = VK_NULL_HANDLE;
  std::vector<VkBufferView> views;            // made by record, destroyed once the frame is through
  Buffer colour_upload, depth_upload;         // a renderer draws; this one copies
  Image colour, depth;
  std::deque<Buffer> buffers[kernels];        // by resource of the plan, then scratch
  std::vector<luxel::vulkan::Binding> bound[kernels];
  int frame = -1;                             // that it holds
};

// The same with the C++ execution; results by name.
std::vector<std::vector<char>> reference(int kernel, const std::vector<float>& colour, const std::vector<float>& depth) {
  const luxel::Plan plan = take(plan_of(kernel, luxel::profile("reference")));
  std::vector<std::vector<char>> memory;
  std::vector<luxel::reference::Binding> bindings;
  for (const luxel::Resource& r : plan.resources) {
    memory.emplace_back(luxel::reference::resource_bytes(r, luxel::reference::Precision::real32));
    const auto& from = r.name == "src" ? colour : depth;
    if (!r.written) std::memcpy(memory.back().data(), from.data(), memory.back().size());
  }
  for (std::size_t i = 0; i < memory.size(); ++i) bindings.push_back({plan.resources[i].name, memory[i].data(), memory[i].size()});
  check(luxel::reference::run(plan, bindings));
  return memory;
}

}  // namespace

int main(int argc, char** argv) {
  open_device();

  // luxel borrows the device. Push descriptors are not enabled here, so that sets come from the engine's pools.
  luxel::vulkan::Adopt adopt;
  adopt.instance = instance, adopt.physical = physical, adopt.device = device;
  auto borrowed = take(luxel::vulkan::Device::adopt(adopt));
  std::vector<luxel::vulkan::Pipeline> pipelines;  // compiled ahead: no frame waits for a compiler
  for (int k = 0; k < kernels; ++k)
    pipelines.push_back(take(luxel::vulkan::Pipeline::create(borrowed, take(plan_of(k, borrowed.profile())))));

  // Descriptors for one frame: what each pipeline takes for one record.
  std::vector<VkDescriptorPoolSize> sizes;
  std::uint32_t sets = 0;
  for (const auto& pipeline : pipelines) {
    sizes.insert(sizes.end(), pipeline.pool_sizes().begin(), pipeline.pool_sizes().end());
    sets += static_cast<std::uint32_t>(pipeline.plan().passes.size());
  }

  VkSemaphoreTypeCreateInfo timeline_type{VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO, nullptr, VK_SEMAPHORE_TYPE_TIMELINE, 0};
  VkSemaphoreCreateInfo timeline_info{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, &timeline_type, 0};
  VkSemaphore timeline;
  check(vkCreateSemaphore(device, &timeline_info, nullptr, &timeline), "vkCreateSemaphore");

  Slot slots[in_flight];
  for (Slot& slot : slots) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, family};
    check(vkCreateCommandPool(device, &pool, nullptr, &slot.pool), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr, slot.pool,
                                       VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    check(vkAllocateCommandBuffers(device, &buffer, &slot.commands), "vkAllocateCommandBuffers");
    VkDescriptorPoolCreateInfo descriptors{VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO, nullptr, 0, sets,
                                           static_cast<std::uint32_t>(sizes.size()), sizes.data()};
    check(vkCreateDescriptorPool(device, &descriptors, nullptr, &slot.descriptors), "vkCreateDescriptorPool");
    slot.colour_upload = make_buffer(16 * pixels), slot.depth_upload = make_buffer(4 * pixels);
    slot.colour = make_image(VK_FORMAT_R32G32B32A32_SFLOAT), slot.depth = make_image(VK_FORMAT_R32_SFLOAT);
    for (int k = 0; k < kernels; ++k) {
      const luxel::Plan& plan = pipelines[static_cast<std::size_t>(k)].plan();
      for (const luxel::Resource& r : plan.resources) {
        luxel::vulkan::Binding binding;
        binding.name = r.name;
        if (r.kind == luxel::ResourceKind::buffer) {
          slot.buffers[k].push_back(make_buffer(r.bytes));
          binding.buffer = slot.buffers[k].back().handle, binding.bytes = r.bytes;
        } else {
          slot.buffers[k].emplace_back();
          binding.view = (k == 1 ? slot.colour : slot.depth).view;
          binding.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
        }
        slot.bound[k].push_back(binding);
      }
      if (plan.scratch_bytes == 0) continue;
      slot.buffers[k].push_back(make_buffer(plan.scratch_bytes));  // what kernels keep between their passes
      slot.bound[k].push_back({"scratch", slot.buffers[k].back().handle, 0, plan.scratch_bytes, VK_NULL_HANDLE});
    }
  }

  std::vector<float> colour, depth;
  for (int frame = 0; frame < frames; ++frame) {
    Slot& slot = slots[frame % in_flight];
    // The frame that had this slot is through once the timeline says so; the one before this may still run.
    const std::uint64_t through = frame >= in_flight ? static_cast<std::uint64_t>(frame - in_flight + 1) : 0;
    VkSemaphoreWaitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO, nullptr, 0, 1, &timeline, &through};
    check(vkWaitSemaphores(device, &wait, UINT64_MAX), "vkWaitSemaphores");
    for (VkBufferView view : slot.views) vkDestroyBufferView(device, view, nullptr);
    slot.views.clear();
    check(vkResetCommandPool(device, slot.pool, 0), "vkResetCommandPool");
    check(vkResetDescriptorPool(device, slot.descriptors, 0), "vkResetDescriptorPool");
    draw(frame, colour, depth);
    std::memcpy(slot.colour_upload.data, colour.data(), 16 * pixels);
    std::memcpy(slot.depth_upload.data, depth.data(), 4 * pixels);
    slot.frame = frame;

    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
    const VkBufferImageCopy whole{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {width, height, 1}};
    for (const auto& [image, from] : {std::pair{&slot.colour, &slot.colour_upload}, {&slot.depth, &slot.depth_upload}}) {
      move(slot.commands, *image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
           VK_ACCESS_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT);
      vkCmdCopyBufferToImage(slot.commands, from->handle, image->handle, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &whole);
      move(slot.commands, *image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
           VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_SHADER_READ_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT,
           VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT);
    }
    // bilateral reads buffers: it gets what was uploaded.
    for (std::size_t i = 0; i < pipelines[0].plan().resources.size(); ++i) {
      const luxel::Resource& r = pipelines[0].plan().resources[i];
      if (r.written) continue;
      const VkBufferCopy copy{0, 0, r.bytes};
      vkCmdCopyBuffer(slot.commands, (r.name == "src" ? slot.colour_upload : slot.depth_upload).handle,
                      slot.buffers[0][i].handle, 1, &copy);
    }
    // luxel records no barriers at its edges: these are the engine's.
    const VkMemoryBarrier uploaded{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT,
                                   VK_ACCESS_SHADER_READ_BIT};
    vkCmdPipelineBarrier(slot.commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, 0, 1, &uploaded, 0,
                         nullptr, 0, nullptr);
    luxel::vulkan::Record record;
    record.pool = slot.descriptors;
    record.texel_views = &slot.views;
    record.tables_current = frame >= in_flight;  // weights lie in this slot's scratch since its first frame
    for (int k = 0; k < kernels; ++k)            // they share nothing that is written: no barrier between them
      check(pipelines[static_cast<std::size_t>(k)].record(slot.commands, slot.bound[k], record));
    const VkMemoryBarrier results{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(slot.commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &results, 0,
                         nullptr, 0, nullptr);
    check(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");

    const std::uint64_t done = static_cast<std::uint64_t>(frame) + 1;
    VkTimelineSemaphoreSubmitInfo signal{VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO};
    signal.signalSemaphoreValueCount = 1;
    signal.pSignalSemaphoreValues = &done;
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO, &signal};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &slot.commands;
    submit.signalSemaphoreCount = 1;
    submit.pSignalSemaphores = &timeline;
    check(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE), "vkQueueSubmit");
  }
  check(vkDeviceWaitIdle(device), "vkDeviceWaitIdle");

  // Both frames that were in flight last, against the C++ execution.
  int status = 0;
  for (const Slot& slot : slots) {
    draw(slot.frame, colour, depth);
    for (int k = 0; k < kernels; ++k) {
      const luxel::Plan& plan = pipelines[static_cast<std::size_t>(k)].plan();
      const auto expected = reference(k, colour, depth);
      for (std::size_t i = 0; i < plan.resources.size(); ++i)
        if (plan.resources[i].written && std::memcmp(expected[i].data(), slot.buffers[k][i].data, expected[i].size()) != 0) {
          std::fprintf(stderr, "frame %d: %s of %s differs from the C++ execution\n", slot.frame, plan.resources[i].name.c_str(),
                       plan.kernel.c_str());
          status = 1;
        }
    }
  }
  if (status == 0) std::printf("frames %d and %d: three kernels, the bits of the C++ execution\n", slots[0].frame, slots[1].frame);
  if (argc > 1) {
    const auto written = [&](int k) {
      const auto& resources = pipelines[static_cast<std::size_t>(k)].plan().resources;
      for (std::size_t i = 0; i < resources.size(); ++i)
        if (resources[i].written) return reinterpret_cast<const float*>(slots[0].buffers[k][i].data);
      return static_cast<const float*>(nullptr);
    };
    const float *clean = written(0), *glow = written(1);
    std::FILE* out = std::fopen(argv[1], "wb");
    if (!out) fail(std::string("cannot write ") + argv[1]);
    std::fprintf(out, "P6 %d %d 255\n", width, height);
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = std::clamp(0.7f * clean[4 * i + c] + 0.3f * glow[4 * i + c], 0.0f, 1.0f);
        std::fputc(static_cast<int>(255 * (light <= 0.0031308f ? 12.92f * light : 1.055f * std::pow(light, 1 / 2.4f) - 0.055f) + 0.5f), out);
      }
    if (std::fclose(out) != 0) fail(std::string("cannot write ") + argv[1]);
  }

  for (Slot& slot : slots) {
    for (VkBufferView view : slot.views) vkDestroyBufferView(device, view, nullptr);
    for (auto& buffers : slot.buffers)
      for (const Buffer& b : buffers) destroy(b);
    for (const Buffer& b : {slot.colour_upload, slot.depth_upload}) destroy(b);
    for (const Image& i : {slot.colour, slot.depth}) destroy(i);
    vkDestroyDescriptorPool(device, slot.descriptors, nullptr);
    vkDestroyCommandPool(device, slot.pool, nullptr);
  }
  vkDestroySemaphore(device, timeline, nullptr);
  pipelines.clear();
  borrowed = {};  // luxel's pipelines go before the device they were made with
  vkDestroyDevice(device, nullptr);
  vkDestroyInstance(instance, nullptr);
  return status;
}

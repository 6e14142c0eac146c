#include "host/vulkan/memory.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "host/vulkan/result.h"

namespace luxel::vulkan {
namespace {

constexpr VkMemoryPropertyFlags host_memory =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

Status allocate(const Machine& machine, const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags,
                const std::string& what, VkDeviceMemory& memory) {
  const int type = machine.memory_type(needs.memoryTypeBits, flags);
  if (type < 0) return {Code::unsupported, "vulkan: " + machine.about().name + " has no memory for " + what};
  auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = needs.size;
  info.memoryTypeIndex = static_cast<std::uint32_t>(type);
  if (const VkResult result = vkAllocateMemory(machine.device(), &info, nullptr, &memory)) {
    return failure("vulkan: allocating " + std::to_string(needs.size) + " bytes for " + what, result);
  }
  return {};
}

Status make_buffer(const std::shared_ptr<Machine>& machine, std::size_t bytes, VkBufferUsageFlags usage, bool host,
                   const std::string& what, Buffer& buffer) {
  buffer.machine = machine;
  const VkDevice device = machine->device();
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = bytes;
  info.usage = usage;
  if (const VkResult result = vkCreateBuffer(device, &info, nullptr, &buffer.handle)) {
    return failure("vulkan: a buffer of " + std::to_string(bytes) + " bytes for " + what, result);
  }
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device, buffer.handle, &needs);
  VkMemoryPropertyFlags flags = host_memory;
  if (!host) {
    const VkMemoryPropertyFlags shared =
        VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT | host_memory;
    flags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    if (machine->memory_type(needs.memoryTypeBits, shared) >= 0) flags = shared;
  }
  if (Status status = allocate(*machine, needs, flags, what, buffer.memory); !status) return status;
  if (const VkResult result = vkBindBufferMemory(device, buffer.handle, buffer.memory, 0)) {
    return failure("vulkan: vkBindBufferMemory for " + what, result);
  }
  if (!(flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) return {};
  if (const VkResult result = vkMapMemory(device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &buffer.mapped)) {
    return failure("vulkan: vkMapMemory for " + what, result);
  }
  return {};
}

Status make_staging(const std::shared_ptr<Machine>& machine, std::size_t bytes, Buffer& buffer) {
  return make_buffer(machine, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, true,
                     "a copy from or to the host", buffer);
}

}  // namespace

Buffer::~Buffer() {
  if (!machine) return;
  vkDestroyBuffer(machine->device(), handle, nullptr);
  vkFreeMemory(machine->device(), memory, nullptr);
}

Status make_storage(const std::shared_ptr<Machine>& machine, std::size_t bytes, const std::string& what,
                    Buffer& buffer) {
  return make_buffer(machine, bytes,
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                         VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                         VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                     false, what, buffer);
}

DeviceMemory::DeviceMemory(const Context* owner, const Resource& resource, std::size_t bytes)
    : luxel::Memory(owner, resource, bytes) {
  static std::atomic<std::uint64_t> next{0};
  id_ = ++next;
}

Result<std::shared_ptr<luxel::Memory>> DeviceMemory::make(const Context* owner,
                                                          const std::shared_ptr<Machine>& machine,
                                                          const Resource& resource, std::size_t bytes) {
  if (resource.kind != ResourceKind::buffer) {
    bytes = bytes_per_pixel(resource.format);
    for (const int size : resource.extent) {
      if (size < 1) {
        return Status(Code::invalid_argument, resource.name + " has an extent of " + std::to_string(size) +
                                                  "; expected at least 1 texel each way");
      }
      bytes *= static_cast<std::size_t>(size);
    }
  } else {
    bytes = std::max({bytes, resource.bytes, std::size_t{1}});
  }
  std::shared_ptr<DeviceMemory> memory(new DeviceMemory(owner, resource, bytes));
  memory->machine_ = machine;
  Status status = resource.kind == ResourceKind::buffer ? make_storage(machine, bytes, resource.name, memory->buffer_)
                                                        : memory->make_image();
  if (!status) return status;
  return std::shared_ptr<luxel::Memory>(std::move(memory));
}

DeviceMemory::~DeviceMemory() {
  vkDestroyImageView(machine_->device(), view_, nullptr);
  vkDestroyImage(machine_->device(), image_, nullptr);
  vkFreeMemory(machine_->device(), image_memory_, nullptr);
}

Status DeviceMemory::make_image() {
  const VkDevice device = machine_->device();
  const bool volume = resource.extent[2] > 1;
  const bool stored = resource.kind == ResourceKind::storage_image;
  layout_ = stored ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = volume ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = vulkan_format(resource.format);
  info.extent = {static_cast<std::uint32_t>(resource.extent[0]), static_cast<std::uint32_t>(resource.extent[1]),
                 static_cast<std::uint32_t>(resource.extent[2])};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (stored) info.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  if (const VkResult result = vkCreateImage(device, &info, nullptr, &image_)) {
    return failure("vulkan: an image for " + resource.name, result);
  }
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device, image_, &needs);
  if (Status status = allocate(*machine_, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, resource.name, image_memory_);
      !status) {
    return status;
  }
  if (const VkResult result = vkBindImageMemory(device, image_, image_memory_, 0)) {
    return failure("vulkan: vkBindImageMemory for " + resource.name, result);
  }
  auto view = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = image_;
  view.viewType = volume ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D;
  view.format = info.format;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  if (const VkResult result = vkCreateImageView(device, &view, nullptr, &view_)) {
    return failure("vulkan: vkCreateImageView for " + resource.name, result);
  }
  return machine_->once([&](VkCommandBuffer commands) { move(commands, VK_IMAGE_LAYOUT_UNDEFINED, layout_); });
}

namespace {

// What uses an image in a layout here. What was there before an upload does not matter, and no other work runs then.
struct Use {
  VkPipelineStageFlags stage;
  VkAccessFlags access;
};
Use use_of(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL: return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT};
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL: return {VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT};
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL: return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT};
    case VK_IMAGE_LAYOUT_GENERAL:
      return {VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT};
    default: return {VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, 0};
  }
}

}  // namespace

void DeviceMemory::move(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const {
  auto barrier = structure<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
  barrier.srcAccessMask = use_of(from).access;
  barrier.dstAccessMask = use_of(to).access;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image_;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(commands, use_of(from).stage, use_of(to).stage, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

VkBufferImageCopy DeviceMemory::whole() const {
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {static_cast<std::uint32_t>(resource.extent[0]), static_cast<std::uint32_t>(resource.extent[1]),
                        static_cast<std::uint32_t>(resource.extent[2])};
  return region;
}

Status DeviceMemory::check_size(const char* verb, std::size_t size) const {
  const bool image = image_ != VK_NULL_HANDLE;
  if (image ? size == bytes : size <= bytes) return {};
  return {Code::invalid_argument, std::string(verb) + " of " + resource.name + " has " + std::to_string(size) +
                                      " bytes; expected " + (image ? "" : "at most ") + std::to_string(bytes)};
}

Status DeviceMemory::upload(const void* data, std::size_t size) {
  if (Status status = check_size("upload", size); !status) return status;
  if (size == 0) return {};
  if (buffer_.mapped) {
    std::memcpy(buffer_.mapped, data, size);
    return {};
  }
  Buffer staging;
  if (Status status = make_staging(machine_, size, staging); !status) return status;
  std::memcpy(staging.mapped, data, size);
  return machine_->once([&](VkCommandBuffer commands) {
    if (image_ == VK_NULL_HANDLE) {
      const VkBufferCopy region{0, 0, size};
      vkCmdCopyBuffer(commands, staging.handle, buffer_.handle, 1, &region);
      return;
    }
    const VkBufferImageCopy region = whole();
    move(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(commands, staging.handle, image_, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    move(commands, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, layout_);
  });
}

Status DeviceMemory::download(void* data, std::size_t size) {
  if (Status status = check_size("download", size); !status) return status;
  if (size == 0) return {};
  if (buffer_.mapped) {
    std::memcpy(data, buffer_.mapped, size);
    return {};
  }
  Buffer staging;
  if (Status status = make_staging(machine_, size, staging); !status) return status;
  Status status = machine_->once([&](VkCommandBuffer commands) {
    if (image_ == VK_NULL_HANDLE) {
      const VkBufferCopy region{0, 0, size};
      vkCmdCopyBuffer(commands, buffer_.handle, staging.handle, 1, &region);
      return;
    }
    const VkBufferImageCopy region = whole();
    move(commands, layout_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdCopyImageToBuffer(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, staging.handle, 1, &region);
    move(commands, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout_);
  });
  if (status) std::memcpy(data, staging.mapped, size);
  return status;
}

Binding DeviceMemory::binding(std::string_view name) const {
  Binding binding;
  binding.name = name;
  binding.buffer = buffer_.handle;
  binding.bytes = buffer_.handle == VK_NULL_HANDLE ? 0 : bytes;
  binding.view = view_;
  binding.layout = layout_;
  return binding;
}

}  // namespace luxel::vulkan

// Buffers and images of the small layer.
#pragma once
#include <memory>

#include "host/context.h"
#include "host/vulkan/machine.h"

namespace luxel::vulkan {

/// A buffer with memory of its own; `mapped` where the host sees it.
struct Buffer {
  std::shared_ptr<Machine> machine;
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  void* mapped = nullptr;

  Buffer() = default;
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
};

/// Storage that kernels use, seen by the host where that costs nothing (a software driver, an integrated GPU).
Status make_storage(const std::shared_ptr<Machine>& machine, std::size_t bytes, const std::string& what,
                    Buffer& buffer);

/// Memory of the small layer on Vulkan: a buffer, or an image in one fixed layout.
class DeviceMemory final : public luxel::Memory {
 public:
  static Result<std::shared_ptr<luxel::Memory>> make(const Context* owner, const std::shared_ptr<Machine>& machine,
                                                     const Resource& resource, std::size_t bytes);
  ~DeviceMemory() override;

  Status upload(const void* data, std::size_t size);
  Status download(void* data, std::size_t size);

  /// What a record needs to know.
  Binding binding(std::string_view name) const;
  /// Never the same for two memories of a process.
  std::uint64_t id() const { return id_; }

 private:
  DeviceMemory(const Context* owner, const Resource& resource, std::size_t bytes);
  Status make_image();
  void move(VkCommandBuffer commands, VkImageLayout from, VkImageLayout to) const;
  VkBufferImageCopy whole() const;
  Status check_size(const char* verb, std::size_t size) const;

  std::shared_ptr<Machine> machine_;
  std::uint64_t id_;
  Buffer buffer_;
  VkImage image_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  VkDeviceMemory image_memory_ = VK_NULL_HANDLE;
  VkImageLayout layout_ = VK_IMAGE_LAYOUT_UNDEFINED;
};

}  // namespace luxel::vulkan

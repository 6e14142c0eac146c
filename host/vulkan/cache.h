// The driver's pipeline cache on disk, one file a module and driver. Whatever is wrong with it costs time only.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <luxel/vulkan.h>

namespace luxel::vulkan {

/// A VkPipelineCache that starts with what the disk holds; null where the device was adopted without a cache directory.
class DiskCache {
 public:
  DiskCache(const Device::State& device, std::uint64_t module_hash);
  ~DiskCache();
  DiskCache(const DiskCache&) = delete;
  DiskCache& operator=(const DiskCache&) = delete;

  VkPipelineCache handle() const { return cache_; }

  /// Writes the file if the cache holds something else than the file does.
  void save();

 private:
  VkDevice device_ = VK_NULL_HANDLE;
  VkPipelineCache cache_ = VK_NULL_HANDLE;
  std::string path_;
  std::vector<std::uint8_t> on_disk_;
};

/// The file of a module's pipelines on a driver.
std::string cache_path(const std::string& directory, const VkPhysicalDeviceProperties& driver,
                       std::uint64_t module_hash);

/// Data that this driver may be given: its header names this device and this build of the driver.
bool is_cache_of(const std::vector<std::uint8_t>& data, const VkPhysicalDeviceProperties& driver);

}  // namespace luxel::vulkan

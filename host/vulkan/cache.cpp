#include "host/vulkan/cache.h"

#include <cstring>

#include "host/files.h"
#include "host/vulkan/result.h"
#include "host/vulkan/state.h"

namespace luxel::vulkan {
namespace {

std::string hex(const std::uint8_t* bytes, std::size_t count) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += digits[bytes[i] >> 4];
    text += digits[bytes[i] & 15];
  }
  return text;
}

// VkPipelineCacheHeaderVersionOne in integers: a file may hold a version that Vulkan's enumeration does not.
struct CacheHeader {
  std::uint32_t size, version, vendor, device;
  std::uint8_t uuid[VK_UUID_SIZE];
};
static_assert(sizeof(CacheHeader) == sizeof(VkPipelineCacheHeaderVersionOne));

}  // namespace

std::string cache_path(const std::string& directory, const VkPhysicalDeviceProperties& driver,
                       std::uint64_t module_hash) {
  std::uint8_t hash[8];
  for (int i = 0; i < 8; ++i) hash[i] = static_cast<std::uint8_t>(module_hash >> (56 - 8 * i));
  return directory + "/vulkan-" + hex(driver.pipelineCacheUUID, VK_UUID_SIZE) + "-" + hex(hash, 8) + ".bin";
}

bool is_cache_of(const std::vector<std::uint8_t>& data, const VkPhysicalDeviceProperties& driver) {
  CacheHeader header;
  if (data.size() < sizeof header) return false;
  std::memcpy(&header, data.data(), sizeof header);
  return header.size >= sizeof header && header.size <= data.size() &&
         header.version == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendor == driver.vendorID &&
         header.device == driver.deviceID && std::memcmp(header.uuid, driver.pipelineCacheUUID, VK_UUID_SIZE) == 0;
}

DiskCache::DiskCache(const Device::State& device, std::uint64_t module_hash) : device_(device.adopt.device) {
  if (device.adopt.cache_directory.empty()) return;
  path_ = cache_path(device.adopt.cache_directory, device.physical.properties, module_hash);
  if (!read_checked(path_, on_disk_) || !is_cache_of(on_disk_, device.physical.properties)) on_disk_.clear();
  auto info = structure<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
  info.initialDataSize = on_disk_.size();
  info.pInitialData = on_disk_.empty() ? nullptr : on_disk_.data();
  if (vkCreatePipelineCache(device_, &info, nullptr, &cache_) != VK_SUCCESS) cache_ = VK_NULL_HANDLE;
}

DiskCache::~DiskCache() { vkDestroyPipelineCache(device_, cache_, nullptr); }

void DiskCache::save() {
  if (cache_ == VK_NULL_HANDLE) return;
  std::size_t size = 0;
  if (vkGetPipelineCacheData(device_, cache_, &size, nullptr) != VK_SUCCESS) return;
  std::vector<std::uint8_t> data(size);
  if (vkGetPipelineCacheData(device_, cache_, &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);
  if (data != on_disk_ && write_checked(path_, data)) on_disk_ = std::move(data);
}

}  // namespace luxel::vulkan

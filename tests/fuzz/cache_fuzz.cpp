// The checksummed files of caches: bytes as a file; bytes as a payload that is written, read, and read with one byte
// changed; and as the header that Vulkan prescribes for its own cache.
#include "host/files.h"
#include "tests/fuzz/fuzz.h"
#if LUXEL_VULKAN
#include "host/vulkan/cache.h"
#endif

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace luxel;
  std::vector<std::uint8_t> payload{1};
  if (const fuzz::MemoryFile file(data, size); read_checked(file.path(), payload))
    fuzz::require(payload.size() + 24 == size, "a payload is what its file says");
  else
    fuzz::require(payload.empty(), "nothing comes of a file that is refused");

  // The same envelope by hand, as write_checked renames and a file in memory cannot be.
  const std::uint64_t head[2] = {size, fnv1a(data, size)};
  std::vector<std::uint8_t> whole(24 + size);
  std::memcpy(whole.data(), "luxel-c1", 8);
  std::memcpy(whole.data() + 8, head, 16);
  if (size > 0) std::memcpy(whole.data() + 24, data, size);
  {
    const fuzz::MemoryFile file(whole.data(), whole.size());
    fuzz::require(read_checked(file.path(), payload), "a whole file is read");
    fuzz::require(payload.size() == size && std::equal(payload.begin(), payload.end(), data), "as it was written");
  }
  fuzz::Bytes bytes(data, size);
  whole[bytes.value<std::uint16_t>() % whole.size()] ^= static_cast<std::uint8_t>(1u << bytes.below(8));
  const fuzz::MemoryFile file(whole.data(), whole.size());
  fuzz::require(!read_checked(file.path(), payload) && payload.empty(), "a flipped bit is noticed");
#if LUXEL_VULKAN
  VkPhysicalDeviceProperties driver{};
  driver.vendorID = 0x10005;
  const std::vector<std::uint8_t> cache(data, data + size);
  if (vulkan::is_cache_of(cache, driver)) fuzz::require(size >= 32, "a header is whole");
#endif
  return 0;
}

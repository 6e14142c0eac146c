// The pipeline cache on disk: whatever is wrong with it costs time, never a result.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "host/files.h"
#include "host/module.h"
#include "host/vulkan/cache.h"
#include "host/vulkan/state.h"
#include "tests/support/vulkan_engine.h"

namespace luxel::vulkan {
namespace {

namespace fs = std::filesystem;

/// A folder for caches that goes with the test.
class VulkanCache : public VulkanTest {
 protected:
  VulkanCache() : folder_(fs::temp_directory_path() / ("luxel_vulkan_test_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
  }
  ~VulkanCache() override { fs::remove_all(folder_); }

  /// A device that compiles everything anew, with this cache.
  void run(const std::string& directory) {
    const Engine fresh = Engine::open(directory);
    const Plan plan = fresh.plan();
    Bound bound(fresh, plan);
    const Status status = bound.run(fresh.pipeline(plan));
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(bound.output(), expected(plan));
  }

  std::string file() const {
    const Plan plan = engine().plan();
    return cache_path(folder_.string(), engine().device.state->physical.properties, plan.passes[0].module->hash);
  }

  static std::vector<std::uint8_t> content(const std::string& path) {
    std::vector<std::uint8_t> bytes;
    EXPECT_TRUE(read_file(path, bytes)) << path;
    return bytes;
  }

  static void write(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  const fs::path folder_;
};

TEST_F(VulkanCache, IsWrittenAndReadAgain) {
  run(folder_.string());
  std::vector<std::uint8_t> payload;
  ASSERT_TRUE(read_checked(file(), payload));
  EXPECT_TRUE(is_cache_of(payload, engine().device.state->physical.properties));
  const auto written = fs::last_write_time(file());
  run(folder_.string());
  EXPECT_EQ(fs::last_write_time(file()), written) << "a cache that lacked nothing was written again";
}

TEST_F(VulkanCache, DamageCostsTimeOnly) {
  run(folder_.string());
  const std::vector<std::uint8_t> good = content(file());
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{30}, good.size() - 1}) {
    write(file(), {good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)});
    run(folder_.string());
    EXPECT_EQ(content(file()), good) << "truncated to " << size;
  }
  for (std::size_t at = 0; at < good.size(); at += std::max<std::size_t>(1, good.size() / 16)) {
    std::vector<std::uint8_t> flipped = good;
    flipped[at] ^= 0x10;
    write(file(), flipped);
    run(folder_.string());
    EXPECT_EQ(content(file()), good) << "byte " << at << " flipped";
  }
}

TEST_F(VulkanCache, OfAnotherDriverIsNotHandedToThisOne) {
  run(folder_.string());
  const VkPhysicalDeviceProperties& driver = engine().device.state->physical.properties;
  std::vector<std::uint8_t> payload;
  ASSERT_TRUE(read_checked(file(), payload));
  const std::vector<std::uint8_t> good = payload;
  for (const std::size_t at : {0u, 4u, 8u, 12u, 16u, 31u}) {  // every field of the header that Vulkan prescribes
    payload = good;
    payload[at] ^= 0x7f;
    EXPECT_FALSE(is_cache_of(payload, driver)) << "header byte " << at;
    ASSERT_TRUE(write_checked(file(), payload));
    run(folder_.string());
    ASSERT_TRUE(read_checked(file(), payload));
    EXPECT_EQ(payload, good) << "header byte " << at;
  }
}

TEST_F(VulkanCache, ThatCannotBeWrittenChangesNothing) {
  fs::create_directories(folder_);
  write((folder_ / "a_file").string(), {1, 2, 3});
  run((folder_ / "a_file").string());
  run("/proc/luxel");
  fs::create_directories(file());  // a folder where the file belongs
  run(folder_.string());
  EXPECT_TRUE(fs::is_directory(file()));
}

}  // namespace
}  // namespace luxel::vulkan

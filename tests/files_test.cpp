// Files of caches: what was written is read back whole or not at all.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <thread>

#include "host/files.h"

namespace luxel {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

class Files : public testing::Test {
 protected:
  Files() {
    fs::remove_all(folder);
  }
  ~Files() override { fs::remove_all(folder); }
  std::string path(const char* name) const { return folder + "/" + name; }

  const std::string folder =
      testing::TempDir() + "luxel_files_" + testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(Files, Fnv1aGivesThePublishedValues) {
  EXPECT_EQ(fnv1a("", 0), 0xcbf29ce484222325ull);
  EXPECT_EQ(fnv1a("a", 1), 0xaf63dc4c8601ec8cull);
  EXPECT_EQ(fnv1a("foobar", 6), 0x85944171f73967e8ull);
  EXPECT_EQ(fnv1a("bar", 3, fnv1a("foo", 3)), fnv1a("foobar", 6));
}

TEST_F(Files, WholeFilesComeBack) {
  for (const std::size_t size : {0u, 1u, 4095u, 100000u}) {
    Bytes content(size);
    for (std::size_t i = 0; i < size; ++i) content[i] = static_cast<std::uint8_t>(i * 31);
    Bytes back{9};
    ASSERT_TRUE(write_file_atomically(path("deep/er/plain"), content));
    ASSERT_TRUE(read_file(path("deep/er/plain"), back));
    EXPECT_EQ(back, content);
    ASSERT_TRUE(write_checked(path("checked"), content));
    ASSERT_TRUE(read_checked(path("checked"), back));
    EXPECT_EQ(back, content);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    EXPECT_NE(entry.path().extension(), ".tmp") << "a temporary file was left behind";
}

TEST_F(Files, EveryFlippedBitAndEveryLengthIsNoticed) {
  const Bytes payload{0, 1, 2, 3, 250, 251};
  ASSERT_TRUE(write_checked(path("file"), payload));
  Bytes whole, back;
  ASSERT_TRUE(read_file(path("file"), whole));
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    Bytes damaged = whole;
    damaged[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    ASSERT_TRUE(write_file_atomically(path("file"), damaged));
    EXPECT_FALSE(read_checked(path("file"), back)) << "bit " << bit;
    EXPECT_TRUE(back.empty());
  }
  for (std::size_t length = 0; length <= whole.size() + 1; ++length) {
    if (length == whole.size()) continue;
    Bytes damaged = whole;
    damaged.resize(length);
    ASSERT_TRUE(write_file_atomically(path("file"), damaged));
    EXPECT_FALSE(read_checked(path("file"), back)) << "length " << length;
  }
}

TEST_F(Files, WhatCannotBeReadOrWrittenIsFalseAndLeavesNothing) {
  Bytes back{1};
  EXPECT_FALSE(read_file(path("missing"), back));
  EXPECT_TRUE(back.empty());
  ASSERT_TRUE(write_file_atomically(path("file"), back));
  EXPECT_FALSE(read_file(folder, back)) << "a folder is no file";
  EXPECT_FALSE(write_file_atomically(path("file/below"), Bytes{1}));
  EXPECT_FALSE(write_checked("/proc/nothing/here", Bytes{1}));
  fs::create_directories(path("folder/full"));
  EXPECT_FALSE(write_file_atomically(path("folder"), Bytes{1}));
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) files += entry.is_regular_file();
  EXPECT_EQ(files, 1u);
}

TEST_F(Files, ReadersSeeAWholeFileWhileOthersWriteIt) {
  const auto content = [](std::uint8_t value) { return Bytes(20000, value); };
  ASSERT_TRUE(write_checked(path("file"), content(0)));
  std::vector<std::thread> writers;
  for (std::uint8_t w = 1; w <= 3; ++w) {
    writers.emplace_back([&, w] {
      for (int i = 0; i < 50; ++i) EXPECT_TRUE(write_checked(path("file"), content(w)));
    });
  }
  for (int i = 0; i < 200; ++i) {
    Bytes back;
    ASSERT_TRUE(read_checked(path("file"), back));
    ASSERT_EQ(back, content(back[0]));
  }
  for (std::thread& writer : writers) writer.join();
}

TEST_F(Files, CacheDirectoryFollowsTheEnvironment) {
  const char* names[] = {"LUXEL_CACHE", "XDG_CACHE_HOME", "HOME"};
  std::vector<std::pair<const char*, std::string>> before;
  for (const char* name : names) before.emplace_back(name, std::getenv(name) ? std::getenv(name) : "");
  setenv("LUXEL_CACHE", "/own", 1);
  setenv("XDG_CACHE_HOME", "/xdg", 1);
  setenv("HOME", "/home/me", 1);
  EXPECT_EQ(cache_directory(), "/own");
  setenv("LUXEL_CACHE", "", 1);
  EXPECT_EQ(cache_directory(), "/xdg/luxel");
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(cache_directory(), "/home/me/.cache/luxel");
  unsetenv("HOME");
  EXPECT_EQ(cache_directory(), "");
  for (const auto& [name, value] : before) value.empty() ? unsetenv(name) : setenv(name, value.c_str(), 1);
}

}  // namespace
}  // namespace luxel

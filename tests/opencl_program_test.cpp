// Programs of the OpenCL execution: built once, kept on disk, and never wrong for what happened to the files there.
#if LUXEL_OPENCL
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "host/files.h"
#include "host/opencl/pipeline.h"
#include "tests/support/opencl.h"

namespace luxel::opencl {
namespace {

namespace fs = std::filesystem;

const char* broken_source = "__kernel void tiny(__global float* a) {\n  a[0] = undeclared_name;\n}\n";

class OpenClProgram : public testing::Test {
 protected:
  OpenClProgram() : machine(Machine::open()), queue(machine.queue()) {
    folder = testing::TempDir() + "luxel_opencl_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
             testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder);
  }
  ~OpenClProgram() override { fs::remove_all(folder); }

  /// A fresh Device that keeps programs on disk with every driver.
  Device caching(const std::string& cache) const {
    Device device = machine.adopt(cache);
    device.state->keep_binaries = true;
    return device;
  }

  void expect_right(const Device& device, const Plan& plan) {
    const Result<Pipeline> pipeline = Pipeline::create(device, plan);
    ASSERT_TRUE(pipeline.ok()) << pipeline.status().message();
    const std::vector<float> input = counting(100);
    const OwnedMemory src = machine.buffer(400), dst = machine.buffer(400);
    write(queue.get(), src, input);
    write(queue.get(), dst, std::vector<float>(100, -1.0f));
    const Status status =
        pipeline.value().enqueue(queue.get(), {{"src", src.get(), 0, 400}, {"dst", dst.get(), 0, 400}});
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(read<float>(queue.get(), dst, 100), tiny_result(input, 1));
  }

  std::string only_file() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    EXPECT_EQ(files.size(), 1u);
    return files.empty() ? "" : files[0];
  }

  Machine machine;
  OwnedQueue queue;
  std::string folder;
};

TEST_F(OpenClProgram, CompilerErrorIsOneLineThatNamesKernelDeviceAndReason) {
  const Module module = tiny_module(broken_source);
  const Status status = Pipeline::create(machine.device, tiny_plan(module, 100, 1)).status();
  EXPECT_EQ(status.code(), Code::compile_failed);
  EXPECT_EQ(status.message().find('\n'), std::string::npos);
  EXPECT_EQ(status.message().rfind("tiny: tiny (tiny) does not compile on " + machine.device.name(), 0), 0u)
      << status.message();
  EXPECT_NE(status.message().find("undeclared identifier 'undeclared_name'"), std::string::npos) << status.message();
}

TEST_F(OpenClProgram, FailedBuildIsNotKept) {
  const Module broken = tiny_module(broken_source), good = tiny_module();
  const Device device = caching(folder);
  EXPECT_EQ(Pipeline::create(device, tiny_plan(broken, 100, 1)).status().code(), Code::compile_failed);
  EXPECT_FALSE(fs::exists(folder));
  expect_right(device, tiny_plan(good, 100, 1));
}

TEST_F(OpenClProgram, OneProgramForEqualModuleConstantsAndWorkgroup) {
  const Module module = tiny_module();
  Plan plan = tiny_plan(module, 100, 3);
  const Result<Pipeline> first = Pipeline::create(machine.device, plan);
  const Result<Pipeline> second = Pipeline::create(machine.device, plan);
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(machine.device.state->programs.size(), 1u);
  const auto program = first.value().state->shared->programs[0];
  for (const auto& other : second.value().state->shared->programs) EXPECT_EQ(other, program);
  EXPECT_EQ(first.value().clone().value().state->shared->programs[2], program);

  plan.passes[1].constants[0] = 2.0;
  plan.passes[2].workgroup = {32, 1, 1};
  plan.passes[2].parameters[1] = 3.0;
  ASSERT_TRUE(Pipeline::create(machine.device, plan).ok());
  EXPECT_EQ(machine.device.state->programs.size(), 3u);
}

TEST_F(OpenClProgram, ConstantsReachTheKernelAsTheyAre) {
  const Module module = tiny_module();
  for (const double offset : {0.1, -2.5, 1e-38, 16777217.0, 1e30, 0.0}) {
    Plan plan = tiny_plan(module, 1, 1);
    plan.passes[0].constants[0] = offset;
    plan.passes[0].constants[1] = 0.0;
    const Result<Pipeline> pipeline = Pipeline::create(machine.device, plan);
    ASSERT_TRUE(pipeline.ok()) << pipeline.status().message();
    const OwnedMemory src = machine.buffer(4), dst = machine.buffer(4);
    write(queue.get(), src, std::vector<float>{0.0f});
    ASSERT_TRUE(pipeline.value().enqueue(queue.get(), {{"src", src.get(), 0, 4}, {"dst", dst.get(), 0, 4}}).ok());
    EXPECT_EQ(read<float>(queue.get(), dst, 1)[0], static_cast<float>(offset));
  }
  Plan plan = tiny_plan(module, 1, 1);
  plan.passes[0].constants[1] = 4294967295.0;
  EXPECT_NE(build_options(*machine.device.state, plan, plan.passes[0]).value().find("-D ROUNDS=4294967295u"),
            std::string::npos);
  plan.passes[0].constants[1] = 4294967296.0;
  EXPECT_EQ(build_options(*machine.device.state, plan, plan.passes[0]).status().code(), Code::internal);
  plan.passes[0].constants = {1e39, 0.0};
  EXPECT_EQ(build_options(*machine.device.state, plan, plan.passes[0]).status().code(), Code::internal);
}

TEST_F(OpenClProgram, KeptProgramIsUsedAndGivesTheRightResult) {
  const Module good = tiny_module(), broken = tiny_module(broken_source);
  expect_right(caching(folder), tiny_plan(good, 100, 1));
  only_file();
  // A source that does not compile under the same key: only the kept program can give a result.
  expect_right(caching(folder), tiny_plan(broken, 100, 1));
  // Other constants are another program.
  Plan plan = tiny_plan(broken, 100, 1);
  plan.passes[0].constants[0] = 3.0;
  EXPECT_EQ(Pipeline::create(caching(folder), plan).status().code(), Code::compile_failed);
}

TEST_F(OpenClProgram, DamagedFilesCostTimeNeverAResult) {
  const Module module = tiny_module();
  const Plan plan = tiny_plan(module, 100, 1);
  expect_right(caching(folder), plan);
  const std::string path = only_file();
  std::vector<std::uint8_t> whole;
  ASSERT_TRUE(read_file(path, whole));
  std::vector<std::vector<std::uint8_t>> damages;
  for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{24}, whole.size() / 2, whole.size() - 1})
    damages.emplace_back(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
  for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{17}, std::size_t{30}, whole.size() / 2}) {
    damages.push_back(whole);
    damages.back()[at] ^= 0x10;
  }
  damages.push_back(whole);
  damages.back().push_back(0);
  for (std::size_t i = 0; i < damages.size(); ++i) {
    SCOPED_TRACE(i);
    ASSERT_TRUE(write_file_atomically(path, damages[i]));
    expect_right(caching(folder), plan);
    std::vector<std::uint8_t> repaired;
    ASSERT_TRUE(read_checked(path, repaired)) << "the file was not written anew";
  }
}

TEST_F(OpenClProgram, FileOfAnotherKeyOrWithAForeignProgramIsNotUsed) {
  const Module module = tiny_module();
  const Plan plan = tiny_plan(module, 100, 1);
  expect_right(caching(folder), plan);
  const std::string path = only_file();
  std::vector<std::uint8_t> payload;
  ASSERT_TRUE(read_checked(path, payload));
  const auto end = std::find(payload.begin(), payload.end(), 0);
  ASSERT_NE(end, payload.end());

  std::vector<std::uint8_t> other_key = payload;
  other_key[5] ^= 1;
  ASSERT_TRUE(write_checked(path, other_key));
  expect_right(caching(folder), plan);
  std::vector<std::uint8_t> after;
  ASSERT_TRUE(read_checked(path, after));
  EXPECT_TRUE(std::equal(payload.begin(), end, after.begin())) << "the file was not written anew";

  std::vector<std::uint8_t> no_program(payload.begin(), end + 1);
  no_program.insert(no_program.end(), {'n', 'o', 't', ' ', 'a', ' ', 'p', 'r', 'o', 'g', 'r', 'a', 'm'});
  ASSERT_TRUE(write_checked(path, no_program));
  expect_right(caching(folder), plan);
}

TEST_F(OpenClProgram, UnwritableFolderCostsTimeNeverAResult) {
  const Module module = tiny_module();
  fs::create_directories(folder);
  std::ofstream(folder + "/file") << "in the way";
  expect_right(caching(folder + "/file"), tiny_plan(module, 100, 1));
  expect_right(caching(folder + "/file/below"), tiny_plan(module, 100, 1));
  expect_right(caching("/proc/nothing/here"), tiny_plan(module, 100, 1));
}

}  // namespace
}  // namespace luxel::opencl
#endif

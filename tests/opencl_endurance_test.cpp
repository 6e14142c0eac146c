// Hard use of the OpenCL execution: cycles without growth, and what must be refused or survived.
#if LUXEL_OPENCL
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "host/files.h"
#include "host/opencl/device.h"
#include "tests/support/opencl.h"
#include "tests/support/resident.h"

namespace luxel::opencl {
namespace {

namespace fs = std::filesystem;

class OpenClEndurance : public testing::Test {
 protected:
  OpenClEndurance() : machine(Machine::open()), queue(machine.queue()) {}

  Pipeline pipeline(const Plan& plan) const {
    Result<Pipeline> made = Pipeline::create(machine.device, plan);
    EXPECT_TRUE(made.ok()) << made.status().message();
    if (!made.ok()) std::exit(1);
    return std::move(made).value();
  }

  static constexpr int count = 64, passes = 3;
  Machine machine;
  OwnedQueue queue;
  const Module module = tiny_module();
  const Plan plan = tiny_plan(module, count, passes);
  const OwnedMemory src = machine.buffer(4 * count), dst = machine.buffer(4 * count), scratch = machine.buffer(plan.scratch_bytes);
  const std::vector<Binding> bindings{{"src", src.get(), 0, 4 * count},
                                      {"dst", dst.get(), 0, 4 * count},
                                      {"scratch", scratch.get(), 0, plan.scratch_bytes}};
};

TEST_F(OpenClEndurance, TwoHundredPipelinesAreMadeRunAndGone) {
  write(queue.get(), src, counting(count));
  std::size_t before = 0, allocated = 0;
  for (int i = 0; i < 200; ++i) {
    if (i == 50) before = resident_bytes(), allocated = allocated_bytes();
    const Pipeline made = pipeline(plan);
    const Status status = made.enqueue(queue.get(), bindings);
    ASSERT_TRUE(status.ok()) << status.message();
    ASSERT_EQ(clFinish(queue.get()), CL_SUCCESS);
  }
  EXPECT_LE(resident_bytes(), before + resident_noise);
  EXPECT_LE(allocated_bytes(), allocated + allocated_noise);
  EXPECT_EQ(read<float>(queue.get(), dst, count), tiny_result(counting(count), passes));
}

TEST_F(OpenClEndurance, TenThousandRunsOfOnePipeline) {
  write(queue.get(), src, counting(count));
  const Pipeline made = pipeline(plan);
  std::size_t before = 0, allocated = 0;
  for (int i = 0; i < 10000; ++i) {
    if (i == 1000) before = resident_bytes(), allocated = allocated_bytes();
    const Status status = made.enqueue(queue.get(), bindings);
    ASSERT_TRUE(status.ok()) << status.message();
    if (i % 16 == 15) {
      ASSERT_EQ(clFinish(queue.get()), CL_SUCCESS);
    }
  }
  ASSERT_EQ(clFinish(queue.get()), CL_SUCCESS);
  EXPECT_LE(resident_bytes(), before + resident_noise);
  EXPECT_LE(allocated_bytes(), allocated + allocated_noise);
  EXPECT_EQ(read<float>(queue.get(), dst, count), tiny_result(counting(count), passes));
}

TEST_F(OpenClEndurance, ADispatchOfNothingIsRefused) {
  Plan nothing = plan;
  nothing.passes[0].groups[0] = 0;
  const Status status = Pipeline::create(machine.device, nothing).status();
  EXPECT_FALSE(status.ok()) << "0 workgroups were taken";
  EXPECT_EQ(status.message().find('\n'), std::string::npos);
}

TEST_F(OpenClEndurance, LostAndExhaustedHaveTheirOwnCodes) {
  EXPECT_EQ(failure(CL_OUT_OF_RESOURCES, "x").code(), Code::out_of_memory);
  EXPECT_EQ(failure(CL_OUT_OF_HOST_MEMORY, "x").code(), Code::out_of_memory);
  EXPECT_EQ(failure(CL_MEM_OBJECT_ALLOCATION_FAILURE, "x").code(), Code::out_of_memory);
  EXPECT_EQ(failure(CL_DEVICE_NOT_AVAILABLE, "x").code(), Code::device_lost);
}

// What keeps programs goes through write_checked. (The driver's own files cannot be written either on a full disk, so that it
// may refuse to build at all: that is compile_failed.)
TEST(OpenClFullDisk, AFileThatIsCutShortIsNotLeftBehind) {
  const fs::path file = fs::temp_directory_path() / ("luxel_full_disk_cl_" + std::to_string(getpid())) / "opencl" / "a.bin";
  const std::vector<std::uint8_t> content(100000, 7);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit little = before;
  little.rlim_cur = 4096;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  const bool written = write_checked(file.string(), content);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(written);
  for (const auto& entry : fs::recursive_directory_iterator(file.parent_path().parent_path())) {
    EXPECT_FALSE(entry.is_regular_file()) << entry.path() << " was left half written";
  }
  EXPECT_TRUE(write_checked(file.string(), content));
  fs::remove_all(file.parent_path().parent_path());
}

}  // namespace
}  // namespace luxel::opencl
#endif

// The OpenCL execution on queues: order, events, threads, and what is left when a driver refuses half way.
#if LUXEL_OPENCL
#include <atomic>
#include <thread>

#include <luxel/gaussian_blur.h>
#include <luxel/reference.h>

#include "tests/support/opencl.h"

namespace luxel::opencl {
namespace {

class OpenClQueue : public testing::Test {
 protected:
  OpenClQueue() : machine(Machine::open()) {}

  Pipeline pipeline(Plan plan) const {
    Result<Pipeline> made = Pipeline::create(machine.device, std::move(plan));
    EXPECT_TRUE(made.ok()) << made.status().message();
    if (!made.ok()) std::exit(1);
    return std::move(made).value();
  }
  OwnedEvent gate() const {
    cl_int error = CL_SUCCESS;
    OwnedEvent event(clCreateUserEvent(machine.context.get(), &error));
    EXPECT_EQ(error, CL_SUCCESS);
    return event;
  }
  static cl_int state(cl_event event) {
    cl_int result = -1;
    clGetEventInfo(event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof result, &result, nullptr);
    return result;
  }

  Machine machine;
  const Module module = tiny_module();
};

TEST_F(OpenClQueue, PassesRunInOrderOnAnOutOfOrderQueue) {
  const OwnedQueue queue = machine.queue(CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE);
  constexpr int count = 4096, passes = 8;
  // The first pass works longest, so that a queue that does not wait for it shows.
  Plan plan = tiny_plan(module, count, passes);
  for (int p = 0; p < passes; ++p) plan.passes[static_cast<std::size_t>(p)].constants[1] = p == 0 ? 20000 : 0;
  const Pipeline chain = pipeline(plan);
  const std::size_t bytes = count * sizeof(float), scratch_bytes = chain.plan().scratch_bytes;
  const OwnedMemory src = machine.buffer(bytes), dst = machine.buffer(bytes), scratch = machine.buffer(scratch_bytes);
  write(queue.get(), src, counting(count));
  for (int round = 0; round < 5; ++round) {
    write(queue.get(), scratch, std::vector<float>(scratch_bytes / 4, -1.0f));
    cl_event done = nullptr;
    Enqueue options;
    options.done = &done;
    ASSERT_TRUE(chain.enqueue(queue.get(), {{"src", src.get(), 0, bytes}, {"dst", dst.get(), 0, bytes},
                                            {"scratch", scratch.get(), 0, scratch_bytes}}, options).ok());
    ASSERT_EQ(clWaitForEvents(1, &done), CL_SUCCESS);
    clReleaseEvent(done);
    ASSERT_EQ(read<float>(queue.get(), dst, count), tiny_result(counting(count), passes));
  }
}

TEST_F(OpenClQueue, WaitsForTheCallersEventsAndReportsItsOwn) {
  for (const cl_command_queue_properties order : {0, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE}) {
    const OwnedQueue queue = machine.queue(order | CL_QUEUE_PROFILING_ENABLE), reader = machine.queue();
    const Pipeline chain = pipeline(tiny_plan(module, 100, 3));
    const std::size_t scratch_bytes = chain.plan().scratch_bytes;
    const OwnedMemory src = machine.buffer(400), dst = machine.buffer(400), scratch = machine.buffer(scratch_bytes);
    write(reader.get(), src, counting(100));
    write(reader.get(), dst, std::vector<float>(100, -1.0f));
    const OwnedEvent first = gate(), second = gate();
    const cl_event waits[] = {first.get(), second.get()};
    cl_event done = nullptr;
    std::vector<cl_event> passes;
    ASSERT_TRUE(chain.enqueue(queue.get(), {{"src", src.get(), 0, 400}, {"dst", dst.get(), 0, 400},
                                            {"scratch", scratch.get(), 0, scratch_bytes}},
                              {waits, 2, &done, &passes}).ok());
    clFlush(queue.get());
    clSetUserEventStatus(first.get(), CL_COMPLETE);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_GT(state(done), CL_COMPLETE);
    EXPECT_EQ(read<float>(reader.get(), dst, 100), std::vector<float>(100, -1.0f)) << "ran before it was let";
    clSetUserEventStatus(second.get(), CL_COMPLETE);
    ASSERT_EQ(clWaitForEvents(1, &done), CL_SUCCESS);
    EXPECT_EQ(read<float>(reader.get(), dst, 100), tiny_result(counting(100), 3));

    ASSERT_EQ(passes.size(), 3u);
    EXPECT_EQ(passes.back(), done);
    cl_ulong before = 0;
    for (const cl_event event : passes) {
      cl_ulong start = 0, end = 0;
      EXPECT_EQ(clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_START, sizeof start, &start, nullptr), CL_SUCCESS);
      EXPECT_EQ(clGetEventProfilingInfo(event, CL_PROFILING_COMMAND_END, sizeof end, &end, nullptr), CL_SUCCESS);
      EXPECT_LE(before, start);
      EXPECT_LE(start, end);
      before = end;
    }
    // Each is the caller's to release, the last one twice.
    EXPECT_EQ(clReleaseEvent(done), CL_SUCCESS);
    for (const cl_event event : passes) EXPECT_EQ(clReleaseEvent(event), CL_SUCCESS);
  }
}

TEST_F(OpenClQueue, EmptyPlanStillSignalsAfterItsWaitList) {
  const OwnedQueue queue = machine.queue();
  Plan plan = tiny_plan(module, 100, 1);
  plan.passes.clear();
  const Pipeline nothing = pipeline(plan);
  const OwnedMemory src = machine.buffer(400), dst = machine.buffer(400);
  const OwnedEvent before = gate();
  const cl_event wait = before.get();
  cl_event done = nullptr;
  ASSERT_TRUE(nothing.enqueue(queue.get(), {{"src", src.get(), 0, 400}, {"dst", dst.get(), 0, 400}}, {&wait, 1, &done})
                  .ok());
  clFlush(queue.get());
  EXPECT_GT(state(done), CL_COMPLETE);
  clSetUserEventStatus(wait, CL_COMPLETE);
  EXPECT_EQ(clWaitForEvents(1, &done), CL_SUCCESS);
  clReleaseEvent(done);
}

TEST_F(OpenClQueue, TablesOutliveThePipelineUntilTheyAreWritten) {
  GaussianBlurParams params;
  params.width = params.height = 64;
  params.format = Format::f32x1;
  constexpr std::size_t bytes = 64 * 64 * 4;
  std::vector<float> input = counting(64 * 64), expected(input.size());
  ASSERT_TRUE(reference::run(plan(params, profile("reference")).value(),
                             {{"src", input.data(), bytes}, {"dst", expected.data(), bytes}}).ok());
  const OwnedQueue queue = machine.queue();
  const OwnedMemory src = machine.buffer(bytes), dst = machine.buffer(bytes);
  write(queue.get(), src, input);
  const OwnedEvent before = gate();
  const cl_event wait = before.get();
  OwnedMemory scratch;
  {
    const Pipeline blur = pipeline(plan(params, machine.device.profile()).value());
    const std::size_t scratch_bytes = blur.plan().scratch_bytes;
    scratch = machine.buffer(scratch_bytes);
    ASSERT_TRUE(blur.enqueue(queue.get(), {{"src", src.get(), 0, bytes}, {"dst", dst.get(), 0, bytes},
                                           {"scratch", scratch.get(), 0, scratch_bytes}}, {&wait, 1}).ok());
  }
  // Where the tables were, had they been freed.
  const std::vector<std::vector<float>> reuse(64, std::vector<float>(16, 1e30f));
  clSetUserEventStatus(wait, CL_COMPLETE);
  EXPECT_EQ(read<float>(queue.get(), dst, expected.size()), expected);
}

TEST_F(OpenClQueue, CurrentTablesAreNotWrittenAgain) {
  GaussianBlurParams params;
  params.width = params.height = 16;
  params.format = Format::f32x1;
  constexpr std::size_t bytes = 16 * 16 * 4;
  const OwnedQueue queue = machine.queue();
  const Pipeline blur = pipeline(plan(params, machine.device.profile()).value());
  const std::size_t scratch_bytes = blur.plan().scratch_bytes;
  const OwnedMemory src = machine.buffer(bytes), dst = machine.buffer(bytes), scratch = machine.buffer(scratch_bytes);
  write(queue.get(), src, std::vector<float>(256, 1.0f));
  const auto run = [&](bool current) {
    Enqueue options;
    options.tables_current = current;
    EXPECT_TRUE(blur.enqueue(queue.get(), {{"src", src.get(), 0, bytes}, {"dst", dst.get(), 0, bytes},
                                           {"scratch", scratch.get(), 0, scratch_bytes}}, options).ok());
    return read<float>(queue.get(), dst, 256);
  };
  EXPECT_EQ(run(false), std::vector<float>(256, 1.0f));
  EXPECT_EQ(run(true), std::vector<float>(256, 1.0f));
  write(queue.get(), scratch, std::vector<float>(4096, 0.0f));
  EXPECT_EQ(run(true), std::vector<float>(256, 0.0f)) << "the zeroed tables were written again";
  EXPECT_EQ(run(false), std::vector<float>(256, 1.0f));
}

TEST_F(OpenClQueue, ClonesRunOnOtherThreadsAtTheSameTime) {
  const Pipeline original = pipeline(tiny_plan(module, 1000, 4));
  std::atomic<int> wrong{0};
  const auto work = [&](int seed) {
    const Result<Pipeline> mine = original.clone();
    if (!mine.ok()) { ++wrong; return; }
    const OwnedQueue queue = machine.queue();
    const std::size_t scratch_bytes = mine.value().plan().scratch_bytes;
    const OwnedMemory src = machine.buffer(4000), dst = machine.buffer(4000), scratch = machine.buffer(scratch_bytes);
    for (int round = 0; round < 50; ++round) {
      const std::vector<float> input(1000, static_cast<float>(seed * 1000 + round));
      write(queue.get(), src, input);
      const Status status = mine.value().enqueue(queue.get(), {{"src", src.get(), 0, 4000}, {"dst", dst.get(), 0, 4000},
                                                               {"scratch", scratch.get(), 0, scratch_bytes}});
      if (!status || read<float>(queue.get(), dst, 1000) != tiny_result(input, 4)) ++wrong;
    }
  };
  std::thread first(work, 1), second(work, 2);
  work(3);
  first.join();
  second.join();
  EXPECT_EQ(wrong, 0);
}

TEST_F(OpenClQueue, PipelinesAreMadeOnSeveralThreadsAtTheSameTime) {
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      if (!Pipeline::create(machine.device, tiny_plan(module, 100, 2, 12345)).ok()) ++wrong;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST_F(OpenClQueue, RefusalHalfWayIsSaid) {
  // The second module demands another workgroup size than its pass has, which drivers notice when it is enqueued.
  std::string source = tiny_source;
  source.replace(source.find("WORKGROUP_X"), 11, "16");
  const Module stubborn = tiny_module(source);
  Plan plan = tiny_plan(module, 100, 3);
  plan.passes[1].module = &stubborn;
  plan.passes[1].constants[1] = 1.0;  // a key of its own
  const Pipeline broken = pipeline(plan);
  const OwnedQueue queue = machine.queue();
  const std::size_t scratch_bytes = broken.plan().scratch_bytes;
  const OwnedMemory src = machine.buffer(400), dst = machine.buffer(400), scratch = machine.buffer(scratch_bytes);
  cl_event done = nullptr;
  std::vector<cl_event> passes;
  const Status status = broken.enqueue(queue.get(), {{"src", src.get(), 0, 400}, {"dst", dst.get(), 0, 400},
                                                     {"scratch", scratch.get(), 0, scratch_bytes}},
                                       {nullptr, 0, &done, &passes});
  EXPECT_EQ(status.message(),
            "tiny: pass 2 of 3 (step 1) was not enqueued, the passes before it are enqueued, so wait for the queue and "
            "take the outputs as undefined: CL_INVALID_WORK_GROUP_SIZE");
  EXPECT_EQ(status.code(), Code::internal);
  EXPECT_EQ(done, nullptr);
  EXPECT_TRUE(passes.empty());
  EXPECT_EQ(clFinish(queue.get()), CL_SUCCESS);
}

}  // namespace
}  // namespace luxel::opencl
#endif

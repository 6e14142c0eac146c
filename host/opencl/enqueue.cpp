#include "host/opencl/pipeline.h"

namespace luxel::opencl {
namespace {

/// The commands of one call. On an out-of-order queue each waits for the one before it.
class Sequence {
 public:
  Sequence(cl_command_queue queue, bool chained, const Enqueue& options)
      : queue_(queue), chained_(chained), waits_(options.wait, options.wait + options.wait_count) {}

  /// `command(waits, count, event)` enqueues; `keep`: its event is wanted.
  template <class Command>
  cl_int add(bool keep, Command command) {
    cl_event event = nullptr;
    const cl_uint count = static_cast<cl_uint>(waits_.size());
    const cl_int error = command(count ? waits_.data() : nullptr, count, chained_ || keep ? &event : nullptr);
    if (error != CL_SUCCESS) return error;
    waits_.clear();
    if (chained_) waits_.push_back(event);
    events_.emplace_back(event);
    return CL_SUCCESS;
  }

  cl_command_queue queue() const { return queue_; }
  std::vector<OwnedEvent>& events() { return events_; }

 private:
  cl_command_queue queue_;
  bool chained_;
  std::vector<cl_event> waits_;
  std::vector<OwnedEvent> events_;  // one a command; null where none was wanted
};

struct QueueInfo {
  bool out_of_order = false;
};

Result<QueueInfo> check_call(const Shared& shared, cl_command_queue queue, const Enqueue& options) {
  const auto bad = [&](const std::string& what) {
    return Status(Code::invalid_argument, shared.plan.kernel + ": " + what);
  };
  if (!queue) return bad("queue is null; expected a cl_command_queue");
  cl_context context = nullptr;
  cl_device_id device = nullptr;
  cl_command_queue_properties properties = 0;
  cl_int error = clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof context, &context, nullptr);
  if (error == CL_SUCCESS) error = clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof device, &device, nullptr);
  if (error == CL_SUCCESS) error = clGetCommandQueueInfo(queue, CL_QUEUE_PROPERTIES, sizeof properties, &properties, nullptr);
  if (error == CL_INVALID_COMMAND_QUEUE) return bad("queue is no command queue");
  if (error != CL_SUCCESS) return failure(error, shared.plan.kernel + ": the queue could not be looked at");
  if (context != shared.device->context.get() || device != shared.device->device)
    return bad("queue belongs to another device; expected one of " + shared.device->name);
  if ((options.wait == nullptr) != (options.wait_count == 0))
    return bad("Enqueue.wait_count is " + std::to_string(options.wait_count) + " and wait is " +
               (options.wait ? "not null" : "null") + "; expected both or neither");
  for (cl_uint i = 0; i < options.wait_count; ++i) {
    if (!options.wait[i]) return bad("Enqueue.wait[" + std::to_string(i) + "] is null; expected a cl_event");
  }
  return QueueInfo{(properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) != 0};
}

/// Sets every pass's memory before anything is enqueued, so that a refusal leaves the queue as it was.
Status set_memory(const Pipeline::State& state, const Arguments& arguments) {
  const Plan& plan = state.shared->plan;
  for (std::size_t p = 0; p < plan.passes.size(); ++p) {
    const Pass& pass = plan.passes[p];
    cl_uint argument = 1;
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      const cl_mem memory = arguments.of(pass.slots[i]);
      const cl_int error = clSetKernelArg(state.kernels[p].get(), argument, sizeof memory, &memory);
      if (error != CL_SUCCESS)
        return failure(error, plan.kernel + ": pass " + pass.label + " refuses binding " +
                                  std::string(pass.module->bindings[i].name));
      argument += is_sampled(pass.module->bindings[i].kind) ? 2 : 1;
    }
  }
  return {};
}

using Tables = std::shared_ptr<const std::vector<float>>;

void CL_CALLBACK release_tables(cl_event, cl_int, void* tables) { delete static_cast<Tables*>(tables); }

/// The write returns at once; the tables outlive the pipeline where it is destroyed before the write happened.
Status write_tables(const Shared& shared, const Range& scratch, Sequence& sequence) {
  const cl_int error = sequence.add(true, [&](const cl_event* waits, cl_uint count, cl_event* event) {
    return clEnqueueWriteBuffer(sequence.queue(), scratch.memory, CL_FALSE, scratch.offset,
                                shared.tables->size() * sizeof(float), shared.tables->data(), count, waits, event);
  });
  if (error != CL_SUCCESS)
    return failure(error, shared.plan.kernel + ": the tables were not enqueued, and no pass was");
  auto* kept = new Tables(shared.tables);
  const cl_event written = sequence.events().back().get();
  if (clSetEventCallback(written, CL_COMPLETE, release_tables, kept) != CL_SUCCESS) {
    clWaitForEvents(1, &written);
    delete kept;
  }
  return {};
}

Status enqueue_pass(const Pipeline::State& state, std::size_t index, bool keep, Sequence& sequence) {
  const Plan& plan = state.shared->plan;
  const Pass& pass = plan.passes[index];
  std::array<std::size_t, 3> global{}, local{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    local[axis] = pass.workgroup[axis];
    global[axis] = local[axis] * pass.groups[axis];
  }
  const cl_int error = sequence.add(keep, [&](const cl_event* waits, cl_uint count, cl_event* event) {
    return clEnqueueNDRangeKernel(sequence.queue(), state.kernels[index].get(), 3, nullptr, global.data(), local.data(),
                                  count, waits, event);
  });
  if (error == CL_SUCCESS) return {};
  const std::string before =
      index == 0 ? "and no other pass is"
                 : "the passes before it are enqueued, so wait for the queue and take the outputs as undefined";
  return failure(error, plan.kernel + ": pass " + std::to_string(index + 1) + " of " +
                            std::to_string(plan.passes.size()) + " (" + pass.label + ") was not enqueued, " + before);
}

}  // namespace

Status Pipeline::enqueue(cl_command_queue queue, const std::vector<Binding>& bindings, const Enqueue& options) const {
  if (!state) return Status(Code::invalid_argument, "pipeline is empty; expected one from opencl::Pipeline::create");
  const Shared& shared = *state->shared;
  const Result<QueueInfo> info = check_call(shared, queue, options);
  if (!info) return info.status();
  const Result<std::vector<Range>> ranges = check_bindings(shared, bindings);
  if (!ranges) return ranges.status();
  Arguments arguments;
  if (Status status = arguments.make(shared, ranges.value()); !status) return status;
  if (Status status = set_memory(*state, arguments); !status) return status;

  Sequence sequence(queue, info.value().out_of_order, options);
  if (shared.tables && !options.tables_current) {
    if (Status status = write_tables(shared, ranges.value().back(), sequence); !status) return status;
  }
  const std::size_t count = shared.plan.passes.size();
  for (std::size_t p = 0; p < count; ++p) {
    const bool keep = options.pass_events || (options.done && p + 1 == count);
    if (Status status = enqueue_pass(*state, p, keep, sequence); !status) return status;
  }
  if (count == 0 && options.done) {
    const cl_int error = sequence.add(true, [&](const cl_event* waits, cl_uint waiting, cl_event* event) {
      return clEnqueueMarkerWithWaitList(queue, waiting, waits, event);
    });
    if (error != CL_SUCCESS) return failure(error, shared.plan.kernel + ": a marker was not enqueued");
  }

  std::vector<OwnedEvent>& events = sequence.events();
  if (options.done) {
    *options.done = events.back().get();
    clRetainEvent(*options.done);
  }
  if (options.pass_events) {
    options.pass_events->clear();
    for (std::size_t p = 0; p < count; ++p) options.pass_events->push_back(events[events.size() - count + p].take());
  }
  return {};
}

}  // namespace luxel::opencl

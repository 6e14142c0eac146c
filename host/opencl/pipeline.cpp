#include "host/opencl/pipeline.h"

#include <array>
#include <cstring>

namespace luxel::opencl {
namespace {

/// The parameters as the kernel's struct holds them: 4-byte scalars; one zero for a kernel without any.
Result<std::vector<std::uint32_t>> parameter_words(const Plan& plan, const Pass& pass) {
  std::vector<std::uint32_t> words(std::max<std::size_t>(1, pass.parameters.size()));
  for (std::size_t i = 0; i < pass.parameters.size(); ++i) {
    const double value = pass.parameters[i];
    const Scalar type = pass.module->parameters[i].type;
    if (type == Scalar::float32) {
      const float narrow = static_cast<float>(value);
      std::memcpy(&words[i], &narrow, sizeof narrow);
      continue;
    }
    const double low = type == Scalar::int32 ? -2147483648.0 : 0.0;
    const double high = type == Scalar::int32 ? 2147483647.0 : 4294967295.0;
    if (!(value >= low && value <= high))
      return Status(Code::internal, plan.kernel + ": parameter " + std::string(pass.module->parameters[i].name) +
                                        " of pass " + pass.label + " is " + std::to_string(value) +
                                        ", which its type cannot hold");
    words[i] = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  }
  return words;
}

bool samples(const Plan& plan, Address address) {
  for (const Pass& pass : plan.passes) {
    for (std::size_t i = 0; i < pass.slots.size(); ++i) {
      if (is_sampled(pass.module->bindings[i].kind) &&
          plan.resources[static_cast<std::size_t>(pass.slots[i].index)].address == address)
        return true;
    }
  }
  return false;
}

Status make_samplers(Shared& shared) {
  shared.samplers.resize(2);
  for (const Address address : {Address::clamp, Address::wrap}) {
    if (!samples(shared.plan, address)) continue;
    const cl_addressing_mode mode = address == Address::clamp ? CL_ADDRESS_CLAMP_TO_EDGE : CL_ADDRESS_REPEAT;
    cl_int error = CL_SUCCESS;
    OwnedSampler sampler(clCreateSampler(shared.device->context.get(), CL_TRUE, mode, CL_FILTER_LINEAR, &error));
    if (error != CL_SUCCESS) return failure(error, shared.plan.kernel + ": a linear sampler could not be made");
    shared.samplers[static_cast<std::size_t>(address)] = std::move(sampler);
  }
  return {};
}

/// Every table as floats, where it lies in scratch.
std::shared_ptr<const std::vector<float>> pack_tables(const Plan& plan) {
  if (plan.tables.empty()) return nullptr;
  constexpr std::size_t stride = table_bytes / sizeof(float);
  auto packed = std::make_shared<std::vector<float>>((plan.tables.size() - 1) * stride + plan.tables.back().size());
  for (std::size_t i = 0; i < plan.tables.size(); ++i) {
    for (std::size_t k = 0; k < plan.tables[i].size(); ++k)
      (*packed)[i * stride + k] = static_cast<float>(plan.tables[i][k]);
  }
  if (packed->empty()) return nullptr;
  return packed;
}

/// A kernel with everything set but its memory.
Result<OwnedKernel> make_kernel(const Shared& shared, std::size_t index) {
  const Plan& plan = shared.plan;
  const Pass& pass = plan.passes[index];
  const std::string who = plan.kernel + ": kernel " + std::string(pass.module->part);
  cl_int error = CL_SUCCESS;
  OwnedKernel kernel(
      clCreateKernel(shared.programs[index]->program.get(), std::string(pass.module->part).c_str(), &error));
  if (error != CL_SUCCESS) return failure(error, who + " could not be made");

  const Result<std::vector<std::uint32_t>> words = parameter_words(plan, pass);
  if (!words) return words.status();
  cl_uint argument = 0;
  error = clSetKernelArg(kernel.get(), argument++, words.value().size() * 4, words.value().data());
  if (error != CL_SUCCESS) return failure(error, who + " refuses its parameters");
  for (std::size_t i = 0; i < pass.slots.size(); ++i) {
    ++argument;
    if (!is_sampled(pass.module->bindings[i].kind)) continue;
    const Resource& resource = plan.resources[static_cast<std::size_t>(pass.slots[i].index)];
    const cl_sampler sampler = shared.samplers[static_cast<std::size_t>(resource.address)].get();
    error = clSetKernelArg(kernel.get(), argument++, sizeof sampler, &sampler);
    if (error != CL_SUCCESS) return failure(error, who + " refuses the sampler of " + resource.name);
  }
  for (const SharedInfo& memory : pass.module->shared) {
    error = clSetKernelArg(kernel.get(), argument++, memory.bytes, nullptr);
    if (error != CL_SUCCESS) return failure(error, who + " refuses workgroup memory " + std::string(memory.name));
  }
  return kernel;
}

/// What the compiled kernel itself allows, which may be less than the device does.
Status check_kernel(const Shared& shared, std::size_t index, cl_kernel kernel) {
  const Pass& pass = shared.plan.passes[index];
  const std::size_t need = std::size_t{pass.workgroup[0]} * pass.workgroup[1] * pass.workgroup[2];
  std::size_t limit = 0;
  const cl_int error = clGetKernelWorkGroupInfo(kernel, shared.device->device, CL_KERNEL_WORK_GROUP_SIZE, sizeof limit,
                                                &limit, nullptr);
  if (error == CL_SUCCESS && need > limit)
    return Status(Code::unsupported, shared.plan.kernel + ": CL_KERNEL_WORK_GROUP_SIZE of pass " + pass.label + " on " +
                                         shared.device->name + " is " + std::to_string(limit) + "; needs " +
                                         std::to_string(need) + " invocations");
  return {};
}

Result<std::vector<OwnedKernel>> make_kernels(const Shared& shared) {
  std::vector<OwnedKernel> kernels;
  for (std::size_t i = 0; i < shared.plan.passes.size(); ++i) {
    Result<OwnedKernel> kernel = make_kernel(shared, i);
    if (!kernel) return kernel.status();
    if (Status status = check_kernel(shared, i, kernel.value().get()); !status) return status;
    kernels.push_back(std::move(kernel).value());
  }
  return kernels;
}

}  // namespace

Result<Pipeline> Pipeline::create(const Device& device, Plan plan) {
  if (!device.state)
    return Status(Code::invalid_argument, plan.kernel + ": device is empty; expected one from opencl::Device::adopt");
  if (Status status = check(plan); !status) return status;
  if (Status status = check_limits(*device.state, plan); !status) return status;
  auto shared = std::make_shared<Shared>();
  shared->device = device.state;
  shared->plan = std::move(plan);
  shared->uses = uses(shared->plan);
  shared->exclusive = exclusive(shared->plan);
  shared->tables = pack_tables(shared->plan);
  for (const Pass& pass : shared->plan.passes) {
    Result<std::shared_ptr<BuiltProgram>> program = program_for(*device.state, shared->plan, pass);
    if (!program) return program.status();
    shared->programs.push_back(std::move(program).value());
  }
  if (Status status = make_samplers(*shared); !status) return status;

  Pipeline first;
  first.state = std::make_shared<State>();
  first.state->shared = std::move(shared);
  return first.clone();
}

Result<Pipeline> Pipeline::clone() const {
  if (!state) return Status(Code::invalid_argument, "pipeline is empty; expected one from opencl::Pipeline::create");
  Result<std::vector<OwnedKernel>> kernels = make_kernels(*state->shared);
  if (!kernels) return kernels.status();
  Pipeline pipeline;
  pipeline.state = std::make_shared<State>();
  pipeline.state->shared = state->shared;
  pipeline.state->kernels = std::move(kernels).value();
  return pipeline;
}

const Plan& Pipeline::plan() const { return state->shared->plan; }

}  // namespace luxel::opencl

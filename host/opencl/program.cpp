#include "host/opencl/program.h"

#include <charconv>
#include <cmath>
#include <cstring>

#include "host/files.h"

namespace luxel::opencl {
namespace {

std::string hex(std::uint64_t value) {
  char digits[16];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, 16).ptr;
  return std::string(sizeof digits - static_cast<std::size_t>(end - digits), '0') + std::string(digits, end);
}

/// A constant as OpenCL C spells it; empty for a value that its type cannot hold.
std::string literal(Scalar type, double value) {
  if (type == Scalar::float32) {
    const float rounded = static_cast<float>(value);
    if (!std::isfinite(rounded)) return {};
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, rounded, std::chars_format::scientific, 8).ptr;
    return std::string(digits, end) + "f";
  }
  const bool is_signed = type == Scalar::int32;
  const double low = is_signed ? -2147483647.0 : 0.0, high = is_signed ? 2147483647.0 : 4294967295.0;
  if (!(value >= low && value <= high) || value != std::floor(value)) return {};
  return std::to_string(static_cast<long long>(value)) + (is_signed ? "" : "u");
}

/// The first line of a driver's log that speaks of an error, else the first line.
std::string first_error(const std::string& log) {
  std::string first;
  for (std::size_t begin = 0; begin < log.size();) {
    std::size_t end = log.find('\n', begin);
    if (end == std::string::npos) end = log.size();
    const std::string line = log.substr(begin, end - begin);
    if (line.find("error") != std::string::npos) return line;
    if (first.empty() && line.find_first_not_of(" \t\r") != std::string::npos) first = line;
    begin = end + 1;
  }
  return first.empty() ? "the driver gives no reason" : first;
}

std::string build_log(cl_program program, cl_device_id device) {
  std::size_t size = 0;
  if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, 0, nullptr, &size) != CL_SUCCESS) return {};
  std::string log(size, '\0');
  if (clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, size, log.data(), nullptr) != CL_SUCCESS) return {};
  return std::string(log.c_str());
}

/// A kept file holds the key before the program, so that two keys of one hash are told apart. A program that no kernel
/// can be made of, because a driver's own settings have changed, is not used either.
OwnedProgram load_binary(const Device::State& device, const Module& module, const std::string& key,
                         const std::string& options) {
  std::vector<std::uint8_t> file;
  if (!read_checked(cache_path(device, key), file)) return {};
  if (file.size() <= key.size() + 1 || std::memcmp(file.data(), key.c_str(), key.size() + 1) != 0) return {};
  const unsigned char* binary = file.data() + key.size() + 1;
  const std::size_t bytes = file.size() - key.size() - 1;
  cl_int status = CL_SUCCESS, error = CL_SUCCESS;
  OwnedProgram program(
      clCreateProgramWithBinary(device.context.get(), 1, &device.device, &bytes, &binary, &status, &error));
  if (error != CL_SUCCESS || status != CL_SUCCESS) return {};
  if (clBuildProgram(program.get(), 1, &device.device, options.c_str(), nullptr, nullptr) != CL_SUCCESS) return {};
  const OwnedKernel kernel(clCreateKernel(program.get(), std::string(module.part).c_str(), &error));
  if (error != CL_SUCCESS) return {};
  return program;
}

/// Failing to keep a program costs the next start its compilation, nothing else.
void store_binary(const Device::State& device, const std::string& key, cl_program program) {
  std::size_t bytes = 0;
  if (clGetProgramInfo(program, CL_PROGRAM_DEVICES, 0, nullptr, &bytes) != CL_SUCCESS) return;
  std::vector<cl_device_id> devices(bytes / sizeof(cl_device_id));
  std::vector<std::size_t> sizes(devices.size());
  if (clGetProgramInfo(program, CL_PROGRAM_DEVICES, bytes, devices.data(), nullptr) != CL_SUCCESS) return;
  bytes = sizes.size() * sizeof(std::size_t);
  if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, bytes, sizes.data(), nullptr) != CL_SUCCESS) return;

  std::vector<std::uint8_t> file(key.begin(), key.end());
  file.push_back(0);
  std::vector<unsigned char*> binaries(devices.size(), nullptr);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i] != device.device || sizes[i] == 0) continue;
    file.resize(key.size() + 1 + sizes[i]);
    binaries[i] = file.data() + key.size() + 1;
  }
  bytes = binaries.size() * sizeof(unsigned char*);
  if (file.size() == key.size() + 1 ||
      clGetProgramInfo(program, CL_PROGRAM_BINARIES, bytes, binaries.data(), nullptr) != CL_SUCCESS)
    return;
  (void)write_checked(cache_path(device, key), file);
}

Result<OwnedProgram> build(const Device::State& device, const Plan& plan, const Module& module, const std::string& key,
                           const std::string& options) {
  const bool keep = device.keep_binaries && !device.cache_directory.empty();
  if (keep) {
    if (OwnedProgram kept = load_binary(device, module, key, options)) return kept;
  }
  const std::string part = plan.kernel + ": " + std::string(module.part) + " (" + std::string(module.name) + ")";
  const char* source = module.opencl.data();
  const std::size_t length = module.opencl.size();
  cl_int error = CL_SUCCESS;
  OwnedProgram program(clCreateProgramWithSource(device.context.get(), 1, &source, &length, &error));
  if (error != CL_SUCCESS) return failure(error, part + " could not be made on " + device.name);
  error = clBuildProgram(program.get(), 1, &device.device, options.c_str(), nullptr, nullptr);
  if (error == CL_BUILD_PROGRAM_FAILURE)
    return Status(Code::compile_failed, part + " does not compile on " + device.name + " (" + device.driver +
                                            "): " + first_error(build_log(program.get(), device.device)));
  if (error != CL_SUCCESS) return failure(error, part + " could not be built on " + device.name);
  if (keep) store_binary(device, key, program.get());
  return program;
}

}  // namespace

Result<std::string> build_options(const Device::State& device, const Plan& plan, const Pass& pass) {
  std::string options = device.base_options;
  const char axes[] = {'X', 'Y', 'Z'};
  for (std::size_t axis = 0; axis < 3; ++axis)
    options += std::string(" -D WORKGROUP_") + axes[axis] + "=" + std::to_string(pass.workgroup[axis]);
  for (std::size_t i = 0; i < pass.constants.size(); ++i) {
    const ConstantInfo& constant = pass.module->constants[i];
    const std::string value = literal(constant.type, pass.constants[i]);
    if (value.empty())
      return Status(Code::internal, plan.kernel + ": constant " + std::string(constant.name) + " of pass " +
                                        pass.label + " is " + std::to_string(pass.constants[i]) +
                                        ", which its type cannot hold");
    options += " -D " + std::string(constant.name) + "=" + value;
  }
  return options;
}

std::string cache_path(const Device::State& device, const std::string& key) {
  return device.cache_directory + "/opencl/" + hex(fnv1a(key.data(), key.size())) + ".bin";
}

Result<std::shared_ptr<BuiltProgram>> program_for(Device::State& device, const Plan& plan, const Pass& pass) {
  const Module& module = *pass.module;
  const Result<std::string> options = build_options(device, plan, pass);
  if (!options) return options.status();
  const std::string key = std::string(module.kernel) + " " + std::string(module.part) + " " + std::string(module.name) +
                          " " + hex(module.hash) + "\n" + options.value() + "\n" + device.name + "\n" + device.driver;
  std::shared_ptr<BuiltProgram> entry;
  {
    const std::lock_guard lock(device.mutex);
    std::shared_ptr<BuiltProgram>& place = device.programs[key];
    if (!place) place = std::make_shared<BuiltProgram>();
    entry = place;
  }
  const std::lock_guard lock(entry->mutex);
  if (!entry->program) {
    Result<OwnedProgram> program = build(device, plan, module, key, options.value());
    if (!program) return program.status();
    entry->program = std::move(program).value();
  }
  return entry;
}

}  // namespace luxel::opencl

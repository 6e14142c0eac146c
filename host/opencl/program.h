// Programs: one per module, constants and workgroup; from the device's memory, the disk, or the driver's compiler.
#pragma once
#include "host/opencl/device.h"
#include "host/module.h"

namespace luxel::opencl {

/// The program of a pass, built if no pipeline of the device has it yet. Errors: compile_failed with the first error
/// line of the driver's log, out_of_memory, internal.
Result<std::shared_ptr<BuiltProgram>> program_for(Device::State& device, const Plan& plan, const Pass& pass);

/// The build options of a pass: standard, workgroup, constants.
Result<std::string> build_options(const Device::State& device, const Plan& plan, const Pass& pass);

/// The file in `cache_directory` that a program with this key is kept in.
std::string cache_path(const Device::State& device, const std::string& key);

}  // namespace luxel::opencl

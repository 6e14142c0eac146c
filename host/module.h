// Module: what the build knows about one kernel source with one choice of options.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <luxel/plan.h>

namespace luxel {

namespace reference { struct Dispatch; }

enum class BindingKind { read, write, update, texels, uniform, image2d, image3d, sampled2d, sampled3d,
                         image_write2d, image_read2d };

struct BindingInfo {
  BindingKind kind;
  int slot;               // Vulkan binding number
  std::string_view type;  // element type as the dialect spells it: f32x4, vec4, uint ...
  std::string_view name;
  int count;              // floats of a uniform table, else 0
};

enum class Scalar { int32, uint32, float32 };

struct ParameterInfo {
  Scalar type;
  std::string_view name;
};

struct ConstantInfo {
  int id;                 // Vulkan constant_id
  Scalar type;
  std::string_view name;
  double fallback;
  bool shape;             // decides speed only; fixed to `fallback` in the C++ execution
};

struct SharedInfo {       // workgroup memory
  std::size_t bytes;
  std::string_view name;
};

struct Module {
  std::string_view kernel;  // "gaussian_blur"
  std::string_view part;    // stem of the kernel file
  std::string_view name;    // the option combination, "f32x4"
  std::span<const BindingInfo> bindings;
  std::span<const ParameterInfo> parameters;
  std::span<const ConstantInfo> constants;
  std::span<const SharedInfo> shared;
  std::span<const std::uint32_t> spirv;
  std::string_view opencl;  // flat OpenCL C, constants given as -D NAME=value
  std::string_view glsl;    // flat GLSL, what spirv was compiled from
  std::uint64_t hash;       // of the sources above
  void (*run_float)(const reference::Dispatch&);
  void (*run_double)(const reference::Dispatch&);
};

/// Every module that is built in, in a fixed order.
std::span<const Module* const> modules();

/// The module of a part with an option combination, or null.
const Module* find_module(std::string_view part, std::string_view name);

/// Constants given as OpenCL -D options or Vulkan specialization data use these ids beside the module's own.
constexpr int workgroup_constant_id = 100;  // x, y, z: 100, 101, 102

}  // namespace luxel

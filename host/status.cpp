#include <luxel/plan.h>
#include <luxel/status.h>

namespace luxel {

const char* name(Code code) {
  switch (code) {
    case Code::ok: return "ok";
    case Code::invalid_argument: return "invalid_argument";
    case Code::unsupported: return "unsupported";
    case Code::missing_driver: return "missing_driver";
    case Code::compile_failed: return "compile_failed";
    case Code::out_of_memory: return "out_of_memory";
    case Code::device_lost: return "device_lost";
    case Code::io: return "io";
    case Code::internal: return "internal";
  }
  return "unknown";
}

const char* name(Format format) {
  switch (format) {
    case Format::f32x1: return "f32x1";
    case Format::f32x2: return "f32x2";
    case Format::f32x4: return "f32x4";
    case Format::f16x2: return "f16x2";
    case Format::f16x4: return "f16x4";
    case Format::unorm8x4: return "unorm8x4";
    case Format::u32: return "u32";
  }
  return "unknown";
}

}  // namespace luxel

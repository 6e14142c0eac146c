// How tests run plans: devices by name, pixels in storage formats, guard bands behind every output.
#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <luxel/device.h>

namespace luxel {

using Bytes = std::vector<std::uint8_t>;

/// What the tests run on: the environment variable LUXEL_BACKENDS (names for Context::open, divided by spaces or commas),
/// default "opencl vulkan cpu" as far as the build has them.
const std::vector<std::string>& test_devices();

/// A device, opened once a process. One that is missing throws, which fails the test.
Context& test_context(const std::string& device);

/// Values as a format stores them; with `real64` every channel is a double, as cpu:double has them.
Bytes encode(Format format, const std::vector<float>& values, bool real64 = false);
std::vector<double> decode(Format format, const Bytes& bytes, bool real64 = false);
/// Value `index` of these.
double decode_at(Format format, const Bytes& bytes, std::size_t index);

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

using NamedBytes = std::vector<std::pair<std::string, Bytes>>;

/// Uploads `inputs`, runs the plan and returns `outputs`, in that order. Resources that are not given begin as a pattern
/// (texels that no pass writes show it). Fails the test when the pattern behind a resource changed, when the validation
/// layers spoke, and when a call failed (the outputs are then empty).
std::vector<Bytes> run_bytes(Context& context, const Plan& plan, const NamedBytes& inputs,
                             const std::vector<std::string>& outputs);

/// The byte that unwritten memory and guard bands hold.
constexpr std::uint8_t guard_byte = 0xa5;

}  // namespace luxel

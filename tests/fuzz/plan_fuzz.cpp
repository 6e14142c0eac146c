// Every kernel's parameters from bytes, by name as `luxel emit --options` sets them: validate() and plan() refuse in one
// line, or give a plan that fits its modules and that a host can carry out.
#include <cmath>
#include <iterator>

#include "bench/emit/kernels.h"
#include "host/bindings.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace luxel;

/// A number as text: an edge of a type or of a range, a small one, or any.
std::string number(fuzz::Bytes& bytes) {
  static constexpr const char* edges[] = {
      "0", "1", "-1", "2", "3", "7", "8", "16", "31", "32", "33", "63", "64", "65", "255", "256", "257", "1023", "1024", "2047",
      "2048", "4095", "4096", "4097", "65535", "65536", "2147483647", "-2147483648", "4294967295", "nan", "inf", "-inf", "1e-45",
      "1e-300", "1e38", "3.5e38", "1e300", "-0", "0.5", "0.999999", "1.000001", "1e-6", "10000", "16384", "16777216"};
  switch (bytes.below(4)) {
    case 0: case 1: return edges[bytes.below(std::size(edges))];
    case 2: return std::to_string(bytes.below(256));
    default: {
      char text[40];
      std::snprintf(text, sizeof text, "%.9g", static_cast<double>(bytes.value<float>()));
      return text;
    }
  }
}

/// One of the names that a field takes: "one of clamp, mirror, wrap".
std::string choice(fuzz::Bytes& bytes, const std::string& takes) {
  std::vector<std::string> names;
  for (std::size_t at = 7; at <= takes.size();) {
    const std::size_t end = std::min(takes.find(", ", at), takes.size());
    names.push_back(takes.substr(at, end - at));
    at = end + 2;
  }
  return names[bytes.below(names.size())];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  const emit::Kernel& kernel = emit::kernels()[bytes.below(emit::kernels().size())];
  static constexpr const char* profiles[] = {"reference", "pocl", "lavapipe", "gpu", "opencl_gpu"};
  const Profile profile = luxel::profile(profiles[bytes.below(5)]);
  // Small, so that what is set beyond it is looked at, and not the time that large tables take.
  emit::Settings settings = emit::sized(kernel, std::vector<int>(3, 1 + static_cast<int>(bytes.below(64))));
  while (!bytes.empty() && settings.size() < 16) {
    const auto& [name, takes] = kernel.fields[bytes.below(kernel.fields.size())];
    std::string value;
    if (takes.starts_with("one of ")) value = choice(bytes, takes);
    else if (takes.starts_with("0 or 1")) value = bytes.below(2) ? "1" : "0";
    else if (takes.starts_with("numbers")) value = number(bytes) + "x" + number(bytes) + "x" + number(bytes);
    else if (bytes.below(32) == 0) value = bytes.text(12);
    else value = number(bytes);
    settings.emplace_back(name, value);
  }
  const Result<Plan> made = kernel.plan(settings, profile);
  if (!made) {
    fuzz::require_one_line(made.status());
    fuzz::require(made.status().code() != Code::internal, "parameters are no defect of luxel:", made.status().message());
    return 0;
  }
  const Plan& plan = made.value();
  const Status fits = check(plan);
  fuzz::require(fits.ok(), "a plan fits its modules:", kernel.name + ": " + fits.message());
  std::string what = kernel.name;
  for (const auto& [key, value] : settings) what += " " + key + "=" + value;
  for (const ScratchRegion& region : plan.scratch)
    fuzz::require(region.offset % 1024 == 0 && region.offset <= plan.scratch_bytes &&
                      region.count <= (plan.scratch_bytes - region.offset) / bytes_per_pixel(region.format),
                  "scratch regions lie in the scratch buffer:", what);
  for (const Resource& resource : plan.resources)
    for (const int extent : resource.extent) fuzz::require(extent >= 1, "extents are positive:", what + " " + resource.name);
  // Parameters may be NaN: validate() does not look at the fields of what is switched off, and no pass reads them.
  for (const Pass& pass : plan.passes) {
    for (const std::uint32_t n : pass.groups) fuzz::require(n >= 1, "every pass has workgroups:", what + ", " + pass.label);
    for (const double c : pass.constants) fuzz::require(std::isfinite(c), "constants are finite:", what + ", " + pass.label);
  }
  fuzz::require(std::isfinite(plan.flops) && plan.flops >= 0 && std::isfinite(plan.bytes) && plan.bytes >= 0,
                "work is counted:", what);
  return 0;
}

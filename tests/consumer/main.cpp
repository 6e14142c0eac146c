// Finds surfaces' edges with the C++ execution, and on every device of the executions that were built in.
#include <cstdint>
#include <cstdio>
#include <vector>

#include <luxel/device.h>
#include <luxel/discontinuity_mask.h>
#include <luxel/reference.h>
#include <luxel/version.h>

static_assert(LUXEL_VERSION >= 100, "version.h");

int main() {
  luxel::DiscontinuityMaskParams params;
  params.width = 16;
  params.height = 8;
  params.normal = false;
  std::vector<float> depth(16 * 8, 1.0f);
  for (int y = 0; y < 8; ++y) depth[static_cast<std::size_t>(16 * y + 5)] = 9.0f;  // a wall behind, one pixel wide

  std::vector<std::uint32_t> first;
  for (const luxel::DeviceInfo& device : luxel::devices()) {
    const auto context = luxel::Context::open(device.id);
    if (!context) return std::fprintf(stderr, "%s\n", context.status().message().c_str()), 1;
    if (context.value()->real64()) continue;
    const auto plan = luxel::plan(params, context.value()->profile());
    if (!plan) return std::fprintf(stderr, "%s\n", plan.status().message().c_str()), 1;
    const auto program = context.value()->compile(plan.value());
    if (!program) return std::fprintf(stderr, "%s\n", program.status().message().c_str()), 1;
    std::vector<luxel::Named> bound;
    std::shared_ptr<luxel::Memory> mask;
    for (const luxel::Resource& resource : plan.value().resources) {
      auto memory = context.value()->make(resource);
      if (!memory) return std::fprintf(stderr, "%s\n", memory.status().message().c_str()), 1;
      if (resource.written) mask = memory.value();
      else if (!context.value()->upload(*memory.value(), depth.data(), resource.bytes)) return 1;
      bound.push_back({resource.name, memory.value()});
    }
    if (auto s = context.value()->run(*program.value(), bound); !s) return std::fprintf(stderr, "%s\n", s.message().c_str()), 1;
    std::vector<std::uint32_t> result(16 * 8);
    if (!context.value()->download(*mask, result.data(), result.size() * 4)) return 1;
    if (first.empty()) first = result;
    // Bit 0: an edge to the right. The wall has one on each side; the image ends in one.
    for (int i = 0; i < 16 * 8; ++i)
      if (((result[static_cast<std::size_t>(i)] & 1u) != 0) != (i % 16 == 4 || i % 16 == 5 || i % 16 == 15) || result != first)
        return std::fprintf(stderr, "%s: pixel %d is %u\n", device.id.c_str(), i, result[static_cast<std::size_t>(i)]), 1;
    std::printf("%s: edges found\n", device.id.c_str());
  }
  return first.empty();
}

// The probe kernel uses every word of the dialect on every execution, so that a driver that gets one wrong is known by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <luxel/reference.h>

#include "host/module.h"
#include "tests/support/probe_list.h"
#include "tests/support/run.h"

namespace luxel::built_in {
extern const std::span<const Module* const> probe;
}

namespace luxel {
namespace {

constexpr int width = 48, height = 5, numbers_count = 64, words = 16;

Format format_of(const Module& module) {
  for (const Format format : {Format::f32x1, Format::f32x2, Format::f32x4, Format::f16x2, Format::f16x4, Format::unorm8x4})
    if (module.name == name(format)) return format;
  return Format::u32;
}

Plan probe_plan(const Module& module, const Profile& profile) {
  const Format format = format_of(module);
  const int n = channels(format);
  const int lanes = profile.rows.lanes ? profile.rows.lanes : n;
  Plan plan;
  plan.kernel = "probe";
  const auto add = [&](const char* name, Format f, std::size_t count, bool written) {
    Resource resource{name};
    resource.format = f;
    resource.bytes = count * bytes_per_pixel(f);
    resource.written = written;
    plan.resources.push_back(resource);
  };
  add("src", format, width * height, false);
  add("dst", format, width * height, true);
  add("counters", Format::u32, 4, true);
  add("numbers", Format::f32x1, numbers_count, false);
  add("results", Format::f32x1, numbers_count * words, true);
  add("bits", Format::u32, numbers_count * 4, true);
  plan.resources[0].may_alias = true;
  std::vector<double> table(16);
  for (int i = 0; i < 16; ++i) table[i] = i * 0.125;
  plan.tables = plan.exact_tables = {table};
  plan.scratch_bytes = table_bytes;
  Pass pass;
  pass.module = &module;
  pass.label = "probe";
  const auto resource = [](int i) { return Slot{Slot::Source::resource, i}; };
  pass.slots = {resource(0), resource(1), {Slot::Source::table, 0}, resource(2), resource(3), resource(4), resource(5), resource(0)};
  pass.parameters = {width, 0.75, 5, height};
  pass.constants = {2, 0.5, 7, static_cast<double>(lanes)};
  pass.workgroup = {64, 1, 1};
  pass.groups = {2, height, 1};
  plan.passes = {pass};
  return plan;
}

// A result that languages may round differently stands in no kernel; every word here gives equal bits.
const char* word_of(std::size_t which) {
  static const char* const names[] = {"+ - * /", "sqrt abs floor", "min max clamp", "vec4 members", "integers", "bits of floats",
                                      "sums", "border_index", "isnan isinf", "ceil sign", "table and constants", "parameters",
                                      "uint parameters and constants", "vec2 vec3", "invocation ids", "denormals"};
  return names[which];
}

class Probe : public testing::TestWithParam<const Module*> {};

TEST_P(Probe, EveryWordGivesTheSameBitsOnEveryExecution) {
  const Module& module = *GetParam();
  const Format format = format_of(module);
  std::vector<float> numbers(numbers_count);
  for (int i = 0; i < numbers_count; ++i) numbers[i] = std::sin(i * 1.7f) * std::exp2(static_cast<float>(i % 9 - 4));
  numbers[60] = 0.0f;
  numbers[61] = 1e-40f;
  numbers[62] = 3e5f;
  numbers[63] = -70000.0f;
  std::vector<float> pixels(static_cast<std::size_t>(width) * height * channels(format));
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = 0.5f + 0.49f * std::sin(i * 0.37f);

  std::map<std::string, std::vector<std::vector<std::uint8_t>>> outputs;
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    const Plan plan = probe_plan(module, context.profile());
    std::vector<std::uint32_t> counters{0, 0, 1000000, 7};
    std::vector<Bytes> out = run_bytes(context, plan,
                                       {{"src", encode(format, pixels)}, {"numbers", bytes_of(numbers)}, {"counters", bytes_of(counters)}},
                                       {"dst", "counters", "results", "bits"});
    outputs[device] = out;
    const auto* count = reinterpret_cast<const std::uint32_t*>(out[1].data());
    EXPECT_EQ(count[0], 128u * height) << device << " atomic_add";
    EXPECT_EQ(count[1], 127u) << device << " atomic_max";
    EXPECT_EQ(count[2], 873u) << device << " atomic_min";
    EXPECT_EQ(count[3], 9u) << device << " atomic_compare_swap";
    const auto* bits = reinterpret_cast<const std::uint32_t*>(out[3].data());
    for (int i = 0; i < numbers_count; ++i) EXPECT_EQ(bits[i * 4 + 2], 63u - i) << device << " workgroup memory and barrier, " << i;
  }
  const auto& expected = outputs.begin()->second;
  for (const auto& [device, out] : outputs) {
    const auto* a = reinterpret_cast<const std::uint32_t*>(expected[2].data());
    const auto* b = reinterpret_cast<const std::uint32_t*>(out[2].data());
    for (std::size_t i = 0; i < numbers_count * words; ++i)
      EXPECT_EQ(a[i], b[i]) << device << ": " << word_of(i % words) << " of number " << i / words;
    EXPECT_EQ(expected[3], out[3]) << device << " packing";
    EXPECT_EQ(expected[0], out[0]) << device << " pixels of " << module.name;
  }
}

// Lengths around a workgroup, and a launch that is too short for one item an invocation.
TEST(ProbeList, EveryItemIsMetOnceHoweverTheWorkgroupsAreCounted) {
  for (const std::string& device : test_devices()) {
    Context& context = test_context(device);
    for (const std::uint32_t most : {3u, 40u})
      for (const std::size_t length : {0, 1, 32, 33, 500, 1000}) {
        std::vector<std::uint32_t> marked(probe_items, 0), done(probe_items + 1, 0);
        for (std::size_t i = 0; i < length; ++i) marked[i * 7 % probe_items] = 1;
        const Plan plan = probe_list_plan(most);
        const auto out = run_bytes(context, plan, {{"marked", bytes_of(marked)}, {"done", bytes_of(done)}}, {"done"});
        std::memcpy(done.data(), out[0].data(), 4 * done.size());
        for (std::size_t i = 0; i < probe_items; ++i)
          ASSERT_EQ(done[i], marked[i]) << device << ": item " << i << " of " << length << " in " << most << " workgroups";
        const bool fixed = context.info().api == Api::opencl;
        EXPECT_EQ(done[probe_items], fixed ? most : std::min<std::uint32_t>(most, (length + 31) / 32))
            << device << ": workgroups for " << length << " items";
      }
  }
}

TEST(ProbeList, MoreWorkgroupsThanPlannedAreRefusedByTheCppExecution) {
  Plan plan = probe_list_plan(3);
  plan.passes[0].parameters[2] = 4;
  std::vector<std::uint32_t> marked(probe_items, 1), done(probe_items + 1, 0);
  const Status status = reference::run(plan, {{"marked", marked.data(), 4 * marked.size()}, {"done", done.data(), 4 * done.size()}});
  EXPECT_EQ(status.code(), Code::internal);
  EXPECT_EQ(status.message(), "probe: pass walk finds 4 workgroups; at most 3 were planned");
}

INSTANTIATE_TEST_SUITE_P(Formats, Probe, testing::ValuesIn(built_in::probe.begin(), built_in::probe.end()),
                         [](const auto& info) { return std::string(info.param->name); });

}  // namespace
}  // namespace luxel

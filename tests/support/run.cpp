#include "tests/support/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <stdexcept>

#include <luxel/reference.h>

#include "host/reference/words.h"

namespace luxel {
namespace {

constexpr std::size_t guard_bytes = 4096;

int storage_bytes(Format format) { return static_cast<int>(bytes_per_pixel(format)) / channels(format); }

void expect_ok(const Status& status, const char* what) {
  if (!status) throw std::runtime_error(std::string(what) + ": " + status.message());
}

template <class T>
T expect_value(Result<T> result, const char* what) {
  expect_ok(result.status(), what);
  return std::move(result).value();
}

std::vector<Bytes> run_or_throw(Context& context, const Plan& plan, const NamedBytes& inputs,
                                const std::vector<std::string>& outputs) {
  const auto precision = context.real64() ? reference::Precision::real64 : reference::Precision::real32;
  const auto given = [&](const std::string& name) {
    return std::find_if(inputs.begin(), inputs.end(), [&](const auto& input) { return input.first == name; });
  };
  const auto program = expect_value(context.compile(plan), "compile");
  std::vector<Named> named;
  for (const Resource& resource : plan.resources) {
    const bool guarded = resource.kind == ResourceKind::buffer;
    const std::size_t size = reference::resource_bytes(resource, precision);
    auto memory = expect_value(context.make(resource, guarded ? size + guard_bytes : 0), "make");
    Bytes content(guarded ? size + guard_bytes : size, guard_byte);
    if (const auto input = given(resource.name); input != inputs.end()) {
      if (input->second.size() > size)
        throw std::runtime_error(resource.name + " has " + std::to_string(size) + " bytes; the test gives " +
                                 std::to_string(input->second.size()));
      std::copy(input->second.begin(), input->second.end(), content.begin());
    }
    expect_ok(context.upload(*memory, content.data(), content.size()), "upload");
    named.push_back({resource.name, memory});
  }
  expect_ok(context.run(*program, named), "run");
  for (const std::string& message : context.validation_messages()) ADD_FAILURE() << message;

  std::vector<Bytes> results(outputs.size());
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const Resource& resource = plan.resources[i];
    const auto wanted = std::find(outputs.begin(), outputs.end(), resource.name);
    if (!resource.written && wanted == outputs.end()) continue;
    const std::size_t size = reference::resource_bytes(resource, precision);
    Bytes content(resource.kind == ResourceKind::buffer ? size + guard_bytes : size);
    expect_ok(context.download(*named[i].memory, content.data(), content.size()), "download");
    const auto changed = std::find_if(content.begin() + static_cast<std::ptrdiff_t>(size), content.end(),
                                      [](std::uint8_t byte) { return byte != guard_byte; });
    EXPECT_EQ(changed, content.end()) << plan.kernel << " on " << context.info().id << " wrote "
                                      << changed - content.begin() - static_cast<std::ptrdiff_t>(size)
                                      << " bytes behind the end of " << resource.name;
    content.resize(size);
    if (wanted != outputs.end()) results[static_cast<std::size_t>(wanted - outputs.begin())] = std::move(content);
  }
  return results;
}

}  // namespace

const std::vector<std::string>& test_devices() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    const char* const chosen = std::getenv("LUXEL_BACKENDS");
    std::string text = chosen ? chosen : LUXEL_OPENCL && LUXEL_VULKAN ? "opencl vulkan cpu"
                                     : LUXEL_OPENCL                 ? "opencl cpu"
                                     : LUXEL_VULKAN                 ? "vulkan cpu"
                                                                    : "cpu";
    std::replace(text.begin(), text.end(), ',', ' ');
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      if (end > at) found.push_back(text.substr(at, end - at));
      at = end + 1;
    }
    return found;
  }();
  return names;
}

namespace {

std::map<std::string, std::shared_ptr<Context>>& open_contexts() {
  static std::map<std::string, std::shared_ptr<Context>> open;
  return open;
}

// Devices are closed before exit: a driver's own statics may be gone by the time ours are destroyed.
struct Closing : testing::Environment {
  void TearDown() override { open_contexts().clear(); }
};
const testing::Environment* const closing = testing::AddGlobalTestEnvironment(new Closing);

}  // namespace

Context& test_context(const std::string& device) {
  std::shared_ptr<Context>& context = open_contexts()[device];
  if (!context) context = expect_value(Context::open(device), device.c_str());
  return *context;
}

Bytes encode(Format format, const std::vector<float>& values, bool real64) {
  if (real64) return bytes_of(std::vector<double>(values.begin(), values.end()));
  switch (storage_bytes(format)) {
    case 1: {
      Bytes bytes;
      for (const float v : values) bytes.push_back(static_cast<std::uint8_t>(reference::unorm8_bits(v)));
      return bytes;
    }
    case 2: {
      std::vector<std::uint16_t> halves;
      for (const float v : values) halves.push_back(static_cast<std::uint16_t>(reference::f16_bits(v)));
      return bytes_of(halves);
    }
    default: return bytes_of(values);
  }
}

double decode_at(Format format, const Bytes& bytes, std::size_t index) {
  const auto read = [&](auto stored) {
    std::memcpy(&stored, bytes.data() + index * sizeof stored, sizeof stored);
    return stored;
  };
  switch (storage_bytes(format)) {
    case 1: return static_cast<double>(reference::unorm8_value(read(std::uint8_t{})));
    case 2: return static_cast<double>(reference::f16_value(read(std::uint16_t{})));
    default: return static_cast<double>(read(float{}));
  }
}

std::vector<double> decode(Format format, const Bytes& bytes, bool real64) {
  std::vector<double> values(bytes.size() / (real64 ? sizeof(double) : static_cast<std::size_t>(storage_bytes(format))));
  if (real64) {
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  } else {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = decode_at(format, bytes, i);
  }
  return values;
}

std::vector<Bytes> run_bytes(Context& context, const Plan& plan, const NamedBytes& inputs,
                             const std::vector<std::string>& outputs) {
  try {
    return run_or_throw(context, plan, inputs, outputs);
  } catch (const std::exception& failure) {
    ADD_FAILURE() << plan.kernel << " on " << context.info().id << ": " << failure.what();
    return std::vector<Bytes>(outputs.size());
  }
}

}  // namespace luxel

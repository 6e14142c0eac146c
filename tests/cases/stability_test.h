// Runs a kernel's cases as tests, on every device of the tests and on the execution in double.
#pragma once
#include <gtest/gtest.h>

#include <cctype>

#include "tests/cases/case.h"
#include "tests/support/run.h"

namespace luxel::cases {

struct Where {
  std::string device;
  Case what;
};

inline std::ostream& operator<<(std::ostream& out, const Where& where) {
  return out << where.device << ": " << where.what.name;
}

inline std::vector<Where> everywhere(const std::vector<Case>& cases, bool slow) {
  std::vector<Where> all;
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (const std::string& device : devices)
    for (const Case& c : cases)
      if (c.slow == slow &&
          !(device == "cpu:double" && c.applies && !c.applies({0, Api::cpu, "", "", "", "cpu:double"})))
        all.push_back({device, c});
  return all;
}

/// GoogleTest takes letters, digits and underscores.
inline std::string test_name(const testing::TestParamInfo<Where>& info) {
  std::string name = info.param.device + "_" + info.param.what.name + "_" + std::to_string(info.index);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return name;
}

inline void check(const Where& where) {
  Context& context = test_context(where.device);
  if (!applies(where.what, context.info())) GTEST_SKIP() << "does not apply to " << context.info().id;
  const Result<double> measured = where.what.measure(context);
  if (measured.status().code() == Code::unsupported) GTEST_SKIP() << measured.status().message();
  ASSERT_TRUE(measured.ok()) << measured.status().message();
  EXPECT_TRUE(kept(where.what, measured.value()))
      << where.what.promise << ": measured " << measured.value() << ", bound " << where.what.bound;
  for (const std::string& message : context.validation_messages()) ADD_FAILURE() << message;
}

}  // namespace luxel::cases

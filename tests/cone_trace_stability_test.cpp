// Every extreme case of cone_trace, on every device.
#include "tests/cases/cone_trace_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class ConeTraceStability : public testing::TestWithParam<Where> {};

TEST_P(ConeTraceStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, ConeTraceStability, testing::ValuesIn(everywhere(cone_trace_cases(), false)), test_name);

class ConeTraceStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(ConeTraceStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, ConeTraceStabilityFull, testing::ValuesIn(everywhere(cone_trace_cases(), true)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

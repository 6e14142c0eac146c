// Every extreme case of probe_irradiance and probe_shade, on every device.
#include "tests/cases/probe_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class ProbeStability : public testing::TestWithParam<Where> {};

TEST_P(ProbeStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, ProbeStability, testing::ValuesIn(everywhere(probe_cases(), false)), test_name);

}  // namespace
}  // namespace luxel::cases

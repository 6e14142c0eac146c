// Every extreme case of light_propagation, on every device.
#include "tests/cases/light_propagation_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class LightPropagationStability : public testing::TestWithParam<Where> {};

TEST_P(LightPropagationStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, LightPropagationStability, testing::ValuesIn(everywhere(light_propagation_cases(), false)), test_name);

class LightPropagationStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(LightPropagationStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, LightPropagationStabilityFull, testing::ValuesIn(everywhere(light_propagation_cases(), true)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

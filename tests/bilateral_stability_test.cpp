// Every extreme case of bilateral, on every device.
#include "tests/cases/bilateral_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class BilateralStability : public testing::TestWithParam<Where> {};

TEST_P(BilateralStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, BilateralStability, testing::ValuesIn(everywhere(bilateral_cases(), false)),
                         test_name);

class BilateralStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(BilateralStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, BilateralStabilityFull, testing::ValuesIn(everywhere(bilateral_cases(), true)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

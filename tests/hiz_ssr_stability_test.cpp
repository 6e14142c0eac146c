// Every extreme case of hiz_ssr, on every device.
#include "tests/cases/hiz_ssr_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class HizSsrStability : public testing::TestWithParam<Where> {};

TEST_P(HizSsrStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, HizSsrStability, testing::ValuesIn(everywhere(hiz_ssr_cases(), false)), test_name);

class HizSsrStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(HizSsrStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, HizSsrStabilityFull, testing::ValuesIn(everywhere(hiz_ssr_cases(), true)), test_name);

}  // namespace
}  // namespace luxel::cases

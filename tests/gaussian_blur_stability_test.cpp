// Every extreme case of gaussian_blur, on every device.
#include "tests/cases/gaussian_blur_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class GaussianBlurStability : public testing::TestWithParam<Where> {};

TEST_P(GaussianBlurStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, GaussianBlurStability, testing::ValuesIn(everywhere(gaussian_blur_cases(), false)),
                         test_name);

class GaussianBlurStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(GaussianBlurStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, GaussianBlurStabilityFull, testing::ValuesIn(everywhere(gaussian_blur_cases(), true)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

// Every extreme case of mip_build, on every device.
#include "tests/cases/mip_build_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class MipBuildStability : public testing::TestWithParam<Where> {};

TEST_P(MipBuildStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, MipBuildStability, testing::ValuesIn(everywhere(mip_build_cases(), false)), test_name);

class MipBuildStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(MipBuildStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, MipBuildStabilityFull, testing::ValuesIn(everywhere(mip_build_cases(), true)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

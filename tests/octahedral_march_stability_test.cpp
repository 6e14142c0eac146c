// Every extreme case of octahedral_march, on every device.
#include "tests/cases/octahedral_march_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class OctahedralMarchStability : public testing::TestWithParam<Where> {};

TEST_P(OctahedralMarchStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, OctahedralMarchStability, testing::ValuesIn(everywhere(octahedral_march_cases(), false)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

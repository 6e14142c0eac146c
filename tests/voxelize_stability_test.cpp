// Every extreme case of voxelize, on every device.
#include "tests/cases/voxelize_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class VoxelizeStability : public testing::TestWithParam<Where> {};

TEST_P(VoxelizeStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, VoxelizeStability, testing::ValuesIn(everywhere(voxelize_cases(), false)), test_name);

class VoxelizeStabilityFull : public testing::TestWithParam<Where> {};

TEST_P(VoxelizeStabilityFull, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, VoxelizeStabilityFull, testing::ValuesIn(everywhere(voxelize_cases(), true)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

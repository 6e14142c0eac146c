// Every extreme case of voxel_inject, on every device.
#include "tests/cases/voxel_inject_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

class VoxelInjectStability : public testing::TestWithParam<Where> {};

TEST_P(VoxelInjectStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, VoxelInjectStability, testing::ValuesIn(everywhere(voxel_inject_cases(), false)),
                         test_name);

}  // namespace
}  // namespace luxel::cases

// Every extreme case of injection, look-up and filter of light volumes, on every device.
#include "tests/cases/lpv_cases.h"
#include "tests/cases/stability_test.h"

namespace luxel::cases {
namespace {

std::vector<Case> all() {
  std::vector<Case> cases = lpv_inject_cases();
  for (auto more : {lpv_geometry_cases(), lpv_sample_cases()}) cases.insert(cases.end(), more.begin(), more.end());
  return cases;
}

class LpvStability : public testing::TestWithParam<Where> {};

TEST_P(LpvStability, KeepsItsPromise) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cases, LpvStability, testing::ValuesIn(everywhere(all(), false)), test_name);

}  // namespace
}  // namespace luxel::cases

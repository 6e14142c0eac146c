#include "tests/cases/light_propagation_cases.h"

namespace luxel::cases {

std::vector<Case> light_propagation_cases() {
  std::vector<Case> cases;
  add_lpv_flux_cases(cases);
  add_lpv_value_cases(cases);
  return cases;
}

}  // namespace luxel::cases

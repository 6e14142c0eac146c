#include "tests/support/property.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace luxel {

std::vector<int> shrink(const std::vector<Chosen>& numbers, std::vector<int> failing, const Property& property) {
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (const int simpler : {numbers[i].low, numbers[i].low + (failing[i] - numbers[i].low) / 2, failing[i] - 1}) {
        if (simpler < numbers[i].low || simpler >= failing[i]) continue;
        std::vector<int> tried = failing;
        tried[i] = simpler;
        if (property(tried).empty()) continue;
        failing = tried;
        smaller = true;
        break;
      }
  }
  return failing;
}

void for_all(const std::vector<Chosen>& numbers, int count, const Property& property) {
  std::uint64_t state = 0x9e3779b97f4a7c15;
  const auto random = [&] {  // xorshift64*
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return static_cast<std::uint32_t>((state * 0x2545f4914f6cdd1d) >> 32);
  };
  for (int k = 0; k < count; ++k) {
    std::vector<int> numbers_of_case;
    for (const Chosen& c : numbers)
      numbers_of_case.push_back(c.low + static_cast<int>(random() % static_cast<std::uint32_t>(c.high - c.low + 1)));
    if (property(numbers_of_case).empty()) continue;
    const std::vector<int> smallest = shrink(numbers, numbers_of_case, property);
    std::string text;
    for (std::size_t i = 0; i < numbers.size(); ++i) text += std::string(" ") + numbers[i].name + "=" + std::to_string(smallest[i]);
    ADD_FAILURE() << "case " << k << ", made small:" << text << ": " << property(smallest);
    return;
  }
}

}  // namespace luxel

// Properties that hold for any input: many random cases, and for one that fails the smallest that still does.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace luxel {

/// A whole number that a case consists of, low..high; smaller is simpler.
struct Chosen {
  const char* name;
  int low, high;
};

/// Why a case does not have the property; empty: it has it.
using Property = std::function<std::string(const std::vector<int>&)>;

/// The smallest case that fails as `failing` does: no number of it can be `low`, halfway to it or one less.
std::vector<int> shrink(const std::vector<Chosen>& numbers, std::vector<int> failing, const Property& property);

/// Tries `count` cases of a fixed seed; fails the test at the first that has not the property, naming the smallest such case.
void for_all(const std::vector<Chosen>& numbers, int count, const Property& property);

}  // namespace luxel

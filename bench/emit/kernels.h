// Every kernel that `luxel emit` knows: its plan for parameters that are named as text.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <luxel/plan.h>

namespace luxel::emit {

using Settings = std::vector<std::pair<std::string, std::string>>;  // field, value

struct Kernel {
  std::string name;
  std::string folder;               // of kernels/, where its README is
  std::string variant;              // the field that --variant sets; empty: there is none
  std::string standard;             // what it is when not given; `default` where there is none
  std::vector<std::string> sizes;   // fields that --size sets, in order
  std::vector<int> size;            // what they are when not given
  std::function<Result<Plan>(const Settings&, const Profile&)> plan;
  std::vector<std::pair<std::string, std::string>> fields;  // name, and what it takes
};

const std::vector<Kernel>& kernels();

/// `size` as settings of the kernel's fields.
Settings sized(const Kernel& kernel, const std::vector<int>& size);

}  // namespace luxel::emit

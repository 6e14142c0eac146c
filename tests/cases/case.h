// A promise about a kernel in an extreme or stiff case: what is promised, the bound, and how it is measured on a
// device. The tests and `luxel report` run the same list.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <luxel/device.h>

namespace luxel::cases {

struct Case {
  std::string kernel;   // "gaussian_blur"
  std::string name;     // short, unique within the kernel
  std::string promise;  // a sentence
  double bound = 0;     // kept when the measured number is <= bound; NaN breaks it
  std::function<Result<double>(Context&)> measure = {};
  bool slow = false;                                    // more than about a second on a software driver
  std::function<bool(const DeviceInfo&)> applies = {};  // empty: on every device
};

inline bool kept(const Case& c, double measured) { return measured <= c.bound; }

inline bool applies(const Case& c, const DeviceInfo& device) { return !c.applies || c.applies(device); }

/// Where a promise is about bits or storage, which the execution in double has not.
inline bool not_double(const DeviceInfo& device) { return device.id != "cpu:double"; }

}  // namespace luxel::cases

// Plans on a device that share memory by name.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <luxel/device.h>

namespace luxel::report {

class SharedPlans {
 public:
  explicit SharedPlans(Context& context) : context_(context) {}

  /// Memory of that name holds these bytes.
  Status put(const std::string& name, const void* data, std::size_t bytes, Format format);
  template <class T>
  Status put(const std::string& name, const std::vector<T>& values, Format format) {
    return put(name, values.data(), values.size() * sizeof(T), format);
  }

  using Step = std::function<Result<double>()>;  // milliseconds of one run
  /// A plan whose resources are the memory of their names, or of the names that `names` gives them; made where there is none.
  Result<Step> step(const Result<Plan>& plan, const std::map<std::string, std::string>& names = {});
  /// Bytes of the memory of a name.
  Result<std::vector<std::uint8_t>> read(const std::string& name);

 private:
  struct Held {
    std::shared_ptr<Memory> memory;
    std::size_t bytes = 0;
  };
  Context& context_;
  std::map<std::string, Held> held_;
};

/// One after the other.
SharedPlans::Step in_turn(std::vector<SharedPlans::Step> steps);

}  // namespace luxel::report

// A plan on a device, with its memory: values in, run, values out.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <luxel/device.h>

namespace luxel::cases {

/// A compiled plan and memory for each of its resources. The context must outlive it.
class Run {
 public:
  static Result<Run> make(Context& context, const Result<Plan>& plan);

  /// Fills a resource from its start with channel values, stored in its format. Images take all their texels.
  Status write(std::string_view name, std::span<const double> values);
  /// Every channel value of a resource.
  Result<std::vector<double>> read(std::string_view name);
  /// Every byte of a resource, as the device stores it.
  Result<std::vector<std::byte>> bytes(std::string_view name);
  /// Binds `name` to the memory of `other`.
  void alias(std::string_view name, std::string_view other);

  /// Runs the plan `repeat` times and waits.
  Status go(int repeat = 1, Times* times = nullptr);

  const Plan& plan() const { return plan_; }
  double compile_ms() const { return compile_ms_; }
  /// Bytes of all resources and of scratch on a device.
  std::size_t memory_bytes() const;

 private:
  std::size_t index(std::string_view name) const;
  std::size_t size(std::size_t index) const;

  Context* context_ = nullptr;
  Plan plan_;
  std::shared_ptr<Program> program_;
  std::vector<std::shared_ptr<Memory>> memory_;  // in the order of plan_.resources
  double compile_ms_ = 0;
};

}  // namespace luxel::cases

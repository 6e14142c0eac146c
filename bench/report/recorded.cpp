#include "bench/report/recorded.h"

namespace luxel::report {
namespace {

class Recorded : public Context {
 public:
  Recorded(std::shared_ptr<Context> context, std::function<void(const Plan&)> compiled)
      : context_(std::move(context)), compiled_(std::move(compiled)) {}

  const DeviceInfo& info() const override { return context_->info(); }
  const Profile& profile() const override { return context_->profile(); }
  bool real64() const override { return context_->real64(); }
  Result<std::shared_ptr<Memory>> make(const Resource& resource, std::size_t bytes) override {
    return context_->make(resource, bytes);
  }
  Status upload(Memory& memory, const void* data, std::size_t bytes) override {
    return context_->upload(memory, data, bytes);
  }
  Status download(Memory& memory, void* data, std::size_t bytes) override {
    return context_->download(memory, data, bytes);
  }
  Result<std::shared_ptr<Program>> compile(const Plan& plan) override {
    compiled_(plan);
    return context_->compile(plan);
  }
  Status run(Program& program, const std::vector<Named>& resources, Times* times) override {
    return context_->run(program, resources, times);
  }
  Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) override {
    return context_->run_many(program, resources, repeat, times);
  }
  std::vector<std::string> validation_messages() override { return context_->validation_messages(); }

 private:
  std::shared_ptr<Context> context_;
  std::function<void(const Plan&)> compiled_;
};

}  // namespace

std::shared_ptr<Context> recorded(std::shared_ptr<Context> context, std::function<void(const Plan&)> compiled) {
  return std::make_shared<Recorded>(std::move(context), std::move(compiled));
}

}  // namespace luxel::report

// The small layer: devices by name, memory, programs and their refusals, alike on every execution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include <luxel/gaussian_blur.h>

#include "host/context.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

/// A variable of the environment, set as long as this lives.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

void expect_refusal(const Status& status, Code code, const std::string& part) {
  EXPECT_EQ(status.code(), code) << name(status.code()) << ": " << status.message();
  EXPECT_NE(status.message().find(part), std::string::npos) << status.message() << "\nexpected: " << part;
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
}

template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.status().message());
  return std::move(result).value();
}

TEST(Devices, AreCountedAndOpenByIndexIdAndPartOfAName) {
  std::vector<std::string> problems;
  const std::vector<DeviceInfo> found = devices(&problems);
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[found.size() - 2].id, "cpu:float");
  EXPECT_EQ(found.back().id, "cpu:double");
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].index, static_cast<int>(i));
    EXPECT_FALSE(found[i].name.empty());
    EXPECT_FALSE(found[i].driver.empty());
    for (const std::string& which : {std::to_string(i), found[i].id, found[i].name}) {
      const Result<std::shared_ptr<Context>> context = Context::open(which);
      ASSERT_TRUE(context.ok()) << which << ": " << context.status().message();
      EXPECT_EQ(context.value()->info().name, found[i].name) << which;
      EXPECT_EQ(context.value()->info().api, found[i].api) << which;
      EXPECT_EQ(context.value()->profile().name, found[i].profile) << which;
      EXPECT_EQ(context.value()->real64(), found[i].id == "cpu:double") << which;
    }
  }
  EXPECT_EQ(value_of(Context::open("C++ DOUBLE"))->info().id, "cpu:double");
  EXPECT_EQ(value_of(Context::open("cpu"))->info().id, "cpu:float");
}

TEST(Devices, AnUnknownNameListsThoseThatExist) {
  const std::vector<DeviceInfo> found = devices();
  for (const std::string& which : {std::string("riva tnt"), std::string(""), std::to_string(found.size())}) {
    const Status status = Context::open(which).status();
    expect_refusal(status, Code::missing_driver, "no device is called '" + which + "'");
    for (const DeviceInfo& info : found) expect_refusal(status, Code::missing_driver, info.id);
  }
}

#if LUXEL_VULKAN
TEST(Devices, AMissingVulkanDriverSaysWhatToInstall) {
  const Variable old_name("VK_ICD_FILENAMES", "/nonexistent.json"), new_name("VK_DRIVER_FILES", "/nonexistent.json");
  expect_refusal(Context::open("vulkan").status(), Code::missing_driver, "mesa-vulkan-drivers");
  std::vector<std::string> problems;
  for (const DeviceInfo& info : devices(&problems)) EXPECT_NE(info.api, Api::vulkan);
  ASSERT_EQ(problems.empty(), false);
  EXPECT_NE(problems.back().find("mesa-vulkan-drivers"), std::string::npos) << problems.back();
  expect_refusal(Context::open("riva tnt").status(), Code::missing_driver, "mesa-vulkan-drivers");
}

TEST(Devices, ValidationThatIsMisspeltIsNotSilence) {
  const Variable odd("LUXEL_VALIDATION", "best practices");
  expect_refusal(Context::open("vulkan").status(), Code::missing_driver, "LUXEL_VALIDATION is best practices; expected 0, 1 or best_practices");
}

TEST(Devices, AMissingValidationLayerSaysWhatToInstall) {
  const Variable on("LUXEL_VALIDATION", "1"), nowhere("VK_LAYER_PATH", "/nonexistent");
  expect_refusal(Context::open("vulkan").status(), Code::missing_driver, "vulkan-validationlayers");
}
#endif

/// Every device under test.
class Device : public testing::TestWithParam<std::string> {
 protected:
  Context& context() { return test_context(GetParam()); }

  Plan plan(Input input = Input::buffer, int width = 41) {
    GaussianBlurParams params;
    params.width = width;
    params.height = 23;
    params.sigma = 1.5;
    params.input = input;
    return value_of(luxel::plan(params, context().profile()));
  }

  /// Memory for every resource; the names are the plan's, which must live as long.
  std::vector<Named> make_all(const Plan& plan) {
    std::vector<Named> named;
    for (const Resource& resource : plan.resources) {
      named.push_back({resource.name, value_of(context().make(resource))});
      std::vector<float> values(named.back().memory->bytes / 4);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5f + 0.5f * std::sin(static_cast<float>(i));
      const Status status = context().upload(*named.back().memory, values.data(), named.back().memory->bytes);
      EXPECT_TRUE(status.ok()) << status.message();
    }
    return named;
  }

  std::vector<float> read(const std::shared_ptr<Memory>& memory) {
    std::vector<float> values(memory->bytes / 4);
    const Status status = context().download(*memory, values.data(), memory->bytes);
    EXPECT_TRUE(status.ok()) << status.message();
    return values;
  }

  void TearDown() override { EXPECT_EQ(context().validation_messages(), std::vector<std::string>{}); }
};

TEST_P(Device, MemoryReturnsWhatWasUploaded) {
  for (const Input input : {Input::buffer, Input::image}) {
    const Plan plan = this->plan(input);
    const std::shared_ptr<Memory> memory = value_of(context().make(plan.resources[0]));
    std::vector<std::uint8_t> data(memory->bytes), back(memory->bytes);
    for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::uint8_t>(i * 31 % 64);
    ASSERT_TRUE(context().upload(*memory, data.data(), data.size()).ok());
    ASSERT_TRUE(context().download(*memory, back.data(), back.size()).ok());
    EXPECT_EQ(data, back);
    data.resize(data.size() + 4);
    EXPECT_EQ(context().upload(*memory, data.data(), data.size()).code(), Code::invalid_argument);
    EXPECT_EQ(context().download(*memory, data.data(), data.size()).code(), Code::invalid_argument);
  }
}

TEST_P(Device, AProgramRunsAgainOnOtherMemory) {
  const Plan plan = this->plan();
  const std::shared_ptr<Program> program = value_of(context().compile(plan));
  const std::vector<Named> first = make_all(plan), second = make_all(plan);
  Status status = context().run(*program, first);
  ASSERT_TRUE(status.ok()) << status.message();
  const std::vector<float> expected = read(first[1].memory);
  EXPECT_NE(expected, read(second[1].memory));
  for (const std::vector<Named>* named : {&second, &first, &second}) {
    status = context().run(*program, *named);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(expected, read((*named)[1].memory));
  }
  status = context().run(*program, {{"dst", second[1].memory}, {"src", first[0].memory}});
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(expected, read(second[1].memory));
}

TEST_P(Device, ManyRunsAndTheirTimes) {
  const Plan plan = this->plan();
  const std::shared_ptr<Program> program = value_of(context().compile(plan));
  const std::vector<Named> once = make_all(plan), many = make_all(plan);
  Times times;
  Status status = context().run(*program, once, &times);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_GT(times.total, 0);
  status = context().run_many(*program, many, 5, &times);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(read(once[1].memory), read(many[1].memory));
  EXPECT_GT(times.total, 0);
  if (!times.passes.empty()) {
    ASSERT_EQ(times.passes.size(), plan.passes.size());
    double sum = 0;
    for (const double pass : times.passes) {
      EXPECT_GT(pass, 0);
      sum += pass;
    }
    EXPECT_LE(sum, times.total * 1.05);  // two clocks
  }
  EXPECT_EQ(context().run_many(*program, many, 0, &times).code(), Code::invalid_argument);
}

TEST_P(Device, RunRefusesWhatDoesNotFit) {
  const Plan plan = this->plan(), images = this->plan(Input::image);
  const std::shared_ptr<Program> program = value_of(context().compile(plan));
  const std::shared_ptr<Program> image_program = value_of(context().compile(images));
  const std::vector<Named> good = make_all(plan), good_images = make_all(images);
  const auto run = [&](std::vector<Named> named) { return context().run(*program, named); };
  expect_refusal(run({good[0]}), Code::invalid_argument, "gaussian_blur: binding dst is missing");
  expect_refusal(run({good[0], good[1], good[1]}), Code::invalid_argument, "gaussian_blur: binding dst is given twice");
  expect_refusal(run({good[0], good[1], {"mask", good[0].memory}}), Code::invalid_argument,
                 "gaussian_blur: binding mask is unknown");
  expect_refusal(run({good[0], {"dst", nullptr}}), Code::invalid_argument, "gaussian_blur: binding dst");
  expect_refusal(run({good_images[0], good[1]}), Code::invalid_argument, "gaussian_blur: binding src");
  const Plan small_plan = this->plan(Input::buffer, 40), narrow_plan = this->plan(Input::image, 40);
  const std::vector<Named> small = make_all(small_plan), narrow = make_all(narrow_plan);
  expect_refusal(run({good[0], small[1]}), Code::invalid_argument, "gaussian_blur: binding dst has ");
  expect_refusal(context().run(*image_program, {narrow[0], good_images[1]}), Code::invalid_argument,
                 "gaussian_blur: binding src");

  expect_refusal(run({{"src", good[0].memory, std::size_t{1} << 20}, good[1]}), Code::invalid_argument,
                 "gaussian_blur: binding src begins at pixel 1048576");
  expect_refusal(run({{"src", good[0].memory, 64}, good[1]}), Code::invalid_argument, "gaussian_blur: binding src has ");
  expect_refusal(context().run(*image_program, {{"src", good_images[0].memory, 1}, good_images[1]}),
                 Code::invalid_argument, "gaussian_blur: binding src is an image bound from texel 1");

  const std::shared_ptr<Context> other = value_of(Context::open("cpu"));
  const std::shared_ptr<Memory> foreign = value_of(other->make(plan.resources[1]));
  expect_refusal(run({good[0], {"dst", foreign}}), Code::invalid_argument, "another");
  EXPECT_EQ(context().upload(*foreign, "1234", 4).code(), Code::invalid_argument);
  char four[4];
  EXPECT_EQ(context().download(*foreign, four, 4).code(), Code::invalid_argument);
  EXPECT_EQ(other->run(*program, good).code(), Code::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Each, Device, testing::ValuesIn(test_devices()),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& letter : name) {
                             if (!std::isalnum(static_cast<unsigned char>(letter))) letter = '_';
                           }
                           return name;
                         });

}  // namespace
}  // namespace luxel

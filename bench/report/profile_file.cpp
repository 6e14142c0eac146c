#include "bench/report/profile_file.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

namespace luxel::report {
namespace {

class Tuned : public Context {
 public:
  Tuned(std::shared_ptr<Context> context, const Profile& profile) : context_(std::move(context)), profile_(profile) {}
  const DeviceInfo& info() const override { return context_->info(); }
  const Profile& profile() const override { return profile_; }
  bool real64() const override { return context_->real64(); }
  Result<std::shared_ptr<Memory>> make(const Resource& resource, std::size_t bytes) override { return context_->make(resource, bytes); }
  Status upload(Memory& memory, const void* data, std::size_t bytes) override { return context_->upload(memory, data, bytes); }
  Status download(Memory& memory, void* data, std::size_t bytes) override { return context_->download(memory, data, bytes); }
  Result<std::shared_ptr<Program>> compile(const Plan& plan) override { return context_->compile(plan); }
  Status run(Program& program, const std::vector<Named>& resources, Times* times) override { return context_->run(program, resources, times); }
  Status run_many(Program& program, const std::vector<Named>& resources, int repeat, Times* times) override {
    return context_->run_many(program, resources, repeat, times);
  }
  std::vector<std::string> validation_messages() override { return context_->validation_messages(); }

 private:
  std::shared_ptr<Context> context_;
  Profile profile_;
};

Json json_of(const Shape& s) {
  return {{"lanes", s.lanes}, {"block", s.block}, {"unroll", s.unroll}, {"split", s.split}, {"workgroup", s.workgroup}};
}

Status read(const Json& from, const char* name, int least, int most, int& to) {
  if (!from.contains(name) || !from[name].is_number_integer() || from[name] < least || from[name] > most)
    return {Code::invalid_argument, fmt::format("{} is {}; expected a whole number {}..{}", name, from.contains(name) ? from[name].dump() : "missing", least, most)};
  to = from[name];
  return {};
}

Status read(const Json& profile, const char* name, Shape& to) {
  if (!profile.contains(name) || !profile[name].is_object()) return {Code::invalid_argument, fmt::format("{} is missing; expected an object", name)};
  const Json& s = profile[name];
  Status status = read(s, "lanes", 0, 16, to.lanes);
  if (status) status = read(s, "block", 1, 64, to.block);
  if (status) status = read(s, "unroll", 0, 4095, to.unroll);
  if (status) status = read(s, "split", 0, 1, to.split);
  if (!status) return {Code::invalid_argument, fmt::format("{}.{}", name, status.message())};
  const Json w = s.value("workgroup", Json());
  if (!w.is_array() || w.size() != 3 || !std::all_of(w.begin(), w.end(), [](const Json& n) { return n.is_number_integer() && n >= 1 && n <= 1024; }))
    return {Code::invalid_argument, fmt::format("{}.workgroup is {}; expected three whole numbers 1..1024", name, w.dump())};
  for (std::size_t i = 0; i < 3; ++i) to.workgroup[i] = w[i];
  return {};
}

}  // namespace

std::string profile_folder() {
  if (const char* folder = std::getenv("LUXEL_PROFILES"); folder && *folder) return folder;
  if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) return std::string(config) + "/luxel/profiles";
  const char* home = std::getenv("HOME");
  return std::string(home && *home ? home : "/nonexistent") + "/.config/luxel/profiles";
}

std::string profile_path(const DeviceInfo& device) {
  std::string name = device.id;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
  return profile_folder() + "/" + name + ".json";
}

Json to_json(const DeviceInfo& device, const Profile& p) {
  return {{"device", device.id},
          {"driver", device.driver},
          {"profile",
           {{"name", p.name},
            {"rows", json_of(p.rows)},
            {"columns", json_of(p.columns)},
            {"pixels", json_of(p.pixels)},
            {"voxels", json_of(p.voxels)},
            {"workgroup_memory", p.workgroup_memory},
            {"texels", p.texels}}}};
}

Result<Profile> profile_from(const Json& json) {
  if (!json.is_object() || !json.contains("profile") || !json["profile"].is_object()) return Status(Code::invalid_argument, "profile is missing; expected an object");
  const Json& from = json["profile"];
  Profile p;
  if (!from.contains("name") || !from["name"].is_string()) return Status(Code::invalid_argument, "name is missing; expected a string");
  p.name = from["name"];
  for (auto [name, shape] : {std::pair{"rows", &p.rows}, {"columns", &p.columns}, {"pixels", &p.pixels}, {"voxels", &p.voxels}})
    if (Status s = read(from, name, *shape); !s) return s;
  for (auto [name, flag] : {std::pair{"workgroup_memory", &p.workgroup_memory}, {"texels", &p.texels}}) {
    if (!from.contains(name) || !from[name].is_boolean()) return Status(Code::invalid_argument, fmt::format("{} is missing; expected true or false", name));
    *flag = from[name];
  }
  return p;
}

std::shared_ptr<Context> with_profile(std::shared_ptr<Context> context, const Profile& profile) {
  return std::make_shared<Tuned>(std::move(context), profile);
}

std::shared_ptr<Context> tuned(std::shared_ptr<Context> context, std::string* problem) {
  if (context->info().api == Api::cpu) return context;  // fixed shapes
  const std::string path = profile_path(context->info());
  std::ifstream file(path);
  if (!file) return context;
  std::stringstream text;
  text << file.rdbuf();
  const Json json = Json::parse(text.str(), nullptr, false);
  const auto say = [&](const std::string& what) {
    if (problem) *problem = fmt::format("{} is left out of account: {}; `luxel tune --profile` makes it anew", path, what);
    return context;
  };
  const Result<Profile> p = profile_from(json);
  if (!p) return say(p.status().message());
  if (json.value("driver", "") != context->info().driver) return say("it was made with another driver, " + json.value("driver", "unknown"));
  return with_profile(std::move(context), p.value());
}

Result<std::shared_ptr<Context>> open_tuned(const std::string& device) {
  const auto opened = [&]() -> Result<std::shared_ptr<Context>> {
    if (!device.empty()) return Context::open(device);
    for (const char* api : {"opencl", "vulkan"})
      if (auto context = Context::open(api); context) return context;
    return Context::open("cpu");
  }();
  if (!opened) return opened;
  std::string problem;
  auto context = tuned(opened.value(), &problem);
  if (!problem.empty()) fmt::print(stderr, "luxel: {}\n", problem);
  return context;
}

std::string cpp_of(const Profile& p) {
  const auto shape = [](const char* name, const Shape& s) {
    return fmt::format("p.{} = {{{}, {}, {}, {}, {{{}, {}, {}}}}};\n", name, s.lanes, s.block, s.unroll, s.split, s.workgroup[0], s.workgroup[1], s.workgroup[2]);
  };
  return fmt::format("luxel::Profile p = luxel::profile(\"{}\");\n{}{}{}{}p.workgroup_memory = {};\np.texels = {};\n", p.name, shape("rows", p.rows),
                     shape("columns", p.columns), shape("pixels", p.pixels), shape("voxels", p.voxels), p.workgroup_memory, p.texels);
}

}  // namespace luxel::report

// `luxel emit`: one kernel as flat files. The plan is made here; the texts are made by python/emit, which the build put
// into the program, so that the source tree is not needed (python3 is, and glslangValidator for SPIR-V).
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/emit/embedded.h"
#include "bench/emit/kernels.h"
#include "bench/io/temporary_folder.h"
#include "bench/report/child.h"
#include "commands.h"
#include "common.h"
#include "host/module.h"

namespace luxel::program {
namespace {

using json = nlohmann::ordered_json;  // sizes keep their order

struct Arguments {
  std::string kernel, variant, size, options, constants, format = "all", profile = "gpu", out;
};

const char* spelled(ResourceKind kind) {
  switch (kind) {
    case ResourceKind::buffer: return "buffer";
    case ResourceKind::image: return "image";
    case ResourceKind::sampled_image: return "sampled_image";
    case ResourceKind::storage_image: return "storage_image";
  }
  return "";
}

json slot_json(const Slot& slot) {
  constexpr const char* sources[] = {"resource", "scratch", "table"};
  return {{"source", sources[static_cast<int>(slot.source)]}, {"index", slot.index}};
}

std::string module_name(const Module& module) { return std::string(module.part) + "." + std::string(module.name); }

json plan_json(const Plan& plan) {
  json resources = json::array(), scratch = json::array(), passes = json::array();
  for (const Resource& r : plan.resources)
    resources.push_back({{"name", r.name}, {"kind", spelled(r.kind)}, {"format", name(r.format)}, {"bytes", r.bytes},
                         {"extent", r.extent}, {"address", r.address == Address::clamp ? "clamp" : "wrap"},
                         {"written", r.written}, {"may_alias", r.may_alias}});
  for (const ScratchRegion& s : plan.scratch)
    scratch.push_back({{"format", name(s.format)}, {"bytes", s.count * bytes_per_pixel(s.format)}});
  for (const Pass& p : plan.passes) {
    json slots = json::array();
    for (const Slot& slot : p.slots) slots.push_back(slot_json(slot));
    json pass{{"module", module_name(*p.module)}, {"label", p.label}, {"slots", slots}, {"parameters", p.parameters},
              {"constants", p.constants}, {"workgroup", p.workgroup}, {"groups", p.groups}};
    if (p.counts) pass["counts"] = {{"slot", slot_json(p.counts->slot)}, {"first", p.counts->first}};
    passes.push_back(std::move(pass));
  }
  return {{"resources", resources}, {"scratch", scratch}, {"tables", plan.tables}, {"passes", passes}};
}

json module_json(const Module& module) {
  json bindings = json::array(), parameters = json::array(), constants = json::array(), shared = json::array();
  for (const BindingInfo& b : module.bindings) bindings.push_back({{"name", b.name}});
  for (const ParameterInfo& p : module.parameters) parameters.push_back({{"name", p.name}});
  for (const ConstantInfo& c : module.constants) constants.push_back({{"name", c.name}, {"shape", c.shape}});
  for (const SharedInfo& s : module.shared) shared.push_back({{"name", s.name}, {"bytes", s.bytes}});
  return {{"glsl", module.glsl}, {"bindings", bindings}, {"parameters", parameters}, {"constants", constants}, {"shared", shared}};
}

/// "A=1,B=0"; empty name: the text is not of that form.
std::vector<std::pair<std::string, std::string>> pairs(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> found;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    const std::size_t at = part.find('=');
    found.emplace_back(at == std::string::npos ? "" : part.substr(0, at), at == std::string::npos ? part : part.substr(at + 1));
  }
  return found;
}

std::string_view embedded(std::string_view name) {
  for (const emit::Embedded& file : emit::embedded())
    if (file.name == name) return file.text;
  return {};
}

/// Runs the emitter on a request. `output`: a line for each file that it wrote. `problem`: the last line that it said.
int run_script(const json& request, std::string& output, std::string& problem) {
  const io::TemporaryFolder scripts("luxel-emit");
  const std::string& at = scripts.path();
  if (at.empty()) return problem = "no folder can be made for temporary files; set TMPDIR to one that can be written", -1;
  for (const emit::Embedded& file : emit::embedded())
    if (file.name.ends_with(".py")) std::ofstream(at + "/" + std::string(file.name)) << file.text;
  std::ofstream(at + "/request.json") << request.dump();
  // No shell: a folder may have any name.
  const report::Ended ended = report::run_child({"/usr/bin/env", "python3", "-B", at + "/emit.py", at + "/request.json"}, {},
                                                at + "/said", 600, [](const std::string&) {});
  std::ifstream in(at + "/said");
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) output += line + "\n", problem = line;
  if (!ended.started) return 127;
  return ended.died() ? -1 : ended.status;
}

int run(const Arguments& a, const std::string& command) {
  std::vector<std::string> names;
  const emit::Kernel* kernel = nullptr;
  for (const emit::Kernel& k : emit::kernels()) {
    names.push_back(k.name);
    if (k.name == a.kernel) kernel = &k;
  }
  if (kernel == nullptr) {
    const std::string near = closest(a.kernel, names);
    return complain(fmt::format("emit: no kernel {}; {}expected {}", a.kernel,
                                near.empty() ? "" : fmt::format("did you mean {}? ", near), fmt::join(names, ", ")), misused);
  }
  std::vector<int> size = kernel->size;
  if (!a.size.empty()) {
    size.clear();
    std::istringstream in(a.size);
    for (std::string part; std::getline(in, part, 'x');) {
      int value = 0;
      if (std::sscanf(part.c_str(), "%d", &value) != 1 || value < 1 || std::to_string(value) != part)
        return complain(fmt::format("emit: --size is {}; expected whole numbers joined by x, as 1920x1080", a.size), misused);
      size.push_back(value);
    }
    if (size.size() > kernel->sizes.size())
      return complain(fmt::format("emit: --size is {}; expected {} of {}", a.size, fmt::join(kernel->sizes, " x "), kernel->name),
                      misused);
    while (size.size() < kernel->sizes.size()) size.push_back(1);
  }
  emit::Settings settings;
  json options = json::object(), constants = json::object();
  if (!a.variant.empty()) {
    if (kernel->variant.empty()) return complain(fmt::format("emit: {} has no variants", kernel->name), misused);
    settings.emplace_back(kernel->variant, a.variant);
  }
  for (const auto& [key, value] : pairs(a.options)) {
    if (key.empty()) return complain(fmt::format("emit: --options has {}; expected NAME=VALUE", value), misused);
    settings.emplace_back(key, value);
    options[key] = value;
  }
  std::string variant = kernel->standard;
  for (const auto& [key, value] : settings)
    if (key == kernel->variant) variant = value;
  for (const auto& [key, value] : pairs(a.constants)) {
    if (key.empty()) return complain(fmt::format("emit: --constants has {}; expected NAME=VALUE or NAME=open", value), misused);
    constants[key] = value;
  }
  const Profile profile = luxel::profile(a.profile);

  // The plan at the size asked for, and at others, from which it shows what follows from the size.
  json plans = json::array(), sizes = json::array(), modules = json::object();
  // Larger ones by less than two, by which pyramids keep their number of levels where the size is a power of two.
  constexpr double scales[][3] = {{1, 1, 1}, {1.13, 1.31, 1.57}, {1.83, 1.13, 1.31}, {1.31, 1.57, 1.13}, {1.57, 1.83, 1.83}};
  for (const auto& scale : scales) {
    std::vector<int> at = size;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = static_cast<int>(at[i] * scale[i % 3]);
    emit::Settings all = emit::sized(*kernel, at);
    all.insert(all.end(), settings.begin(), settings.end());
    const Result<Plan> plan = kernel->plan(all, profile);
    if (!plan) {
      if (!plans.empty()) continue;
      return complain("emit: " + plan.status().message(), plan.status().code() == Code::invalid_argument ? misused : failed);
    }
    json named = json::object();
    for (std::size_t i = 0; i < at.size(); ++i) named[kernel->sizes[i]] = at[i];
    sizes.push_back(named);
    plans.push_back(plan_json(plan.value()));
    for (const Pass& pass : plan.value().passes)
      if (const std::string key = module_name(*pass.module); !modules.contains(key)) modules[key] = module_json(*pass.module);
  }
  for (const auto& [key, value] : constants.items()) {
    bool known = false;
    std::string all;
    for (const auto& [part, module] : modules.items())
      for (const auto& c : module["constants"]) {
        known = known || c["name"] == key;
        if (all.find(c["name"]) == std::string::npos) all += (all.empty() ? "" : ", ") + c["name"].get<std::string>();
      }
    if (!known) return complain(fmt::format("emit: no constant {}; expected one of {}", key, all), misused);
    double number = 0;
    char rest = 0;
    if (value != "open" && std::sscanf(value.get<std::string>().c_str(), "%lf%c", &number, &rest) != 1)
      return complain(fmt::format("emit: constant {} is {}; expected a number or open", key, value.get<std::string>()), misused);
  }

  const json errors = json::parse(embedded("errors.json"));
  json stated{{"summary", errors["summary"].value(kernel->folder, "")},
              {"stated", errors["stated"].value(kernel->folder, json::array())},
              {"source", "kernels/" + kernel->folder + "/README.md"}};
  const json request{{"version", LUXEL_VERSION}, {"command", command}, {"license", embedded("LICENSE")},
                     {"kernel", kernel->name}, {"variant", variant}, {"options", options}, {"constants", constants},
                     {"profile", a.profile}, {"format", a.format}, {"out", a.out}, {"plans", plans}, {"sizes", sizes},
                     {"modules", modules}, {"errors", stated}, {"glslang", "glslangValidator"}};
  std::string output, problem;
  const int status = run_script(request, output, problem);
  if (status != 0)
    return complain(problem.starts_with("emit: ") ? problem
                    : status == 127               ? "emit: python3 is not there; install python3"
                                                  : fmt::format("emit: {}", problem.empty() ? "the emitter failed" : problem),
                    status == misused ? misused : failed);
  std::size_t files = 0;
  for (const char c : output) files += c == '\n';
  fmt::print("emit: {} files of {} in {}; what to bind and dispatch: {}.json\n", files, kernel->name, a.out, kernel->name);
  return done;
}

}  // namespace

void add_emit(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("emit", "write a kernel as flat files for an engine of your own, without luxel");
  auto a = std::make_shared<Arguments>();
  command->add_option("kernel", a->kernel, "which kernel, as `gaussian_blur`")->type_name("NAME")->required();
  command->add_option("--variant", a->variant, "its variant; default: the first that `luxel list` names");
  command->add_option("--size", a->size, "size the plan is made for, as 1920x1080 or 128x128x128");
  command->add_option("--options", a->options, "fields of the kernel's parameters, as sigma=8,border=mirror,format=f16x4");
  command->add_option("--constants", a->constants,
                      "constants of the modules, as RADIUS=4; NAME=open: left to the one who builds the pipeline");
  command->add_option("--profile", a->profile, "for which kind of device")
      ->check(CLI::IsMember({"gpu", "opencl_gpu", "lavapipe"}))
      ->capture_default_str();
  command->add_option("--format", a->format, "which files")
      ->check(CLI::IsMember({"spirv", "glsl", "opencl", "cpp", "all"}))
      ->capture_default_str();
  command->add_option("-o,--out", a->out, "folder for the files")->required();
  command->footer("Needs python3, and glslangValidator for SPIR-V; no device and no source tree.");
  command->callback([a, &exit_status] {
    std::string text = "luxel emit " + a->kernel;
    for (const auto& [name, value] : {std::pair{" --variant ", a->variant}, {" --size ", a->size}, {" --options ", a->options},
                                      {" --constants ", a->constants}})
      if (!value.empty()) text += name + value;
    if (a->profile != "gpu") text += " --profile " + a->profile;
    exit_status = run(*a, text);
  });
}

}  // namespace luxel::program

#include <luxel/device.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "host/reference/context.h"
#if LUXEL_OPENCL
#include "host/opencl/context.h"
#endif
#if LUXEL_VULKAN
#include "host/vulkan/context.h"
#endif

namespace luxel {
namespace {

/// One execution: what it lists and how it opens one of these.
struct Backend {
  Api api;
  std::vector<DeviceInfo> (*list)(std::string* problem);
  Result<std::shared_ptr<Context>> (*open)(int index);
};

[[maybe_unused]] std::vector<DeviceInfo> list_none(std::string* problem, const char* name, const char* option) {
  if (problem) *problem = std::string(name) + ": not in this build; configure with -D" + option + "=ON";
  return {};
}

[[maybe_unused]] Result<std::shared_ptr<Context>> open_none(int) {
  return Status(Code::missing_driver, "this build has no such devices");
}

const Backend backends[] = {
#if LUXEL_OPENCL
    {Api::opencl, opencl::list, opencl::open},
#else
    {Api::opencl, [](std::string* problem) { return list_none(problem, "OpenCL", "LUXEL_OPENCL"); }, open_none},
#endif
#if LUXEL_VULKAN
    {Api::vulkan, vulkan::list, vulkan::open},
#else
    {Api::vulkan, [](std::string* problem) { return list_none(problem, "Vulkan", "LUXEL_VULKAN"); }, open_none},
#endif
    {Api::cpu, reference::list, reference::open},
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

/// A device, and what opens it.
struct Candidate {
  const Backend* backend;
  DeviceInfo info;  // index within the backend
};

std::vector<Candidate> candidates(std::vector<std::string>* problems) {
  std::vector<Candidate> found;
  for (const Backend& backend : backends) {
    std::string problem;
    const std::vector<DeviceInfo> infos = backend.list(&problem);
    if (infos.empty() && problems) problems->push_back(problem);
    for (const DeviceInfo& info : infos) found.push_back({&backend, info});
  }
  return found;
}

/// The first device of an API, without a look at the others' drivers.
Result<std::shared_ptr<Context>> open_first(Api api) {
  const Backend& backend = *std::find_if(std::begin(backends), std::end(backends),
                                         [&](const Backend& candidate) { return candidate.api == api; });
  std::string problem;
  const std::vector<DeviceInfo> infos = backend.list(&problem);
  if (infos.empty()) return Status(Code::missing_driver, problem);
  return backend.open(infos.front().index);
}

}  // namespace

std::vector<DeviceInfo> devices(std::vector<std::string>* problems) {
  std::vector<DeviceInfo> infos;
  for (const Candidate& candidate : candidates(problems)) {
    infos.push_back(candidate.info);
    infos.back().index = static_cast<int>(infos.size()) - 1;
  }
  return infos;
}

Result<std::shared_ptr<Context>> Context::open(std::string_view which) {
  const std::string wanted = lower(which);
  if (wanted == "opencl") return open_first(Api::opencl);
  if (wanted == "vulkan") return open_first(Api::vulkan);
  if (wanted == "cpu" || wanted == "cpu:float") return reference::open(0);
  if (wanted == "cpu:double") return reference::open(1);

  std::vector<std::string> problems;
  const std::vector<Candidate> found = candidates(&problems);
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (error == std::errc() && end == wanted.data() + wanted.size() && index < found.size()) {
    return found[index].backend->open(found[index].info.index);
  }
  const auto matches = [&](auto&& test) { return std::find_if(found.begin(), found.end(), test); };
  auto chosen = matches([&](const Candidate& candidate) {
    return lower(candidate.info.id) == wanted || candidate.info.profile == wanted;
  });
  if (chosen == found.end() && !wanted.empty()) {
    chosen = matches([&](const Candidate& candidate) {
      return lower(candidate.info.name).find(wanted) != std::string::npos;
    });
  }
  if (chosen != found.end()) return chosen->backend->open(chosen->info.index);

  std::string message = "no device is called '" + std::string(which) + "'; expected opencl, vulkan, cpu, cpu:double, ";
  message += "or an index or part of a name of:";
  for (std::size_t i = 0; i < found.size(); ++i) {
    message += (i ? ", " : " ") + std::to_string(i) + " " + found[i].info.id;
  }
  for (const std::string& problem : problems) message += "; " + problem;
  return Status(Code::missing_driver, message);
}

}  // namespace luxel

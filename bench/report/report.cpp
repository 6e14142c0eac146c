#include "bench/report/report.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "bench/report/child.h"
#include "bench/report/limits.h"
#include "bench/report/listing.h"
#include "bench/report/machine.h"
#include "bench/report/progress.h"
#include "bench/report/schema.h"
#include "bench/report/table.h"

namespace luxel::report {
namespace {

namespace fs = std::filesystem;

// A device that says nothing for so long hangs; compiling and the slowest single row take less.
constexpr int silence_s = 300;

int misuse(const std::string& message) {
  fmt::print(stderr, "luxel: {}\n", message);
  return 2;
}

std::string this_program() { return fs::read_symlink("/proc/self/exe").string(); }

std::vector<std::string> child_arguments(const Settings& s, const std::string& device, double best, bool first) {
  std::vector<std::string> argv{this_program(),          "report", "--measure", device, "--guard-best",
                                fmt::format("{}", best), "-o",     s.out};
  if (s.quick) argv.push_back("--quick");
  if (first) argv.push_back("--first");
  for (const std::string& kernel : s.kernels) argv.insert(argv.end(), {"--kernel", kernel});
  for (const std::string& image : s.images) argv.insert(argv.end(), {"--image", image});
  for (const std::string& text : s.only) argv.insert(argv.end(), {"--only", text});
  return argv;
}

// Drivers and luxel compile into folders of the report's own, so that every first use is one.
std::vector<std::string> child_environment(const Settings& s) {
  const std::string cache = fs::absolute(s.out).string() + "/cache";
  return {"LUXEL_CACHE=" + cache + "/luxel", "POCL_CACHE_DIR=" + cache + "/pocl",
          "MESA_SHADER_CACHE_DIR=" + cache + "/mesa", "OPENCV_OPENCL_CACHE_ENABLE=0"};
}

// OpenCV's OpenCL path is for comparison on the same device, which it is told by type.
std::string opencv_device(const DeviceInfo& device) {
  return std::string("OPENCV_OPENCL_DEVICE=:") + (device.profile == "pocl" ? "CPU" : "GPU") + ":";
}

Json device_row(const DeviceInfo& d) {
  return {{"id", d.id},
          {"name", d.name},
          {"driver", d.driver},
          {"profile", d.profile},
          {"died", false},
          {"problems", Json::array()},
          {"limits", Json::array()},
          {"first_use", Json::array()}};
}

void has_died(Gathered& gathered, Progress& progress, const std::string& what) {
  gathered.devices.back()["died"] = true;
  gathered.devices.back()["problems"].push_back(what);
  progress.line(what);
}

// Where the time of a device went.
std::string longest_jobs(const Gathered& gathered, const std::string& device) {
  std::vector<std::pair<double, std::string>> jobs;
  double seconds = 0;
  for (const Json& job : gathered.spent) {
    if (job.at("device") != device) continue;
    jobs.emplace_back(-job.at("seconds").get<double>(), job.at("label").get<std::string>());
    seconds -= jobs.back().first;
  }
  std::sort(jobs.begin(), jobs.end());
  std::string text = fmt::format("{}: {} jobs in {:.0f} s", device, jobs.size(), seconds);
  for (std::size_t i = 0; i < std::min<std::size_t>(jobs.size(), 3); ++i)
    text += fmt::format("{} {} ({:.1f} s)", i == 0 ? "; longest:" : ",", jobs[i].second, -jobs[i].first);
  return text;
}

void measure(const Settings& s, const DeviceInfo& device, const std::string& name, bool first, Gathered& gathered,
             Progress& progress, std::ofstream& rows) {
  gathered.devices.push_back(device_row(device));
  progress.begin(device.id);
  std::vector<std::string> environment = child_environment(s);
  environment.push_back(opencv_device(device));
  const std::string log = fmt::format("{}/device_{}.log", s.out, gathered.devices.size() - 1);
  const Ended ended = run_child(child_arguments(s, name, gathered.best_guard, first), environment, log, silence_s,
                                [&](const std::string& line) {
                                  if (const std::string row = take_line(gathered, line); !row.empty())
                                    rows << row << std::endl;
                                  progress.update(gathered.last_done, gathered.last_of, gathered.last_label);
                                });
  if (ended.died() || ended.status != 0)
    has_died(gathered, progress,
             fmt::format("{} died: {} while at: {}; see {}", device.id, ended.reason(silence_s),
                         gathered.last_label.empty() ? "its start" : gathered.last_label, log));
  gathered.last_label.clear();
  progress.line(longest_jobs(gathered, device.id));
}

Status write_file(const std::string& path, const std::string& text) {
  const std::string part = path + ".part";
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  std::error_code error;
  if (file) fs::rename(part, path, error);
  if (!file || error) return {Code::io, path + " could not be written; check the folder and the space on its disk"};
  return {};
}

// The page and the plots are made by Python; without it the numbers stand all the same.
void render(const std::string& out) {
  const std::string script = LUXEL_SOURCE_DIR "/python/report/render.py", log = out + "/render.log";
  std::string why = "python3 is missing (Debian: apt-get install python3-matplotlib)";
  // Debian's own first: its packages are what is installed for this.
  for (std::vector<std::string> argv : {std::vector<std::string>{"/usr/bin/python3"}, {"/usr/bin/env", "python3"}}) {
    argv.insert(argv.end(), {script, out});
    const Ended ended = run_child(argv, {}, log, 600, [](const std::string&) {});
    if (!ended.died() && ended.status == 0) return;
    std::string last, line;
    for (std::ifstream file(log); std::getline(file, line);)
      if (!line.empty()) last = line;
    if (ended.started && !last.empty()) why = last;
  }
  fmt::print(stderr, "luxel: no page was made: {}\n", why);
}

}  // namespace

int run_report(const Settings& settings) {
  for (const std::string& kernel : settings.kernels)
    if (std::find(measured_kernels().begin(), measured_kernels().end(), kernel) == measured_kernels().end())
      return misuse(fmt::format("--kernel is {}; expected one of: {}", kernel, fmt::join(measured_kernels(), ", ")));
  for (const std::string& image : settings.images)
    if (const auto read = io::read_image(image); !read)
      return misuse(fmt::format("--image: {}", read.status().message()));
  std::error_code error;
  fs::create_directories(settings.out + "/pictures", error);
  const std::string listing_log = settings.out + "/devices.log";
  const Listing listing = list_devices(
      [](const std::string& what) {
        return std::vector<std::string>{this_program(), "report", "--list", what};
      },
      listing_log);
  const auto chosen = choose_devices(listing.devices, settings.devices, listing.died);
  if (!chosen) return misuse(chosen.status().message());
  if (!error) fs::remove_all(settings.out + "/cache", error);
  if (!error) fs::remove(settings.out + "/oracles.jsonl", error);
  std::ofstream rows(settings.out + "/rows.jsonl", std::ios::trunc);
  if (error || !rows)
    return misuse(fmt::format("-o {}: cannot write there; give a folder that can be made or written", settings.out));

  Progress progress;
  if (settings.devices.empty())
    for (const std::string& problem : listing.problems) progress.line(problem);
  Json about = machine();
  about["quick"] = settings.quick;
  about["limits"] = machine_limits(settings.quick);
  Gathered gathered;
  gathered.best_guard = about["limits"].back()["rate"].get<double>();
  bool first = true;
  for (const DeviceInfo& device : chosen.value()) {
    measure(settings, device, name_to_open(device, listing.devices), first, gathered, progress, rows);
    first = false;
  }
  for (const std::string& api : listing.died) {
    const auto named = std::find(settings.devices.begin(), settings.devices.end(), api);
    if (!settings.devices.empty() && named == settings.devices.end()) continue;
    gathered.devices.push_back(device_row({-1, Api::cpu, api, "", "", api}));
    has_died(gathered, progress, fmt::format("{} died while its driver was loaded; see {}", api, listing_log));
  }
  progress.end();
  fs::remove_all(settings.out + "/cache", error);
  fs::remove(settings.out + "/oracles.jsonl", error);
  for (const std::string& line : gathered.skipped) progress.line("skipped: " + line);

  const Json pictures = gathered.pictures;
  const Json report = assemble(std::move(gathered), std::move(about));
  int status = exit_status_of(report);
  for (const std::string& defect : check_schema(report)) {
    fmt::print(stderr, "luxel: the report does not have its shape: {}; this is a defect of luxel: please report it\n",
               defect);
    status = 1;
  }
  for (const auto& [file, json] : {std::pair{"report.json", &report}, {"pictures.json", &pictures}})
    if (Status written = write_file(settings.out + "/" + file, json->dump(1) + "\n"); !written)
      return misuse(written.message());
  render(settings.out);
  print_tables(report, settings.out);
  return status;
}

}  // namespace luxel::report

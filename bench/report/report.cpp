#include "bench/report/report.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "bench/report/certificate.h"
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

int misuse(const std::string& message) { return complain(message, 2); }

std::string this_program() { return fs::read_symlink("/proc/self/exe").string(); }

// What measure_device is told of a device's part in the report.
struct Role {
  bool oracle, first;
};

std::vector<std::string> child_arguments(const Settings& s, const std::string& name, const Role& role, double best) {
  std::vector<std::string> argv{this_program(),          "report", "--measure", name, "--guard-best",
                                fmt::format("{}", best), "-o",     s.out};
  if (role.oracle) argv.push_back("--oracle");
  if (role.first) argv.push_back("--first");
  if (s.quick) argv.push_back("--quick");
  if (s.stability) argv.push_back("--stability");
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

void measure(const Settings& s, const DeviceInfo& device, const std::string& name, const Role& role, Gathered& gathered,
             Progress& progress, std::ofstream& rows) {
  const int kept = gathered.from_before, of = gathered.of;
  gathered.devices.push_back(device_row(device));
  progress.begin(device.id);
  std::vector<std::string> environment = child_environment(s);
  environment.push_back(opencv_device(device));
  const std::string log = fmt::format("{}/device_{}.log", s.out, gathered.devices.size() - 1);
  const Ended ended = run_child(child_arguments(s, name, role, gathered.best_guard), environment, log, silence_s,
                                [&](const std::string& line) {
                                  if (const std::string row = take_line(gathered, line); !row.empty())
                                    rows << row << std::endl;
                                  gathered.of = of + gathered.last_of;
                                  progress.update(gathered.last_done, gathered.last_of, gathered.last_label);
                                });
  gathered.last_of = 0;
  if (ended.interrupted) return;
  if (ended.died() || ended.status != 0)
    has_died(gathered, progress,
             fmt::format("{} died: {} while at: {}; see {}", device.id, ended.reason(silence_s),
                         gathered.last_label.empty() ? "its start" : gathered.last_label, log));
  gathered.last_label.clear();
  if (gathered.from_before > kept)
    progress.line(fmt::format("{}: {} of {} jobs are those of an earlier run; --fresh measures them again", device.id,
                              gathered.from_before - kept, gathered.of - of));
  progress.line(longest_jobs(gathered, device.id));
}

// Where the scripts lie: beside the program as it was installed (PREFIX/bin and PREFIX/share/luxel/report), so that a prefix
// may be moved; else in the source tree that it was built from.
std::string script_folder() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed = program.parent_path() / LUXEL_SCRIPTS_FROM_BIN;
  if (!error && std::filesystem::exists(installed / "render.py", error)) return installed.lexically_normal().string();
  return LUXEL_SOURCE_DIR "/python/report";
}

// The page and the plots are made by Python; without it the numbers stand all the same.
void render(const std::string& out) {
  const std::string script = script_folder() + "/render.py", log = out + "/render.log";
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

// One report at a time writes to a folder.
class Alone {
 public:
  explicit Alone(const std::string& folder) : fd_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    held_ = fd_ >= 0 && ::flock(fd_, LOCK_EX | LOCK_NB) == 0;
  }
  ~Alone() {
    if (fd_ >= 0) ::close(fd_);
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;
  explicit operator bool() const { return held_; }

 private:
  int fd_;
  bool held_ = false;
};

// The exit status of a shell's Ctrl-C, and a line that says what is lost (nothing that was finished).
int say_interrupted(const Settings& settings, const Gathered& gathered, const std::vector<DeviceInfo>& chosen) {
  std::error_code ignored;
  fs::remove_all(settings.out + "/cache", ignored);
  std::string left;
  for (std::size_t i = gathered.devices.size(); i < chosen.size(); ++i) left += (left.empty() ? "" : ", ") + chosen[i].id;
  const std::string kept =
      gathered.of > 0 ? fmt::format("{} of {} jobs are kept", gathered.finished, gathered.of) : "nothing was lost";
  fmt::print(stderr, "luxel: interrupted; run the same command to go on; {}{}\n", kept,
             left.empty() ? "" : fmt::format(" (not begun: {})", left));
  return 130;
}

}  // namespace

int complain(const std::string& message, int status) {
  fmt::print(stderr, "luxel: {}\n", message);
  return status;
}

int run_report(const Settings& settings) {
  for (const std::string& kernel : settings.kernels)
    if (std::find(measured_kernels().begin(), measured_kernels().end(), kernel) == measured_kernels().end())
      return misuse(fmt::format("{} is {}; expected one of: {}", settings.stability ? "KERNEL" : "--kernel", kernel, fmt::join(measured_kernels(), ", ")));
  for (const std::string& image : settings.images)
    if (const auto read = io::read_image(image); !read)
      return misuse(fmt::format("--image: {}", read.status().message()));
  std::error_code error;
  fs::create_directories(settings.out + (settings.stability ? "" : "/pictures"), error);
  const Alone alone(settings.out);
  if (!error && !alone)
    return misuse(fmt::format("-o {}: another report is being written there; wait for it or give another folder", settings.out));
  const Interruptible interruptible;
  const std::string rows_file = settings.out + "/rows.jsonl";
  Gathered gathered;
  if (!settings.fresh) gathered.kept = read_kept(rows_file);
  const std::string listing_log = settings.out + "/devices.log";
  const Listing listing = list_devices(
      [](const std::string& what) {
        return std::vector<std::string>{this_program(), "report", "--list", what};
      },
      listing_log);
  if (interrupted()) return say_interrupted(settings, gathered, {});
  const auto chosen = choose_devices(listing.devices, settings.devices, listing.died);
  if (!chosen) return misuse(chosen.status().message());
  if (!error) fs::remove_all(settings.out + "/cache", error);
  if (!error && settings.fresh) fs::remove(settings.out + "/oracles.jsonl", error);
  if (interrupted()) return say_interrupted(settings, gathered, chosen.value());
  const Status kept = write_kept(rows_file, gathered.kept);
  std::ofstream rows(rows_file, std::ios::app);
  if (error || !kept || !rows)
    return misuse(fmt::format("-o {}: cannot write there; give a folder that can be made or written", settings.out));

  Progress progress;
  if (settings.devices.empty())
    for (const std::string& problem : listing.problems) progress.line(problem);
  Json about = machine();
  about["quick"] = settings.quick;
  about["limits"] = Json::array();
  if (!settings.stability) {
    for (const Cell& limit : machine_limits(settings.quick)) about["limits"].push_back(limit.json());
    gathered.best_guard = about["limits"].back()["rate"].get<double>();
  }
  bool first = true;
  for (const DeviceInfo& device : chosen.value()) {
    const bool oracle = settings.devices.empty() && device.api == Api::cpu && chosen.value().size() > 1;
    measure(settings, device, name_to_open(device, listing.devices), {oracle, first && !oracle}, gathered, progress, rows);
    first = first && oracle;
    if (interrupted()) {
      progress.end();
      return say_interrupted(settings, gathered, chosen.value());
    }
  }
  for (const std::string& api : listing.died) {
    const auto named = std::find(settings.devices.begin(), settings.devices.end(), api);
    if (!settings.devices.empty() && named == settings.devices.end()) continue;
    gathered.devices.push_back(device_row({-1, Api::cpu, api, "", "", api}));
    has_died(gathered, progress, fmt::format("{} died while its driver was loaded; see {}", api, listing_log));
  }
  progress.end();
  fs::remove_all(settings.out + "/cache", error);
  for (const std::string& line : gathered.skipped) progress.line("skipped: " + line);

  const Json pictures = gathered.pictures;
  const Json report = assemble(gathered, std::move(about));
  int status = exit_status_of(report);
  for (const std::string& defect : check_schema(report)) {
    fmt::print(stderr, "luxel: the report does not have its shape: {}; this is a defect of luxel: please report it\n",
               defect);
    status = 1;
  }
  if (Status written = write_file(settings.out + "/report.json", report.dump(1) + "\n"); !written) return misuse(written.message());
  if (settings.stability) {
    for (const auto& [kernel, text] : certificate_pages(report))
      if (Status written = write_file(settings.out + "/" + kernel + ".md", text); !written) return misuse(written.message());
    print_certificate(report);
    return status;
  }
  if (Status written = write_file(settings.out + "/pictures.json", pictures.dump(1) + "\n"); !written) return misuse(written.message());
  if (settings.page) render(settings.out);
  if (interrupted()) return say_interrupted(settings, gathered, chosen.value());
  print_tables(report, settings.out);
  return status;
}

}  // namespace luxel::report

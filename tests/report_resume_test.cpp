// A report that was interrupted, or whose child died, goes on where it ended.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "bench/io/temporary_folder.h"
#include "bench/report/kept.h"
#include "bench/report/report.h"
#include "bench/report/schema.h"
#include "host/module.h"
#include "tests/report/errors_of.h"
#include "tests/support/run.h"

namespace luxel::report {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

std::string slurp(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string line_of(const Json& j) { return j.dump(); }

std::string finished(const std::string& key, const Json& modules = Json::object()) {
  return line_of({{"finished", {{"label", "a"}, {"modules", modules}, {"guard", 1}}}, {"job", key}});
}

TEST(ReportKept, OnlyJobsWhoseEveryLineIsThere) {
  const fs::path path = fs::path(testing::TempDir()) / ("luxel_kept_" + std::to_string(::getpid()) + ".jsonl");
  const auto begin = [](const char* key) { return line_of({{"begin", "a"}, {"job", key}}); };
  const auto note = [](const char* key, int v) { return line_of({{"note", "limits"}, {"entry", v}, {"job", key}}); };
  std::ofstream(path) << begin("whole") << "\n" << note("whole", 1) << "\n" << finished("whole") << "\n"
                      << begin("ended early") << "\n" << note("ended early", 2) << "\n"
                      << begin("twice") << "\n" << note("twice", 3) << "\n" << finished("twice") << "\n"
                      << begin("again") << "\n" << note("again", 4) << "\n" << finished("again") << "\n"
                      << begin("again") << "\n" << note("again", 5) << "\n"
                      << begin("twice") << "\n" << note("twice", 6) << "\n" << finished("twice") << "\n"
                      << note("no begin", 7) << "\n" << finished("no begin") << "\n"
                      << line_of({{"section", "stability"}, {"row", Json::object()}}) << "\n"
                      << begin("torn") << "\n" << finished("torn").substr(0, 20);
  KeptJobs jobs = read_kept(path.string());
  ASSERT_EQ(jobs.size(), 2u);
  EXPECT_EQ(jobs.at("whole").lines, (std::vector<std::string>{begin("whole"), note("whole", 1), finished("whole")}));
  EXPECT_EQ(jobs.at("twice").lines, (std::vector<std::string>{begin("twice"), note("twice", 6), finished("twice")}));
  ASSERT_TRUE(write_kept(path.string(), jobs));
  const KeptJobs again = read_kept(path.string());
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again.at("twice").lines, jobs.at("twice").lines);
  EXPECT_FALSE(fs::exists(path.string() + ".part"));
}

TEST(ReportKept, KernelsDriversAndRequestsAreTold) {
  const Module& m = *modules().front();
  const std::string name = std::string(m.part) + "." + std::string(m.name);
  EXPECT_TRUE(unchanged({{name, module_hash(name)}}));
  EXPECT_FALSE(unchanged({{name, "0123456789abcdef"}}));
  EXPECT_FALSE(unchanged({{name, module_hash(name)}, {"gone.f32x4", "0123456789abcdef"}}));
  EXPECT_FALSE(unchanged(nullptr));

  const DeviceInfo device{0, Api::vulkan, "n", "driver 1", "lavapipe", "vulkan:n"};
  const Profile p = profile("lavapipe");
  Settings settings;
  const std::string key = job_key(device, p, settings, "blur sigma 4");
  EXPECT_EQ(key, job_key(device, p, settings, "blur sigma 4"));
  EXPECT_NE(key, job_key(device, p, settings, "blur sigma 5"));
  DeviceInfo other = device;
  other.driver = "driver 2";
  EXPECT_NE(key, job_key(other, p, settings, "blur sigma 4"));
  Profile tuned = p;
  tuned.rows.block = 3;
  EXPECT_NE(key, job_key(device, tuned, settings, "blur sigma 4"));
  settings.quick = true;
  EXPECT_NE(key, job_key(device, p, settings, "blur sigma 4"));
}

// --- The program itself

const fs::path& folder() {
  static const io::TemporaryFolder around("luxel-report-resume");  // what the program prints stands beside the report
  static const fs::path path = fs::path(around.path()) / "report";
  return path;
}

// The program in the background; stderr in a file.
class Running {
 public:
  explicit Running(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {LUXEL_PROGRAM, "report", "--no-page", "-o", folder().string()});
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(::open((folder().string() + ".err").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 2);
      ::dup2(::open((folder().string() + ".out").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), 1);
      ::execv(argv[0], argv.data());
      ::_exit(127);
    }
  }
  ~Running() { wait(); }
  // Until the file has that many finished jobs more than `before`, or the program ended.
  void until_finished(std::size_t jobs) {
    for (int i = 0; i < 12000 && !ended() && count("\"finished\"") < jobs; ++i) std::this_thread::sleep_for(5ms);
  }
  static std::size_t count(const std::string& text) {
    const std::string all = slurp(folder() / "rows.jsonl");
    std::size_t n = 0;
    for (std::size_t at = 0; (at = all.find(text, at)) != std::string::npos; ++at) ++n;
    return n;
  }
  std::vector<pid_t> children() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children");
    std::vector<pid_t> all;
    for (pid_t p; file >> p;) all.push_back(p);
    return all;
  }
  void signal(int s) const { ::kill(pid_, s); }
  int wait() {
    while (!ended()) std::this_thread::sleep_for(2ms);
    return WIFEXITED(state_) ? WEXITSTATUS(state_) : -1;
  }
  std::string errors() const { return slurp(folder().string() + ".err"); }

 private:
  bool ended() {
    if (!ended_) ended_ = ::waitpid(pid_, &state_, WNOHANG) == pid_;
    return ended_;
  }
  pid_t pid_ = 0;
  int state_ = 0;
  bool ended_ = false;
};

bool alive(pid_t pid) { return ::kill(pid, 0) == 0; }

Json report() { return Json::parse(slurp(folder() / "report.json"), nullptr, false); }

std::vector<std::string> devices_here() {
  std::vector<std::string> devices{"cpu"};
  for (const std::string& d : test_devices())
    if (d != "cpu" && devices.size() < 2) devices.push_back(d);
  return devices;
}

// A few jobs with rows of all that must be kept: frontier and stability rows, shares, bits, limits; on C++ and one driver.
std::vector<std::string> few_jobs() {
  std::vector<std::string> words{"--quick", "--kernel", "gaussian_blur", "--only", "on step", "--only", "case sigma 0", "--only", "limit "};
  for (const std::string& d : devices_here()) words.insert(words.end(), {"--device", d});
  return words;
}

std::vector<std::string> with(std::vector<std::string> words, const std::string& more) {
  words.push_back(more);
  return words;
}

TEST(ReportResumeFull, GoesOnAfterInterruptionsAndAChildThatDies) {
  fs::remove_all(folder());
  {
    Running first(few_jobs());
    first.until_finished(2);
    const std::vector<pid_t> children = first.children();
    ASSERT_FALSE(children.empty()) << first.errors();
    first.signal(SIGINT);
    EXPECT_EQ(first.wait(), 130) << first.errors();
    for (const pid_t child : children) EXPECT_FALSE(alive(child));
    const std::string text = first.errors();
    EXPECT_NE(text.find("luxel: interrupted; run the same command to go on; "), std::string::npos) << text;
    EXPECT_NE(text.find(std::to_string(Running::count("\"finished\"")) + " of "), std::string::npos) << text;
    EXPECT_FALSE(fs::exists(folder() / "report.json"));
    EXPECT_FALSE(fs::exists(folder() / "cache"));
  }
  const std::size_t kept = Running::count("\"finished\"");
  EXPECT_GE(kept, 2u);
  const KeptJobs before = read_kept((folder() / "rows.jsonl").string());
  {
    Running third(few_jobs());
    EXPECT_EQ(third.wait(), 0) << third.errors();
    EXPECT_NE(third.errors().find(" jobs are those of an earlier run; --fresh measures them again"), std::string::npos) << third.errors();
  }
  // What was finished was neither measured again nor lost.
  const KeptJobs after = read_kept((folder() / "rows.jsonl").string());
  for (const auto& [key, job] : before) EXPECT_EQ(after.at(key).lines, job.lines);
  const Json whole = report();
  ASSERT_TRUE(whole.is_object());
  const std::vector<std::string> wrong = check_schema(whole);
  EXPECT_TRUE(wrong.empty()) << wrong.front();
  EXPECT_GE(whole["frontier"].size(), devices_here().size());
  EXPECT_GT(whole["stability"].size(), 2 * devices_here().size());

  // Nothing is left to do: the same rows, times included.
  {
    Running again(few_jobs());
    EXPECT_EQ(again.wait(), 0) << again.errors();
  }
  EXPECT_EQ(report()["frontier"], whole["frontier"]);
  EXPECT_EQ(report()["stability"], whole["stability"]);
  EXPECT_EQ(report()["devices"], whole["devices"]);

  // A kernel whose text is another is measured again, and nothing else.
  KeptJobs edited = after;
  const auto blurred = std::find_if(edited.begin(), edited.end(), [](const auto& job) {
    return job.second.finished["label"].template get<std::string>().find("on step") != std::string::npos;
  });
  ASSERT_NE(blurred, edited.end());
  Json last = Json::parse(blurred->second.lines.back());
  ASSERT_FALSE(last["finished"]["modules"].empty());
  for (auto& hash : last["finished"]["modules"]) hash = "0123456789abcdef";
  blurred->second.lines.back() = last.dump();
  ASSERT_TRUE(write_kept((folder() / "rows.jsonl").string(), edited));
  {
    Running changed(few_jobs());
    EXPECT_EQ(changed.wait(), 0) << changed.errors();
  }
  const KeptJobs anew = read_kept((folder() / "rows.jsonl").string());
  ASSERT_EQ(anew.size(), after.size());
  for (const auto& [key, job] : after) EXPECT_EQ(anew.at(key).lines == job.lines, key != blurred->first) << job.finished;
  EXPECT_EQ(errors_of(report()), errors_of(whole));

  // A child that dies loses the job that it was at; with --fresh all is measured again, to the same errors.
  {
    Running dying(with(few_jobs(), "--fresh"));
    // The file is emptied before the first child begins.
    for (int i = 0; i < 4000 && Running::count("\"finished\"") >= after.size(); ++i) std::this_thread::sleep_for(5ms);
    dying.until_finished(1);  // of two that take a second each, and others after them
    const std::vector<pid_t> children = dying.children();
    ASSERT_EQ(children.size(), 1u) << dying.errors();
    ::kill(children.front(), SIGKILL);
    EXPECT_EQ(dying.wait(), 1) << dying.errors();
    EXPECT_NE(dying.errors().find("luxel: cpu:float died: signal 9 (Killed) while at: "), std::string::npos) << dying.errors();
  }
  const Json torn = report();
  ASSERT_TRUE(torn.is_object());
  EXPECT_TRUE(check_schema(torn).empty());
  ASSERT_EQ(torn["devices"].size(), devices_here().size());
  EXPECT_EQ(torn["devices"][0]["died"], true);
  const auto of_device = [](const Json& rows, const std::string& id) {
    return std::count_if(rows.begin(), rows.end(), [&](const Json& r) { return r["device"] == id; });
  };
  for (const Json& d : whole["devices"]) {
    const std::string id = d["id"];
    const auto rows = of_device(torn["frontier"], id) + of_device(torn["stability"], id),
               all = of_device(whole["frontier"], id) + of_device(whole["stability"], id);
    if (id == "cpu:float")
      EXPECT_LT(rows, all);
    else
      EXPECT_EQ(rows, all) << id;
  }
  {
    Running rest(few_jobs());
    EXPECT_EQ(rest.wait(), 0) << rest.errors();
  }
  EXPECT_EQ(errors_of(report()), errors_of(whole));
  fs::remove_all(folder());
}

TEST(ReportResume, OneReportAtATimeWritesToAFolder) {
  fs::remove_all(folder());
  Running first(few_jobs());
  first.until_finished(2);
  const std::string command = LUXEL_PROGRAM " report --quick --no-page --only nothing -o " + folder().string() + " 2>" + folder().string() + ".second";
  const int state = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(state), 2);
  EXPECT_NE(slurp(folder().string() + ".second").find("another report is being written there"), std::string::npos);
  first.signal(SIGTERM);
  EXPECT_EQ(first.wait(), 130);
  fs::remove_all(folder());
}

}  // namespace
}  // namespace luxel::report

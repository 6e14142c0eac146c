// The report: frontier, shape, children that die, and the program itself on a few rows.
#include <gtest/gtest.h>

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "bench/report/child.h"
#include "bench/report/defaults.h"
#include "bench/report/frontier.h"
#include "bench/report/report.h"
#include "bench/report/schema.h"
#include "bench/report/stage.h"
#include "bench/report/stats.h"
#include "bench/report/workers.h"
#include "tests/report/errors_of.h"
#include "tests/support/run.h"

namespace luxel::report {
namespace {

namespace fs = std::filesystem;

Json row(const std::string& group, double error, double q1, double median, double q3) {
  return {
      {"kernel", "k"},
      {"variant", "v"},
      {"device", "cpu:float"},
      {"scene", "s"},
      {"size", "1x1"},
      {"options", Json::object()},
      {"knobs", Json::object()},
      {"time_ms",
       {{"build", nullptr}, {"update", nullptr}, {"shade", {{"median", median}, {"q1", q1}, {"q3", q3}, {"n", 9}, {"busy", false}}}}},
      {"error",
       {{"metric", "m"},
        {"rounding", error},
        {"storage", 0},
        {"device", 0},
        {"method", 0},
        {"discretization", nullptr},
        {"model", nullptr},
        {"stderr", nullptr}}},
      {"bytes", 1},
      {"flops", 1},
      {"memory_bytes", 1},
      {"on_frontier", nullptr},
      {"group", group}};
}

Json device(const std::string& id, bool died = false) {
  return {{"id", id},
          {"name", "n"},
          {"driver", "d"},
          {"profile", "p"},
          {"died", died},
          {"problems", Json::array()},
          {"limits", Json::array()},
          {"first_use", Json::array()}};
}

Json stability(bool pass) {
  return {{"kernel", "k"},  {"case", "c"}, {"device", "cpu:float"},
          {"promise", "p"}, {"bound", 1},  {"measured", pass ? 0 : 2},
          {"pass", pass}};
}

TEST(ReportStats, QuartilesAreInterpolated) {
  const Sample s = summarise({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(s.q1, 1.75);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.q3, 3.25);
  EXPECT_EQ(s.n, 4);
  EXPECT_EQ(summarise({7}).median, 7);
  EXPECT_EQ(summarise({}).n, 0);
}

TEST(ReportFrontier, DominatesOnlyBeyondTheQuartiles) {
  std::vector<Json> rows{row("a", 1e-3, 9, 10, 11),  // beaten by the next: not larger error, q3 6 < q1 9
                         row("a", 1e-3, 4, 5, 6),
                         row("a", 1e-2, 5.5, 7, 8),     // the quartiles overlap: not beaten
                         row("a", 1e-2, 6.5, 7, 8),     // q1 above 6: beaten
                         row("a", 1e-6, 90, 100, 110),  // slow but exact
                         row("b", 1, 900, 1000, 1100),  // alone in its group
                         row("a", std::nan(""), 1, 1, 1)};
  mark_frontier(rows);
  const bool expected[] = {false, true, true, false, true, true, false};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i]["on_frontier"], expected[i]) << i;
    EXPECT_FALSE(rows[i].contains("group"));
  }
}

TEST(ReportDefaults, SaysWhatBeatsADefaultAndWhyItIsOne) {
  const auto ssr = [](const char* variant, double error, double ms) {
    Json r = row("reach 2", error, ms, ms, ms);
    r["kernel"] = "hiz_ssr";
    r["variant"] = variant;
    return r;
  };
  Json all = default_rows({ssr("linear", 0, 3), ssr("hiz", 0, 5), ssr("dda", 0, 4), ssr("stochastic", 1, 1)});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0]["setting"]["variant"], "hiz");
  EXPECT_EQ(all[0]["better"]["setting"]["variant"], "linear");  // the fastest whose error is not larger
  EXPECT_TRUE(all[0]["why"].is_string());
  all = default_rows({ssr("linear", 1e-9, 3), ssr("hiz", 0, 5)});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_TRUE(all[0]["better"].is_null());
  EXPECT_TRUE(all[0]["why"].is_null());
  // Options and knobs count; a row that lacks one is no default.
  Json cones = ssr("isotropic", 0, 1);
  cones["kernel"] = "cone_trace";
  EXPECT_EQ(default_rows({cones}).size(), 0u);
  cones["options"] = {{"input", "buffer"}};
  cones["knobs"] = {{"cones", "6"}, {"footprint", 0.25}, {"step_scale", 1}, {"error", 0}};
  EXPECT_EQ(default_rows({cones}).size(), 1u);
  cones["knobs"]["cones"] = "9";
  EXPECT_EQ(default_rows({cones}).size(), 0u);
}

TEST(ReportFrontier, ErrorIsTheSumOfItsParts) {
  Json r = row("a", 1, 1, 1, 1);
  r["error"]["storage"] = 2;
  r["error"]["device"] = nullptr;
  r["error"]["method"] = 4;
  EXPECT_EQ(total_error(r), 7);
  r["time_ms"]["build"] = {{"median", 2}, {"q1", 1}, {"q3", 3}, {"n", 5}, {"busy", false}};
  EXPECT_EQ(total_time(r).median, 3);
}

Json whole_report() {
  Gathered g;
  g.devices.push_back(device("cpu:float"));
  g.frontier.push_back(row("a", 0, 1, 1, 1));
  g.stability.push_back(stability(true));
  return assemble(std::move(g), {{"cpu", "c"}});
}

TEST(ReportSchema, AcceptsTheReportAndNamesWhatIsWrong) {
  EXPECT_TRUE(check_schema(whole_report()).empty());
  const auto defect = [](auto change) {
    Json report = whole_report();
    change(report);
    const auto wrong = check_schema(report);
    return wrong.empty() ? std::string() : wrong.front();
  };
  EXPECT_EQ(defect([](Json& r) { r.erase("peers"); }), "report.peers is missing");
  EXPECT_EQ(defect([](Json& r) { r["extra"] = 1; }), "report.extra is unknown");
  EXPECT_EQ(defect([](Json& r) { r["frontier"][0].erase("flops"); }), "row 0: frontier.flops is missing");
  EXPECT_EQ(defect([](Json& r) {
              r["frontier"][0]["group"] = 1;
              r["frontier"][0]["more"] = 1;
            }),
            "row 0: frontier.more is unknown");
  EXPECT_EQ(defect([](Json& r) { r["frontier"][0]["error"]["rounding"] = "0"; }),
            "row 0: frontier.error.rounding is a string; expected type n?");
  EXPECT_EQ(defect([](Json& r) { r["frontier"][0]["time_ms"]["shade"].erase("q3"); }),
            "row 0: frontier.time_ms.shade.q3 is missing");
  EXPECT_EQ(defect([](Json& r) { r["frontier"][0]["device"] = "gpu"; }),
            "row 0: frontier.device is gpu; expected opencl..., vulkan... or cpu...");
  EXPECT_EQ(defect([](Json& r) { r["stability"][0]["pass"] = 1; }),
            "row 0: stability.pass is a number; expected type b");
}

TEST(ReportStatus, IsOneWhereAPromiseIsBrokenOrADeviceDied) {
  EXPECT_EQ(exit_status_of(whole_report()), 0);
  Json broken = whole_report();
  broken["stability"].push_back(stability(false));
  EXPECT_EQ(exit_status_of(broken), 1);
  Json died = whole_report();
  died["devices"].push_back(device("opencl:x", true));
  EXPECT_EQ(exit_status_of(died), 1);
}

TEST(ReportRows, DamagedLinesAreNoRows) {
  Gathered g;
  g.devices.push_back(device("cpu:float"));
  const std::string good = Json({{"section", "stability"}, {"row", stability(false)}}).dump();
  EXPECT_EQ(take_line(g, good), good);
  for (const std::string& bad :
       {good.substr(0, good.size() / 2), std::string("noise of a driver"), std::string("[1,2]"), std::string("{}"),
        std::string(R"({"section":"stability","row":{"kernel":"k"}})"), std::string(R"({"section":"x","row":{}})")})
    EXPECT_EQ(take_line(g, bad), "") << bad;
  EXPECT_EQ(g.stability.size(), 1u);
}

std::vector<DeviceInfo> machine_devices() {
  return {{0, Api::opencl, "pthread-Xeon", "pocl", "pocl", "opencl:pthread-Xeon"},
          {1, Api::vulkan, "llvmpipe (LLVM)", "lavapipe", "lavapipe", "vulkan:llvmpipe (LLVM)"},
          {2, Api::cpu, "C++ float", "", "reference", "cpu:float"},
          {3, Api::cpu, "C++ double", "", "reference", "cpu:double"}};
}

TEST(ReportDevices, AreChosenByNameAndTheOracleIsNone) {
  const auto ids = [](const std::vector<std::string>& names) {
    std::string text;
    const auto chosen = choose_devices(machine_devices(), names);
    if (!chosen) return chosen.status().message();
    for (const DeviceInfo& d : chosen.value()) text += std::to_string(d.index);
    return text;
  };
  EXPECT_EQ(ids({}), "201");  // the C++ execution first
  EXPECT_EQ(ids({"vulkan", "opencl", "1"}), "10");
  EXPECT_EQ(ids({"LLVMPIPE"}), "1");
  EXPECT_EQ(ids({"cpu"}), "2");
  EXPECT_EQ(ids({"cpu:double"}), "--device is cpu:double; expected another: every row is compared with cpu:double");
  EXPECT_NE(
      ids({"gtx"}).find(
          "--device is gtx; expected opencl, vulkan, cpu, or an index or part of a name of: 0 opencl:pthread-Xeon"),
      std::string::npos);
  EXPECT_TRUE(choose_devices({machine_devices()[2]}, {"opencl", "cpu"}, {"opencl"}).ok());
}

// A job that takes the small stage leaves the next one its full stage, in whichever order.
TEST(ReportStage, QuickAndFullAreApart) {
  const Place furnace{"furnace (generated)", "furnace", {{}, {}, 0}};
  const auto quick = stage_of(furnace, true), full = stage_of(furnace, false), again = stage_of(furnace, true);
  ASSERT_TRUE(quick.ok() && full.ok() && again.ok());
  EXPECT_EQ(quick.value()->seen.pixels(), 48u * 27u);
  EXPECT_EQ(full.value()->seen.pixels(), 96u * 54u);
  EXPECT_EQ(quick.value(), again.value());
}

TEST(ReportChild, TellsHowItEndedAndKeepsItsLines) {
  const fs::path log = fs::path(testing::TempDir()) / "luxel_child.log";
  const auto shell = [&](const std::string& script, std::vector<std::string>& lines, int silence = 30) {
    return run_child({"/bin/sh", "-c", script}, {"LUXEL_TEST_WORD=word"}, log.string(), silence,
                     [&](const std::string& l) { lines.push_back(l); });
  };
  std::vector<std::string> lines;
  Ended ended = shell("echo one >&3; echo $LUXEL_TEST_WORD >&3; echo log; exit 4", lines);
  EXPECT_FALSE(ended.died());
  EXPECT_EQ(ended.status, 4);
  EXPECT_EQ(lines, (std::vector<std::string>{"one", "word"}));
  std::ifstream file(log);
  std::string text;
  std::getline(file, text);
  EXPECT_EQ(text, "log");

  lines.clear();
  ended = shell("echo before >&3; kill -SEGV $$", lines);
  EXPECT_TRUE(ended.died());
  EXPECT_EQ(ended.signal, SIGSEGV);
  EXPECT_EQ(lines, std::vector<std::string>{"before"});
  EXPECT_NE(ended.reason(1).find("signal 11"), std::string::npos);

  ended = shell("exec sleep 30", lines, 1);
  EXPECT_TRUE(ended.hung);
  EXPECT_EQ(ended.reason(1), "no answer for 1 s");
  EXPECT_FALSE(run_child({"/nonexistent/program"}, {}, log.string(), 5, [](const std::string&) {}).started);
}

// --- The program itself
// ---------------------------------------------------------------------------------------------------

struct Outcome {
  int status = -1;
  Json report;
  std::string stdout_text, stderr_text;
};

std::string slurp(const fs::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Outcome run_program(const std::string& name, const std::string& arguments, const std::string& environment = "") {
  const fs::path folder = fs::path(testing::TempDir()) / ("luxel_report_" + name);
  fs::remove_all(folder);
  const std::string out = folder.string() + ".out", err = folder.string() + ".err";
  const std::string command =
      environment + " " LUXEL_PROGRAM " report " + arguments + " -o " + folder.string() + " >" + out + " 2>" + err;
  Outcome outcome;
  const int state = std::system(command.c_str());
  outcome.status = WIFEXITED(state) ? WEXITSTATUS(state) : -1;
  outcome.report = Json::parse(slurp(folder / "report.json"), nullptr, false);
  outcome.stdout_text = slurp(out);
  outcome.stderr_text = slurp(err);
  return outcome;
}

std::string test_device_options() {
  std::string options;
  for (const std::string& d : test_devices()) options += " --device " + d;
  return options;
}

constexpr const char* few_rows =
    " --quick --only 'on impulse' --only 'case sigma 0 radius' --only 'case opacity 1, isotropic' --only 'mip_build "
    "isotropic unorm8x4 on multiples' --only 'mip_build minmax' "
    "--only 'limit triad' --only 'difference on landscape'";

TEST(Report, TwoRunsAgreeOnEveryErrorToTheLastDigit) {
  const Outcome first = run_program("first", few_rows + test_device_options());
  ASSERT_EQ(first.status, 0) << first.stderr_text << first.stdout_text;
  const std::vector<std::string> wrong = check_schema(first.report);
  EXPECT_TRUE(wrong.empty()) << wrong.front();
  EXPECT_EQ(first.report["devices"].size(), test_devices().size());
  EXPECT_GE(first.report["frontier"].size(), 10 * test_devices().size());
  EXPECT_GE(first.report["stability"].size(), 10 * test_devices().size());
  for (const Json& d : first.report["devices"]) EXPECT_FALSE(d["limits"].empty()) << d["id"];
  for (const Json& r : first.report["frontier"]) {
    EXPECT_EQ(r["error"]["device"], 0) << r.dump();
    EXPECT_GT(total_time(r).median, 0);
    EXPECT_LE(total_time(r).q1, total_time(r).median);
  }
  EXPECT_NE(first.stdout_text.find("gaussian_blur on "), std::string::npos);
  const std::string page = slurp(fs::path(testing::TempDir()) / "luxel_report_first" / "index.html");
  if (page.empty()) {  // only where Python or its packages are missing, and then it is said
    EXPECT_NE(first.stderr_text.find("luxel: no page was made: "), std::string::npos) << first.stderr_text;
  } else {
    EXPECT_NE(page.find("<svg"), std::string::npos);
    EXPECT_NE(page.find("<title>separable f32x"), std::string::npos) << "points name their settings";
    for (const char* outside : {"src=\"http", "href=\"http", "@import", "url(http"})
      EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  const Outcome second = run_program("second", few_rows + test_device_options());
  EXPECT_EQ(errors_of(first.report), errors_of(second.report));
}

TEST(Report, RowsOfTheFileAreThoseOfTheReport) {
  const Outcome o = run_program("rows", " --quick --device cpu --kernel gaussian_blur --only 'on step'");
  ASSERT_EQ(o.status, 0) << o.stderr_text;
  std::ifstream file(fs::path(testing::TempDir()) / "luxel_report_rows" / "rows.jsonl");
  std::size_t frontier = 0;
  for (std::string line; std::getline(file, line);) {
    const Json j = Json::parse(line, nullptr, false);
    ASSERT_TRUE(j.is_object()) << line;
    if (!j.contains("section")) continue;  // where jobs begin and end, and what they note
    EXPECT_TRUE(check_row(j["section"], j["row"]).empty());
    frontier += j["section"] == "frontier" ? 1 : 0;
  }
  EXPECT_EQ(frontier, o.report["frontier"].size());
  EXPECT_GT(frontier, 0u);
}

TEST(Report, ADriverThatDiesLosesOnlyItsOwnRowsAndIsNamed) {
  const fs::path vendors = fs::path(testing::TempDir()) / "luxel_crashing_vendors";
  fs::create_directories(vendors);
  std::ofstream(vendors / "crash.icd") << LUXEL_CRASHING_DRIVER << "\n";
  const std::string environment = "OCL_ICD_VENDORS=" + vendors.string();
  const Outcome o =
      run_program("died", " --quick --kernel gaussian_blur --only 'on step' --device opencl --device cpu", environment);
#if LUXEL_OPENCL
  EXPECT_EQ(o.status, 1) << o.stderr_text;
  EXPECT_NE(o.stderr_text.find("luxel: opencl died"), std::string::npos) << o.stderr_text;
  ASSERT_EQ(o.report["devices"].size(), 2u);
  EXPECT_EQ(o.report["devices"][1]["died"], true);
#endif
  ASSERT_FALSE(o.report["frontier"].empty());
  for (const Json& r : o.report["frontier"]) EXPECT_EQ(r["device"], "cpu:float");
  EXPECT_TRUE(check_schema(o.report).empty());
}

TEST(Workers, EachBusyThreadGetsACoreOfItsOwnAndIdleOnesKeepAll) {
  const std::vector<int> places = cores();
  ASSERT_FALSE(places.empty());
  struct Thread {
    std::atomic<int> id{0};
    std::jthread thread;
  };
  std::vector<Thread> busy(places.size());
  for (Thread& b : busy)
    b.thread = std::jthread([&b](const std::stop_token& stop) {
      b.id = ::gettid();
      while (!stop.stop_requested()) {}
    });
  std::atomic<int> idle_id{0};
  const std::jthread idle([&](const std::stop_token& stop) {
    idle_id = ::gettid();
    while (!stop.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  });
  const auto allowed = [](int thread) {
    cpu_set_t set;
    CPU_ZERO(&set);
    EXPECT_EQ(::sched_getaffinity(thread, sizeof set, &set), 0);
    return set;
  };
  const auto kept = [&] {
    const cpu_set_t set = allowed(busy[0].id);
    return CPU_COUNT(&set) == 1;
  };
  for (const Thread& b : busy)
    while (b.id == 0) std::this_thread::yield();
  while (idle_id == 0) std::this_thread::yield();
  Workers workers;
  // What else runs on the machine may leave a thread without time in one try.
  for (int i = 0; i < 20 && (i == 0 || !kept()); ++i)
    workers.place([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      return true;
    });
  std::vector<int> found;
  for (const Thread& b : busy) {
    const cpu_set_t set = allowed(b.id);
    ASSERT_EQ(CPU_COUNT(&set), 1);
    for (const int core : places)
      if (CPU_ISSET(core, &set)) found.push_back(core);
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, places);
  const cpu_set_t set = allowed(idle_id);
  EXPECT_EQ(CPU_COUNT(&set), static_cast<int>(places.size()));
}

TEST(Report, WrongUseIsOneLineAndStatusTwo) {
  for (const auto& [arguments, text] :
       {std::pair<std::string, std::string>{"--kernel blur",
                                            "luxel: --kernel is blur; expected one of: gaussian_blur, bilateral, mip_build, voxelize, cone_trace, hiz_ssr, "
                                            "octahedral_march, light_propagation\n"},
        {"--image /nonexistent.png", "luxel: --image: /nonexistent.png: "},
        {"--device cpu:double",
         "luxel: --device is cpu:double; expected another: every row is compared with cpu:double\n"}}) {
    const Outcome o = run_program("misuse", arguments);
    EXPECT_EQ(o.status, 2) << arguments;
    EXPECT_EQ(o.stderr_text.substr(0, text.size()), text);
    EXPECT_EQ(std::count(o.stderr_text.begin(), o.stderr_text.end(), '\n'), 1) << o.stderr_text;
    EXPECT_EQ(o.stdout_text, "");
  }
}

}  // namespace
}  // namespace luxel::report

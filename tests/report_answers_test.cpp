// What `luxel tune` and `luxel stability` conclude from numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "bench/report/certificate.h"
#include "bench/report/instruments.h"
#include "bench/report/profile_file.h"
#include "bench/report/tune.h"
#include "tests/support/run.h"

namespace luxel::report {
namespace {

namespace fs = std::filesystem;

Choice choice(const char* name, double error, double q1, double median, double q3) {
  return {{{"variant", name}}, error, {median, q1, q3}};
}

TEST(ReportTune, TheCheapestWithinAnErrorAndTheMostExactWithinATime) {
  const std::vector<Choice> all{choice("coarse", 1e-1, 0.9, 1, 1.1), choice("fast", 1e-3, 1.8, 2, 2.2), choice("as fast", 5e-4, 2.1, 2.3, 2.5),
                                choice("exact", 1e-6, 8, 9, 10), choice("broken", std::nan(""), 0.1, 0.1, 0.1)};
  TuneRequest r;
  r.max_error = 1e-3;  // the bound itself is within
  Answer a = answer_of(r, all);
  ASSERT_TRUE(a.found);
  EXPECT_EQ(a.found->row["variant"], "fast");
  ASSERT_EQ(a.as_fast.size(), 1u);
  EXPECT_EQ(a.as_fast[0].row["variant"], "as fast");
  r.max_error = 1e-7;
  a = answer_of(r, all);
  EXPECT_FALSE(a.found);
  ASSERT_TRUE(a.nearest);
  EXPECT_EQ(a.nearest->row["variant"], "exact");
  r.max_error.reset();
  r.max_ms = 2.2;
  EXPECT_EQ(answer_of(r, all).found->row["variant"], "fast");
  r.max_ms = 9;
  EXPECT_EQ(answer_of(r, all).found->row["variant"], "exact");
  r.max_ms = 0.5;  // a result that is not a number is none, however fast
  a = answer_of(r, all);
  EXPECT_FALSE(a.found);
  EXPECT_EQ(a.nearest->row["variant"], "coarse");
  EXPECT_FALSE(answer_of(r, {}).nearest);
}

TEST(ReportTune, SettingsAreSpelledAsCommandsAndAsCpp) {
  const Json row{{"kernel", "gaussian_blur"},
                 {"variant", "pyramid"},
                 {"scene", "s"},
                 {"size", "8x8"},
                 {"options", {{"format", "f16x4"}, {"border", "mirror"}, {"input", "buffer"}, {"difference", false}, {"keep_alpha", true}, {"drop_taps", false}}},
                 {"knobs", {{"sigma", 12.5}, {"levels", 2}, {"filter", "cubic"}}}};
  const Spelled s = spelled(row);
  EXPECT_EQ(s.command,
            "luxel gaussian_blur --in image.exr -o blurred.exr --sigma 12.5 --variant pyramid --levels 2 --filter cubic --border mirror --format f16 --keep-alpha");
  for (const char* line : {"#include <luxel/gaussian_blur.h>", "p.sigma = 12.5;", "p.levels = 2;", "p.filter = luxel::PyramidFilter::cubic;",
                           "p.border = luxel::Border::mirror;", "p.variant = luxel::GaussianVariant::pyramid;", "p.format = luxel::Format::f16x4;",
                           "p.keep_alpha = true;"})
    EXPECT_NE(s.cpp.find(line), std::string::npos) << line << "\n" << s.cpp;
  EXPECT_EQ(s.cpp.find("difference"), std::string::npos);
}

TEST(ReportTune, ProfilesComeBackFromTheirFileAndOtherDriversDoNotCount) {
  const fs::path folder = fs::path(testing::TempDir()) / "luxel_profiles";
  fs::remove_all(folder);
  fs::create_directories(folder);
  ::setenv("LUXEL_PROFILES", folder.c_str(), 1);
  const std::string device = test_devices().front();
  const auto opened = Context::open(device);
  ASSERT_TRUE(opened.ok());
  const DeviceInfo& info = opened.value()->info();
  Profile p = profile("lavapipe");
  p.name = "mine";
  p.rows = {4, 3, 7, 1, {8, 2, 1}};
  p.texels = false;
  const auto write = [&](const Json& json) { std::ofstream(profile_path(info)) << json.dump(); };
  write(to_json(info, p));
  if (info.api == Api::cpu) {
    EXPECT_EQ(tuned(opened.value())->profile().name, opened.value()->profile().name);
  } else {
    std::string problem;
    EXPECT_EQ(to_json(info, tuned(opened.value(), &problem)->profile()), to_json(info, p));
    EXPECT_EQ(problem, "");
    DeviceInfo other = info;
    other.driver = "another";
    write(to_json(other, p));
    EXPECT_EQ(tuned(opened.value(), &problem)->profile().name, opened.value()->profile().name);
    EXPECT_NE(problem.find("it was made with another driver, another"), std::string::npos) << problem;
  }
  Json damaged = to_json(info, p);
  damaged["profile"]["rows"]["block"] = 0;
  EXPECT_EQ(profile_from(damaged).status().message(), "rows.block is 0; expected a whole number 1..64");
  damaged["profile"]["rows"]["block"] = 1;
  damaged["profile"].erase("columns");
  EXPECT_EQ(profile_from(damaged).status().message(), "columns is missing; expected an object");
  ::unsetenv("LUXEL_PROFILES");
  fs::remove_all(folder);
}

TEST(ReportInstruments, PowersAreFittedAndEdgesAreFound) {
  EXPECT_NEAR(fitted_power("x", {{1, 2}, {2, 8}, {4, 32}, {8, 128}}).measured, 2, 1e-12);
  EXPECT_EQ(fitted_power("x", {{1, 0}, {2, 0}, {4, 0}}).measured, 0);
  EXPECT_NEAR(fitted_power("x", {{1, 0}, {2, 1}, {4, 0.5}}).measured, -1, 1e-12);
  EXPECT_TRUE(std::isnan(fitted_power("x", {{1, 1}, {2, std::nan("")}}).measured));
  EXPECT_NE(fitted_power("error by x", {{1, 2}, {2, 8}}).where.find("error by x: 1: 2, 2: 8"), std::string::npos);

  const auto below = [](double limit) { return [limit](double v) -> Result<bool> { return v <= limit; }; };
  EXPECT_NEAR(edge_between(1, 1e9, below(12345)).value() / 12345, 1, 2e-3);
  EXPECT_EQ(edge_between(1, 100, below(1e9)).value(), 100);
  EXPECT_TRUE(std::isnan(edge_between(10, 100, below(1)).value()));
  // Downwards: what must not be smaller.
  EXPECT_NEAR(edge_between(1, 1e-12, [](double v) -> Result<bool> { return v >= 1e-5; }).value() / 1e-5, 1, 2e-3);
  EXPECT_EQ(edge_between(1, 2, [](double) -> Result<bool> { return Status(Code::internal, "no"); }).status().message(), "no");
}

TEST(ReportInstruments, NamesSayWhatTheyAreAndEveryKernelHasSome) {
  std::set<std::string> families, names;
  for (const Instrument& i : instruments()) {
    EXPECT_TRUE(i.name.starts_with("gain: ") || i.name.starts_with("growth: ") || i.name.starts_with("storage: ") || i.name.starts_with("edge: ")) << i.name;
    EXPECT_TRUE(names.insert(i.kernel + i.name).second) << "twice: " << i.kernel << " " << i.name;
    EXPECT_TRUE(Settings{}.wants(i.family));
    families.insert(i.family);
  }
  for (const std::string& kernel : measured_kernels()) EXPECT_TRUE(families.contains(kernel)) << kernel;
}

Json row(const char* name, const char* promise, double bound, Json measured, bool pass, const char* device = "cpu:float") {
  return {{"kernel", "k"}, {"case", name}, {"device", device}, {"promise", promise}, {"bound", bound}, {"measured", std::move(measured)}, {"pass", pass}};
}

TEST(ReportCertificate, ALineIsAClassWithTheWorstOfItsCases) {
  const Json report{{"devices", Json::array()},
                    {"stability",
                     {row("NaN, linear", "p", 1, 0.5, true), row("NaN, clamp", "p", 2, 1.5, true, "vulkan:x"), row("NaN, other", "q", 0, 0, true),
                      row("huge", "p", 1, 0.1, true), row("huge", "p", 1, nullptr, false, "opencl:y"), row("edge: largest", "p (goes wrong at 4)", 1, 0.25, true)}}};
  const auto lines = certificate(report);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0].input, "NaN");
  EXPECT_EQ(lines[0].cases, 2);
  EXPECT_EQ(lines[0].measured, 1.5);  // three quarters of its bound, the other half of its own
  EXPECT_EQ(lines[0].bound, 2);
  EXPECT_EQ(lines[0].where, "NaN, clamp on vulkan:x");
  EXPECT_EQ(lines[1].promise, "q");
  EXPECT_EQ(lines[2].input, "huge");
  EXPECT_EQ(lines[2].broken, 1);
  EXPECT_EQ(lines[2].where, "on opencl:y");
  EXPECT_TRUE(std::isnan(lines[2].measured));
  EXPECT_EQ(lines[3].promise, "p");
  EXPECT_EQ(lines[3].where, "goes wrong at 4 on cpu:float");
  const auto pages = certificate_pages(report);
  ASSERT_EQ(pages.size(), 1u);
  EXPECT_NE(pages[0].second.find("| huge | p | 1 | nan | on opencl:y | 2 | **1 broken** |"), std::string::npos) << pages[0].second;
}

}  // namespace
}  // namespace luxel::report

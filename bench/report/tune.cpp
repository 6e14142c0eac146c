#include "bench/report/tune.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "bench/io/temporary_folder.h"
#include "bench/report/child.h"
#include "bench/report/grid.h"
#include "bench/report/profile_file.h"
#include "bench/report/progress.h"
#include "bench/report/report.h"
#include "bench/report/session.h"

namespace luxel::report {
namespace {

namespace fs = std::filesystem;

// What a session sends, read back from memory.
class Sent {
 public:
  Sent() : fd_(::memfd_create("luxel rows", MFD_CLOEXEC)) {}
  ~Sent() {
    if (fd_ >= 0) ::close(fd_);
  }
  Sent(const Sent&) = delete;
  Sent& operator=(const Sent&) = delete;
  int fd() const { return fd_; }
  // The messages since the last call.
  std::vector<Json> take() {
    std::string text;
    char buffer[1 << 14];
    for (ssize_t n; (n = ::pread(fd_, buffer, sizeof buffer, at_)) > 0; at_ += n) text.append(buffer, static_cast<std::size_t>(n));
    std::vector<Json> messages;
    for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
      if (Json j = Json::parse(text.substr(begin, end - begin), nullptr, false); j.is_object()) messages.push_back(std::move(j));
    return messages;
  }

 private:
  int fd_;
  off_t at_ = 0;
};

std::string text_of(const Json& v) { return v.is_string() ? v.get<std::string>() : v.is_number_float() ? fmt::format("{}", v.get<double>()) : v.dump(); }

bool has(const Json& row, const std::string& name, const std::string& value) {
  if (name == "variant" || name == "size" || name == "kernel") return row.at(name) == value;
  for (const char* where : {"options", "knobs"})
    if (row.at(where).contains(name)) return text_of(row.at(where).at(name)) == value;
  return false;
}

bool wanted(const TuneRequest& r, const Json& row) {
  const std::string size = r.settings.width > 0 ? fmt::format("{}x{}", r.settings.width, r.settings.height) : "";
  return row.at("scene").get<std::string>().find(r.scene) != std::string::npos &&
         row.at("error").at("metric").get<std::string>().find(r.metric) != std::string::npos && (size.empty() || row.at("size") == size) &&
         !row.at("options").contains("peer") && !row.at("knobs").contains("level") &&
         std::all_of(r.fixed.begin(), r.fixed.end(), [&](const auto& f) { return has(row, f.first, f.second); });
}

// What rows compare within, without the device.
std::string group_of(const Json& row) {
  const std::string group = row.value("group", "");
  return fmt::format("{}|{}|{}|{}|{}", row.at("kernel").get<std::string>(), row.at("scene").get<std::string>(), row.at("size").get<std::string>(),
                     row.at("error").at("metric").get<std::string>(), group.substr(group.rfind('|') == std::string::npos ? 0 : group.rfind('|') + 1));
}

// Without a scene or metric that was asked for, those of the first row.
void settle(TuneRequest& r, const Json& row) {
  if (r.scene.empty()) r.scene = row.at("scene");
  if (r.metric.empty()) r.metric = row.at("error").at("metric");
}

std::string line_of(const Json& row) {
  std::string text = row.at("variant");
  for (const char* where : {"options", "knobs"})
    for (const auto& [name, v] : row.at(where).items()) {
      if (v.is_boolean()) {
        if (v.get<bool>()) text += " " + name;
      } else {
        text += v.is_number_float() ? fmt::format(" {} {:.4g}", name, v.get<double>()) : fmt::format(" {} {}", name, text_of(v));
      }
    }
  return text;
}

Json json_of(const Choice& c) {
  Json row = c.row;
  row.erase("group");
  const Spelled s = spelled(c.row);
  return {{"row", row}, {"error", c.error}, {"time_ms", {{"median", c.ms.median}, {"q1", c.ms.q1}, {"q3", c.ms.q3}}}, {"command", s.command}, {"cpp", s.cpp}};
}

std::string ms_text(const Span& ms) { return fmt::format("{:.3g} ms (quartiles {:.3g} to {:.3g})", ms.median, ms.q1, ms.q3); }

}  // namespace

Answer answer_of(const TuneRequest& r, const std::vector<Choice>& choices) {
  Answer a;
  const auto sound = [](const Choice& c) { return c.error >= 0 && c.ms.median > 0; };
  const auto fits = [&](const Choice& c) { return sound(c) && (r.max_error ? c.error <= *r.max_error : c.ms.median <= *r.max_ms); };
  // Within an error the fastest, of equally fast ones the most exact; within a time the other way round.
  const auto before = [&](const Choice& x, const Choice& y) {
    return r.max_error ? std::pair(x.ms.median, x.error) < std::pair(y.ms.median, y.error) : std::pair(x.error, x.ms.median) < std::pair(y.error, y.ms.median);
  };
  for (const Choice& c : choices)
    if (fits(c) && (!a.found || before(c, *a.found))) a.found = c;
  if (a.found) {
    for (const Choice& c : choices)
      if (r.max_error && fits(c) && before(*a.found, c) && c.ms.q1 <= a.found->ms.q3) a.as_fast.push_back(c);
    return a;
  }
  const auto nearer = [&](const Choice& x, const Choice& y) { return r.max_error ? x.error < y.error : x.ms.median < y.ms.median; };
  for (const Choice& c : choices)
    if (c.error >= 0 && (r.max_error || sound(c)) && (!a.nearest || nearer(c, *a.nearest))) a.nearest = c;
  return a;
}

int run_tune(const TuneRequest& request) {
  TuneRequest r = request;
  const std::string kernel = r.settings.kernels.front();
  const io::TemporaryFolder folder("luxel-tune");
  if (folder.path().empty()) return complain("no folder can be made for temporary files; set TMPDIR to one that can be written", 1);
  r.settings.out = folder.path();
  const auto opened = open_tuned(r.settings.devices.empty() ? "" : r.settings.devices.front());
  if (!opened) return complain(opened.status().message(), 2);
  if (opened.value()->real64()) return complain("--device is cpu:double; expected another: every result is compared with cpu:double", 2);

  const Interruptible interruptible;
  std::optional<Progress> progress;  // for somebody who looks on
  if (::isatty(STDERR_FILENO) == 1) progress.emplace();
  const auto say = [&](const std::string& text) {
    if (progress) progress->line(text);
    else fmt::print(stderr, "luxel: {}\n", text);
  };
  std::vector<std::string> missing;
  // Errors of all settings by the C++ executions, which no driver compiles: what of them is too large is not timed.
  std::map<std::string, std::vector<Choice>> known;  // by label
  std::vector<std::string> order;                    // of groups
  const auto run_jobs = [&](Session& session, const std::vector<Job>& jobs, Sent& sent, const std::string& part, const auto& skip, const auto& take) {
    if (progress) progress->begin(part);
    for (std::size_t i = 0; i < jobs.size() && !interrupted(); ++i) {
      if (progress) progress->update(static_cast<double>(i), static_cast<double>(jobs.size()), jobs[i].label);
      if (skip(jobs[i])) continue;
      session.run({jobs[i]});
      for (const Json& m : sent.take()) {
        if (m.value("section", "") == "frontier") take(jobs[i].label, m.at("row"));
        if (m.value("note", "") == "problems" && m.at("entry").is_string()) say(m.at("entry").get<std::string>());
      }
    }
  };
  std::vector<Json> first_rows;
  if (r.max_error) {
    Settings once = r.settings;
    once.once = true;
    Sent sent;
    Session session(Context::open("cpu:float").value(), once, sent.fd(), 0);
    const std::vector<Job> jobs = grid_jobs(session, kernel, !request.scene.empty(), missing);
    run_jobs(session, jobs, sent, "errors in C++", [](const Job&) { return false; },
             [&](const std::string& label, const Json& row) {
               first_rows.push_back(row);
               known[label].push_back({row, total_error(row), {}});
             });
  }
  std::vector<Choice> choices;
  int of = 0, skipped = 0;
  {
    Sent sent;
    Session session(opened.value(), r.settings, sent.fd(), 0);
    const std::vector<Job> jobs = grid_jobs(session, kernel, !request.scene.empty(), missing);
    for (const Json& row : first_rows)
      if (wanted(r, row)) {
        settle(r, row);
        break;
      }
    run_jobs(session, jobs, sent, opened.value()->info().id,
             [&](const Job& job) {
               const auto rows = known.find(job.label);
               if (rows == known.end()) return ++of, false;  // C++ leaves out what takes it too long: measured
               bool any = false, fits = false;
               for (const Choice& c : rows->second)
                 if (wanted(r, c.row)) any = true, fits = fits || c.error <= *r.max_error;
               of += any;
               skipped += any && !fits;
               return !fits;
             },
             [&](const std::string&, const Json& row) {
               if (!wanted(r, row)) return;
               settle(r, row);
               if (wanted(r, row)) choices.push_back({row, total_error(row), total_time(row)});
             });
  }
  if (progress) progress->end();
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  for (const std::string& line : missing) say("skipped: " + line);
  if (interrupted()) return complain("interrupted", 130);

  // Groups in the order of rows; errors of what was not timed say what came nearest.
  std::map<std::string, std::vector<Choice>> groups;
  const auto add = [&](const Choice& c) {
    const std::string key = group_of(c.row);
    if (!groups.contains(key)) order.push_back(key);
    groups[key].push_back(c);
  };
  for (const Choice& c : choices) add(c);
  for (const auto& [label, rows] : known)
    for (const Choice& c : rows)
      if (wanted(r, c.row) && c.error > *r.max_error) add(c);
  if (order.empty())
    return complain(fmt::format("no setting of {} fits what is asked for (--scene, --size, --metric, --fix); `luxel report --kernel {}` lists scenes, sizes and metrics", kernel, kernel), 2);

  const std::string limit = r.max_error ? fmt::format("error at most {:g}", *r.max_error) : fmt::format("at most {:g} ms", *r.max_ms);
  Json answers = Json::array();
  bool any = false;
  fmt::print("{} on {}, {}: {} of {} settings timed{}\n", kernel, opened.value()->info().id, limit, of - skipped, of,
             skipped > 0 ? "; the others' error is larger, known from C++" : "");
  for (const std::string& key : order) {
    const Answer a = answer_of(r, groups[key]);
    const Json& sample = groups[key].front().row;
    const std::string group = key.substr(key.rfind('|') + 1);
    fmt::print("\n{}, {}{}, error by {}\n", sample.at("scene").get<std::string>(), sample.at("size").get<std::string>(),
               group.empty() ? "" : fmt::format(" ({})", group), sample.at("error").at("metric").get<std::string>());
    Json answer{{"kernel", sample.at("kernel")}, {"scene", sample.at("scene")}, {"size", sample.at("size")}, {"metric", sample.at("error").at("metric")}, {"group", group}, {"found", nullptr}, {"nearest", nullptr}, {"margin", nullptr}, {"as_fast", Json::array()}};
    if (!a.found) {
      if (a.nearest) {
        answer["nearest"] = json_of(*a.nearest);
        fmt::print("  none fits; nearest: {}: error {:.3g}{}\n", line_of(a.nearest->row), a.nearest->error,
                   a.nearest->ms.median > 0 ? ", " + ms_text(a.nearest->ms) : "");
      } else {
        fmt::print("  none fits, and none gave a number\n");
      }
      answers.push_back(answer);
      continue;
    }
    any = true;
    const Choice& c = *a.found;
    const double used = r.max_error ? c.error / *r.max_error : c.ms.median / *r.max_ms;
    answer["found"] = json_of(c);
    answer["margin"] = {{"used", used}};
    if (r.max_ms) answer["margin"]["used_q1"] = c.ms.q1 / *r.max_ms, answer["margin"]["used_q3"] = c.ms.q3 / *r.max_ms;
    fmt::print("  {}\n  error {:.3g}, {}; {}\n", line_of(c.row), c.error, ms_text(c.ms),
               r.max_error ? fmt::format("{:.3g} of the error allowed", used)
                           : fmt::format("{:.3g} of the time allowed (quartiles {:.3g} to {:.3g})", used, c.ms.q1 / *r.max_ms, c.ms.q3 / *r.max_ms));
    for (const Choice& other : a.as_fast) {
      answer["as_fast"].push_back(json_of(other));
      fmt::print("  not told apart by its quartiles: {}: error {:.3g}, {}\n", line_of(other.row), other.error, ms_text(other.ms));
    }
    const Spelled s = spelled(c.row);
    if (!s.command.empty()) fmt::print("\n  {}\n", s.command);
    if (!s.cpp.empty()) fmt::print("\n{}", s.cpp);
    answers.push_back(answer);
  }
  if (!r.json.empty()) {
    Json j{{"kernel", kernel}, {"device", opened.value()->info().id}, {"driver", opened.value()->info().driver}, {"max_error", nullptr}, {"max_ms", nullptr}, {"answers", answers}};
    if (r.max_error) j["max_error"] = *r.max_error;
    if (r.max_ms) j["max_ms"] = *r.max_ms;
    if (Status s = write_file(r.json, j.dump(1) + "\n"); !s) return complain(s.message(), 1);
  }
  return any ? 0 : complain(fmt::format("no setting of {} has {}; the nearest stands above", kernel, limit), 1);
}

}  // namespace luxel::report

#include "bench/report/session.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "bench/report/json.h"
#include "bench/report/kept.h"
#include "bench/report/recorded.h"
#include "host/module.h"

namespace luxel::report {
namespace {

constexpr double quick_pairs_ms = 300, pairs_ms = 3000;  // what pairs may take, where three (whole reports: nine) take no longer
constexpr double slow_pair_ms = 500;                     // above it five must do, warm after one
constexpr double long_s = 2;                             // rows that take so long are taken again once at most

// Labels begin with their kernel's name.
std::string kernel_of(const std::string& label) { return label.substr(0, label.find(' ')); }

}  // namespace

std::uint64_t hash_bytes(const std::vector<std::byte>& bytes) {
  std::uint64_t value = 0xcbf29ce484222325ull;
  for (const std::byte b : bytes) value = (value ^ static_cast<std::uint64_t>(b)) * 0x100000001b3ull;
  return value;
}

std::uint64_t hash_values(const std::vector<double>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return hash_bytes({bytes.begin(), bytes.end()});
}

Session::Session(std::shared_ptr<Context> context, Settings settings, int rows, double best_guard)
    : settings_(std::move(settings)), rows_(rows), guard_(best_guard),
      kept_(std::make_shared<const KeptJobs>(read_kept(settings_.out + "/rows.jsonl"))) {
  context_ = noting(std::move(context));
  load_oracles();
}

// The context, with what it compiles noted for the kernel whose jobs run.
std::shared_ptr<Context> Session::noting(std::shared_ptr<Context> context) {
  return recorded(std::move(context), [this](const Plan& plan) {
    for (const Pass& pass : plan.passes) {
      const std::string name = std::string(pass.module->part) + "." + std::string(pass.module->name);
      std::string& hash = compiled_[kernel_][name];
      if (hash.empty()) hash = module_hash(name);
    }
  });
}

Context& Session::cpu_float() {
  // The C++ executions need no driver; they always open.
  if (!cpu_float_) cpu_float_ = noting(Context::open("cpu:float").value());
  return *cpu_float_;
}

Context& Session::cpu_double() {
  if (!cpu_double_) cpu_double_ = noting(Context::open("cpu:double").value());
  return *cpu_double_;
}

void Session::send(Json message) {
  if (!job_.empty()) message["job"] = job_;
  const std::string line = message.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  std::size_t at = 0;
  while (at < line.size()) {
    const ssize_t n = ::write(rows_, line.data() + at, line.size() - at);
    if (n <= 0) return;  // the parent is gone
    at += static_cast<std::size_t>(n);
  }
}

void Session::row(const std::string& section, const Cell& row) { send({{"section", section}, {"row", row.json()}}); }

void Session::note(const std::string& list, const Cell& entry) { send({{"note", list}, {"entry", entry.json()}}); }

void Session::progress(std::size_t done, std::size_t of, const std::string& label) {
  send({{"done", done}, {"of", of}, {"label", label}, {"guard", guard_.best()}});
}

bool Session::keep(const std::string& key, const std::string& label) {
  const auto found = kept_->find(key);
  if (found == kept_->end() || found->second.finished.value("label", "") != label) return false;
  const Json& modules = found->second.finished["modules"];
  if (!unchanged(modules)) return false;
  for (const auto& [name, hash] : modules.items()) compiled_[kernel_][name] = hash.get<std::string>();
  for (const std::string& line : found->second.lines) {
    const Json j = Json::parse(line, nullptr, false);
    const std::string list = j.value("note", "");
    if (list != "bits" && list != "share") continue;
    const Json& e = j.at("entry");
    const std::string kernel = e.at("kernel"), what = e.at("label");
    if (list == "bits")
      add_bits(kernel, e.at("equal"), what);
    else
      add_share(kernel, e.at("name"), e.at("promise"), e.at("share").is_number() ? e.at("share").get<double>() : NAN, what);
  }
  send({{"kept", key}});
  return true;
}

void Session::run(const std::vector<Job>& jobs) {
  std::map<std::string, int> times;  // that a label was met
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::string& label = jobs[i].label;
    progress(i, jobs.size(), label);
    kernel_ = kernel_of(label);
    const int earlier = times[label]++;
    const std::string key = job_key(context_->info(), context_->profile(), settings_,
                                    earlier > 0 ? fmt::format("{}|{}", label, earlier) : label);
    if (keep(key, label)) continue;
    job_ = key;
    send({{"begin", label}});
    const auto begin = std::chrono::steady_clock::now();
    const Status status = jobs[i].run();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    note("spent", {{"label", label}, {"seconds", spent.count()}});
    if (!status) note("problems", fmt::format("{}: {}", label, status.message()));
    if (!status && status.code() != Code::unsupported)
      row("stability", {{"kernel", kernel_of(label)},
                        {"case", "runs: " + label},
                        {"device", device()},
                        {"promise", "every setting of the report runs: " + status.message()},
                        {"bound", 0},
                        {"measured", 1},
                        {"pass", false}});
    else
      send({{"finished", {{"label", label}, {"modules", Json(compiled_[kernel_])}, {"guard", guard_.best()}}}});
    job_.clear();
  }
  kernel_.clear();
  progress(jobs.size(), jobs.size(), "");
}

template <class Take>
auto Session::guarded(const Take& take, const std::string& label) -> decltype(take()) {
  ++timed_;
  // Where the machine is busy all the time, taking rows again does not help: it is bounded.
  int most = settings_.quick ? 1 : 3;
  const auto may_retake = [&] { return retaken_ < std::max(settings_.quick ? 8 : 20, timed_ / 10); };
  double lowest = 0;
  for (int attempt = 0;; ++attempt) {
    const double before = guard_.measure();
    const auto begin = std::chrono::steady_clock::now();
    auto taken = take();
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() > long_s) most = 1;
    lowest = std::min(before, guard_.measure());
    if (!taken.ok() || guard_.quiet(lowest)) return taken;
    if (attempt == most || !may_retake()) {
      note("busy", {{"label", label}, {"gflops", lowest}, {"best", guard_.best()}});
      if constexpr (requires { taken.value().busy; }) taken.value().busy = true;
      return taken;
    }
    ++retaken_;
    std::this_thread::sleep_for(std::chrono::milliseconds(50 << attempt));
  }
}

Result<Sample> Session::time(cases::Run& run, const std::string& label) {
  Times first, second;
  if (Status status = run.go(1, &first); !status) return status;
  if (settings_.once) return summarise({first.total});
  if (Status status = run.go(1, &second); !status) return status;
  note("first_use", {{"label", label}, {"compile_ms", run.compile_ms()}, {"first_run_ms", first.total}});
  if (!is_cpu()) workers_.place([&] { return run.go(1).ok(); });
  const double one = std::max(1e-3, std::min(first.total, second.total));
  const double sample_ms = settings_.quick ? 1.0 : 3.0, budget_ms = settings_.quick ? 60 : 200;
  const int repeat = std::clamp(static_cast<int>(std::ceil(sample_ms / one)), 1, 1000);
  // Quartiles need five; where a run takes a second, or is slow for the C++ execution or a quick report, three must do.
  const int least = one > ((is_cpu() || settings_.quick) ? 50 : 1000) ? 3 : 5;
  const int n = std::clamp(static_cast<int>(budget_ms / (one * repeat)), least, settings_.quick ? 9 : 21);
  return guarded(
      [&]() -> Result<Sample> {
        std::vector<double> ms;
        for (int i = 0; i < n; ++i) {
          Times times;
          if (Status status = run.go(repeat, &times); !status) return status;
          ms.push_back(times.total / repeat);
        }
        return summarise(std::move(ms));
      },
      label);
}

Result<Session::Pair> Session::interleave(const Timed& a, const Timed& b, const std::string& label) {
  if (settings_.once) {
    const Result<double> first = a(), second = b();
    if (!first) return first.status();
    if (!second) return second.status();
    return Pair{{first.value()}, {second.value()}};
  }
  double one = 0;
  for (int warm = 0; warm < (one < slow_pair_ms ? 2 : 1); ++warm) {
    const Result<double> first = a(), second = b();
    if (!first) return first.status();
    if (!second) return second.status();
    one = first.value() + second.value();
  }
  if (!is_cpu()) workers_.place([&] { return a().ok(); });
  const int least = settings_.quick ? 3 : one < slow_pair_ms ? 9 : 5;
  const int n = std::clamp(static_cast<int>((settings_.quick ? quick_pairs_ms : pairs_ms) / one), least, settings_.quick ? 9 : 25);
  return guarded(
      [&]() -> Result<Pair> {
        Pair pair;
        for (int i = 0; i < n; ++i) {
          const Result<double> first = a();
          if (!first) return first.status();
          const Result<double> second = b();
          if (!second) return second.status();
          pair.a.push_back(first.value());
          pair.b.push_back(second.value());
        }
        return pair;
      },
      label);
}

void Session::load_oracles() {
  std::ifstream file(settings_.out + "/oracles.jsonl");
  for (std::string line; std::getline(file, line);) {
    const Json j = Json::parse(line, nullptr, false);
    if (!j.is_object() || !j.contains("modules") || !unchanged(j["modules"])) continue;
    const auto number_of = [](const Json& v) { return v.is_number() ? v.get<double>() : NAN; };
    if (j.contains("numbers")) {
      std::vector<double>& numbers = numbers_[j.at("key").get<std::string>()];
      numbers.clear();
      for (const Json& v : j["numbers"]) numbers.push_back(number_of(v));
      continue;
    }
    std::vector<Oracle>& list = oracles_[j.at("key").get<std::string>()];
    list.clear();
    for (const Json& o : j.at("oracles")) {
      const auto number = [&](const char* field) { return number_of(o.at(field)); };
      list.push_back({o.at("bits").get<std::uint64_t>(), number("rounding"), number("storage"), number("method")});
    }
  }
}

Result<std::vector<Oracle>> Session::oracles(const std::string& key,
                                             const std::function<Result<std::vector<Oracle>>()>& compute) {
  if (const auto found = oracles_.find(key); found != oracles_.end()) return found->second;
  Result<std::vector<Oracle>> made = compute();
  if (!made) return made;
  Json list = Json::array();
  for (const Oracle& o : made.value())
    list.push_back({{"bits", o.bits}, {"rounding", o.rounding}, {"storage", o.storage}, {"method", o.method}});
  save_oracle(key, "oracles", std::move(list));
  return oracles_[key] = std::move(made).value();
}

Result<std::vector<double>> Session::shared(const std::string& label, const std::function<Result<std::vector<double>>()>& compute) {
  if (const auto found = numbers_.find(label); found != numbers_.end()) return found->second;
  Result<std::vector<double>> made = compute();
  if (!made) return made;
  save_oracle(label, "numbers", made.value());
  return numbers_[label] = std::move(made).value();
}

void Session::save_oracle(const std::string& key, const char* what, Json value) {
  // A line of its own, also after one that a killed process left in its middle.
  std::ofstream(settings_.out + "/oracles.jsonl", std::ios::app)
      << "\n" + Json({{"key", key}, {what, std::move(value)}, {"modules", Json(compiled_[kernel_])}}).dump() + "\n";
}

Result<std::vector<ErrorSplit>> Session::errors(const std::string& label, const std::vector<std::string>& metrics,
                                                std::uint64_t bits, bool promised,
                                                const std::function<Result<std::vector<Oracle>>()>& compute,
                                                const std::function<Result<std::vector<double>>()>& device) {
  const Result<std::vector<Oracle>> found = oracles(label, compute);
  if (!found) return found.status();
  const bool equal = bits == found.value().front().bits;
  if (promised) promise_bits(kernel_of(label), equal, label);
  std::vector<double> apart(metrics.size(), 0.0);
  if (!equal) {
    Result<std::vector<double>> off = device();
    if (!off) return off.status();
    apart = std::move(off).value();
  }
  std::vector<ErrorSplit> errors;
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    const Oracle& o = found.value().at(i);
    errors.push_back({metrics[i], o.rounding, o.storage, apart.at(i), o.method});
  }
  return errors;
}

void Session::frontier(const FrontierRow& r) {
  const ErrorSplit& e = r.error;
  row("frontier", {{"kernel", r.kernel},
                   {"variant", r.variant},
                   {"device", device()},
                   {"scene", r.scene},
                   {"size", r.size},
                   {"options", r.options},
                   {"knobs", r.knobs},
                   {"time_ms", {{"build", r.build}, {"update", r.update}, {"shade", r.shade}}},
                   {"error",
                    {{"metric", e.metric},
                     {"rounding", e.rounding},
                     {"storage", e.storage},
                     {"device", e.device},
                     {"method", e.method},
                     {"discretization", e.discretization},
                     {"model", e.model},
                     {"stderr", e.standard_error}}},
                   {"bytes", r.bytes},
                   {"flops", r.flops},
                   {"memory_bytes", r.memory},
                   {"on_frontier", nullptr},
                   {"group", fmt::format("{}|{}|{}|{}|{}|{}", r.kernel, device(), r.scene, r.size, e.metric, r.group)}});
}

void Session::promise_bits(const std::string& kernel, bool equal, const std::string& label) {
  note("bits", {{"kernel", kernel}, {"equal", equal}, {"label", label}});
  add_bits(kernel, equal, label);
}

void Session::add_bits(const std::string& kernel, bool equal, const std::string& label) {
  Bits& bits = bits_[kernel];
  bits.checked += 1;
  if (equal) return;
  bits.different += 1;
  if (bits.first.empty()) bits.first = label;
}

void Session::promise_share(const std::string& kernel, const std::string& name, const std::string& promise,
                            double share, const std::string& label) {
  note("share", {{"kernel", kernel}, {"name", name}, {"promise", promise}, {"share", share}, {"label", label}});
  add_share(kernel, name, promise, share, label);
}

void Session::add_share(const std::string& kernel, const std::string& name, const std::string& promise, double share,
                        const std::string& label) {
  Share& s = shares_[{kernel, name}];
  s.promise = promise;
  if (std::isnan(s.most) || share <= s.most) return;
  s.most = share;  // NaN too, which stays
  s.worst = label;
}

void Session::emit_promises() {
  for (const auto& [kernel, bits] : bits_)
    row("stability",
        {{"kernel", kernel},
         {"case", "bits of the whole grid"},
         {"device", device()},
         {"promise",
          fmt::format("every result of the frontier's {:.0f} settings that are free of samplers has the bits of "
                      "the C++ execution in float (settings that differ{})",
                      bits.checked, bits.first.empty() ? "" : "; first: " + bits.first)},
         {"bound", 0},
         {"measured", bits.different},
         {"pass", bits.different == 0}});
  for (const auto& [key, share] : shares_)
    row("stability",
        {{"kernel", key.first},
         {"case", key.second},
         {"device", device()},
         {"promise", fmt::format("{} (the largest share of the bound that was used: {})", share.promise, share.worst)},
         {"bound", 1},
         {"measured", share.most},
         {"pass", share.most <= 1}});
}

Session::Timed timed(const std::shared_ptr<cases::Run>& run) {
  return [run]() -> Result<double> {
    Times times;
    if (Status status = run->go(1, &times); !status) return status;
    return times.total;
  };
}

}  // namespace luxel::report

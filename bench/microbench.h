// What the microbenchmarks of all kernels share: a benchmark a device and setting, timed from submission to completion.
#pragma once
#include <memory>

#include <benchmark/benchmark.h>
#include <luxel/device.h>

#include "bench/report/bench.h"
#include "tests/cases/run.h"

namespace luxel::bench {

/// Registers `settings(profile)` of every device but the execution in double, as DEVICE/SETTING (--benchmark_filter
/// picks by regular expression), and runs them. Counters: bytes and flops a second, of the plan's least traffic and
/// arithmetic.
template <class Settings>
int run(int argc, char** argv, const Settings& settings) {
  for (const DeviceInfo& device : devices()) {
    if (device.id == "cpu:double") continue;
    struct Opened {
      std::shared_ptr<Context> context;
    };
    const auto opened = std::make_shared<Opened>();
    for (const report::BenchSetting& setting : settings(profile(device.profile)))
      benchmark::RegisterBenchmark(
          (device.id + "/" + setting.name).c_str(),
          [=](benchmark::State& state) {
            if (!opened->context) {
              const auto context = Context::open(std::to_string(device.index));
              if (!context) return state.SkipWithError(context.status().message().c_str());
              opened->context = context.value();
            }
            auto run = cases::Run::make(*opened->context, setting.plan);
            if (!run) return state.SkipWithError(run.status().message().c_str());
            if (const Status status = report::fill(run.value(), setting); !status)
              return state.SkipWithError(status.message().c_str());
            Times times;
            if (const Status status = run.value().go(1, &times); !status)
              return state.SkipWithError(status.message().c_str());
            for (auto _ : state) {
              if (const Status status = run.value().go(1, &times); !status)
                return state.SkipWithError(status.message().c_str());
              state.SetIterationTime(times.total * 1e-3);
            }
            using benchmark::Counter;
            state.counters["bytes/s"] = Counter(setting.plan.bytes, Counter::kIsIterationInvariantRate);
            state.counters["flops/s"] = Counter(setting.plan.flops, Counter::kIsIterationInvariantRate);
          })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond)
          ->MinWarmUpTime(0.05);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace luxel::bench

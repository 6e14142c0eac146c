// luxel bench: times of the main settings of each kernel, without errors, peers or pages.
#include <algorithm>
#include <charconv>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/program/commands.h"
#include "bench/report/bench.h"
#include "bench/report/profile_file.h"
#include "bench/report/report.h"

namespace luxel::program {
namespace {

int misuse(const std::string& message) { return report::complain(message, 2); }

bool parse_size(const std::string& text, int& width, int& height) {
  const char* end = text.data() + text.size();
  const auto [x, first] = std::from_chars(text.data(), end, width);
  if (first != std::errc() || x == end || *x != 'x') return false;
  const auto [last, second] = std::from_chars(x + 1, end, height);
  return second == std::errc() && last == end && width >= 1 && height >= 1 && width <= 16384 && height <= 16384;
}

struct Arguments {
  std::vector<std::string> kernels, devices, sizes;
};

int run(const Arguments& a) {
  const auto& known = report::measured_kernels();
  for (const std::string& kernel : a.kernels)
    if (std::find(known.begin(), known.end(), kernel) == known.end())
      return misuse(fmt::format("--kernel is {}; expected one of: {}", kernel, fmt::join(known, ", ")));
  std::vector<std::pair<int, int>> sizes;
  for (const std::string& text : a.sizes) {
    int width = 0, height = 0;
    if (!parse_size(text, width, height))
      return misuse(fmt::format("--size is {}; expected WIDTHxHEIGHT, each 1..16384", text));
    sizes.emplace_back(width, height);
  }
  if (sizes.empty()) sizes = {{1920, 1080}};
  const auto chosen = report::choose_devices(devices(), a.devices);
  if (!chosen) return misuse(chosen.status().message());
  int status = 0;
  for (const DeviceInfo& device : chosen.value()) {
    const auto context = report::open_tuned(std::to_string(device.index));
    if (!context) {
      fmt::print(stderr, "luxel: {}\n", context.status().message());
      status = 1;
      continue;
    }
    status = std::max(status, report::bench_device(context.value(), a.kernels, sizes));
  }
  return status;
}

}  // namespace

void add_bench(CLI::App& app, int& exit_status) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("bench", "times of each kernel's main settings: median and quartiles, GB/s, GFLOP/s");
  command->add_option("--kernel", a->kernels, "gaussian_blur, bilateral, mip_build ...; may be given again; default: all")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      ->add_option("--device", a->devices,
                   "opencl, vulkan, cpu, an index of `luxel devices`, or part of a device's name; may be "
                   "given again; default: all")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_option("--size", a->sizes, "size of images, 1x1..16384x16384; may be given again; default 1920x1080")
      ->type_name("WxH")
      ->allow_extra_args(false);
  command->footer(
      "Volumes are 128^3. The microbenchmarks of each kernel (Google Benchmark) are programs of their own in the "
      "build's\n"
      "bin folder: gaussian_blur_bench, bilateral_bench, mip_build_bench.");
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

// luxel tune: the cheapest setting of a kernel within an error, and the profile of a device.
#include <algorithm>
#include <charconv>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/program/commands.h"
#include "bench/report/tune.h"
#include "bench/report/tune_profile.h"

namespace luxel::program {
namespace {

struct Arguments {
  report::TuneRequest request;
  std::string kernel, device, size, profile_file;
  double max_error = -1, max_ms = -1;
  std::vector<std::string> fixed;
  bool profile = false;
};

int misuse(const std::string& message) {
  fmt::print(stderr, "luxel: tune: {}; see `luxel tune --help`\n", message);
  return 2;
}

int run(Arguments a) {
  if (a.profile) {
    if (!a.kernel.empty()) return misuse("--profile is of a device; expected no kernel beside it");
    return report::run_tune_profile(a.device, a.profile_file, a.request.settings.quick);
  }
  const auto& known = report::measured_kernels();
  if (std::find(known.begin(), known.end(), a.kernel) == known.end())
    return misuse(a.kernel.empty() ? fmt::format("a kernel is missing; expected one of: {}", fmt::join(known, ", "))
                                   : fmt::format("kernel is {}; expected one of: {}", a.kernel, fmt::join(known, ", ")));
  if ((a.max_error >= 0) == (a.max_ms >= 0)) return misuse("expected one of --max-error and --max-ms");
  report::TuneRequest& r = a.request;
  if (a.max_error >= 0) r.max_error = a.max_error;
  if (a.max_ms >= 0) r.max_ms = a.max_ms;
  r.settings.kernels = {a.kernel};
  if (!a.device.empty()) r.settings.devices = {a.device};
  if (!a.size.empty()) {
    const char *begin = a.size.data(), *end = begin + a.size.size();
    const auto [x, first] = std::from_chars(begin, end, r.settings.width);
    if (first != std::errc() || x == end || *x != 'x' || r.settings.width < 1 || r.settings.width > 16384 ||
        std::from_chars(x + 1, end, r.settings.height).ptr != end || r.settings.height < 1 || r.settings.height > 16384)
      return misuse(fmt::format("--size is {}; expected WIDTHxHEIGHT, each 1..16384", a.size));
    if (a.kernel != "gaussian_blur" && a.kernel != "bilateral") return misuse("--size is of gaussian_blur and bilateral; expected --fix size=... with another kernel");
  }
  if (r.settings.sigma > 0 && a.kernel != "gaussian_blur") return misuse("--sigma is of gaussian_blur");
  if (r.settings.radius > 0 && a.kernel != "bilateral") return misuse("--radius is of bilateral");
  // What is asked of these two is part of the question, not a knob.
  if (a.kernel == "gaussian_blur" && r.settings.sigma == 0) r.settings.sigma = 4;
  if (a.kernel == "bilateral" && r.settings.radius == 0) r.settings.radius = 4;
  for (const std::string& f : a.fixed) {
    const std::size_t at = f.find('=');
    if (at == std::string::npos || at == 0) return misuse(fmt::format("--fix is {}; expected NAME=VALUE", f));
    r.fixed.emplace_back(f.substr(0, at), f.substr(at + 1));
  }
  return report::run_tune(r);
}

}  // namespace

void add_tune(CLI::App& app, int& exit_status) {
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("tune", "the cheapest setting of a kernel within an error, measured here; or a device's profile");
  command->add_option("kernel", a->kernel, "gaussian_blur, bilateral, mip_build ...")->type_name("KERNEL");
  command->add_option("--max-error", a->max_error, "the cheapest setting whose error, all parts together, is at most this, 0..1e30")
      ->type_name("E")
      ->check(CLI::Range(0.0, 1e30));
  command->add_option("--max-ms", a->max_ms, "the most exact setting whose median time is at most this, 0..1e9")->type_name("T")->check(CLI::Range(0.0, 1e9));
  command->add_option("--sigma", a->request.settings.sigma, "of gaussian_blur: what is blurred by, pixels, 0.1..1000; default 4")
      ->type_name("S")
      ->check(CLI::Range(0.1, 1000.0));
  command->add_option("--radius", a->request.settings.radius, "of bilateral: the window that is wanted, pixels, 1..24; default 4")
      ->type_name("R")
      ->check(CLI::Range(1, 24));
  command->add_option("--scene", a->request.scene, "part of a scene's name, as the report has them (cornell, atrium, ...); default: the kernel's first")->type_name("NAME");
  command->add_option("--size", a->size, "of gaussian_blur and bilateral: size of a generated image")->type_name("WxH");
  command->add_option("--metric", a->request.metric, "part of a metric's name; default: the kernel's first")->type_name("NAME");
  command->add_option("--fix", a->fixed, "an option or knob that is given: format=f16x4, bands=2, variant=hiz, size=64x64x64; may be given again")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command->add_option("--device", a->device,
                      "opencl, vulkan, cpu, an index of `luxel devices`, or part of a device's name; default: the first of opencl, "
                      "vulkan and cpu that works")
      ->type_name("NAME");
  command->add_flag("--quick", a->request.settings.quick, "the settings of a quick report");
  command->add_option("--json", a->request.json, "file for what is printed, as JSON")->type_name("FILE");
  command->add_flag("--profile", a->profile, "find lanes, blocks, unrolling and workgroups of the device, and keep them for luxel's tools");
  command->add_option("--profile-file", a->profile_file, "with --profile: another file than the device's own")->type_name("FILE");
  command->footer(
      "Prints the setting as a command, as C++ that compiles, and what of the error or time it uses. Errors of all\n"
      "settings come from the C++ executions first: those too large are not timed. The answer is of this device, scene\n"
      "and size; times are medians with quartiles. Profiles: in LUXEL_PROFILES, else in ~/.config/luxel/profiles.\n"
      "Exit status: 0; 1 when no setting fits (the nearest is named) or measuring failed; 2 for wrong use.");
  command->callback([a, &exit_status] { exit_status = run(*a); });
}

}  // namespace luxel::program

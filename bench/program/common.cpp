#include "common.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include <fmt/format.h>
#include <luxel/reference.h>

#include "bench/io/pixels.h"
#include "bench/report/profile_file.h"

namespace luxel::program {
namespace {

template <class Entry>
const Entry& entry(const std::vector<Entry>& entries, std::string_view name) {
  return *std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; });
}

CLI::Validator among(std::vector<std::string_view> choices) {
  return CLI::Validator([choices = std::move(choices)](std::string& text) {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return std::string();
    return fmt::format("{} is not known; expected {}", text, fmt::join(choices, ", "));
  }, "");
}

std::string help_of(const Option& option) {
  return fmt::format("{}; default {}; {}", range_text(option), option.fallback, option.meaning);
}

template <class T>
CLI::Option* add_number_of(CLI::App& command, const Kernel& kernel, std::string_view name, T& value) {
  const Knob& knob = entry(kernel.knobs, name);
  const CLI::Validator inside([&knob](std::string& text) {
    char* end = nullptr;
    const double v = std::strtod(text.c_str(), &end);
    const bool number = end != text.c_str() && *end == '\0';
    if (number && v >= knob.least && v <= knob.most && (!knob.integer || v == static_cast<double>(static_cast<int>(v))))
      return std::string();
    return fmt::format("{} is {}; expected {}{}", text, number ? "out of range" : "not a number",
                       knob.integer ? "a whole number " : "", range_text(knob));
  }, "");
  const std::string fallback = knob.fallback.empty() ? "" : fmt::format("; default {}", knob.fallback);
  const std::string unit = knob.unit.empty() ? "" : fmt::format(" {}", knob.unit);
  CLI::Option* option = command.add_option(std::string(name), value,
                                           fmt::format("{}: {}{}{}", knob.meaning, range_text(knob), unit, fallback));
  option->type_name(knob.integer ? "INT" : "NUMBER")->check(inside);
  return knob.fallback.empty() ? option->required() : option;
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool space = static_cast<unsigned char>(c) <= 32 || c == 127;
    if (!space) line += c;
    else if (!line.empty() && line.back() != ' ') line += ' ';
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

int complain(std::string_view message, int exit_status) {
  std::fprintf(stderr, "luxel: %s\n", one_line(message).c_str());
  return exit_status;
}

int complain(const Status& status, bool input) {
  const Code code = status.code();
  const bool misuse = code == Code::invalid_argument || code == Code::missing_driver || (input && code == Code::io);
  return complain(status.message(), misuse ? misused : failed);
}

std::string closest(std::string_view word, const std::vector<std::string>& candidates) {
  const auto edits = [&](std::string_view other) {
    std::vector<std::size_t> row(other.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= word.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= other.size(); ++j) {
        const std::size_t above = row[j];
        row[j] = std::min({row[j - 1] + 1, above + 1, diagonal + (word[i - 1] == other[j - 1] ? 0 : 1)});
        diagonal = above;
      }
    }
    return row.back();
  };
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2);
  for (const std::string& candidate : candidates)
    if (const std::size_t n = edits(candidate); n <= least && (best.empty() || n < least)) {
      best = candidate;
      least = n;
    }
  return best;
}

void add_image_in(CLI::App& command, std::string& path, std::string_view text) {
  command.add_option("--in", path, fmt::format("{}: .exr, .hdr, .png or .npy ([y][x] or [y][x][c], 1..4 channels)", text))
      ->required()
      ->type_name("FILE");
}

void add_image_out(CLI::App& command, std::string& path, std::string_view text) {
  command.add_option("-o,--out", path, fmt::format("{}: .exr (float32), .hdr, .png (8 bits) or .npy (float32)", text))
      ->required()
      ->type_name("FILE");
}

void add_device_option(CLI::App& command, std::string& device) {
  command
      .add_option(
          "--device", device,
          "opencl, vulkan, cpu, cpu:double, an index of `luxel devices`, or part of a device's name; default: the "
          "first of opencl, vulkan and cpu that works")
      ->type_name("NAME");
}

Result<std::shared_ptr<Context>> open_device(const std::string& device) { return report::open_tuned(device); }

Status run_plan(Context& context, const Plan& plan, ResourceData& data, Times& times) {
  const auto program = context.compile(plan);
  if (!program) return program.status();
  const auto precision = context.real64() ? reference::Precision::real64 : reference::Precision::real32;
  std::vector<Named> bound;
  for (const Resource& resource : plan.resources) {
    const std::size_t size = std::max(data[resource.name].size(), reference::resource_bytes(resource, precision));
    auto memory = context.make(resource, resource.kind == ResourceKind::buffer ? size : 0);
    if (!memory) return memory.status();
    bound.push_back({resource.name, std::move(memory).value()});
  }
  // Drivers compile at the first dispatch: what is timed is the second.
  for (int runs = context.info().api == Api::cpu ? 1 : 2; runs > 0; --runs) {
    for (const Named& b : bound)
      if (const auto& bytes = data[std::string(b.name)]; !bytes.empty())
        if (Status s = context.upload(*b.memory, bytes.data(), bytes.size()); !s) return s;
    times = {};
    if (Status s = context.run(*program.value(), bound, &times); !s) return s;
  }
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const Resource& resource = plan.resources[i];
    if (!resource.written) continue;
    std::vector<std::uint8_t>& bytes = data[resource.name];
    bytes.resize(std::max(bytes.size(), reference::resource_bytes(resource, precision)));
    if (Status s = context.download(*bound[i].memory, bytes.data(), bytes.size()); !s) return s;
  }
  return {};
}

std::string range_text(const Knob& knob) { return fmt::format("{}..{}", knob.least, knob.most); }

std::string range_text(const Option& option) {
  return option.choices.empty() ? "off|on" : fmt::format("{}", fmt::join(option.choices, "|"));
}

CLI::Option* add_variant(CLI::App& command, const Kernel& kernel, std::string& value) {
  std::vector<std::string_view> names;
  for (const Variant& v : kernel.variants) names.push_back(v.name);
  value = names.front();
  const std::string help = fmt::format("{}; default {}; `luxel list` describes them", fmt::join(names, "|"), value);
  return command.add_option("--variant", value, help)->type_name("NAME")->check(among(names));
}

CLI::Option* add_choice(CLI::App& command, const Kernel& kernel, std::string_view name, std::string& value) {
  const Option& o = entry(kernel.options, name);
  value = o.fallback;
  return command.add_option(std::string(name), value, help_of(o))->type_name("NAME")->check(among(o.choices));
}

CLI::Option* add_choices(CLI::App& command, const Kernel& kernel, std::string_view name,
                         std::vector<std::string>& values) {
  const Option& o = entry(kernel.options, name);
  return command.add_option(std::string(name), values, help_of(o))
      ->type_name("NAMES")
      ->delimiter(',')
      ->check(among(o.choices));
}

CLI::Option* add_switch(CLI::App& command, const Kernel& kernel, std::string_view name, bool& value) {
  return command.add_flag(std::string(name), value,
                          fmt::format("{}; default off", entry(kernel.options, name).meaning));
}

CLI::Option* add_number(CLI::App& command, const Kernel& kernel, std::string_view name, double& value) {
  return add_number_of(command, kernel, name, value);
}

CLI::Option* add_number(CLI::App& command, const Kernel& kernel, std::string_view name, int& value) {
  return add_number_of(command, kernel, name, value);
}

Format storage_format(const std::string& format, int channels) {
  return io::format_for(format == "f16"      ? Format::f16x4
                        : format == "unorm8" ? Format::unorm8x4
                                             : Format::f32x1,
                        channels);
}

std::string time_text(const Times& times) {
  const double passes = std::accumulate(times.passes.begin(), times.passes.end(), 0.0);
  const double ms = passes > 0 ? passes : times.total;
  return fmt::format("{:.{}f} ms{}", ms, ms < 10 ? 3 : ms < 100 ? 1 : 0, passes > 0 ? " on the device's clock" : "");
}

std::string changes_text(const io::WriteReport& report) {
  std::string text;
  if (report.out_of_range > 0) text += fmt::format("; {} values clamped to the file's range", report.out_of_range);
  if (report.not_finite > 0) text += fmt::format("; {} values were not finite", report.not_finite);
  return text;
}

}  // namespace luxel::program

// What the commands share: errors, devices, and options that take their ranges and defaults from the catalog.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <luxel/device.h>

#include "bench/io/image.h"
#include "catalog.h"

namespace luxel::program {

constexpr int done = 0;
constexpr int failed = 1;
constexpr int misused = 2;

/// `text` as one line: line breaks and other control characters become single spaces.
std::string one_line(std::string_view text);

/// Prints "luxel: message" as one line on stderr and returns `exit_status`.
int complain(std::string_view message, int exit_status);

/// The same for a Status: misused for invalid_argument, missing_driver and, where `input`, io; else failed.
int complain(const Status& status, bool input = false);

/// The candidate with the fewest edits from `word`; empty where none is near.
std::string closest(std::string_view word, const std::vector<std::string>& candidates);

/// `--in` and `-o`, both required: an image read and one written. The texts begin their help.
void add_image_in(CLI::App& command, std::string& path, std::string_view text);
void add_image_out(CLI::App& command, std::string& path, std::string_view text);

/// `--device`. Empty: the first of opencl, vulkan and cpu that works.
void add_device_option(CLI::App& command, std::string& device);
Result<std::shared_ptr<Context>> open_device(const std::string& device);

/// Bytes by name of a plan's resources, laid out as io::pack does.
using ResourceData = std::map<std::string, std::vector<std::uint8_t>, std::less<>>;

/// Compiles and runs a plan. What `data` holds is uploaded; what the plan writes is downloaded into it. Except in C++
/// it runs twice, the second time for `times`.
Status run_plan(Context& context, const Plan& plan, ResourceData& data, Times& times);

/// Options of a kernel's catalog entry, with help, range and default. The names must be in the entry.
CLI::Option* add_variant(CLI::App& command, const Kernel& kernel, std::string& value);
CLI::Option* add_choice(CLI::App& command, const Kernel& kernel, std::string_view name, std::string& value);
CLI::Option* add_choices(CLI::App& command, const Kernel& kernel, std::string_view name,
                         std::vector<std::string>& values);
CLI::Option* add_switch(CLI::App& command, const Kernel& kernel, std::string_view name, bool& value);
CLI::Option* add_number(CLI::App& command, const Kernel& kernel, std::string_view name, double& value);
CLI::Option* add_number(CLI::App& command, const Kernel& kernel, std::string_view name, int& value);

/// "0..4095", "clamp|mirror|wrap|zero" or "off|on".
std::string range_text(const Knob& knob);
std::string range_text(const Option& option);

/// Storage format of `--format` for a number of channels in a file.
Format storage_format(const std::string& format, int channels);

/// The time of a run for a results line: by the device's clock where it has one, else as the host saw it.
std::string time_text(const Times& times);

/// What writing a file changed, for a results line; empty where nothing was.
std::string changes_text(const io::WriteReport& report);

}  // namespace luxel::program

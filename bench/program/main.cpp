// The program `luxel`: subcommands, and one line on stderr for whatever is wrong with the command line.
#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>

#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

constexpr const char* no_stdout = "cannot write to stdout; check where it goes";

// The subcommand that was named, or the program itself.
const CLI::App& named_command(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : named_command(*commands.front());
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// "probes build"; empty: the program itself.
std::string name_of(const CLI::App& command) {
  if (command.get_parent() == nullptr) return "";
  const std::string parent = name_of(*command.get_parent());
  return parent.empty() ? command.get_name() : parent + " " + command.get_name();
}

std::string help_of(const CLI::App& command) {
  return command.get_parent() == nullptr ? "luxel --help" : fmt::format("luxel {} --help", name_of(command));
}

// A word that no command or option claimed.
std::string unknown_word(const CLI::App& app, const std::string& word) {
  const CLI::App& command = named_command(app);
  const bool option = word.starts_with("-");
  std::vector<std::string> candidates = option_names(command);
  if (!option) {
    candidates.clear();
    for (const CLI::App* c : app.get_subcommands({})) candidates.push_back(c->get_name());
  }
  if (!option && &command != &app)
    return fmt::format("{}: unexpected argument {}; see `{}`", name_of(command), word, help_of(command));
  const std::string prefix = &command == &app ? "" : name_of(command) + ": ";
  const std::string near = closest(word.substr(0, word.find('=')), candidates);
  return fmt::format("{}unknown {} {}; {}see `{}`", prefix, option ? "option" : "command", word,
                     near.empty() ? "" : fmt::format("did you mean {}? ", near), help_of(command));
}

int parse_failure(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> left = app.remaining(true);
  const CLI::App& command = named_command(app);
  if (!left.empty() && left.front() != "--") return complain(unknown_word(app, left.front()), misused);
  if (&command == &app && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    return complain("no command given; see `luxel --help`", misused);
  const std::string prefix = &command == &app ? "" : name_of(command) + ": ";
  return complain(fmt::format("{}{}; see `{}`", prefix, error.what(), help_of(command)), misused);
}

int run(int argc, char** argv) {
  CLI::App app{"luxel: GPU compute kernels for real-time global illumination, with their error and their run time",
               "luxel"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "luxel " LUXEL_VERSION, "Print the version and exit");
  app.footer(
      "Exit status: 0 done, 1 the run failed or a promise is broken, 2 wrong use. Errors are one line on stderr.\n"
      "`luxel COMMAND --help` shows a command's options with their ranges and defaults.");
  int exit_status = done;
  add_devices(app, exit_status);
  add_list(app, exit_status);
  add_emit(app, exit_status);
  add_gaussian_blur(app, exit_status);
  add_bilateral(app, exit_status);
  add_denoise(app, exit_status);
  add_mip_build(app, exit_status);
  add_voxelize(app, exit_status);
  add_hiz_ssr(app, exit_status);
  add_cone_trace(app, exit_status);
  add_probes(app, exit_status);
  add_render(app, exit_status);
  add_plan(app, exit_status);
  add_bench(app, exit_status);
  add_report(app, exit_status);
  add_stability(app, exit_status);
  add_tune(app, exit_status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    return parse_failure(app, error);
  } catch (const std::bad_alloc&) {
    return complain("out of memory; use a smaller input", failed);
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return complain(no_stdout, failed);
    return complain(fmt::format("{}; this is a defect of luxel: please report it", error.what()), failed);
  }
  if (std::fflush(stdout) != 0) return complain(no_stdout, failed);
  return exit_status;
}

}  // namespace
}  // namespace luxel::program

int main(int argc, char** argv) { return luxel::program::run(argc, argv); }

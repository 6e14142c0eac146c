#include <cstdio>

#include <fmt/format.h>

#include "commands.h"
#include "common.h"

namespace luxel::program {
namespace {

void print(const Kernel& kernel) {
  fmt::print("{}: {}\n  variants\n", kernel.name, kernel.meaning);
  for (const Variant& v : kernel.variants)
    fmt::print("    {:<14} {}{}\n", v.name, v.meaning, &v == &kernel.variants.front() ? " (default)" : "");
  fmt::print("  options\n");
  for (const Option& o : kernel.options) {
    fmt::print("    {:<14} {}, default {}\n", o.name, range_text(o), o.fallback);
    fmt::print("    {:<14} {}\n", "", o.meaning);
  }
  fmt::print("  knobs\n");
  for (const Knob& k : kernel.knobs)
    fmt::print("    {:<14} {}{}{}, {}: {}\n", k.name, range_text(k), k.integer ? ", whole" : "",
               k.unit.empty() ? "" : fmt::format(" {}", k.unit),
               k.fallback.empty() ? "required" : fmt::format("default {}", k.fallback), k.meaning);
}

}  // namespace

void add_list(CLI::App& app, int& exit_status) {
  CLI::App* command =
      app.add_subcommand("list", "list the kernels: variants, options, knobs with their ranges and defaults");
  auto only = std::make_shared<std::string>();
  command->add_option("kernel", *only, "only this kernel")->type_name("NAME");
  command->callback([only, &exit_status] {
    std::vector<std::string> names;
    bool printed = false;
    for (const Kernel& k : catalog()) {
      names.emplace_back(k.name);
      if (!only->empty() && *only != k.name) continue;
      if (printed) fmt::print("\n");
      print(k);
      printed = true;
    }
    exit_status =
        printed ? done
                : complain(fmt::format("list: no kernel {}; expected {}", *only, fmt::join(names, ", ")), misused);
  });
}

}  // namespace luxel::program

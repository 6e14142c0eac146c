// luxel stability: what is promised for extreme inputs, with the number measured beside each bound.
#include <CLI/CLI.hpp>

#include "bench/program/commands.h"
#include "bench/report/report.h"

namespace luxel::program {

void add_stability(CLI::App& app, int& exit_status) {
  const auto a = std::make_shared<report::Settings>();
  a->stability = true;
  a->out = "luxel-stability";
  CLI::App* command = app.add_subcommand("stability", "each kernel's promises for extreme inputs: bound, worst number measured, where");
  command->add_option("kernels", a->kernels, "gaussian_blur, bilateral, mip_build ...; default: all")->type_name("KERNEL");
  command
      ->add_option("--device", a->devices,
                   "opencl, vulkan, cpu, an index of `luxel devices`, or part of a device's name; "
                   "may be given again; default: all")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_flag("--quick", a->quick, "fewer cases on drivers and fewer sizes: within a minute a device on two cores");
  command->add_option("--only", a->only, "only cases with this text in \"KERNEL case NAME\"; may be given again")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command->add_option("-o,--out", a->out, "folder for report.json and a page per kernel (KERNEL.md); default luxel-stability")->type_name("DIR");
  command->add_flag("--fresh", a->fresh, "measure everything anew, also what an earlier run finished in DIR");
  command->footer(
      "Beside the cases: gain of what is iterated or fed back, by power iteration; growth of rounding with size, steps and\n"
      "scale, as a power; f16 and unorm8 beside f32, in steps of the format; and by bisection how far behind each\n"
      "documented limit things go wrong.\n"
      "Exit status: 0; 1 when a promise is broken or a device died; 2 for wrong use; 130 when interrupted (run it again).");
  command->callback([a, &exit_status] { exit_status = report::run_report(*a); });
}

}  // namespace luxel::program

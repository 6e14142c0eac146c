// luxel report
#include <CLI/CLI.hpp>

#include "bench/program/commands.h"
#include "bench/report/listing.h"
#include "bench/report/measure.h"
#include "bench/report/report.h"

namespace luxel::program {

void add_report(CLI::App& app, int& exit_status) {
  struct Arguments {
    report::Settings settings;
    std::string measure, list;
    double best_guard = 0;
    bool first = false;
  };
  const auto a = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "report", "measure error against run time, stability and peers; write tables, JSON and a page");
  command->add_flag("--quick", a->settings.quick, "fewer settings: three minutes on two fast quiet cores, eight on busy ones");
  command
      ->add_option("--device", a->settings.devices,
                   "opencl, vulkan, cpu, an index of `luxel devices`, or part of a device's name; "
                   "may be given again; default: all")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_option("--kernel", a->settings.kernels, "gaussian_blur, bilateral, mip_build ...; may be given again; default: all")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command
      ->add_option("--image", a->settings.images,
                   "EXR, HDR, PNG or NPY file to measure on (its middle 512x512, with --quick 256x256); may be "
                   "given again; default: the photographs and skies of the data folder (LUXEL_DATA)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  command
      ->add_option("--only", a->settings.only,
                   "measure only what has this text in its label, as the progress shows it; may be given again")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command
      ->add_option("-o,--out", a->settings.out, "folder for report.json, index.html and pictures; default luxel-report")
      ->type_name("DIR");
  command->add_flag("--fresh", a->settings.fresh, "measure everything anew, also what an earlier run finished in DIR");
  command->add_flag("!--no-page", a->settings.page, "report.json and tables alone, without plots and page");
  // What the report starts its own children with.
  command->add_option("--list", a->list)->group("");
  command->add_option("--measure", a->measure)->group("");
  command->add_option("--guard-best", a->best_guard)->group("");
  command->add_flag("--first", a->first)->group("");
  command->add_flag("--oracle", a->settings.oracle)->group("");
  command->add_flag("--stability", a->settings.stability)->group("");
  command->footer(
      "Exit status: 0; 1 when a promise is broken or a device died; 2 for wrong use; 130 when interrupted.\n"
      "A report goes on where an earlier one in DIR ended: what was finished is kept, unless the text of its kernels, the\n"
      "device's driver or what is asked for is another. After changes elsewhere (host code, the report itself): --fresh.\n"
      "Of the extreme cases a report shows the quick ones, on each driver those that go furthest; `luxel stability` has all.\n"
      "Errors are the same to the last digit in every run (but of voxelize's moving_average and last_write, which depend on\n"
      "timing); times are medians with quartiles, taken again while the machine is busy. Photographs of the data folder that\n"
      "are absent are named and left out.");
  command->callback([a, &exit_status] {
    if (!a->list.empty())
      exit_status = report::write_listing(a->list);
    else if (!a->measure.empty())
      exit_status = report::measure_device(a->settings, a->measure, a->best_guard, a->first);
    else
      exit_status = report::run_report(a->settings);
  });
}

}  // namespace luxel::program

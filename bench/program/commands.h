// The commands of the program `luxel`. Each adds its subcommand to `app`; running it sets `exit_status`: 0 done,
// 1 the run failed or a promise is broken, 2 wrong use (bad values and unreadable input included).
#pragma once
#include <CLI/CLI.hpp>

namespace luxel::program {

void add_devices(CLI::App& app, int& exit_status);
void add_list(CLI::App& app, int& exit_status);
void add_emit(CLI::App& app, int& exit_status);
void add_gaussian_blur(CLI::App& app, int& exit_status);
void add_bilateral(CLI::App& app, int& exit_status);
void add_denoise(CLI::App& app, int& exit_status);
void add_mip_build(CLI::App& app, int& exit_status);
void add_hiz_ssr(CLI::App& app, int& exit_status);
void add_cone_trace(CLI::App& app, int& exit_status);
void add_voxelize(CLI::App& app, int& exit_status);
void add_probes(CLI::App& app, int& exit_status);
void add_render(CLI::App& app, int& exit_status);
void add_plan(CLI::App& app, int& exit_status);
void add_bench(CLI::App& app, int& exit_status);
void add_report(CLI::App& app, int& exit_status);
void add_stability(CLI::App& app, int& exit_status);
void add_tune(CLI::App& app, int& exit_status);

}  // namespace luxel::program

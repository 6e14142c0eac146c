// Microbenchmarks of probe_irradiance and probe_shade (Google Benchmark): the main settings on every device.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::probe_shade_settings); }

// Microbenchmarks of lpv_inject, lpv_inject_geometry and lpv_sample (Google Benchmark): the main settings on every device.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::lpv_inject_settings); }

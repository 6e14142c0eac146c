// Microbenchmarks of voxelize (Google Benchmark): the main settings on every device.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::voxelize_settings); }

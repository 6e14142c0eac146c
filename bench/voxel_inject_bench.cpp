// Microbenchmarks of voxel_inject (Google Benchmark): the main settings on every device.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::voxel_inject_settings); }

// Microbenchmarks of mip_build (Google Benchmark): the main settings on every device, 128^3 and 1920x1080.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::mip_build_settings); }

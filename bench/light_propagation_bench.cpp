// Microbenchmarks of lpv_propagate (Google Benchmark): 8 steps in 32^3 and 64^3 on every device.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::light_propagation_settings); }

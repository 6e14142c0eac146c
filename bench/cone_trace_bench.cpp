// Microbenchmarks of cone_trace (Google Benchmark): the main settings on every device, 256 x 64 receivers in 64^3.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::cone_trace_settings); }

// Microbenchmarks of octahedral_march (Google Benchmark): rays through 32 probes in the generated atrium, and building maps.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::octahedral_march_settings); }

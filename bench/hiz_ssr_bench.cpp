// Microbenchmarks of hiz_ssr (Google Benchmark): each walk over the height field of the report, 1280x720.
#include "bench/microbench.h"

int main(int argc, char** argv) { return luxel::bench::run(argc, argv, luxel::report::hiz_ssr_settings); }

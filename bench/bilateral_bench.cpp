// Microbenchmarks of bilateral (Google Benchmark): the main settings on every device, at 1920x1080.
#include "bench/microbench.h"

int main(int argc, char** argv) {
  return luxel::bench::run(
      argc, argv, [](const luxel::Profile& profile) { return luxel::report::bilateral_settings(1920, 1080, profile); });
}

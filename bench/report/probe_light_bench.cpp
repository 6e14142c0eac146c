// Settings of probe_irradiance and probe_shade for `luxel bench` and the microbenchmark: probes of noise, receivers at random.
#include <fmt/format.h>

#include "bench/report/bench.h"
#include "tests/cases/probe_support.h"

namespace luxel::report {

std::vector<BenchSetting> probe_shade_settings(const Profile& profile) {
  std::vector<BenchSetting> settings;
  for (const bool half : {true, false}) {
    cases::ProbeSetUp s = cases::probe_set_up({8, 4, 8}, half);
    s.filter.maps.size = 32;
    s.filter.moments_size = s.shade.moments_size = 16;
    const char* format = half ? "f16" : "f32";
    if (const Result<Plan> made = plan(s.filter, profile))
      settings.push_back({fmt::format("irradiance of 256 probes of 32x32, {}", format), made.value(), {"radiance", "distance"}});
    s.shade.width = 256;
    s.shade.height = 128;
    const auto receivers = std::make_shared<const std::vector<double>>(cases::random_receivers(s.shade.grid, 256 * 128, 3));
    for (const bool visibility : {true, false}) {
      s.shade.visibility = visibility;
      if (const Result<Plan> made = plan(s.shade, profile))
        settings.push_back({fmt::format("{} {} of 32768 receivers", visibility ? "filtered" : "plain", format), made.value(), visibility
                                ? std::vector<std::string>{"light", "moments"} : std::vector<std::string>{"light"}, {{"receivers", receivers}}});
    }
  }
  return settings;
}

}  // namespace luxel::report

// Settings of cone_trace for `luxel bench` and the microbenchmark: receivers and voxels at random, which is the worst
// case for a driver that runs neighbours side by side.
#include <fmt/format.h>

#include "bench/report/bench.h"
#include "tests/cases/cone_trace_support.h"

namespace luxel::report {

std::vector<BenchSetting> cone_trace_settings(const Profile& profile) {
  std::vector<BenchSetting> settings;
  for (const ConeVariant variant : {ConeVariant::isotropic, ConeVariant::anisotropic})
    for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4})
      for (const Input input : {Input::buffer, Input::image}) {
        ConeTraceParams p = cases::cone_params(64, variant, format);
        p.width = 256;
        p.height = 64;
        p.input = input;
        const Result<Plan> made = plan(p, profile);
        if (made)
          settings.push_back({fmt::format("{} {} {} 6 cones",
                                          variant == ConeVariant::isotropic ? "isotropic" : "anisotropic", name(format),
                                          input == Input::image ? "image" : "buffer"),
                              made.value(),
                              {"fine", "coarse", "receivers"}});
      }
  return settings;
}

}  // namespace luxel::report

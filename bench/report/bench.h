// Times of the main settings of each kernel on one device.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <luxel/device.h>

#include "tests/cases/run.h"

namespace luxel::report {

/// A plan with a name, as `luxel bench` and the microbenchmarks run it. Resources are left as they are made, but for
/// what `fill` names: times of these kernels do not depend on the values, denormals and NaN apart.
struct BenchSetting {
  std::string name;
  Plan plan;
  std::vector<std::string> fill;  // resources that are filled with noise
  std::vector<std::pair<std::string, std::shared_ptr<const std::vector<double>>>> data = {};  // resources that hold these
};

/// Fills the resources that `setting.fill` and `setting.data` name.
Status fill(cases::Run& run, const BenchSetting& setting);

/// Main settings of gaussian_blur at a size: formats, inputs and variants at sigma 4, 25 taps.
std::vector<BenchSetting> gaussian_blur_settings(int width, int height, const Profile& profile);

/// Main settings of bilateral at a size: variants and terms.
std::vector<BenchSetting> bilateral_settings(int width, int height, const Profile& profile);

/// Main settings of mip_build: volumes of 128^3, and depth pyramids of 1920x1080.
std::vector<BenchSetting> mip_build_settings(const Profile& profile);

/// Main settings of voxelize: the bunny of LUXEL_DATA (without it a ball of as many triangles) at 64^3 to 256^3.
std::vector<BenchSetting> voxelize_settings(const Profile& profile);

/// Main settings of voxel_inject: a floor and a wall in 128^3, by shadow rays and from a map.
std::vector<BenchSetting> voxel_inject_settings(const Profile& profile);

/// Main settings of cone_trace: 256 x 64 receivers in 64^3, random voxels.
std::vector<BenchSetting> cone_trace_settings(const Profile& profile);

/// Main settings of hiz_ssr: 640 x 360 mirror rays in the generated atrium.
std::vector<BenchSetting> hiz_ssr_settings(const Profile& profile);

/// Main settings of lpv_inject, lpv_inject_geometry and lpv_sample: 2^18 lights, surfels and receivers in 32^3 and 64^3.
std::vector<BenchSetting> lpv_inject_settings(const Profile& profile);

/// Main settings of lpv_propagate: 8 steps in 32^3 and 64^3.
std::vector<BenchSetting> light_propagation_settings(const Profile& profile);

/// Prints a table on stdout. Returns the exit status: 0, or 1 where a setting failed.
int bench_device(const std::shared_ptr<Context>& context, const std::vector<std::string>& kernels,
                 const std::vector<std::pair<int, int>>& sizes);

}  // namespace luxel::report

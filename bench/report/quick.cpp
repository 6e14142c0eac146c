#include "bench/report/quick.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace luxel::report {
namespace {

// How labels begin.
constexpr std::string_view of_whole_reports[] = {
    "gaussian_blur box f32x1",
    "gaussian_blur box f32x4 sigma 16",
    "gaussian_blur left out: taps below",
    "gaussian_blur peer OpenCV CPU f32x1",
    "gaussian_blur peer OpenCV OpenCL",
    "gaussian_blur pyramid f32x4 sigma 16",
    "gaussian_blur pyramid f32x4 sigma 4 1 levels cubic",
    "gaussian_blur pyramid peer",
    "gaussian_blur recursive f32x1",
    "gaussian_blur recursive f32x4 sigma 4",
    "gaussian_blur recursive peer",
    "gaussian_blur reproduction: two texels",
    "gaussian_blur sampler f32x4 sigma 1",
    "gaussian_blur separable f32x4 sigma 1 ",
    "gaussian_blur separable f32x4 sigma 4 k 3 difference",
    "gaussian_blur separable f32x4 sigma 4 k 3 image on landscape",
    "bilateral beside direct R 4: adaptive",
    "bilateral beside direct R 4: atrous",
    "bilateral beside direct R 4: step 2",
    "bilateral denoise direct",
    "bilateral denoise separable R 6 adaptive",
    "bilateral left out flat",
    "bilateral left out sky",
    "bilateral peer OpenCV joint",
    "bilateral reproduction",
    "mip_build anisotropic f16x4",
    "mip_build anisotropic unorm8x4",
    "mip_build gaussian3 f32x4 vertices",
    "mip_build gaussian3 unorm8x4",
    "mip_build isotropic f16x4",
    "mip_build isotropic f32x1",
    "mip_build max",
    "mip_build minmax f16x2",
    "mip_build moments f16x2",
    "voxel_inject reproduction",
    "voxelize conservative exact f16x4",
    "voxelize conservative exact f32x4 normals",
    "voxelize conservative exact unorm8x4",
    "voxelize conservative last_write",
    "voxelize conservative moving_average",
    "update: ",
    "cone_trace anisotropic 6 cones 64^3",
    "cone_trace anisotropic f16x4",
    "cone_trace anisotropic f32x4, 1 ",
    "cone_trace anisotropic f32x4, 16",
    "cone_trace anisotropic f32x4, classic",
    "cone_trace anisotropic unorm8x4",
    "cone_trace isotropic 16",
    "cone_trace isotropic 6 cones 64^3 step 0.5 in Sponza",
    "cone_trace isotropic f16x4",
    "cone_trace left out: counters",
    "cone_trace left out: the finer",
    "cone_trace peer: sampling, anisotropic",
    "cone_trace peer: sampling, isotropic, image",
    "hiz_ssr dda reach 2 ",
    "hiz_ssr hiz reach 2 ",
    "hiz_ssr linear reach 2 ",
    "hiz_ssr stochastic 1 rays",
    "hiz_ssr thin",
    "octahedral_march left out",
    "probe_irradiance left out",
    "probe_irradiance reproduction",
    "probe_shade filtered 8 probes",
    "probe_shade leaks of 8 probes, plain",
    "probe_shade left out: counters",
    "probe_shade left out: facing",
    "probe_shade left out: positions",
    "probe_shade peer: reads of 1",
    "probe_shade reproduction",
    "light_propagation left out: channels",
    "light_propagation left out: the geometry",
    "light_propagation rescale",
};

}  // namespace

void keep_quick(std::vector<Job>& jobs) {
  std::erase_if(jobs, [](const Job& job) {
    return std::any_of(std::begin(of_whole_reports), std::end(of_whole_reports),
                       [&](std::string_view beginning) { return job.label.starts_with(beginning); });
  });
}

}  // namespace luxel::report

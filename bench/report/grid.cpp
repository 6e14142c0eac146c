#include "bench/report/grid.h"

#include "bench/report/cones.h"
#include "bench/report/filters.h"
#include "bench/report/gaussian.h"
#include "bench/report/lpv_scenes.h"
#include "bench/report/mips.h"
#include "bench/report/probe_light.h"
#include "bench/report/probes.h"
#include "bench/report/propagation.h"
#include "bench/report/rendered.h"
#include "bench/report/screens.h"
#include "bench/report/voxels.h"

namespace luxel::report {

std::vector<Job> grid_jobs(Session& session, const std::string& kernel, bool scenes, std::vector<std::string>& missing) {
  const Settings& settings = session.settings();
  std::vector<Job> jobs;
  const auto add = [&](std::vector<Job> more) {
    for (Job& job : more)
      if (job.label.find("limit ") != 0 && job.label.find(" left out") == std::string::npos && job.label.find("peer ") == std::string::npos)
        jobs.push_back(std::move(job));
  };
  std::vector<std::shared_ptr<const Scene>> files;
  if (kernel == "gaussian_blur" || kernel == "mip_build")
    for (const Scene& scene : image_files(settings, missing))
      files.push_back(std::make_shared<Scene>(middle_of(scene, settings.quick ? 256 : 512)));
  if (kernel == "gaussian_blur") add(gaussian_grid(session, files));
  if (kernel == "bilateral") {
    add(filter_grid(session));
    if (scenes) add(denoise_grid(session, missing));
  }
  if (kernel == "mip_build") add(mip_grid(session, mip_scenes(settings, files, missing)));
  if (kernel == "voxelize") add(voxel_jobs(session));
  if (kernel == "cone_trace") {
    add(cone_grid(session));
    if (scenes) add(rendered_grid(session, missing));
  }
  if (kernel == "hiz_ssr") {
    add(screen_grid(session));
    if (scenes) add(screen_truth_grid(session, missing));
  }
  if (kernel == "octahedral_march") {
    add(probe_grid(session));
    if (scenes) add(probe_light_grid(session, missing));
  }
  if (kernel == "light_propagation") {
    add(propagation_grid(session));
    if (scenes) add(lpv_scene_grid(session, missing));
  }
  return jobs;
}

}  // namespace luxel::report

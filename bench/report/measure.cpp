#include "bench/report/measure.h"

#include <algorithm>
#include <csignal>

#include "bench/report/child.h"
#include "bench/report/cones.h"
#include "bench/report/filters.h"
#include "bench/report/gaussian.h"
#include "bench/report/instruments.h"
#include "bench/report/limits.h"
#include "bench/report/lpv_scenes.h"
#include "bench/report/mips.h"
#include "bench/report/octree.h"
#include "bench/report/propagation.h"
#include "bench/report/updates.h"
#include "bench/report/voxels.h"
#include "bench/report/pictures.h"
#include "bench/report/profile_file.h"
#include "bench/report/quick.h"
#include "bench/report/probes.h"
#include "bench/report/probe_light.h"
#include "bench/report/rendered.h"
#include "bench/report/scene_savings.h"
#include "bench/report/screens.h"
#include "bench/report/session.h"
#include "bench/report/stability.h"
#include "tests/cases/bilateral_cases.h"
#include "tests/cases/cone_trace_cases.h"
#include "tests/cases/gaussian_blur_cases.h"
#include "tests/cases/hiz_ssr_cases.h"
#include "tests/cases/light_propagation_cases.h"
#include "tests/cases/lpv_cases.h"
#include "tests/cases/mip_build_cases.h"
#include "tests/cases/octahedral_march_cases.h"
#include "tests/cases/probe_cases.h"
#include "tests/cases/voxel_inject_cases.h"
#include "tests/cases/voxelize_cases.h"

namespace luxel::report {
namespace {

template <class T>
void append(std::vector<T>& to, std::vector<T> more) {
  for (T& t : more) to.push_back(std::move(t));
}

// The cases of all kernels that are asked for, and what is found out by experiment.
std::vector<Job> stability_alone(Session& session) {
  const std::vector<std::pair<const char*, std::vector<cases::Case>>> lists{
      {"gaussian_blur", cases::gaussian_blur_cases()},   {"bilateral", cases::bilateral_cases()},
      {"mip_build", cases::mip_build_cases()},           {"voxelize", cases::voxelize_cases()},
      {"voxelize", cases::voxel_inject_cases()},         {"cone_trace", cases::cone_trace_cases()},
      {"hiz_ssr", cases::hiz_ssr_cases()},               {"octahedral_march", cases::octahedral_march_cases()},
      {"octahedral_march", cases::probe_cases()},        {"light_propagation", cases::light_propagation_cases()},
      {"light_propagation", cases::lpv_inject_cases()},  {"light_propagation", cases::lpv_geometry_cases()},
      {"light_propagation", cases::lpv_sample_cases()}};
  std::vector<Job> jobs;
  for (const auto& [kernel, list] : lists)
    if (session.settings().wants(kernel)) append(jobs, stability_jobs(session, list));
  append(jobs, instrument_jobs(session));
  return jobs;
}

// Those whose label has one of the texts that were asked for.
void keep_only(const Settings& settings, std::vector<Job>& jobs) {
  if (settings.only.empty()) return;
  std::erase_if(jobs, [&](const Job& job) {
    return std::none_of(settings.only.begin(), settings.only.end(),
                        [&](const std::string& text) { return job.label.find(text) != std::string::npos; });
  });
}

}  // namespace

int measure_device(Settings settings, const std::string& device, double best_guard, bool first) {
  std::signal(SIGPIPE, SIG_IGN);
  Result<std::shared_ptr<Context>> opened = Context::open(device);
  if (!opened) {
    std::fprintf(stderr, "luxel: %s\n", opened.status().message().c_str());
    return 1;
  }
  std::string problem;
  const auto context = tuned(opened.value(), &problem);
  // `luxel stability` has all cases; of drivers, which compile each, a report shows those that go furthest.
  settings.slow_cases = settings.stability && !settings.quick;
  if (context->info().api != Api::cpu && !settings.slow_cases) settings.most_cases = settings.quick ? 6 : 24;
  // Beside devices the C++ execution is their oracle, with their bits: few settings of it are timed, and whole scenes, what
  // it could leave out, and how it compares would only say the same again.
  const bool compares = !settings.oracle;
  if (settings.oracle && !settings.stability) settings.quick = true;
  Session session(context, settings, child_fd, best_guard);
  if (!problem.empty()) session.note("problems", problem);
  if (settings.stability) {
    std::vector<Job> jobs = stability_alone(session);
    keep_only(settings, jobs);
    session.run(jobs);
    return 0;
  }

  std::vector<std::string> missing;
  std::vector<std::shared_ptr<const Scene>> files;
  // The grids take the middle: every setting of them is measured on every device.
  for (const Scene& scene : image_files(settings, missing))
    files.push_back(std::make_shared<Scene>(middle_of(scene, settings.quick ? 256 : 512)));

  std::vector<Job> jobs = limit_jobs(session);
  if (settings.wants("gaussian_blur")) {
    append(jobs, gaussian_grid(session, files));
    if (compares) {
      append(jobs, gaussian_left_out(session));
      append(jobs, gaussian_reproduction(session));
      append(jobs, gaussian_peers(session));
      append(jobs, gaussian_scipy(session));
    }
    append(jobs, stability_jobs(session, cases::gaussian_blur_cases()));
    if (first) append(jobs, gaussian_pictures(session, files));
  }
  if (settings.wants("bilateral")) {
    append(jobs, denoise_grid(session, missing));
    append(jobs, filter_grid(session));
    if (compares) {
      append(jobs, filter_left_out(session));
      append(jobs, filter_reproduction(session));
      append(jobs, filter_peers(session));
    }
    append(jobs, stability_jobs(session, cases::bilateral_cases()));
  }
  if (settings.wants("mip_build")) {
    const MipScenes scenes = mip_scenes(settings, files, missing);
    append(jobs, mip_grid(session, scenes));
    if (compares) {
      append(jobs, mip_left_out(session, scenes));
      append(jobs, mip_reproduction(session, scenes));
      append(jobs, octree_reproduction(session, missing));
      append(jobs, mip_peers(session));
    }
    append(jobs, stability_jobs(session, cases::mip_build_cases()));
    if (first) {
      append(jobs, mip_marches(session, scenes));
      append(jobs, mip_pictures(session, scenes));
    }
  }
  if (settings.wants("voxelize")) {
    append(jobs, voxel_jobs(session));
    append(jobs, update_jobs(session));
    append(jobs, shadow_map_jobs(session));
    append(jobs, stability_jobs(session, cases::voxelize_cases()));
    append(jobs, stability_jobs(session, cases::voxel_inject_cases()));
  }
  if (settings.wants("cone_trace")) {
    append(jobs, cone_grid(session));
    if (compares) {
      append(jobs, cone_left_out(session));
      append(jobs, scene_left_out(session, missing));
      append(jobs, cone_reproduction(session));
      append(jobs, cone_peers(session));
    }
    append(jobs, stability_jobs(session, cases::cone_trace_cases()));
    if (compares) append(jobs, rendered_grid(session, missing));
  }
  if (settings.wants("hiz_ssr")) {
    append(jobs, screen_grid(session));
    if (compares) {
      append(jobs, screen_truth_grid(session, missing));
      append(jobs, screen_left_out(session));
      append(jobs, screen_peers(session));
    }
    append(jobs, stability_jobs(session, cases::hiz_ssr_cases()));
  }
  if (settings.wants("octahedral_march")) {
    append(jobs, probe_grid(session));
    if (compares) {
      append(jobs, probe_left_out(session));
      append(jobs, probe_reproduction(session));
      append(jobs, probe_peers(session));
    }
    append(jobs, stability_jobs(session, cases::octahedral_march_cases()));
    append(jobs, probe_light_grid(session, missing));
    if (compares) {
      append(jobs, probe_light_left_out(session));
      append(jobs, probe_light_reproduction(session));
      append(jobs, probe_light_peers(session));
    }
    append(jobs, stability_jobs(session, cases::probe_cases()));
  }
  if (settings.wants("light_propagation")) {
    append(jobs, propagation_grid(session));
    if (compares) {
      append(jobs, propagation_left_out(session));
      append(jobs, propagation_reproduction(session));
      append(jobs, propagation_peers(session));
    }
    append(jobs, stability_jobs(session, cases::light_propagation_cases()));
    append(jobs, lpv_scene_grid(session, missing));
    if (compares) append(jobs, lpv_scene_left_out(session));
    append(jobs, stability_jobs(session, cases::lpv_inject_cases()));
    append(jobs, stability_jobs(session, cases::lpv_geometry_cases()));
    append(jobs, stability_jobs(session, cases::lpv_sample_cases()));
  }
  for (const std::string& line : missing)
    if (session.first_time(line)) session.note("skipped", line);
  keep_only(settings, jobs);
  if (settings.quick && settings.only.empty()) keep_quick(jobs);
  session.run(jobs);
  session.emit_promises();
  return 0;
}

}  // namespace luxel::report

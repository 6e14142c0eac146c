// What the report measures of gaussian_blur.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <luxel/gaussian_blur.h>

#include "bench/report/scenes.h"
#include "bench/report/session.h"

namespace luxel::report {

/// How a result is compared with the truth.
enum class BlurMetric {
  largest,  // max |x - t| over the largest |input|
  half_l1   // half the sum of |x - t|: of an impulse response, the share of the weight that lies wrong
};

/// One setting on one scene.
struct BlurSetting {
  std::shared_ptr<const Scene> scene;
  GaussianBlurParams params;
  double k = 0;  // radius = ceil(k sigma); 0: the radius was given
  BlurMetric metric = BlurMetric::largest;
};

/// "gaussian_blur separable f32x4 sigma 4 k 3 on camera.png"
std::string label(const BlurSetting& setting);

/// Parameters for a scene: width and height of it, sigma, radius ceil(k sigma).
GaussianBlurParams params_for(const Scene& scene, double sigma, double k, Format format = Format::f32x4,
                              GaussianVariant variant = GaussianVariant::separable);

/// Times a setting, splits its error, and makes a frontier row.
Status measure_blur(Session& session, const BlurSetting& setting);

/// Milliseconds of one run of a setting, for pairs in turn. The run is compiled and warm.
Result<Session::Timed> timed_blur(Session& session, const BlurSetting& setting);

/// Another library's blur of the same image; `run` waits until the result is there.
struct GaussianPeer {
  std::string name, version;
  int radius = 0;  // taps on each side that it takes
  Session::Timed run;
  std::function<std::vector<double>()> result;
};

/// Times a setting and a peer in turn, and makes a row of `peers`.
Status beside_peer(Session& session, const BlurSetting& setting, const GaussianPeer& peer, Cell goal);

/// The error of values against the truth of a setting.
double blur_error(const BlurSetting& setting, const std::vector<double>& source, const std::vector<double>& values);

std::vector<Job> gaussian_grid(Session& session, const std::vector<std::shared_ptr<const Scene>>& files);
std::vector<Job> gaussian_left_out(Session& session);
std::vector<Job> gaussian_reproduction(Session& session);
std::vector<Job> gaussian_peers(Session& session);
std::vector<Job> gaussian_scipy(Session& session);

}  // namespace luxel::report

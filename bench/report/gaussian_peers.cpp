// OpenCV's GaussianBlur beside ours: the same image, the same taps, in turn.
#include "bench/report/gaussian.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#ifdef LUXEL_OPENCV
#include <opencv2/core.hpp>
#include <opencv2/core/ocl.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/cases/gaussian_blur_support.h"
#endif

namespace luxel::report {

#ifdef LUXEL_OPENCV
namespace {

using Shared = std::shared_ptr<const Scene>;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

cv::Mat matrix(const Scene& scene, Format format) {
  const std::vector<double> values = in_format(scene, format);
  cv::Mat image(scene.height, scene.width, CV_32FC(channels(format)));
  std::copy(values.begin(), values.end(), image.ptr<float>());
  return image;
}

std::vector<double> values_of(const cv::Mat& image) {
  const float* data = image.ptr<float>();
  return {data, data + image.total() * image.channels()};
}

GaussianPeer on_cpu(const BlurSetting& s, int radius) {
  struct State {
    cv::Mat src, dst;
  };
  const auto state = std::make_shared<State>();
  state->src = matrix(*s.scene, s.params.format);
  const cv::Size size(2 * radius + 1, 2 * radius + 1);
  const double sigma = s.params.sigma;
  return {fmt::format("OpenCV GaussianBlur, CPU, {} threads", cv::getNumThreads()), CV_VERSION, radius,
          [=]() -> Result<double> {
            const auto begin = Clock::now();
            cv::GaussianBlur(state->src, state->dst, size, sigma, sigma, cv::BORDER_REPLICATE);
            return ms_since(begin);
          },
          [=] { return values_of(state->dst); }};
}

Result<GaussianPeer> on_opencl(const BlurSetting& s, int radius, const std::string& device) {
  cv::ocl::setUseOpenCL(true);
  if (!cv::ocl::haveOpenCL() || !cv::ocl::useOpenCL())
    return Status(Code::unsupported, "OpenCV's OpenCL path finds no device here (OPENCV_OPENCL_DEVICE chooses one)");
  const std::string used = cv::ocl::Device::getDefault().name();
  if (device.find(used) == std::string::npos)
    return Status(Code::unsupported, fmt::format("OpenCV's OpenCL path took the device {}, not this one", used));
  struct State {
    cv::UMat src, dst;
  };
  const auto state = std::make_shared<State>();
  matrix(*s.scene, s.params.format).copyTo(state->src);
  const cv::Size size(2 * radius + 1, 2 * radius + 1);
  const double sigma = s.params.sigma;
  return GaussianPeer{"OpenCV GaussianBlur, OpenCL path on this device", CV_VERSION, radius,
              [=]() -> Result<double> {
                const auto begin = Clock::now();
                cv::GaussianBlur(state->src, state->dst, size, sigma, sigma, cv::BORDER_REPLICATE);
                cv::ocl::finish();
                return ms_since(begin);
              },
              [=] { return values_of(state->dst.getMat(cv::ACCESS_READ)); }};
}

// OpenCV reports by exceptions.
Status caught(const std::function<Status()>& work) {
  try {
    return work();
  } catch (const cv::Exception& error) {
    return {Code::unsupported, std::string("OpenCV: ") + error.what()};
  }
}

}  // namespace

std::vector<Job> gaussian_peers(Session& session) {
  if (session.is_cpu()) return {};  // the C++ execution is there to be right, not fast
  const Shared scene = std::make_shared<Scene>(landscape(1920, 1080));
  const bool opencl = session.context().info().api == Api::opencl;
  const bool software = session.context().profile().name == "pocl" || session.context().profile().name == "lavapipe";
  std::vector<Job> jobs;
  for (const Format format : {Format::f32x4, Format::f32x1}) {
    const BlurSetting s{scene, params_for(*scene, 4, 3, format), 3};
    // Goals for the two software drivers on the cores that OpenCV uses too; elsewhere there is none.
    Cell goal;
    if (software && format == Format::f32x4) goal = opencl ? 2.5 : 1.0;
    if (software && format == Format::f32x1 && opencl) goal = 1.5;
    jobs.push_back({fmt::format("gaussian_blur peer OpenCV CPU {}", name(format)), [&session, s, goal] {
                      return caught(
                          [&] { return beside_peer(session, s, on_cpu(s, s.params.radius), goal); });
                    }});
    if (!opencl) continue;
    goal = software && format == Format::f32x4 ? Cell(4.0) : Cell();
    jobs.push_back({fmt::format("gaussian_blur peer OpenCV OpenCL {}", name(format)), [&session, s, goal] {
                      return caught([&] {
                        const auto peer = on_opencl(s, s.params.radius, session.device());
                        return peer ? beside_peer(session, s, peer.value(), goal) : peer.status();
                      });
                    }});
  }
  // At equal error of 1e-3 of full scale, OpenCV needs 85 taps at sigma 12.
  constexpr int taps_85 = 42;
  for (const GaussianVariant variant : {GaussianVariant::pyramid, GaussianVariant::recursive}) {
    BlurSetting s{scene, params_for(*scene, 12, 0, Format::f32x4, variant), 0};
    s.params.levels = -1;
    const Cell goal = software && opencl && variant == GaussianVariant::pyramid ? Cell(4.0) : Cell();
    jobs.push_back({fmt::format("gaussian_blur {} peer OpenCV CPU 85 taps", cases::name(variant)), [&session, s, goal] {
                      return caught([&] { return beside_peer(session, s, on_cpu(s, taps_85), goal); });
                    }});
  }
  return jobs;
}

#else

std::vector<Job> gaussian_peers(Session& session) {
  session.note("problems",
               "peers: this build has no OpenCV (Debian: apt-get install libopencv-imgproc-dev, then build again)");
  return {};
}

#endif

}  // namespace luxel::report

#include "bench/report/filters_opencv.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include <fmt/format.h>

#ifdef LUXEL_OPENCV_XIMGPROC
#include <opencv2/core.hpp>
#include <opencv2/core/ocl.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/ximgproc/edge_filter.hpp>
#endif

namespace luxel::report {

#ifdef LUXEL_OPENCV_XIMGPROC
namespace {

cv::Mat three(const std::vector<double>& values, int width, int height) {
  cv::Mat m(height, width, CV_32FC3);
  float* to = m.ptr<float>();
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % 4 != 3) *to++ = static_cast<float>(values[i]);
  return m;
}

OpenCvFilter made(std::string name, const cv::Mat& src, const cv::Mat& guide, int d, double sigma_color,
                  double sigma_space) {
  struct State {
    cv::Mat src, guide, dst;
  };
  const auto state = std::make_shared<State>(State{src, guide, {}});
  return {std::move(name),
          CV_VERSION,
          {{"diameter", d}, {"sigma_color", sigma_color}, {"sigma_space", sigma_space}},
          [=]() -> Result<double> {
            const auto begin = std::chrono::steady_clock::now();
            try {
              if (state->guide.empty())
                cv::bilateralFilter(state->src, state->dst, d, sigma_color, sigma_space, cv::BORDER_REPLICATE);
              else
                cv::ximgproc::jointBilateralFilter(state->guide, state->src, state->dst, d, sigma_color, sigma_space,
                                                   cv::BORDER_REPLICATE);
            } catch (const cv::Exception& error) {
              return Status(Code::unsupported, std::string("OpenCV: ") + error.what());
            }
            return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
          },
          [=] {
            std::vector<double> values;
            const float* from = state->dst.ptr<float>();
            for (std::size_t i = 0; i < state->dst.total(); ++i) {
              for (int c = 0; c < 3; ++c) values.push_back(*from++);
              values.push_back(0);
            }
            return values;
          }};
}

}  // namespace

Result<OpenCvFilter> opencv_filter(const BilateralParams& p, const std::vector<double>& src,
                                   const std::vector<double>& guide) {
  const int d = 2 * p.radius + 1;
  return made(fmt::format("OpenCV {}, CPU, {} threads", guide.empty() ? "bilateralFilter" : "jointBilateralFilter",
                          cv::getNumThreads()),
              three(src, p.width, p.height), guide.empty() ? cv::Mat() : three(guide, p.width, p.height), d,
              p.sigma_range, p.sigma_space);
}

Result<OpenCvFilter> opencv_filter8(const BilateralParams& p, const std::vector<double>& src,
                                    const std::string& device) {
  if (!device.empty()) {
    cv::ocl::setUseOpenCL(true);
    if (!cv::ocl::haveOpenCL() || !cv::ocl::useOpenCL())
      return Status(Code::unsupported, "OpenCV's OpenCL path finds no device here (OPENCV_OPENCL_DEVICE chooses one)");
    const std::string used = cv::ocl::Device::getDefault().name();
    if (device.find(used) == std::string::npos)
      return Status(Code::unsupported, fmt::format("OpenCV's OpenCL path took the device {}, not this one", used));
  }
  struct State {
    cv::Mat src, dst;
    cv::UMat device_src, device_dst;
  };
  const auto state = std::make_shared<State>();
  three(src, p.width, p.height).convertTo(state->src, CV_8UC3, 255);
  if (!device.empty()) state->src.copyTo(state->device_src);
  const int d = 2 * p.radius + 1;
  const double color = 255 * p.sigma_range, space = p.sigma_space;
  const bool opencl = !device.empty();
  return OpenCvFilter{
      opencl ? std::string("OpenCV bilateralFilter, 8 bits, OpenCL path on this device")
             : fmt::format("OpenCV bilateralFilter, 8 bits, CPU, {} threads", cv::getNumThreads()),
      CV_VERSION,
      {{"diameter", d}, {"sigma_color", color}, {"sigma_space", space}},
      [=]() -> Result<double> {
        const auto begin = std::chrono::steady_clock::now();
        try {
          if (opencl) {
            cv::bilateralFilter(state->device_src, state->device_dst, d, color, space, cv::BORDER_REPLICATE);
            cv::ocl::finish();
          } else {
            cv::bilateralFilter(state->src, state->dst, d, color, space, cv::BORDER_REPLICATE);
          }
        } catch (const cv::Exception& error) {
          return Status(Code::unsupported, std::string("OpenCV: ") + error.what());
        }
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      },
      [=] {
        const cv::Mat out = opencl ? state->device_dst.getMat(cv::ACCESS_READ).clone() : state->dst;
        std::vector<double> values;
        const unsigned char* from = out.ptr<unsigned char>();
        for (std::size_t i = 0; i < out.total(); ++i) {
          for (int c = 0; c < 3; ++c) values.push_back(*from++ / 255.0);
          values.push_back(0);
        }
        return values;
      }};
}

std::vector<OpenCvFilter> opencv_denoisers(const NoisyRender& render, bool quick) {
  const cv::Mat src = three(without_albedo(render, render.color), render.width, render.height);
  std::vector<double> guide = render.normals;
  for (std::size_t i = 0; i < guide.size(); ++i) {
    guide[i] += render.albedo[i];
    if (i % 4 == 2) guide[i] += 1000 / render.depth[i / 4];  // the scene is some 1000 units deep
  }
  const cv::Mat joint = three(guide, render.width, render.height);
  struct Best {
    int d;
    double color, space;
  };
  std::vector<OpenCvFilter> all;
  for (const Best& b : {Best{9, 0.02, 9}, {13, 0.02, 13 / 3.0}, {17, 0.02, 17 / 3.0}, {25, 0.02, 5}})
    if (!quick || b.d == 13) all.push_back(made("OpenCV jointBilateralFilter", src, joint, b.d, b.color, b.space));
  for (const Best& b : {Best{9, 1, 2.25}, {15, 1, 3.75}})
    if (!quick || b.d == 9) all.push_back(made("OpenCV bilateralFilter", src, {}, b.d, b.color, b.space));
  return all;
}

#else

Result<OpenCvFilter> opencv_filter(const BilateralParams&, const std::vector<double>&, const std::vector<double>&) {
  return Status(Code::unsupported,
                "this build has no OpenCV ximgproc (Debian: apt-get install libopencv-contrib-dev, then build again)");
}

Result<OpenCvFilter> opencv_filter8(const BilateralParams& p, const std::vector<double>& src, const std::string&) {
  return opencv_filter(p, src, {});
}

std::vector<OpenCvFilter> opencv_denoisers(const NoisyRender&, bool) { return {}; }

#endif

}  // namespace luxel::report

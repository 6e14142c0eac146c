#include "bench/report/pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/io/image.h"
#include "bench/report/gaussian.h"
#include "bench/truth/gaussian_truth.h"
#include "tests/cases/gaussian_blur_support.h"

namespace luxel::report {
namespace {

double srgb(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

// Stops of the false colours, from 1e-8 to 1, two decades apart: sRGB values.
constexpr double stops[5][3] = {
    {0, 0, 0.02}, {0.34, 0.06, 0.43}, {0.73, 0.21, 0.33}, {0.98, 0.55, 0.04}, {0.99, 1, 0.75}};

}  // namespace

const char* const error_map_scale =
    "error over full scale: black 1e-8 and below, violet 1e-6, red 1e-4, orange 1e-2, light yellow 1";

Status write_picture(Session& session, const std::string& kernel, const std::string& file, const std::string& caption,
                     int width, int height, int channels, const std::vector<double>& values, double exposure,
                     bool encoded) {
  const int shown = std::min(channels, 3) == 2 ? 1 : std::min(channels, 3);
  io::Image image{width, height, shown, {}};
  for (std::size_t p = 0; p < static_cast<std::size_t>(width) * height; ++p)
    for (int c = 0; c < shown; ++c) {
      const double v = values[p * channels + c] * exposure;
      image.pixels.push_back(static_cast<float>(encoded ? v : srgb(v)));
    }
  const std::string path = "pictures/" + file + ".png";
  if (Status status = io::write_image(session.settings().out + "/" + path, image); !status) return status;
  session.note("pictures",
               {{"kernel", kernel}, {"file", path}, {"caption", caption}, {"width", width}, {"height", height}});
  return {};
}

double exposure_for(const Scene& scene) {
  if (scene.encoded) return 1;
  std::vector<double> luminance;
  for (std::size_t p = 0; p < static_cast<std::size_t>(scene.width) * scene.height; ++p) {
    const double* v = scene.values.data() + p * scene.channels;
    luminance.push_back(scene.channels < 3 ? v[0] : 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]);
  }
  if (luminance.empty()) return 1;
  const auto at = luminance.begin() + static_cast<std::ptrdiff_t>(luminance.size() * 95 / 100);
  std::nth_element(luminance.begin(), at, luminance.end());
  return *at > 0 ? 0.8 / *at : 1;
}

std::vector<double> error_map(const std::vector<double>& a, const std::vector<double>& b, int channels,
                              double full_scale) {
  std::vector<double> colours;
  for (std::size_t p = 0; p * channels < a.size(); ++p) {
    double worst = 0;
    for (int c = 0; c < channels; ++c) worst = std::max(worst, std::fabs(a[p * channels + c] - b[p * channels + c]));
    const double place = std::clamp((std::log10(std::max(worst / full_scale, 1e-30)) + 8) / 2, 0.0, 4.0);
    const int low = std::min(static_cast<int>(place), 3);
    for (int c = 0; c < 3; ++c) colours.push_back(stops[low][c] + (stops[low + 1][c] - stops[low][c]) * (place - low));
  }
  return colours;
}

std::vector<Job> gaussian_pictures(Session& session, const std::vector<std::shared_ptr<const Scene>>& files) {
  std::vector<Job> jobs;
  std::vector<std::shared_ptr<const Scene>> scenes(files.begin(),
                                                   files.begin() + std::min<std::ptrdiff_t>(files.size(), 2));
  scenes.push_back(std::make_shared<Scene>(landscape(512, 288)));
  for (std::size_t i = 0; i < scenes.size(); ++i)
    jobs.push_back({"gaussian_blur pictures of " + scenes[i]->name, [&session, scene = scenes[i], i]() -> Status {
                      const double exposure = exposure_for(*scene);
                      const std::vector<double> src = in_format(*scene, Format::f32x4);
                      double full_scale = 0;
                      for (const double v : src) full_scale = std::max(full_scale, std::fabs(v));
                      const auto picture = [&](const std::string& file, const std::string& caption,
                                               const std::vector<double>& v, int n, bool map) {
                        return write_picture(session, "gaussian_blur", fmt::format("gaussian_blur_{}_{}", i, file),
                                             caption, scene->width, scene->height, n, v, map ? 1 : exposure,
                                             map || scene->encoded);
                      };
                      if (Status status = picture("input", scene->name + ": input", src, 4, false); !status)
                        return status;
                      struct Shown {
                        double sigma, k;
                        GaussianVariant variant;
                      };
                      for (const Shown& s : {Shown{4, 3, GaussianVariant::separable},
                                             {16, 3, GaussianVariant::separable},
                                             {4, 1, GaussianVariant::separable},
                                             {4, 3, GaussianVariant::sampler}}) {
                        const GaussianBlurParams p = params_for(*scene, s.sigma, s.k, Format::f32x4, s.variant);
                        const auto out = cases::blur(session.context(), p, src);
                        if (!out && out.status().code() == Code::unsupported) continue;
                        if (!out) return out.status();
                        const std::string what =
                            fmt::format("{}, sigma {}, k {} (R {})", cases::name(s.variant), s.sigma, s.k, p.radius);
                        const std::string file = fmt::format("{}_s{}_k{}", cases::name(s.variant), s.sigma, s.k);
                        const auto exact = truth::gaussian(src, p.width, p.height, 4, s.sigma, Border::clamp);
                        if (Status status = picture(file, what, out.value(), 4, false); !status) return status;
                        if (Status status = picture(file + "_error", fmt::format("{}: {}", what, error_map_scale),
                                                    error_map(out.value(), exact, 4, full_scale), 3, true);
                            !status)
                          return status;
                      }
                      return {};
                    }});
  return jobs;
}

}  // namespace luxel::report

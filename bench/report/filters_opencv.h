// OpenCV's bilateral filters as peers: of a build without OpenCV, none.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include <luxel/bilateral.h>

#include "bench/report/denoise.h"
#include "bench/report/session.h"

namespace luxel::report {

struct OpenCvFilter {
  std::string name, version;
  Cell knobs;
  Session::Timed run;                           // the milliseconds of one call
  std::function<std::vector<double>()> result;  // of the last, 4 channels
};

/// bilateralFilter, or with a guide jointBilateralFilter, of the first three channels, at the parameters' diameter and
/// sigmas. Errors: unsupported, where the build has no OpenCV.
Result<OpenCvFilter> opencv_filter(const BilateralParams& params, const std::vector<double>& src,
                                   const std::vector<double>& guide);

/// bilateralFilter of three channels of 8 bits, values 0..1; through OpenCV's OpenCL path on the device whose name is part of
/// `device`, or by the CPU where `device` is empty. Errors: unsupported, also where OpenCV took another device.
Result<OpenCvFilter> opencv_filter8(const BilateralParams& params, const std::vector<double>& src,
                                    const std::string& device);

/// Filters of light without albedo, at the parameters that leave least relmse_pixel over all pixels on
/// gbuffer_cycles_cbox, of diameters 9 to 33, sigma_color 0.005 to 10 and sigma_space d/5 to d; jointBilateralFilter by a guide of
/// normals, albedo and inverse depth in its three channels, the best of four such guides.
std::vector<OpenCvFilter> opencv_denoisers(const NoisyRender& render, bool quick);

}  // namespace luxel::report

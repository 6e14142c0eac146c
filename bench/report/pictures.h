// Pictures of the report: exposure and the sRGB curve, error maps in false colour. Nothing here goes into a number.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/report/scenes.h"
#include "bench/report/session.h"

namespace luxel::report {

/// Writes DIR/pictures/`file`.png of interleaved values and notes its caption. `exposure`: factor on linear light.
Status write_picture(Session& session, const std::string& kernel, const std::string& file, const std::string& caption,
                     int width, int height, int channels, const std::vector<double>& values, double exposure,
                     bool encoded);

/// The factor that brings a scene's 95th percentile of luminance to 0.8; 1 for values that are encoded already.
double exposure_for(const Scene& scene);

/// |a - b| of each pixel over `full_scale` as colour: black 1e-8 and below, through violet, red and yellow to white at
/// 1.
std::vector<double> error_map(const std::vector<double>& a, const std::vector<double>& b, int channels,
                              double full_scale);

/// One line that explains error_map.
extern const char* const error_map_scale;

std::vector<Job> gaussian_pictures(Session& session, const std::vector<std::shared_ptr<const Scene>>& files);

}  // namespace luxel::report

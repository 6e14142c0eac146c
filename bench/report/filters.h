// Rows of bilateral: a noisy render denoised by every variant and by OpenCV, approximations beside the filter, and speed.
#pragma once
#include "bench/report/session.h"

namespace luxel::report {

/// Every variant and knob on a render of one sample a pixel (LUXEL_DATA/gbuffer_cycles_cbox) against 512 samples, with
/// OpenCV's filters tuned on the same picture. `missing` receives a line where the data is not there.
std::vector<Job> denoise_grid(Session& session, std::vector<std::string>& missing);
/// separable, adaptive, grid and steps against direct in double.
std::vector<Job> filter_grid(Session& session);
std::vector<Job> filter_left_out(Session& session);
/// Fewer taps, far apart, against a window with all of them.
std::vector<Job> filter_reproduction(Session& session);
/// OpenCV's bilateralFilter and jointBilateralFilter at 1920x1080, in turn with ours.
std::vector<Job> filter_peers(Session& session);

}  // namespace luxel::report

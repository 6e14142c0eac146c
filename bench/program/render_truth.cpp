#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

#include "render.h"

namespace luxel::program {
namespace {

io::Image image_of(const std::vector<double>& values, int channels, const scene::GBuffer& g) {
  return {g.width, g.height, channels, {values.begin(), values.end()}};
}

// The root of the mean squared standard error over the mean, in percent.
double noise(const truth::Estimate& e) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < e.error.size(); ++i) squares += e.error[i] * e.error[i], sum += e.mean(i);
  return sum > 0 ? 100 * std::sqrt(squares * static_cast<double>(e.error.size())) / sum : 0;
}

}  // namespace

Result<RenderOutput> render_truth(const RenderInput& input) {
  const scene::GBuffer& g = input.gbuffer;
  truth::PathSettings settings = input.settings;
  int shown = -1;
  if (isatty(STDERR_FILENO))
    settings.progress = [&](double share) {
      const int percent = static_cast<int>(share * 100);
      if (percent != shown) std::fprintf(stderr, "\rtracing paths: %d %% ", shown = percent);
    };
  const auto traced = path_truth(input.rays, truth::receivers(g, input.scene.camera.eye), settings);
  if (shown >= 0) std::fprintf(stderr, "\r\033[K");
  if (!traced) return traced.status();
  const truth::PathTruth& t = traced.value();
  RenderOutput out;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    out.lighting.sun.push_back(t.sun.rgb(i));
    out.lighting.direct.push_back(t.emitted.rgb(i) + t.sky.rgb(i));
    out.lighting.indirect.push_back(t.indirect_all.rgb(i));
    out.lighting.glossy.push_back(t.glossy_emitted.rgb(i) + t.glossy_sky.rgb(i) + t.glossy_all.rgb(i));
    out.lighting.visibility.push_back(t.visibility.mean(i));
  }
  out.times.push_back({"shade", t.seconds > 0 ? "path_truth" : "path_truth, from the cache,", t.seconds * 1e3});
  out.notes.push_back(fmt::format(
      "standard error: emitted {:.2f} %, sky {:.2f} %, indirect {:.2f} %, all bounces {:.2f} %, visibility {:.2f} %",
      noise(t.emitted), noise(t.sky), noise(t.indirect), noise(t.indirect_all), noise(t.visibility)));
  for (const auto& [name, estimate] : estimates(t)) {
    out.buffers["truth_" + name + "_t1"] = image_of(estimate->t1, estimate->channels, g);
    out.buffers["truth_" + name + "_t2"] = image_of(estimate->t2, estimate->channels, g);
    out.buffers["truth_" + name + "_error"] = image_of(estimate->error, estimate->channels, g);
  }
  return out;
}

}  // namespace luxel::program

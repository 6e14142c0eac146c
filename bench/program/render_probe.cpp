#include <numbers>

#include <fmt/format.h>

#include "common.h"
#include "direct_light.h"
#include "render.h"

namespace luxel::program {

using glm::dvec3;

Result<RenderOutput> render_probe(const RenderInput& input) {
  const scene::GBuffer& g = input.gbuffer;
  auto context = open_device(input.device);
  if (!context) return context.status();
  if (context.value()->real64())
    return Status(Code::invalid_argument, "--method probe: the device cpu:double is not taken; expected another");
  auto built = scene::ProbeScene::build(context.value(), input.rays, input.probes);
  if (!built) return built.status();
  scene::ProbeScene& probes = built.value();
  if (Status s = probes.light(); !s) return s;

  // Each pixel, and where one is glossy its mirror direction in place of the normal.
  std::vector<float> receivers, mirrored;
  bool glossy = false;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const dvec3 p = g.at(g.position, i), n = g.at(g.normal, i), to_eye = input.scene.camera.eye - p;
    const dvec3 mirror = 2 * glm::dot(n, to_eye) * n - to_eye;
    const bool mine = g.surface_at(i) && g.at(g.specular, i) != dvec3(0);
    glossy = glossy || mine;
    for (const double v : {p.x, p.y, p.z, 1.0, n.x, n.y, n.z, 0.0}) receivers.push_back(static_cast<float>(v));
    for (const double v : {p.x, p.y, p.z, 1.0, mine ? mirror.x : 0, mine ? mirror.y : 0, mine ? mirror.z : 0, 0.0})
      mirrored.push_back(static_cast<float>(v));
  }
  ProbeShadeParams knobs = input.by_probes;
  knobs.count = true;
  auto lit = probes.shade(knobs, receivers, true);
  if (!lit) return lit.status();
  const scene::ProbeLit light = std::move(lit).value();
  std::vector<scene::ProbeStep> steps = probes.shade_steps();
  scene::ProbeLit in_mirrors;
  if (glossy) {
    knobs.count = false;
    knobs.normal_bias = 0;
    auto seen = probes.shade(knobs, mirrored, true);
    if (!seen) return seen.status();
    in_mirrors = std::move(seen).value();
    for (const scene::ProbeStep& s : probes.shade_steps()) steps.push_back({s.name + ", glossy", s.ms});
  }

  RenderOutput out;
  Clock clock;
  out.lighting.sun = direct(input, probes.lights(), true);
  out.lighting.direct = direct(input, probes.lights(), false);
  out.times.push_back({"shade", "shadow rays", clock.ms()});
  io::Image share{g.width, g.height, 1, {}};
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const auto rgb = [&](const std::vector<float>& v) {
      return v.empty() ? dvec3(0) : dvec3(v[4 * i], v[4 * i + 1], v[4 * i + 2]);
    };
    if (!probes.lamps()) out.lighting.direct[i] += rgb(light.direct);
    out.lighting.indirect.push_back(rgb(light.indirect));
    out.lighting.glossy.push_back((rgb(in_mirrors.indirect) + rgb(in_mirrors.direct)) / std::numbers::pi);
    out.lighting.visibility.push_back(g.surface_at(i) ? 1 : 0);
    share.pixels.push_back(light.indirect[4 * i + 3]);
  }
  out.buffers["seen_by_probes"] = std::move(share);
  for (const scene::ProbeStep& s : probes.build_steps()) out.times.push_back({"build", s.name, s.ms});
  for (const scene::ProbeStep& s : probes.light_steps()) out.times.push_back({"update", s.name, s.ms});
  for (const scene::ProbeStep& s : steps) out.times.push_back({"shade", s.name, s.ms});
  const ProbeGrid& grid = probes.probes().grid;
  const auto count = [&](ProbeShadeOutcome o) { return light.counters[static_cast<std::size_t>(o)]; };
  out.notes.push_back(fmt::format("{}: {}x{}x{} probes, {} inside geometry, {:.1f} MiB", context.value()->info().id, grid.count[0],
                                  grid.count[1], grid.count[2], probes.dead(), static_cast<double>(probes.memory_bytes()) / 1048576));
  out.notes.push_back(fmt::format("{} receivers: {} outside the outermost probes, {} seen by no probe, {} without any",
                                  count(ProbeShadeOutcome::receivers) - count(ProbeShadeOutcome::degenerate), count(ProbeShadeOutcome::outside),
                                  count(ProbeShadeOutcome::hidden), count(ProbeShadeOutcome::lost)));
  out.notes.push_back("ambient occlusion is not found by probes: 1 everywhere");
  if (glossy) out.notes.push_back("glossy surfaces mirror what a cosine lobe about the mirror direction sees, whatever their roughness");
  return out;
}

}  // namespace luxel::program

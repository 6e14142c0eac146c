#include <numbers>

#include <fmt/format.h>

#include "common.h"
#include "render.h"

namespace luxel::program {

// Reflections of what cones lit: where a ray hits the screen, what is seen there reflects diffusely, as the truth has it.
Result<RenderOutput> render_ssr(const RenderInput& input) {
  auto rendered = render_cone(input);
  if (!rendered) return rendered;
  RenderOutput& out = rendered.value();
  const scene::GBuffer& g = input.gbuffer;
  auto context = open_device(input.device);
  if (!context) return context.status();

  HizSsrParams p = input.screen;
  const HizSsrParams view = screen_params(g, input.scene.camera);
  p.width = view.width, p.height = view.height;
  p.focal_x = view.focal_x, p.focal_y = view.focal_y, p.centre_x = view.centre_x, p.centre_y = view.centre_y;
  p.shade = p.fallback = p.count = true;
  std::vector<float> colour, fallback;
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    const glm::dvec3 e = out.lighting.sun[i] + out.lighting.direct[i] + out.lighting.indirect[i];
    const glm::dvec3 seen = g.at(g.emission, i) + g.at(g.albedo, i) / std::numbers::pi * e;
    const glm::dvec3 by_cone = out.lighting.glossy[i];
    for (const double v : {seen.x, seen.y, seen.z, 1.0}) colour.push_back(static_cast<float>(v));
    for (const double v : {by_cone.x, by_cone.y, by_cone.z, 0.0}) fallback.push_back(static_cast<float>(v));
  }
  const std::vector<float> normals = screen_normals(g, input.scene.camera);
  const auto reflected = scene::reflect(*context.value(), p, {g.depth, normals, {}, colour, fallback, {}});
  if (!reflected) return reflected.status();
  const scene::ScreenOutput& r = reflected.value();
  io::Image seen{g.width, g.height, 1, {}};
  for (std::size_t i = 0; i < g.pixels(); ++i) {
    out.lighting.glossy[i] = {r.radiance[4 * i], r.radiance[4 * i + 1], r.radiance[4 * i + 2]};
    seen.pixels.push_back(r.radiance[4 * i + 3]);
  }
  out.buffers["reflected_on_screen"] = std::move(seen);
  for (const scene::ScreenStep& s : r.steps) out.times.push_back({"shade", s.name, s.ms});
  const auto count = [&](SsrOutcome o) { return r.counters[static_cast<std::size_t>(o)]; };
  out.notes.push_back(fmt::format("{} rays on the screen: {} hit, {} missed, {} left, {} came behind, {} capped; {} passed behind a surface",
                                  count(SsrOutcome::rays), count(SsrOutcome::hit), count(SsrOutcome::miss), count(SsrOutcome::left),
                                  count(SsrOutcome::behind), count(SsrOutcome::capped), count(SsrOutcome::hidden)));
  return rendered;
}

}  // namespace luxel::program

#include "tests/cases/bilateral_support.h"

#include <cmath>
#include <limits>

#include "bench/scene/images.h"
#include "host/module.h"
#include "tests/cases/bilateral_cases.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::cases {

BilateralImages bilateral_images(const BilateralParams& p, std::uint32_t seed, bool sky) {
  const int w = p.width, h = p.height, n = channels(p.format), g = channels(p.guide_format);
  BilateralImages m;
  m.src = scene::noise(w, h, n, seed);
  m.guide = scene::noise(w, h, g, seed + 1);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * w + x;
      // A floor that rises to a horizon above the image, a wall, and a box in front of both.
      const bool box = x > w / 3 && x < 2 * w / 3 && y > h / 4 && y < 3 * h / 4, wall = x >= w / 2;
      const double level = box ? 0.75 : wall ? 0.4 : 0.05;
      for (int c = 0; c < n; ++c) m.src[i * n + c] = level + 0.25 * m.src[i * n + c];
      for (int c = 0; c < g; ++c) m.guide[i * g + c] = level + 0.1 * m.guide[i * g + c];
      double z = box ? 3 : wall ? 4 + 0.02 * x : 20.0 / (y + 4);
      if (sky && x < w / 4 && y < h / 4) z = x == 1 && y == 1 ? HUGE_VAL : 1e10;
      m.depth.push_back(z);
      const double normal[3] = {wall && !box ? -0.8 : 0.0, wall || box ? 0.0 : 1.0, box ? 1.0 : wall ? 0.6 : 0.0};
      for (const double v : normal) m.normals.push_back(v);
      m.normals.push_back(0);
      m.variance.push_back(0.001 + 0.02 * scene::random01(static_cast<std::uint32_t>(i), seed + 2));
    }
  m.src = quantise(m.src, p.format);
  m.guide = quantise(m.guide, p.guide_format);
  m.depth = quantise(m.depth, Format::f32x1);
  m.variance = quantise(m.variance, Format::f32x1);
  if (p.normal_format == Format::unorm8x4) {
    for (double& v : m.normals) v = v / 2 + 0.5;
    m.normals = quantise(m.normals, p.normal_format);
    for (double& v : m.normals) v = 2 * v - 1;
  } else {
    m.normals = quantise(m.normals, p.normal_format);
  }
  return m;
}

Result<Filtered> filter(Context& context, const BilateralParams& p, const BilateralImages& images) {
  return filter(context, p, images, context.profile());
}

Result<Filtered> filter(Context& context, const BilateralParams& p, const BilateralImages& images,
                        const Profile& profile) {
  Result<Run> made = Run::make(context, plan(p, profile));
  if (!made) return made.status();
  Run& run = made.value();
  Values normals = images.normals;
  if (p.normal_format == Format::unorm8x4)
    for (double& v : normals) v = v / 2 + 0.5;
  const double unwritten = p.format == Format::unorm8x4 ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  const int stride = p.dst_stride > 0 ? p.dst_stride : p.width;
  const Values nothing((static_cast<std::size_t>(p.height - 1) * stride + p.width) * channels(p.format), unwritten);
  const Values zeros(4, 0.0);
  const std::pair<const char*, const Values*> inputs[] = {
      {"src", &images.src},           {"guide", &images.guide}, {"depth", &images.depth}, {"normals", &normals},
      {"variance", &images.variance}, {"dst", &nothing},        {"counters", &zeros}};
  const auto has = [&](std::string_view name) {
    for (const Resource& r : run.plan().resources)
      if (r.name == name) return true;
    return false;
  };
  for (const auto& [name, values] : inputs)
    if (has(name))
      if (Status status = run.write(name, *values); !status) return status;
  if (Status status = run.go(); !status) return status;
  Filtered out;
  out.part = run.plan().passes.back().module->part;
  const std::pair<const char*, Values*> outputs[] = {
      {"dst", &out.dst}, {"variance_out", &out.variance_out}, {"counters", &out.counters}};
  for (const auto& [name, values] : outputs)
    if (has(name)) {
      Result<Values> read = run.read(name);
      if (!read) return read.status();
      *values = std::move(read).value();
    }
  return out;
}

BilateralParams bilateral_params(int width, int height, const std::string& terms, Format format, Border border) {
  BilateralParams p;
  p.width = width;
  p.height = height;
  p.format = format;
  p.border = border;
  p.radius = 4;
  p.sigma_space = 2;
  p.sigma_range = 0.2;
  p.footprint = 2.0 / height;
  p.sigma_normal = 16;
  p.sigma_luminance = 2;
  p.range = RangeTerm::off;
  for (const char term : terms) {
    if (term == 'c') p.range = RangeTerm::self;
    if (term == 'g') p.range = RangeTerm::guide;
    if (term == 'd') p.depth = DepthTerm::plane;
    if (term == 's') p.depth = DepthTerm::svgf;
    if (term == 'n') p.normal = true;
    if (term == 'l') p.luminance = true;
  }
  return p;
}

}  // namespace luxel::cases

#include "bench/scene/lpv_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench/io/pixels.h"

namespace luxel::scene {
namespace {

using glm::dvec3;

double since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Result<std::shared_ptr<Memory>> LpvScene::make(Format format, std::size_t count, const void* data, bool kept) {
  Resource r{"volume"};
  r.format = format;
  r.bytes = std::max<std::size_t>(count, 1) * bytes_per_pixel(format);
  auto memory = context_->make(r);
  if (!memory) return memory.status();
  if (kept) bytes_ += r.bytes;
  if (data != nullptr && count > 0)
    if (Status s = context_->upload(*memory.value(), data, count * bytes_per_pixel(format)); !s) return s;
  return memory;
}

Status LpvScene::run(const Result<Plan>& plan, const std::vector<Named>& resources, const char* name,
                     std::vector<LpvStep>& steps) {
  if (!plan) return plan.status();
  auto program = context_->compile(plan.value());
  if (!program) return program.status();
  scratch_ = std::max(scratch_, plan.value().scratch_bytes);
  Times times;
  if (Status s = context_->run(*program.value(), resources, &times); !s) return s;
  double ms = 0;
  for (const double pass : times.passes) ms += pass;
  steps.push_back({name, times.passes.empty() ? times.total : ms});
  return {};
}

void LpvScene::place() {
  const Bounds box = bounds(rays_->scene());
  const dvec3 size = box.high - box.low;
  const double longest = std::max({size.x, size.y, size.z, 1e-9});
  const int n = settings_.resolution;
  if (settings_.cascades == 1) {
    // A quarter of a cell is left at each end, so that no surface lies on the grid's own sides.
    LpvGrid g;
    g.cell = longest / (n - 0.5);
    for (int a = 0; a < 3; ++a) {
      g.extent[static_cast<std::size_t>(a)] = std::clamp(static_cast<int>(std::ceil(size[a] / g.cell + 0.5)), 1, n);
      origin_[a] = (box.low[a] + box.high[a]) / 2 - g.cell * g.extent[static_cast<std::size_t>(a)] / 2;
    }
    grids_ = {g};
    return;
  }
  double reach = 1e-9;
  for (int a = 0; a < 3; ++a)
    reach = std::max({reach, box.high[a] - settings_.centre[a], settings_.centre[a] - box.low[a]});
  const double coarsest = 2 * reach / (n - 1.5);
  origin_ = settings_.centre;
  grids_ = lpv_cascades({n, n, n}, std::ldexp(coarsest, 1 - settings_.cascades), {0, 0, 0}, settings_.cascades);
}

int LpvScene::iterations() const {
  const auto& e = grids_[0].extent;
  return settings_.iterations > 0 ? settings_.iterations : std::max({e[0], e[1], e[2]});
}

Result<LpvScene> LpvScene::build(std::shared_ptr<Context> context, const Rays& rays, const LpvSceneSettings& settings) {
  LpvScene made(std::move(context), rays, settings);
  made.place();
  made.geometry_.resize(made.grids_.size());
  if (settings.blockers == LpvBlockers::none || settings.blockers == LpvBlockers::maps) return made;
  // Static surfaces, once: four pieces and more in a cell's face of the finest grid.
  const auto start = std::chrono::steady_clock::now();
  if (settings.blockers == LpvBlockers::surfaces)
    made.pieces_ = surface_pieces(rays.scene(), std::max(made.grids_[0].cell * made.grids_[0].cell / 4, 1e-30));
  made.build_steps_.push_back({"pieces", since(start)});
  for (std::size_t k = 0; k < made.grids_.size(); ++k)
    if (Status s = made.block(k, made.pieces_, {}, made.build_steps_); !s) return s;
  return made;
}

Status LpvScene::block(std::size_t k, const std::vector<VirtualLight>& pieces, const std::vector<VirtualLight>& more,
                       std::vector<LpvStep>& steps) {
  LpvInjectGeometryParams p;
  p.grid = grids_[k];
  p.format = settings_.format;
  p.two_sided = settings_.two_sided;
  constexpr std::size_t most = 1 << 22;
  if (pieces.size() + more.size() > most)
    return Status(Code::unsupported, "more than 4194304 pieces of surfaces; take a coarser grid");
  p.surfels = {static_cast<int>(pieces.size()), static_cast<int>(more.size()), 0, 0};
  std::vector<float> list = surfels_list(pieces, origin_);
  const std::vector<float> second = surfels_list(more, origin_);
  list.insert(list.end(), second.begin(), second.end());
  auto surfels = make(Format::f32x4, list.size() / 4, list.data(), false);
  if (!surfels) return surfels.status();
  if (!geometry_[k]) {
    auto volume = make(p.format, lpv_geometry_pixels(p.grid), nullptr);
    if (!volume) return volume.status();
    geometry_[k] = volume.value();
  }
  return run(plan(p, context_->profile()), {{"surfels", surfels.value()}, {"geometry", geometry_[k]}}, "lpv_inject_geometry", steps);
}

LpvSampleParams LpvScene::look_up(const LpvSampleParams& knobs, std::size_t receivers) const {
  LpvSampleParams p = knobs;
  p.grids = grids_;
  p.bands = settings_.bands;
  p.channels = channels_;
  p.format = settings_.format;
  p.per_area = true;
  p.receivers = static_cast<int>(std::max<std::size_t>(receivers, 1));
  return p;
}

Status LpvScene::light(const LpvSampleParams& knobs, const std::vector<float>& receivers) {
  light_steps_.clear();
  const auto start = std::chrono::steady_clock::now();
  RsmSettings maps = settings_.maps;
  const auto& e = grids_[0].extent;
  // Over the whole scene, in cells of the finest grid; what is beyond 4096 would be no map.
  const int along = std::min(1024, settings_.cascades == 1 ? std::max({e[0], e[1], e[2]}) : settings_.resolution << (settings_.cascades - 1));
  if (maps.sun_texels <= 0) maps.sun_texels = 4 * along;
  if (maps.sky_texels <= 0) maps.sky_texels = along;
  if (maps.lamp_rays <= 0) maps.lamp_rays = std::min(1 << 22, std::max(4096, 16 * along * along));
  lights_ = reflective_shadow_maps(*rays_, maps);
  light_steps_.push_back({"maps", since(start)});
  double flux_max = 0;
  bool grey = true;
  for (const VirtualLight& l : lights_) {
    flux_max = std::max({flux_max, l.flux.x, l.flux.y, l.flux.z});
    grey = grey && static_cast<float>(l.flux.x) == static_cast<float>(l.flux.y) && static_cast<float>(l.flux.x) == static_cast<float>(l.flux.z);
  }
  flux_max = std::clamp(flux_max * (1 + 1e-6), 1e-30, 1e30);
  channels_ = grey && settings_.find_grey ? 1 : 3;
  if (lights_.size() > 1 << 24) return Status(Code::unsupported, "more than 16777216 small lights; take smaller maps");

  const LpvSampleParams shape = look_up(knobs, 1);
  const std::size_t needed = lpv_sample_offset(shape, static_cast<int>(grids_.size()));
  if (light_bytes_ != needed * bytes_per_pixel(settings_.format)) {
    bytes_ -= light_bytes_;
    auto made = make(settings_.format, needed, nullptr);
    if (!made) return made.status();
    light_ = made.value();
    light_bytes_ = needed * bytes_per_pixel(settings_.format);
  }
  const std::vector<float> list = lights_list(lights_, origin_);
  auto held = make(Format::f32x4, list.size() / 4, list.data(), false);
  if (!held) return held.status();
  run_ = receivers.empty() ? std::vector<bool>(grids_.size(), true) : lpv_cascades_read(shape, receivers);
  for (std::size_t k = 0; k < grids_.size(); ++k) {
    if (!run_[k]) continue;
    if (settings_.moving && settings_.blockers == LpvBlockers::surfaces)
      if (Status s = block(k, pieces_, {}, light_steps_); !s) return s;
    if (settings_.blockers == LpvBlockers::maps)
      if (Status s = block(k, lights_, settings_.seen, light_steps_); !s) return s;
    if (Status s = fill(k, held.value(), flux_max); !s) return s;
  }
  return {};
}

Status LpvScene::fill(std::size_t k, const std::shared_ptr<Memory>& list, double flux_max) {
  LpvInjectParams in;
  in.grid = grids_[k];
  in.lights = static_cast<int>(lights_.size());
  in.bands = settings_.bands;
  in.channels = channels_;
  in.format = settings_.format;
  in.flux_max = flux_max;
  const std::size_t pixels = lpv_pixels(in.grid, in.bands, in.channels);
  auto injected = make(in.format, pixels, nullptr, false);
  if (!injected) return injected.status();
  if (Status s = run(plan(in, context_->profile()), {{"lights", list}, {"injected", injected.value()}}, "lpv_inject", light_steps_); !s)
    return s;
  LpvPropagateParams p;
  p.grid = grids_[k];
  p.bands = settings_.bands;
  p.channels = channels_;
  p.format = settings_.format;
  p.iterations = iterations();
  p.lobes = settings_.lobes;
  p.geometry = geometry_[k] != nullptr;
  p.geometry_format = settings_.format;
  p.keep_injected = settings_.keep_injected;
  const std::size_t first = lpv_sample_offset(look_up({}, 1), static_cast<int>(k));
  std::vector<Named> named{{"injected", injected.value()}};
  if (p.geometry) named.push_back({"geometry", geometry_[k]});
  std::shared_ptr<Memory> sharp;
  if (settings_.filter > 0) {
    auto made = make(p.format, pixels, nullptr, false);
    if (!made) return made.status();
    sharp = made.value();
    named.push_back({"result", sharp});
  } else {
    named.push_back({"result", light_, first});
  }
  if (Status s = run(plan(p, context_->profile()), named, "lpv_propagate", light_steps_); !s) return s;
  if (settings_.filter == 0) return {};
  LpvFilterParams f;
  f.grid = grids_[k];
  f.bands = settings_.bands;
  f.channels = channels_;
  f.format = settings_.format;
  f.weight = settings_.filter;
  return run(plan(f, context_->profile()), {{"src", sharp}, {"dst", light_, first}}, "lpv_filter", light_steps_);
}

Result<LpvScene::Seen> LpvScene::sample(const LpvSampleParams& knobs, const std::vector<float>& receivers,
                                        const std::vector<float>& views) {
  shade_steps_.clear();
  const std::size_t count = receivers.size() / 8;
  Seen seen;
  if (count == 0) return seen;
  LpvSampleParams p = look_up(knobs, count);
  if (views.empty()) p.glossy_steps = 0;
  p.count = false;
  auto places = make(Format::f32x4, 2 * count, receivers.data(), false), out = make(Format::f32x4, count, nullptr, false);
  if (!places) return places.status();
  if (!out) return out.status();
  std::vector<Named> named{{"light", light_}, {"receivers", places.value()}, {"irradiance", out.value()}};
  std::shared_ptr<Memory> glossy;
  if (p.glossy_steps > 0) {
    auto eyes = make(Format::f32x4, count, views.data(), false), made = make(Format::f32x4, count, nullptr, false);
    if (!eyes) return eyes.status();
    if (!made) return made.status();
    glossy = made.value();
    named.insert(named.end(), {{"views", eyes.value()}, {"specular", glossy}});
  }
  if (Status s = run(plan(p, context_->profile()), named, "lpv_sample", shade_steps_); !s) return s;
  seen.irradiance.resize(4 * count);
  if (Status s = context_->download(*out.value(), seen.irradiance.data(), 16 * count); !s) return s;
  if (glossy) {
    seen.glossy.resize(4 * count);
    if (Status s = context_->download(*glossy, seen.glossy.data(), 16 * count); !s) return s;
  }
  return seen;
}

Result<std::vector<float>> LpvScene::volume(std::size_t cascade) {
  const LpvSampleParams shape = look_up({}, 1);
  const std::size_t pixels = lpv_pixels(grids_[cascade], settings_.bands, channels_), pixel = bytes_per_pixel(settings_.format);
  const std::size_t all = lpv_sample_offset(shape, static_cast<int>(grids_.size())), first = lpv_sample_offset(shape, static_cast<int>(cascade));
  std::vector<std::uint8_t> bytes(all * pixel);
  if (Status s = context_->download(*light_, bytes.data(), bytes.size()); !s) return s;
  return io::unpack({bytes.data() + first * pixel, pixels * pixel}, settings_.format, false, 4);
}

}  // namespace luxel::scene

#include "bench/scene/probe_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "tests/cases/storage.h"

namespace luxel::scene {
namespace {

using glm::dvec3;

#define TRY(status) \
  do { \
    if (Status s_ = (status); !s_) return s_; \
  } while (false)

constexpr int lamp_pieces = 64;  // as VoxelSceneSettings has them

class Watch {
 public:
  double ms() const { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

std::array<int, 3> probe_cubes(const Scene& scene, int longest) {
  const Bounds box = bounds(scene);
  const dvec3 side = box.high - box.low;
  const double most = std::max({side.x, side.y, side.z, 1e-30});
  std::array<int, 3> count{};
  for (int k = 0; k < 3; ++k) count[static_cast<std::size_t>(k)] = std::max(1, static_cast<int>(std::lround(longest * side[k] / most)));
  return count;
}

Result<ProbeScene> ProbeScene::build(std::shared_ptr<Context> context, const Rays& rays, const ProbeSceneSettings& settings) {
  if (context->real64()) return Status(Code::unsupported, "cpu:double: scenes in probes are made in f32");
  ProbeScene made(std::move(context), rays, settings);
  if (Status s = made.cast(); !s) return s;
  return made;
}

std::size_t ProbeScene::dead() const {
  return static_cast<std::size_t>(std::count(probes_.alive.begin(), probes_.alive.end(), 0));
}

std::size_t ProbeScene::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [name, held] : memories_)
    if (name != "receivers" && name != "lit" && name != "counters") bytes += held.bytes;
  return bytes;
}

Status ProbeScene::put(const std::string& name, Format format, std::size_t count, const void* data) {
  Resource r{name};
  r.format = format;
  r.bytes = std::max<std::size_t>(count, 1) * bytes_per_pixel(format);
  Held& held = memories_[name];
  if (!held.memory || held.bytes < r.bytes) {
    auto memory = context_->make(r);
    if (!memory) return memory.status();
    held = {memory.value(), r.bytes};
  }
  return data != nullptr && count > 0 ? context_->upload(*held.memory, data, count * bytes_per_pixel(format)) : Status();
}

Status ProbeScene::run(const Result<Plan>& plan, const std::map<std::string, std::string>& names, const char* step,
                       std::vector<ProbeStep>& steps) {
  if (!plan) return plan.status();
  std::vector<Named> named;
  for (const Resource& r : plan.value().resources) {
    const auto other = names.find(r.name);
    const std::string& name = other == names.end() ? r.name : other->second;
    if (memories_[name].bytes < r.bytes) TRY(put(name, r.format, r.bytes / bytes_per_pixel(r.format), nullptr));
    named.push_back({r.name, memories_[name].memory});
  }
  auto program = context_->compile(plan.value());
  if (!program) return program.status();
  Times times;
  TRY(context_->run(*program.value(), named, &times));
  double ms = 0;
  for (const double pass : times.passes) ms += pass;
  steps.push_back({step, times.passes.empty() ? times.total : ms});
  return {};
}

Status ProbeScene::cast() {
  const Watch placing;
  const Scene& scene = rays_->scene();
  probes_ = place_probes(scene, settings_.count);
  if (settings_.find_dead) find_dead_probes(probes_, *rays_);
  build_steps_.push_back({"probes placed", placing.ms()});
  sky_ = !scene.sky.dark();
  std::size_t emitting = 0;
  for (std::size_t i = 0; i < scene.indices.size(); ++i) emitting += scene.material_of(i).emission != dvec3(0) && finite(scene, i);
  lamps_ = emitting > 0 && !sky_ && emitting <= lamp_pieces;
  seen_directly_ = sky_ || emitting > 0;
  lights_ = voxel_lights_of(scene, lamps_ ? lamp_pieces : 1);
  if (!lamps_) std::erase_if(lights_, [](const VoxelLight& l) { return l.kind == VoxelLight::Kind::patch; });
  filter_ = settings_.filter;
  filter_.grid = probes_.grid;
  filter_.maps = {settings_.size, 1, ProbeRadiance::f16x4, ProbeDistance::f32, ProbeNormal::none};
  filter_.listed = dead() > 0 ? static_cast<int>(probes_.size() - dead()) : 0;
  if (dead() == probes_.size()) return Status(Code::invalid_argument, "every probe lies inside geometry; expected another number of probes");
  TRY(validate(filter_));

  const Watch casting;
  ProbeHits hits = cast_probes(probes_, *rays_, settings_.size);
  distance_ = std::move(hits.distance);
  if (settings_.bounces > 1) {
    albedo_.assign(3 * distance_.size(), 0);
    seen_.assign(8 * distance_.size(), 0);
    const std::size_t each = static_cast<std::size_t>(settings_.size) * static_cast<std::size_t>(settings_.size);
    std::vector<std::thread> threads;
    const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
    for (std::size_t t = 0; t < count; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t i = t; i < distance_.size(); i += count) {
          const dvec3 d = texel_direction(static_cast<int>(i % each) % settings_.size, static_cast<int>(i % each) / settings_.size, settings_.size);
          const auto hit = rays_->first(probes_.centres[i / each], d);
          if (!hit) continue;
          const dvec3 a = scene.surface(hit->triangle, hit->b1, hit->b2).albedo;
          for (int k = 0; k < 3; ++k) {
            const std::size_t c = static_cast<std::size_t>(k);
            albedo_[3 * i + c] = a[k];
            seen_[8 * i + c] = static_cast<float>(hit->position[k]);
            seen_[8 * i + 4 + c] = static_cast<float>(hit->normal[k]);
          }
        }
      });
    for (std::thread& thread : threads) thread.join();
  }
  build_steps_.push_back({"rays cast", casting.ms()});
  if (probes_.grid.placed) {
    std::vector<float> positions;
    for (const double v : probes_.positions()) positions.push_back(static_cast<float>(v));
    TRY(put("positions", Format::f32x4, probes_.size(), positions.data()));
  }
  if (filter_.listed > 0) {
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i < probes_.size(); ++i)
      if (probes_.alive[i] != 0) list.push_back(static_cast<std::uint32_t>(i));
    TRY(put("list", Format::u32, list.size(), list.data()));
  }
  std::vector<float> distance;
  for (const double d : distance_) distance.push_back(std::isfinite(d) ? static_cast<float>(d) : 1e30f);
  return put("distance", Format::f32x1, distance.size(), distance.data());
}

// Radiance of the texels into maps of irradiance.
Status ProbeScene::gather(const std::vector<double>& radiance, const std::string& to, bool moments) {
  const auto data = cases::store(radiance, Format::f16x4, false);
  TRY(put("radiance", Format::f16x4, radiance.size() / 4, data.data()));
  ProbeIrradianceParams p = filter_;
  if (!moments) p.moments_size = 0;
  return run(plan(p, context_->profile()), {{"irradiance", to}}, moments ? "irradiance and distances" : "irradiance", light_steps_);
}

Status ProbeScene::light() {
  light_steps_.clear();
  const Watch lighting;
  ProbeLight light;
  light.sky_samples = sky_ ? settings_.sky_samples : 0;
  const std::vector<double> first = cast_probes(probes_, *rays_, settings_.size, &light).radiance;
  light_steps_.push_back({"light on what is seen", lighting.ms()});
  TRY(gather(first, "irradiance", filter_.moments_size > 0));
  for (int bounce = 1; bounce < settings_.bounces; ++bounce) {
    const auto lit = lit_by("irradiance", shade_params(settings_.bounce, distance_.size()), seen_, "probes lit by probes", light_steps_);
    if (!lit) return lit.status();
    std::vector<double> radiance = first;
    for (std::size_t i = 0; i < radiance.size(); ++i)
      if (i % 4 < 3) radiance[i] += albedo_[i / 4 * 3 + i % 4] / std::numbers::pi * static_cast<double>(lit.value()[i]);
    TRY(gather(radiance, "irradiance", false));
  }
  if (!seen_directly_) return {};
  ProbeLight own;
  own.reflected = false;
  own.emitted = own.sky = true;
  return gather(cast_probes(probes_, *rays_, settings_.size, &own).radiance, "direct_irradiance", false);
}

ProbeShadeParams ProbeScene::shade_params(const ProbeShadeParams& knobs, std::size_t receivers) const {
  ProbeShadeParams p = knobs;
  p.grid = probes_.grid;
  p.width = static_cast<int>(std::min<std::size_t>(receivers, 1 << 14));
  p.height = static_cast<int>((receivers + static_cast<std::size_t>(p.width) - 1) / static_cast<std::size_t>(p.width));
  p.irradiance_size = filter_.irradiance_size;
  p.irradiance_format = filter_.irradiance_format;
  if (filter_.moments_size > 0) p.moments_size = filter_.moments_size;
  else p.visibility = false;
  return p;
}

Result<std::vector<float>> ProbeScene::lit_by(const std::string& maps, const ProbeShadeParams& p, const std::vector<float>& receivers,
                                              const char* step, std::vector<ProbeStep>& steps) {
  std::vector<float> padded = receivers;
  padded.resize(8 * static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height), 0.0f);
  TRY(put("receivers", Format::f32x4, padded.size() / 4, padded.data()));
  TRY(run(plan(p, context_->profile()), {{"light", maps}, {"irradiance", "lit"}}, step, steps));
  std::vector<float> lit(receivers.size() / 2);
  TRY(context_->download(*memories_["lit"].memory, lit.data(), lit.size() * sizeof(float)));
  return lit;
}

Result<ProbeLit> ProbeScene::shade(const ProbeShadeParams& knobs, const std::vector<float>& receivers, bool direct) {
  shade_steps_.clear();
  ProbeShadeParams p = shade_params(knobs, receivers.size() / 8);
  ProbeLit out;
  if (p.count) {
    const std::vector<std::uint32_t> zeros(probe_shade_outcomes, 0);
    TRY(put("counters", Format::u32, zeros.size(), zeros.data()));
  }
  auto lit = lit_by("irradiance", p, receivers, "probe_shade", shade_steps_);
  if (!lit) return lit.status();
  out.indirect = std::move(lit).value();
  if (p.count) {
    out.counters.resize(probe_shade_outcomes);
    TRY(context_->download(*memories_["counters"].memory, out.counters.data(), out.counters.size() * 4));
    // Receivers that fill the last row are none.
    const auto spare = static_cast<std::uint32_t>(static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height) - receivers.size() / 8);
    out.counters[0] -= spare;
    out.counters[1] -= spare;
  }
  if (seen_directly_ && direct) {
    p.count = false;
    auto own = lit_by("direct_irradiance", p, receivers, "probe_shade of direct light", shade_steps_);
    if (!own) return own.status();
    out.direct = std::move(own).value();
  }
  return out;
}

}  // namespace luxel::scene

#include "tests/cases/cone_trace_support.h"

#include <algorithm>
#include <cmath>

#include <luxel/mip_build.h>

#include "bench/scene/images.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

MipBuildParams mips_of(const ConeTraceParams& p) {
  MipBuildParams m;
  m.width = p.extent[0];
  m.height = p.extent[1];
  m.depth = p.extent[2];
  m.levels = cone_trace_levels(p) - 1;
  m.variant = p.variant == ConeVariant::anisotropic ? MipVariant::anisotropic : MipVariant::isotropic;
  m.format = p.format;
  return m;
}

int directions(const ConeTraceParams& p) { return p.variant == ConeVariant::anisotropic ? 6 : 1; }

Resource buffer(const std::string& name, Format format, std::size_t count) {
  Resource r{name};
  r.format = format;
  r.bytes = count * bytes_per_pixel(format);
  return r;
}

// The texels of the buffer of coarse levels, where the atlas has them; 0 between.
Values atlas(const ConeTraceParams& p, const Values& coarse) {
  const auto e = cone_trace_atlas_extent(p);
  Values image(static_cast<std::size_t>(e[0]) * e[1] * e[2] * 4);
  for (int level = 1; level < cone_trace_levels(p); ++level)
    for (int d = 0; d < directions(p); ++d) {
      const auto at = cone_trace_atlas_offset(p, level, d), n = cone_trace_extent(p, level);
      const std::size_t from = cone_trace_level_offset(p, level, d);
      for (int z = 0; z < n[2]; ++z)
        for (int y = 0; y < n[1]; ++y)
          for (int x = 0; x < n[0]; ++x) {
            const std::size_t i = from + (static_cast<std::size_t>(z) * n[1] + y) * n[0] + x;
            const std::size_t j = (static_cast<std::size_t>(at[2] + z) * e[1] + at[1] + y) * e[0] + at[0] + x;
            std::copy_n(&coarse[i * 4], 4, &image[j * 4]);
          }
    }
  return image;
}

bool same(const ConeTraceParams& a, const ConeTraceParams& b) {
  const auto equal = [](const Cone& x, const Cone& y) {
    return x.direction == y.direction && x.weight == y.weight && x.aperture == y.aperture;
  };
  return a.width == b.width && a.height == b.height && a.extent == b.extent && a.levels == b.levels &&
         a.variant == b.variant && a.format == b.format && a.input == b.input && a.origin == b.origin &&
         a.voxel == b.voxel && a.pattern_x == b.pattern_x && a.pattern_y == b.pattern_y &&
         a.footprint == b.footprint && a.specular_footprint == b.specular_footprint && a.step_scale == b.step_scale && a.normal_offset == b.normal_offset && a.start == b.start &&
         a.max_distance == b.max_distance &&
         a.rotate == b.rotate && a.seed == b.seed && a.sky_size == b.sky_size && a.sky_levels == b.sky_levels &&
         a.sky_aperture == b.sky_aperture && a.gamma == b.gamma && a.environment == b.environment &&
         a.error == b.error && a.radiance_max == b.radiance_max && a.max_steps == b.max_steps &&
         a.radiance == b.radiance && a.occlusion == b.occlusion && a.specular == b.specular &&
         a.skip_empty == b.skip_empty && a.count == b.count &&
         std::equal(a.cones.begin(), a.cones.end(), b.cones.begin(), b.cones.end(), equal);
}

}  // namespace

Result<ConeScene::Held> ConeScene::hold(const Resource& resource, std::span<const double> values) {
  Result<std::shared_ptr<Memory>> memory = context_->make(resource);
  if (!memory) return memory.status();
  if (!values.empty()) {
    const std::vector<std::byte> data = store(values, resource.format, context_->real64());
    if (Status s = context_->upload(*memory.value(), data.data(), data.size()); !s) return s;
  }
  return Held{resource, memory.value()};
}

Result<ConeScene> ConeScene::make(Context& context, const ConeTraceParams& params, std::span<const double> level_0) {
  ConeScene scene;
  scene.context_ = &context;
  if (Status s = scene.build(params, level_0); !s) return s;
  return scene;
}

Result<ConeScene> ConeScene::make(Context& context, const ConeTraceParams& params, std::span<const std::byte> level_0) {
  ConeScene scene;
  scene.context_ = &context;
  const Resource resource = buffer("fine", params.format, level_0.size() / bytes_per_pixel(params.format));
  const Result<std::shared_ptr<Memory>> fine = context.make(resource);
  if (!fine) return fine.status();
  if (Status s = context.upload(*fine.value(), level_0.data(), level_0.size()); !s) return s;
  if (Status s = scene.build_coarse(params, {resource, fine.value()}); !s) return s;
  return scene;
}

Status ConeScene::build_coarse(const ConeTraceParams& p, const Held& fine) {
  const std::size_t fine_texels = static_cast<std::size_t>(p.extent[0]) * p.extent[1] * p.extent[2];
  const std::size_t coarse_texels = cone_trace_coarse_texels(p);
  volume_bytes_ = (fine_texels + coarse_texels) * bytes_per_pixel(p.format);
  held_ = {fine};
  if (cone_trace_levels(p) == 1) return {};
  Result<Held> coarse = hold(buffer("coarse", p.format, coarse_texels), {});
  if (!coarse) return coarse.status();
  held_.push_back(coarse.value());
  const MipBuildParams m = mips_of(p);
  const Result<Plan> made = plan(m, context_->profile());
  if (!made) return made.status();
  const Result<std::shared_ptr<Program>> program = context_->compile(made.value());
  if (!program) return program.status();
  std::vector<std::string> names;  // a Named holds no text of its own
  std::vector<std::size_t> offsets;
  for (int level = 1; level < cone_trace_levels(p); ++level)
    for (int d = 0; d < directions(p); ++d) {
      names.push_back(mip_level_name(level, directions(p) == 6 ? d : -1));
      offsets.push_back(cone_trace_level_offset(p, level, d));
    }
  std::vector<Named> named{{"level_0", fine.memory}};
  for (std::size_t i = 0; i < names.size(); ++i) named.push_back({names[i], coarse.value().memory, offsets[i]});
  // Drivers compile at the first dispatch: what is timed is the second.
  for (int runs = context_->info().api == Api::cpu ? 1 : 2; runs > 0; --runs)
    if (Status s = context_->run(*program.value(), named, &build_times_); !s) return s;
  return {};
}

Status ConeScene::build(const ConeTraceParams& p, std::span<const double> level_0) {
  Result<Held> fine = hold(buffer("fine", p.format, static_cast<std::size_t>(p.extent[0]) * p.extent[1] * p.extent[2]), level_0);
  if (!fine) return fine.status();
  if (Status s = build_coarse(p, fine.value()); !s) return s;
  if (p.input == Input::image) {
    Resource fine_image{"fine"}, coarse_image{"coarse"};
    fine_image.kind = coarse_image.kind = ResourceKind::sampled_image;
    fine_image.format = coarse_image.format = p.format;
    fine_image.extent = p.extent;
    fine = hold(fine_image, level_0);
    if (!fine) return fine.status();
    if (held_.size() > 1) {
      std::vector<std::byte> data(cone_trace_coarse_texels(p) * (context_->real64() ? 32 : bytes_per_pixel(p.format)));
      if (Status s = context_->download(*held_[1].memory, data.data(), data.size()); !s) return s;
      coarse_image.extent = cone_trace_atlas_extent(p);
      Result<Held> coarse = hold(coarse_image, atlas(p, fetch(data, p.format, context_->real64())));
      if (!coarse) return coarse.status();
      held_[1] = coarse.value();
    }
    held_[0] = fine.value();
  }
  return {};
}

Status ConeScene::receive(std::span<const double> receivers, std::span<const double> views) {
  std::erase_if(held_, [](const Held& h) { return h.resource.name == "receivers" || h.resource.name == "views"; });
  Result<Held> r = hold(buffer("receivers", Format::f32x4, receivers.size() / 4), receivers);
  if (!r) return r.status();
  held_.push_back(r.value());
  if (views.empty()) return {};
  r = hold(buffer("views", Format::f32x4, views.size() / 4), views);
  if (!r) return r.status();
  held_.push_back(r.value());
  return {};
}

Status ConeScene::shine(const std::vector<float>& sky) {
  std::erase_if(held_, [](const Held& h) { return h.resource.name == "sky"; });
  const Values values(sky.begin(), sky.end());
  Result<Held> r = hold(buffer("sky", Format::f32x4, values.size() / 4), values);
  if (r) held_.push_back(r.value());
  return r.status();
}

Status ConeScene::trace(const ConeTraceParams& p, int repeat, Times* times) {
  if (!has_program_ || !same(p, compiled_)) {
    const Result<Plan> made = plan(p, context_->profile());
    if (!made) return made.status();
    Result<std::shared_ptr<Program>> program = context_->compile(made.value());
    if (!program) return program.status();
    program_ = program.value();
    compiled_ = p;
    has_program_ = true;
    made_.clear();
    for (const Resource& resource : made.value().resources) {
      if (!resource.written) continue;
      Result<Held> held = hold(resource, {});
      if (!held) return held.status();
      made_.push_back(held.value());
    }
  }
  std::vector<Named> named;
  for (const Held& h : held_) {
    if (h.resource.name == "coarse" && cone_trace_levels(p) == 1) continue;
    if (h.resource.name == "views" && !p.specular) continue;
    if (h.resource.name == "sky" && p.sky_size == 0) continue;
    named.push_back({h.resource.name, h.memory});
  }
  for (const Held& h : made_) {
    if (h.resource.name == "counters") {
      const std::array<std::uint32_t, cone_outcomes> zeros{};
      if (Status s = context_->upload(*h.memory, zeros.data(), sizeof zeros); !s) return s;
    }
    named.push_back({h.resource.name, h.memory});
  }
  return context_->run_many(*program_, named, repeat, times);
}

Result<Values> ConeScene::read(const std::string& name) const {
  for (const Held& h : made_) {
    if (h.resource.name != name) continue;
    const bool doubles = context_->real64() && h.resource.format != Format::u32;
    std::vector<std::byte> data(h.resource.bytes * (doubles ? 2 : 1));
    if (Status s = context_->download(*h.memory, data.data(), data.size()); !s) return s;
    return fetch(data, h.resource.format, context_->real64());
  }
  return Status(Code::invalid_argument, "cone_trace wrote no " + name);
}

Result<ConeResult> trace(Context& context, const ConeTraceParams& p, std::span<const double> level_0,
                         std::span<const double> receivers, std::span<const double> views) {
  Result<ConeScene> scene = ConeScene::make(context, p, level_0);
  if (!scene) return scene.status();
  if (Status s = scene.value().receive(receivers, views); !s) return s;
  if (Status s = scene.value().trace(p); !s) return s;
  ConeResult result;
  const auto take = [&](bool wanted, const char* name, Values& to) {
    if (!wanted) return Status();
    Result<Values> values = scene.value().read(name);
    if (values) to = std::move(values).value();
    return values.status();
  };
  if (Status s = take(p.radiance || p.occlusion, "irradiance", result.irradiance); !s) return s;
  if (Status s = take(p.specular, "specular", result.specular); !s) return s;
  if (Status s = take(p.count, "counters", result.counters); !s) return s;
  return result;
}

ConeTraceParams cone_params(int n, ConeVariant variant, Format format) {
  ConeTraceParams p;
  p.width = 1;
  p.extent = {n, n, n};
  p.variant = variant;
  p.format = format;
  p.voxel = 1.0 / n;
  return p;
}

void add_receiver(Values& receivers, std::array<double, 3> position, std::array<double, 3> normal, double roughness) {
  receivers.insert(receivers.end(), position.begin(), position.end());
  receivers.push_back(roughness);
  receivers.insert(receivers.end(), normal.begin(), normal.end());
  receivers.push_back(0);
}

Values cone_receivers(const ConeTraceParams& p, int count, std::uint32_t seed) {
  Values receivers;
  for (int i = 0; i < count; ++i) {
    const auto random = [&](int k) { return scene::random01(static_cast<std::uint32_t>(i * 8 + k), seed); };
    std::array<double, 3> position, normal;
    for (int axis = 0; axis < 3; ++axis) {
      position[axis] = static_cast<float>(p.origin[axis] + p.voxel * p.extent[axis] * random(axis));
      normal[axis] = static_cast<float>(2 * random(3 + axis) - 1);
    }
    if (i % 7 == 0) normal = {0, 0, i % 2 == 0 ? 1.0 : -1.0};
    add_receiver(receivers, position, normal, static_cast<float>(random(6)));
  }
  return receivers;
}

Values uniform_volume(int n, std::array<double, 4> value) {
  Values values;
  for (int i = 0; i < n * n * n; ++i) values.insert(values.end(), value.begin(), value.end());
  return values;
}

std::vector<NamedSet> cone_sets() {
  std::vector<NamedSet> sets;
  for (const int n : {1, 4, 5, 6, 8, 9, 16, 25}) sets.push_back({std::to_string(n), cone_set(n).value()});
  sets.push_back({"classic 6", classic_cones()});
  return sets;
}

}  // namespace luxel::cases

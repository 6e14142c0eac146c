#include "bench/scene/voxel_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include <luxel/mip_build.h>

#include "bench/io/pixels.h"

namespace luxel::scene {
namespace {

using glm::dvec3;

std::array<double, 3> array_of(dvec3 v) { return {v.x, v.y, v.z}; }

double luminance(dvec3 c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

// Quarters of a triangle until the largest has at most `area`.
void add_pieces(dvec3 a, dvec3 b, dvec3 c, double area, dvec3 radiance, std::vector<VoxelLight>& lights) {
  const dvec3 across = glm::cross(b - a, c - a);
  const double mine = glm::length(across) / 2;
  if (!(mine > 0)) return;
  if (mine > area) {
    const dvec3 ab = (a + b) / 2.0, bc = (b + c) / 2.0, ca = (c + a) / 2.0;
    add_pieces(a, ab, ca, area, radiance, lights);
    add_pieces(ab, b, bc, area, radiance, lights);
    add_pieces(ca, bc, c, area, radiance, lights);
    add_pieces(ab, bc, ca, area, radiance, lights);
    return;
  }
  for (const double side : {1.0, -1.0})
    lights.push_back({VoxelLight::Kind::patch, array_of((a + b + c) / 3.0), array_of(radiance * mine),
                      array_of(side * across), mine});
}

std::size_t emitting_triangles(const Scene& scene) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.indices.size(); ++i)
    count += scene.material_of(i).emission != dvec3(0) && finite(scene, i);
  return count;
}

}  // namespace

std::vector<VoxelLight> voxel_lights_of(const Scene& scene, int pieces) {
  std::vector<VoxelLight> lights;
  if (scene.sun.irradiance != dvec3(0))
    lights.push_back({VoxelLight::Kind::sun, array_of(scene.sun.direction), array_of(scene.sun.irradiance), {}, 0});
  double area = 0;
  const auto each = [&](auto&& take) {
    for (std::size_t i = 0; i < scene.indices.size(); ++i) {
      const dvec3 radiance = scene.material_of(i).emission;
      if (radiance == dvec3(0) || !finite(scene, i)) continue;
      const glm::uvec3 t = scene.indices[i];
      take(scene.positions[t.x], scene.positions[t.y], scene.positions[t.z], radiance);
    }
  };
  each([&](dvec3 a, dvec3 b, dvec3 c, dvec3) { area += glm::length(glm::cross(b - a, c - a)) / 2; });
  // Quartering leaves pieces of a quarter to the whole of this area.
  each([&](dvec3 a, dvec3 b, dvec3 c, dvec3 radiance) { add_pieces(a, b, c, 2 * area / pieces, radiance, lights); });
  return lights;
}

VoxelScene::VoxelScene(std::shared_ptr<Context> context, const Scene& scene, const VoxelSceneSettings& settings)
    : context_(std::move(context)),
      scene_(scene),
      settings_(settings),
      grid_(grid_around(scene, settings.resolution)) {}

Result<VoxelScene> VoxelScene::build(std::shared_ptr<Context> context, const Scene& scene,
                                     const VoxelSceneSettings& settings) {
  VoxelScene made(std::move(context), scene, settings);
  if (Status s = made.voxelize(); !s) return s;
  return made;
}

std::size_t VoxelScene::memory_bytes() const { return bytes_; }

Result<std::shared_ptr<Memory>> VoxelScene::make(Format format, std::size_t count, const void* data) {
  Resource r{"volume"};
  r.format = format;
  r.bytes = std::max<std::size_t>(count, 1) * bytes_per_pixel(format);
  auto memory = context_->make(r);
  if (!memory) return memory.status();
  bytes_ += r.bytes;
  if (data != nullptr && count > 0)
    if (Status s = context_->upload(*memory.value(), data, count * bytes_per_pixel(format)); !s) return s;
  return memory;
}

Status VoxelScene::run(const Plan& plan, const std::vector<Named>& resources, const char* name,
                       std::vector<VoxelStep>& steps) {
  auto program = context_->compile(plan);
  if (!program) return program.status();
  Times times;
  if (Status s = context_->run(*program.value(), resources, &times); !s) return s;
  double ms = 0;
  for (const double pass : times.passes) ms += pass;
  steps.push_back({name, times.passes.empty() ? times.total : ms});
  return {};
}

Status VoxelScene::voxelize() {
  auto made = scene_voxels(scene_, grid_, true);
  if (!made) return made.status();
  const SceneVoxels& voxels = made.value();
  skipped_ = voxels.triangles.not_finite;
  VoxelizeParams p = voxels.params;
  p.mode = settings_.mode;
  p.format = settings_.format;
  p.normal = true;
  p.emission = p.emission || settings_.keep.emission;
  emission_ = p.emission;
  auto plan = luxel::plan(p, context_->profile());
  if (!plan) return plan.status();

  std::vector<Named> named;
  for (const Resource& r : plan.value().resources) {
    const void* data = r.name == "triangles"       ? static_cast<const void*>(voxels.triangles.records.data())
                       : r.name == "materials"     ? static_cast<const void*>(voxels.materials.data())
                       : r.name == "uvs"           ? static_cast<const void*>(voxels.triangles.uvs.data())
                       : r.name == "texture_table" ? static_cast<const void*>(voxels.textures.table.data())
                       : r.name == "texels"        ? static_cast<const void*>(voxels.textures.texels.data())
                                                   : nullptr;
    const bool nothing = voxels.triangles.count == 0 && (r.name == "triangles" || r.name == "uvs");
    auto memory = make(r.format, r.bytes / bytes_per_pixel(r.format), nothing ? nullptr : data);
    if (!memory) return memory.status();
    named.push_back({r.name, memory.value()});
    if (r.name == "colour") colour_ = memory.value();
    if (r.name == "normal") normal_ = memory.value();
    if (r.name == "emission") emitted_ = memory.value();
    if (r.name == "bricks") brick_list_ = memory.value();
    if (r.name == "counters") counters_ = memory.value();
  }
  if (Status s = run(plan.value(), named, "voxelize", build_steps_); !s) return s;
  std::uint32_t counts[16];
  if (Status s = context_->download(*counters_, counts, sizeof counts); !s) return s;
  occupied_ = counts[static_cast<int>(VoxelizeCount::occupied)];
  bricks_ = static_cast<int>(std::clamp<std::uint32_t>(counts[static_cast<int>(VoxelizeCount::bricks)], 1,
                                                       static_cast<std::uint32_t>(p.bricks)));
  return {};
}

// Depths seen from the sun, in voxels.
std::vector<float> VoxelScene::shadow_map(const VoxelShadow& shadow) {
  const dvec3 right(shadow.to_x[0], shadow.to_x[1], shadow.to_x[2]), up(shadow.to_y[0], shadow.to_y[1], shadow.to_y[2]),
      away(shadow.to_depth[0], shadow.to_depth[1], shadow.to_depth[2]);
  const dvec3 origin(grid_.origin[0], grid_.origin[1], grid_.origin[2]);
  const std::size_t width = static_cast<std::size_t>(shadow.width), height = static_cast<std::size_t>(shadow.height);
  std::vector<float> depths(width * height, 1e30f);
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::jthread> threads;
  const std::size_t count = std::max(1u, std::thread::hardware_concurrency());
  for (std::size_t t = 0; t < count; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t y = t; y < height; y += count)
        for (std::size_t x = 0; x < width; ++x) {
          const dvec3 p = (static_cast<double>(x) + 0.5 - shadow.to_x[3]) / glm::dot(right, right) * right +
                          (static_cast<double>(y) + 0.5 - shadow.to_y[3]) / glm::dot(up, up) * up - shadow.to_depth[3] * away;
          const auto hit = settings_.rays->first(origin + grid_.voxel * p, away);
          if (hit) depths[y * width + x] = static_cast<float>(hit->distance / grid_.voxel);
        }
    });
  threads.clear();
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
  light_steps_.push_back({"shadow map", passed.count()});
  return depths;
}

Status VoxelScene::inject(Pyramid& pyramid, bool emission, const std::vector<VoxelLight>& lights,
                          const std::vector<float>& map, const char* name) {
  VoxelInjectParams p;
  p.width = grid_.width;
  p.height = grid_.height;
  p.depth = grid_.depth;
  p.format = settings_.format;
  p.bricks = bricks_;
  p.voxel = grid_.voxel;
  p.emission = emission;
  p.lights = static_cast<int>(lights.size());
  p.two_sided = settings_.two_sided;
  p.clear = !pyramid.fine;
  const bool shadowed = settings_.rays != nullptr && !lights.empty() && lights.front().kind == VoxelLight::Kind::sun;
  if (shadowed) p.shadow = voxel_shadow({p.width, p.height, p.depth}, lights.front().place, settings_.shadow_texels);
  if (!map.empty()) {
    p.map_width = 1024;
    p.map_height = static_cast<int>(map.size() / 8 / 1024);
    p.irradiance_max = 1e-6;
    for (std::size_t i = 0; i < map.size(); i += 8)
      for (std::size_t c = 4; c < 7; ++c) p.irradiance_max = std::max<double>(p.irradiance_max, map[i + c]);
  }
  auto plan = luxel::plan(p, context_->profile());
  if (!plan) return plan.status();
  std::vector<Named> named{{"colour", colour_}, {"bricks", brick_list_}, {"voxel_counters", counters_}};
  const std::vector<float> list = voxel_lights(lights, grid_.origin, grid_.voxel);
  const std::vector<float> depths = shadowed ? shadow_map(p.shadow) : std::vector<float>();
  for (const Resource& r : plan.value().resources) {
    if (r.name == "normal") named.push_back({r.name, normal_});
    if (r.name == "emission") named.push_back({r.name, emitted_});
    if (r.name != "lights" && r.name != "map" && r.name != "shadow") continue;
    const std::size_t before = bytes_;
    const std::vector<float>& values = r.name == "lights" ? list : r.name == "map" ? map : depths;
    auto memory = make(r.format, r.bytes / bytes_per_pixel(r.format), values.empty() ? nullptr : values.data());
    if (!memory) return memory.status();
    bytes_ = before;  // they go with this step
    named.push_back({r.name, memory.value()});
  }
  if (!pyramid.fine) {
    auto fine = make(settings_.format, static_cast<std::size_t>(p.width) * p.height * p.depth);
    if (!fine) return fine.status();
    pyramid.fine = fine.value();
  }
  named.push_back({"radiance", pyramid.fine});
  return run(plan.value(), named, name, light_steps_);
}

ConeTraceParams VoxelScene::shape() const {
  ConeTraceParams p;
  p.extent = {grid_.width, grid_.height, grid_.depth};
  p.variant = settings_.variant;
  p.format = settings_.format;
  p.voxel = grid_.voxel;
  return p;
}

Status VoxelScene::mip(Pyramid& pyramid, const char* name) {
  MipBuildParams p;
  p.variant = settings_.variant == ConeVariant::anisotropic ? MipVariant::anisotropic : MipVariant::isotropic;
  p.width = grid_.width;
  p.height = grid_.height;
  p.depth = grid_.depth;
  p.format = settings_.format;
  auto plan = luxel::plan(p, context_->profile());
  if (!plan) return plan.status();
  const ConeTraceParams cones = shape();
  if (!pyramid.coarse) {
    auto coarse = make(settings_.format, cone_trace_coarse_texels(cones));
    if (!coarse) return coarse.status();
    pyramid.coarse = coarse.value();
  }
  std::vector<std::string> names;
  std::vector<Named> named{{"level_0", pyramid.fine}};
  const int directions = p.variant == MipVariant::anisotropic ? 6 : 1;
  names.reserve(static_cast<std::size_t>(mip_levels(p) * directions));
  for (int level = 1; level <= mip_levels(p); ++level)
    for (int d = 0; d < directions; ++d) {
      names.push_back(mip_level_name(level, directions == 6 ? d : -1));
      named.push_back({names.back(), pyramid.coarse, cone_trace_level_offset(cones, level, d)});
    }
  return run(plan.value(), named, name, light_steps_);
}

Result<std::vector<float>> VoxelScene::reflected() {
  const std::size_t voxels = static_cast<std::size_t>(grid_.width) * grid_.height * grid_.depth;
  std::vector<std::uint8_t> bytes(voxels * bytes_per_pixel(settings_.format));
  if (Status s = context_->download(*reflected_.fine, bytes.data(), bytes.size()); !s) return s;
  return io::unpack(bytes, settings_.format, false, 4);
}

// Both sides of every occupied voxel, from the grid's origin in scene units; `places`: a vec4 a voxel, in voxels.
Result<std::vector<float>> VoxelScene::voxel_receivers(std::vector<float>& places) {
  const std::size_t row = static_cast<std::size_t>(grid_.width), voxels = row * grid_.height * grid_.depth;
  std::vector<std::uint8_t> colour(voxels * bytes_per_pixel(settings_.format)), normal(colour.size());
  if (Status s = context_->download(*colour_, colour.data(), colour.size()); !s) return s;
  if (Status s = context_->download(*normal_, normal.data(), normal.size()); !s) return s;
  std::vector<float> receivers;
  const std::size_t line = row * bytes_per_pixel(settings_.format);
  for (std::size_t first = 0; first < voxels; first += row) {
    const std::size_t at = first * bytes_per_pixel(settings_.format);
    const std::vector<float> c = io::unpack({&colour[at], line}, settings_.format, false, 4);
    const std::vector<float> n = io::unpack({&normal[at], line}, settings_.format, false, 4);
    for (std::size_t x = 0; x < row; ++x) {
      if (!(c[4 * x + 3] > 0)) continue;
      const std::size_t y = first / row % static_cast<std::size_t>(grid_.height),
                        z = first / row / static_cast<std::size_t>(grid_.height);
      const float place[3] = {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, static_cast<float>(z) + 0.5f};
      places.insert(places.end(), {place[0], place[1], place[2], 1});
      float d[3];
      for (std::size_t i = 0; i < 3; ++i)
        d[i] = settings_.format == Format::unorm8x4 ? 2 * n[4 * x + i] - 1 : n[4 * x + i];
      if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 1e-6f) d[0] = d[2] = 0, d[1] = 1;
      const float voxel = static_cast<float>(grid_.voxel);
      for (const float side : {1.0f, -1.0f})
        receivers.insert(receivers.end(), {place[0] * voxel, place[1] * voxel, place[2] * voxel, 1, side * d[0],
                                           side * d[1], side * d[2], 0});
    }
  }
  return receivers;
}

Result<std::vector<float>> VoxelScene::cones(const ConeTraceParams& params, const Pyramid& pyramid,
                                             const std::vector<float>& receivers, const std::vector<float>& views,
                                             std::vector<float>* glossy, const char* name,
                                             std::vector<VoxelStep>& steps) {
  ConeTraceParams p = params;
  const ConeTraceParams volume = shape();
  p.extent = volume.extent;
  p.variant = volume.variant;
  p.format = volume.format;
  p.voxel = volume.voxel;
  p.origin = {0, 0, 0};
  const std::size_t count = receivers.size() / 8;
  if (params.width <= 0) {
    p.width = 1024;
    p.height = static_cast<int>((count + 1023) / 1024);
  }
  p.specular = glossy != nullptr;
  auto plan = luxel::plan(p, context_->profile());
  if (!plan) return plan.status();
  const std::size_t before = bytes_, room = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
  std::vector<float> padded = receivers;
  padded.resize(room * 8);
  auto in = make(Format::f32x4, room * 2, padded.data());
  if (!in) return in.status();
  std::vector<Named> named{{"fine", pyramid.fine}, {"coarse", pyramid.coarse}, {"receivers", in.value()}};
  std::shared_ptr<Memory> diffuse;
  if (p.radiance || p.occlusion) {
    auto made = make(Format::f32x4, room);
    if (!made) return made.status();
    diffuse = made.value();
    named.push_back({"irradiance", diffuse});
  }
  std::shared_ptr<Memory> specular;
  if (glossy != nullptr) {
    padded = views;
    padded.resize(room * 4);
    auto eyes = make(Format::f32x4, room, padded.data());
    if (!eyes) return eyes.status();
    auto made = make(Format::f32x4, room);
    if (!made) return made.status();
    specular = made.value();
    named.insert(named.end(), {{"views", eyes.value()}, {"specular", specular}});
  }
  if (p.sky_size > 0) named.push_back({"sky", sky_});
  if (Status s = run(plan.value(), named, name, steps); !s) return s;
  bytes_ = before;
  std::vector<float> values(room * 4);
  if (diffuse)
    if (Status s = context_->download(*diffuse, values.data(), room * 16); !s) return s;
  values.resize(count * 4);
  if (glossy != nullptr) {
    glossy->resize(room * 4);
    if (Status s = context_->download(*specular, glossy->data(), room * 16); !s) return s;
    glossy->resize(count * 4);
  }
  return values;
}

// What cones that leave the volume see. An image is averaged over caps as wide as theirs.
Status VoxelScene::see_sky(ConeTraceParams& p) {
  const Sky& sky = scene_.sky;
  if (sky.image.empty()) {
    p.environment = array_of(sky.radiance);
    return {};
  }
  p.environment = {1, 1, 1};
  p.sky_size = 33;
  p.sky_levels = 6;
  if (p.cones.empty()) p.cones = cone_set(6).value();
  p.sky_aperture = std::clamp(2 * p.cones.front().aperture, 0.01, 2.6);
  if (sky_ && sky_aperture_ == p.sky_aperture) return {};
  const auto start = std::chrono::steady_clock::now();
  const std::vector<float> texels = cone_sky(
      p, [&](const std::array<double, 3>& d) { return array_of(sky.toward({d[0], d[1], d[2]})); }, 1024);
  auto made = make(Format::f32x4, texels.size() / 4, texels.data());
  if (!made) return made.status();
  if (sky_) bytes_ -= texels.size() * 4;
  sky_ = made.value();
  sky_aperture_ = p.sky_aperture;
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
  light_steps_.push_back({"sky", passed.count()});
  return {};
}

Status VoxelScene::light() {
  light_steps_.clear();
  const bool sky = !scene_.sky.dark();
  const bool lamps = emission_ && !sky && emitting_triangles(scene_) <= static_cast<std::size_t>(settings_.lamp_pieces);
  gathered_ = sky || (emission_ && !lamps) || settings_.keep.gathering;
  if (sky || emission_ || gathered_) {
    if (Status s = inject(own_, emission_, {}, {}, "voxel_inject emission"); !s) return s;
    if (Status s = mip(own_, "mip_build emission"); !s) return s;
  }
  lights_ = voxel_lights_of(scene_, lamps ? settings_.lamp_pieces : 1);
  if (!lamps) std::erase_if(lights_, [](const VoxelLight& l) { return l.kind == VoxelLight::Kind::patch; });
  std::vector<float> map;
  if (gathered_) {
    std::vector<float> places;
    const auto receivers = voxel_receivers(places);
    if (!receivers) return receivers.status();
    ConeTraceParams p;
    p.cones = cone_set(settings_.voxel_cones).value();
    if (Status s = see_sky(p); !s) return s;
    p.occlusion = false;
    p.normal_offset = 2;
    auto arrived = cones(p, own_, receivers.value(), {}, nullptr, "cone_trace voxels", light_steps_);
    if (!arrived) return arrived.status();
    // The side that more light reaches; an isotropic voxel has one radiance.
    const std::vector<float>& e = arrived.value();
    for (std::size_t i = 0; i < places.size() / 4; ++i) {
      const float* a = &e[8 * i];
      const float* b = a + 4;
      const float* side = !settings_.two_sided || luminance({a[0], a[1], a[2]}) >= luminance({b[0], b[1], b[2]}) ? a : b;
      map.insert(map.end(), &places[4 * i], &places[4 * i] + 4);
      map.insert(map.end(), {side[0], side[1], side[2], 0});
    }
    map.resize((map.size() + 8191) / 8192 * 8192);
  }
  if (Status s = inject(reflected_, false, lights_, map, "voxel_inject"); !s) return s;
  return mip(reflected_, "mip_build");
}

Result<ConeLight> VoxelScene::trace(const ConeTraceParams& params, const std::vector<float>& receivers,
                                    const std::vector<float>& views, double occlusion_reach) {
  shade_steps_.clear();
  ConeLight light;
  const bool glossy = !views.empty();
  std::vector<float> mirrored;
  const bool near = params.occlusion && occlusion_reach > 0;  // then occlusion has cones of its own
  if (own_.fine && (gathered_ || glossy)) {
    ConeTraceParams p = params;
    if (Status s = see_sky(p); !s) return s;
    p.radiance = gathered_;
    p.occlusion = gathered_ && params.occlusion && !near;
    auto direct =
        cones(p, own_, receivers, views, glossy ? &light.glossy : nullptr, "cone_trace emission", shade_steps_);
    if (!direct) return direct.status();
    if (gathered_) light.direct = std::move(direct).value();
  }
  ConeTraceParams p = params;
  p.occlusion = !gathered_ && params.occlusion && !near;
  auto indirect = cones(p, reflected_, receivers, views, glossy ? &mirrored : nullptr, "cone_trace", shade_steps_);
  if (!indirect) return indirect.status();
  light.indirect = std::move(indirect).value();
  if (light.glossy.empty())
    light.glossy = std::move(mirrored);
  else
    for (std::size_t i = 0; i < mirrored.size(); ++i)
      if (i % 4 < 3) light.glossy[i] += mirrored[i];
  std::vector<float> occluded;
  if (near) {
    p.occlusion = true;
    p.radiance = false;
    p.max_distance = occlusion_reach;
    auto made = cones(p, reflected_, receivers, {}, nullptr, "cone_trace occlusion", shade_steps_);
    if (!made) return made.status();
    occluded = std::move(made).value();
  }
  const std::vector<float>& visible = near ? occluded : light.direct;
  if (near || gathered_)
    for (std::size_t i = 3; i < light.indirect.size(); i += 4) light.indirect[i] = visible[i];
  return light;
}

}  // namespace luxel::scene

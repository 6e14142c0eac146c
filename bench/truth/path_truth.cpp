#include "bench/truth/path_truth.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <numbers>
#include <thread>

#include <fmt/format.h>

#include "bench/truth/path_lights.h"
#include "host/files.h"

namespace luxel::truth {
namespace {

using glm::dvec3;
namespace fs = std::filesystem;
using scene::Hit;

constexpr double pi = std::numbers::pi;
constexpr std::uintmax_t cache_bytes = std::uintmax_t{2} << 30;  // a receiver takes 672
constexpr std::uint32_t version = 2;  // of what is computed: a change makes old cache files useless

enum Quantity {
  visibility,
  sun,
  emitted,
  sky,
  indirect,
  indirect_all,
  glossy_emitted,
  glossy_sky,
  glossy,
  glossy_all,
  count
};

std::array<Estimate*, count> parts(PathTruth& t) {
  return {&t.visibility, &t.sun, &t.emitted, &t.sky, &t.indirect, &t.indirect_all,
          &t.glossy_emitted, &t.glossy_sky, &t.glossy, &t.glossy_all};
}

// Radiance that a point sends back: after one reflection of direct light, and after all.
struct Outgoing {
  dvec3 once{0}, all{0};
};

class Tracer {
 public:
  Tracer(const scene::Rays& rays, const PathSettings& settings)
      : rays_(rays), scene_(rays.scene()), settings_(settings), lights_(scene_) {}

  dvec3 sunlight(dvec3 point, dvec3 normal) const {
    const double cosine = glm::dot(normal, scene_.sun.direction);
    if (!(cosine > 0) || scene_.sun.irradiance == dvec3(0) || rays_.blocked(start(point, normal), scene_.sun.direction))
      return dvec3(0);
    return scene_.sun.irradiance * cosine;
  }

  // Path `s` of a receiver.
  std::array<dvec3, count> sample(const Receiver& r, int s, Random& random) const {
    std::array<dvec3, count> v{};
    v[visibility] = dvec3(1);
    const dvec3 from = start(r.position, r.normal);
    sampled_lights(from, r.normal, random, v[emitted], v[sky]);
    const dvec3 way = cosine_direction(r.normal, stratified(s, settings_.samples, random));
    if (const auto hit = rays_.first(from, way); !hit) {
      v[sky] += pi * sky_met(way, r.normal);
    } else {
      if (hit->distance <= settings_.ao_distance) v[visibility] -= 1 / (1 + settings_.ao_falloff * hit->distance);
      v[emitted] += pi * emission_met(*hit, way, r.normal);
      const Outgoing light = reflected(*hit, random);
      v[indirect] = pi * light.once;
      v[indirect_all] = pi * light.all;
    }
    if (r.glossy && settings_.glossy) {
      const dvec3 mirrored = lobe_direction(r, stratified(s, settings_.samples, random), random);
      if (const auto hit = rays_.first(from, mirrored); !hit) {
        v[glossy_sky] = scene_.sky.toward(mirrored);
      } else {
        v[glossy_emitted] = scene_.material_of(hit->triangle).emission;
        const Outgoing light = reflected(*hit, random);
        v[glossy] = light.once;
        v[glossy_all] = light.all;
      }
    }
    return v;
  }

 private:
  const scene::Rays& rays_;
  const scene::Scene& scene_;
  const PathSettings& settings_;
  Lights lights_;

  dvec3 start(dvec3 point, dvec3 normal) const { return point + normal * rays_.offset(); }

  // Irradiance by sampled lights: radiance cos / density, times the balance heuristic's density / (density + cos / pi).
  void sampled_lights(dvec3 from, dvec3 normal, Random& random, dvec3& emitted, dvec3& sky) const {
    if (lights_.has_emitters()) {
      if (const auto s = lights_.emitter(from, random)) {
        const double cosine = glm::dot(normal, s->direction);
        if (cosine > 0) {
          const dvec3 way = start(s->point, s->normal) - from;
          const double reach = glm::length(way);
          if (!rays_.blocked(from, way / reach, reach)) emitted += s->radiance * cosine / (s->density + cosine / pi);
        }
      }
    }
    if (lights_.samples_sky()) {
      const LightSample s = lights_.sky(random);
      const double cosine = glm::dot(normal, s.direction);
      if (cosine > 0 && !rays_.blocked(from, s.direction)) sky += s.radiance * cosine / (s.density + cosine / pi);
    }
  }

  // What a cosine-weighted direction meets, times the heuristic's weight of having met it by chance.
  dvec3 sky_met(dvec3 way, dvec3 normal) const {
    const dvec3 radiance = scene_.sky.toward(way);
    if (!lights_.samples_sky()) return radiance;
    const double by_chance = glm::dot(normal, way) / pi;
    return radiance * by_chance / (by_chance + lights_.sky_density(way));
  }
  dvec3 emission_met(const Hit& hit, dvec3 way, dvec3 normal) const {
    const dvec3 radiance = scene_.material_of(hit.triangle).emission;
    const double aimed = lights_.emitter_density(hit.triangle, hit.distance, way),
                 by_chance = glm::dot(normal, way) / pi;
    return std::isfinite(aimed) ? radiance * by_chance / (by_chance + aimed) : dvec3(0);
  }

  Outgoing reflected(Hit hit, Random& random) const {
    Outgoing light;
    dvec3 weight(1);
    for (int bounce = 1;; ++bounce) {
      weight *= scene_.surface(hit.triangle, hit.b1, hit.b2).albedo;
      const double most = std::max({weight.r, weight.g, weight.b});
      if (!(most > 0)) return light;
      if (bounce > 3) {  // Russian roulette
        const double go_on = std::min(most, 0.95);
        if (random.next() >= go_on) return light;
        weight /= go_on;
      }
      const dvec3 from = start(hit.position, hit.normal);
      dvec3 by_light = sunlight(hit.position, hit.normal);
      sampled_lights(from, hit.normal, random, by_light, by_light);
      dvec3 radiance = weight / pi * by_light;
      const dvec3 way = cosine_direction(hit.normal, {random.next(), random.next()});
      const auto next = rays_.first(from, way);
      radiance += weight * (next ? emission_met(*next, way, hit.normal) : sky_met(way, hit.normal));
      if (bounce == 1) light.once = radiance;
      light.all += radiance;
      if (!next || bounce == settings_.bounces) return light;
      hit = *next;
    }
  }

  // Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), section 3.2; drawn again while the
  // mirrored direction lies below the surface.
  dvec3 lobe_direction(const Receiver& r, glm::dvec2 u, Random& random) const {
    const double alpha = std::max(r.roughness * r.roughness, 1e-6);
    const dvec3 t = about(r.normal, {1, 0, 0}), s = about(r.normal, {0, 1, 0});
    const dvec3 view(glm::dot(r.view, t), glm::dot(r.view, s), std::max(glm::dot(r.view, r.normal), 1e-9));
    const dvec3 stretched = glm::normalize(dvec3(alpha * view.x, alpha * view.y, view.z));
    const double flat = stretched.x * stretched.x + stretched.y * stretched.y;
    const dvec3 t1 = flat > 0 ? dvec3(-stretched.y, stretched.x, 0) / std::sqrt(flat) : dvec3(1, 0, 0);
    const dvec3 t2 = glm::cross(stretched, t1);
    for (int tries = 0; tries < 64; ++tries, u = {random.next(), random.next()}) {
      const double radius = std::sqrt(u.x), p = 2 * pi * u.y;
      const double a = radius * std::cos(p), w = 0.5 * (1 + stretched.z);
      const double b = (1 - w) * std::sqrt(1 - a * a) + w * radius * std::sin(p);
      const dvec3 n = a * t1 + b * t2 + std::sqrt(std::max(0.0, 1 - a * a - b * b)) * stretched;
      const dvec3 half = glm::normalize(dvec3(alpha * n.x, alpha * n.y, std::max(0.0, n.z)));
      const dvec3 way = 2 * glm::dot(view, half) * half - view;
      if (way.z > 0) return glm::normalize(about(r.normal, way));
    }
    return glm::normalize(2 * glm::dot(r.view, r.normal) * r.normal - r.view);
  }
};

template <class Work>
void on_threads(std::size_t n, const PathSettings& settings, const Work& work) {
  const int threads =
      settings.threads > 0 ? settings.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  constexpr std::size_t chunk = 16;
  std::atomic<std::size_t> next{0};
  std::mutex telling;
  std::vector<std::jthread> workers;
  for (int t = 0; t < threads; ++t)
    workers.emplace_back([&] {
      for (std::size_t first = next.fetch_add(chunk); first < n; first = next.fetch_add(chunk)) {
        for (std::size_t i = first; i < std::min(n, first + chunk); ++i) work(i);
        if (!settings.progress) continue;
        const std::lock_guard lock(telling);
        settings.progress(static_cast<double>(std::min(n, next.load())) / static_cast<double>(n));
      }
    });
}

// Everything that the result depends on.
class Key {
 public:
  template <class T>
  Key& add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    value_ = fnv1a(values.data(), values.size() * sizeof(T), value_);
    return add(static_cast<double>(values.size()));
  }
  Key& add(double v) {
    value_ = fnv1a(&v, sizeof(v), value_);
    return *this;
  }
  Key& add(dvec3 v) { return add(v.x).add(v.y).add(v.z); }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = fnv1a_seed;
};

std::uint64_t key_of(const scene::Scene& s, const std::vector<Receiver>& receivers, const PathSettings& settings) {
  Key key;
  key.add(version).add(s.positions).add(s.uvs).add(s.indices).add(s.triangle_materials);
  for (const scene::Material& m : s.materials)
    key.add(m.base_color)
        .add(m.alpha)
        .add(m.emission)
        .add(m.metallic)
        .add(static_cast<int>(m.alpha_mode))
        .add(m.alpha_cutoff)
        .add(m.texture);
  for (const scene::Texture& t : s.textures) key.add(t.width).add(t.srgb).add(t.rgba);
  key.add(s.sun.direction).add(s.sun.irradiance).add(s.sky.radiance).add(s.sky.width).add(s.sky.image);
  for (const Receiver& r : receivers) key.add(r.position).add(r.normal).add(r.view).add(r.roughness).add(r.glossy);
  key.add(settings.samples).add(settings.bounces).add(settings.ao_falloff).add(settings.ao_distance);
  key.add(settings.glossy).add(settings.seed);
  return key.value();
}

bool load(const std::string& file, PathTruth& truth) {
  std::vector<std::uint8_t> bytes;
  if (!read_checked(file, bytes)) return false;
  std::size_t at = 0, expected = 0;
  for (const Estimate* e : parts(truth)) expected += 3 * e->t1.size() * sizeof(double);
  if (bytes.size() != expected) return false;
  for (Estimate* e : parts(truth))
    for (auto* values : {&e->t1, &e->t2, &e->error}) {
      const std::size_t size = values->size() * sizeof(double);
      std::memcpy(values->data(), bytes.data() + at, size);
      at += size;
    }
  return true;
}

// Until the folder is small enough. Another process may do the same at the same time.
void forget_oldest(const fs::path& folder) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  std::uintmax_t total = 0;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    files.emplace_back(entry.last_write_time(error), entry.path());
    const std::uintmax_t size = entry.file_size(error);
    total += error ? 0 : size;
  }
  std::sort(files.begin(), files.end());
  for (std::size_t i = 0; i + 1 < files.size() && total > cache_bytes; ++i) {
    const std::uintmax_t size = fs::file_size(files[i].second, error);
    if (!error && fs::remove(files[i].second, error)) total -= std::min(total, size);
  }
}

void save(const std::string& file, PathTruth& truth) {
  std::vector<std::uint8_t> bytes;
  for (const Estimate* e : parts(truth))
    for (const auto* values : {&e->t1, &e->t2, &e->error}) {
      const auto* first = reinterpret_cast<const std::uint8_t*>(values->data());
      bytes.insert(bytes.end(), first, first + values->size() * sizeof(double));
    }
  if (bytes.size() > cache_bytes / 4) return;
  (void)write_checked(file, bytes);  // a cache that cannot be written costs time alone
  forget_oldest(fs::path(file).parent_path());
}

void trace_receiver(const Tracer& tracer, const Receiver& r, std::size_t i, const PathSettings& settings,
                    PathTruth& truth) {
  const double n = settings.samples;
  const dvec3 by_sun = tracer.sunlight(r.position, r.normal);
  std::array<dvec3, count> halves[2], squares{}, before{};  // squares: of the differences of pairs of samples
  for (int half = 0, pair = 0; half < 2; ++half) {
    std::array<dvec3, count> sum{};
    for (int s = 0; s < settings.samples; ++s, pair ^= 1) {
      Random random(settings.seed * std::uint64_t{2} + static_cast<std::uint64_t>(half), i,
                    static_cast<std::uint64_t>(s));
      const auto v = tracer.sample(r, s, random);
      for (std::size_t q = 0; q < count; ++q) {
        sum[q] += v[q];
        if (pair != 0) squares[q] += (v[q] - before[q]) * (v[q] - before[q]);
      }
      before = v;
    }
    for (dvec3& q : sum) q /= n;
    sum[sun] = by_sun;
    halves[half] = sum;
  }
  const auto estimates = parts(truth);
  for (std::size_t q = 0; q < count; ++q) {
    for (int c = 0; c < estimates[q]->channels; ++c) {
      const std::size_t at = i * static_cast<std::size_t>(estimates[q]->channels) + static_cast<std::size_t>(c);
      estimates[q]->t1[at] = halves[0][q][c];
      estimates[q]->t2[at] = halves[1][q][c];
      estimates[q]->error[at] = std::sqrt(squares[q][c]) / (2 * n);
    }
  }
}

}  // namespace

std::vector<Receiver> receivers(const scene::GBuffer& g, glm::dvec3 eye) {
  std::vector<Receiver> list(g.pixels());
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!g.surface_at(i)) continue;
    Receiver& r = list[i];
    r.position = g.at(g.position, i);
    r.normal = glm::normalize(g.at(g.normal, i));
    r.view = glm::normalize(eye - r.position);
    r.roughness = g.roughness[i];
    r.glossy = g.at(g.specular, i) != glm::dvec3(0);
  }
  return list;
}

std::vector<std::pair<std::string, const Estimate*>> estimates(const PathTruth& t) {
  return {{"visibility", &t.visibility}, {"sun", &t.sun}, {"emitted", &t.emitted}, {"sky", &t.sky},
          {"indirect", &t.indirect}, {"indirect_all", &t.indirect_all}, {"glossy_emitted", &t.glossy_emitted},
          {"glossy_sky", &t.glossy_sky}, {"glossy", &t.glossy}, {"glossy_all", &t.glossy_all}};
}

Result<PathTruth> path_truth(const scene::Rays& rays, const std::vector<Receiver>& receivers,
                             const PathSettings& settings) {
  const auto bad = [](const char* field, double value, const char* range) {
    return Status(Code::invalid_argument, fmt::format("PathSettings.{} is {}; expected {}", field, value, range));
  };
  if (settings.samples < 1 || settings.samples > 1048576) return bad("samples", settings.samples, "1..1048576");
  if (settings.bounces < 0) return bad("bounces", settings.bounces, "0 or more");
  if (!(settings.ao_falloff >= 0) || !std::isfinite(settings.ao_falloff))
    return bad("ao_falloff", settings.ao_falloff, "0 or more");
  if (!(settings.ao_distance > 0)) return bad("ao_distance", settings.ao_distance, "more than 0");

  PathTruth truth;
  truth.visibility.channels = 1;
  for (Estimate* e : parts(truth))
    for (auto* values : {&e->t1, &e->t2, &e->error})
      values->assign(receivers.size() * static_cast<std::size_t>(e->channels), 0.0);
  const std::string folder = settings.cached ? cache_directory() : "";
  const std::string file =
      folder.empty() ? "" : fmt::format("{}/truth/{:016x}", folder, key_of(rays.scene(), receivers, settings));
  if (!file.empty() && load(file, truth)) return truth;

  const auto begin = std::chrono::steady_clock::now();
  const Tracer tracer(rays, settings);
  on_threads(receivers.size(), settings, [&](std::size_t i) {
    if (receivers[i].normal != dvec3(0)) trace_receiver(tracer, receivers[i], i, settings, truth);
  });
  truth.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!file.empty()) save(file, truth);
  return truth;
}

}  // namespace luxel::truth

#include "tests/cases/probe_support.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bench/scene/images.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::cases {

ProbeSeen random_probes(const ProbeIrradianceParams& p, std::uint32_t seed) {
  ProbeSeen seen;
  const std::size_t n = probe_count(p.grid) * static_cast<std::size_t>(p.maps.size) * static_cast<std::size_t>(p.maps.size);
  const double unit = probe_unit(p.grid);
  for (std::size_t i = 0; i < n; ++i) {
    const auto random = [&](std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 4 + k, seed); };
    for (std::uint32_t c = 0; c < 3; ++c) seen.radiance.push_back(static_cast<float>(3 * random(c) * random(c)));
    seen.radiance.push_back(0);
    seen.distance.push_back(random(3) > 0.95 ? HUGE_VAL : static_cast<float>(2 * unit * random(3)));
  }
  return seen;
}

namespace {

std::uint32_t small_code(double v, int mantissa) {
  if (!(v > 0)) return 0;
  int exponent = std::max(static_cast<int>(std::floor(std::log2(v))), -14);
  const auto steps = static_cast<std::uint32_t>(std::lround(std::ldexp(v, mantissa - exponent)));
  return static_cast<std::uint32_t>(exponent + 14) * (1u << mantissa) + steps;  // a carry is the next exponent
}

double small_value(std::uint32_t code, int mantissa) {
  const int exponent = static_cast<int>(code >> mantissa);
  const double fraction = static_cast<double>(code & ((1u << mantissa) - 1)) / (1 << mantissa);
  return exponent == 0 ? std::ldexp(fraction, -14) : std::ldexp(1 + fraction, exponent - 15);
}

}  // namespace

Values pack_r11g11b10(std::span<const double> rgba) {
  Values words;
  for (std::size_t i = 0; i + 4 <= rgba.size(); i += 4)
    words.push_back(small_code(rgba[i], 6) | small_code(rgba[i + 1], 6) << 11 | small_code(rgba[i + 2], 5) << 22);
  return words;
}

Values unpack_r11g11b10(std::span<const double> words) {
  Values rgba;
  for (const double w : words) {
    const auto code = static_cast<std::uint32_t>(w);
    for (const double v : {small_value(code & 2047, 6), small_value(code >> 11 & 2047, 6), small_value(code >> 22, 5), 0.0}) rgba.push_back(v);
  }
  return rgba;
}

Values pack_f16(std::span<const double> values) {
  Values even(values.begin(), values.end());
  if (even.size() % 2 != 0) even.push_back(0);
  const std::vector<std::byte> bytes = store(even, Format::f16x2, false);
  Values words;
  for (std::size_t i = 0; i + 4 <= bytes.size(); i += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, &bytes[i], 4);
    words.push_back(word);
  }
  return words;
}

Result<ProbeFiltered> filter(Context& context, const ProbeIrradianceParams& p, const ProbeSeen& seen, const Values& list,
                             const ProbeFiltered& previous) {
  auto run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  Run& r = run.value();
  const auto write = [&](const char* name, const Values& values) { return r.write(name, values); };
  if (p.listed > 0)
    if (Status s = write("list", list); !s) return s;
  ProbeFiltered made;
  const std::size_t probes = probe_count(p.grid);
  if (p.irradiance_size > 0) {
    if (Status s = write("radiance", seen.radiance); !s) return s;
    if (Status s = write("irradiance", Values(4 * probe_map_texels(probes, p.irradiance_size), 7)); !s) return s;
    if (p.previous)
      if (Status s = write("previous_irradiance", previous.irradiance); !s) return s;
  }
  if (p.moments_size > 0) {
    if (Status s = write("distance", seen.distance); !s) return s;
    if (Status s = write("moments", Values(2 * probe_map_texels(probes, p.moments_size), 7)); !s) return s;
    if (p.previous)
      if (Status s = write("previous_moments", previous.moments); !s) return s;
  }
  if (Status s = r.go(); !s) return s;
  for (const auto& [name, to, wanted] : {std::tuple{"irradiance", &made.irradiance, p.irradiance_size > 0},
                                         {"moments", &made.moments, p.moments_size > 0}}) {
    if (!wanted) continue;
    auto values = r.read(name);
    if (!values) return values.status();
    *to = std::move(values).value();
  }
  return made;
}

Result<ProbeLit> shade(Context& context, const ProbeShadeParams& p, const truth::ProbeScene& scene, std::span<const double> receivers) {
  auto run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  Run& r = run.value();
  if (Status s = r.write("receivers", receivers); !s) return s;
  if (Status s = r.write("light", scene.light); !s) return s;
  if (p.visibility)
    if (Status s = r.write("moments", scene.moments); !s) return s;
  if (p.grid.placed)
    if (Status s = r.write("positions", scene.positions); !s) return s;
  if (p.count)
    if (Status s = r.write("counters", Values(probe_shade_outcomes, 0.0)); !s) return s;
  if (Status s = r.go(); !s) return s;
  ProbeLit lit;
  auto values = r.read("irradiance");
  if (!values) return values.status();
  lit.irradiance = std::move(values).value();
  if (p.count) {
    auto counters = r.read("counters");
    if (!counters) return counters.status();
    lit.counters = std::move(counters).value();
  }
  return lit;
}

ProbeSetUp probe_set_up(std::array<int, 3> count, bool half) {
  ProbeSetUp s;
  ProbeGrid grid;
  grid.count = count;
  grid.origin = {-1.25, 0.5, 2};
  grid.spacing = {1.5, 1, 2};
  s.filter.grid = s.shade.grid = grid;
  s.filter.maps = {16, 1, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
  s.filter.irradiance_size = s.shade.irradiance_size = 8;
  s.filter.moments_size = s.shade.moments_size = 8;
  s.filter.irradiance_format = s.shade.irradiance_format = half ? Format::f16x4 : Format::f32x4;
  s.filter.moments_format = half ? Format::f16x2 : Format::f32x2;
  return s;
}

Values even_map(std::size_t probes, int size, std::vector<double> texel) {
  Values v;
  for (std::size_t i = 0; i < probe_map_texels(probes, size); ++i) v.insert(v.end(), texel.begin(), texel.end());
  return v;
}

void add_probe_receiver(Values& receivers, std::array<double, 3> p, std::array<double, 3> n) {
  for (const double v : {p[0], p[1], p[2], 1.0, n[0], n[1], n[2], 0.0}) receivers.push_back(static_cast<float>(v));
}

Values random_receivers(const ProbeGrid& g, int count, std::uint32_t seed, double beyond) {
  Values receivers;
  for (int i = 0; i < count; ++i) {
    const auto random = [&](std::uint32_t k) { return scene::random01(static_cast<std::uint32_t>(i) * 8 + k, seed); };
    std::array<double, 3> p{}, n{};
    for (std::size_t k = 0; k < 3; ++k) {
      const double side = std::max((g.count[k] - 1) * g.spacing[k], g.spacing[k]);
      p[k] = g.origin[k] + side * ((1 + 2 * beyond) * random(static_cast<std::uint32_t>(k)) - beyond);
      n[k] = 2 * random(static_cast<std::uint32_t>(k) + 3) - 1;
    }
    if (i % 7 == 0) n = {i % 2 == 0 ? 1.0 : -1.0, 0, 0};
    add_probe_receiver(receivers, p, n);
  }
  return receivers;
}

Values probe_positions(const ProbeGrid& g, double jitter, int dead, std::uint32_t seed) {
  Values all;
  std::uint32_t i = 0;
  for (int z = 0; z < g.count[2]; ++z)
    for (int y = 0; y < g.count[1]; ++y)
      for (int x = 0; x < g.count[0]; ++x, ++i) {
        const std::array<int, 3> at{x, y, z};
        for (std::size_t k = 0; k < 3; ++k)
          all.push_back(static_cast<float>(g.origin[k] + (at[k] + jitter * (2 * scene::random01(3 * i + static_cast<std::uint32_t>(k), seed) - 1)) * g.spacing[k]));
        all.push_back(dead > 0 && static_cast<int>(i) % dead == dead - 1 ? 0 : 1);
      }
  return all;
}

}  // namespace luxel::cases

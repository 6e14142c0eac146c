#include "tests/cases/lpv_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/scene/images.h"

namespace luxel::cases::lpv {

namespace {

constexpr long double pi = std::numbers::pi_v<long double>;

double rounded(double v) { return static_cast<float>(v); }

std::array<long double, 3> cell_place(const LpvGrid& g, const Vec& place, const Vec& n, double offset) {
  std::array<long double, 3> q{};
  for (std::size_t a = 0; a < 3; ++a)
    q[a] = (static_cast<long double>(place[a]) - g.origin[a]) / g.cell + static_cast<long double>(offset) * n[a];
  return q;
}

Vec normalised(const Vec& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  if (!(length > 0)) return {0, 0, 0};
  return {v[0] / length, v[1] / length, v[2] / length};
}

// Index of the box of `extent` that holds q; -1 outside.
std::ptrdiff_t index_of(const std::array<long double, 3>& q, const std::array<int, 3>& extent) {
  for (std::size_t a = 0; a < 3; ++a)
    if (!(q[a] >= 0 && q[a] < extent[a])) return -1;
  const auto at = [&](std::size_t a) { return static_cast<std::ptrdiff_t>(std::floor(q[a])); };
  return (at(2) * extent[1] + at(1)) * extent[0] + at(0);
}

}  // namespace

double uniform(std::uint32_t i) { return (scene::hash(i) >> 8) * 0x1p-24; }

Vec direction(std::uint32_t i) {
  const double z = 2 * uniform(2 * i + 7) - 1, angle = 2 * std::numbers::pi * uniform(2 * i + 8),
               r = std::sqrt(std::max(0.0, 1 - z * z));
  return {rounded(r * std::cos(angle)), rounded(r * std::sin(angle)), rounded(z)};
}

double inner(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Values list_of(const std::vector<Light>& lights) {
  Values v;
  for (const Light& l : lights)
    for (const Vec& part : {l.place, l.normal, l.flux}) {
      for (const double c : part) v.push_back(rounded(c));
      v.push_back(0);
    }
  return v;
}

Values list_of(const std::vector<Surfel>& surfels) {
  Values v;
  for (const Surfel& s : surfels) {
    for (const double c : s.place) v.push_back(rounded(c));
    v.push_back(rounded(s.area));
    for (const double c : s.normal) v.push_back(rounded(c));
    v.push_back(0);
  }
  return v;
}

Values receivers_at(const std::vector<Surfel>& places) { return list_of(places); }

std::vector<Light> random_lights(int count, const std::array<int, 3>& extent, std::uint32_t seed) {
  std::vector<Light> lights;
  for (int k = 0; k < count; ++k) {
    const std::uint32_t i = seed + 16 * static_cast<std::uint32_t>(k);
    Light l;
    l.normal = direction(i);
    const Vec n = normalised(l.normal);
    for (std::uint32_t a = 0; a < 3; ++a) {
      const double q = uniform(i + a) * extent[a], cell = std::min(std::floor(q), extent[a] - 1.0);
      l.place[a] = rounded(cell + 0.01 + 0.98 * (q - cell) - 0.5 * n[a]);
      l.flux[a] = rounded(uniform(i + 4 + a) * uniform(i + 7 + a));
    }
    lights.push_back(l);
  }
  return lights;
}

std::vector<Surfel> random_surfels(int count, const std::array<int, 3>& extent, std::uint32_t seed) {
  std::vector<Surfel> surfels;
  for (int k = 0; k < count; ++k) {
    const std::uint32_t i = seed + 16 * static_cast<std::uint32_t>(k);
    Surfel s;
    s.normal = direction(i);
    for (std::uint32_t a = 0; a < 3; ++a) {
      // Off the middles between corners.
      const double q = uniform(i + a) * extent[a], corner = std::floor(q);
      s.place[a] = rounded(q - corner < 0.5 ? corner + 0.98 * (q - corner) : corner + 1 - 0.98 * (corner + 1 - q));
    }
    s.area = rounded(0.3 * uniform(i + 5));
    surfels.push_back(s);
  }
  return surfels;
}

LpvGrid grid_of(int width, int height, int depth) {
  LpvGrid g;
  g.extent = {width, height, depth};
  return g;
}

double cosine_lobe(int i, const Vec& n) {
  const long double x = n[0], y = n[1], z = n[2];
  if (i == 0) return static_cast<double>(std::sqrt(pi) / 2);
  if (x == 0 && y == 0 && z == 0) return 0;
  const long double first = std::sqrt(pi / 3), second = std::sqrt(15 * pi) / 8, third = std::sqrt(5 * pi) / 16;
  switch (i) {
    case 1: return static_cast<double>(first * y);
    case 2: return static_cast<double>(first * z);
    case 3: return static_cast<double>(first * x);
    case 4: return static_cast<double>(second * x * y);
    case 5: return static_cast<double>(second * y * z);
    case 6: return static_cast<double>(third * (3 * z * z - 1));
    case 7: return static_cast<double>(second * x * z);
    default: return static_cast<double>(second / 2 * (x * x - y * y));
  }
}

Result<Values> injected(Context& context, LpvInjectParams p, const Values& lights, Values* outcomes) {
  p.lights = static_cast<int>(lights.size() / 12);
  p.count = outcomes != nullptr;
  Result<Run> run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (!lights.empty())
    if (Status s = run.value().write("lights", lights); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  if (outcomes != nullptr) {
    auto read = run.value().read("outcomes");
    if (!read) return read.status();
    *outcomes = read.value();
  }
  return run.value().read("injected");
}

Result<Values> injected_geometry(Context& context, LpvInjectGeometryParams p, const Values& surfels, const Values& kept,
                                 Values* outcomes) {
  p.count = outcomes != nullptr;
  p.keep = !kept.empty();
  if (p.surfels == std::array<int, 4>{}) p.surfels[0] = static_cast<int>(surfels.size() / 8);
  Result<Run> run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (!surfels.empty())
    if (Status s = run.value().write("surfels", surfels); !s) return s;
  if (p.keep)
    if (Status s = run.value().write("kept", kept); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  if (outcomes != nullptr) {
    auto read = run.value().read("outcomes");
    if (!read) return read.status();
    *outcomes = read.value();
  }
  return run.value().read("geometry");
}

Result<Sampled> sampled(Context& context, LpvSampleParams p, const Values& light, const Values& receivers,
                        const Values& views) {
  p.receivers = static_cast<int>(receivers.size() / 8);
  Result<Run> run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write("light", light); !s) return s;
  if (Status s = run.value().write("receivers", receivers); !s) return s;
  if (p.glossy_steps > 0)
    if (Status s = run.value().write("views", views); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  Sampled all;
  auto read = run.value().read("irradiance");
  if (!read) return read.status();
  all.irradiance = read.value();
  if (p.glossy_steps > 0) {
    read = run.value().read("specular");
    if (!read) return read.status();
    all.specular = read.value();
  }
  if (p.count) {
    read = run.value().read("outcomes");
    if (!read) return read.status();
    all.outcomes = read.value();
  }
  return all;
}

Result<Values> filtered(Context& context, const LpvFilterParams& p, const Values& volume) {
  Result<Run> run = Run::make(context, plan(p, context.profile()));
  if (!run) return run.status();
  if (Status s = run.value().write("src", volume); !s) return s;
  if (Status s = run.value().go(); !s) return s;
  return run.value().read("dst");
}

Values injected_truth(const LpvInjectParams& p, const std::vector<Light>& lights) {
  const std::size_t cells = lpv_pixels(p.grid, 2, 1), quads = p.bands == 3 ? 3 : 1;
  std::vector<long double> sums(lpv_pixels(p.grid, p.bands, p.channels) * 4, 0.0L);
  for (const Light& l : lights) {
    const Vec n = normalised(l.normal);
    const std::ptrdiff_t cell = index_of(cell_place(p.grid, l.place, n, p.offset), p.grid.extent);
    if (cell < 0) continue;
    for (std::size_t c = 0; c < static_cast<std::size_t>(p.channels); ++c)
      for (int i = 0; i < p.bands * p.bands; ++i) {
        const std::size_t pixel = (c * quads + static_cast<std::size_t>(i) / 4) * cells + static_cast<std::size_t>(cell);
        sums[4 * pixel + static_cast<std::size_t>(i) % 4] += std::min(l.flux[c], p.flux_max) / pi * cosine_lobe(i, n);
      }
  }
  const long double scale = p.per_area ? 1 / (static_cast<long double>(p.grid.cell) * p.grid.cell) : 1.0L;
  Values v;
  for (const long double s : sums) v.push_back(static_cast<double>(s * scale));
  return v;
}

Values geometry_truth(const LpvInjectGeometryParams& p, const std::vector<Surfel>& surfels) {
  const std::array<int, 3> extent{p.grid.extent[0] + 1, p.grid.extent[1] + 1, p.grid.extent[2] + 1};
  std::vector<long double> sums(lpv_geometry_pixels(p.grid) * 4, 0.0L);
  for (const Surfel& s : surfels) {
    const Vec n = normalised(s.normal);
    auto q = cell_place(p.grid, s.place, n, p.offset);
    for (long double& c : q) c += 0.5L;
    const std::ptrdiff_t corner = index_of(q, extent);
    if (corner < 0) continue;
    const long double area =
        std::min<long double>(s.area / (static_cast<long double>(p.grid.cell) * p.grid.cell), p.area_max);
    for (int i = 0; i < 4; ++i) {
      const double back = p.two_sided ? cosine_lobe(i, {-n[0], -n[1], -n[2]}) : 0;
      sums[4 * static_cast<std::size_t>(corner) + static_cast<std::size_t>(i)] += area * (cosine_lobe(i, n) + back);
    }
  }
  return {sums.begin(), sums.end()};
}

Values sampled_truth(const LpvSampleParams& p, const Values& light, const Values& receivers) {
  const LpvGrid& g = p.grids[0];
  const std::size_t cells = lpv_pixels(g, 2, 1), quads = p.bands == 3 ? 3 : 1;
  Values result;
  for (std::size_t r = 0; r + 8 <= receivers.size(); r += 8) {
    const Vec place{receivers[r], receivers[r + 1], receivers[r + 2]},
        n = normalised({receivers[r + 4], receivers[r + 5], receivers[r + 6]});
    const auto at = cell_place(g, place, {0, 0, 0}, 0);
    bool inside = true;
    for (std::size_t a = 0; a < 3; ++a) inside = inside && at[a] >= 0 && at[a] <= g.extent[a];
    std::array<long double, 3> e{};
    for (std::size_t c = 0; inside && c < 3; ++c) {
      const std::size_t channel = p.channels == 1 ? 0 : c;
      for (int i = 0; i < p.bands * p.bands; ++i) {
        // Hat functions of all cells: those of no weight drop out.
        long double value = 0;
        std::array<std::array<std::pair<int, long double>, 2>, 3> taps{};
        for (std::size_t a = 0; a < 3; ++a) {
          const long double q = std::clamp<long double>(at[a] + static_cast<long double>(p.offset) * n[a] - 0.5L, 0, g.extent[a] - 1);
          const int low = static_cast<int>(std::floor(q)), high = std::min(low + 1, g.extent[a] - 1);
          taps[a] = {{{low, 1 - (q - low)}, {high, q - low}}};
        }
        for (const auto& x : taps[0])
          for (const auto& y : taps[1])
            for (const auto& z : taps[2]) {
              const std::size_t cell = static_cast<std::size_t>((z.first * g.extent[1] + y.first) * g.extent[0] + x.first);
              const std::size_t pixel = (channel * quads + static_cast<std::size_t>(i) / 4) * cells + cell;
              value += x.second * y.second * z.second * light[4 * pixel + static_cast<std::size_t>(i) % 4];
            }
        e[c] += value * cosine_lobe(i, {-n[0], -n[1], -n[2]});
      }
      e[c] = std::max(e[c], 0.0L) * p.gain / (p.per_area ? 1.0L : static_cast<long double>(g.cell) * g.cell);
    }
    for (const long double v : e) result.push_back(static_cast<double>(v));
    result.push_back(inside ? 1 : 0);
  }
  return result;
}

std::vector<Turn> turns() {
  std::vector<Turn> all;
  std::array<int, 3> to{0, 1, 2};
  do {
    for (int signs = 0; signs < 8; ++signs)
      all.push_back({to, {signs & 1 ? -1.0 : 1.0, signs & 2 ? -1.0 : 1.0, signs & 4 ? -1.0 : 1.0}});
  } while (std::next_permutation(to.begin(), to.end()));
  return all;
}

double relative_error(const Values& a, const Values& b) {
  if (a.size() != b.size()) return std::nan("");
  double most = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::fabs(a[i] - b[i]);
    if (!(d <= most)) most = d;
    largest = std::max(largest, std::fabs(b[i]));
  }
  return most / largest;
}

}  // namespace luxel::cases::lpv

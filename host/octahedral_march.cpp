#include <luxel/octahedral_march.h>

#include <cmath>

#include "host/check.h"

namespace luxel {

std::size_t probe_count(const ProbeGrid& g) {
  return static_cast<std::size_t>(g.count[0]) * static_cast<std::size_t>(g.count[1]) * static_cast<std::size_t>(g.count[2]);
}

double probe_unit(const ProbeGrid& g) { return std::hypot(g.spacing[0], g.spacing[1], g.spacing[2]); }

namespace {

std::size_t texels(const ProbeMaps& m, std::size_t probes) {
  return probes * static_cast<std::size_t>(m.size) * static_cast<std::size_t>(m.size);
}

std::size_t words(std::size_t n) { return (n + 1) / 2; }

}  // namespace

std::size_t probe_radiance_elements(const ProbeMaps& m, std::size_t probes) { return texels(m, probes); }

std::size_t probe_distance_elements(const ProbeMaps& m, std::size_t probes) {
  return m.distance == ProbeDistance::f16 ? words(texels(m, probes)) : texels(m, probes);
}

std::size_t probe_normal_elements(const ProbeMaps& m, std::size_t probes) {
  if (m.normal == ProbeNormal::none) return 0;
  return m.normal == ProbeNormal::snorm8 ? words(texels(m, probes)) : texels(m, probes);
}

std::size_t probe_minimum_elements(const ProbeMaps& m, std::size_t probes) {
  if (m.ratio == 1) return 0;
  const std::size_t side = static_cast<std::size_t>(m.size / m.ratio), n = probes * side * side;
  return m.distance == ProbeDistance::f16 ? words(n) : n;
}

Format probe_radiance_format(const ProbeMaps& m) {
  return m.radiance == ProbeRadiance::f32x4   ? Format::f32x4
         : m.radiance == ProbeRadiance::f16x4 ? Format::f16x4
                                              : Format::u32;
}

Format probe_distance_format(const ProbeMaps& m) {
  return m.distance == ProbeDistance::f16 ? Format::u32 : Format::f32x1;
}

double probe_texel_bytes(const ProbeMaps& m) {
  const double normal = m.normal == ProbeNormal::none ? 0 : m.normal == ProbeNormal::snorm8 ? 2 : 4;
  return static_cast<double>(bytes_per_pixel(probe_radiance_format(m))) + (m.distance == ProbeDistance::f16 ? 2 : 4) + normal;
}

Status validate(const ProbeGrid& g) {
  for (const int n : g.count) LUXEL_CHECK(check_range("ProbeGrid.count", n, 1, 1024));
  if (probe_count(g) > 65536) return out_of_range("ProbeGrid.count", probe_count(g), "at most 65536 probes in all");
  for (const double v : g.origin) LUXEL_CHECK(check_range("ProbeGrid.origin", v, -1e15, 1e15));
  for (const double v : g.spacing) LUXEL_CHECK(check_range("ProbeGrid.spacing", v, 1e-15, 1e15));
  return {};
}

Status validate(const ProbeMaps& m, std::size_t probes) {
  LUXEL_CHECK(check_range("ProbeMaps.size", m.size, 16, 2048));
  if (m.size % 2 != 0) return out_of_range("ProbeMaps.size", m.size, "an even number");
  LUXEL_CHECK(check_range("ProbeMaps.ratio", m.ratio, 1, 256));
  if ((m.ratio & (m.ratio - 1)) != 0 || m.size % m.ratio != 0)
    return out_of_range("ProbeMaps.ratio", m.ratio, "a power of two that divides the size");
  LUXEL_CHECK(check_range("ProbeMaps.radiance", static_cast<int>(m.radiance), 0, 2));
  LUXEL_CHECK(check_range("ProbeMaps.distance", static_cast<int>(m.distance), 0, 1));
  LUXEL_CHECK(check_range("ProbeMaps.normal", static_cast<int>(m.normal), 0, 2));
  if (texels(m, probes) > 0x7fffffffu)
    return out_of_range("ProbeMaps.size", m.size, "size x size x probes of at most 2147483647");
  return {};
}

}  // namespace luxel

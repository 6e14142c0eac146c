#include "bench/truth/probe_truth.h"

#include <algorithm>
#include <cmath>

namespace luxel::truth {
namespace {

constexpr double endless = 1e30;

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
Vec3 along(const ProbeRay& r, double t) {
  return {r.origin[0] + t * r.direction[0], r.origin[1] + t * r.direction[1], r.origin[2] + t * r.direction[2]};
}

struct Part {
  double in = 0, out = 0;  // of t
  int texel = 0;
};

// The part of a ray in the cone of texel (x, y) of one octant. False: none.
bool clip(int size, int x, int y, const Vec3& side, const ProbeRay& ray, Part& part) {
  double in = ray.begin, out = ray.reach;
  // a + t b >= 0.
  const auto keep = [&](double a, double b) {
    if (b > 0) in = std::max(in, -a / b);
    else if (b < 0) out = std::min(out, -a / b);
    else if (a < 0) out = -1;
  };
  const Vec3 &o = ray.origin, &d = ray.direction;
  for (std::size_t k = 0; k < 3; ++k) keep(side[k] * o[k], side[k] * d[k]);
  const double l0 = side[0] * o[0] + side[1] * o[1] + side[2] * o[2], l1 = side[0] * d[0] + side[1] * d[1] + side[2] * d[2];
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const int i = axis == 0 ? x : y;
    const std::size_t other = 1 - axis;
    // The map's coordinate times L: of the upper half the component, of the lower L less the other's size, with its sign.
    const double c0 = side[2] > 0 ? o[axis] : side[axis] * (l0 - side[other] * o[other]);
    const double c1 = side[2] > 0 ? d[axis] : side[axis] * (l1 - side[other] * d[other]);
    const double low = 2.0 * i / size - 1, high = 2.0 * (i + 1) / size - 1;
    keep(c0 - low * l0, c1 - low * l1);
    keep(high * l0 - c0, high * l1 - c1);
  }
  part = {in, out, y * size + x};
  return in < out;
}

}  // namespace

Vec3 octahedral_direction(double u, double v) {
  const double z = 1 - std::fabs(u) - std::fabs(v);
  Vec3 d{u, v, z};
  if (z < 0) d = {std::copysign(1 - std::fabs(v), u), std::copysign(1 - std::fabs(u), v), z};
  const double l = length(d);
  for (double& c : d) c /= l;
  return d;
}

std::array<double, 2> octahedral_place(const Vec3& d) {
  const double sum = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
  const double x = d[0] / sum, y = d[1] / sum;
  if (d[2] >= 0) return {x, y};
  return {std::copysign(1 - std::fabs(y), x), std::copysign(1 - std::fabs(x), y)};
}

Vec3 direction_of_code(std::uint32_t code, int bits) {
  const auto part = [&](std::uint32_t c) {
    const int range = 1 << bits, v = static_cast<int>(c & static_cast<std::uint32_t>(range - 1));
    const double whole = v < range / 2 ? v : v - range;
    return std::max(whole / (range / 2 - 1), -1.0);
  };
  return octahedral_direction(part(code), part(code >> bits));
}

ProbeAnswer probe_truth(const ProbeMap& map, const ProbeRay& ray, const ProbeTraceParams& p) {
  std::vector<Part> parts;
  for (int y = 0; y < map.size; ++y)
    for (int x = 0; x < map.size; ++x) {
      // Least and largest |u| + |v| of the texel, in half texels from the middle, say which octants it meets.
      const int near = std::min(std::abs(2 * x - map.size), std::abs(2 * x + 2 - map.size)) +
                       std::min(std::abs(2 * y - map.size), std::abs(2 * y + 2 - map.size));
      for (const double z : {1.0, -1.0}) {
        if ((z > 0 && near >= map.size) || (z < 0 && near + 4 <= map.size)) continue;
        Part part;
        const Vec3 side{2 * x < map.size ? -1.0 : 1.0, 2 * y < map.size ? -1.0 : 1.0, z};
        if (clip(map.size, x, y, side, ray, part)) parts.push_back(part);
      }
    }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.in < b.in; });

  ProbeAnswer answer;
  answer.t = ray.reach;
  const auto decide = [&](double a, double b) {
    const double most = std::max(std::fabs(a), std::fabs(b));
    if (most > 0 && most < endless) answer.margin = std::min(answer.margin, std::fabs(a - b) / most);
  };
  const auto foot_at = [&](int x, int y) {
    const double u = (2.0 * x + 1) / map.size - 1, v = (2.0 * y + 1) / map.size - 1;
    const Vec3 d = octahedral_direction(u, v);
    const double q = 1 / (std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]));
    return 2 / (map.size * std::pow(q, 1.5));
  };
  double start = ray.begin;
  if (p.bias > 0) {
    const double l = length(ray.origin);
    const double q = l > 0 ? l / (std::fabs(ray.origin[0]) + std::fabs(ray.origin[1]) + std::fabs(ray.origin[2])) : 1;
    start += p.bias * l * 2 / (map.size * std::pow(q, 1.5));
  }
  for (const Part& part : parts) {
    const std::size_t i = static_cast<std::size_t>(part.texel);
    const double far = map.distance[i];
    if (far >= endless) continue;
    const double r_in = length(along(ray, part.in)), r_out = part.out < endless ? length(along(ray, part.out)) : endless;
    decide(std::max(r_in, r_out), far);
    if (std::max(r_in, r_out) < far) continue;
    const int x = part.texel % map.size, y = part.texel / map.size;
    const Vec3 w = octahedral_direction((2.0 * x + 1) / map.size - 1, (2.0 * y + 1) / map.size - 1);
    double depth = p.thickness * far * foot_at(x, y);
    if (!map.normal.empty()) {
      const double facing = std::clamp(-dot(map.normal[i], w), 0.0, 1.0), rise = std::sqrt(1 - facing * facing);
      depth *= 1 + (rise < p.slope * facing ? rise / facing : p.slope);
    }
    decide(r_in, far + depth);
    if (!(r_in <= far + depth)) {
      answer.outcome = ProbeOutcome::unknown;
      answer.t = part.in;
      answer.texel = part.texel;
      return answer;
    }
    if (start > ray.begin) decide(part.out, start);
    double t = part.in;
    if (map.normal.empty()) {
      if (r_in > far || r_out > far) decide(r_in, far), decide(r_out, far);
      if ((r_in > far && r_out < far) || part.out <= start) continue;
      if (r_in <= far) {
        const double b = dot(ray.origin, ray.direction);
        t = std::clamp(std::sqrt(std::max(far * far - (dot(ray.origin, ray.origin) - b * b), 0.0)) - b, part.in, part.out);
      }
    } else {
      const double approach = dot(map.normal[i], ray.direction);
      const double above = dot(map.normal[i], ray.origin) - far * dot(map.normal[i], w);
      answer.margin = std::min(answer.margin, std::fabs(approach));
      if (approach >= 0 || part.out <= start) continue;
      if (part.out < endless) {
        decide(above, -part.out * approach);
        if (above + part.out * approach > 0) continue;
      }
      const double slack = std::min(part.out, endless) - part.in;
      t = std::clamp(above / -approach, std::max(part.in - slack, start), part.out + slack);
    }
    answer.outcome = ProbeOutcome::hit;
    answer.t = t;
    answer.texel = part.texel;
    return answer;
  }
  return answer;
}

}  // namespace luxel::truth

#include "bench/truth/ssr_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace luxel::truth {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unit_f32 = 0x1p-23;

struct Part {
  double from = 0, to = infinity;  // empty where from > to
};

// Where a + b t >= 0.
void keep(Part& part, double a, double b) {
  if (b > 0)
    part.from = std::max(part.from, -a / b);
  else if (b < 0)
    part.to = std::min(part.to, -a / b);
  else if (a < 0)
    part.to = -infinity;
}

// A ray with what one axis of the projection makes of it: pixel(t) = (p + q t) / depth(t).
struct Projected {
  double p[2], q[2], d0, rate;
  Part whole;
  double depth(double t) const { return rate == 0 ? d0 : d0 + rate * t; }
};

Projected project(const HizSsrParams& s, const ScreenRay& r) {
  Projected v{};
  v.d0 = -r.origin[2];
  v.rate = -r.direction[2];
  v.p[0] = s.centre_x * v.d0 + s.focal_x * r.origin[0];
  v.p[1] = s.centre_y * v.d0 - s.focal_y * r.origin[1];
  v.q[0] = s.centre_x * v.rate + s.focal_x * r.direction[0];
  v.q[1] = s.centre_y * v.rate - s.focal_y * r.direction[1];
  v.whole.to = r.reach;
  keep(v.whole, v.d0 - s.near_plane, v.rate);
  return v;
}

// Where the ray is seen between two coordinates of an axis.
void between(const Projected& r, int axis, double low, double high, Part& part) {
  keep(part, r.p[axis] - low * r.d0, r.q[axis] - low * r.rate);
  keep(part, high * r.d0 - r.p[axis], high * r.rate - r.q[axis]);
}

// A part's depths against a surface's; t: where they first meet.
bool meets(const Projected& r, const Part& part, double z, double thickness, double slack, double& t) {
  const double a = r.depth(part.from), b = r.depth(part.to), most = std::max(a, b);
  const double grow = slack * std::max(1.0, std::min(most, z) / r.d0);
  const double front = z * (1 - grow), back = (z + thickness) * (1 + grow);
  if (!(most >= front && std::min(a, b) <= back)) return false;
  t = part.from;
  if (a < front) t = (front - r.d0) / r.rate;
  if (a > back) t = (back - r.d0) / r.rate;
  t = std::clamp(t, part.from, part.to);
  return true;
}

struct Found {
  bool hit = false;
  Part part;
  double t = 0;
};

Found in_pixel(const HizSsrParams& s, std::span<const double> depth, const Projected& r, int x, int y, Part part,
               Slack slack) {
  Found f;
  between(r, 0, x - slack.pixels, x + 1 + slack.pixels, part);
  f.part = part;
  if (!(part.from < part.to)) return f;
  const double z = depth_of(s, depth[static_cast<std::size_t>(y) * s.width + x]);
  f.hit = std::isfinite(z) && z > 0 && meets(r, part, z, s.thickness, slack.depth, f.t);
  return f;
}

Part in_row(const Projected& r, int y, Slack slack) {
  Part part = r.whole;
  between(r, 1, y - slack.pixels, y + 1 + slack.pixels, part);
  return part;
}

double middle_of(const Part& part) { return part.to < infinity ? 0.5 * (part.from + part.to) : infinity; }

// How a ray without a hit ends, each way at its t.
struct End {
  double left, limit;
  SsrOutcome at_limit;
};
End end_of(const HizSsrParams& s, const ScreenRay& ray, const Projected& r) {
  Part seen = r.whole;
  between(r, 0, 0, s.width, seen);
  between(r, 1, 0, s.height, seen);
  const bool behind = r.depth(ray.reach) < s.near_plane && r.rate < 0;
  return {seen.from > seen.to ? 0 : seen.to, r.whole.to,
          behind ? SsrOutcome::behind : SsrOutcome::miss};
}

}  // namespace

Slack f32_slack(const HizSsrParams& p) { return {4 * unit_f32 * std::max({p.width, p.height, 64}), 4 * unit_f32}; }

double depth_of(const HizSsrParams& p, double stored) {
  if (std::isnan(stored)) return infinity;
  if (p.depth == SsrDepth::linear) return stored < 1e10 ? stored : infinity;
  const double x = p.depth == SsrDepth::standard ? 1 - stored : stored;
  const double far_w = p.far_plane > 0 ? 1 / p.far_plane : 0;
  return x > 0 ? 1 / (x * (1 / p.near_plane - far_w) + far_w) : infinity;
}

bool mirror_ray(const HizSsrParams& p, int x, int y, double stored, const std::array<double, 3>& normal, ScreenRay& ray) {
  const double z = depth_of(p, stored);
  const double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (!std::isfinite(z) || !(z > 0) || !(size > 0) || !std::isfinite(size)) return false;
  const std::array<double, 3> n{normal[0] / size, normal[1] / size, normal[2] / size};
  std::array<double, 3> sight{(x + 0.5 - p.centre_x) / p.focal_x, (p.centre_y - y - 0.5) / p.focal_y, -1};
  const double facing = n[0] * sight[0] + n[1] * sight[1] + n[2] * sight[2];
  if (!(facing < 0)) return false;
  // The plane through the surface has 1 / depth = (n . sight) w / facing, linear in the pixel.
  const double w = 1 / z, slope = w * (std::fabs(n[0] / p.focal_x) + std::fabs(n[1] / p.focal_y)) / -facing;
  const double lift = p.bias * slope + w * 0x1p-18, lifted = 1 / (w + lift);
  const double length = std::sqrt(sight[0] * sight[0] + sight[1] * sight[1] + 1);
  if (lift * (1 + 2 * facing * n[2]) > w) return false;  // nearer to its plane's horizon than the bias
  for (int a = 0; a < 3; ++a) {
    ray.origin[a] = sight[a] * lifted;
    ray.direction[a] = (sight[a] - 2 * facing * n[a]) / length;
  }
  ray.reach = p.max_distance > 0 ? p.max_distance : infinity;
  return true;
}

ScreenHit first_hit(const HizSsrParams& p, std::span<const double> depth, const ScreenRay& ray, Slack slack) {
  const Projected r = project(p, ray);
  ScreenHit first;
  if (!(r.d0 > p.near_plane)) return first;
  double least = infinity;
  for (int y = 0; y < p.height; ++y) {
    const Part row = in_row(r, y, slack);
    if (!(row.from < row.to) || row.from > least) continue;
    for (int x = 0; x < p.width; ++x) {
      const Found f = in_pixel(p, depth, r, x, y, row, slack);
      if (!f.hit || !(f.part.from < least)) continue;
      least = f.part.from;
      first = {x, y, f.t, middle_of(f.part), r.depth(f.t)};
    }
  }
  return first;
}

Verdict judge(const HizSsrParams& p, std::span<const double> depth, const ScreenRay& ray, SsrOutcome outcome, int x, int y) {
  const Projected r = project(p, ray);
  const Slack slack = f32_slack(p), less{-slack.pixels, -slack.depth};
  const bool hit = outcome == SsrOutcome::hit;
  const ScreenHit exact = first_hit(p, depth, ray);
  if (hit && exact.x == x && exact.y == y) return Verdict::equal;
  const ScreenHit sure = first_hit(p, depth, ray, less);
  if (hit) {
    if (x < 0 || y < 0 || x >= p.width || y >= p.height) return Verdict::wrong;
    const Found f = in_pixel(p, depth, r, x, y, in_row(r, y, slack), slack);
    if (!f.hit) return Verdict::wrong;
    return sure.x >= 0 && (sure.x != x || sure.y != y) && sure.middle < middle_of(f.part) ? Verdict::wrong : Verdict::tie;
  }
  if (sure.x >= 0) return Verdict::wrong;
  if (!(r.d0 > p.near_plane)) return outcome == SsrOutcome::behind ? Verdict::equal : Verdict::wrong;
  const End end = end_of(p, ray, r);
  const bool left = outcome == SsrOutcome::left;
  if (!left && outcome != end.at_limit) return Verdict::wrong;
  if (exact.x < 0 && left == (end.left < end.limit)) return Verdict::equal;
  if (exact.x >= 0) return Verdict::tie;
  // Where image and ray end together, within the slack of a pixel on the screen.
  const double t = std::min(end.left, end.limit), d = r.depth(t);
  for (int axis = 0; axis < 2; ++axis) {
    const double at = (r.p[axis] + (r.q[axis] == 0 ? 0 : r.q[axis] * t)) / d, size = axis == 0 ? p.width : p.height;
    if (std::fabs(at) <= slack.pixels || std::fabs(at - size) <= slack.pixels) return Verdict::tie;
  }
  return Verdict::wrong;
}

}  // namespace luxel::truth

// The red-green wall (Crassin 2011): a red wall a voxel thick, a green one right behind it. Who looks at the red one
// should see no green.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/cases/mip_build_support.h"

namespace luxel::cases {
namespace {

constexpr int side = 32;

Values two_walls(int at) {
  Values values(static_cast<std::size_t>(side) * side * side * 4, 0.0);
  for (std::size_t i = 0; i < values.size() / 4; ++i) {
    const int x = static_cast<int>(i) % side;
    if (x != at && x != at + 1) continue;
    values[i * 4 + (x == at ? 0 : 1)] = 1;
    values[i * 4 + 3] = 1;
  }
  return values;
}

// Green seen along +x through the first row of a level, in samples a voxel apart from `start` voxels on, interpolated
// along x. A sample stands for `part` of its opacity's reference length.
double green_seen(const Values& level, int n, double start, double part) {
  double green = 0, opacity = 0;
  for (double at = start; at < n + 1; at += 1) {
    const int low = static_cast<int>(std::floor(at - 0.5));
    const double f = at - 0.5 - low;
    double g = 0, a = 0;
    for (int k = 0; k < 2; ++k) {
      if (low + k < 0 || low + k >= n) continue;
      g += (k == 0 ? 1 - f : f) * level[static_cast<std::size_t>(low + k) * 4 + 1];
      a += (k == 0 ? 1 - f : f) * level[static_cast<std::size_t>(low + k) * 4 + 3];
    }
    const double corrected = a >= 1 ? 1 : 1 - std::pow(1 - a, part), through = 1 - opacity;
    green += through * g * (a > 0 ? corrected / a : part);
    opacity += through * corrected;
  }
  return green;
}

// The largest leak over levels 1 to 4 and both places of the wall in the grid.
template <class See>
Case wall(std::string name, std::string promise, double bound, MipVariant variant, See see) {
  return {"", std::move(name), std::move(promise), bound, [=](Context& context) -> Result<double> {
            double most = 0;
            for (const int at : {14, 15}) {
              const auto levels = build(context, mip_params(variant, Format::f32x4, {side, side, side}), two_walls(at));
              if (!levels) return levels.status();
              for (int level = 1; level <= 4; ++level) {
                const double green = see(levels.value(), level, side >> level);
                if (!(green <= most)) most = green;
              }
            }
            return most;
          }};
}

}  // namespace

void add_mip_wall_cases(std::vector<Case>& cases) {
  cases.push_back(
      wall("red-green wall, anisotropic, along the axis",
           "looking along the axis at voxel centres, nothing leaks (green seen)", 0, MipVariant::anisotropic,
           [](const Pyramid& p, int level, int n) { return green_seen(p.at(mip_level_name(level, 0)), n, 0.5, 1); }));
  cases.push_back(
      wall("red-green wall, anisotropic, between centres",
           "between centres an opaque voxel mixes with an empty one: at most 25 % leak", 0.25 + 1e-6,
           MipVariant::anisotropic, [](const Pyramid& p, int level, int n) {
             double most = 0;
             if (level == 4)
               return most;  // the red wall lies in the first voxel: who starts behind its centre is past it
             for (double start = 0.5; start < 1.5; start += 1.0 / 16)
               most = std::max(most, green_seen(p.at(mip_level_name(level, 0)), n, start, 1));
             return most;
           }));
  // Off the axis the volumes are mixed by the squared cosines, and those across the normal see the wall's edge.
  for (const int degrees : {15, 30, 45, 60})
    cases.push_back(wall(fmt::format("red-green wall, anisotropic, {} degrees off the axis", degrees),
                         "off the axis the volumes mix and the wall leaks: a number, at most half", 0.5,
                         MipVariant::anisotropic, [=](const Pyramid& p, int level, int n) {
                           const double c = std::cos(degrees * 3.14159265358979 / 180);
                           const Values& px = p.at(mip_level_name(level, 0));
                           const Values& py = p.at(mip_level_name(level, 2));
                           Values mixed(static_cast<std::size_t>(n) * 4);
                           for (std::size_t i = 0; i < mixed.size(); ++i)
                             mixed[i] = c * c * px[i] + (1 - c * c) * py[i];
                           return green_seen(mixed, n, 0.5, 1 / c);
                         }));
  // Opacity of the isotropic pyramid belongs to a finest voxel: a sample a voxel of the level apart stands for 2^level.
  cases.push_back(wall("red-green wall, isotropic",
                       "the isotropic mean of both walls leaks by construction: a number, at most half", 0.5,
                       MipVariant::isotropic, [](const Pyramid& p, int level, int n) {
                         return green_seen(p.at(mip_level_name(level)), n, 0.5, std::ldexp(1.0, level));
                       }));
}

}  // namespace luxel::cases

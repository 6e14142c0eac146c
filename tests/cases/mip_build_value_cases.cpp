// Values that are not ordinary: colour without opacity, opacity 1, saturation, ties, denormals, moments far from 0.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bench/truth/mip_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr MipVariant colour_variants[] = {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3};
constexpr Format colour_formats[] = {Format::f32x4, Format::f16x4, Format::unorm8x4};

std::string text(const MipBuildParams& p) {
  return fmt::format("{} {} {}x{}x{}", name(p.variant), name(p.format), p.width, p.height, p.depth);
}

// Values of all levels for which `bad(level number, channel, value)`.
template <class Bad>
double count(const Pyramid& pyramid, const MipBuildParams& p, Bad bad) {
  double sum = 0;
  for (const auto& [name, values] : pyramid)
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += bad(level_of(name), static_cast<int>(i) % channels(p.format), values[i]) ? 1 : 0;
  return sum;
}

void add_hidden_colour(std::vector<Case>& cases, const MipBuildParams& p) {
  cases.push_back(
      {"", fmt::format("a = 0 with NaN or infinity, {}", text(p)),
       "colour without opacity that is not finite does not leak: the bits are those of 0 there (values that differ)", 0,
       [=](Context& context) -> Result<double> {
         Values clean = mip_input(p, 21), dirty = clean;
         // f16 stores saturate infinities; NaN passes.
         const double bad[] = {nan, p.format == Format::f32x4 ? HUGE_VAL : nan,
                               p.format == Format::f32x4 ? -HUGE_VAL : nan};
         for (std::size_t i = 0; i < clean.size() / 4; i += 3)
           for (int c = 0; c < 4; ++c) {
             clean[i * 4 + c] = 0;
             dirty[i * 4 + c] = c == 3 ? 0 : bad[(i + c) % 3];
           }
         const auto a = build(context, p, dirty), b = build(context, p, clean);
         if (!a) return a.status();
         if (!b) return b.status();
         double different = 0;
         for (const auto& [name, values] : a.value()) different += count_different(values, b.value().at(name));
         return different;
       }});
}

void add_opaque(std::vector<Case>& cases, const MipBuildParams& p) {
  cases.push_back({"", fmt::format("opacity 1, {}", text(p)),
                   "an opaque block stays exactly opaque on every level (texels that do not)", 0,
                   [=](Context& context) -> Result<double> {
                     Values src = mip_input(p, 22);
                     for (std::size_t i = 3; i < src.size(); i += 4) src[i] = 1;
                     const auto levels = build(context, p, src);
                     if (!levels) return levels.status();
                     return count(levels.value(), p, [](int, int channel, double v) { return channel == 3 && v != 1; });
                   },
                   p.width == 16 && p.format != Format::f32x4, not_double});
}

void add_saturation(std::vector<Case>& cases) {
  for (const MipVariant v : colour_variants) {
    const MipBuildParams p = mip_params(v, Format::f16x4, {8, 8, 8});
    cases.push_back({"", fmt::format("f16 saturates, {}", name(v)),
                     "emission of 65504 everywhere stays at 65504, never infinity (values that do not)", 0,
                     [=](Context& context) -> Result<double> {
                       Values src(8 * 8 * 8 * 4, 65504.0);
                       for (std::size_t i = 3; i < src.size(); i += 4) src[i] = 0;
                       const auto levels = build(context, p, src);
                       if (!levels) return levels.status();
                       return count(levels.value(), p, [](int, int channel, double value) {
                         return value != (channel == 3 ? 0.0 : 65504.0);
                       });
                     },
                     false, not_double});
  }
}

void add_ties(std::vector<Case>& cases) {
  cases.push_back({"", "unorm8 rounds half to even",
                   "the mean of neighbouring steps goes to the even one (ties that do not, of 255)", 0,
                   [](Context& context) -> Result<double> {
                     MipBuildParams p = mip_params(MipVariant::isotropic, Format::unorm8x4, {510, 1, 1});
                     p.levels = 1;
                     Values src;
                     for (int k = 0; k < 255; ++k)
                       for (int i = 0; i < 2; ++i) src.insert(src.end(), 4, (k + i) / 255.0);
                     const auto levels = build(context, p, quantise(src, p.format));
                     if (!levels) return levels.status();
                     const Values& v = levels.value().at("level_1");
                     double wrong = 0;
                     for (int k = 0; k < 255; ++k)
                       wrong += std::lround(v[static_cast<std::size_t>(k) * 4] * 255) == k + k % 2 ? 0 : 1;
                     return wrong;
                   },
                   false, not_double});
}

void add_constants(std::vector<Case>& cases) {
  for (const double value : {0.7, 1.7e38, 1e-40})
    cases.push_back({"", fmt::format("constant {}", value),
                     "a constant volume of any extent stays constant to the bit (values that differ)", 0,
                     [=](Context& context) -> Result<double> {
                       const MipBuildParams p = mip_params(MipVariant::isotropic, Format::f32x1, {13, 7, 5});
                       const double stored = static_cast<float>(value);
                       const auto levels = build(context, p, Values(13 * 7 * 5, stored));
                       if (!levels) return levels.status();
                       return count(levels.value(), p, [=](int, int, double v) { return v != stored; });
                     }});
}

void add_emission(std::vector<Case>& cases) {
  for (const Format format : colour_formats)
    cases.push_back({"", fmt::format("emission without opacity, {}", name(format)),
                     "emission in front is seen whole, behind opacity 1 not at all (largest error in storage steps)", 1,
                     [=](Context& context) -> Result<double> {
                       // Along x: emission 1/2 (red), then an opaque green voxel.
                       Values src(8 * 4, 0.0);
                       src[0] = 0.5;
                       src[4 + 1] = 0.25;
                       src[4 + 3] = 1;
                       const MipBuildParams p = mip_params(MipVariant::anisotropic, format, {2, 2, 2});
                       const auto levels = build(context, p, quantise(src, format));
                       if (!levels) return levels.status();
                       const Values& front = levels.value().at("level_1_px");
                       const Values& back = levels.value().at("level_1_nx");
                       return std::fmax(std::fabs(front[0] - quantise(src, format)[0] / 4) / step(format, 0.125),
                                        back[0] == 0 ? 0 : nan);
                     }});
}

void add_moments(std::vector<Case>& cases) {
  struct Range {
    double low, high;
  };
  for (const Range r : {Range{256, 60000}, {10000, 10064}})
    cases.push_back({"", fmt::format("moments of {}..{} in f16", r.low, r.high),
                     "mean and deviation of z >= 256 hold in f16: within a unit 2^-11 a level of the mean (and "
                     "deviation), as a share of that",
                     1, [=](Context& context) -> Result<double> {
                       const MipBuildParams p = mip_params(MipVariant::moments, Format::f16x2, {64, 64, 1});
                       Values src = mip_distances(64 * 64, 23);
                       for (double& v : src)
                         v = static_cast<float>(r.low + (r.high - r.low) * std::log2(v / 0.1) / 13.3);
                       const auto levels = build(context, p, src);
                       if (!levels) return levels.status();
                       const auto truth = truth::pyramid(p, src);
                       double most = 0;
                       for (const auto& [name, v] : levels.value()) {
                         const int level = level_of(name);
                         const Values& t = truth[level].values;
                         for (std::size_t i = 0; i < v.size(); i += 2) {
                           const double mean = std::fabs(v[i] - t[i]) / (level * 0x1p-11 * t[i]);
                           const double sigma = std::fabs(v[i + 1] - t[i + 1]) / (level * 0x1p-11 * (t[i] + t[i + 1]));
                           if (!(std::fmax(mean, sigma) <= most))
                             most = std::isnan(mean + sigma) ? nan : std::fmax(mean, sigma);
                         }
                       }
                       return most;
                     }});
}

// Values that are multiples of a step, so that ties are as frequent as can be; errors in units of the last place of
// 1/2..1.
void add_drift(std::vector<Case>& cases, Format format, std::array<int, 3> extent, bool slow) {
  const auto measure = [=](bool mean) {
    return [=](Context& context) -> Result<double> {
      const MipBuildParams p = mip_params(MipVariant::isotropic, format, extent);
      const std::size_t n = static_cast<std::size_t>(extent[0]) * extent[1] * extent[2];
      Values src = mip_distances(n * 4, 24);
      for (double& v : src) v = std::floor(std::log2(v / 0.1) / 13.3001 * 256) / 255;
      src = quantise(src, format);
      const auto levels = build(context, p, src);
      if (!levels) return levels.status();
      const auto truth = truth::pyramid(p, src);
      const double unit = step(format, 0.75);
      double most = 0;
      for (const auto& [name, v] : levels.value()) {
        const int level = level_of(name);
        double sum = 0, largest = 0;
        for (std::size_t i = 0; i < v.size(); ++i) {
          const double d = (v[i] - truth[level].values[i]) / unit;
          sum += d;
          largest = std::fmax(largest, std::fabs(d));
        }
        if (mean && v.size() < 16 * 16 * 16 * 4) continue;
        const double value = mean ? std::fabs(sum / static_cast<double>(v.size())) : largest / level;
        if (!(value <= most)) most = value;
      }
      return most;
    };
  };
  const std::string what = fmt::format("{} {}x{}x{}", name(format), extent[0], extent[1], extent[2]);
  cases.push_back(
      {"", "mean drift, " + what,
       "the mean of a level of 16^3 or more texels drifts by at most 1/16 step (half up drifts so much a level)",
       1.0 / 16, measure(true), slow});
  // f32 rounds in its last place too, a few times a level.
  cases.push_back({"", "drift of a texel, " + what,
                   "no texel drifts by more than half a step a level (f32: and two more, of its arithmetic)",
                   format == Format::f32x4 ? 2.5 : 0.5 + 1e-3, measure(false), slow});
}

}  // namespace

void add_mip_value_cases(std::vector<Case>& cases) {
  for (const MipVariant v : colour_variants) {
    add_hidden_colour(cases, mip_params(v, Format::f32x4, {8, 8, 8}));
    add_hidden_colour(cases, mip_params(v, Format::f32x4, {5, 7, 3}));
    add_hidden_colour(cases, mip_params(v, Format::f16x4, {9, 4, 1}));
    for (const Format format : colour_formats) {
      add_opaque(cases, mip_params(v, format, {16, 16, 16}));
      add_opaque(cases, mip_params(v, format, {15, 9, 27}));
    }
  }
  add_saturation(cases);
  add_ties(cases);
  add_constants(cases);
  add_emission(cases);
  add_moments(cases);
  for (const Format format : colour_formats) {
    add_drift(cases, format, {64, 64, 64}, false);
    add_drift(cases, format, {256, 64, 64}, true);
  }
}

}  // namespace luxel::cases

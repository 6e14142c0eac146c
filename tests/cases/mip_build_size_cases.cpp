// Extents of all kinds against the truth, forms and executions against each other.
#include <cmath>

#include <fmt/format.h>

#include "bench/truth/mip_truth.h"
#include "tests/cases/compare.h"
#include "tests/cases/mip_build_support.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

std::string text(const MipBuildParams& p) {
  return fmt::format("{} {} {}x{}x{}{}", name(p.variant), name(p.format), p.width, p.height, p.depth,
                     p.samples == MipSamples::vertices ? " vertices" : "");
}

// Units of the last place a level that a result may be off: its own rounding (1/2) and, in f32, that of a few
// operations; compositing hands the error of a front voxel on to what lies behind, up to three times.
double units_a_level(const MipBuildParams& p) {
  const bool f32 = p.format == Format::f32x1 || p.format == Format::f32x2 || p.format == Format::f32x4;
  return f32 ? (p.variant == MipVariant::anisotropic ? 12 : 4)
             : (p.variant == MipVariant::anisotropic ? 1.5 : 0.5 + 1e-3);
}

void add_size(std::vector<Case>& cases, const MipBuildParams& p) {
  cases.push_back(
      {"", text(p),
       "any extent: within a few units of the storage format's last place a level of the truth (units a level)",
       units_a_level(p), [=](Context& context) -> Result<double> {
         const Values src = mip_input(p, 31);
         const auto levels = build(context, p, src);
         if (!levels) return levels.status();
         std::map<int, std::vector<truth::Level>> truths;
         double most = 0;
         for (const auto& [name, v] : levels.value()) {
           const int level = level_of(name), direction = direction_of(name);
           if (!truths.contains(direction)) truths[direction] = truth::pyramid(p, src, direction);
           const Values& t = truths[direction][level].values;
           if (v.size() != t.size()) return Status(Code::internal, name + " has another size than the truth");
           const double scale = p.variant == MipVariant::moments ? 0.0 : 1.0;
           for (std::size_t i = 0; i < v.size(); ++i) {
             // A deviation is as exact as the means that it is made of.
             const double size =
                 p.variant == MipVariant::moments ? std::fmax(t[i - i % 2], t[i]) : std::fmax(std::fabs(t[i]), scale);
             const double units = std::fabs(v[i] - t[i]) / step(p.format, size) / level;
             if (!(units <= most)) most = units;
           }
         }
         return most;
       }});
}

void add_same_bits(std::vector<Case>& cases, const MipBuildParams& p) {
  cases.push_back({"", "bits, " + text(p), "the same bits as the C++ execution in float (values that differ)", 0,
                   [=](Context& context) -> Result<double> {
                     const Values src = mip_input(p, 32);
                     const auto levels = build(context, p, src);
                     if (!levels) return levels.status();
                     const auto cpu = Context::open("cpu:float");
                     if (!cpu) return cpu.status();
                     const auto expected = build(*cpu.value(), p, src);
                     if (!expected) return expected.status();
                     double different = 0;
                     for (const auto& [name, values] : levels.value())
                       different += count_different(values, expected.value().at(name));
                     return different;
                   },
                   p.width == 16 && p.format != Format::f32x4, not_double});
}

void add_single_pass(std::vector<Case>& cases, const MipBuildParams& p) {
  cases.push_back({"", "single pass, " + text(p),
                   "three levels a dispatch give the bits of one level a dispatch (values that differ)", 0,
                   [=](Context& context) -> Result<double> {
                     const Values src = mip_input(p, 33);
                     const auto a = build(context, p, src, true), b = build(context, p, src, false);
                     if (!a) return a.status();
                     if (!b) return b.status();
                     double different = 0;
                     for (const auto& [name, values] : a.value())
                       different += count_different(values, b.value().at(name));
                     return different;
                   },
                   false, not_double});
}

}  // namespace

void add_mip_size_cases(std::vector<Case>& cases) {
  const std::array<int, 3> extents[] = {{16, 16, 16}, {17, 16, 15}, {1, 9, 4}, {33, 31, 1}, {129, 1, 1}, {1, 1, 127}};
  for (const auto& e : extents)
    for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4}) {
      add_size(cases, mip_params(MipVariant::isotropic, format, e));
      if (format == Format::f32x4 || e[0] == 17) add_size(cases, mip_params(MipVariant::anisotropic, format, e));
      if (format == Format::f32x4 || e[0] == 17) add_size(cases, mip_params(MipVariant::gaussian3, format, e));
    }
  MipBuildParams vertices = mip_params(MipVariant::gaussian3, Format::f32x4, {17, 9, 5});
  vertices.samples = MipSamples::vertices;
  add_size(cases, vertices);
  for (const Format format : {Format::f32x2, Format::f16x2})
    add_size(cases, mip_params(MipVariant::moments, format, {63, 65, 1}));

  for (const auto& e : {std::array{16, 16, 16}, {13, 7, 5}})
    for (const MipVariant v : {MipVariant::isotropic, MipVariant::anisotropic, MipVariant::gaussian3})
      for (const Format format : {Format::f32x4, Format::f16x4, Format::unorm8x4})
        add_same_bits(cases, mip_params(v, format, e));
  add_same_bits(cases, mip_params(MipVariant::isotropic, Format::f32x1, {31, 17, 3}));
  add_same_bits(cases, vertices);
  for (const Format format : {Format::f32x2, Format::f16x2})
    for (const MipVariant v : {MipVariant::minmax, MipVariant::moments})
      add_same_bits(cases, mip_params(v, format, {37, 53, 1}));
  for (const MipVariant v : {MipVariant::min, MipVariant::max})
    add_same_bits(cases, mip_params(v, Format::f32x1, {37, 53, 1}));

  add_single_pass(cases, mip_params(MipVariant::isotropic, Format::f32x4, {32, 16, 24}));
  add_single_pass(cases, mip_params(MipVariant::isotropic, Format::unorm8x4, {64, 32, 1}));
  add_single_pass(cases, mip_params(MipVariant::minmax, Format::f32x2, {64, 48, 1}));
}

}  // namespace luxel::cases

// What bilateral leaves out: pixels whose noise is below a target; tiles without edges; steps that leave the image; and what the pairs of `adaptive`
// mix across edges.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr int width = 45, height = 37;

BilateralParams guided(BilateralVariant variant) {
  BilateralParams p = bilateral_params(width, height, "dnl");
  p.variant = variant;
  p.levels = 2;
  return p;
}

// The variance that the luminance term looks at.
double smoothed(const Values& variance, int x, int y) {
  double sum = 0;
  for (int j = -1; j <= 1; ++j)
    for (int i = -1; i <= 1; ++i)
      sum += (2 - std::abs(i)) * (2 - std::abs(j)) / 16.0 *
             variance[std::clamp(y + j, 0, height - 1) * width + std::clamp(x + i, 0, width - 1)];
  return sum;
}

void add_targets(std::vector<Case>& cases) {
  for (const BilateralVariant variant : {BilateralVariant::direct, BilateralVariant::separable, BilateralVariant::atrous})
    cases.push_back({"", fmt::format("variance target above all noise, variant {}", static_cast<int>(variant)),
                     "the input, bit for bit, and its variance (values that differ)", 0,
                     [=](Context& context) -> Result<double> {
                       BilateralParams p = guided(variant);
                       p.variance_target = 1;
                       p.carry_variance = variant == BilateralVariant::atrous;
                       const BilateralImages images = bilateral_images(p, 21);
                       const auto out = filter(context, p, images);
                       if (!out) return out.status();
                       return count_different(out.value().dst, images.src) +
                              (p.carry_variance ? count_different(out.value().variance_out, images.variance) : 0);
                     }});
  cases.push_back({"", "variance target amid the noise",
                   "pixels below keep their value to the bit, most others do not (values that break it)", 0,
                   [](Context& context) -> Result<double> {
                     BilateralParams p = guided(BilateralVariant::direct);
                     p.variance_target = 0.011;
                     const BilateralImages images = bilateral_images(p, 22);
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     double bad = 0, above = 0, kept = 0;
                     for (int i = 0; i < width * height; ++i) {
                       const double v = smoothed(images.variance, i % width, i / width);
                       const bool as_before = same(out.value().dst[4 * i], images.src[4 * i]);
                       if (v < 0.0109999) bad += !as_before;
                       if (v > 0.0110001) {
                         ++above;
                         kept += as_before;
                       }
                     }
                     return bad + (above > 100 && kept <= 0.05 * above ? 0 : 1e6);
                   }});
  cases.push_back({"", "variance target, levels by the formula",
                   "each level of atrous asks anew what is below (largest difference from the formula)", 4e-5,
                   [](Context& context) -> Result<double> {
                     BilateralParams p = guided(BilateralVariant::atrous);
                     p.variance_target = 0.004;
                     const BilateralImages images = bilateral_images(p, 23);
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     return max_difference(out.value().dst, truth::bilateral(p, images).src);
                   }});
  cases.push_back({"", "variance target 0", "nothing is left out: the same bits as a target below all noise (values that differ)",
                   0, [](Context& context) -> Result<double> {
                     BilateralParams p = guided(BilateralVariant::atrous);
                     const BilateralImages images = bilateral_images(p, 24);
                     const auto a = filter(context, p, images);
                     p.variance_target = 1e-12;
                     const auto b = filter(context, p, images);
                     if (!a) return a.status();
                     if (!b) return b.status();
                     return count_different(a.value().dst, b.value().dst);
                   }});
}

// A ramp of colour, a guide, a plane seen at a slant and its normal, all but even; across the middle, or down, an edge in each.
BilateralImages even_images(const BilateralParams& p, bool down) {
  BilateralImages m = bilateral_images(p, 29);
  const int n = channels(p.format), g = channels(p.guide_format);
  for (int i = 0; i < p.width * p.height; ++i) {
    const int x = i % p.width, y = i / p.width, side = (down ? y >= p.height / 2 : x >= p.width / 2) ? 1 : 0;
    const double step = 0.4 * side, wave = 0.002 * std::sin(0.7 * x + 0.4 * y);
    if (p.range == RangeTerm::self || p.luminance)  // else noise
      for (int c = 0; c < n; ++c) m.src[i * n + c] = 0.3 + step + 0.0004 * y + wave * (c + 1);
    for (int c = 0; c < g; ++c) m.guide[i * g + c] = 0.2 + step - 0.0003 * x + wave;
    m.depth[i] = 1 / (0.5 - 0.002 * y + 0.1 * side);
    const double normal[4] = {side ? 0.6 : 0.0, 0, side ? 0.8 : 1.0, 0};
    for (int c = 0; c < 4; ++c) m.normals[4 * i + c] = normal[c];
    m.variance[i] = 0.01;
  }
  m.src = quantise(m.src, p.format);
  m.guide = quantise(m.guide, p.guide_format);
  m.depth = quantise(m.depth, Format::f32x1);
  m.normals = quantise(m.normals, p.normal_format);
  return m;
}

// Against the filter of all tiles: the edge's tiles must be equal to the bit, the others within the promised part of what
// colours differ by, and most of them must have taken the other way. One pixel is no number: the tiles that it reaches stay.
Case flat_tiles(const std::string& terms, Format format, Border border, bool down = false) {
  return {"",
          fmt::format("flat tiles, terms '{}', {}, border {}{}", terms, name(format), static_cast<int>(border),
                      down ? ", edge down" : ""),
          "tiles at an edge to the bit, others within flat/4 (1 + flat) of what colours differ by (parts of that)",
          1,
          [=](Context& context) -> Result<double> {
            constexpr int w = 156, h = 92, reach = 4;  // the edges are reached by tiles beside them
            BilateralParams p = bilateral_params(w, h, terms, format, border);
            p.sigma_luminance = 10;
            BilateralImages images = even_images(p, down);
            const int n = channels(format);
            constexpr int spoilt_x = 18, spoilt_y = 47;  // reached from tiles to the left and below
            images.src[(spoilt_y * w + spoilt_x) * n] = std::numeric_limits<double>::quiet_NaN();
            const auto all = filter(context, p, images);
            p.flat = 0.1;
            const auto some = filter(context, p, images);
            if (!all) return all.status();
            if (!some) return some.status();
            double worst = 0;
            int changed = 0;
            const auto reached = [&](int begin, int at, int size) {
              return at >= begin - reach && at <= std::min(begin + 15, size - 1) + reach;
            };
            for (int y = 0; y < h; ++y)
              for (int x = 0; x < w; ++x) {
                const int tx = x / 16 * 16, ty = y / 16 * 16;
                const int begin = down ? ty : tx, size = down ? h : w;
                const bool edge =
                    terms.size() > 0 && begin - reach < size / 2 && std::min(begin + 15, size - 1) + reach >= size / 2;
                const bool spoilt = reached(tx, spoilt_x, w) && reached(ty, spoilt_y, h);
                for (int c = 0; c < n; ++c) {
                  const double a = all.value().dst[(y * w + x) * n + c], b = some.value().dst[(y * w + x) * n + c];
                  changed += !same(a, b);
                  if (edge || spoilt) {
                    worst = std::max(worst, same(a, b) ? 0.0 : HUGE_VAL);
                    continue;
                  }
                  double least = 1e9, greatest = -1e9;
                  for (int j = -reach; j <= reach; ++j)
                    for (int i = -reach; i <= reach; ++i) {
                      const double v =
                          images.src[(std::clamp(y + j, 0, h - 1) * w + std::clamp(x + i, 0, w - 1)) * n + c];
                      least = std::min(least, v);
                      greatest = std::max(greatest, v);
                    }
                  worst = std::max(worst, (std::fabs(a - b) - 4e-7) / (p.flat / 4 * (1 + p.flat) * (greatest - least)));
                }
              }
            return changed > 1000 ? worst : HUGE_VAL;
          },
          terms.size() > 0 && terms != "c" && terms != "cdnl" && !down};
}

// Columns of two colours: their weights are 1 - flat where they differ by `critical`.
Case flat_limit(const char* where, double part, bool flat) {
  return {
      "", fmt::format("flat tiles, colours {} the limit", where),
      flat ? "every pixel takes the other way (pixels that do not)" : "no pixel takes the other way (pixels that do)",
      0, [=](Context& context) -> Result<double> {
        BilateralParams p = bilateral_params(64, 48, "c", Format::f32x1);
        const double critical = p.sigma_range * std::sqrt(-2 * std::log(0.9));
        BilateralImages images = bilateral_images(p, 31);
        for (int i = 0; i < p.width * p.height; ++i) images.src[i] = 0.25 + (i % 64 % 3 == 0 ? part * critical : 0);
        images.src = quantise(images.src, p.format);
        const auto all = filter(context, p, images);
        p.flat = 0.1;
        const auto some = filter(context, p, images);
        if (!all) return all.status();
        if (!some) return some.status();
        const double changed = count_different(all.value().dst, some.value().dst);
        return flat ? 64 * 48 - changed : changed;
      }};
}

void add_flat(std::vector<Case>& cases) {
  for (const std::string terms : {"", "c", "g", "d", "n", "l", "cdnl"})
    cases.push_back(flat_tiles(terms, Format::f32x4, Border::clamp));
  cases.push_back(flat_tiles("c", Format::f32x1, Border::mirror));
  cases.push_back(flat_tiles("d", Format::f32x4, Border::clamp, true));
  cases.push_back(flat_limit("below", 0.99, true));
  cases.push_back(flat_limit("above", 1.01, false));
  cases.push_back({"", "flat tiles of a constant image", "constant to the bit (values that differ)", 0,
                   [](Context& context) -> Result<double> {
                     BilateralParams p = bilateral_params(width, height, "c");
                     p.flat = 0.05;
                     BilateralImages images = bilateral_images(p, 30);
                     images.src.assign(images.src.size(), 0.25);
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     return count_different(out.value().dst, images.src);
                   }});
}

// Taps that all lie outside.
void add_steps(std::vector<Case>& cases) {
  for (const Border border : {Border::clamp, Border::mirror, Border::wrap, Border::zero}) {
    cases.push_back({"", fmt::format("6 levels on 7x5, border {}", static_cast<int>(border)),
                     "taps 32 pixels apart on an image of 7 follow the formula (largest difference)", 4e-5,
                     [=](Context& context) -> Result<double> {
                       BilateralParams p = bilateral_params(7, 5, "c", Format::f32x1, border);
                       p.variant = BilateralVariant::atrous;
                       p.levels = 6;
                       const BilateralImages images = bilateral_images(p, 25);
                       const auto out = filter(context, p, images);
                       if (!out) return out.status();
                       return max_difference(out.value().dst, truth::bilateral(p, images).src);
                     },
                     border != Border::clamp});
    cases.push_back({"", fmt::format("steps of 16 on 9x6, border {}", static_cast<int>(border)),
                     "a stride above the width follows the formula (largest difference)", 2e-6,
                     [=](Context& context) -> Result<double> {
                       BilateralParams p = bilateral_params(9, 6, "c", Format::f32x1, border);
                       p.step = 16;
                       p.radius = 48;
                       p.sigma_space = 24;
                       const BilateralImages images = bilateral_images(p, 26);
                       const auto out = filter(context, p, images);
                       if (!out) return out.status();
                       return max_difference(out.value().dst, truth::bilateral(p, images).src);
                     },
                     border != Border::clamp});
  }
}

// Pairs average pixels of both sides of an edge: their mean differs less from either than the sides do.
void add_mixing(std::vector<Case>& cases) {
  constexpr int side = 49, edge = 24;
  const auto leak = [=](Context& context, bool adaptive, const std::string& terms) -> Result<double> {
    BilateralParams p = bilateral_params(side, side, terms, Format::f32x1);
    p.variant = BilateralVariant::separable;
    p.adaptive = adaptive;
    p.radius = 12;
    p.sigma_space = 6;
    BilateralImages images = bilateral_images(p, 27);
    images.guide.assign(images.guide.size(), 0.5);
    for (int i = 0; i < side * side; ++i) {
      images.src[i] = i % side >= edge ? 1 : 0;
      images.depth[i] = i % side >= edge ? 1 : 4;
      for (int c = 0; c < 3; ++c) images.normals[4 * i + c] = c == (i % side >= edge ? 0 : 2);
    }
    const auto out = filter(context, p, images);
    if (!out) return out.status();
    return max_difference(out.value().dst, images.src);
  };
  cases.push_back({"", "a step of five sigma_range, separable",
                   "what crosses the edge where taps are pixels (largest part of the step)", 3e-5,
                   [=](Context& context) { return leak(context, false, "c"); }});
  cases.push_back({"", "a step of five sigma_range, adaptive",
                   "what the averaged pairs of the outer half carry across (largest part of the step)", 0.01,
                   [=](Context& context) { return leak(context, true, "c"); }});
  cases.push_back({"", "a step in depth and normals, adaptive",
                   "pairs that straddle it weigh by their averaged guides (largest part of the step)", 1e-6,
                   [=](Context& context) { return leak(context, true, "dn"); }});
}

void add_adaptive_nan(std::vector<Case>& cases) {
  for (const std::string terms : {"c", "gdn"})
    cases.push_back({"", fmt::format("one NaN, adaptive, terms '{}'", terms),
                     "the pixel stays, all others lie among the other values (values that break it)", 0,
                     [=](Context& context) -> Result<double> {
                       BilateralParams p = bilateral_params(width, height, terms, Format::f32x1);
                       p.variant = BilateralVariant::separable;
                       p.adaptive = true;
                       p.radius = 9;
                       BilateralImages images = bilateral_images(p, 28);
                       const std::size_t at = 18 * width + 20;
                       images.src[at] = std::numeric_limits<double>::quiet_NaN();
                       const auto out = filter(context, p, images);
                       if (!out) return out.status();
                       double bad = 0;
                       for (std::size_t i = 0; i < images.src.size(); ++i)
                         bad += i == at ? !same(out.value().dst[i], images.src[i])
                                        : !(out.value().dst[i] >= 0 && out.value().dst[i] <= 1.01);
                       return bad;
                     }});
}

}  // namespace

void add_bilateral_left_out_cases(std::vector<Case>& cases) {
  add_targets(cases);
  add_flat(cases);
  add_steps(cases);
  add_mixing(cases);
  add_adaptive_nan(cases);
}

}  // namespace luxel::cases

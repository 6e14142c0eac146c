// The variants that are kernels of their own (grid, discontinuity, upsample), and the kernels beside the filter: variance,
// outlier_clamp, discontinuity_mask. Each against its definition, and its extreme cases.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <luxel/discontinuity_mask.h>
#include <luxel/outlier_clamp.h>
#include <luxel/variance.h>

#include "bench/scene/images.h"
#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/run.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int width = 41, height = 33;

using Inputs = std::vector<std::pair<std::string, Values>>;

Result<Values> result_of(Context& context, const Result<Plan>& plan, const Inputs& inputs, const std::string& output) {
  Result<Run> made = Run::make(context, plan);
  if (!made) return made.status();
  Run& run = made.value();
  for (const auto& [name, values] : inputs)
    if (Status status = run.write(name, values); !status) return status;
  if (Status status = run.go(); !status) return status;
  return run.read(output);
}

BilateralImages images() { return bilateral_images(bilateral_params(width, height, "c"), 30, true); }

// The largest difference from C++ float in any bit, as a count.
Case equal_bits(std::string kernel, std::string name, std::function<Result<Values>(Context&)> compute) {
  return {std::move(kernel),
          "bits, " + name,
          "the same bits as the C++ execution in float (values that differ)",
          0,
          [=](Context& context) -> Result<double> {
            const auto cpu = Context::open("cpu:float");
            if (!cpu) return cpu.status();
            const auto a = compute(context), b = compute(*cpu.value());
            if (!a) return a.status();
            if (!b) return b.status();
            return count_different(a.value(), b.value());
          },
          false,
          not_double};
}

Result<Values> mask_of(Context& context, const BilateralImages& m) {
  DiscontinuityMaskParams p;
  p.width = width;
  p.height = height;
  return result_of(context, plan(p, context.profile()), {{"depth", m.depth}, {"normals", m.normals}}, "mask");
}

Result<Values> stopped(Context& context, const Values& src, const Values& mask) {
  BilateralParams p = bilateral_params(width, height, "");
  p.variant = BilateralVariant::discontinuity;
  return result_of(context, plan(p, context.profile()), {{"src", src}, {"mask", mask}}, "dst");
}

Result<Values> gridded(Context& context, const Values& src, double cell, double range) {
  BilateralParams p = bilateral_params(width, height, "c");
  p.variant = BilateralVariant::grid;
  p.sigma_space = cell;
  p.sigma_range = range;
  return result_of(context, plan(p, context.profile()), {{"src", src}}, "dst");
}

void add_mask(std::vector<Case>& cases) {
  cases.push_back(
      equal_bits("discontinuity_mask", "depth and normals", [](Context& c) { return mask_of(c, images()); }));
  cases.push_back({"discontinuity_mask", "symmetric",
                   "both pixels hold the same verdict of the edge between them (pairs that do not)", 0,
                   [](Context& context) -> Result<double> {
                     const auto mask = mask_of(context, images());
                     if (!mask) return mask.status();
                     const auto bit = [&](int x, int y, int b) {
                       return static_cast<int>(mask.value()[y * width + x]) >> b & 1;
                     };
                     double bad = 0;
                     for (int y = 0; y < height; ++y)
                       for (int x = 0; x < width; ++x) {
                         if (x + 1 < width) bad += bit(x, y, 0) != bit(x + 1, y, 2);
                         if (y + 1 < height) bad += bit(x, y, 1) != bit(x, y + 1, 3);
                       }
                     return bad;
                   }});
  cases.push_back({"discontinuity_mask", "a slanted floor and a step",
                   "a floor has no edge inside, up to its horizon; a step of a tenth, or a turn of 90 degrees, has one "
                   "(pixels wrong)",
                   0, [](Context& context) -> Result<double> {
                     BilateralImages m = images();
                     for (int i = 0; i < width * height; ++i) {
                       const int x = i % width, y = i / width;
                       m.depth[i] = static_cast<float>(20.0 / (y + 0.5) * (x < 20 ? 1 : 1.1));
                       for (int c = 0; c < 3; ++c) m.normals[4 * i + c] = c == (x < 30 ? 1 : 0);
                     }
                     const auto mask = mask_of(context, m);
                     if (!mask) return mask.status();
                     double bad = 0;
                     for (int y = 0; y < height; ++y)
                       for (int x = 0; x + 1 < width; ++x) {
                         const int bits = static_cast<int>(mask.value()[y * width + x]);
                         bad += (bits & 1) != (x == 19 || x == 29);
                         if (y + 1 < height) bad += (bits & 2) != 0;
                       }
                     return bad;
                   }});
  cases.push_back({"discontinuity_mask", "sky, NaN and infinity",
                   "sky beside sky is no edge; sky beside a surface and a depth of NaN are (pixels wrong)", 0,
                   [](Context& context) -> Result<double> {
                     BilateralImages m = images();
                     m.depth.assign(m.depth.size(), 5.0);
                     for (std::size_t i = 0; i < m.normals.size(); ++i) m.normals[i] = i % 4 == 2;
                     for (int i = 0; i < width * height; ++i)
                       if (i % width < 10) m.depth[i] = i % 2 ? 1e10 : HUGE_VAL;
                     m.depth[20 * width + 20] = nan;
                     const auto mask = mask_of(context, m);
                     if (!mask) return mask.status();
                     double bad = 0;
                     for (int y = 0; y < height; ++y)
                       for (int x = 0; x + 1 < width; ++x)
                         bad += (static_cast<int>(mask.value()[y * width + x]) & 1) !=
                                (x == 9 || (y == 20 && (x == 19 || x == 20)));
                     return bad;
                   }});
}

void add_discontinuity(std::vector<Case>& cases) {
  cases.push_back(equal_bits("bilateral", "variant discontinuity", [](Context& c) -> Result<Values> {
    const BilateralImages m = images();
    const auto mask = mask_of(c, m);
    if (!mask) return mask.status();
    return stopped(c, m.src, mask.value());
  }));
  cases.push_back({"bilateral", "discontinuity stops at edges",
                   "an edge across the image lets nothing through (largest value on the dark side)", 0,
                   [](Context& context) -> Result<double> {
                     Values src(width * height * 4, 0.0), mask(width * height, 0.0);
                     for (int i = 0; i < width * height; ++i) {
                       const int x = i % width, y = i / width;
                       for (int c = 0; c < 4; ++c) src[4 * i + c] = x > 20 ? 1e6 : 0;
                       mask[i] = (x == width - 1 || x == 20 ? 1 : 0) + (y == height - 1 ? 2 : 0) +
                                 (x == 0 || x == 21 ? 4 : 0) + (y == 0 ? 8 : 0);
                     }
                     const auto out = stopped(context, src, mask);
                     if (!out) return out.status();
                     double most = 0;
                     for (int i = 0; i < width * height; ++i)
                       if (i % width <= 20 && !(out.value()[4 * i] <= most)) most = out.value()[4 * i];
                     return most;
                   }});
  cases.push_back({"bilateral", "discontinuity, one NaN",
                   "the pixel stays, all others are finite (values that break it)", 0,
                   [](Context& context) -> Result<double> {
                     BilateralImages m = images();
                     const auto mask = mask_of(context, m);
                     if (!mask) return mask.status();
                     const std::size_t at = 4 * (16 * width + 10);
                     m.src[at + 1] = nan;
                     const auto out = stopped(context, m.src, mask.value());
                     if (!out) return out.status();
                     double bad = 0;
                     for (std::size_t i = 0; i < m.src.size(); ++i)
                       bad += i / 4 == at / 4 ? !same(out.value()[i], m.src[i]) : !std::isfinite(out.value()[i]);
                     return bad;
                   }});
}

void add_grid(std::vector<Case>& cases) {
  cases.push_back(equal_bits("bilateral", "variant grid", [](Context& c) { return gridded(c, images().src, 5, 0.1); }));
  // Coordinates are rounded to 2^-24 of 41 pixels, averages of equal values by some roundings.
  cases.push_back({"bilateral", "grid, a constant image", "stays constant to rounding (largest difference)", 1e-6,
                   [](Context& context) -> Result<double> {
                     const Values src = quantise(Values(width * height * 4, 0.7), Format::f32x4);
                     const auto out = gridded(context, src, 4, 0.1);
                     if (!out) return out.status();
                     return max_difference(out.value(), src);
                   }});
  cases.push_back({"bilateral", "grid beside direct",
                   "on two levels 0.35 apart with noise, within 0.12 of the filter of the grid's own width (largest "
                   "difference of colour)",
                   0.12, [](Context& context) -> Result<double> {
                     BilateralParams p = bilateral_params(width, height, "c");
                     p.sigma_space = 3;
                     p.radius = 9;
                     p.sigma_range = 0.15;
                     const BilateralImages m = images();
                     const auto out = gridded(context, m.src, 3, 0.15);
                     if (!out) return out.status();
                     return max_difference(out.value(), truth::bilateral(p, m).src);
                   }});
  cases.push_back({"bilateral", "grid, one NaN", "the pixel stays, all others are finite (values that break it)", 0,
                   [](Context& context) -> Result<double> {
                     Values src = images().src;
                     src[4 * 500 + 2] = nan;
                     const auto out = gridded(context, src, 4, 0.1);
                     if (!out) return out.status();
                     double bad = 0;
                     for (std::size_t i = 0; i < src.size(); ++i)
                       bad += i / 4 == 500 ? !same(out.value()[i], src[i]) : !std::isfinite(out.value()[i]);
                     return bad;
                   }});
}

Inputs upsample_inputs(int ratio, bool normal) {
  const BilateralImages m = images();
  const int w = (width + ratio - 1) / ratio, h = (height + ratio - 1) / ratio;
  Inputs in{{"src", {}}, {"depth_low", {}}, {"depth", m.depth}};
  Values normals_low;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * ratio * width + x * ratio;
      in[1].second.push_back(m.depth[i]);
      for (int c = 0; c < 4; ++c) in[0].second.push_back(m.src[4 * i + c]);
      for (int c = 0; c < 4; ++c) normals_low.push_back(m.normals[4 * i + c]);
    }
  if (normal) {
    in.emplace_back("normals_low", normals_low);
    in.emplace_back("normals", m.normals);
  }
  return in;
}

BilateralUpsampleParams upsample_params(int ratio, bool normal) {
  BilateralUpsampleParams p;
  p.width = width;
  p.height = height;
  p.ratio = ratio;
  p.normal = normal;
  p.footprint = 0.05;
  return p;
}

void add_upsample(std::vector<Case>& cases) {
  for (const int ratio : {2, 4})
    for (const bool normal : {false, true})
      cases.push_back(equal_bits("bilateral", fmt::format("upsample from 1/{}{}", ratio, normal ? " with normals" : ""),
                                 [=](Context& c) {
                                   return result_of(c, plan(upsample_params(ratio, normal), c.profile()),
                                                    upsample_inputs(ratio, normal), "dst");
                                 }));
  for (const bool nearest : {false, true})
    cases.push_back({"bilateral", fmt::format("upsample, two depths{}", nearest ? ", nearest depth" : ""),
                     "a surface takes from low pixels of its own depth alone, also where a thin one is seen by few of "
                     "them (largest "
                     "difference from its colour)",
                     1e-6, [=](Context& context) -> Result<double> {
                       BilateralUpsampleParams p = upsample_params(4, false);
                       p.nearest_depth = nearest;
                       p.footprint = 0.001;
                       const int w = (width + 3) / 4, h = (height + 3) / 4;
                       Values src, depth_low, depth, expected;
                       for (int i = 0; i < w * h; ++i) {
                         const bool close = i % w < 5;
                         depth_low.push_back(close ? 1 : 50);
                         for (int c = 0; c < 4; ++c) src.push_back(close ? 0.25 : 0.75);
                       }
                       for (int i = 0; i < width * height; ++i) {
                         const bool close = i % width < 18;
                         depth.push_back(close ? 1 : 50);
                         for (int c = 0; c < 4; ++c) expected.push_back(close ? 0.25 : 0.75);
                       }
                       const auto out = result_of(context, plan(p, context.profile()),
                                                  {{"src", src}, {"depth_low", depth_low}, {"depth", depth}}, "dst");
                       if (!out) return out.status();
                       return max_difference(out.value(), expected);
                     }});
}

void add_upsample_values(std::vector<Case>& cases) {
  cases.push_back({"bilateral", "upsample, one NaN", "taps that are not finite do not count: all are finite (values that are not)",
                   0, [](Context& context) -> Result<double> {
                     Inputs in = upsample_inputs(2, false);
                     in[0].second[4 * 100 + 1] = nan;
                     in[0].second[4 * 150] = HUGE_VAL;
                     const auto out = result_of(context, plan(upsample_params(2, false), context.profile()), in, "dst");
                     if (!out) return out.status();
                     return std::count_if(out.value().begin(), out.value().end(),
                                          [](double v) { return !std::isfinite(v); });
                   }});
  cases.push_back({"bilateral", "upsample, sky",
                   "sky takes from sky, surfaces take nothing of it (largest difference from the colour of each)", 1e-6,
                   [](Context& context) -> Result<double> {
                     const int w = (width + 1) / 2, h = (height + 1) / 2;
                     Values src, depth_low, depth, expected;
                     for (int i = 0; i < w * h; ++i) {
                       const bool sky = i / w < 8;
                       depth_low.push_back(sky ? HUGE_VAL : 3);
                       for (int c = 0; c < 4; ++c) src.push_back(sky ? 1000 : 0.5);
                     }
                     for (int i = 0; i < width * height; ++i) {
                       const bool sky = i / width < 16;
                       depth.push_back(sky ? 1e10 : 3);
                       for (int c = 0; c < 4; ++c) expected.push_back(sky ? 1000 : 0.5);
                     }
                     const auto out = result_of(context, plan(upsample_params(2, false), context.profile()),
                                                {{"src", src}, {"depth_low", depth_low}, {"depth", depth}}, "dst");
                     if (!out) return out.status();
                     double most = 0;
                     for (std::size_t i = 0; i < expected.size(); ++i) {
                       const double e = std::fabs(out.value()[i] / expected[i] - 1);
                       if (!(e <= most)) most = e;
                     }
                     return most;
                   }});
}

Result<Values> spread(Context& context, const Values& src) {
  VarianceParams p;
  p.width = width;
  p.height = height;
  p.format = Format::f32x1;
  return result_of(context, plan(p, context.profile()), {{"src", src}}, "variances");
}

void add_variance(std::vector<Case>& cases) {
  const Values noise = scene::noise(width, height, 1, 40);
  cases.push_back(equal_bits("variance", "spatial", [=](Context& c) { return spread(c, noise); }));
  cases.push_back({"variance", "spatial, by its definition", "sum (l - mean)^2 / (n - 1) over 7x7 (largest difference)",
                   1e-6, [=](Context& context) -> Result<double> {
                     const auto out = spread(context, noise);
                     if (!out) return out.status();
                     Values expected;
                     for (int y = 0; y < height; ++y)
                       for (int x = 0; x < width; ++x) {
                         double sum = 0, squares = 0, n = 0;
                         for (int j = std::max(y - 3, 0); j <= std::min(y + 3, height - 1); ++j)
                           for (int i = std::max(x - 3, 0); i <= std::min(x + 3, width - 1); ++i, ++n) {
                             sum += noise[j * width + i];
                             squares += noise[j * width + i] * noise[j * width + i];
                           }
                         expected.push_back((squares - sum * sum / n) / (n - 1));
                       }
                     return max_difference(out.value(), expected);
                   }});
  cases.push_back(
      {"variance", "spatial, 1e6 and noise",
       "a level of 1e6 costs no digits but those of its own storage, 1/16 in values of 0..16 (relative difference)",
       0.01, [=](Context& context) -> Result<double> {
         Values raised = noise;
         for (double& v : raised) v = static_cast<float>(16 * v + 1e6);
         const auto a = spread(context, raised), b = spread(context, noise);
         if (!a) return a.status();
         if (!b) return b.status();
         double most = 0;
         for (std::size_t i = 0; i < noise.size(); ++i) {
           const double e = std::fabs(a.value()[i] / (256 * b.value()[i]) - 1);
           if (!(e <= most)) most = e;
         }
         return most;
       }});
  cases.push_back({"variance", "spatial, one NaN",
                   "it does not count: where it is a neighbour, the variance of the 48 others (largest difference)", 1e-6,
                   [=](Context& context) -> Result<double> {
                     Values src = noise;
                     constexpr int x = 20, y = 17;
                     src[y * width + x] = nan;
                     const auto out = spread(context, src);
                     if (!out) return out.status();
                     double sum = 0, squares = 0;
                     for (int j = y - 2; j <= y + 4; ++j)
                       for (int i = x - 2; i <= x + 4; ++i)
                         if (i != x || j != y) {
                           sum += noise[j * width + i];
                           squares += noise[j * width + i] * noise[j * width + i];
                         }
                     const double there = out.value()[(y + 1) * width + x + 1];
                     const double most = std::fabs(there - (squares - sum * sum / 48) / 47);
                     for (const double v : out.value())
                       if (!std::isfinite(v)) return HUGE_VAL;
                     return most;
                   }});
  cases.push_back({"variance", "temporal, 64 frames",
                   "with alpha 0, the variance of the frames that were seen (largest relative difference)", 1e-4,
                   [](Context& context) -> Result<double> {
                     VarianceParams p;
                     p.width = 19;
                     p.height = 7;
                     p.format = Format::f32x1;
                     p.variant = VarianceVariant::temporal;
                     p.alpha = 0;
                     constexpr std::size_t n = 19 * 7;
                     Values history(3 * n, 0.0), sum(n, 0.0), squares(n, 0.0), out;
                     for (std::uint32_t frame = 0; frame < 64; ++frame) {
                       const Values src = scene::noise(19, 7, 1, 50 + frame);
                       Result<Run> made = Run::make(context, plan(p, context.profile()));
                       if (!made) return made.status();
                       Run& run = made.value();
                       if (Status s = run.write("src", src); !s) return s;
                       if (Status s = run.write("history", history); !s) return s;
                       if (Status s = run.go(); !s) return s;
                       history = run.read("history_out").value();
                       out = run.read("variances").value();
                       for (std::size_t i = 0; i < n; ++i) {
                         sum[i] += src[i];
                         squares[i] += src[i] * src[i];
                       }
                     }
                     double most = 0;
                     for (std::size_t i = 0; i < n; ++i) {
                       const double e = std::fabs(out[i] / ((squares[i] - sum[i] * sum[i] / 64) / 63) - 1);
                       if (!(e <= most)) most = e;
                     }
                     return most;
                   },
                   true});
}

struct Clamped {
  Values dst, counters;
};

Result<Clamped> clamped(Context& context, OutlierVariant variant, const Values& src) {
  OutlierClampParams p;
  p.width = width;
  p.height = height;
  p.variant = variant;
  p.count = true;
  Result<Run> made = Run::make(context, plan(p, context.profile()));
  if (!made) return made.status();
  Run& run = made.value();
  if (Status s = run.write("src", src); !s) return s;
  if (Status s = run.write("counters", Values(2, 0.0)); !s) return s;
  if (Status s = run.go(); !s) return s;
  return Clamped{run.read("dst").value(), run.read("counters").value()};
}

// What clamping gives, from sorted neighbours: luminance within the middle +- k spreads, colour scaled with it.
Values clamped_by_definition(OutlierVariant variant, const Values& src) {
  const auto luminance = [&](int x, int y) {
    const double* v = &src[4 * (static_cast<std::size_t>(y) * width + x)];
    return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2];
  };
  const auto median = [](Values v) {
    std::sort(v.begin(), v.end());
    return (v[(v.size() - 1) / 2] + v[v.size() / 2]) / 2;
  };
  Values expected = src;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Values around;
      for (int j = std::max(y - 2, 0); j <= std::min(y + 2, height - 1); ++j)
        for (int i = std::max(x - 2, 0); i <= std::min(x + 2, width - 1); ++i)
          if (i != x || j != y) around.push_back(luminance(i, j));
      double middle = 0, spread = 0;
      if (variant == OutlierVariant::mean) {
        for (const double l : around) middle += l / static_cast<double>(around.size());
        for (const double l : around) spread += (l - middle) * (l - middle) / static_cast<double>(around.size() - 1);
        spread = std::sqrt(spread);
      } else {
        middle = median(around);
        for (double& l : around) l = std::fabs(l - middle);
        spread = 1.4826 * median(around);
      }
      const double l = luminance(x, y), kept = std::clamp(l, middle - 3 * spread, middle + 3 * spread);
      for (int c = 0; c < 3; ++c) expected[4 * (static_cast<std::size_t>(y) * width + x) + c] *= kept / l;
    }
  return expected;
}

void add_outliers(std::vector<Case>& cases) {
  for (const OutlierVariant variant : {OutlierVariant::mean, OutlierVariant::median}) {
    const std::string tag = variant == OutlierVariant::mean ? "mean" : "median";
    const Values picture = images().src;
    cases.push_back(equal_bits("outlier_clamp", tag, [=](Context& c) -> Result<Values> {
      auto out = clamped(c, variant, picture);
      if (!out) return out.status();
      return out.value().dst;
    }));
    cases.push_back({"outlier_clamp", "one firefly, " + tag,
                     "a pixel of 1e6 in 0.5..0.6 falls to 1.3 or less, with its hue; nothing else changes; it is "
                     "counted (things wrong)",
                     0, [=](Context& context) -> Result<double> {
                       Values src = scene::noise(width, height, 4, 60);
                       for (double& v : src) v = static_cast<float>(0.5 + 0.1 * v);
                       const std::size_t at = 4 * (16 * width + 20);
                       src[at] = 1e6;
                       src[at + 1] = 5e5;
                       src[at + 2] = 0;
                       const auto out = clamped(context, variant, src);
                       if (!out) return out.status();
                       const Values& v = out.value().dst;
                       double bad =
                           v[at] <= 1.3 && v[at] >= 0.5 && std::fabs(v[at + 1] / v[at] - 0.5) < 1e-6 && v[at + 2] == 0
                               ? 0
                               : 1;
                       for (std::size_t i = 0; i < src.size(); ++i)
                         if (i / 4 != at / 4 && !(std::fabs(v[i] - src[i]) <= 0.1)) ++bad;
                       return bad + (out.value().counters[0] >= 1 && out.value().counters[1] == 0 ? 0 : 1);
                     }});
    cases.push_back({"outlier_clamp", "by its definition, " + tag,
                     "bright and dark specks come to the bound on their side (largest difference)", 2e-6,
                     [=](Context& context) -> Result<double> {
                       Values src = scene::noise(width, height, 4, 61);
                       for (std::size_t i = 0; i < src.size() / 4; ++i)
                         for (std::size_t c = 0; c < 3; ++c) {
                           double& v = src[4 * i + c];
                           v = static_cast<float>((0.5 + 0.1 * v) * (i % 37 == 5 ? 8 : i % 41 == 9 ? 0.125 : 1));
                         }
                       const auto out = clamped(context, variant, src);
                       if (!out) return out.status();
                       return max_difference(out.value().dst, clamped_by_definition(variant, src));
                     }});
    cases.push_back({"outlier_clamp", "NaN and infinity, " + tag,
                     "become grey of what is around, are counted apart, and count nowhere (things wrong)", 0,
                     [=](Context& context) -> Result<double> {
                       Values src(width * height * 4, 0.5);
                       src[4 * 400] = nan;
                       src[4 * 700 + 1] = HUGE_VAL;
                       const auto out = clamped(context, variant, src);
                       if (!out) return out.status();
                       double bad = out.value().counters[1] == 2 ? 0 : 1;
                       for (std::size_t i = 0; i < src.size(); ++i)
                         if (i % 4 != 3) bad += !(std::fabs(out.value().dst[i] - 0.5) <= 1e-6);
                       return bad;
                     }});
  }
}

}  // namespace

void add_bilateral_variant_cases(std::vector<Case>& cases) {
  add_mask(cases);
  add_discontinuity(cases);
  add_grid(cases);
  add_upsample(cases);
  add_upsample_values(cases);
  add_variance(cases);
  add_outliers(cases);
}

}  // namespace luxel::cases

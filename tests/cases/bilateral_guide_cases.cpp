// Guides that are not ordinary: NaN, sky, zero normals, planes seen from far, edges in one guide alone, constants.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tests/cases/bilateral_support.h"
#include "tests/cases/compare.h"
#include "tests/cases/storage.h"

namespace luxel::cases {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int side = 33, centre = 16;
constexpr std::size_t middle = static_cast<std::size_t>(centre) * side + centre;

// A guide is spoilt at one pixel: that pixel keeps its value, others are finite, and its colour reaches nobody.
Case spoilt(std::string name, const std::string& terms, const std::function<void(BilateralImages&)>& spoil,
            int counter) {
  BilateralParams p = bilateral_params(side, side, terms);
  p.count = counter >= 0;
  return {"", std::move(name),
          "the pixel keeps its value to the bit, weighs nothing elsewhere, and is counted (values that break it)", 0,
          [=](Context& context) -> Result<double> {
            BilateralImages images = bilateral_images(p, 11);
            spoil(images);
            const auto out = filter(context, p, images);
            if (!out) return out.status();
            BilateralImages other = images;
            other.src[4 * middle] = 1000;
            const auto with = filter(context, p, other);
            if (!with) return with.status();
            double bad = counter < 0 || out.value().counters[static_cast<std::size_t>(counter)] == 1 ? 0 : 1e6;
            for (std::size_t i = 0; i < images.src.size(); ++i) {
              const double v = out.value().dst[i], w = with.value().dst[i];
              if (i / 4 == middle)
                bad += same(v, images.src[i]) && same(w, other.src[i]) ? 0 : 1;
              else
                bad += std::isfinite(v) && same(v, w) ? 0 : 1;
            }
            return bad;
          }};
}

void add_spoilt(std::vector<Case>& cases) {
  for (const std::string terms : {"d", "s", "gd"}) {
    cases.push_back(spoilt(
        fmt::format("a depth of NaN, terms '{}'", terms), terms, [](auto& m) { m.depth[middle] = nan; }, 2));
    cases.push_back(spoilt(
        fmt::format("a depth of 0, terms '{}'", terms), terms, [](auto& m) { m.depth[middle] = 0; }, 2));
    cases.push_back(spoilt(
        fmt::format("a depth of -1, terms '{}'", terms), terms, [](auto& m) { m.depth[middle] = -1; }, 2));
    cases.push_back(spoilt(
        fmt::format("an infinite depth, terms '{}'", terms), terms, [](auto& m) { m.depth[middle] = HUGE_VAL; }, 2));
  }
  cases.push_back(spoilt(
      "a normal of NaN", "n", [](auto& m) { m.normals[4 * middle + 1] = nan; }, 3));
  cases.push_back(spoilt(
      "a zero normal", "n",
      [](auto& m) {
        for (int c = 0; c < 3; ++c) m.normals[4 * middle + c] = 0;
      },
      3));
  cases.push_back(spoilt(
      "a guide colour of NaN", "g", [](auto& m) { m.guide[4 * middle + 2] = nan; }, 1));
  cases.push_back(spoilt(
      "an infinite guide colour", "g", [](auto& m) { m.guide[4 * middle + 2] = HUGE_VAL; }, 1));
}

void add_sky(std::vector<Case>& cases) {
  for (const std::string terms : {"d", "s"})
    cases.push_back({"", fmt::format("sky at 1e10 and infinity, terms '{}'", terms),
                     "sky keeps its colour to the bit and gives none to what stands before it (values that break it)",
                     0, [=](Context& context) -> Result<double> {
                       const BilateralParams p = bilateral_params(side, side, terms);
                       const BilateralImages images = bilateral_images(p, 12, true);
                       BilateralImages other = images;
                       const auto sky = [&](std::size_t i) { return !(images.depth[i] < 1e10); };
                       for (std::size_t i = 0; i < other.src.size(); ++i)
                         if (sky(i / 4)) other.src[i] = 77;
                       const auto a = filter(context, p, images), b = filter(context, p, other);
                       if (!a) return a.status();
                       if (!b) return b.status();
                       double bad = 0;
                       for (std::size_t i = 0; i < other.src.size(); ++i)
                         bad += sky(i / 4) ? !same(a.value().dst[i], images.src[i])
                                           : !same(a.value().dst[i], b.value().dst[i]);
                       return bad;
                     }});
}

// A plane that rises to a horizon just above the image: z from `nearest` to some 30 times that.
Values floor_depth(double nearest) {
  Values z;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) z.push_back(nearest * side / (side + 0.5 - y - 0.01 * x));
  return quantise(z, Format::f32x1);
}

void add_planes(std::vector<Case>& cases) {
  // Weights of a coplanar neighbour are 1 but for the roundings of 1/z and of its extrapolation over R = 4 pixels: some
  // (2 + 2 R) 2^-24, over a tolerance of at least 4 2^-23 and the footprint's 0.06 times the distance.
  for (const double nearest : {1.0, 1000.0, 1e5})
    cases.push_back(
        {"", fmt::format("slanted floor from z = {}", nearest),
         "plane gives a coplanar neighbour its whole weight: as if there were no depth (largest difference beyond R "
         "from the border)",
         2e-5, [=](Context& context) -> Result<double> {
           BilateralParams p = bilateral_params(side, side, "c");
           BilateralImages images = bilateral_images(p, 13);
           images.depth = floor_depth(nearest);
           const auto without = filter(context, p, images);
           if (!without) return without.status();
           p.depth = DepthTerm::plane;
           const auto with = filter(context, p, images);
           if (!with) return with.status();
           double most = 0;
           for (std::size_t i = 0; i < images.src.size(); ++i) {
             const int x = static_cast<int>(i / 4 % side), y = static_cast<int>(i / 4 / side);
             if (std::min(x, y) < p.radius || std::max(x, y) >= side - p.radius) continue;
             const double d = std::fabs(with.value().dst[i] - without.value().dst[i]);
             if (!(d <= most)) most = d;
           }
           return most;
         }});
  cases.push_back(
      {"", "slanted floor, footprint 1e-6",
       "where a footprint is below the rounding of depth, epsilon keeps coplanar neighbours: the noise falls to a "
       "third or less (standard deviation against that of the input)",
       1.0 / 3, [](Context& context) -> Result<double> {
         BilateralParams p = bilateral_params(side, side, "d", Format::f32x1);
         p.footprint = 1e-6;
         BilateralImages images = bilateral_images(p, 14);
         images.depth = floor_depth(1e5);
         for (std::size_t i = 0; i < images.src.size(); ++i) images.src[i] = i * 2654435761u % 1024 / 1024.0;
         const auto out = filter(context, p, images);
         if (!out) return out.status();
         const auto deviation = [](const Values& v) {
           double mean = 0, sum = 0;
           for (const double x : v) mean += x / v.size();
           for (const double x : v) sum += (x - mean) * (x - mean);
           return std::sqrt(sum / v.size());
         };
         return deviation(out.value().dst) / deviation(images.src);
       }});
}

void add_edges(std::vector<Case>& cases) {
  cases.push_back({"", "equal depth, different normals",
                   "neither side takes from the other (largest difference from the input)", 1e-6,
                   [](Context& context) -> Result<double> {
                     const BilateralParams p = bilateral_params(side, side, "dn", Format::f32x1);
                     BilateralImages images = bilateral_images(p, 15);
                     images.depth.assign(images.depth.size(), 5.0);
                     for (std::size_t i = 0; i < images.src.size(); ++i) {
                       const bool right = i % side >= centre;
                       images.src[i] = right ? 1 : 0;
                       for (int c = 0; c < 3; ++c) images.normals[4 * i + c] = c == (right ? 0 : 2) ? 1 : 0;
                     }
                     const auto out = filter(context, p, images);
                     if (!out) return out.status();
                     return max_difference(out.value().dst, images.src);
                   }});
  for (const std::string term : {"g", "d", "n"})
    cases.push_back(
        {"", fmt::format("constant guide, term '{}'", term), "as without that term, bit for bit (values that differ)",
         0, [=](Context& context) -> Result<double> {
           const BilateralParams p = bilateral_params(side, side, term), without = bilateral_params(side, side, "");
           BilateralImages images = bilateral_images(p, 16);
           images.guide.assign(images.guide.size(), 0.5);
           images.depth.assign(images.depth.size(), 3.0);
           for (std::size_t i = 0; i < images.normals.size(); ++i) images.normals[i] = i % 4 == 2 ? 1 : 0;
           const auto a = filter(context, p, images), b = filter(context, without, images);
           if (!a) return a.status();
           if (!b) return b.status();
           return count_different(a.value().dst, b.value().dst);
         }});
}

}  // namespace

void add_bilateral_guide_cases(std::vector<Case>& cases) {
  add_spoilt(cases);
  add_sky(cases);
  add_planes(cases);
  add_edges(cases);
}

}  // namespace luxel::cases

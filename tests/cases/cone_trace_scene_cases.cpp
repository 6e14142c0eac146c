// Small scenes: a floor, a room at several resolutions.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "tests/cases/cone_trace_cases.h"
#include "tests/cases/cone_trace_support.h"

namespace luxel::cases {
namespace {

using std::numbers::pi;

const char* name(ConeVariant v) { return v == ConeVariant::isotropic ? "isotropic" : "anisotropic"; }

// A flat floor of solid voxels under an open sky: how much of it hides itself.
Case floor_case(const char* what, std::array<double, 3> normal, ConeVariant variant, double footprint, double bound) {
  return {"", fmt::format("floor hides itself, {}, {}, footprint {}", name(variant), what, footprint),
          "a receiver on a flat floor should see all of the sky (largest loss of light)", bound,
          [=](Context& context) -> Result<double> {
            constexpr int n = 64;
            ConeTraceParams p = cone_params(n, variant);
            p.environment = {1, 1, 1};
            p.footprint = footprint;
            Values v;
            for (int i = 0; i < n * n * n; ++i) v.insert(v.end(), {0, 0, 0, i / n / n < 8 ? 1.0 : 0.0});
            Values receivers;
            for (int i = 0; i < 16; ++i)
              add_receiver(receivers, {(24.0 + i) / n, (24.5 + 0.61 * i) / n, 8.0 / n}, normal);
            p.width = static_cast<int>(receivers.size() / 8);
            const auto r = trace(context, p, v, receivers);
            if (!r) return r.status();
            double most = 0;
            for (int i = 0; i < p.width; ++i) most = std::max(most, 1 - r.value().irradiance[i * 4] / pi);
            return most;
          }};
}

// A lamp before one wall of an open box, 1/16 of its side thick: the mean light on the floor.
Result<double> lit_floor(Context& context, ConeVariant variant, Format format, int n) {
  ConeTraceParams p = cone_params(n, variant, format);
  const auto opaque = [&](int x, int y, int z) { return y < n / 16 || x < n / 16 || x >= n - n / 16 || z < n / 16; };
  Result<ConeScene> scene(Status(Code::internal, ""));
  if (n > 256) {  // as bytes: numbers would take 4 GiB
    std::vector<std::byte> bytes;
    bytes.reserve(static_cast<std::size_t>(n) * n * n * 4);
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const auto a = static_cast<std::byte>(opaque(x, y, z) ? 255 : 0), l = static_cast<std::byte>(z < n / 16 ? 204 : 0);
          bytes.insert(bytes.end(), {l, l, l, a});
        }
    scene = ConeScene::make(context, p, bytes);
  } else {
    Values v;
    v.reserve(static_cast<std::size_t>(n) * n * n * 4);
    for (int z = 0; z < n; ++z)
      for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
          const double a = opaque(x, y, z) ? 1 : 0, l = z < n / 16 ? 0.8 : 0;
          v.insert(v.end(), {l, l, l, a});
        }
    scene = ConeScene::make(context, p, v);
  }
  if (!scene) return scene.status();
  Values receivers;
  for (int i = 0; i < 64; ++i)
    add_receiver(receivers, {0.15 + 0.7 * (i % 8) / 8, 1.0 / 16, 0.15 + 0.7 * (i / 8) / 8}, {0, 1, 0});
  p.width = 64;
  p.normal_offset = n / 64.0;  // the same in scene units
  if (Status s = scene.value().receive(receivers); !s) return s;
  if (Status s = scene.value().trace(p); !s) return s;
  const Result<Values> irradiance = scene.value().read("irradiance");
  if (!irradiance) return irradiance.status();
  double mean = 0;
  for (std::size_t i = 0; i < 64; ++i) mean += irradiance.value()[i * 4] / 64;
  return mean;
}

Case resolution_case(ConeVariant variant, std::vector<int> sides, Format format, double bound, bool slow) {
  Case c{"", fmt::format("brightness at {}^3 to {}^3, {} {}", sides.front(), sides.back(), name(variant), luxel::name(format)),
         "the mean light on a floor does not depend on the resolution (largest over smallest, less 1)", bound,
         [=](Context& context) -> Result<double> {
           double least = HUGE_VAL, most = 0;
           for (const int n : sides) {
             const Result<double> mean = lit_floor(context, variant, format, n);
             if (!mean) return mean;
             least = std::min(least, mean.value());
             most = std::max(most, mean.value());
           }
           return most / least - 1;
         },
         slow};
  // The C++ execution would take minutes, and a volume of doubles 4 GiB.
  if (sides.back() > 256) c.applies = [](const DeviceInfo& device) { return device.api != Api::cpu; };
  return c;
}

}  // namespace

void add_cone_scene_cases(std::vector<Case>& cases) {
  for (const ConeVariant v : {ConeVariant::isotropic, ConeVariant::anisotropic}) {
    cases.push_back(floor_case("normal along the axis", {0, 0, 1}, v, 0.25, 0.05));
    cases.push_back(floor_case("normal tilted by 1 degree", {0.0175, 0, 1}, v, 0.25, 0.05));
    cases.push_back(floor_case("normal along the axis", {0, 0, 1}, v, 1, 1));
    cases.push_back(resolution_case(v, {32, 64, 128}, Format::f32x4, 0.1, false));
    cases.push_back(resolution_case(v, {64, 128, 256}, Format::unorm8x4, 0.1, true));
    cases.push_back(resolution_case(v, {64, 512}, Format::unorm8x4, 0.1, true));
  }
}

}  // namespace luxel::cases

// mip_build: rounding by the storage formats over many levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/pyramid.h"

namespace luxel {
namespace {

// Mean signed and largest absolute error of a level, in steps of unorm8 or units of the last place of full scale 1.
struct Drift {
  double mean = 0, most = 0;
};

Drift drift(const Bytes& level, const std::vector<double>& truth, Format format) {
  Drift d;
  const double unit = step(format, 0.75);  // the values' mean is 1/2: units of [0.5, 1)
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = (decode_at(format, level, i) - truth[i]) / unit;
    d.mean += error / static_cast<double>(truth.size());
    d.most = std::max(d.most, std::fabs(error));
  }
  return d;
}

// Means of 2 x 2 x 2 in double, level by level from the finest: side x side x side texels of four values.
std::vector<std::vector<double>> halved(Format format, const Bytes& level_0, std::size_t side) {
  std::vector<std::vector<double>> levels(1);
  for (std::size_t n = side / 2; n > 0; n /= 2) {
    const std::vector<double>& finer = levels.back();
    const auto value = [&](std::size_t x, std::size_t y, std::size_t z, std::size_t c) {
      const std::size_t i = ((z * 2 * n + y) * 2 * n + x) * 4 + c;
      return finer.empty() ? decode_at(format, level_0, i) : finer[i];
    };
    std::vector<double> level(n * n * n * 4);
    for (std::size_t i = 0; i < level.size(); ++i) {
      const std::size_t c = i % 4, x = i / 4 % n, y = i / 4 / n % n, z = i / 4 / n / n;
      for (std::size_t k = 0; k < 8; ++k) level[i] += value(2 * x + k % 2, 2 * y + k / 2 % 2, 2 * z + k / 4, c) / 8;
    }
    levels.push_back(std::move(level));
  }
  return levels;
}

// Rounding up at ties would drift by 1/16 step a level.
constexpr double mean_drift_bound = 1.0 / 16;
// A level rounds once: half a step; f32 rounds up to three sums of two, and a unit of [0.5, 1) is half of one at 1.
constexpr double steps_a_level = 0.5 + 1e-3;
constexpr double f32_steps_a_level = 3;
constexpr double smallest_level = 16 * 16 * 16;

void check_drift(int side, const std::vector<std::string>& devices) {
  for (const Format f : colour_formats) {
    const MipBuildParams p = params(MipVariant::isotropic, f, {side, side, side});
    Bytes level_0;
    for (std::uint32_t i = 0, left = static_cast<std::uint32_t>(texels(mip_extent(p, 0)) * 4); i < left; i += 1024) {
      std::vector<float> values(1024);
      for (std::uint32_t k = 0; k < 1024; ++k) values[k] = uniform(i + k);
      const Bytes part = encode(f, values);
      level_0.insert(level_0.end(), part.begin(), part.end());
    }
    const std::vector<std::vector<double>> truth = halved(f, level_0, static_cast<std::size_t>(side));
    for (const std::string& device : devices) {
      MipBuildParams q = p;
      // 256 x 256 x 256 of f32x4 fits no storage buffer of some devices; images hold it.
      if (side == 256 && f == Format::f32x4 && device == "vulkan") q.input = Input::image;
      for (const auto& [name, bytes] : build_levels(test_context(device), q, level_0)) {
        const int level = level_of(name);
        const Drift d = drift(bytes, truth[static_cast<std::size_t>(level)], f);
        std::printf("%s %s %s: mean %+.5f, most %.4f steps\n", device.c_str(), luxel::name(f), name.c_str(), d.mean,
                    d.most);
        EXPECT_LE(d.most, level * (f == Format::f32x4 ? f32_steps_a_level : steps_a_level))
            << device << " " << text(p) << " " << name;
        if (bytes.size() >= smallest_level * bytes_per_pixel(f)) {
          EXPECT_LE(std::fabs(d.mean), mean_drift_bound) << device << " " << text(p) << " " << name;
        }
      }
    }
  }
}

TEST(MipBuild, DoesNotDrift) { check_drift(64, test_devices()); }
TEST(MipBuildFull, DoesNotDriftOverEightLevels) { check_drift(256, test_devices()); }

TEST(MipBuild, Unorm8RoundsHalfToEven) {
  const MipBuildParams p = params(MipVariant::isotropic, Format::unorm8x4, {2 * 255, 1, 1});
  Bytes level_0;
  for (int k = 0; k < 255; ++k)
    for (int i = 0; i < 2; ++i)
      level_0.insert(level_0.end(), 4, static_cast<std::uint8_t>(k + i));  // the mean is k + 1/2
  for (const std::string& device : test_devices()) {
    const Bytes level = build_levels(test_context(device), p, level_0).at("level_1");
    for (int k = 0; k < 255; ++k)
      EXPECT_EQ(level[static_cast<std::size_t>(k) * 4], k + k % 2)
          << device << " half between " << k << " and " << k + 1;
  }
}

}  // namespace
}  // namespace luxel

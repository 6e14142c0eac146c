// probe_irradiance against probes that another program rendered and integrated: LUXEL_DATA/probes_cycles_cbox.
#include <luxel/probe_irradiance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "bench/io/image.h"
#include "tests/cases/probe_support.h"
#include "tests/support/run.h"

namespace luxel {
namespace {

using namespace cases;
constexpr double pi = std::numbers::pi;

// Error of the irradiance along the axes against theirs, over the largest of the probe. Their radiance is piecewise constant over
// 128 x 64 equirect pixels, ours over octahedral texels, averaged to 32 x 32, and looked up in maps of 32 x 32.
constexpr double cycles_bound = 0.01;

std::string folder() {
  const char* named = std::getenv("LUXEL_DATA");
  return (named ? std::string(named) : std::string("../shared/data")) + "/probes_cycles_cbox";
}

// Equirect pixels (row t from +y, column p about it) into a map of size x size.
Values octahedral_map(const io::Image& image, int size) {
  Values map(static_cast<std::size_t>(4 * size * size), 0), all(map.size() / 4, 0);
  truth::over_sphere(size, 8, [&](int texel, const std::array<double, 3>& d, double solid) {
    const double t = std::acos(std::clamp(d[1], -1.0, 1.0)), p = std::atan2(d[2], d[0]);
    const int row = std::min(static_cast<int>(t / pi * image.height), image.height - 1);
    const int column = std::min(static_cast<int>((p / (2 * pi) + 0.5) * image.width), image.width - 1);
    const auto i = static_cast<std::size_t>(texel);
    for (std::size_t c = 0; c < 3; ++c)
      map[4 * i + c] += solid * static_cast<double>(image.pixels[static_cast<std::size_t>(row * image.width + column) * static_cast<std::size_t>(image.channels) + c]);
    all[i] += solid;
  });
  for (std::size_t i = 0; i < map.size(); ++i) map[i] = static_cast<float>(map[i] / all[i / 4]);
  return map;
}

TEST(ProbeIrradianceData, AgreesWithAnotherProgramsIntegrals) {
  if (!std::filesystem::exists(folder())) GTEST_SKIP() << folder() << " is missing; set LUXEL_DATA to the test data";
  std::vector<std::array<double, 3>> axes;
  std::vector<std::array<double, 3>> answers[4];
  std::ifstream file(folder() + "/probe_sh_irradiance.csv");
  for (std::string line; std::getline(file, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::string kind;
    std::size_t probe = 0;
    std::array<double, 3> axis{}, rgb{};
    if (!(words >> kind) || kind != "irradiance" || !(words >> probe >> axis[0] >> axis[1] >> axis[2] >> rgb[0] >> rgb[1] >> rgb[2])) continue;
    if (probe == 0) axes.push_back(axis);
    answers[probe].push_back(rgb);
  }
  ASSERT_EQ(axes.size(), 6u);
  Values radiance;
  for (int probe = 0; probe < 4; ++probe) {
    const auto image = io::read_image(folder() + "/probe" + std::to_string(probe) + "_color.exr");
    ASSERT_TRUE(image) << image.status().message();
    const Values map = octahedral_map(image.value(), 128);
    radiance.insert(radiance.end(), map.begin(), map.end());
  }
  ProbeIrradianceParams p;
  p.grid.count = {4, 1, 1};
  p.maps = {128, 1, ProbeRadiance::f32x4, ProbeDistance::f32, ProbeNormal::none};
  p.irradiance_size = 32;
  p.moments_size = 0;
  p.irradiance_format = Format::f32x4;
  // Look-ups are probe_shade's: a receiver in each probe's own place.
  ProbeShadeParams s;
  s.grid = p.grid;
  s.visibility = false;
  s.facing = ProbeFacing::all;
  s.normal_bias = 0;
  s.irradiance_size = 32;
  s.irradiance_format = Format::f32x4;
  s.width = 24;
  Values receivers;
  for (int probe = 0; probe < 4; ++probe)
    for (const auto& n : axes) add_probe_receiver(receivers, {static_cast<double>(probe), 0, 0}, n);
  std::vector<std::string> devices = test_devices();
  devices.push_back("cpu:double");
  for (const std::string& device : devices) {
    const auto maps = filter(test_context(device), p, {radiance, {}});
    ASSERT_TRUE(maps) << maps.status().message();
    const auto r = shade(test_context(device), s, {maps.value().irradiance, {}, {}}, receivers);
    ASSERT_TRUE(r) << r.status().message();
    double worst = 0;
    for (std::size_t probe = 0; probe < 4; ++probe) {
      double most = 0;
      for (const auto& rgb : answers[probe]) most = std::max({most, rgb[0], rgb[1], rgb[2]});
      for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t c = 0; c < 3; ++c) {
          const double e = r.value().irradiance[4 * (6 * probe + k) + c];
          // Probe 1 is dead: inside a box, it sees nothing.
          if (probe == 1) EXPECT_EQ(e, 0);
          else worst = std::max(worst, std::fabs(e - answers[probe][k][c]) / most);
        }
    }
    EXPECT_LE(worst, cycles_bound) << device;
    EXPECT_GT(worst, 1e-7) << "compared with itself";
    RecordProperty("worst_" + device.substr(0, 3), std::to_string(worst));
    std::printf("%s: largest difference %.2e of the probe's largest irradiance\n", device.c_str(), worst);
  }
}

}  // namespace
}  // namespace luxel

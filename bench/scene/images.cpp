#include "bench/scene/images.h"

#include <algorithm>
#include <cmath>

namespace luxel::scene {

std::uint32_t hash(std::uint32_t v) {
  const std::uint32_t state = v * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

double random01(std::uint32_t index, std::uint32_t seed) { return (hash(index ^ hash(seed)) >> 8) * 0x1p-24; }

std::vector<double> noise(int width, int height, int channels, std::uint32_t seed) {
  std::vector<double> values(static_cast<std::size_t>(width) * height * channels);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = random01(static_cast<std::uint32_t>(i), seed);
  return values;
}

std::vector<double> impulse(int width, int height, int channels, int x, int y) {
  std::vector<double> values(static_cast<std::size_t>(width) * height * channels, 0.0);
  const std::size_t at = (static_cast<std::size_t>(y) * width + x) * channels;
  std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(at), channels, 1.0);
  return values;
}

std::vector<double> step_edge(int width, int height, int channels, int x) {
  std::vector<double> values(static_cast<std::size_t>(width) * height * channels);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i / channels % width) >= x ? 1.0 : 0.0;
  return values;
}

namespace {

struct Rgb {
  double r, g, b;
};

Rgb shade(double u, double v) {                          // u, v in 0..1, v downwards
  Rgb c{0.25 + 0.35 * v, 0.4 + 0.3 * v, 0.9 - 0.2 * v};  // sky
  const double du = (u - 0.73) * 1.78, dv = v - 0.2;
  const double sun = du * du + dv * dv;
  if (sun < 0.0009)
    c = {2000, 1700, 1200};
  else
    c = {c.r + 0.004 / sun * 0.02, c.g + 0.003 / sun * 0.02, c.b + 0.002 / sun * 0.02};
  if (v > 0.6) {  // floor in perspective
    const double depth = 0.1 / (v - 0.59);
    const int tile =
        static_cast<int>(std::floor((u - 0.5) * depth * 12 + 100)) + static_cast<int>(std::floor(depth * 6));
    c = tile % 2 == 0 ? Rgb{0.05, 0.04, 0.04} : Rgb{0.7, 0.65, 0.55};
  }
  for (int i = 0; i < 12; ++i) {  // thin bars, ever finer
    const double left = 0.05 + 0.03 * i;
    if (v > 0.3 && v < 0.75 && u > left && u < left + 0.012 / (1 + i)) c = {0.01, 0.01, 0.015};
  }
  for (int i = 0; i < 5; ++i) {  // lamps, each sixteen times as bright as the one before
    const double x = (u - 0.52 - 0.1 * i) * 1.78, y = v - 0.5;
    const double r = 0.03 - std::sqrt(x * x + y * y);
    if (r > 0) {
      const double power = std::ldexp(0.02, 4 * i) * std::min(1.0, r * 60);
      c = {c.r + power, c.g + power * 0.8, c.b + power * 0.5};
    }
  }
  return c;
}

}  // namespace

std::vector<double> hdr_landscape(int width, int height, int channels) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(width) * height * channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Rgb c = shade((x + 0.5) / width, (y + 0.5) / height);
      const double all[4] = {c.r, c.g, c.b, 1.0};
      for (int i = 0; i < channels; ++i) values.push_back(static_cast<float>(all[i]));
    }
  return values;
}

}  // namespace luxel::scene

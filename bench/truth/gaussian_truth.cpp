#include "bench/truth/gaussian_truth.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace luxel::truth {
namespace {

// Index inside 0..n-1 that stands for i, or -1 where nothing does.
long inside(long i, long n, Border border) {
  if (i >= 0 && i < n) return i;
  switch (border) {
    case Border::clamp: return i < 0 ? 0 : n - 1;
    case Border::wrap: return ((i % n) + n) % n;
    case Border::mirror: {
      if (n == 1) return 0;
      const long period = 2 * (n - 1);
      const long j = ((i % period) + period) % period;
      return std::min(j, period - j);
    }
    case Border::zero: break;
  }
  return -1;
}

std::vector<double> weights_of(double sigma, int radius) {
  std::vector<double> w(static_cast<std::size_t>(radius) + 1, 0.0);
  for (int t = 0; t <= radius; ++t) w[t] = t == 0 ? 1.0 : std::exp(-(static_cast<double>(t) * t) / (2 * sigma * sigma));
  return w;
}

// One axis. A line has `n` cells of `width` values each, `step` values from cell to cell; out(i) = sum w in / sum w.
void blur_line(const double* in, double* out, long n, long width, long step, const std::vector<double>& w,
               Border border) {
  const long radius = static_cast<long>(w.size()) - 1;
  for (long i = 0; i < n; ++i) {
    double* to = out + i * step;
    std::fill_n(to, width, 0.0);
    double total = 0;
    for (long t = radius; t >= -radius; --t) {  // small weights first on one side; the sum in double is exact enough
      const double weight = w[static_cast<std::size_t>(std::labs(t))];
      const long j = inside(i + t, n, border);
      if (j < 0) continue;
      total += weight;
      const double* from = in + j * step;
      for (long k = 0; k < width; ++k) to[k] += weight * from[k];
    }
    for (long k = 0; k < width; ++k) to[k] /= total;
  }
}

template <class Work>
void on_threads(long count, const Work& work) {
  const long threads = std::max(1L, std::min(count, static_cast<long>(std::thread::hardware_concurrency())));
  std::vector<std::jthread> others;
  for (long i = 0; i < threads; ++i) others.emplace_back([=] { work(count * i / threads, count * (i + 1) / threads); });
}

}  // namespace

int full_radius(double sigma) { return static_cast<int>(std::ceil(8.3 * sigma)); }

std::vector<double> gaussian(std::span<const double> src, int width, int height, int channels, double sigma,
                             Border border, int radius) {
  const std::vector<double> w = weights_of(sigma, radius >= 0 ? radius : full_radius(sigma));
  const long row = static_cast<long>(width) * channels;
  std::vector<double> middle(src.size()), out(src.size());
  on_threads(height, [&](long first, long last) {
    for (long y = first; y < last; ++y)
      blur_line(src.data() + y * row, middle.data() + y * row, width, channels, channels, w, border);
  });
  // Columns in strips of 64 values, so that a line's cells stay in the cache.
  constexpr long strip = 64;
  on_threads((row + strip - 1) / strip, [&](long first, long last) {
    for (long s = first; s < last; ++s)
      blur_line(middle.data() + s * strip, out.data() + s * strip, height, std::min(strip, row - s * strip), row, w,
                border);
  });
  return out;
}

}  // namespace luxel::truth

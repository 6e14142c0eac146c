// The recursive variant: poles for a sigma, the ends of lines, and its passes.
#include "host/gaussian_blur.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <complex>

namespace luxel {

namespace {

using Complex = std::complex<double>;
constexpr int states = 5;
using State = std::array<double, states>;
using Matrix = std::array<State, states>;  // [row][column]

// Below, the Gaussian's first zeros approximate it better than poles of the same number (order 3, 4, 5).
constexpr double least_sigma_of_poles[] = {1.0, 1.05, 1.1};
// What is left of a disturbance once a line has been followed this far: exp(-18) = 1.5e-8, less than half a unit of f32.
constexpr double forgotten = 18;

// Poles 1/p of sigma 2, the real one apart, one of each conjugate pair (van Vliet, Young, Verbeek 1998, table 1, L-infinity).
struct Poles {
  double real;
  std::array<Complex, 2> pairs;
};
Poles poles_at_two(int order) {
  if (order == 3) return {1.86543, {Complex(1.41650, 1.00829)}};
  if (order == 4) return {0, {Complex(1.13228, 1.28114), Complex(1.78534, 0.46763)}};
  return {1.87504, {Complex(0.86430, 1.45389), Complex(1.61433, 0.83134)}};
}

// d^(1/q) of every pole.
Poles moved(const Poles& p, double q) {
  Poles to{p.real > 0 ? std::pow(p.real, 1 / q) : 0, {}};
  for (int i = 0; i < 2; ++i)
    if (p.pairs[i] != 0.0) to.pairs[i] = std::pow(p.pairs[i], 1 / q);
  return to;
}

// Variance of the filter run both ways: sum of 2 d / (d - 1)^2 over all poles.
double variance(const Poles& p) {
  const auto of = [](Complex d) { return 2.0 * d / ((d - 1.0) * (d - 1.0)); };
  double sum = p.real > 0 ? of(p.real).real() : 0;
  for (const Complex& d : p.pairs)
    if (d != 0.0) sum += 2 * of(d).real();
  return sum;
}

// Newton's iteration on q, from sigma 2 scaled, for the exact variance.
Poles poles_for(double sigma, int order) {
  const Poles two = poles_at_two(order);
  double q = sigma / 2;
  for (int i = 0; i < 100; ++i) {
    const double h = 1e-6 * q;
    const double slope = (variance(moved(two, q + h)) - variance(moved(two, q - h))) / (2 * h);
    const double step = (variance(moved(two, q)) - sigma * sigma) / slope;
    q -= step;
    if (std::fabs(step) <= 1e-13 * q) break;
  }
  return moved(two, q);
}

struct Filter {
  bool zeros = false;
  std::array<double, 8> c{};  // as in the kernel's table
  double memory = 0;          // positions after which a value is forgotten
};

Filter filter_for(double sigma, int order) {
  Filter f;
  f.zeros = sigma < least_sigma_of_poles[order - 3];
  if (f.zeros) {
    // theta_3: the weights q^(t^2), q = exp(-1/(2 sigma^2)), are the product of (1 + q^(2n-1) z)(1 + q^(2n-1) / z), n >= 1.
    for (int n = 1; n <= order; ++n) {
      const double zero = std::exp(-(2 * n - 1) / (2 * sigma * sigma));
      f.c[n - 1] = zero < FLT_MIN ? 0 : zero / (1 + zero);
    }
    f.memory = order;
    return f;
  }
  const Poles poles = poles_for(sigma, order);
  double slowest = 0;
  if (poles.real > 0) {
    slowest = 1 / poles.real;
    f.c[0] = 1 - slowest;
  }
  for (int i = 0; i < 2; ++i) {
    if (poles.pairs[i] == 0.0) continue;
    const Complex p = 1.0 / poles.pairs[i];
    slowest = std::max(slowest, std::abs(p));
    f.c[3 * i + 1] = 1 - p.real();
    f.c[3 * i + 2] = p.imag();
    f.c[3 * i + 3] = (p.real() - std::norm(p)) / p.imag();
  }
  f.memory = std::ceil(forgotten / -std::log(slowest));
  return f;
}

// One step of the kernel: the state after x, and the result.
double advance(const Filter& f, int order, State& s, double x) {
  if (f.zeros) {
    for (int n = 0; n < order; ++n) {
      const double y = x + f.c[n] * (s[n] - x);
      s[n] = x;
      x = y;
    }
    return x;
  }
  if (order != 4) x = s[0] += f.c[0] * (x - s[0]);
  for (int pair = 0; pair < (order == 3 ? 1 : 2); ++pair) {
    double &re = s[2 * pair + 1], &im = s[2 * pair + 2];
    const double *c = &f.c[3 * pair + 1], e = x - re;
    re += c[0] * e - c[1] * im;
    im -= c[0] * im + c[1] * e;
    x = re + c[2] * im;
  }
  return x;
}

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (int i = 0; i < states; ++i)
    for (int j = 0; j < states; ++j)
      for (int k = 0; k < states; ++k) m[i][j] += a[i][k] * b[k][j];
  return m;
}

Matrix plus(Matrix a, const Matrix& b, double factor = 1) {
  for (int i = 0; i < states; ++i)
    for (int j = 0; j < states; ++j) a[i][j] += factor * b[i][j];
  return a;
}

Matrix identity() {
  Matrix m{};
  for (int i = 0; i < states; ++i) m[i][i] = 1;
  return m;
}

// Gauss-Jordan elimination with the largest pivot.
Matrix inverse(Matrix a) {
  Matrix b = identity();
  for (int c = 0; c < states; ++c) {
    int most = c;
    for (int r = c; r < states; ++r)
      if (std::fabs(a[r][c]) > std::fabs(a[most][c])) most = r;
    std::swap(a[c], a[most]);
    std::swap(b[c], b[most]);
    for (int r = 0; r < states; ++r) {
      const double factor = (r == c ? a[c][c] - 1 : a[r][c]) / a[c][c];
      for (int k = 0; k < states; ++k) {
        a[r][k] -= factor * (k >= c ? a[c][k] : 0);
        b[r][k] -= factor * b[c][k];
      }
    }
  }
  return b;
}

// What a step makes of a state when x is 0, column by column. States that this order does not use stay out of it.
Matrix step_matrix(const Filter& f, int order, State* result) {
  Matrix m{};
  const int first = !f.zeros && order == 4 ? 1 : 0;
  for (int j = first; j < first + order; ++j) {
    State s{};
    s[j] = 1;
    (*result)[j] = advance(f, order, s, 0);
    for (int i = 0; i < states; ++i) m[i][j] = s[i];
  }
  return m;
}

// The state that a periodic line repeats, from the one that a period starting at rest leaves: (1 - A^period)^-1.
Matrix periodic_ends(const Filter& f, int order, int period) {
  State unused{};
  Matrix power = identity(), square = step_matrix(f, order, &unused);
  for (int n = period; n > 0; n /= 2) {
    if (n % 2 == 1) power = times(power, square);
    square = times(square, square);
  }
  return inverse(plus(identity(), power, -1));
}

// The backward state at the end of a line, from the forward state s there: sum over n >= 0 of A^n b c A^(n+1) s, where b is
// the state after an impulse and c A s the result after s. The sum doubles: S(2n) = S(n) + A^n S(n) A^n.
Matrix open_ends(const Filter& f, int order) {
  State result{}, impulse{};
  const Matrix step = step_matrix(f, order, &result);
  advance(f, order, impulse, 1);
  Matrix sum{};
  for (int i = 0; i < states; ++i)
    for (int j = 0; j < states; ++j) sum[i][j] = impulse[i] * result[j];
  Matrix power = step;
  for (int doublings = 0; doublings < 32; ++doublings) {
    sum = plus(sum, times(times(power, sum), power));
    power = times(power, power);
  }
  return sum;
}

// How one axis runs: see the kernel's parameters.
struct Line {
  int lines, count, period = 0, warm = 0, stored;
  double sigma;
  Filter filter;
  Matrix ends;
};

Line line_of(const GaussianBlurParams& p, int axis) {
  Line l;
  l.lines = axis == 0 ? p.height : p.width;
  l.count = axis == 0 ? p.width : p.height;
  l.sigma = p.sigma;
  l.stored = l.count;
  if (p.border == Border::wrap) l.period = l.count;
  if (p.border == Border::mirror) l.period = 2 * l.count - 2;
  // Four periods wide, a Gaussian leaves nothing but the mean: exp(-2 pi^2 4^2).
  if (l.period > 0) l.sigma = std::min(p.sigma, 4.0 * l.period);
  l.filter = filter_for(l.sigma, p.order);
  if (l.period > 0) {
    l.warm = static_cast<int>(std::min<double>(l.filter.memory, l.period));
    l.stored = std::min(l.count + l.warm, p.border == Border::mirror ? l.period : l.count);
    l.ends = l.warm == l.period ? periodic_ends(l.filter, p.order, l.period) : identity();
  } else {
    l.ends = open_ends(l.filter, p.order);
  }
  return l;
}

constexpr int kept_states = 6;  // kept behind a line: the state at its end, and its last value

}  // namespace

double recursive_scratch(const GaussianBlurParams& p) {
  const auto kept = [&](double lines, double count) {
    return count > 1 ? (lines + 15) * (2 * count + kept_states) * channels(p.format) : 0.0;
  };
  return std::max(kept(p.height, p.width), kept(p.width, p.height));
}

void plan_recursive(const GaussianBlurParams& p, const Profile& profile, Planner& planner, const Pixels& from,
                    const Pixels& to) {
  const Slot nothing = planner.scratch(Format::f32x1, 1);
  const bool together = profile.rows.lanes > 0;  // an invocation's lines lie together, else neighbours' positions

  const auto lanes_of = [&](Format format) { return std::max(profile.rows.lanes, channels(format)); };
  // Pixels of the lines kept between the directions, whole invocations of them.
  const auto kept_size = [&](const Line& l, int lines, Format format) {
    const int pixels = lanes_of(format) / channels(format);
    return static_cast<std::size_t>((lines + pixels - 1) / pixels * pixels) * (l.stored + kept_states);
  };
  // Along one axis, forward and backward; `ones`: one line of an image of ones.
  const auto filter = [&](int axis, const Pixels& in, const Pixels& out, bool ones, Slot coverage, Slot between) {
    const Line l = line_of(p, axis);
    const Pixels kept{between, f32_of(out.format), 0};
    const int n = channels(kept.format), lanes = lanes_of(kept.format), pixels = lanes / n;
    const int lines = ones ? 1 : l.lines, groups = (lines + pixels - 1) / pixels, length = l.stored + kept_states;
    std::vector<double> exact(64, 0.0);
    std::copy(l.filter.c.begin(), l.filter.c.end(), exact.begin());
    for (int i = 0; i < states; ++i) std::copy(l.ends[i].begin(), l.ends[i].end(), exact.begin() + 8 + states * i);
    std::vector<double> rounded = exact;
    for (double& v : rounded) v = std::fabs(v) < FLT_MIN ? 0 : static_cast<float>(v);
    const Slot coefficients = planner.table(rounded, exact);
    for (const bool backward : {false, true}) {
      const std::string label = std::string("gaussian_blur recursive ") + (axis == 0 ? "rows " : "columns ") +
                                (backward ? "backward" : "forward") + (ones ? " coverage" : "");
      planner.pass("gaussian_blur_recursive", backward ? module_of(kept, out, profile) : module_of(in, kept, profile),
                   label, {static_cast<std::uint32_t>(groups), 1, 1}, {together ? 4u : 32u, 1, 1},
                   {{"lines", lines},
                    {"count", l.count},
                    {"image_stride", backward ? out.stride : in.stride},
                    {"kept_stride", together ? pixels : groups * pixels},
                    {"kept_group", together ? length * pixels : pixels},
                    {"stored", l.stored},
                    {"period", l.period},
                    {"warm", l.warm}},
                   {{"ORDER", l.filter.zeros ? 5 : p.order},  // zeros that an order leaves out are 0
                    {"ZEROS", l.filter.zeros},
                    {"AXIS", axis},
                    {"BACKWARD", backward},
                    {"BORDER", static_cast<int>(p.border)},
                    {"CLOSED", l.period > 0 ? l.warm == l.period : backward},
                    {"ONES", ones},
                    {"KEEP_ALPHA", p.keep_alpha && !ones},
                    {"LANES", lanes}},
                   {{"src", backward ? kept.slot : in.slot},
                    {"dst", backward ? out.slot : kept.slot},
                    {"coefficients", coefficients},
                    {"coverage", coverage}});
      planner.rounds(1.0 + l.warm + (backward ? l.count : l.stored));
      // A real pole takes 3 operations, a pair 11.
      const int operations = p.order == 3 ? 14 : p.order == 4 ? 22 : 25;
      planner.cost(static_cast<double>(lines) * (l.stored + l.warm) * n * operations,
                   static_cast<double>(lines) * l.count *
                       (bytes_per_pixel(kept.format) + bytes_per_pixel(backward ? out.format : in.format)));
    }
  };
  // Where outside is nothing, results are divided by what becomes of ones.
  const auto cover = [&](int axis) {
    if (p.border != Border::zero) return nothing;
    const Slot kept = planner.scratch(Format::f32x1, kept_size(line_of(p, axis), 1, Format::f32x1));
    const Pixels covered{planner.scratch(Format::f32x1, axis == 0 ? p.width : p.height), Format::f32x1, 1};
    filter(axis, {nothing, Format::f32x1, 1}, covered, true, nothing, kept);
    return covered.slot;
  };
  const Format format = f32_of(p.format);
  const Line rows = line_of(p, 0), columns = line_of(p, 1);
  if (p.width > 1 && p.height > 1) {
    const Slot kept =
        planner.scratch(format, std::max(kept_size(rows, p.height, format), kept_size(columns, p.width, format)));
    const Pixels middle{planner.scratch(format, static_cast<std::size_t>(p.width) * p.height), format, p.width};
    filter(0, from, middle, false, cover(0), kept);
    filter(1, middle, to, false, cover(1), kept);
  } else {
    const int axis = p.height > 1 ? 1 : 0;
    filter(axis, from, to, false, cover(axis),
           planner.scratch(format, kept_size(axis == 0 ? rows : columns, 1, format)));
  }
}

}  // namespace luxel

// The dialect's types and memory words in C++, for float and for double. kernels/portable/cpp.h binds them to a kernel.
#pragma once
#define GLM_FORCE_SILENT_WARNINGS
#define GLM_FORCE_XYZW_ONLY
#include <glm/glm.hpp>

#include <atomic>
#include <iterator>
#include <type_traits>
#include <vector>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "host/reference/dispatch.h"

namespace luxel::reference {

using glm::abs; using glm::ceil; using glm::clamp; using glm::cross; using glm::dot; using glm::floor;
using glm::length; using glm::max; using glm::min; using glm::mix; using glm::normalize; using glm::sign;
using glm::isnan; using glm::isinf;
using std::exp; using std::exp2; using std::log2; using std::pow; using std::sqrt; using std::sin; using std::cos;
using glm::ivec2; using glm::ivec3; using glm::ivec4; using glm::uvec2; using glm::uvec3; using glm::uvec4;
using glm::vec2; using glm::vec3; using glm::vec4; using glm::dvec2; using glm::dvec3; using glm::dvec4;
using uint = unsigned int;

inline uint floatBitsToUint(float v) { uint u; std::memcpy(&u, &v, 4); return u; }
inline float uintBitsToFloat(uint u) { float v; std::memcpy(&v, &u, 4); return v; }

#define FN inline
#include "kernels/math/packing.h"
#undef FN

// Pixels of 1, 2, 4 channels.
template <class Real, int N> struct PixelOf { using type = glm::vec<N, Real>; };
template <class Real> struct PixelOf<Real, 1> { using type = Real; };
template <class Real, int N> using Pixel = typename PixelOf<Real, N>::type;
template <class P> auto& channel(P& p, int i) {
  if constexpr (std::is_floating_point_v<P>) return (void)i, p; else return p[i];
}

// LANES neighbouring channels.
template <class Real, int N>
struct Wide {
  Real v[N];
  friend Wide operator+(Wide a, const Wide& b) { for (int i = 0; i < N; ++i) a.v[i] += b.v[i]; return a; }
  friend Wide operator-(Wide a, const Wide& b) { for (int i = 0; i < N; ++i) a.v[i] -= b.v[i]; return a; }
  friend Wide operator*(Wide a, const Wide& b) { for (int i = 0; i < N; ++i) a.v[i] *= b.v[i]; return a; }
  friend Wide operator/(Wide a, const Wide& b) { for (int i = 0; i < N; ++i) a.v[i] /= b.v[i]; return a; }
  friend Wide operator*(Real s, Wide a) { for (int i = 0; i < N; ++i) a.v[i] *= s; return a; }
  friend Wide operator/(Wide a, Real s) { for (int i = 0; i < N; ++i) a.v[i] /= s; return a; }
};
template <class Real, int N> Wide<Real, N> choose(const Wide<Real, N>& which, Wide<Real, N> yes, const Wide<Real, N>& no) {
  for (int i = 0; i < N; ++i) yes.v[i] = which.v[i] != 0 ? yes.v[i] : no.v[i];
  return yes;
}
template <class Real, int N> Wide<Real, N> with_alpha_of(Wide<Real, N> w, const Wide<Real, N>& alpha) {
  for (int i = 3; i < N; i += 4) w.v[i] = alpha.v[i];
  return w;
}
template <class W, class Real> W splat(Real s) { W w; for (auto& x : w.v) x = s; return w; }

// Storage formats: what one channel is in memory. In double every format stores doubles; rounding by the storage format
// is reported apart from rounding by arithmetic.
struct StoreF32 { using type = float; static float decode(float v) { return v; } static float encode(float v) { return v; } };
struct StoreF16 {
  using type = std::uint16_t;
  static float decode(type v) { return f16_value(v); }
  static type encode(float v) { return static_cast<type>(f16_bits(v)); }
};
struct StoreUnorm8 {
  using type = std::uint8_t;
  static float decode(type v) { return unorm8_value(v); }
  static type encode(float v) { return static_cast<type>(unorm8_bits(v)); }
};
struct StoreF64 { using type = double; static double decode(double v) { return v; } static double encode(double v) { return v; } };

struct f32x1 { using store = StoreF32; static constexpr int count = 1; };
struct f32x2 { using store = StoreF32; static constexpr int count = 2; };
struct f32x4 { using store = StoreF32; static constexpr int count = 4; };
struct f16x2 { using store = StoreF16; static constexpr int count = 2; };
struct f16x4 { using store = StoreF16; static constexpr int count = 4; };
struct unorm8x4 { using store = StoreUnorm8; static constexpr int count = 4; };

// Bounds: an access outside is counted and not made.
struct Bound {
  const Memory* memory = nullptr;
  std::atomic<std::size_t>* outside = nullptr;
  bool in(std::size_t offset, std::size_t bytes) const {
    if (offset <= memory->bytes && bytes <= memory->bytes - offset) return true;
    outside->fetch_add(1, std::memory_order_relaxed);
    return false;
  }
};

template <class Real, class F>
struct Pixels : Bound {
  using Store = std::conditional_t<std::is_same_v<Real, double>, StoreF64, typename F::store>;
  using T = typename Store::type;
  using P = Pixel<Real, F::count>;
  void get(std::ptrdiff_t element, int n, Real* to) const {
    for (int i = 0; i < n; ++i) to[i] = 0;
    if (element < 0 || !in(element * sizeof(T), n * sizeof(T))) return (void)(element < 0 && outside->fetch_add(1));
    const T* from = static_cast<const T*>(memory->data) + element;
    for (int i = 0; i < n; ++i) to[i] = static_cast<Real>(Store::decode(from[i]));
  }
  void put(std::ptrdiff_t element, int n, const Real* from) const {
    if (element < 0 || !in(element * sizeof(T), n * sizeof(T))) return (void)(element < 0 && outside->fetch_add(1));
    T* to = static_cast<T*>(memory->data) + element;
    for (int i = 0; i < n; ++i) to[i] = Store::encode(from[i]);
  }
  static std::ptrdiff_t at(int stride, int x, int y) { return (static_cast<std::ptrdiff_t>(y) * stride + x) * F::count; }
  static std::ptrdiff_t at(ivec3 e, ivec3 p) {
    return ((static_cast<std::ptrdiff_t>(p.z) * e.y + p.y) * e.x + p.x) * F::count;
  }
  P pixel_at(std::ptrdiff_t i) const { P p; get(i, F::count, &channel(p, 0)); return p; }
  P load_pixel_(int stride, int x, int y) const { return pixel_at(at(stride, x, y)); }
  P load_voxel_(ivec3 e, ivec3 p) const { return pixel_at(at(e, p)); }
  void store_pixel_(int stride, int x, int y, P p) const { put(at(stride, x, y), F::count, &channel(p, 0)); }
  void store_voxel_(ivec3 e, ivec3 p, P v) const { put(at(e, p), F::count, &channel(v, 0)); }
  template <class W> W load_wide_(int stride, int x, int y) const {
    W w; get(at(stride, x, y), sizeof(w.v) / sizeof(Real), w.v); return w;
  }
  template <class W> void store_wide_(int stride, int x, int y, const W& w) const {
    put(at(stride, x, y), sizeof(w.v) / sizeof(Real), w.v);
  }
};

// Arrays of plain values: float (double in double), vec4, uint, int.
template <class T>
struct Array : Bound {
  T get(std::ptrdiff_t i) const {
    T v{};
    if (i >= 0 && in(i * sizeof(T), sizeof(T))) std::memcpy(&v, static_cast<const char*>(memory->data) + i * sizeof(T), sizeof(T));
    else if (i < 0) outside->fetch_add(1);
    return v;
  }
  void put(std::ptrdiff_t i, const T& v) const {
    if (i >= 0 && in(i * sizeof(T), sizeof(T))) std::memcpy(static_cast<char*>(memory->data) + i * sizeof(T), &v, sizeof(T));
    else if (i < 0) outside->fetch_add(1);
  }
  template <class Change> T atomic(std::ptrdiff_t i, Change change) const {
    if (i < 0 || !in(i * sizeof(T), sizeof(T))) return T{};
    std::atomic_ref<T> cell(static_cast<T*>(memory->data)[i]);
    T old = cell.load(std::memory_order_relaxed);
    while (!cell.compare_exchange_weak(old, change(old), std::memory_order_relaxed)) {}
    return old;
  }
};

// Workgroup memory.
template <class T, int N>
struct Shared {
  T values[N];
  std::atomic<std::size_t>* outside = nullptr;
  T& operator[](int i) {
    if (i >= 0 && i < N) return values[i];
    outside->fetch_add(1, std::memory_order_relaxed);
    return values[0];
  }
  T get(int i) { return (*this)[i]; }
  void put(int i, const T& v) { (*this)[i] = v; }
};

// Images: texels decoded by the format they are stored in; Real channels, missing ones 0 (alpha too).
template <class Real>
struct Texture : Bound {
  glm::vec<4, Real> texel(int x, int y, int z) const {
    glm::vec<4, Real> v(0);
    const auto& e = memory->extent;
    if (x < 0 || y < 0 || z < 0 || x >= e[0] || y >= e[1] || z >= e[2]) { outside->fetch_add(1); return v; }
    const int n = channels(memory->format);
    const std::size_t element = ((static_cast<std::size_t>(z) * e[1] + y) * e[0] + x) * n;
    for (int i = 0; i < n; ++i) v[i] = value(element + i);
    return v;
  }
  Real value(std::size_t i) const {
    if constexpr (std::is_same_v<Real, double>) return fetch<double>(i);
    else switch (memory->format) {
      case Format::f16x2: case Format::f16x4: return f16_value(fetch<std::uint16_t>(i));
      case Format::unorm8x4: return unorm8_value(fetch<std::uint8_t>(i));
      default: return fetch<float>(i);
    }
  }
  template <class T> T fetch(std::size_t i) const {
    T v{};
    if (in(i * sizeof(T), sizeof(T))) std::memcpy(&v, static_cast<const char*>(memory->data) + i * sizeof(T), sizeof(T));
    return v;
  }
  int address(int i, int n) const {
    if (memory->address == Address::wrap) { i %= n; return i < 0 ? i + n : i; }
    return i < 0 ? 0 : i >= n ? n - 1 : i;
  }
  // Linear filtering of the eight (or four, where the extent is 1) nearest texels.
  glm::vec<4, Real> linear(glm::vec<3, Real> uvw) const {
    int i[3], j[3];
    Real f[3];
    for (int a = 0; a < 3; ++a) {
      const int n = memory->extent[a];
      const Real p = uvw[a] * Real(n) - Real(0.5);
      const Real base = std::floor(p);
      f[a] = p - base;
      i[a] = address(static_cast<int>(base), n);
      j[a] = address(static_cast<int>(base) + 1, n);
    }
    auto row = [&](int y, int z) { return glm::mix(texel(i[0], y, z), texel(j[0], y, z), f[0]); };
    auto slice = [&](int z) { return glm::mix(row(i[1], z), row(j[1], z), f[1]); };
    return memory->extent[2] == 1 ? slice(0) : glm::mix(slice(i[2]), slice(j[2]), f[2]);
  }
};
struct Ctx {};  // the dialect's ctx: the bindings are members here

template <class P, class V> P take(const V& v) {
  if constexpr (std::is_floating_point_v<P>) return v.x; else return P(v);
}

template <class P> constexpr int channels_of = 1;
template <int N, class Real> constexpr int channels_of<glm::vec<N, Real>> = N;

template <class P, class W> P pixel_of(const W& w, int k) {
  P p;
  for (int i = 0; i < channels_of<P>; ++i) channel(p, i) = w.v[k * channels_of<P> + i];
  return p;
}
template <class P, class W> void put_pixel(W& w, int k, const P& p) {
  for (int i = 0; i < channels_of<P>; ++i) w.v[k * channels_of<P> + i] = channel(p, i);
}

// Loads that buffers and images share.
template <class P, class B> auto fetch_pixel(const B& b, int stride, int x, int y) {
  if constexpr (requires { b.texel(x, y, 0); }) return take<P>(b.texel(x, y, 0));
  else return b.load_pixel_(stride, x, y);
}
template <class P, class B> auto fetch_voxel(const B& b, ivec3 extent, ivec3 p) {
  if constexpr (requires { b.texel(0, 0, 0); }) return take<P>(b.texel(p.x, p.y, p.z));
  else return b.load_voxel_(extent, p);
}
template <class W, class P, class B> W fetch_wide(const B& b, int stride, int x, int y) {
  if constexpr (requires { b.texel(x, y, 0); }) {
    W w;
    for (int k = 0; k * channels_of<P> < static_cast<int>(std::size(w.v)); ++k) put_pixel<P>(w, k, fetch_pixel<P>(b, stride, x + k, y));
    return w;
  } else {
    return b.template load_wide_<W>(stride, x, y);
  }
}

// Values of a dispatch that every kernel sees, and the loop over workgroups, phases and invocations.
struct Invocation {
  ivec3 global_{0}, local_{0}, group_{0};
};

template <class Kernel>
void run_workgroups(const Dispatch& d) {
  Kernel kernel(d);
  const auto [nx, ny, nz] = d.workgroup;
  for (std::size_t g = d.first; g < d.last; ++g) {
    const int gx = static_cast<int>(g % d.groups[0]);
    const int gy = static_cast<int>(g / d.groups[0] % d.groups[1]);
    const int gz = static_cast<int>(g / d.groups[0] / d.groups[1]);
    kernel.group_ = ivec3(gx, gy, gz);
    for (int phase = 0; phase < Kernel::phases_; ++phase)
      for (int z = 0; z < nz; ++z)
        for (int y = 0; y < ny; ++y)
          for (int x = 0; x < nx; ++x) {
            kernel.local_ = ivec3(x, y, z);
            kernel.global_ = ivec3(gx * nx + x, gy * ny + y, gz * nz + z);
            kernel.kernel_(phase);
          }
  }
}

}  // namespace luxel::reference

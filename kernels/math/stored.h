// Rounding by the storage formats. Option STORAGE of a module: 0 f32, 1 f16, 2 unorm8, 3 unorm8 that the device's
// texture unit decodes. Means of unorm8 are taken in steps, 0..255: there sums and halves are exact, so that a half is
// seen as one and rounds to even. In units of 1 it would not, and levels would drift upwards by 1/25 step each.
// `n` as math/exact.h wants it.

// 1.5 * 2^23: a sum with it is a whole number, rounded half to even.
FN float to_even(float v, int n) { return in_double(n) ? v : (v + 12582912.0f) - 12582912.0f; }
FN float f16_nearest(float v, int n) { return in_double(n) ? v : f16_value(f16_bits(v)); }
// Texture units hand out unorm8 to within a few units in the last place; there is a whole number of steps.
FN float snapped(float v, int n) { return in_double(n) ? v : floor(255.0f * v + 0.5f) / 255.0f; }

// as_loaded: a value as a buffer would hand it out. to_steps: what means are taken of. rounded: of these, what storing
// and loading again gives. from_steps: the value to store.
#define as_loaded(v, n) (v)
#if STORAGE == 0
#define to_steps(v) (v)
#define rounded(v, n) (v)
#define from_steps(v, n) (v)
#elif STORAGE == 1
#define to_steps(v) (v)
FN vec4 rounded(vec4 v, int n) {
    return vec4(f16_nearest(v.x, n), f16_nearest(v.y, n), f16_nearest(v.z, n), f16_nearest(v.w, n));
}
#define from_steps(v, n) (v)
#else
#define to_steps(v) (255.0f * (v))
FN vec4 rounded(vec4 v, int n) {
    return vec4(to_even(v.x, n), to_even(v.y, n), to_even(v.z, n), to_even(v.w, n));
}
#define from_steps(v, n) (rounded(v, n) / 255.0f)
#if STORAGE == 3
#undef as_loaded
FN vec4 as_loaded(vec4 v, int n) { return vec4(snapped(v.x, n), snapped(v.y, n), snapped(v.z, n), snapped(v.w, n)); }
#endif
#endif

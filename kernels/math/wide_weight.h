// math/range_weight.h for the pixels of a wide, in kernels of one channel. OpenCL C has vectors of any width, and its
// compiler does not find them again in a loop over their parts: there each function is spelled for vectors as well.
#if defined(OCL_JOIN) && LANES > 1
#define WIDE_INT OCL_JOIN(int, LANES)
FN wide bits_to_wide(WIDE_INT v) { return *(const wide*)&v; }
FN WIDE_INT wide_to_bits(wide v) { return *(const WIDE_INT*)&v; }
#define WHOLE 12582912.0f  // a sum with 1.5 2^23 has no fraction; its lowest bits are the number
#define WHOLE_126 12583038.0f

FN wide wide_abs(wide w) { return bits_to_wide(wide_to_bits(w) & 0x7fffffff); }
FN wide wide_weight(wide e) {
    const wide n = e + WHOLE_126;
    const wide t = e - (n - WHOLE_126);
    wide p = 2.0f * 0.0555073374f + t * (2.0f * 0.0096715128f + t * (2.0f * 0.0013264727f));
    p = 2.0f + t * (2.0f * 0.6931469776f + t * (2.0f * 0.2402224208f + t * p));
    return bits_to_wide((e >= -64.0f) & wide_to_bits(p * bits_to_wide(wide_to_bits(n) << 23)));
}
FN wide wide_log2_cosine(wide d) {
    const wide a = d >= 8.67361738e-19f ? d : (wide)(1.0f);
    const WIDE_INT k = (wide_to_bits(a) - 0x3f3504f3) >> 23;
    const wide r = a * bits_to_wide((127 - k) << 23);
    const wide z = (r - 1.0f) / (r + 1.0f);
    const wide q = z * z;
    wide series = 0.142857142857f + q * (0.111111111111f + q * 0.090909090909f);
    series = 1.0f + q * (0.333333333333f + q * (0.2f + q * series));
    const wide exponent = bits_to_wide(wide_to_bits((wide)(WHOLE)) + k) - WHOLE;
    return d >= 8.67361738e-19f ? exponent + 2.88539008177793f * z * series : (wide)(-1.0e30f);
}
#else
FN wide wide_abs(wide w) {
    wide r;
    UNROLL for (int k = 0; k < PIXELS; ++k) set_pixel(r, k, abs(get_pixel(w, k)));
    return r;
}
FN wide wide_weight(wide e) {
    wide r;
    UNROLL for (int k = 0; k < PIXELS; ++k) set_pixel(r, k, range_weight(get_pixel(e, k)));
    return r;
}
FN wide wide_log2_cosine(wide d) {
    wide r;
    UNROLL for (int k = 0; k < PIXELS; ++k) set_pixel(r, k, log2_cosine(get_pixel(d, k)));
    return r;
}
#endif

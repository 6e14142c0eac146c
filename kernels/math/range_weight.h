// Weights of edge-preserving filters, in powers of 2. Only + - * / and bits: the same result on every device.
// Needs math/exact.h.

// 2^e for -64 <= e <= 0, relative error 9.2e-8 and exact at 0; below -64, and for NaN, 0: a weight under 5.4e-20 changes
// no float sum in which the centre weighs 1, and no product with it becomes a denormal.
// A sum with 1.5 2^23 + 126 has no fraction, and its lowest bits are 126 more than e's whole part: shifted, they are half the
// power of 2. So the polynomial is doubled; what comes of an e below -64 is not looked at.
FN float range_weight(float e) {
    if (in_double(1)) {
        float y = e >= -64.0f ? e : -64.0f;
        float whole = (y + 6755399441055744.0f) - 6755399441055744.0f;
        float u = y - whole;
        float v = 0.0555073374f + u * (0.0096715128f + u * 0.0013264727f);
        v = 1.0f + u * (0.6931469776f + u * (0.2402224208f + u * v));
        return e >= -64.0f ? v * uintBitsToFloat(uint(127 + int(whole)) << 23) : 0.0f;
    }
    float n = e + 12583038.0f;
    float t = e - (n - 12583038.0f);
    float p = 0.1110146748f + t * (0.0193430256f + t * 0.0026529454f);
    p = 2.0f + t * (1.3862939552f + t * (0.4804448416f + t * p));
    return e >= -64.0f ? p * uintBitsToFloat(floatBitsToUint(n) << 23) : 0.0f;
}

// log2 d for 2^-60 <= d, absolute error 3e-8 near 1; below, and for NaN, -1e30. d = 2^k r, r in [sqrt(1/2), sqrt(2)),
// ln r = 2 atanh((r - 1) / (r + 1)).
FN float log2_cosine(float d) {
    float a = d >= 8.67361738e-19f ? d : 1.0f;
    int k = (int(floatBitsToUint(a)) - 0x3f3504f3) >> 23;
    float r = a * uintBitsToFloat(uint(127 - k) << 23);
    float z = (r - 1.0f) / (r + 1.0f);
    float q = z * z;
    float series = 0.142857142857f + q * (0.111111111111f + q * 0.090909090909f);
    series = 1.0f + q * (0.333333333333f + q * (0.2f + q * series));
    return d >= 8.67361738e-19f ? float(k) + 2.88539008177793f * z * series : -1.0e30f;
}

// Weights of edge-preserving filters, in powers of 2. Only + - * / and bits: the same result on every device.
// Needs math/exact.h.

// 2^e for -64 <= e <= 0, relative error 9.2e-8 and exact at 0; below -64, and for NaN, 0: a weight under 5.4e-20 changes
// no float sum in which the centre weighs 1, and no product with it becomes a denormal.
FN float range_weight(float e) {
    float y = e >= -64.0f ? e : -64.0f;
    float whole = in_double(1) ? 6755399441055744.0f : 12582912.0f;  // 1.5 2^52 or 1.5 2^23: a sum with it has no fraction
    float n = (y + whole) - whole;
    float t = y - n;
    float p = 0.0555073374f + t * (0.0096715128f + t * 0.0013264727f);
    p = 1.0f + t * (0.6931469776f + t * (0.2402224208f + t * p));
    return e >= -64.0f ? p * uintBitsToFloat(uint(127 + int(n)) << 23) : 0.0f;
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

// What premultiplied colour and opacity of a voxel are multiplied by where k times its reference length is crossed:
// s = (1 - (1-a)^k) / a; k at a = 0, 1 at a = 1. Emission and absorption along a path of constant extinction (Max 1995).
// By log(1-a) and 1 - e^x: the power itself, in floats, is wrong by 138 % at a = 1e-7. Needs math/opacity.h.

// ln(1 - a) for 0 <= a < 1 as log_transmittance has it, without a branch: 1 - a = p r, p = 2^k, r in [sqrt(1/2), sqrt(2)),
// z = (r - 1) / (r + 1), and nothing cancels where a is small.
FN float log_through(float a) {
    int k = (int(floatBitsToUint(1.0f - a)) - 0x3f3504f3) >> 23;
    float p = uintBitsToFloat(uint(127 + k) << 23);
    float z = ((1.0f - p) - a) / ((1.0f + p) - a);
    float q = z * z;
    float series = 0.142857142857f + q * (0.111111111111f + q * 0.090909090909f);
    series = 1.0f + q * (0.333333333333f + q * (0.2f + q * series));
    return float(k) * 0.693147180559945f + 2.0f * z * series;
}

FN float extinction_part(float a, float k) {
    if (!(a >= 1.0e-20f)) return k;
    if (a >= 1.0f) return 1.0f / a;
    float x = k * log_through(a);
    return one_minus_exp(x > -64.0f ? x : -64.0f) / a;
}

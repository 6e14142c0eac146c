// What premultiplied colour and opacity of a voxel are multiplied by where k times its reference length is crossed:
// s = (1 - (1-a)^k) / a; k at a = 0, 1 at a = 1. Emission and absorption along a path of constant extinction (Max 1995).
// By log(1-a) and 1 - e^x: the power itself, in floats, is wrong by 138 % at a = 1e-7. Polynomials are minimax and split
// in halves, which a processor works on at once: marching waits for them.

// ln(1 - a) for 0 <= a < 1, within 1e-9 of itself: 1 - a = p r, p = 2^k, r in [sqrt(1/2), sqrt(2)), z = (r - 1) / (r + 1),
// ln r = 2 atanh z; nothing cancels where a is small.
FN float log_through(float a) {
    const int k = (int(floatBitsToUint(1.0f - a)) - 0x3f3504f3) >> 23;
    const float p = uintBitsToFloat(uint(127 + k) << 23);
    const float z = ((1.0f - p) - a) / ((1.0f + p) - a);
    const float q = z * z;
    const float series = (0.66666776527f + q * 0.39977521656f) + q * q * 0.29872310593f;
    return (float(k) * 0.693147180559945f + 2.0f * z) + z * q * series;
}

// 1 - e^x for -64 <= x <= 0, within 3e-10 of itself: e^x = 2^j e^t with |t| <= ln(2)/2.
FN float absorbed(float x) {
    const int j = int(x * 1.44269504088896f - 0.5f);
    const float t = x - float(j) * 0.693147180559945f;
    const float q = t * t;
    const float high = (0.04166635433f + t * 0.00833327298f) + q * (0.00139410359f + t * 0.00019914209f);
    const float p = t + q * ((0.50000000465f + t * 0.16666666817f) + q * high);
    const float m = uintBitsToFloat(uint(127 + j) << 23);
    return (1.0f - m) - m * p;
}

FN float extinction_part(float a, float k) {
    if (!(a >= 1.0e-20f)) return k;
    const float per_a = 1.0f / a;
    const float x = k * log_through(a < 1.0f ? a : 0.0f);
    return a < 1.0f ? absorbed(x > -64.0f ? x : -64.0f) * per_a : per_a;
}

// Sums of 96 bits that do not depend on the order in which they are added to: three words of uint, two's complement, lowest
// first, each added to by itself and carrying on. Wants wide_int.h.
//
// A value v is counted in steps of 2^-72: exact where |v| >= 2^-48 (|v| >= 2^-19 in double), else cut towards zero. Of values up to
// 2^WIDE_SUM_BITS no fewer than 2^(23 - WIDE_SUM_BITS) fit.

// The whole part of 0 <= t < 2^32.
FN uint word_of(float t) {
    const float high = floor(t * 1.52587890625e-5f);
    return uint(int(high)) * 65536u + uint(int(t - high * 65536.0f));
}
// Steps of 0 <= v < 2^23.
FN uvec3 steps_of(float v) {
    float t = v * 256.0f;
    const float high = floor(t);
    t = (t - high) * 4294967296.0f;
    const float middle = floor(t);
    return uvec3(word_of((t - middle) * 4294967296.0f), word_of(middle), uint(int(high)));
}
// Within 4 units 2^-24 of a sum.
FN float value_of_steps(uvec3 s) {
    const bool minus = negative_96(s);
    const uvec3 m = minus ? negate_96(s) : s;
    const float v = ((float_of(m.x) * 2.3283064365386963e-10f + float_of(m.y)) * 2.3283064365386963e-10f + float_of(m.z)) *
                    0.00390625f;
    return minus ? -v : v;
}

// Storage formats in integers, so that every device writes the same bits.
// f16: IEEE 754 binary16, round to nearest even; finite values beyond 65504 and infinities become +-65504, NaN stays NaN.
FN uint f16_bits(float v) {
    uint u = floatBitsToUint(v);
    uint sign = (u >> 16) & 0x8000u;
    uint a = u & 0x7fffffffu;
    if (a > 0x7f800000u) return sign | 0x7e00u;
    if (a >= 0x477ff000u) return sign | 0x7bffu;  // 65520, the first value that would round to infinity
    if (a <= 0x33000000u) return sign;            // up to 2^-25: half the smallest denormal, ties to even
    if (a < 0x38800000u) {                        // below 2^-14: a denormal half
        uint mantissa = (a & 0x7fffffu) | 0x800000u;
        uint shift = 126u - (a >> 23);
        uint q = mantissa >> shift;
        uint rest = mantissa & ((1u << shift) - 1u);
        uint tie = 1u << (shift - 1u);
        return sign | (q + ((rest > tie || (rest == tie && (q & 1u) == 1u)) ? 1u : 0u));
    }
    a = a - 0x38000000u + 0xfffu + ((a >> 13) & 1u);
    return sign | (a >> 13);
}

FN float f16_value(uint bits) {
    uint sign = (bits & 0x8000u) << 16;
    uint exponent = (bits >> 10) & 31u;
    uint mantissa = bits & 1023u;
    if (exponent == 31u) return uintBitsToFloat(sign | 0x7f800000u | (mantissa << 13));
    if (exponent == 0u) {
        float small = float(mantissa) * 5.9604644775390625e-8f;  // 2^-24
        return sign != 0u ? -small : small;
    }
    return uintBitsToFloat(sign | ((exponent + 112u) << 23) | (mantissa << 13));
}

// unorm8: 0..255 for 0..1, round half to even, clamped; NaN becomes 0.
FN uint unorm8_bits(float v) {
    float inside = v > 0.0f ? (v < 1.0f ? v : 1.0f) : 0.0f;
    return floatBitsToUint(inside * 255.0f + 8388608.0f) & 255u;  // a sum with 2^23 is whole, rounded half to even
}

FN float unorm8_value(uint bits) { return float(bits) / 255.0f; }

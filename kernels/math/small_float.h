// Unsigned floats of 5 bits exponent: 6 bits mantissa in 11 bits, 5 in 10; R11G11B10 has red in the lowest 11. Rounded
// to the nearest, ties to even; what is not above 0 (NaN too) becomes 0, what is too large the largest, 65024 and 64512.
FN uint small_float_bits(float v, int mantissa) {
    if (!(v > 0.0f)) return 0u;
    const uint largest = (31u << uint(mantissa)) - 1u;
    const uint u = floatBitsToUint(v);
    if (u >= 0x47800000u) return largest;
    // Below 2^-14: a denormal, in steps of 2^-(14 + mantissa); a sum with 2^23 is whole.
    if (u < 0x38800000u) return floatBitsToUint(v * float(1 << (14 + mantissa)) + 8388608.0f) & 0x7fffffu;
    const uint shift = uint(23 - mantissa);
    const uint rounded_up = u - 0x38000000u + ((1u << (shift - 1u)) - 1u) + ((u >> shift) & 1u);
    return min(rounded_up >> shift, largest);
}
FN float small_float_value(uint code, int mantissa) {
    const uint exponent = (code >> uint(mantissa)) & 31u;
    const uint fraction = code & ((1u << uint(mantissa)) - 1u);
    if (exponent == 0u) return float(fraction) / float(1 << (14 + mantissa));
    return uintBitsToFloat(((exponent + 112u) << 23) | (fraction << uint(23 - mantissa)));
}
FN uint r11g11b10_bits(vec3 v) {
    return small_float_bits(v.x, 6) | (small_float_bits(v.y, 6) << 11) | (small_float_bits(v.z, 5) << 22);
}
FN vec3 r11g11b10_value(uint code) {
    return vec3(small_float_value(code & 2047u, 6), small_float_value((code >> 11) & 2047u, 6), small_float_value(code >> 22, 5));
}

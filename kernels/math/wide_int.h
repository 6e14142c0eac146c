// Signed integers of 64 and 96 bits, two's complement, from uint: uvec2 and uvec3, lowest word first. And conversions of
// integers to float by sums of exact parts, so that every device rounds the same way.

FN uint magnitude(int v) { return uint(abs(v)); }
FN bool negative_64(uvec2 v) { return (v.y >> 31) != 0u; }
FN bool negative_96(uvec3 v) { return (v.z >> 31) != 0u; }
FN bool zero_64(uvec2 v) { return (v.x | v.y) == 0u; }

// What a + b (and a carry into it), of which `sum` is left, carries on: 0 or 1.
FN uint carry_of(uint a, uint b, uint sum) { return ((a & b) | ((a | b) & ~sum)) >> 31; }

FN uvec2 add_64(uvec2 a, uvec2 b) {
    const uint low = a.x + b.x;
    return uvec2(low, a.y + b.y + carry_of(a.x, b.x, low));
}
FN uvec2 negate_64(uvec2 v) { return add_64(uvec2(~v.x, ~v.y), uvec2(1u, 0u)); }
FN uvec2 magnitude_64(uvec2 v) { return negative_64(v) ? negate_64(v) : v; }

FN uvec3 add_96(uvec3 a, uvec3 b) {
    const uint low = a.x + b.x;
    const uint middle = a.y + b.y + carry_of(a.x, b.x, low);
    return uvec3(low, middle, a.z + b.z + carry_of(a.y, b.y, middle));
}
FN uvec3 negate_96(uvec3 v) { return add_96(uvec3(~v.x, ~v.y, ~v.z), uvec3(1u, 0u, 0u)); }

// All 64 bits of a * b, from products of 16-bit halves.
FN uvec2 product_unsigned(uint a, uint b) {
    const uint low = (a & 0xffffu) * (b & 0xffffu);
    const uint right = (a >> 16) * (b & 0xffffu) + (low >> 16);
    const uint left = (a & 0xffffu) * (b >> 16) + (right & 0xffffu);
    return uvec2((left << 16) | (low & 0xffffu), (a >> 16) * (b >> 16) + (right >> 16) + (left >> 16));
}
FN uvec2 product_64(int a, int b) {
    const uvec2 p = product_unsigned(magnitude(a), magnitude(b));
    return (a < 0) != (b < 0) ? negate_64(p) : p;
}
// a * b for |a| < 2^63 where the product is below 2^95.
FN uvec3 product_96(uvec2 a, int b) {
    const uvec2 m = magnitude_64(a);
    const uvec2 low = product_unsigned(m.x, magnitude(b));
    const uvec2 high = product_unsigned(m.y, magnitude(b));
    const uint middle = low.y + high.x;
    const uvec3 p = uvec3(low.x, middle, high.y + carry_of(low.y, high.x, middle));
    return negative_64(a) != (b < 0) ? negate_96(p) : p;
}

FN float float_of(uint v) { return float(v >> 16) * 65536.0f + float(v & 0xffffu); }
FN float float_of_int(int v) { return v < 0 ? -float_of(magnitude(v)) : float_of(magnitude(v)); }
// Within 3 units 2^-24 of v >= 0.
FN float float_of_64(uvec2 v) { return float_of(v.y) * 4294967296.0f + float_of(v.x); }
FN float float_of_signed_64(uvec2 v) { return negative_64(v) ? -float_of_64(magnitude_64(v)) : float_of_64(v); }

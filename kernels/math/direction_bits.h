// Directions in 16 and 32 bits: both coordinates of the octahedral map (math/octahedral.h) as signed fractions, x in the
// low half. Fractions of 127 and 32767, rounded to the nearest, away from 0 at a tie, so that a direction and its mirror
// images get mirrored codes and the axes are exact; unsigned fractions have no 0 and miss them by .32 degrees.
FN uint snorm_bits(float v, float most) { return uint(int(v < 0.0f ? -floor(0.5f - v * most) : floor(v * most + 0.5f))); }
// The value of the lowest `bits` bits (8 or 16).
FN float snorm_value(uint code, int bits) {
    const int half_range = 1 << (bits - 1);
    const int v = int(code & uint(2 * half_range - 1));
    const int whole = v < half_range ? v : v - 2 * half_range;
    return float(max(whole, 1 - half_range)) / float(half_range - 1);
}
FN uint direction_bits(vec3 d, int bits) {
    const vec2 p = octahedral(d);
    const float most = float((1 << (bits - 1)) - 1);
    const uint mask = uint((1 << bits) - 1);
    return (snorm_bits(p.x, most) & mask) | ((snorm_bits(p.y, most) & mask) << uint(bits));
}
FN vec3 direction_value(uint code, int bits) {
    return octahedral_direction(vec2(snorm_value(code, bits), snorm_value(code >> uint(bits), bits)));
}

// Texels of octahedral probes (include/luxel/octahedral_march.h): texel (x, y) of a probe is number
// (probe * size + y) * size + x. What takes 16 bits lies two to a word of 32, the even number in the low half.
// Distances of NO_SURFACE_AT or more mean that no surface is met.
#define NO_SURFACE_AT 1.0e30f  // f32, scene units
#define NO_SURFACE_F16 65504.0f  // f16, units of the cage's diagonal
FN int probe_texel(int probe, int x, int y, int size) { return (probe * size + y) * size + x; }
FN uint bits_of_texel(uint word, int texel) { return (word >> uint(16 * (texel & 1))) & 0xffffu; }
// A distance in f16; `unit`: what 1 stands for.
FN float probe_distance_f16(uint word, int texel, float unit_length) {
    const float v = f16_value(bits_of_texel(word, texel));
    return v < NO_SURFACE_F16 ? v * unit_length : v >= NO_SURFACE_F16 ? NO_SURFACE_AT : v;
}

// Lists of directions (or colours) to codes of 16 or 32 bits, and back.

KERNEL(octahedral_map) {
    for (int i = invocation_x(); i < params.count; i += params.stride) {
#if DECODE
        const uint code = load(codes, i);
        const vec3 v = CODE == 2 ? r11g11b10_value(code) : direction_value(code, CODE == 0 ? 8 : 16);
        store(values, i, vec4(v.x, v.y, v.z, 0.0f));
#else
        const vec4 v = load(values, i);
        const vec3 d = vec3(v.x, v.y, v.z);
        store(codes, i, CODE == 2 ? r11g11b10_bits(d) : direction_bits(d, CODE == 0 ? 8 : 16));
        // The place, and what it gives back along x: exact at axes and on seams.
        const vec2 p = octahedral(d);
        const vec3 back = octahedral_direction(p);
        store(places, i, vec4(p.x, p.y, back.x, back.y));
#endif
    }
}

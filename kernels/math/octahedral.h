// Octahedral map of directions (Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT
// 2014): the pole is +z, both coordinates lie in -1..1; the lower half is folded over the outer triangles. A vector
// without length, and one that is not finite, lies at the pole.
FN vec2 octahedral(vec3 d) {
    const float sum = abs(d.x) + abs(d.y) + abs(d.z);
    if (!(sum > 0.0f && sum < 3.0e38f)) return vec2(0.0f, 0.0f);
    const float x = d.x / sum;
    const float y = d.y / sum;
    if (d.z >= 0.0f) return vec2(x, y);
    return vec2((1.0f - abs(y)) * (x < 0.0f ? -1.0f : 1.0f), (1.0f - abs(x)) * (y < 0.0f ? -1.0f : 1.0f));
}

// The point of the octahedron |x| + |y| + |z| = 1 at a place of the map, exact at axes and on seams; and the unit vector.
FN vec3 octahedron_point(vec2 p) {
    const float z = 1.0f - abs(p.x) - abs(p.y);
    if (z >= 0.0f) return vec3(p.x, p.y, z);
    return vec3((1.0f - abs(p.y)) * (p.x < 0.0f ? -1.0f : 1.0f), (1.0f - abs(p.x)) * (p.y < 0.0f ? -1.0f : 1.0f), z);
}
FN vec3 octahedral_direction(vec2 p) {
    const vec3 q = octahedron_point(p);
    return q / sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
}

// A map of size x size texels: u to the right, v down. Centre of a texel, and the texel that a place lies in.
FN vec2 octahedral_centre(int x, int y, int size) {
    return vec2(float(2 * x + 1 - size) / float(size), float(2 * y + 1 - size) / float(size));
}
FN int octahedral_texel(float u, int size) { return clamp(int(floor((u + 1.0f) * (0.5f * float(size)))), 0, size - 1); }
FN ivec2 octahedral_texels(vec2 p, int size) { return ivec2(octahedral_texel(p.x, size), octahedral_texel(p.y, size)); }

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

// The texel that lies beyond the border: for x and y from -1 to size, that which shares the edge (or the corner) on the
// sphere. Every edge is met again mirrored at its middle; all four corners are -z.
FN ivec2 octahedral_beyond(int x, int y, int size) {
    int to_x = x;
    int to_y = y;
    if (x < 0 || x >= size) {
        to_x = x < 0 ? 0 : size - 1;
        to_y = size - 1 - to_y;
    }
    if (y < 0 || y >= size) {
        to_y = (to_y < 0) ? 0 : (to_y >= size) ? size - 1 : to_y;
        to_x = size - 1 - to_x;
    }
    return ivec2(to_x, to_y);
}
